//! One robot on its way by TAN: what the kernel orders, carried out in the field, step by step.
//!
//! A robot walks into no obstacle and does not leave the area: when it feels the rim within a step, that direction is
//! barred, and it scans again without it, so that it goes along the rim. A step that takes it out of hearing, behind a
//! corner, it takes back, and bars that direction, too. Once it has gone another way no direction is barred any more.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use tautline_io::named_values::NamedValues;
use tautline_kernel::choice::Oracle;
use tautline_kernel::net::{NodeId, RobotId, Strength};
use tautline_kernel::tan::{Heading, Homing, Nav, Nearness, Order, Stage};

use super::{Antenna, Ear, Signal};
use crate::radio::{Field, Point, Problem, Radio};

/// How fast a robot is.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Gait {
    /// Its speed, in millimetres a second.
    pub speed_mm_s: u32,
    /// The time of a turn by 15°, in nanoseconds.
    pub turn_ns: u64,
    /// The time of a measurement: one packet of the signal, in nanoseconds.
    pub measure_ns: u64,
    /// How long it waits for the answer to a REQNAV, in nanoseconds.
    pub answer_ns: u64,
    /// How far it walks between two measurements, in millimetres.
    pub step_mm: u32,
}

impl Gait {
    /// A man's walking pace, 1.4 m/s, and a turn once round in 2.4 s. A packet of a sensor's radio takes 992 µs. An
    /// answer takes two of them and, on a shared channel, some waiting for it. Half a metre is a fiftieth of the
    /// paper's range.
    pub const WALKING: Self = Self {
        speed_mm_s: 1_400,
        turn_ns: 100_000_000,
        measure_ns: 992_000,
        answer_ns: 20_000_000,
        step_mm: 500,
    };

    fn walk_ns(self, length_m: f64) -> u64 {
        (length_m * 1e12 / f64::from(self.speed_mm_s.max(1))) as u64
    }
}

/// When a robot turns its antenna once round [Jiang 2011, 3.4, step 3].
#[derive(Clone, Copy, PartialEq, Eq, Debug, JsonSchema, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Scans {
    /// When it hears the NAV that it has asked for, and when the signal gets weaker or its way is barred.
    Again,
    /// When it hears the NAV that it has asked for. Then it walks straight on until it is there, or asks again where it
    /// hears nothing or its way is barred.
    Once,
}

impl NamedValues for Scans {
    const WORDS: &'static [(Self, &'static str, &'static str)] = &[
        (
            Self::Again,
            "again",
            "For each signal that it asks for, and when that gets weaker or its way is barred",
        ),
        (Self::Once, "once", "For each signal that it asks for"),
    ];
}

/// A robot's equipment to find its way with.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Equipment {
    /// Its receiver.
    pub ear: Ear,
    /// Its directional antenna.
    pub antenna: Antenna,
    /// How fast it is.
    pub gait: Gait,
    /// When it is at a node, in metres.
    pub near_m: f64,
    /// When it is at a node, by the strength of its signal.
    pub nearness: Nearness,
    /// When it turns its antenna once round.
    pub scans: Scans,
}

/// How often a robot asks one node in vain.
const TRIES: u8 = 3;

/// How often a robot halves its distance from the last node to hear the next: from a hundredth of the range on.
const HALVINGS: u8 = 7;

impl Equipment {
    /// That of a robot among nodes with `radio`, whose measurements are off by a standard deviation of `noise_db`. It
    /// is at a node when it is a hundredth of the range off, as far as it hears farther than a node.
    ///
    /// # Errors
    /// [`Problem::Deviation`] if that is not from 0 to 20 dB.
    pub fn new(radio: Radio, noise_db: f64) -> Result<Self, Problem> {
        Self::near(radio, noise_db, (super::ROBOT_REACH - 1.0) * radio.range_m())
    }

    /// As [`Self::new`], at a node when it is `near_m` off.
    ///
    /// # Errors
    /// As [`Self::new`].
    pub fn near(radio: Radio, noise_db: f64, near_m: f64) -> Result<Self, Problem> {
        let (ear, antenna) = (Ear::new(radio, noise_db)?, Antenna::DIRECTIONAL);
        let [near, half] = [near_m, near_m / 2.0].map(|distance_m| ear.expected(&antenna, distance_m));
        let closer = half.0.abs_diff(near.0).try_into().unwrap_or(u16::MAX);
        let nearness = Nearness { near, closer, times: HALVINGS };
        Ok(Self { ear, antenna, gait: Gait::WALKING, near_m, nearness, scans: Scans::Again })
    }

    /// How far to walk towards a node that is heard so strong on the axis of `antenna`: a step, or half the way.
    pub(super) fn stride_m(&self, antenna: &Antenna, strength: Strength) -> f64 {
        (f64::from(self.gait.step_mm) / 1_000.0).min(self.ear.distance_m(antenna, strength) / 2.0)
    }
}

/// Directions in which a robot does not go from where it is.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
struct HeadingSet(u32);

impl HeadingSet {
    const NONE: Self = Self(0);

    fn bar(&mut self, heading: Heading) {
        self.0 |= Self::bit(heading);
    }

    fn has(self, heading: Heading) -> bool {
        self.0 & Self::bit(heading) != 0
    }

    fn bit(heading: Heading) -> u32 {
        1 << fifteens(heading)
    }
}

/// Steps of 15° from the first heading.
fn fifteens(heading: Heading) -> u16 {
    heading.degrees() / 15
}

/// The place `length_m` from another.
pub(super) fn ahead(from: Point, heading: Heading, length_m: f64) -> Point {
    let (cosine, sine) = heading.vector();
    let along = |part: i32| length_m * (f64::from(part) / 1e6);
    Point { x_m: from.x_m + along(cosine), y_m: from.y_m + along(sine) }
}

/// Whether a robot can go straight from one place to another: inside the area, and through no obstacle.
pub(super) fn is_open(field: &Field, from: Point, to: Point) -> bool {
    field.area().contains(to) && field.has_way(from, to)
}

/// A robot on its way.
#[derive(Clone, PartialEq, Debug)]
pub struct Walker {
    equipment: Equipment,
    homing: Homing,
    facing: Heading,
    barred: HeadingSet,
    trail: Trail,
}

impl Walker {
    /// A robot at `start`, facing +x, that sets out to `wfr`, `hops` away, by its parent in the tree.
    pub fn new(
        equipment: Equipment,
        start: Point,
        robot: RobotId,
        wfr: NodeId,
        (parent, hops): (NodeId, u16),
    ) -> Self {
        let homing = Homing::new(wfr, robot, parent, hops, equipment.nearness, TRIES);
        Self { equipment, homing, facing: Heading::FIRST, barred: HeadingSet::NONE, trail: Trail::new(start) }
    }

    /// The robot's action now. [`Order::Ask`] is for the caller, who sends the REQNAV and comes back with
    /// [`Self::hear`] or [`Self::expire`]; [`Order::Point`] and [`Order::Walk`] are for [`Self::act`].
    pub const fn order(&self) -> Order {
        self.homing.order()
    }

    /// How far it has come.
    pub const fn stage(&self) -> Stage {
        self.homing.stage()
    }

    /// Its hops from the WFR.
    pub const fn hops(&self) -> u16 {
        self.homing.hops()
    }

    /// Whose signal it follows, while it does.
    pub const fn guide(&self) -> Option<NodeId> {
        match self.homing.stage() {
            Stage::Scanning { nav, .. } | Stage::Walking { nav, .. } => Some(nav.node),
            Stage::Asking { .. } | Stage::Arrived | Stage::Lost => None,
        }
    }

    /// Where it is.
    pub fn at(&self) -> Point {
        self.trail.end()
    }

    /// Where it has been: its start, each place where it has turned, and where it is.
    pub fn trail(&self) -> &[Point] {
        &self.trail.points
    }

    /// How far it has walked, in metres.
    pub const fn walked_m(&self) -> f64 {
        self.trail.length_m
    }

    /// A NAV has arrived. One that says nothing new leaves barred what is barred.
    pub fn hear(&mut self, nav: Nav) {
        let next = self.homing.hear(nav);
        if next != self.homing {
            self.homing = next;
            self.barred = HeadingSet::NONE;
        }
    }

    /// It has waited in vain for a NAV, [`Gait::answer_ns`] long.
    pub fn expire(&mut self) {
        self.homing = self.homing.expire();
    }

    /// Points the antenna or walks a step, whichever is the order, and measures the signal of its guide, `None` if that
    /// sends none. Returns how long that takes, in nanoseconds, in which the robot goes straight from where it was to
    /// where it is then.
    pub fn act(&mut self, field: &Field, signal: Option<Signal>, chance: &mut dyn Oracle) -> u64 {
        let gait = self.equipment.gait;
        match (self.homing.stage(), self.homing.order()) {
            (_, Order::Point(heading)) => {
                let turn_ns = self.face(heading);
                let heard = self.measure(field, signal, chance);
                self.homing = self.homing.measure(heard.filter(|_| !self.barred.has(heading)));
                turn_ns + gait.measure_ns
            }
            (Stage::Walking { strongest, .. }, Order::Walk(heading)) => {
                self.face(heading) + self.walk(field, signal, strongest, chance)
            }
            (_, Order::Ask(_) | Order::Walk(_) | Order::Stop) => 0,
        }
    }

    fn walk(
        &mut self,
        field: &Field,
        signal: Option<Signal>,
        strongest: Strength,
        chance: &mut dyn Oracle,
    ) -> u64 {
        let gait = self.equipment.gait;
        let from = self.at();
        let stride_m = self.equipment.stride_m(&self.equipment.antenna, strongest);
        let to = ahead(from, self.facing, stride_m);
        if signal.is_none() {
            self.homing = self.homing.measure(None);
            return gait.measure_ns;
        }
        if !is_open(field, from, to) {
            self.bump();
            return 0;
        }
        self.trail.go(to, self.facing, stride_m);
        let once_ns = gait.walk_ns(stride_m) + gait.measure_ns;
        if let Some(heard) = self.measure(field, signal, chance) {
            self.barred = HeadingSet::NONE;
            let heard = match self.equipment.scans {
                Scans::Again => heard,
                // It goes on however weak the signal gets.
                Scans::Once => heard.max(strongest),
            };
            self.homing = self.homing.measure(Some(heard));
            return once_ns;
        }
        self.trail.go(from, self.facing.opposite(), stride_m);
        match self.measure(field, signal, chance) {
            Some(_) => self.bump(),
            None => self.homing = self.homing.measure(None),
        }
        2 * once_ns
    }

    fn bump(&mut self) {
        self.barred.bar(self.facing);
        self.homing = match self.equipment.scans {
            Scans::Again => self.homing.bump(),
            Scans::Once => self.homing.measure(None),
        };
    }

    /// Turns the shorter way, and says how long that takes.
    fn face(&mut self, heading: Heading) -> u64 {
        let steps = fifteens(self.facing).abs_diff(fifteens(heading));
        self.facing = heading;
        u64::from(steps.min(u16::from(Heading::COUNT) - steps)) * self.equipment.gait.turn_ns
    }

    fn measure(&self, field: &Field, signal: Option<Signal>, chance: &mut dyn Oracle) -> Option<Strength> {
        let axis = (&self.equipment.antenna, self.facing);
        self.equipment.ear.strength(field, signal?, self.at(), axis, chance)
    }
}

/// Where a robot has been.
#[derive(Clone, PartialEq, Debug)]
pub(super) struct Trail {
    pub(super) points: Vec<Point>,
    heading: Option<Heading>,
    pub(super) length_m: f64,
}

impl Trail {
    pub(super) fn new(start: Point) -> Self {
        Self { points: vec![start], heading: None, length_m: 0.0 }
    }

    pub(super) fn end(&self) -> Point {
        // There is a start at least.
        self.points.last().copied().unwrap_or(Point { x_m: 0.0, y_m: 0.0 })
    }

    /// Goes to a place `length_m` off in this direction.
    pub(super) fn go(&mut self, to: Point, heading: Heading, length_m: f64) {
        if self.heading.replace(heading) == Some(heading) {
            self.points.pop();
        }
        self.points.push(to);
        self.length_m += length_m;
    }

    /// Goes straight to a place.
    pub(super) fn go_straight(&mut self, to: Point) {
        self.length_m += super::ear::apart_m(self.end(), to);
        self.heading = None;
        self.points.push(to);
    }
}

#[cfg(test)]
mod tests {
    use tautline_proofs::engine::Tape;

    use super::*;
    use crate::radio::{Area, Model, Obstacle};

    const GUIDE: NodeId = NodeId(0);
    const NAV: Nav = Nav { wfr: GUIDE, node: GUIDE, hops: 0, parent: GUIDE };

    const fn at(x_m: f64, y_m: f64) -> Point {
        Point { x_m, y_m }
    }

    fn field(node: Point, obstacles: Vec<Obstacle>) -> Field {
        let area = Area::new(100.0, 100.0).expect("an area");
        Field::new(area, obstacles, vec![node, at(100.0, 100.0)]).expect("a field")
    }

    /// A robot that has heard its guide, the WFR itself.
    fn led(start: Point) -> Walker {
        let equipment =
            Equipment::new(Radio::new(25.0, Model::Disc).expect("a radio"), 0.0).expect("equipment");
        let mut walker = Walker::new(equipment, start, RobotId(7), GUIDE, (GUIDE, 1));
        walker.barred.bar(Heading::FIRST);
        assert!(
            matches!(walker.order(), Order::Ask(request) if request.node == GUIDE && request.robot == RobotId(7))
        );
        walker.hear(NAV);
        assert_eq!(walker.barred, HeadingSet::NONE, "a new signal may be anywhere");
        walker
    }

    /// Acts until there is nothing to do but to ask or to stop, a thousand times at most; how long that takes.
    fn act(walker: &mut Walker, field: &Field, signal: Option<Signal>) -> u64 {
        let mut time_ns = 0;
        for _ in 0..1_000 {
            match walker.order() {
                Order::Point(_) | Order::Walk(_) => time_ns += walker.act(field, signal, &mut Tape(&[])),
                Order::Ask(_) | Order::Stop => break,
            }
        }
        time_ns
    }

    #[test]
    fn a_robot_walks_straight_to_a_node_due_east_and_time_passes() {
        let node = at(30.0, 50.0);
        let (field, mut walker) = (field(node, vec![]), led(at(10.0, 50.0)));
        let time_ns = act(&mut walker, &field, Some(Signal::plain(node)));
        assert_eq!((walker.stage(), walker.trail().len(), walker.guide()), (Stage::Arrived, 2, None));
        assert!((19.75..19.95).contains(&walker.walked_m()), "{}", walker.walked_m());
        // Once round and back to the first direction 2.4 s, 20 m at 1.4 m/s 14 s, and some 70 packets.
        assert!((16_400_000_000..16_800_000_000).contains(&time_ns), "{time_ns}");
    }

    #[test]
    fn a_step_behind_a_corner_is_taken_back_and_another_way_found() {
        // The node is in sight by three centimetres, 7° southwards of east: due east it is not.
        let lake = Obstacle { west_m: 20.0, north_m: 40.0, east_m: 40.0, south_m: 50.0 };
        let (start, node) = (at(10.0, 48.8), at(32.0, 51.5));
        let field = field(node, vec![lake]);
        assert!(field.has_way(start, node) && !field.has_way(at(10.5, 48.8), node));
        let mut walker = led(start);
        act(&mut walker, &field, Some(Signal::plain(node)));
        assert_eq!(walker.stage(), Stage::Arrived);
        assert_eq!(walker.trail()[..3], [start, at(10.5, 48.8), start]);
    }

    /// A direction is off by up to 7.5°, so that one scan leads past a node, and out of hearing of it.
    #[test]
    fn one_scan_leads_past_the_node_and_another_one_back_to_it() {
        let node = at(30.0, 52.5);
        let field = field(node, vec![]);
        let arrives = |scans| {
            let mut walker = led(at(10.0, 50.0));
            walker.equipment.scans = scans;
            act(&mut walker, &field, Some(Signal::plain(node)));
            walker.stage()
        };
        assert_eq!(arrives(Scans::Again), Stage::Arrived);
        assert!(matches!(arrives(Scans::Once), Stage::Asking { .. }));
    }

    #[test]
    fn a_robot_stops_at_the_rim_and_goes_on_along_it() {
        let lake = Obstacle { west_m: 15.0, north_m: 40.0, east_m: 40.0, south_m: 50.0 };
        let (start, node) = (at(5.0, 53.3), at(28.0, 50.1));
        let field = field(node, vec![lake]);
        let mut walker = led(start);
        act(&mut walker, &field, Some(Signal::plain(node)));
        assert_eq!(walker.stage(), Stage::Arrived);
        assert!(walker.trail().windows(2).all(|leg| field.has_way(leg[0], leg[1])));
        // 15° northwards into the lake it would have been one leg.
        assert!(walker.trail().len() > 2, "{:?}", walker.trail());
    }

    #[test]
    fn a_direction_is_barred_until_the_robot_has_gone_another() {
        let node = at(30.0, 50.0);
        let (field, mut walker) = (field(node, vec![]), led(at(10.0, 50.0)));
        walker.barred.bar(Heading::FIRST);
        while !matches!(walker.order(), Order::Walk(_)) {
            walker.act(&field, Some(Signal::plain(node)), &mut Tape(&[]));
            walker.hear(NAV);
        }
        assert_eq!(
            walker.order(),
            Order::Walk(Heading::FIRST.turned(1)),
            "the same signal again changes nothing"
        );
        walker.act(&field, Some(Signal::plain(node)), &mut Tape(&[]));
        assert_eq!(walker.barred, HeadingSet::NONE);
    }

    #[test]
    fn a_robot_whose_guide_falls_silent_stays_and_asks_again() {
        let node = at(30.0, 50.0);
        let (field, mut walker) = (field(node, vec![]), led(at(10.0, 50.0)));
        while !matches!(walker.order(), Order::Walk(_)) {
            walker.act(&field, Some(Signal::plain(node)), &mut Tape(&[]));
        }
        walker.act(&field, Some(Signal::plain(node)), &mut Tape(&[]));
        let was = walker.trail().to_vec();
        act(&mut walker, &field, None);
        assert!(matches!(walker.order(), Order::Ask(_)));
        assert_eq!((walker.trail(), was.len()), (&was[..], 2), "not a step further");
        walker.expire();
        walker.expire();
        assert_eq!((walker.stage(), walker.act(&field, None, &mut Tape(&[]))), (Stage::Lost, 0));
    }
}

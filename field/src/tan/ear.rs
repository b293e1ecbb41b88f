//! A robot's hearing of a node: whether it hears it at all, and how strong, by distance, direction, shadow and noise.
//!
//! The level of a signal is that of equation (1) above what can just be heard all round, at the robot's reach, by how
//! far off the node seems to be; the antenna adds its gain. Strengths are levels in hundredths of a dB.

use tautline_kernel::choice::Oracle;
use tautline_kernel::net::{NodeId, Propagation, Strength};
use tautline_kernel::tan::Heading;

use super::Antenna;
use super::antenna::degrees_off;
use crate::radio::{Field, Network, Point, Problem, Radio, checked_deviation};
use tautline_grids::chance::deviation;

/// How many times as far as a node a robot hears, and is heard: a tenth of a dB in free space. A robot that is at a
/// node, as near as it goes, so hears whom the node hears.
pub const ROBOT_REACH: f64 = 1.01;

/// Nothing is nearer to an antenna, in metres.
pub const NEAREST_M: f64 = 0.001;

/// A node that sends.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Signal {
    /// Where it is.
    pub at: Point,
    /// How many times as far off as it is it seems to be, for the shadow on the way: 1 if there is none.
    pub stretch: f64,
}

impl Signal {
    /// A node whose signals no shadow changes.
    pub const fn plain(at: Point) -> Self {
        Self { at, stretch: 1.0 }
    }

    /// `node` as it is heard near `place`: with the shadow between the two, if they are linked.
    pub fn near(field: &Field, network: &Network, node: NodeId, place: NodeId) -> Self {
        let at = field.at(node);
        let apart_m = apart_m(at, field.at(place));
        let seems_um = network.distance_um(place, node).filter(|_| apart_m > 0.0);
        Self { at, stretch: seems_um.map_or(1.0, |seems_um| f64::from(seems_um) / 1e6 / apart_m) }
    }

    /// How far off it seems to be, in metres.
    #[inline]
    pub(crate) fn seems_m(self, from: Point) -> f64 {
        self.stretch * apart_m(self.at, from)
    }
}

/// How far apart two points are.
#[inline]
pub(crate) fn apart_m(one: Point, other: Point) -> f64 {
    let (x_m, y_m) = (one.x_m - other.x_m, one.y_m - other.y_m);
    (x_m * x_m + y_m * y_m).sqrt()
}

/// A robot's receiver.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Ear {
    reach_m: f64,
    propagation: Propagation,
    noise_db: f64,
}

impl Ear {
    /// The receiver of a robot among nodes with `radio`. Each strength that it measures is off by a standard deviation
    /// of `noise_db`, anew each time.
    ///
    /// # Errors
    /// [`Problem::Deviation`] if that is not from 0 to 20 dB.
    pub fn new(radio: Radio, noise_db: f64) -> Result<Self, Problem> {
        let reach_m = ROBOT_REACH * radio.range_m();
        Ok(Self { reach_m, propagation: radio.propagation(), noise_db: checked_deviation(noise_db)? })
    }

    /// Whether a robot and a node hear each other's messages.
    #[inline]
    pub fn hears(&self, field: &Field, signal: Signal, from: Point) -> bool {
        signal.seems_m(from) <= self.reach_m && field.has_way(signal.at, from)
    }

    /// How strong the signal is on the axis of `antenna`; `None` if it is not heard at all. Noise is in the
    /// measurement, not on the air: it does not decide about that.
    pub fn strength(
        &self,
        field: &Field,
        signal: Signal,
        from: Point,
        (antenna, axis): (&Antenna, Heading),
        chance: &mut dyn Oracle,
    ) -> Option<Strength> {
        let (x_m, y_m) = (signal.at.x_m - from.x_m, signal.at.y_m - from.y_m);
        let gain_db = antenna.gain_db(degrees_off(axis, x_m, y_m));
        let level_db = self.level_db(signal.seems_m(from)) + gain_db;
        if level_db < 0.0 || !field.has_way(signal.at, from) {
            return None;
        }
        Some(Strength(hundredths(level_db + deviation(self.noise_db, chance))))
    }

    /// How strong the signal of a node so far off is on the axis of `antenna`, without shadow and noise.
    pub fn expected(&self, antenna: &Antenna, distance_m: f64) -> Strength {
        Strength(hundredths(self.level_db(distance_m) + antenna.most_db()))
    }

    /// How far off a node seems to be whose signal is so strong on the axis of `antenna`, in metres: the reverse.
    pub fn distance_m(&self, antenna: &Antenna, strength: Strength) -> f64 {
        let level_db = f64::from(strength.0) / 100.0 - antenna.most_db();
        self.reach_m * self.propagation.times_as_far(-level_db)
    }

    fn level_db(&self, seems_m: f64) -> f64 {
        self.propagation.level_db(self.reach_m, seems_m.max(NEAREST_M))
    }
}

fn hundredths(db: f64) -> i32 {
    (db * 100.0).round() as i32
}

#[cfg(test)]
mod tests {
    use tautline_proofs::engine::{SeededOracle, Tape};

    use super::*;
    use crate::radio::{Area, Model, Obstacle};

    const AXIS: (&Antenna, Heading) = (&Antenna::DIRECTIONAL, Heading::FIRST);

    fn at(x_m: f64, y_m: f64) -> Point {
        Point { x_m, y_m }
    }

    fn field(obstacles: Vec<Obstacle>) -> Field {
        let area = Area::new(100.0, 100.0).expect("an area");
        Field::new(area, obstacles, vec![at(0.0, 0.0), at(100.0, 100.0)]).expect("a field")
    }

    fn ear(noise_db: f64) -> Ear {
        Ear::new(Radio::new(25.0, Model::Disc).expect("a radio"), noise_db).expect("an ear")
    }

    #[test]
    fn strength_falls_with_the_distance_and_off_the_axis_and_tells_the_distance() {
        let (field, ear) = (field(vec![]), ear(0.0));
        let heard = |x_m, y_m, heading| {
            let axis = (&Antenna::DIRECTIONAL, heading);
            ear.strength(&field, Signal::plain(at(x_m, y_m)), at(0.0, 0.0), axis, &mut Tape(&[]))
        };
        let ahead = heard(20.0, 0.0, Heading::FIRST);
        assert_eq!(ahead, Some(Strength(1_002)), "20·log₁₀(25.25/20) + 8 dB");
        assert_eq!(ahead, Some(ear.expected(&Antenna::DIRECTIONAL, 20.0)));
        assert!((ear.distance_m(&Antenna::DIRECTIONAL, Strength(1_002)) - 20.0).abs() < 0.02);
        assert!(heard(10.0, 0.0, Heading::FIRST) > ahead);
        assert!(heard(20.0, 0.0, Heading::FIRST.turned(1)) < ahead);
        assert_eq!(heard(20.0, 0.0, Heading::FIRST.opposite()), None);
        let doubled = Signal { stretch: 2.0, ..Signal::plain(at(10.0, 0.0)) };
        assert_eq!(ear.strength(&field, doubled, at(0.0, 0.0), AXIS, &mut Tape(&[])), ahead);
    }

    #[test]
    fn a_robot_hears_a_hundredth_farther_than_a_node_and_not_through_an_obstacle() {
        let lake = Obstacle { west_m: 5.0, north_m: 40.0, east_m: 6.0, south_m: 60.0 };
        let (field, ear) = (field(vec![lake]), ear(0.0));
        let hears = |x_m, y_m, from| ear.hears(&field, Signal::plain(at(x_m, y_m)), from);
        assert!(hears(25.25, 0.0, at(0.0, 0.0)) && !hears(25.26, 0.0, at(0.0, 0.0)));
        assert!(!hears(10.0, 50.0, at(0.0, 50.0)));
        let behind = Signal::plain(at(10.0, 50.0));
        assert_eq!(ear.strength(&field, behind, at(0.0, 50.0), AXIS, &mut Tape(&[])), None);
    }

    #[test]
    fn noise_has_its_deviation() {
        let (field, ear) = (field(vec![]), ear(2.0));
        let mut source = SeededOracle::new(1, 0);
        let mut strength = || {
            let heard = ear.strength(&field, Signal::plain(at(20.0, 0.0)), at(0.0, 0.0), AXIS, &mut source);
            f64::from(heard.expect("in range").0) - 1_002.0
        };
        let squares: f64 = (0..10_000).map(|_| strength().powi(2)).sum();
        assert!(((squares / 10_000.0).sqrt() - 200.0).abs() < 6.0, "{squares}");
        assert!(Ear::new(Radio::new(25.0, Model::Disc).expect("a radio"), f64::NAN).is_err());
    }
}

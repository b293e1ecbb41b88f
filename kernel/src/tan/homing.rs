//! TAN [Jiang 2011, 3.4; clauses TAN-1 and TAN-2]: the robot asks its parent for a signal, turns its antenna once
//! round, walks towards the strongest direction, and asks the next parent when it is there, with a hop count one less
//! each time, until it is 0.
//!
//! Left open by the paper, and chosen here: a robot that hears nothing asks again; one that walks past the node, since
//! a direction is off by up to 7.5°, or meets an obstacle, scans again. A parent may be at the very end of what its
//! child hears, or just behind a corner, so that the robot beside the child hears nothing of it: then the robot goes
//! nearer to the child, and asks from there. It gives up after so many times.

use super::heading::{Heading, Scan};
use crate::net::{NodeId, RobotId, Strength};

/// REQNAV⟨SN, MID, PID⟩.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct ReqNav {
    /// SN: where the robot goes.
    pub wfr: NodeId,
    /// MID: who asks.
    pub robot: RobotId,
    /// PID: the node that is to send the signal.
    pub node: NodeId,
}

/// NAV: a path node's signal, with its parent in it, as the paper suggests.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Nav {
    /// SN: the root of the tree.
    pub wfr: NodeId,
    /// Who sends.
    pub node: NodeId,
    /// HC: its hops from the WFR.
    pub hops: u16,
    /// Its parent; its own identity at the WFR.
    pub parent: NodeId,
}

/// A path node's part in TAN: its conduct until T_x has passed. Whoever keeps the time may let a silence that has begun
/// last on, or begin anew with each packet: the paper says neither.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Guide {
    /// It has nothing to do with a robot.
    Idle,
    /// It sends NAV.
    Signals(Nav),
    /// It keeps silent, so as not to disturb another's signal.
    Silent,
}

impl Guide {
    /// A REQNAV has arrived; `own` is the node's place in the tree of that WFR, if it is a path node. The one that is
    /// asked signals, the others keep silent, each for T_x. One that keeps silent for another robot's sake does not
    /// signal: the robot asks again.
    #[must_use]
    pub fn request(self, request: ReqNav, id: NodeId, own: Option<Nav>) -> Self {
        let own = own.filter(|own| request.node == id && own.node == id && own.wfr == request.wfr);
        match (self, own) {
            (Self::Idle | Self::Signals(_), Some(own)) => Self::Signals(own),
            (Self::Silent, Some(_)) | (Self::Signals(_), None) => self,
            (Self::Idle | Self::Silent, None) => Self::Silent,
        }
    }

    /// Another node's NAV has been heard: silence for T_x, unless it sends itself.
    #[must_use]
    pub const fn overhear(self) -> Self {
        match self {
            Self::Signals(_) => self,
            Self::Idle | Self::Silent => Self::Silent,
        }
    }

    /// T_x has passed.
    #[must_use]
    pub const fn expire(self) -> Self {
        Self::Idle
    }
}

/// When a robot is at a node.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Nearness {
    /// The node's signal is at least as strong.
    pub near: Strength,
    /// How much stronger it is to be each time that the next node is not heard from there.
    pub closer: u16,
    /// How many times at most.
    pub times: u8,
}

/// How far a robot has come.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Stage {
    /// It has asked a node for its signal.
    Asking {
        /// Which.
        node: NodeId,
    },
    /// It hears the signal and turns its antenna.
    Scanning {
        /// Whose signal.
        nav: Nav,
        /// How far round it is.
        scan: Scan,
    },
    /// It walks towards the node.
    Walking {
        /// Whose signal.
        nav: Nav,
        /// The direction.
        heading: Heading,
        /// The strongest signal on this walk.
        strongest: Strength,
    },
    /// It is at the WFR.
    Arrived,
    /// A node did not answer: the robot no longer knows its way.
    Lost,
}

/// The robot's next action.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Order {
    /// Send this and wait for the signal.
    Ask(ReqNav),
    /// Point the antenna there and measure.
    Point(Heading),
    /// Walk a little that way and measure.
    Walk(Heading),
    /// Nothing: it is where it wanted to be, or lost.
    Stop,
}

/// A robot on its way through the tree of a WFR.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Homing {
    wfr: NodeId,
    robot: RobotId,
    hops: u16,
    tries: u8,
    tries_left: u8,
    nearness: Nearness,
    times_left: u8,
    /// The node where it is, if it has come to one, and its hops.
    last: Option<(NodeId, u16)>,
    stage: Stage,
}

impl Homing {
    /// A robot that sets out, `hops` from the WFR, by its parent in the tree. It asks each node at least once and at
    /// most `tries` times in vain.
    pub const fn new(
        wfr: NodeId,
        robot: RobotId,
        parent: NodeId,
        hops: u16,
        nearness: Nearness,
        tries: u8,
    ) -> Self {
        let (tries_left, times_left) = (tries.saturating_sub(1), nearness.times);
        let stage = Stage::Asking { node: parent };
        Self { wfr, robot, hops, tries, tries_left, nearness, times_left, last: None, stage }
    }

    /// How far it has come.
    pub const fn stage(&self) -> Stage {
        self.stage
    }

    /// Its hops from the WFR: one more than those of the node to which it goes.
    pub const fn hops(&self) -> u16 {
        self.hops
    }

    /// The robot's action now.
    pub const fn order(&self) -> Order {
        match self.stage {
            Stage::Asking { node } => Order::Ask(ReqNav { wfr: self.wfr, robot: self.robot, node }),
            Stage::Scanning { scan, .. } => match scan.heading() {
                Some(heading) => Order::Point(heading),
                None => Order::Stop,
            },
            Stage::Walking { heading, .. } => Order::Walk(heading),
            Stage::Arrived | Stage::Lost => Order::Stop,
        }
    }

    /// A NAV has arrived. Only the node that was asked counts, in the tree of this WFR, one hop nearer than the robot.
    #[must_use]
    pub fn hear(mut self, nav: Nav) -> Self {
        let is_nearer = nav.hops.checked_add(1) == Some(self.hops);
        let is_asked = self.stage == Stage::Asking { node: nav.node };
        if is_asked && nav.wfr == self.wfr && is_nearer {
            self.stage = Stage::Scanning { nav, scan: Scan::START };
        }
        self
    }

    /// The strength of the signal after what [`Self::order`] says, pointing or walking; `None` if nothing is heard.
    #[must_use]
    pub fn measure(mut self, heard: Option<Strength>) -> Self {
        match self.stage {
            Stage::Scanning { nav, scan } => {
                let scan = scan.measure(heard);
                match (scan.heading(), scan.best()) {
                    (Some(_), _) => self.stage = Stage::Scanning { nav, scan },
                    (None, Some((strength, _))) if self.is_near(nav.node, strength) => self.reach(nav),
                    (None, Some((strongest, heading))) => {
                        self.stage = Stage::Walking { nav, heading, strongest };
                    }
                    (None, None) => self.ask_again(nav.node),
                }
            }
            Stage::Walking { nav, heading, strongest } => match heard {
                Some(strength) if self.is_near(nav.node, strength) => self.reach(nav),
                Some(strength) if strength >= strongest => {
                    self.stage = Stage::Walking { nav, heading, strongest: strength };
                }
                Some(_) => self.stage = Stage::Scanning { nav, scan: Scan::START },
                None => self.ask_again(nav.node),
            },
            Stage::Asking { .. } | Stage::Arrived | Stage::Lost => {}
        }
        self
    }

    /// The way in the direction of its walk is barred: it scans again from where it is.
    #[must_use]
    pub const fn bump(mut self) -> Self {
        if let Stage::Walking { nav, .. } = self.stage {
            self.stage = Stage::Scanning { nav, scan: Scan::START };
        }
        self
    }

    /// It has waited in vain for the signal of the node that it has asked.
    #[must_use]
    pub fn expire(mut self) -> Self {
        if let Stage::Asking { node } = self.stage {
            self.ask_again(node);
        }
        self
    }

    /// Whether it is at the node that it hears as `strength`. At a node where it has been it is to be nearer than then.
    fn is_near(&self, node: NodeId, strength: Strength) -> bool {
        let times = if self.is_last(node) { self.nearness.times.saturating_sub(self.times_left) } else { 0 };
        let closer = i32::from(times) * i32::from(self.nearness.closer);
        strength.0 >= self.nearness.near.0.saturating_add(closer)
    }

    fn is_last(&self, node: NodeId) -> bool {
        self.last.is_some_and(|(last, _)| last == node)
    }

    /// It is at the node: the next is the node's parent, one hop nearer.
    fn reach(&mut self, nav: Nav) {
        if !self.is_last(nav.node) {
            self.times_left = self.nearness.times;
        }
        self.last = Some((nav.node, nav.hops));
        self.hops = nav.hops;
        self.tries_left = self.tries.saturating_sub(1);
        self.stage = if nav.hops == 0 { Stage::Arrived } else { Stage::Asking { node: nav.parent } };
    }

    fn ask_again(&mut self, node: NodeId) {
        if let Some(tries_left) = self.tries_left.checked_sub(1) {
            self.tries_left = tries_left;
            self.stage = Stage::Asking { node };
            return;
        }
        let last = self.last.filter(|&(last, _)| last != node);
        self.stage = match (last, self.times_left.checked_sub(1)) {
            (Some((last, hops)), Some(times_left)) => {
                self.times_left = times_left;
                self.tries_left = self.tries.saturating_sub(1);
                self.hops = hops.saturating_add(1);
                Stage::Asking { node: last }
            }
            (None, _) | (_, None) => Stage::Lost,
        };
    }
}

#[cfg(test)]
mod tests {
    use super::super::heading::tests::towards;
    use super::*;

    const WFR: NodeId = NodeId(0);

    /// Node `hops` of a line of nodes 20 m apart.
    const fn nav(hops: u16) -> Nav {
        let parent = NodeId(hops.saturating_sub(1) as u32);
        Nav { wfr: WFR, node: NodeId(hops as u32), hops, parent }
    }

    const fn start(hops: u16) -> Homing {
        Homing::new(WFR, RobotId(1), NodeId(hops as u32 - 1), hops, NEARNESS, 3)
    }

    const NEARNESS: Nearness = Nearness { near: Strength(-1_000), closer: 300, times: 2 };

    /// Minus the distance in millimetres, less one part in eight for each direction that the antenna is off.
    fn heard(antenna: Heading, (x_mm, y_mm): (i32, i32)) -> Strength {
        let off = Heading::all().filter(|heading| {
            let turned = |steps: u8| towards(x_mm, y_mm).turned(steps) == antenna;
            let steps = heading.degrees() / 15;
            steps <= 12 && (turned(steps as u8) || turned(24 - steps as u8))
        });
        let off = off.map(|heading| i32::from(heading.degrees() / 15)).min().unwrap_or(12);
        let distance =
            i32::try_from((i64::from(x_mm).pow(2) + i64::from(y_mm).pow(2)).isqrt()).unwrap_or(i32::MAX);
        Strength(-(distance + distance / 8 * off))
    }

    #[test]
    fn a_robot_reaches_the_wfr_node_after_node_with_a_hop_count_one_less_each_time() {
        let nodes: [(i32, i32); 5] =
            [(0, 0), (14_000, 14_000), (33_000, 9_000), (47_000, -4_000), (60_000, 11_000)];
        let (mut x, mut y) = (71_000, 26_000);
        let mut robot = start(5);
        let mut hops_seen = 5;
        for _ in 0..20_000 {
            match robot.order() {
                Order::Ask(request) => robot = robot.hear(nav(request.node.0 as u16)),
                Order::Point(antenna) | Order::Walk(antenna) => {
                    let (node, is_walk) = match robot.stage() {
                        Stage::Walking { nav, .. } => (nav.node, true),
                        Stage::Scanning { nav, .. } => (nav.node, false),
                        Stage::Asking { .. } | Stage::Arrived | Stage::Lost => unreachable!(),
                    };
                    if is_walk {
                        // A quarter of a metre.
                        let (cosine, sine) = antenna.vector();
                        (x, y) = (x + cosine / 4_000, y + sine / 4_000);
                    }
                    let (node_x, node_y) = nodes[node.0 as usize];
                    robot = robot.measure(Some(heard(antenna, (node_x - x, node_y - y))));
                }
                Order::Stop => break,
            }
            assert!(robot.hops() == hops_seen || robot.hops() + 1 == hops_seen, "one hop at a time");
            hops_seen = robot.hops();
        }
        assert_eq!((robot.stage(), robot.hops()), (Stage::Arrived, 0));
        assert!(x.abs() <= 1_000 && y.abs() <= 1_000, "({x}, {y})");
    }

    #[test]
    fn only_the_node_that_was_asked_is_heard_and_only_if_it_is_one_hop_nearer() {
        let robot = start(3);
        for stray in [
            nav(1),
            nav(3),
            Nav { wfr: NodeId(9), ..nav(2) },
            Nav { hops: 3, ..nav(2) },
            Nav { hops: u16::MAX, ..nav(2) },
        ] {
            assert_eq!(robot.hear(stray), robot, "{stray:?}");
        }
        assert_eq!(robot.hear(nav(2)).order(), Order::Point(Heading::FIRST));
    }

    #[test]
    fn a_node_that_does_not_answer_is_asked_again_and_then_the_robot_is_lost() {
        let mut robot = start(2);
        for _ in 0..3 {
            assert!(matches!(robot.order(), Order::Ask(_)));
            robot = robot.expire();
        }
        assert_eq!((robot.stage(), robot.order()), (Stage::Lost, Order::Stop));
    }

    #[test]
    fn a_robot_that_does_not_hear_the_next_node_goes_nearer_to_the_last_and_then_is_lost() {
        let silent = |robot: Homing| (0..3).fold(robot, |robot, _| robot.expire());
        let at = |robot: Homing, hops, strength| {
            (0..24).fold(robot.hear(nav(hops)), |robot, _| robot.measure(Some(Strength(strength))))
        };
        let asks = |robot: Homing| match robot.order() {
            Order::Ask(request) => Some(request.node.0),
            Order::Point(_) | Order::Walk(_) | Order::Stop => None,
        };
        let beside = at(start(3), 2, -900);
        assert_eq!((asks(beside), beside.hops()), (Some(1), 2));
        let back = silent(beside);
        assert_eq!((asks(back), back.hops()), (Some(2), 3));
        assert_eq!(at(back, 2, -701).order(), Order::Walk(Heading::FIRST), "not near enough any more");
        let nearer = at(back, 2, -700);
        assert_eq!((asks(nearer), nearer.hops()), (Some(1), 2));
        assert_eq!(silent(back).stage(), Stage::Lost, "neither answers");
        let nearest = at(silent(nearer), 2, -400);
        assert_eq!(asks(nearest), Some(1));
        assert_eq!(silent(nearest).stage(), Stage::Lost);
        let next = at(nearest, 1, -1_000);
        assert_eq!(asks(next), Some(0), "at another node it need not be nearer");
    }

    #[test]
    fn tries_and_times_are_counted_anew_at_each_node() {
        let at = |robot: Homing, hops, strength| {
            (0..24).fold(robot.hear(nav(hops)), |robot, _| robot.measure(Some(Strength(strength))))
        };
        let in_vain = |robot: Homing, times| (0..times).fold(robot, |robot, _| robot.expire());
        let asks = |robot: Homing| match robot.order() {
            Order::Ask(request) => Some(request.node.0),
            Order::Point(_) | Order::Walk(_) | Order::Stop => None,
        };
        let beside = at(in_vain(start(4), 2), 3, -900);
        assert_eq!(asks(in_vain(beside, 2)), Some(2), "the tries with the node before do not count");
        let back = in_vain(beside, 3);
        assert_eq!(
            [0, 1, 2].map(|times| asks(in_vain(back, times))),
            [Some(3); 3],
            "nor those that led back"
        );
        assert_eq!(in_vain(back, 3).stage(), Stage::Lost);
        let nearest = at(in_vain(at(back, 3, -700), 3), 3, -400);
        let next = at(nearest, 2, -1_000);
        let back = at(in_vain(next, 3), 2, -700);
        assert_eq!(asks(in_vain(back, 3)), Some(2), "twice nearer to the node before, and twice to this one");
        assert_eq!(in_vain(at(in_vain(back, 3), 2, -400), 3).stage(), Stage::Lost);
    }

    #[test]
    fn a_robot_whose_way_is_barred_scans_again() {
        let scanned = (0..24).fold(start(2).hear(nav(1)), |robot, _| robot.measure(Some(Strength(-9_000))));
        assert_eq!(scanned.bump().order(), Order::Point(Heading::FIRST));
        for robot in [start(2), start(2).hear(nav(1))] {
            assert_eq!(robot.bump(), robot);
        }
    }

    #[test]
    fn a_robot_that_walks_past_the_node_scans_again_and_one_that_hears_nothing_asks_again() {
        let scanned = (0..24).fold(start(2).hear(nav(1)), |robot, _| robot.measure(Some(Strength(-9_000))));
        assert_eq!(scanned.order(), Order::Walk(Heading::FIRST));
        let nearer = scanned.measure(Some(Strength(-8_000)));
        assert_eq!(nearer.order(), Order::Walk(Heading::FIRST));
        assert_eq!(nearer.measure(Some(Strength(-8_000))), nearer, "no weaker is not past the node");
        assert_eq!(nearer.measure(Some(Strength(-8_500))).order(), Order::Point(Heading::FIRST));
        assert!(matches!(nearer.measure(None).order(), Order::Ask(_)));
        let deaf = |robot: Homing| (0..24).fold(robot.hear(nav(1)), |robot, _| robot.measure(None));
        assert!(matches!(deaf(start(2)).order(), Order::Ask(_)));
        assert_eq!(deaf(deaf(deaf(start(2)))).stage(), Stage::Lost);
    }

    #[test]
    fn the_node_that_is_asked_signals_and_the_others_keep_silent_until_the_time_has_passed() {
        let request = ReqNav { wfr: WFR, robot: RobotId(1), node: NodeId(2) };
        let asked = Guide::Idle.request(request, NodeId(2), Some(nav(2)));
        assert_eq!(asked, Guide::Signals(nav(2)));
        assert_eq!(asked.overhear(), asked);
        for (id, own) in [(3, Some(nav(3))), (7, None), (2, None)] {
            let other = Guide::Idle.request(request, NodeId(id), own);
            assert_eq!(other, Guide::Silent, "{id}");
            assert_eq!(other.expire(), Guide::Idle);
        }
        let elsewhere = Nav { wfr: NodeId(9), ..nav(2) };
        let newer = asked.request(ReqNav { wfr: NodeId(9), ..request }, NodeId(2), Some(elsewhere));
        assert_eq!(newer, Guide::Signals(elsewhere), "the latest request counts");
        let others = ReqNav { node: NodeId(3), ..request };
        assert_eq!(asked.request(others, NodeId(2), Some(nav(2))), asked, "another's does not silence it");
        let silent = Guide::Idle.overhear();
        assert_eq!(silent.request(request, NodeId(2), Some(nav(2))), silent);
    }
}

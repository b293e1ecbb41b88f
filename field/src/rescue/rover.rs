//! A robot in the field: the kernel's machine, where it is, and its way.

use tautline_kernel::mrc::{Robot, Rule};
use tautline_kernel::net::{Call, NodeId, RobotId};

use super::{Fix, MAX_WFRS};
use crate::radio::Point;
use crate::tan::Walker;

/// A robot in the field.
pub(super) struct Rover {
    pub(super) machine: Robot<MAX_WFRS>,
    pub(super) has_failed: bool,
    pub(super) at: Point,
    /// The node at which it was last: its shadows are the robot's.
    pub(super) place: Option<NodeId>,
    pub(super) path: Vec<Fix>,
    pub(super) way: Option<Way>,
    /// Where it was when it was last at a WFR, and how far it has gone since on journeys that came to nothing.
    pub(super) since: Point,
    pub(super) moved_m: f64,
    /// Its latest bid, the largest for the call if there were several: the WFR's lease is by one of them.
    pub(super) bid: Option<(Call, u16)>,
    /// Timers of its leases so far.
    pub(super) leases: u32,
    /// Legs of its journeys so far.
    pub(super) legs: u32,
}

impl Rover {
    /// A robot that has heard nothing, at its place.
    pub(super) fn new(rule: Rule, id: RobotId, at: Point) -> Self {
        Self {
            machine: Robot::new(rule, id),
            has_failed: false,
            at,
            place: None,
            path: vec![Fix { at_ns: 0, at }],
            way: None,
            since: at,
            moved_m: 0.0,
            bid: None,
            leases: 0,
            legs: 0,
        }
    }

    /// It goes to a place, from now on until then. If it goes on straight, the place takes the place of the last.
    pub(super) fn go(&mut self, to: Point, now_ns: u64, then_ns: u64, onward: Onward) {
        self.at = to;
        match (onward, self.path.last_mut()) {
            (Onward::Straight, Some(last)) => *last = Fix { at_ns: then_ns, at: to },
            (Onward::Straight | Onward::Turned, last) => {
                let rest = last.map(|last| Fix { at_ns: now_ns, ..*last });
                self.path.extend(rest.filter(|rest| self.path.last() != Some(rest)));
                self.path.push(Fix { at_ns: then_ns, at: to });
            }
        }
    }
}

/// How a robot goes on.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Onward {
    Straight,
    Turned,
}

/// A robot on its way, or at its goal.
pub(super) struct Way {
    pub(super) call: Call,
    pub(super) wfr: usize,
    pub(super) walker: Walker,
    /// A leg begins whenever it begins to ask a node: what was due in another one no longer is.
    pub(super) leg: u32,
    /// The latest node that it has reached.
    pub(super) passed: Option<NodeId>,
    /// Whether it is at its goal.
    pub(super) has_come: bool,
}

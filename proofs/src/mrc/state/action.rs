//! The messages on their way between robots and WFRs, and the actions that can happen to them.

use tautline_kernel::mrc::{Resb, Upward};
use tautline_kernel::net::{Call, Notice, RobotId};

/// A message on its way.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum Message {
    /// A NOTICE, on its way to one of the robots.
    Notice(RobotId, Notice),
    /// A RESB, on its way to its robot.
    Resb(Resb),
    /// A robot's message, on its way to the WFR.
    Up(Upward),
}

impl Message {
    /// The robot that has sent it or is to get it.
    pub const fn robot(self) -> RobotId {
        match self {
            Self::Notice(robot, _) => robot,
            Self::Resb(resb) => resb.robot,
            Self::Up(upward) => upward.robot,
        }
    }

    /// The message with its call under another epoch.
    pub(super) fn renamed(mut self, rename: impl Fn(Call) -> Call) -> Self {
        let call = match &mut self {
            Self::Notice(_, notice) => &mut notice.call,
            Self::Resb(resb) => &mut resb.call,
            Self::Up(upward) => &mut upward.call,
        };
        *call = rename(*call);
        self
    }

    /// The call that it is about.
    pub const fn call(self) -> Call {
        match self {
            Self::Notice(_, notice) => notice.call,
            Self::Resb(resb) => resb.call,
            Self::Up(upward) => upward.call,
        }
    }
}

/// A robot or a WFR, by its place.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum Actor {
    /// A robot.
    Robot(usize),
    /// A WFR.
    Wfr(usize),
}

/// The next action.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum Action {
    /// Something happens at a WFR.
    Raise(usize),
    /// The message at this place arrives.
    Deliver(usize),
    /// A robot that has put off asking asks.
    Begin(usize),
    /// A timer goes off.
    Expire(Actor),
    /// A robot reaches the WFR to which it is on its way.
    Arrive(usize),
    /// A robot's lease lapses before it comes.
    Lapse(usize),
    /// The message at this place is lost.
    Lose(usize),
    /// The message at this place will arrive once more.
    Duplicate(usize),
    /// A robot fails.
    FailRobot(usize),
    /// A path node between a robot and a WFR fails.
    FailNode {
        /// The robot.
        robot: usize,
        /// The WFR.
        wfr: usize,
    },
}

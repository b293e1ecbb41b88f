//! The messages of MRC [Jiang 2011, 3.2 and 3.3]: NOTICE⟨RID, ID, HC⟩, MOVE⟨SN, MID, MHC, PID⟩ and RESB⟨RSN, MID⟩. To
//! each the repair adds the epoch, and to the robot's words that it accepts or declines.

use crate::net::{Call, NodeId, Notice, RobotId};

/// The data by which a WFR chooses.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Bid {
    /// MHC: hops from the robot to the WFR.
    pub hops: u16,
    /// MID: whose bid it is.
    pub robot: RobotId,
}

/// RESB⟨RSN, MID⟩, on its way to one of the robots that sent MOVE.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Resb {
    /// The call.
    pub call: Call,
    /// Who is told.
    pub robot: RobotId,
    /// MID: who is to come. Nobody, when a robot has come already: it may be the one that asks.
    pub chosen: Option<RobotId>,
}

/// A message to a robot.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Downward {
    /// A call for help.
    Notice(Notice),
    /// A WFR's choice.
    Resb(Resb),
}

/// A robot's answer to a WFR.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Word {
    /// MOVE: it could come.
    Move {
        /// MHC: hops from the robot to the WFR.
        hops: u16,
    },
    /// It was chosen, and comes.
    Accept,
    /// It was chosen, but does something else by now.
    Decline,
}

/// A robot's message to a WFR, from parent to parent.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Upward {
    /// The call that it answers.
    pub call: Call,
    /// MID: whose word it is.
    pub robot: RobotId,
    /// The robot's answer.
    pub word: Word,
    /// PID: the node that is to send it on, or the WFR itself.
    pub parent: NodeId,
}

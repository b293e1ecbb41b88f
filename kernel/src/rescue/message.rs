//! What MRC sends (paper 003, 3.2 and 3.3): NOTICE⟨RID, ID, HC⟩, MOVE⟨SN, MID, MHC, PID⟩ and RESB⟨RSN, MID⟩. To each the
//! repair adds the epoch, and to the robot's words that it accepts or declines.

use crate::broadcast::{self, NodeId};

/// The identity of a robot: MID.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub struct RobotId(pub u16);

/// The number of a WFR's call: from 1 on, each larger than the one before. A call under a new epoch is a new event to the
/// nodes, and spreads through the network anew.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub struct Epoch(pub u32);

impl Epoch {
    /// The epoch of a WFR's first call.
    pub const FIRST: Self = Self(1);

    /// The epoch after this one. The last is its own successor, which is four thousand million calls away.
    pub const fn next(self) -> Self {
        Self(self.0.saturating_add(1))
    }
}

/// One call for help.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub struct Call {
    /// SN: who calls.
    pub wfr: NodeId,
    /// Which of its calls.
    pub epoch: Epoch,
}

/// What a WFR chooses by.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub struct Bid {
    /// MHC: hops from the robot to the WFR.
    pub hops: u16,
    /// MID: whose bid it is.
    pub robot: RobotId,
}

/// NOTICE⟨RID, ID, HC⟩, as a robot hears it.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub struct Notice {
    /// The call.
    pub call: Call,
    /// HC: hops from the sender to the WFR.
    pub hops: u16,
    /// ID: who sent it on.
    pub sender: NodeId,
}

impl From<broadcast::Notice> for Notice {
    fn from(notice: broadcast::Notice) -> Self {
        let broadcast::Notice { source, event, sender, hops } = notice;
        Self { call: Call { wfr: source, epoch: Epoch(event) }, hops, sender }
    }
}

/// RESB⟨RSN, MID⟩, on its way to one of the robots that sent MOVE.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub struct Resb {
    /// The call.
    pub call: Call,
    /// Who is told.
    pub robot: RobotId,
    /// MID: who is to come. Nobody, when a robot has come already: it may be the one that asks.
    pub chosen: Option<RobotId>,
}

/// What a robot gets.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum Downward {
    /// A call for help.
    Notice(Notice),
    /// A WFR's choice.
    Resb(Resb),
}

/// What a robot has to say to a WFR.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
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

/// What a robot sends to a WFR, from parent to parent.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub struct Upward {
    /// The call that it answers.
    pub call: Call,
    /// MID: whose word it is.
    pub robot: RobotId,
    /// What it says.
    pub word: Word,
    /// PID: the node that is to send it on, or the WFR itself.
    pub parent: NodeId,
}

//! The network that nodes and robots share: who they are, the call that spreads through it, a message as it is heard,
//! and how strong it is heard.

mod propagation;
pub(crate) mod sets;

pub use propagation::Propagation;

/// The identity of a node: its number in the network.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Default)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct NodeId(pub u32);

/// The identity of a robot: MID.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct RobotId(pub u16);

/// The number of a WFR's call: from 1 on, each larger than the one before. A call under a new epoch is a new event to
/// the nodes, and spreads through the network anew.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
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
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Call {
    /// SN: who calls.
    pub wfr: NodeId,
    /// Which of its calls.
    pub epoch: Epoch,
}

/// NOTICE⟨RID, ID, HC⟩ [Jiang 2011, 3.2], with the number of the call, which the paper leaves out.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Notice {
    /// RID: the node that waits for rescue; and which of its calls.
    pub call: Call,
    /// HC: hops from the sender to the WFR.
    pub hops: u16,
    /// ID: who sends it.
    pub sender: NodeId,
}

/// A message as it is heard.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Reception<M> {
    /// The message.
    pub message: M,
    /// D: how far off the sender seems to be, by the strength of its signal, in micrometres.
    pub distance_um: u32,
    /// When, in nanoseconds.
    pub now_ns: u64,
}

/// How strong a signal is: a larger number is a stronger signal.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Strength(pub i32);

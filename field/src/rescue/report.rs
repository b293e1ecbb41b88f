//! The outcome of a rescue.

use super::{LogEntry, Violation};
use crate::radio::{Air, Field, Point};

/// The spread of the first call for an event through the network.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Spread {
    /// Nodes that know of it, the WFR included.
    pub reached: u32,
    /// Nodes that live when the call goes out and that links connect with the WFR, over such nodes; itself included.
    pub component: u32,
    /// Nodes that forwarded it, the WFR not included.
    pub rebroadcasts: u32,
}

/// The fate of an event at a WFR.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Fate {
    /// Robots came: how many, the first included.
    Served {
        /// Which came first.
        by: usize,
        /// How many came.
        visits: u32,
    },
    /// No robot that lives is connected with it by links, over nodes that live.
    CutOff,
    /// Some are, but none has heard of any of its calls for this event: the broadcast has not reached them.
    Unheard,
    /// One that lives and is connected has heard of it, and none ever came.
    Abandoned,
    /// It has not happened: nobody has served the one before.
    StillToCome,
}

/// How a robot came to a WFR that waited.
#[derive(Clone, PartialEq, Debug)]
pub struct Journey {
    /// Who came.
    pub robot: usize,
    /// To whom.
    pub wfr: usize,
    /// For which of its events.
    pub event: usize,
    /// When, in nanoseconds.
    pub at_ns: u64,
    /// How long that was after the first call for the event, in nanoseconds.
    pub waited_ns: u64,
    /// All that the robot went since it was last at a WFR, or since the beginning, in metres.
    pub moved_m: f64,
    /// The shortest way from where it was then round the obstacles, in metres; none if there is no way.
    pub shortest_m: Option<f64>,
}

/// Where a robot was.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Fix {
    /// When, in nanoseconds.
    pub at_ns: u64,
    /// The place.
    pub at: Point,
}

/// Packets sent, by their use; one that goes several hops counts at each.
#[derive(Clone, Copy, PartialEq, Eq, Default, Debug)]
pub struct Packets {
    /// NOTICE.
    pub notices: u32,
    /// MOVE, RESB, the answers to them, and receipts of these: MRC's control packets.
    pub control: u32,
    /// Requests and signals of TAN.
    pub guiding: u32,
}

/// The outcome of a rescue.
#[derive(Clone, PartialEq, Debug)]
pub struct Report {
    /// WFR by WFR, for each event that has happened.
    pub spreads: Vec<Spread>,
    /// WFR by WFR, event by event.
    pub fates: Vec<Fate>,
    /// The first for each event that was served, in the order of their arrival.
    pub journeys: Vec<Journey>,
    /// The clauses that were broken, each where it first was.
    pub violations: Vec<Violation>,
    /// The events, in order.
    pub log: Vec<LogEntry>,
    /// Where each robot was, robot by robot: between two of these it went straight.
    pub paths: Vec<Vec<Fix>>,
    /// The field.
    pub field: Field,
    /// The places of the WFRs.
    pub wfrs: Vec<Point>,
    /// The traffic on the air.
    pub air: Air,
    /// The packets of it by their use.
    pub packets: Packets,
}

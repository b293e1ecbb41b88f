//! The events of a rescue, as they are told and stored.

use std::fmt;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::radio::Point;

/// A place, in whole millimetres eastwards and southwards.
pub type Millimetres = [u32; 2];

/// To the nearest millimetre.
pub(super) fn millimetres(at: Point) -> Millimetres {
    [at.x_m, at.y_m].map(|metres| (metres * 1e3 + 0.5) as u32)
}

/// The number of a robot, a WFR, or an event at one: counted from 0 here, and from 1 wherever people read it, in text
/// and in JSON.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug, JsonSchema, Serialize, Deserialize)]
#[serde(try_from = "usize", into = "usize")]
pub struct Ordinal(pub usize);

impl From<Ordinal> for usize {
    fn from(Ordinal(place): Ordinal) -> Self {
        place + 1
    }
}

impl TryFrom<usize> for Ordinal {
    type Error = &'static str;

    fn try_from(number: usize) -> Result<Self, Self::Error> {
        number.checked_sub(1).map(Self).ok_or("robots, WFRs and events are counted from 1")
    }
}

impl fmt::Display for Ordinal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", usize::from(*self))
    }
}

/// Something that happens. Nodes are numbered from 0, as in the field.
#[derive(Clone, Copy, PartialEq, Eq, Debug, JsonSchema, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
#[expect(missing_docs, reason = "the fields are the numbers of who takes part")]
pub enum Event {
    /// Something happens at a WFR for the second time, or for a later one.
    Recurs { wfr: Ordinal, event: Ordinal },
    /// A WFR calls.
    Calls { wfr: Ordinal, node: u32, epoch: u32 },
    /// A robot hears of a call, so many hops from the WFR.
    Hears { robot: Ordinal, wfr: Ordinal, epoch: u32, hops: u16 },
    /// A robot sends MOVE.
    Asks { robot: Ordinal, wfr: Ordinal, epoch: u32, hops: u16 },
    /// A WFR sends RESB.
    Chooses { wfr: Ordinal, epoch: u32, robot: Ordinal },
    /// A WFR has done with choosing: it waits for this robot.
    CountsOn { wfr: Ordinal, epoch: u32, robot: Ordinal },
    /// A robot declines.
    Declines { robot: Ordinal, wfr: Ordinal, epoch: u32 },
    /// A robot takes the lease of a call and sets out.
    SetsOut { robot: Ordinal, wfr: Ordinal, epoch: u32, at: Millimetres },
    /// A robot is at a path node.
    Passes { robot: Ordinal, node: u32, at: Millimetres },
    /// A robot gets no signal any more.
    LosesItsWay { robot: Ordinal, at: Millimetres },
    /// A robot gives up a lease, since it has lapsed or the WFR calls anew.
    LetsGo { robot: Ordinal, wfr: Ordinal, epoch: u32, at: Millimetres },
    /// A robot reaches a WFR.
    Arrives { robot: Ordinal, wfr: Ordinal, at: Millimetres },
    /// A robot fails.
    RobotFails { robot: Ordinal, at: Millimetres },
    /// A node fails.
    NodeFails { node: u32 },
}

/// A place in metres.
struct Metres(Millimetres);

impl fmt::Display for Metres {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self([x, y]) = self;
        let tenth = |millimetres: u32| (millimetres + 50) / 100;
        let (x, y) = (tenth(*x), tenth(*y));
        write!(f, "{}.{}, {}.{} m", x / 10, x % 10, y / 10, y % 10)
    }
}

impl fmt::Display for Event {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Recurs { wfr, event } => write!(f, "event {event} happens at WFR {wfr}"),
            Self::Calls { wfr, node, epoch } => write!(f, "WFR {wfr}, node {node}, calls, epoch {epoch}"),
            Self::Hears { robot, wfr, epoch, hops } => {
                write!(f, "robot {robot} hears of WFR {wfr}, epoch {epoch}: hops {hops}")
            }
            Self::Asks { robot, wfr, epoch, hops } => {
                write!(f, "robot {robot} asks WFR {wfr}, epoch {epoch}: hops {hops}")
            }
            Self::Chooses { wfr, epoch, robot } => {
                write!(f, "WFR {wfr} chooses robot {robot}, epoch {epoch}")
            }
            Self::CountsOn { wfr, epoch, robot } => {
                write!(f, "WFR {wfr} counts on robot {robot}, epoch {epoch}")
            }
            Self::Declines { robot, wfr, epoch } => {
                write!(f, "robot {robot} declines WFR {wfr}, epoch {epoch}")
            }
            Self::SetsOut { robot, wfr, epoch, at } => {
                write!(f, "robot {robot} sets out for WFR {wfr}, epoch {epoch}, from {}", Metres(at))
            }
            Self::Passes { robot, node, at } => write!(f, "robot {robot} is at node {node}, {}", Metres(at)),
            Self::LosesItsWay { robot, at } => {
                write!(f, "robot {robot} gets no signal any more at {}", Metres(at))
            }
            Self::LetsGo { robot, wfr, epoch, at } => {
                write!(f, "robot {robot} gives up the lease of WFR {wfr}, epoch {epoch}, at {}", Metres(at))
            }
            Self::Arrives { robot, wfr, at } => {
                write!(f, "robot {robot} reaches WFR {wfr} at {}", Metres(at))
            }
            Self::RobotFails { robot, at } => write!(f, "robot {robot} fails at {}", Metres(at)),
            Self::NodeFails { node } => write!(f, "node {node} fails"),
        }
    }
}

/// When something happened.
#[derive(Clone, Copy, PartialEq, Eq, Debug, JsonSchema, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LogEntry {
    /// In nanoseconds.
    pub at_ns: u64,
    /// The event.
    #[serde(flatten)]
    pub event: Event,
}

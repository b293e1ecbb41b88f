//! What happens in a rescue, as it is told and stored.

use serde::{Deserialize, Serialize};

use crate::radio::Point;

/// A place, in whole millimetres eastwards and southwards.
pub type Millimetres = [u32; 2];

/// To the nearest millimetre.
pub(super) fn millimetres(at: Point) -> Millimetres {
    [at.x_m, at.y_m].map(|metres| (metres * 1e3 + 0.5) as u32)
}

/// Something that happens. Robots and WFRs are numbered from 0, nodes as in the field.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
#[expect(missing_docs, reason = "the fields are the numbers of who takes part")]
pub enum Event {
    /// A WFR calls.
    Calls { wfr: usize, node: u32, epoch: u32 },
    /// A robot hears of a call, so many hops from the WFR.
    Hears { robot: usize, wfr: usize, epoch: u32, hops: u16 },
    /// A robot sends MOVE.
    Asks { robot: usize, wfr: usize, epoch: u32, hops: u16 },
    /// A WFR sends RESB.
    Chooses { wfr: usize, epoch: u32, robot: usize },
    /// A WFR has done with choosing: it waits for this robot.
    CountsOn { wfr: usize, epoch: u32, robot: usize },
    /// A robot declines.
    Declines { robot: usize, wfr: usize, epoch: u32 },
    /// A robot takes the lease of a call and sets out.
    SetsOut { robot: usize, wfr: usize, epoch: u32, at: Millimetres },
    /// A robot is at a path node.
    Passes { robot: usize, node: u32, at: Millimetres },
    /// A robot gets no signal any more.
    LosesItsWay { robot: usize, at: Millimetres },
    /// A robot gives up a lease, since it has lapsed or the WFR calls anew.
    LetsGo { robot: usize, wfr: usize, epoch: u32, at: Millimetres },
    /// A robot reaches a WFR.
    Arrives { robot: usize, wfr: usize, at: Millimetres },
    /// A robot fails.
    RobotFails { robot: usize, at: Millimetres },
    /// A node fails.
    NodeFails { node: u32 },
}

/// When something happened.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Logged {
    /// In nanoseconds.
    pub at_ns: u64,
    /// What.
    #[serde(flatten)]
    pub event: Event,
}

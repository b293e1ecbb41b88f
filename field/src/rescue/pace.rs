//! How TAN goes over the air [Jiang 2011, 3.4], and how long its steps take. A robot asks its guide for the signal anew
//! about once a second, as the paper has it “continuously request” it, and the signal lasts T_x from the last request:
//! so neither a lost REQNAV nor a lost NAV ends a journey, and a robot that fails does not keep the nodes silent. T_x
//! is long enough for three requests to be lost, and short, since the next node on the way is silent for as long after
//! it has overheard its child's signal.

use tautline_kernel::tan::Heading;

use crate::tan::{Equipment, Gait};

/// T_x, in nanoseconds: a node signals, or keeps silent, for so long.
pub(super) const SIGNAL_NS: u64 = 4_000_000_000;

/// A robot asks again after half of this to one and a half times this, in nanoseconds.
pub(super) const ASK_NS: u64 = 1_000_000_000;

/// After so long without the signal of a node, in nanoseconds, a robot has asked it once in vain: twice T_x, so that a
/// node that was silent for another robot's sake can answer.
pub(super) const TRY_NS: u64 = 2 * SIGNAL_NS;

/// A robot takes at most so long from one path node to the next, in nanoseconds: it asks in vain once, and goes twice
/// as far as any signal reaches at its speed, which leaves room for scans and detours. Where strengths are off it may
/// take the node to be behind it after each step, and scan again.
pub(super) fn leg_ns(equipment: &Equipment, reach_m: f64, noise_db: f64) -> u64 {
    let Gait { speed_mm_s, turn_ns, measure_ns, step_mm, .. } = equipment.gait;
    let walk_ns = 2.0 * reach_m / (f64::from(speed_mm_s.max(1)) / 1e3) * 1e9;
    let steps = if noise_db > 0.0 { reach_m * 1e3 / f64::from(step_mm.max(1)) } else { 0.0 };
    let scan_ns = u64::from(Heading::COUNT) * (turn_ns + measure_ns);
    TRY_NS + SIGNAL_NS + walk_ns as u64 + steps as u64 * scan_ns
}

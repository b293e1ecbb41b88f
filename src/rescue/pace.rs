//! How TAN goes over the air (paper 003, 3.4), and how long its steps take. A robot asks its guide for the signal anew about
//! once a second, as the paper has it “continuously request” it, and the signal lasts T_x from the last request: so
//! neither a lost REQNAV nor a lost NAV ends a journey, and a robot that fails does not keep the nodes silent. T_x is
//! long enough for three requests to be lost, and short, since the next node on the way is silent for as long after it
//! has overheard its child's signal.

use crate::homing::Equipment;

/// T_x, in nanoseconds: a node signals, or keeps silent, for so long.
pub(super) const SIGNAL_NS: u64 = 4_000_000_000;

/// A robot asks again after half of this to one and a half times this, in nanoseconds.
pub(super) const ASK_NS: u64 = 1_000_000_000;

/// After so long without the signal of a node, in nanoseconds, a robot has asked it once in vain: twice T_x, so that a node
/// that was silent for another robot's sake can answer.
pub(super) const TRY_NS: u64 = 2 * SIGNAL_NS;

/// A robot takes at most so long from one path node to the next, in nanoseconds: it asks in vain once, and goes twice the
/// range at its speed, which leaves room for scans and detours.
pub(super) fn leg_ns(equipment: &Equipment, range_m: f64) -> u64 {
    let speed_m_s = f64::from(equipment.gait.speed_mm_s.max(1)) / 1e3;
    TRY_NS + SIGNAL_NS + (2.0 * range_m / speed_m_s * 1e9) as u64
}

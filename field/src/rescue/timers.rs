//! How long the timers run that MRC leaves to the network. Each is longer than what it waits for, as the clauses
//! assume: the bounds follow from the longest wait B of a broadcast, what a message takes for a hop, how many hops
//! there are, and how long a robot goes from one path node to the next.
//!
//! A WFR has been told at deployment how deep the network is as seen from it, so that robots and nodes know it from its
//! calls: D hops to the farthest node. A broadcast makes detours, and the robot is one hop more: H = 2·D + 2 hops are
//! enough unless nodes have failed. If they are not, nobody is heard in the window; so each window is twice as long as
//! the one before, up to eight times the first. That spares the air, too, where nobody can come.

use tautline_kernel::mrc::WfrTimer;
use tautline_kernel::net::Epoch;

use super::acks::{ANSWER_WAIT_NS, TRIES};
use crate::radio::LONGEST_WAIT_NS;

/// A message takes at most so long for a hop: a letter and all its repetitions. Over the shared channel nothing bounds
/// how long others send, but hardly ever does it take longer.
const HOP_NS: u64 = TRIES as u64 * ANSWER_WAIT_NS;

/// Windows are doubled at most so often.
const MOST_DOUBLINGS: u32 = 3;

/// The timers of the calls of one WFR, in nanoseconds.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[expect(clippy::struct_field_names, reason = "units are last in names")]
pub(super) struct Timers {
    /// A message of a robot, or one to it, takes at most so long.
    way_ns: u64,
    /// The window of the first call: a NOTICE takes at most so long to the robots, and a MOVE back.
    first_window_ns: u64,
    /// A robot takes at most so long for each hop of its way.
    leg_ns: u64,
}

impl Timers {
    /// Those of a WFR from which no node is farther than `depth` hops, where a robot takes at most `leg_ns` for a hop.
    pub(super) fn new(depth: u16, leg_ns: u64) -> Self {
        let hops = 2 * u64::from(depth) + 2;
        let way_ns = hops * HOP_NS;
        let notice_ns = hops * (u64::from(LONGEST_WAIT_NS) + HOP_NS);
        Self { way_ns, first_window_ns: notice_ns + way_ns, leg_ns }
    }

    /// The window of a call.
    fn window_ns(self, epoch: Epoch) -> u64 {
        self.first_window_ns << (epoch.0.saturating_sub(Epoch::FIRST.0)).min(MOST_DOUBLINGS)
    }

    /// A robot's wait for RESB: the way of its MOVE, the whole window, and the way back.
    pub(super) fn resb_ns(self, epoch: Epoch) -> u64 {
        self.window_ns(epoch) + 2 * self.way_ns + HOP_NS
    }

    /// A WFR's wait for the robot's answer: the way of the RESB, and the way back.
    pub(super) const fn answer_ns(self) -> u64 {
        2 * self.way_ns + HOP_NS
    }

    /// A lease of a robot that is so many hops off.
    fn lease_ns(self, hops: u16) -> u64 {
        (u64::from(hops) + 1) * self.leg_ns
    }

    /// The robot's lease, as [`Self::lease_ns`], from its last answer on: longer than the WFR's by the way of the
    /// answer, so that the WFR no longer counts on it when it is free.
    pub(super) fn robot_lease_ns(self, hops: u16) -> u64 {
        self.lease_ns(hops) + self.way_ns + HOP_NS
    }

    /// A WFR's timer, if the robot of its choice is so many hops off.
    pub(super) fn wfr_ns(self, timer: WfrTimer, hops: u16) -> u64 {
        match timer {
            WfrTimer::Window(epoch) => self.window_ns(epoch),
            WfrTimer::Answer { .. } => self.answer_ns(),
            WfrTimer::Lease(_) => self.lease_ns(hops),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn timers_are_longer_than_what_they_wait_for() {
        for depth in [0, 1, 7, 40, u16::MAX] {
            let timers = Timers::new(depth, 60_000_000_000);
            let notice_ns =
                u64::from(depth + u16::from(depth < u16::MAX)) * (u64::from(LONGEST_WAIT_NS) + HOP_NS);
            for epoch in [1, 2, 6, 7, u32::MAX].map(Epoch) {
                assert!(timers.window_ns(epoch) > notice_ns + timers.way_ns / 2);
                assert!(timers.resb_ns(epoch) > timers.window_ns(epoch) + 2 * timers.way_ns);
            }
            assert!(timers.answer_ns() > 2 * timers.way_ns);
            assert!(timers.robot_lease_ns(3) > timers.lease_ns(3) + timers.way_ns);
        }
    }

    #[test]
    fn windows_are_doubled_three_times() {
        let timers = Timers::new(3, 1);
        assert_eq!((timers.way_ns, timers.first_window_ns), (800_000_000, 2_400_000_000));
        let windows = [1, 2, 3, 4, 5, 1_000].map(|epoch| timers.window_ns(Epoch(epoch)) / 2_400_000_000);
        assert_eq!(windows, [1, 2, 4, 8, 8, 8]);
    }
}

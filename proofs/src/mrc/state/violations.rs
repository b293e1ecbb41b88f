//! Which demands a state breaks.

use tautline_kernel::mrc::{Phase, Task};
use tautline_kernel::net::RobotId;

use super::State;
use super::demand::Demand;
use super::setting::{ROBOTS, Setting, WFRS};

impl State {
    /// Whether this state breaks `demand`.
    pub fn breaks(&self, demand: Demand) -> bool {
        self.broken() & 1 << demand as u16 != 0
    }

    /// The demands that this state breaks, a bit for each; whether a WFR is served in the end no single state tells.
    pub(in crate::mrc) fn broken(&self) -> u16 {
        let leases = |robot: usize| match self.robots[robot].task() {
            Task::Leased { call } if !self.failed[robot] => Some(call),
            Task::Free | Task::Asking { .. } | Task::Leased { .. } => None,
        };
        let counts_on = |wfr: usize| match self.wfrs[wfr].phase() {
            Phase::Leased { choice } => Some(choice.robot),
            Phase::Idle | Phase::Collecting { .. } | Phase::Offered { .. } | Phase::Rescued { .. } => None,
        };
        let is_leased_again = |robot: usize| {
            leases(robot).is_some_and(|call| (0..robot).any(|other| leases(other) == Some(call)))
        };
        let is_counted_on_again = |wfr: usize| {
            counts_on(wfr).is_some_and(|robot| (0..wfr).any(|other| counts_on(other) == Some(robot)))
        };
        let has_not_the_best = |wfr: usize| match self.wfrs[wfr].phase() {
            Phase::Offered { choice, .. } | Phase::Leased { choice } => {
                self.notes.best[wfr].is_none_or(|best| best.robot != choice.robot)
            }
            Phase::Idle | Phase::Collecting { .. } | Phase::Rescued { .. } => false,
        };
        let lacks_consent = |wfr: usize| {
            let taken = |robot: RobotId| self.notes.taken[usize::from(robot.0)][wfr];
            counts_on(wfr).is_some_and(|robot| taken(robot) != Some(self.wfrs[wfr].call().epoch))
        };
        let seen = [
            (Demand::OneRobotForACall, (1..ROBOTS).any(is_leased_again)),
            (Demand::OneCallForARobot, (1..WFRS).any(is_counted_on_again)),
            (Demand::BestOfTheWindow, (0..WFRS).any(has_not_the_best)),
            (Demand::CountsOnConsent, (0..WFRS).any(lacks_consent)),
        ];
        let add = |all, (demand, is_broken)| all | u16::from(is_broken) << demand as u16;
        seen.into_iter().fold(self.notes.broken, add)
    }

    /// Whether a WFR waits while a robot lives.
    pub fn is_owed_service(&self, setting: &Setting, wfr: usize) -> bool {
        self.wfrs[wfr].is_waiting() && self.failed[..setting.robots].iter().any(|failed| !failed)
    }
}

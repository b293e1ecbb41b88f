//! Which demands a state breaks.

use tautline_kernel::mrc::{Phase, Task};
use tautline_kernel::net::RobotId;

use super::State;
use super::demand::Demand;
use super::setting::{ROBOTS, Setting, WFRS};

impl State {
    /// Whether this state breaks `demand`; whether a WFR is served in the end no single state tells.
    pub fn breaks(&self, demand: Demand) -> bool {
        let leases = |robot: usize| match self.robots[robot].task() {
            Task::Leased { call } if !self.failed[robot] => Some(call),
            Task::Free | Task::Asking { .. } | Task::Leased { .. } => None,
        };
        let counts_on = |wfr: usize| match self.wfrs[wfr].phase() {
            Phase::Leased { choice } => Some(usize::from(choice.robot.0)),
            Phase::Idle | Phase::Collecting { .. } | Phase::Offered { .. } | Phase::Rescued { .. } => None,
        };
        match demand {
            Demand::OneRobotForACall => (1..ROBOTS).any(|robot| {
                leases(robot).is_some_and(|call| (0..robot).any(|other| leases(other) == Some(call)))
            }),
            Demand::OneCallForARobot => (1..WFRS).any(|wfr| {
                counts_on(wfr).is_some_and(|robot| {
                    !self.failed[robot] && (0..wfr).any(|other| counts_on(other) == Some(robot))
                })
            }),
            Demand::BestOfTheWindow => (0..WFRS).any(|wfr| match self.wfrs[wfr].phase() {
                Phase::Offered { choice, .. } | Phase::Leased { choice } => {
                    self.notes.best[wfr].is_none_or(|best| best.robot != choice.robot)
                }
                Phase::Idle | Phase::Collecting { .. } | Phase::Rescued { .. } => false,
            }),
            Demand::CountsOnConsent => (0..WFRS).any(|wfr| {
                let taken = |robot: RobotId| self.notes.taken[usize::from(robot.0)][wfr];
                match self.wfrs[wfr].phase() {
                    Phase::Leased { choice } => taken(choice.robot) != Some(self.wfrs[wfr].call().epoch),
                    Phase::Idle
                    | Phase::Collecting { .. }
                    | Phase::Offered { .. }
                    | Phase::Rescued { .. } => false,
                }
            }),
            Demand::AsksAnew | Demand::AsksNearest | Demand::TakesWhatItAsksFor | Demand::TellsWhoAsked => {
                self.notes.broken & 1 << demand as u16 != 0
            }
            Demand::IsServed => false,
        }
    }

    /// Whether a WFR waits while a robot lives.
    pub fn is_owed_service(&self, setting: &Setting, wfr: usize) -> bool {
        self.wfrs[wfr].is_waiting() && self.failed[..setting.robots].iter().any(|failed| !failed)
    }
}

//! What the clauses MRC-1 to MRC-6 demand, looked at after every turn of a run. Each clause is told once.

use tautline_kernel::rescue::{Bid, Call, Epoch, Phase, Robot, RobotId, Served, Task, Wfr};
use tautline_proofs::rescue::Demand;

use super::{MAX_ROBOTS, MAX_WFRS};

/// A clause that was broken.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Violation {
    /// What was demanded.
    pub demand: Demand,
    /// When it was not so, in nanoseconds.
    pub at_ns: u64,
    /// Of which WFR.
    pub wfr: usize,
    /// During which of its events.
    pub event: usize,
}

/// What is noted down beside the machines' own states.
pub(super) struct Judge {
    /// The latest event of each WFR.
    event: Vec<usize>,
    /// The best MOVE of each WFR's latest call that arrived while its window was open.
    best: Vec<Option<Bid>>,
    is_open: Vec<bool>,
    /// The latest epoch of each WFR whose lease each robot has taken, robot by robot.
    taken: Vec<Vec<Option<Epoch>>>,
    pub(super) violations: Vec<Violation>,
}

/// A robot as the judge sees it.
pub(super) struct Seen<'a> {
    pub(super) machine: &'a Robot<MAX_WFRS>,
    pub(super) has_failed: bool,
}

impl Seen<'_> {
    /// The call of which the robot, if it lives, has the lease.
    const fn lease(&self) -> Option<Call> {
        match self.machine.task() {
            Task::Leased { call } if !self.has_failed => Some(call),
            Task::Free | Task::Asking { .. } | Task::Leased { .. } => None,
        }
    }
}

impl Judge {
    pub(super) fn new(robots: usize, wfrs: usize) -> Self {
        Self {
            event: vec![0; wfrs],
            best: vec![None; wfrs],
            is_open: vec![false; wfrs],
            taken: vec![vec![None; wfrs]; robots],
            violations: Vec::new(),
        }
    }

    /// `demand` is not met.
    pub(super) fn tell(&mut self, demand: Demand, wfr: usize, at_ns: u64) {
        if !self.violations.iter().any(|known| known.demand == demand) {
            self.violations.push(Violation { demand, at_ns, wfr, event: self.event[wfr] });
        }
    }

    /// An event happens at a WFR.
    pub(super) fn happens(&mut self, wfr: usize, event: usize) {
        self.event[wfr] = event;
    }

    /// A WFR calls.
    pub(super) fn calls(&mut self, wfr: usize) {
        (self.best[wfr], self.is_open[wfr]) = (None, true);
    }

    /// A MOVE of the present call arrives.
    pub(super) fn bids(&mut self, wfr: usize, bid: Bid) {
        if self.is_open[wfr] {
            // The least (MHC, MID), said here anew: the judge does not ask the kernel which bid is the better.
            let bids = self.best[wfr].into_iter().chain([bid]);
            self.best[wfr] = bids.min_by_key(|&Bid { hops, robot: RobotId(id) }| (hops, id));
        }
    }

    /// The window of a WFR closes.
    pub(super) fn closes(&mut self, wfr: usize) {
        self.is_open[wfr] = false;
    }

    /// A robot has heard a call that is new to it.
    pub(super) fn hears(&mut self, wfr: usize, served: Served, at_ns: u64) {
        match served {
            Served::No => {}
            Served::Yes => self.tell(Demand::AsksAnew, wfr, at_ns),
        }
    }

    /// A robot takes a lease.
    pub(super) fn takes(&mut self, robot: usize, wfr: usize, epoch: Epoch) {
        self.taken[robot][wfr] = Some(epoch);
    }

    /// Looks at all robots and WFRs.
    pub(super) fn look(&mut self, robots: &[Seen<'_>], wfrs: &[Wfr<MAX_ROBOTS>], at_ns: u64) {
        let place = |call: Call| wfrs.iter().position(|wfr| wfr.call().wfr == call.wfr);
        for (robot, seen) in robots.iter().enumerate() {
            let Some(call) = seen.lease() else { continue };
            if robots[..robot].iter().any(|other| other.lease() == Some(call))
                && let Some(wfr) = place(call)
            {
                self.tell(Demand::OneRobotForACall, wfr, at_ns);
            }
        }
        let counts_on = |wfr: &Wfr<MAX_ROBOTS>| match wfr.phase() {
            Phase::Leased { choice } => Some(choice.robot),
            Phase::Idle | Phase::Collecting { .. } | Phase::Offered { .. } | Phase::Rescued { .. } => None,
        };
        let lives = |robot: RobotId| robots.get(usize::from(robot.0)).is_some_and(|seen| !seen.has_failed);
        for (wfr, machine) in wfrs.iter().enumerate() {
            if let Some(robot) = counts_on(machine).filter(|&robot| lives(robot))
                && wfrs[..wfr].iter().any(|other| counts_on(other) == Some(robot))
            {
                self.tell(Demand::OneCallForARobot, wfr, at_ns);
            }
            let taken = |robot: RobotId| self.taken[usize::from(robot.0)][wfr];
            let (has_best, has_consent) = match machine.phase() {
                Phase::Offered { choice, .. } => (self.is_best(wfr, choice), true),
                Phase::Leased { choice } => {
                    (self.is_best(wfr, choice), taken(choice.robot) == Some(machine.call().epoch))
                }
                Phase::Rescued { by } => (true, taken(by).is_some()),
                Phase::Idle | Phase::Collecting { .. } => (true, true),
            };
            if !has_best {
                self.tell(Demand::BestOfTheWindow, wfr, at_ns);
            }
            if !has_consent {
                self.tell(Demand::CountsOnConsent, wfr, at_ns);
            }
        }
    }

    fn is_best(&self, wfr: usize, choice: Bid) -> bool {
        self.best[wfr].is_some_and(|best| best.robot == choice.robot)
    }
}

#[cfg(test)]
mod tests {
    use tautline_kernel::broadcast::NodeId;
    use tautline_kernel::rescue::{Rule, Upward, WfrTimer, Word};

    use super::*;

    const ROBOT: RobotId = RobotId(0);

    /// A WFR that counts on the robot: it has asked, was chosen, and has accepted.
    fn leased(id: u32) -> Wfr<MAX_ROBOTS> {
        let (wfr, _) = Wfr::new(Rule::REPAIRED, NodeId(id)).raise();
        let call = wfr.call();
        let word = |word| Upward { call, robot: ROBOT, word, parent: call.wfr };
        let (wfr, _) = wfr.receive(word(Word::Move { hops: 1 }));
        let (wfr, _) = wfr.expire(WfrTimer::Window(call.epoch));
        wfr.receive(word(Word::Accept)).0
    }

    /// What is told of two WFRs that count on the same robot.
    fn told(has_failed: bool) -> Vec<Violation> {
        let mut judge = Judge::new(1, 2);
        let (wfrs, machine) = ([leased(4), leased(7)], Robot::new(Rule::REPAIRED, ROBOT));
        for (number, wfr) in wfrs.iter().enumerate() {
            judge.calls(number);
            judge.bids(number, Bid { hops: 1, robot: ROBOT });
            judge.closes(number);
            judge.takes(0, number, wfr.call().epoch);
        }
        judge.look(&[Seen { machine: &machine, has_failed }], &wfrs, 5);
        judge.violations
    }

    #[test]
    fn two_that_count_on_one_robot_are_told_while_it_lives() {
        assert_eq!(told(false), [Violation { demand: Demand::OneCallForARobot, at_ns: 5, wfr: 1, event: 0 }]);
        assert_eq!(told(true), []);
    }
}

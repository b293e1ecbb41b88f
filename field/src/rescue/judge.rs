//! The demands of the clauses MRC-1 to MRC-9, looked at after every turn of a run. Each clause is told once.

use tautline_kernel::mrc::{Bid, Phase, Resb, Robot, ServiceBit, Task, Wfr};
use tautline_kernel::net::{Call, Epoch, NodeId, RobotId};
use tautline_proofs::mrc::Demand;

use super::{MAX_ROBOTS, MAX_WFRS};

/// A clause that was broken.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Violation {
    /// The demand that is broken.
    pub demand: Demand,
    /// When it was not so, in nanoseconds.
    pub at_ns: u64,
    /// Of which WFR.
    pub wfr: usize,
    /// During which of its events.
    pub event: usize,
}

/// The judge's notes beside the machines' own states.
pub(super) struct Judge {
    /// The latest event of each WFR.
    event: Vec<usize>,
    /// Whether the window of each WFR's latest call is open.
    is_open: Vec<bool>,
    /// The MOVEs of each WFR's latest call that arrived while its window was open.
    heard: Vec<Vec<Bid>>,
    /// The latest epoch of each WFR whose lease each robot has taken, robot by robot.
    taken: Vec<Vec<Option<Epoch>>>,
    pub(super) violations: Vec<Violation>,
}

/// A robot as the judge sees it.
pub(super) struct RobotView<'a> {
    pub(super) machine: &'a Robot<MAX_WFRS>,
    pub(super) has_failed: bool,
}

impl RobotView<'_> {
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
            is_open: vec![false; wfrs],
            heard: vec![vec![]; wfrs],
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
        self.is_open[wfr] = true;
        self.heard[wfr].clear();
    }

    /// A MOVE of the present call arrives.
    pub(super) fn bids(&mut self, wfr: usize, bid: Bid) {
        if self.is_open[wfr] {
            self.heard[wfr].push(bid);
        }
    }

    /// The window of a WFR closes.
    pub(super) fn closes(&mut self, wfr: usize) {
        self.is_open[wfr] = false;
    }

    /// A robot has heard a call that is new to it.
    pub(super) fn hears(&mut self, wfr: usize, served: ServiceBit, at_ns: u64) {
        match served {
            ServiceBit::No => {}
            ServiceBit::Yes => self.tell(Demand::AsksAnew, wfr, at_ns),
        }
    }

    /// A robot has done a turn, upon a RESB if there is one. `place` finds a WFR.
    pub(super) fn turns(
        &mut self,
        robot: usize,
        (before, after): (Task, &Robot<MAX_WFRS>),
        resb: Option<Resb>,
        place: impl Fn(NodeId) -> Option<usize>,
        at_ns: u64,
    ) {
        // The least (HC, SN), said here anew, like the least (MHC, MID).
        let open = || after.requests().filter(|request| request.served == ServiceBit::No);
        let nearest =
            open().min_by_key(|request| (request.hops, request.call.wfr)).map(|request| request.call);
        let is_asking_on = |call: Call| matches!(before, Task::Asking { call: asked, .. } if asked == call);
        let (call, demand) = match after.task() {
            Task::Free => (nearest, nearest.map(|_| Demand::AsksNearest)),
            Task::Asking { call, .. } => {
                let is_open = open().any(|request| request.call.wfr == call.wfr);
                let is_right = is_asking_on(call) && is_open || nearest == Some(call);
                (Some(call), (!is_right).then_some(Demand::AsksNearest))
            }
            Task::Leased { call } => {
                if let Some(wfr) = place(call.wfr) {
                    self.taken[robot][wfr] = Some(call.epoch);
                }
                let is_told = resb.is_some_and(|resb| resb.call == call && resb.chosen == Some(after.id()));
                let is_right = after.task() == before || is_told && is_asking_on(call);
                (Some(call), (!is_right).then_some(Demand::TakesWhatItAsksFor))
            }
        };
        if let (Some(wfr), Some(demand)) = (call.and_then(|call| place(call.wfr)), demand) {
            self.tell(demand, wfr, at_ns);
        }
    }

    /// A WFR has done a turn, upon the MOVE of its present call by `bidder` if there is one, and has sent `told`.
    pub(super) fn tells(
        &mut self,
        wfr: usize,
        (before, after): (Phase, &Wfr<MAX_ROBOTS>),
        bidder: Option<RobotId>,
        told: &[Resb],
        at_ns: u64,
    ) {
        let robot = |phase: Phase| choice(phase).map(|choice| choice.robot);
        let chosen = robot(after.phase());
        let has_decided = chosen.is_some() || matches!(after.phase(), Phase::Rescued { .. });
        let heard = || self.heard[wfr].iter().map(|bid| bid.robot);
        let is_new = chosen.is_some() && chosen != robot(before);
        let mut due = heard().filter(|_| is_new).chain(bidder.filter(|_| has_decided));
        let is_told = |robot: RobotId| told.iter().any(|resb| resb.robot == robot);
        let may_be_told = |robot: RobotId| heard().chain(bidder).chain(chosen).any(|known| known == robot);
        let is_right =
            |resb: &Resb| (resb.call, resb.chosen) == (after.call(), chosen) && may_be_told(resb.robot);
        if !due.all(is_told) || !told.iter().all(is_right) {
            self.tell(Demand::TellsWhoAsked, wfr, at_ns);
        }
    }

    /// Looks at all robots and WFRs.
    pub(super) fn look(&mut self, robots: &[RobotView<'_>], wfrs: &[Wfr<MAX_ROBOTS>], at_ns: u64) {
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
        for (wfr, machine) in wfrs.iter().enumerate() {
            if let Some(robot) = counts_on(machine)
                && wfrs[..wfr].iter().any(|other| counts_on(other) == Some(robot))
            {
                self.tell(Demand::OneCallForARobot, wfr, at_ns);
            }
            if choice(machine.phase()).is_some_and(|choice| !self.is_best(wfr, choice)) {
                self.tell(Demand::BestOfTheWindow, wfr, at_ns);
            }
            let has_taken =
                |robot: RobotId| self.taken[usize::from(robot.0)][wfr] == Some(machine.call().epoch);
            if counts_on(machine).is_some_and(|robot| !has_taken(robot)) {
                self.tell(Demand::CountsOnConsent, wfr, at_ns);
            }
        }
    }

    /// Whether the choice is the least (MHC, MID), said here anew: the judge does not ask the kernel which bid is the
    /// better.
    fn is_best(&self, wfr: usize, choice: Bid) -> bool {
        let best = self.heard[wfr].iter().min_by_key(|&&Bid { hops, robot: RobotId(id) }| (hops, id));
        best.is_some_and(|best| best.robot == choice.robot)
    }
}

/// The robot that a WFR has chosen and not yet seen.
pub(super) const fn choice(phase: Phase) -> Option<Bid> {
    match phase {
        Phase::Offered { choice, .. } | Phase::Leased { choice } => Some(choice),
        Phase::Idle | Phase::Collecting { .. } | Phase::Rescued { .. } => None,
    }
}

#[cfg(test)]
mod tests {
    use tautline_kernel::mrc::{Condition, Downward, Rule, Upward, WfrTimer, Word};
    use tautline_kernel::net::Notice;

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

    /// The violations when two WFRs count on the same robot.
    fn told(has_failed: bool) -> Vec<Violation> {
        let mut judge = Judge::new(1, 2);
        let (wfrs, machine) = ([leased(4), leased(7)], Robot::new(Rule::REPAIRED, ROBOT));
        for (number, wfr) in wfrs.iter().enumerate() {
            judge.calls(number);
            judge.bids(number, Bid { hops: 1, robot: ROBOT });
            judge.closes(number);
            judge.taken[0][number] = Some(wfr.call().epoch);
        }
        judge.look(&[RobotView { machine: &machine, has_failed }], &wfrs, 5);
        judge.violations
    }

    /// The violations of a robot under `rule` that learns that it is chosen when it has heard of another choice, and
    /// asks another WFR.
    fn told_of_a_robot(rule: Rule) -> Vec<(Demand, usize)> {
        let mut judge = Judge::new(1, 2);
        let call = |wfr: u32| Call { wfr: NodeId(wfr), epoch: Epoch::FIRST };
        let notice =
            |wfr: u32, hops: u16| Downward::Notice(Notice { call: call(wfr), hops, sender: NodeId(wfr) });
        let resb = |wfr: u32, chosen: RobotId| Resb { call: call(wfr), robot: ROBOT, chosen: Some(chosen) };
        let (other, mine) = (resb(0, RobotId(1)), resb(0, ROBOT));
        let heard = [
            (notice(0, 2), None),
            (notice(1, 1), None),
            (Downward::Resb(other), Some(other)),
            (Downward::Resb(mine), Some(mine)),
        ];
        let mut robot = Robot::new(rule, ROBOT);
        for (at_ns, (message, resb)) in (0..).zip(heard) {
            let before = robot.task();
            robot = robot.receive(message).0;
            judge.turns(0, (before, &robot), resb, |wfr| Some(wfr.0 as usize), at_ns);
        }
        judge.violations.iter().map(|violation| (violation.demand, violation.wfr)).collect()
    }

    #[test]
    fn a_robot_that_takes_what_it_does_not_ask_for_is_told() {
        assert_eq!(told_of_a_robot(Rule::REPAIRED), []);
        let late = Rule::REPAIRED.without(Condition::StillAsks);
        assert_eq!(told_of_a_robot(late), [(Demand::TakesWhatItAsksFor, 0)]);
    }

    #[test]
    fn a_robot_that_asks_for_another_than_the_nearest_is_told() {
        let told = |rule: Rule| {
            let call = |wfr: u32| Call { wfr: NodeId(wfr), epoch: Epoch::FIRST };
            let notice = |wfr: u32, hops: u16| Notice { call: call(wfr), hops, sender: NodeId(wfr) };
            let resb = Resb { call: call(2), robot: ROBOT, chosen: None };
            let heard = [notice(2, 1), notice(0, 5), notice(1, 3)].map(Downward::Notice);
            let (mut judge, mut robot) = (Judge::new(1, 3), Robot::new(rule, ROBOT));
            for message in heard.into_iter().chain([Downward::Resb(resb)]) {
                let before = robot.task();
                robot = robot.receive(message).0;
                judge.turns(0, (before, &robot), None, |wfr| Some(wfr.0 as usize), 0);
            }
            judge.violations.iter().map(|violation| violation.demand).collect::<Vec<_>>()
        };
        assert_eq!(told(Rule::REPAIRED), []);
        assert_eq!(told(Rule::REPAIRED.without(Condition::NearestCall)), [Demand::AsksNearest]);
    }

    #[test]
    fn a_wfr_that_leaves_a_robot_without_answer_or_answers_another_is_told() {
        let wfr = leased(4);
        let (rescued, call) = (wfr.reach(ROBOT), wfr.call());
        let nobody = Resb { call, robot: RobotId(1), chosen: None };
        let told = |bidder: Option<u16>, resbs: &[Resb]| {
            let mut judge = Judge::new(2, 1);
            judge.tells(0, (rescued.phase(), &rescued), bidder.map(RobotId), resbs, 0);
            judge.violations.len()
        };
        assert_eq!(told(Some(1), &[nobody]), 0);
        assert_eq!(told(None, &[]), 0);
        assert_eq!(told(Some(1), &[]), 1, "it has asked");
        assert_eq!(told(None, &[nobody]), 1, "it has not asked");
        assert_eq!(told(Some(1), &[Resb { chosen: Some(RobotId(1)), ..nobody }]), 1, "nobody is chosen");
    }

    #[test]
    fn two_that_count_on_one_robot_are_told_whether_it_lives_or_has_failed() {
        let violation = Violation { demand: Demand::OneCallForARobot, at_ns: 5, wfr: 1, event: 0 };
        assert_eq!([false, true].map(told), [[violation], [violation]]);
    }
}

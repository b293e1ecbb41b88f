//! A WFR's part in MRC [Jiang 2011, 3.3, step 4]: it calls, hears MOVEs, chooses a robot, tells all that have asked,
//! and waits until the one chosen is there.

use super::message::{Bid, Resb, Upward, Word};
use super::rule::{Condition, Rule};
use crate::net::{Call, Epoch, NodeId, Notice, RobotId};

/// How far a rescue has come.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Phase {
    /// Nothing has happened.
    Idle,
    /// It has called and hears MOVEs.
    Collecting {
        /// The best so far.
        best: Option<Bid>,
    },
    /// It has chosen, and the robot has not answered.
    Offered {
        /// The choice.
        choice: Bid,
        /// How often it will still repeat its RESB.
        repeats_left: u8,
    },
    /// It counts on the robot.
    Leased {
        /// The choice.
        choice: Bid,
    },
    /// A robot has reached it.
    Rescued {
        /// Which.
        by: RobotId,
    },
}

/// A WFR's one timer. It starts anew whenever [`Wfr::timer`] changes.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum WfrTimer {
    /// The collection window: longer than the way of the NOTICE to the robots and of a MOVE back.
    Window(Epoch),
    /// The wait for the answer of the robot chosen: longer than the way of the RESB and of the answer.
    Answer {
        /// The epoch of the call.
        epoch: Epoch,
        /// How often it will still repeat its RESB.
        repeats_left: u8,
    },
    /// The lease: longer than a robot needs to come.
    Lease(Epoch),
}

/// A WFR's mail: a message to send, or none.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Mail<const ROBOTS: usize> {
    /// Nothing.
    Nothing,
    /// A call, to be spread through the network.
    Notice(Notice),
    /// Its choice, to one robot.
    One(Resb),
    /// Its choice, to every robot of which there is a RESB, on the way that its MOVE came.
    All([Option<Resb>; ROBOTS]),
}

/// A WFR that remembers at most `ROBOTS` robots that have asked. A robot beyond them is heard and may be chosen, but is
/// told of the choice only when it repeats its MOVE.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Wfr<const ROBOTS: usize> {
    rule: Rule,
    call: Call,
    phase: Phase,
    asked: [Option<RobotId>; ROBOTS],
}

impl<const ROBOTS: usize> Wfr<ROBOTS> {
    /// A node at which nothing has happened.
    pub const fn new(rule: Rule, id: NodeId) -> Self {
        let call = Call { wfr: id, epoch: Epoch::FIRST };
        Self { rule, call, phase: Phase::Idle, asked: [None; ROBOTS] }
    }

    /// A node as it was kept: with this call, so far, and asked by these robots, in the order heard.
    pub const fn kept(rule: Rule, call: Call, phase: Phase, asked: [Option<RobotId>; ROBOTS]) -> Self {
        Self { rule, call, phase, asked }
    }

    /// Its rule.
    pub const fn rule(&self) -> &Rule {
        &self.rule
    }

    /// Its latest call; in [`Phase::Idle`] there was none.
    pub const fn call(&self) -> Call {
        self.call
    }

    /// How far the rescue has come.
    pub const fn phase(&self) -> Phase {
        self.phase
    }

    /// The robots that have sent MOVE under this call, in the order heard.
    pub fn asked(&self) -> impl Iterator<Item = RobotId> {
        self.asked.iter().copied().flatten()
    }

    /// Whether something has happened and no robot has come yet.
    pub const fn is_waiting(&self) -> bool {
        !matches!(self.phase, Phase::Idle | Phase::Rescued { .. })
    }

    /// The timer that runs.
    pub fn timer(&self) -> Option<WfrTimer> {
        let (epoch, renews) = (self.call.epoch, self.rule.has(Condition::Renewal));
        match self.phase {
            Phase::Idle | Phase::Rescued { .. } => None,
            Phase::Collecting { .. } => self.rule.has(Condition::Window).then_some(WfrTimer::Window(epoch)),
            Phase::Offered { repeats_left, .. } => {
                (repeats_left > 0 || renews).then_some(WfrTimer::Answer { epoch, repeats_left })
            }
            Phase::Leased { .. } => renews.then_some(WfrTimer::Lease(epoch)),
        }
    }

    /// Something has happened: it calls for help. One that is waiting already goes on waiting.
    pub fn raise(self) -> (Self, Mail<ROBOTS>) {
        match self.phase {
            Phase::Idle => self.collect(),
            Phase::Rescued { .. } => self.renew(),
            Phase::Collecting { .. } | Phase::Offered { .. } | Phase::Leased { .. } => (self, Mail::Nothing),
        }
    }

    /// A robot's message has arrived. What belongs to another WFR is ignored.
    pub fn receive(mut self, message: Upward) -> (Self, Mail<ROBOTS>) {
        let Upward { call, robot, word, .. } = message;
        let is_of_another_epoch = call.epoch != self.call.epoch && self.rule.has(Condition::Epochs);
        if call.wfr != self.call.wfr || is_of_another_epoch {
            return (self, Mail::Nothing);
        }
        match (word, self.phase) {
            (Word::Move { hops }, _) => self.hear(Bid { hops, robot }),
            (Word::Accept, Phase::Offered { choice, .. }) if choice.robot == robot => {
                self.phase = Phase::Leased { choice };
                (self, Mail::Nothing)
            }
            (Word::Decline, Phase::Offered { choice, .. })
                if choice.robot == robot && self.rule.has(Condition::Renewal) =>
            {
                self.renew()
            }
            (Word::Accept | Word::Decline, _) => (self, Mail::Nothing),
        }
    }

    /// A timer has gone off. One that no longer runs is ignored.
    pub fn expire(mut self, timer: WfrTimer) -> (Self, Mail<ROBOTS>) {
        if self.timer() != Some(timer) {
            return (self, Mail::Nothing);
        }
        match self.phase {
            Phase::Collecting { best: Some(best) } => self.choose(best),
            Phase::Offered { choice, repeats_left } if repeats_left > 0 => {
                self.phase = Phase::Offered { choice, repeats_left: repeats_left - 1 };
                (self, self.tell(choice.robot, Some(choice.robot)))
            }
            Phase::Collecting { best: None } if !self.rule.has(Condition::Renewal) => (self, Mail::Nothing),
            Phase::Collecting { best: None } | Phase::Offered { .. } | Phase::Leased { .. } => self.renew(),
            Phase::Idle | Phase::Rescued { .. } => (self, Mail::Nothing),
        }
    }

    /// A robot stands before it, under whichever lease. Only the first is needed.
    #[must_use]
    pub const fn reach(mut self, by: RobotId) -> Self {
        if self.is_waiting() {
            self.phase = Phase::Rescued { by };
        }
        self
    }

    fn hear(mut self, bid: Bid) -> (Self, Mail<ROBOTS>) {
        match self.phase {
            Phase::Idle => (self, Mail::Nothing),
            Phase::Collecting { best } => {
                self.remember(bid.robot);
                let best = best.map_or(bid, |best| self.better(best, bid));
                self.phase = Phase::Collecting { best: Some(best) };
                if self.rule.has(Condition::Window) { (self, Mail::Nothing) } else { self.choose(best) }
            }
            Phase::Offered { choice, .. } | Phase::Leased { choice } => {
                if self.rule.has(Condition::ChoiceStands) {
                    return (self, self.answer(bid.robot, Some(choice.robot)));
                }
                self.remember(bid.robot);
                let better = self.better(choice, bid);
                if better.robot == choice.robot { (self, self.tell_all(choice)) } else { self.choose(better) }
            }
            Phase::Rescued { .. } => (self, self.answer(bid.robot, None)),
        }
    }

    /// The better of two bids, the first heard first.
    fn better(&self, first: Bid, second: Bid) -> Bid {
        let by_hops = self.rule.has(Condition::NearestRobot);
        let by_identity = self.rule.has(Condition::LeastIdentity);
        let rank = |bid: Bid| (by_hops.then_some(bid.hops), by_identity.then_some(bid.robot));
        if rank(second) < rank(first) { second } else { first }
    }

    fn remember(&mut self, robot: RobotId) {
        if self.asked().all(|asked| asked != robot)
            && let Some(place) = self.asked.iter_mut().find(|place| place.is_none())
        {
            *place = Some(robot);
        }
    }

    fn choose(mut self, choice: Bid) -> (Self, Mail<ROBOTS>) {
        self.phase = if self.rule.has(Condition::Consent) {
            Phase::Offered { choice, repeats_left: self.rule.repeats() }
        } else {
            Phase::Leased { choice }
        };
        (self, self.tell_all(choice))
    }

    fn answer(&self, robot: RobotId, chosen: Option<RobotId>) -> Mail<ROBOTS> {
        if self.rule.has(Condition::AnswersAgain) { self.tell(robot, chosen) } else { Mail::Nothing }
    }

    const fn tell(&self, robot: RobotId, chosen: Option<RobotId>) -> Mail<ROBOTS> {
        Mail::One(Resb { call: self.call, robot, chosen })
    }

    fn tell_all(&self, choice: Bid) -> Mail<ROBOTS> {
        let chosen = Some(choice.robot);
        Mail::All(self.asked.map(|asked| asked.map(|robot| Resb { call: self.call, robot, chosen })))
    }

    fn renew(mut self) -> (Self, Mail<ROBOTS>) {
        self.call.epoch = self.call.epoch.next();
        self.collect()
    }

    fn collect(mut self) -> (Self, Mail<ROBOTS>) {
        self.phase = Phase::Collecting { best: None };
        self.asked = [None; ROBOTS];
        (self, Mail::Notice(Notice { call: self.call, hops: 0, sender: self.call.wfr }))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ME: NodeId = NodeId(9);

    const fn word(robot: u16, epoch: u32, word: Word) -> Upward {
        let call = Call { wfr: ME, epoch: Epoch(epoch) };
        Upward { call, robot: RobotId(robot), word, parent: ME }
    }

    const fn bid(robot: u16, hops: u16) -> Upward {
        word(robot, 1, Word::Move { hops })
    }

    fn after(rule: Rule, messages: &[Upward]) -> (Wfr<2>, Mail<2>) {
        let called = Wfr::new(rule, ME).raise();
        messages.iter().fold(called, |(wfr, _), &message| wfr.receive(message))
    }

    fn closed(wfr: Wfr<2>) -> (Wfr<2>, Mail<2>) {
        wfr.expire(WfrTimer::Window(wfr.call().epoch))
    }

    const fn resb(robot: u16, chosen: u16) -> Resb {
        Resb {
            call: Call { wfr: ME, epoch: Epoch::FIRST },
            robot: RobotId(robot),
            chosen: Some(RobotId(chosen)),
        }
    }

    #[test]
    fn the_window_s_best_is_the_least_hop_count_and_of_equal_ones_the_least_id() {
        for (bids, best) in [([bid(1, 4), bid(2, 3)], 2), ([bid(2, 3), bid(1, 3)], 1)] {
            let (wfr, sent) = after(Rule::REPAIRED, &bids);
            assert_eq!(sent, Mail::Nothing, "the window is open");
            let (wfr, sent) = closed(wfr);
            assert!(matches!(wfr.phase(), Phase::Offered { choice, .. } if choice.robot == RobotId(best)));
            let told = bids.map(|bid| Some(resb(bid.robot.0, best)));
            assert_eq!(sent, Mail::All(told));
        }
    }

    #[test]
    fn a_window_without_a_move_makes_a_new_call() {
        let (wfr, sent) = closed(after(Rule::REPAIRED, &[]).0);
        let call = Call { wfr: ME, epoch: Epoch(2) };
        assert_eq!(sent, Mail::Notice(Notice { call, hops: 0, sender: ME }));
        assert_eq!((wfr.call(), wfr.phase()), (call, Phase::Collecting { best: None }));
    }

    #[test]
    fn a_new_call_forgets_who_asked_under_the_one_before() {
        let (wfr, _) = closed(after(Rule::REPAIRED, &[bid(1, 4), bid(2, 5)]).0);
        let (wfr, _) = wfr.receive(word(1, 1, Word::Decline));
        assert_eq!((wfr.call().epoch, wfr.asked().count()), (Epoch(2), 0));
        let (wfr, _) = wfr.receive(word(2, 2, Word::Move { hops: 5 }));
        let told = Resb { call: wfr.call(), ..resb(2, 2) };
        assert_eq!(closed(wfr).1, Mail::All([Some(told), None]));
    }

    #[test]
    fn the_next_event_is_a_new_call_once_a_robot_has_come_and_not_before() {
        for rule in [Rule::PUBLISHED, Rule::REPAIRED] {
            let (waiting, _) = after(rule, &[bid(1, 4)]);
            assert_eq!(waiting.raise(), (waiting, Mail::Nothing));
            let (again, sent) = waiting.reach(RobotId(1)).raise();
            let call = Call { wfr: ME, epoch: Epoch(2) };
            assert_eq!(sent, Mail::Notice(Notice { call, hops: 0, sender: ME }));
            assert_eq!((again.call(), again.phase()), (call, Phase::Collecting { best: None }));
        }
    }

    #[test]
    fn a_late_move_is_answered_with_the_choice_that_stands() {
        let (wfr, _) = closed(after(Rule::REPAIRED, &[bid(1, 4)]).0);
        assert_eq!(wfr.receive(bid(2, 1)), (wfr, Mail::One(resb(2, 1))));
        let rescued = wfr.reach(RobotId(1));
        for robot in [1, 2] {
            let nobody = Resb { chosen: None, ..resb(robot, 1) };
            assert_eq!(rescued.receive(bid(robot, 1)), (rescued, Mail::One(nobody)));
        }
    }

    #[test]
    fn as_published_a_late_move_changes_the_choice() {
        let (wfr, sent) = after(Rule::PUBLISHED, &[bid(1, 4)]);
        assert_eq!(sent, Mail::All([Some(resb(1, 1)), None]));
        let (_, sent) = wfr.receive(bid(2, 1));
        assert_eq!(sent, Mail::All([Some(resb(1, 2)), Some(resb(2, 2))]));
    }

    #[test]
    fn what_names_another_wfr_or_epoch_changes_nothing() {
        let (wfr, _) = after(Rule::REPAIRED, &[bid(1, 4)]);
        let elsewhere = Call { wfr: NodeId(8), epoch: Epoch::FIRST };
        for stray in [word(2, 2, Word::Move { hops: 1 }), Upward { call: elsewhere, ..bid(2, 1) }] {
            assert_eq!(wfr.receive(stray), (wfr, Mail::Nothing));
        }
        let (wfr, _) = closed(wfr);
        for stray in [word(1, 2, Word::Accept), word(2, 1, Word::Accept), word(2, 1, Word::Decline)] {
            assert_eq!(wfr.receive(stray), (wfr, Mail::Nothing));
        }
        let idle = Wfr::<2>::new(Rule::REPAIRED, ME);
        assert_eq!(idle.receive(bid(1, 1)), (idle, Mail::Nothing));
    }

    #[test]
    fn an_unanswered_choice_is_repeated_then_called_again_and_a_lapsed_lease_too() {
        let (wfr, _) = closed(after(Rule::REPAIRED, &[bid(1, 4), bid(2, 5)]).0);
        let (again, sent) = wfr.expire(wfr.timer().expect("a timer runs"));
        assert_eq!(sent, Mail::One(resb(1, 1)));
        let (called, sent) = again.expire(again.timer().expect("a timer runs"));
        assert!(matches!(sent, Mail::Notice(_)) && called.call().epoch == Epoch(2));
        let (leased, _) = again.receive(word(1, 1, Word::Accept));
        assert_eq!(leased.timer(), Some(WfrTimer::Lease(Epoch::FIRST)));
        let (called, _) = leased.expire(WfrTimer::Lease(Epoch::FIRST));
        assert_eq!(called.call().epoch, Epoch(2));
        let (called, _) = wfr.receive(word(1, 1, Word::Decline));
        assert_eq!(called.call().epoch, Epoch(2));
    }

    #[test]
    fn without_renewal_a_wfr_repeats_its_choice_as_often_as_it_may_and_calls_no_more() {
        let rule = Rule::REPAIRED.without(Condition::Renewal);
        let (offered, _) = closed(after(rule, &[bid(1, 4)]).0);
        let answer = WfrTimer::Answer { epoch: Epoch::FIRST, repeats_left: 1 };
        assert_eq!(offered.timer(), Some(answer));
        let (again, sent) = offered.expire(answer);
        assert_eq!((sent, again.timer()), (Mail::One(resb(1, 1)), None));
        let (uncalled, _) = after(rule, &[]);
        assert_eq!(closed(uncalled), (uncalled, Mail::Nothing));
    }

    #[test]
    fn where_ids_do_not_count_the_first_heard_of_equals_is_chosen() {
        let rule = Rule::REPAIRED.without(Condition::LeastIdentity);
        for (first, second) in [(2, 1), (1, 2)] {
            let (_, sent) = closed(after(rule, &[bid(first, 3), bid(second, 3)]).0);
            assert_eq!(sent, Mail::All([first, second].map(|robot| Some(resb(robot, first)))));
        }
    }

    #[test]
    fn a_robot_beyond_those_that_it_can_remember_is_chosen_all_the_same() {
        let (wfr, sent) = closed(after(Rule::REPAIRED, &[bid(1, 4), bid(2, 5), bid(3, 3)]).0);
        assert_eq!(sent, Mail::All([Some(resb(1, 3)), Some(resb(2, 3))]));
        assert_eq!(wfr.receive(bid(3, 3)), (wfr, Mail::One(resb(3, 3))));
    }
}

//! A robot's part in MRC [Jiang 2011, 3.3, steps 1, 2 and 5]: the request table
//! T_REQ, what it asks for, and where it goes.

use super::message::{Downward, Resb, Upward, Word};
use super::rule::{Condition, Rule};
use crate::net::{Call, NodeId, Notice, RobotId};

/// SBit: whether a robot still has to do with a call.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum ServiceBit {
    /// 0: it may ask for it.
    No,
    /// 1: it has heard whom the WFR has chosen, or has asked in vain.
    Yes,
}

/// A record of T_REQ.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Request {
    /// SN, and the newest epoch heard of it.
    pub call: Call,
    /// SBit.
    pub served: ServiceBit,
    /// HC: hops from the robot to the WFR, the least heard under the epoch.
    pub hops: u16,
    /// ID: the robot's parent in the tree of the call.
    pub parent: NodeId,
}

/// A robot's task.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Task {
    /// It knows of no call that it may ask for.
    Free,
    /// It has sent MOVE and waits for RESB.
    Asking {
        /// For what.
        call: Call,
        /// How often it will still repeat its MOVE.
        repeats_left: u8,
    },
    /// It is on its way: it holds the lease of the call.
    Leased {
        /// To whom.
        call: Call,
    },
}

/// A robot's one timer. It starts anew whenever [`Robot::timer`] changes.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct RobotTimer {
    /// The call on whose RESB it waits. Longer than the way of a MOVE, the WFR's window and the way of the RESB.
    pub call: Call,
    /// How often it will still repeat its MOVE.
    pub repeats_left: u8,
}

/// A robot that knows of at most `CALLS` WFRs at a time.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Robot<const CALLS: usize> {
    rule: Rule,
    id: RobotId,
    requests: [Option<Request>; CALLS],
    task: Task,
}

impl<const CALLS: usize> Robot<CALLS> {
    /// A free robot that has heard nothing.
    pub const fn new(rule: Rule, id: RobotId) -> Self {
        Self { rule, id, requests: [None; CALLS], task: Task::Free }
    }

    /// A robot as it was kept: with these records, in the order heard, and this task.
    pub const fn kept(rule: Rule, id: RobotId, requests: [Option<Request>; CALLS], task: Task) -> Self {
        Self { rule, id, requests, task }
    }

    /// Its rule.
    pub const fn rule(&self) -> &Rule {
        &self.rule
    }

    /// Its identity.
    pub const fn id(&self) -> RobotId {
        self.id
    }

    /// The robot's task.
    pub const fn task(&self) -> Task {
        self.task
    }

    /// T_REQ, in the order heard.
    pub fn requests(&self) -> impl Iterator<Item = &Request> {
        self.requests.iter().flatten()
    }

    /// Its record of a WFR.
    pub fn request(&self, wfr: NodeId) -> Option<&Request> {
        self.requests().find(|request| request.call.wfr == wfr)
    }

    /// The timer that runs.
    pub fn timer(&self) -> Option<RobotTimer> {
        let Task::Asking { call, repeats_left } = self.task else { return None };
        self.rule.has(Condition::Repetition).then_some(RobotTimer { call, repeats_left })
    }

    /// A message has arrived: what it makes of the robot, and what the robot sends.
    pub fn receive(self, message: Downward) -> (Self, Option<Upward>) {
        match message {
            Downward::Notice(notice) => self.note(notice).ask_if_free(),
            Downward::Resb(resb) if resb.robot == self.id => self.heed(resb),
            Downward::Resb(_) => (self, None),
        }
    }

    /// A timer has gone off. One that no longer runs is ignored.
    pub fn expire(mut self, timer: RobotTimer) -> (Self, Option<Upward>) {
        if self.timer() != Some(timer) {
            return (self, None);
        }
        let RobotTimer { call, repeats_left } = timer;
        if let Some(repeats_left) = repeats_left.checked_sub(1) {
            self.task = Task::Asking { call, repeats_left };
            return (self, self.request(call.wfr).map(|request| self.bid(request)));
        }
        self.set_served(call.wfr);
        self.task = Task::Free;
        self.ask_if_free()
    }

    /// It has reached the WFR whose lease it holds, and is free again.
    pub fn arrive(mut self) -> (Self, Option<Upward>) {
        if let Task::Leased { .. } = self.task {
            self.task = Task::Free;
        }
        self.ask_if_free()
    }

    /// The lease of `call` has lapsed before it came: it is free again. It must hold the lease no shorter than the WFR,
    /// which else counts on a robot that may be another's.
    pub fn lapse(mut self, call: Call) -> (Self, Option<Upward>) {
        if self.task != (Task::Leased { call }) {
            return (self, None);
        }
        self.task = Task::Free;
        self.ask_if_free()
    }

    /// Step 1: a record for the call, and the least hop count for it; of equal ones the first heard.
    fn note(mut self, notice: Notice) -> Self {
        let Notice { call, hops, sender } = notice;
        let hops = hops.saturating_add(1);
        let has_epochs = self.rule.has(Condition::Epochs);
        let heard = Request { call, served: ServiceBit::No, hops, parent: sender };
        let Some(known) = self.record(call.wfr) else {
            self.add(heard);
            return self;
        };
        if has_epochs && known.call.epoch < call.epoch {
            *known = heard;
            // Whatever it does for an older call of the same WFR is over.
            if let Task::Asking { call: older, .. } | Task::Leased { call: older } = self.task
                && older.wfr == call.wfr
            {
                self.task = Task::Free;
            }
        } else if !has_epochs || known.call.epoch == call.epoch {
            known.call.epoch = known.call.epoch.max(call.epoch);
            if hops < known.hops {
                (known.hops, known.parent) = (hops, sender);
            }
        }
        self
    }

    /// Step 5: the SBit is set; the robot chosen sets out, and who is not chosen asks elsewhere.
    fn heed(mut self, resb: Resb) -> (Self, Option<Upward>) {
        let Resb { call, chosen, .. } = resb;
        let Some(request) = self.request(call.wfr).copied() else { return (self, None) };
        if self.rule.has(Condition::Epochs) && request.call.epoch != call.epoch {
            return (self, None);
        }
        self.set_served(call.wfr);
        let has_consent = self.rule.has(Condition::Consent);
        let (is_asking, is_leased, is_under_way) = match self.task {
            Task::Free => (false, false, false),
            Task::Asking { call: asked, .. } => (asked.wfr == call.wfr, false, false),
            Task::Leased { call: held } => (false, held.wfr == call.wfr, true),
        };
        if chosen == Some(self.id) {
            let takes_late = !is_under_way && !self.rule.has(Condition::StillAsks);
            let takes = is_asking || takes_late || !has_consent;
            if takes {
                self.task = Task::Leased { call };
            }
            let word = if takes || is_leased { Word::Accept } else { Word::Decline };
            let answer = Upward { call, robot: self.id, word, parent: request.parent };
            return (self, has_consent.then_some(answer));
        }
        if is_asking || is_leased && !has_consent {
            self.task = Task::Free;
        }
        self.ask_if_free()
    }

    /// Step 2: a free robot sends MOVE for the nearest call that is not served.
    fn ask_if_free(mut self) -> (Self, Option<Upward>) {
        if self.task != Task::Free {
            return (self, None);
        }
        let by_hops = self.rule.has(Condition::NearestCall);
        let by_identity = self.rule.has(Condition::LeastIdentity);
        let rank =
            |request: &&Request| (by_hops.then_some(request.hops), by_identity.then_some(request.call.wfr));
        let open = self.requests().filter(|request| request.served == ServiceBit::No);
        let Some(request) = open.min_by_key(rank).copied() else { return (self, None) };
        self.task = Task::Asking { call: request.call, repeats_left: self.rule.repeats() };
        (self, Some(self.bid(&request)))
    }

    fn bid(&self, request: &Request) -> Upward {
        let Request { call, hops, parent, .. } = *request;
        Upward { call, robot: self.id, word: Word::Move { hops }, parent }
    }

    fn record(&mut self, wfr: NodeId) -> Option<&mut Request> {
        self.requests.iter_mut().flatten().find(|request| request.call.wfr == wfr)
    }

    fn set_served(&mut self, wfr: NodeId) {
        if let Some(request) = self.record(wfr) {
            request.served = ServiceBit::Yes;
        }
    }

    /// Adds a record, in the place of a served one if the table is full, but not of the one whose lease the robot
    /// holds: with that, an older call of the same WFR that comes late would pass for the newest, and the next for a
    /// newer one. Where none can go the call is left to others, and heard again under its next epoch.
    fn add(&mut self, heard: Request) {
        let own = match self.task {
            Task::Free => None,
            Task::Asking { call, .. } | Task::Leased { call } => Some(call.wfr),
        };
        let may_go = |place: &Option<Request>| {
            place.is_some_and(|request| request.served == ServiceBit::Yes && Some(request.call.wfr) != own)
        };
        let empty = self.requests.iter().position(Option::is_none);
        let place = empty.or_else(|| self.requests.iter().position(may_go));
        if let Some(place) = place.and_then(|place| self.requests.get_mut(place)) {
            *place = Some(heard);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::net::Epoch;

    const ME: RobotId = RobotId(1);
    const OTHER: RobotId = RobotId(2);

    const fn call(wfr: u32, epoch: u32) -> Call {
        Call { wfr: NodeId(wfr), epoch: Epoch(epoch) }
    }

    const fn notice(call: Call, hops: u16, sender: u32) -> Downward {
        Downward::Notice(Notice { call, hops, sender: NodeId(sender) })
    }

    const fn resb(call: Call, robot: RobotId, chosen: RobotId) -> Downward {
        Downward::Resb(Resb { call, robot, chosen: Some(chosen) })
    }

    fn after(rule: Rule, messages: &[Downward]) -> (Robot<2>, Option<Upward>) {
        messages.iter().fold((Robot::new(rule, ME), None), |(robot, _), &message| robot.receive(message))
    }

    fn word(sent: Option<Upward>) -> Option<(u32, u32, Word)> {
        sent.map(|sent| (sent.call.wfr.0, sent.call.epoch.0, sent.word))
    }

    #[test]
    fn of_equal_hop_counts_the_first_heard_is_the_parent_and_of_others_the_least() {
        let heard = [notice(call(0, 0), 4, 10), notice(call(0, 0), 4, 11)];
        for rule in [Rule::PUBLISHED, Rule::REPAIRED] {
            let (robot, _) = after(rule, &heard);
            assert_eq!(
                robot.request(NodeId(0)).map(|request| (request.hops, request.parent.0)),
                Some((5, 10))
            );
            let (robot, sent) = robot.receive(notice(call(0, 0), 2, 12));
            assert_eq!(
                robot.request(NodeId(0)).map(|request| (request.hops, request.parent.0)),
                Some((3, 12))
            );
            assert_eq!(sent, None, "it has asked before");
        }
    }

    #[test]
    fn a_robot_that_is_not_chosen_asks_for_the_nearest_of_the_others_the_least_id_first() {
        let heard = [notice(call(9, 0), 1, 3), notice(call(8, 0), 6, 3), resb(call(9, 0), ME, OTHER)];
        for rule in [Rule::PUBLISHED, Rule::REPAIRED] {
            let (robot, sent) = after(rule, &heard);
            assert_eq!(word(sent), Some((8, 0, Word::Move { hops: 7 })));
            assert!(robot.requests().map(|request| request.served).eq([ServiceBit::Yes, ServiceBit::No]));
        }
        let tie = [(9, 1), (8, 4), (7, 4), (6, 5)].map(|(wfr, hops)| notice(call(wfr, 0), hops, 3));
        let (robot, _) = tie
            .iter()
            .fold((Robot::<4>::new(Rule::REPAIRED, ME), None), |(robot, _), &message| robot.receive(message));
        let (_, sent) = robot.receive(resb(call(9, 0), ME, OTHER));
        assert_eq!(word(sent), Some((7, 0, Word::Move { hops: 5 })));
    }

    #[test]
    fn the_sbit_clears_on_a_new_epoch_and_on_nothing_else() {
        let served = [notice(call(0, 3), 4, 10), resb(call(0, 3), ME, OTHER)];
        let (robot, _) = after(Rule::REPAIRED, &served);
        for old in [notice(call(0, 3), 1, 10), notice(call(0, 2), 1, 10)] {
            let (robot, sent) = robot.receive(old);
            assert_eq!(robot.request(NodeId(0)).map(|request| request.served), Some(ServiceBit::Yes));
            assert_eq!(sent, None);
        }
        let (robot, sent) = robot.receive(notice(call(0, 4), 6, 10));
        assert_eq!(robot.request(NodeId(0)).map(|request| request.served), Some(ServiceBit::No));
        assert_eq!(word(sent), Some((0, 4, Word::Move { hops: 7 })));
    }

    #[test]
    fn a_newer_call_ends_what_a_robot_does_for_the_older_and_for_no_other() {
        let asking = [notice(call(0, 1), 4, 10)];
        let leased = [notice(call(0, 1), 4, 10), resb(call(0, 1), ME, ME)];
        for heard in [&asking[..], &leased] {
            let (robot, _) = after(Rule::REPAIRED, heard);
            let (other, sent) = robot.receive(notice(call(1, 1), 1, 10));
            assert_eq!((other.task(), sent), (robot.task(), None));
            let (robot, sent) = robot.receive(notice(call(0, 2), 4, 10));
            assert_eq!(word(sent), Some((0, 2, Word::Move { hops: 5 })));
            assert_eq!(robot.task(), Task::Asking { call: call(0, 2), repeats_left: 1 });
        }
    }

    #[test]
    fn an_answer_that_names_nobody_frees_a_robot_that_asks() {
        let heard = [notice(call(0, 1), 4, 10), notice(call(1, 1), 6, 10)];
        let (robot, _) = after(Rule::REPAIRED, &heard);
        let nobody = Downward::Resb(Resb { call: call(0, 1), robot: ME, chosen: None });
        let (robot, sent) = robot.receive(nobody);
        assert_eq!(word(sent), Some((1, 1, Word::Move { hops: 7 })));
        assert_eq!(robot.request(NodeId(0)).map(|request| request.served), Some(ServiceBit::Yes));
    }

    #[test]
    fn what_names_an_unknown_wfr_epoch_or_robot_changes_nothing() {
        let (robot, _) = after(Rule::REPAIRED, &[notice(call(0, 3), 4, 10)]);
        for stray in [
            resb(call(5, 3), ME, ME),
            resb(call(0, 2), ME, ME),
            resb(call(0, 4), ME, ME),
            resb(call(0, 3), OTHER, ME),
        ] {
            assert_eq!(robot.receive(stray), (robot, None), "{stray:?}");
        }
    }

    #[test]
    fn the_choice_is_accepted_again_each_time_that_it_comes_and_declined_elsewhere() {
        let chosen = resb(call(0, 0), ME, ME);
        let (robot, sent) = after(Rule::REPAIRED, &[notice(call(0, 0), 4, 10), chosen]);
        assert_eq!(word(sent), Some((0, 0, Word::Accept)));
        assert_eq!(robot.task(), Task::Leased { call: call(0, 0) });
        assert_eq!(robot.receive(chosen), (robot, sent));
        let (robot, _) = robot.receive(notice(call(1, 0), 4, 10));
        let (robot, sent) = robot.receive(resb(call(1, 0), ME, ME));
        assert_eq!(word(sent), Some((1, 0, Word::Decline)));
        assert_eq!(robot.task(), Task::Leased { call: call(0, 0) });
    }

    #[test]
    fn a_move_is_repeated_and_then_the_call_is_left_to_others() {
        let (robot, first) = after(Rule::REPAIRED, &[notice(call(0, 0), 4, 10)]);
        let timer = robot.timer().expect("a timer runs");
        let (robot, again) = robot.expire(timer);
        assert_eq!(again, first);
        assert_eq!(robot.expire(timer), (robot, None), "that timer runs no longer");
        let (robot, sent) = robot.expire(robot.timer().expect("a timer runs"));
        assert_eq!((robot.task(), sent, robot.timer()), (Task::Free, None, None));
    }

    #[test]
    fn a_lease_that_has_lapsed_frees_the_robot_and_another_one_does_not() {
        let heard = [notice(call(0, 1), 4, 10), notice(call(1, 1), 6, 10), resb(call(0, 1), ME, ME)];
        let (robot, _) = after(Rule::REPAIRED, &heard);
        assert_eq!(robot.lapse(call(0, 2)), (robot, None));
        let (free, sent) = robot.lapse(call(0, 1));
        assert_eq!(word(sent), Some((1, 1, Word::Move { hops: 7 })));
        assert_eq!(free.lapse(call(0, 1)), (free, None));
    }

    #[test]
    fn a_full_table_gives_the_place_of_a_served_call_and_no_other() {
        let full = [notice(call(0, 0), 4, 10), notice(call(1, 0), 5, 10)];
        let (robot, _) = after(Rule::REPAIRED, &full);
        assert_eq!(robot.receive(notice(call(2, 0), 1, 10)), (robot, None));
        let (robot, _) = robot.receive(resb(call(0, 0), ME, OTHER));
        let (robot, _) = robot.receive(notice(call(2, 0), 1, 10));
        assert!(robot.requests().map(|request| request.call.wfr.0).eq([2, 1]));
    }

    #[test]
    fn a_robot_keeps_the_record_of_its_lease_though_its_table_is_full() {
        let heard = [notice(call(1, 2), 1, 3), resb(call(1, 2), ME, ME)];
        let fresh = (Robot::<1>::new(Rule::REPAIRED, ME), None);
        let (robot, _) = heard.iter().fold(fresh, |(robot, _), &message| robot.receive(message));
        // Another WFR calls, and then two old NOTICEs of the first come once more.
        let late = [notice(call(2, 1), 1, 3), notice(call(1, 1), 1, 3), notice(call(1, 2), 1, 3)];
        let (robot, sent) = late.iter().fold((robot, None), |(robot, _), &message| robot.receive(message));
        assert_eq!((robot.task(), sent), (Task::Leased { call: call(1, 2) }, None));
    }
}

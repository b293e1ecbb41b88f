//! A turn: the state after an action, what the machines send then, and what the observer notes.

use std::{array, mem};

use tautline_kernel::mrc::{
    Bid, Condition, Mail, Phase, Robot, ServiceBit, Task, Upward, Wfr, WfrTimer, Word,
};
use tautline_kernel::net::{Call, Notice, RobotId};

use super::action::{Action, Actor, Message};
use super::demand::Demand;
use super::parts::{FIRST_WFR, REST, of_network};
use super::setting::{Faults, ROBOTS, Setting, WFRS};
use super::{State, node, place, robot_id};
use crate::mrc::Misreading;
use crate::mrc::reading::begin;

impl State {
    /// The state after `action`, which must be one of [`Self::actions`].
    #[must_use]
    pub fn after(&self, setting: &Setting, action: Action) -> Self {
        let mut next = self.clone();
        next.act(setting, action);
        next
    }

    /// Makes of the state the one after `action`.
    pub(in crate::mrc) fn act(&mut self, setting: &Setting, action: Action) {
        if mem::take(&mut self.is_canonical) {
            self.touched = 0;
        }
        match action {
            Action::Raise(wfr) => {
                self.events_left -= 1;
                self.touch(REST);
                self.turn_wfr(setting, wfr, None, Wfr::raise);
            }
            Action::Deliver(at) => {
                let message = self.network.remove(at);
                self.touch(of_network(message.robot()));
                self.deliver(setting, message);
            }
            Action::Begin(robot) => self.turn_robot(setting, robot, |robot| begin(&robot)),
            Action::Expire(actor) => {
                if !self.is_due(setting, actor) {
                    self.spend(|left| &mut left.delays);
                }
                self.expire(setting, actor);
            }
            Action::Arrive(robot) => {
                if let Task::Leased { call } = self.robots[robot].task() {
                    let wfr = place(call.wfr);
                    self.wfrs[wfr] = self.wfrs[wfr].reach(robot_id(robot));
                    self.touch(FIRST_WFR + wfr);
                    self.turn_robot(setting, robot, Robot::arrive);
                }
            }
            Action::Lapse(robot) => {
                if let Task::Leased { call } = self.robots[robot].task() {
                    self.turn_robot(setting, robot, |robot| robot.lapse(call));
                }
            }
            Action::Lose(at) => {
                self.spend(|left| &mut left.losses);
                let message = self.network.remove(at);
                self.touch(of_network(message.robot()));
            }
            Action::Duplicate(at) => {
                self.spend(|left| &mut left.duplicates);
                self.network.insert(at, self.network[at]);
                self.touch(of_network(self.network[at].robot()));
            }
            Action::FailRobot(robot) => {
                self.spend(|left| &mut left.robots);
                self.failed[robot] = true;
                self.network.retain(|message| match message {
                    Message::Notice(..) | Message::Resb(_) => message.robot() != robot_id(robot),
                    Message::Up(_) => true,
                });
                self.touch(robot);
                self.touch(of_network(robot_id(robot)));
            }
            Action::FailNode { robot, wfr } => {
                self.spend(|left| &mut left.nodes);
                let call = self.wfrs[wfr].call();
                self.cut[robot][wfr] = Some(call.epoch);
                self.network.retain(|message| match message {
                    Message::Notice(..) => true,
                    Message::Resb(_) | Message::Up(_) => {
                        (message.robot(), message.call()) != (robot_id(robot), call)
                    }
                });
                self.touch(robot);
                self.touch(of_network(robot_id(robot)));
            }
        }
        self.note(setting);
    }

    /// The part in this place may be another one than when the state was canonical.
    pub(super) const fn touch(&mut self, place: usize) {
        self.touched |= 1 << place;
    }

    /// One fault less.
    fn spend(&mut self, kind: impl Fn(&mut Faults) -> &mut u8) {
        self.left.spend(kind);
        self.touch(REST);
    }

    /// `demand` is not met.
    fn tell(&mut self, demand: Demand) {
        self.notes.broken |= 1 << demand as u16;
        self.touch(REST);
    }

    fn deliver(&mut self, setting: &Setting, message: Message) {
        match message {
            Message::Notice(id, notice) => {
                let robot = usize::from(id.0);
                let wfr = notice.call.wfr;
                let known = self.robots[robot].request(wfr).map(|request| request.call.epoch);
                self.turn_robot(setting, robot, |robot| setting.reading.hear(robot, notice));
                let is_new = known.is_none_or(|known| known < notice.call.epoch);
                let is_served =
                    self.robots[robot].request(wfr).is_some_and(|request| request.served == ServiceBit::Yes);
                if is_new && is_served {
                    self.tell(Demand::AsksAnew);
                }
            }
            Message::Resb(resb) => {
                let (robot, before) =
                    (usize::from(resb.robot.0), self.robots[usize::from(resb.robot.0)].task());
                self.turn_robot(setting, robot, |robot| {
                    let (next, sent) = setting.reading.heed(robot, resb);
                    match (setting.misread, robot.task()) {
                        // On its way it says that it comes, and goes on.
                        (Some(Misreading::Offers), Task::Leased { .. }) => {
                            (next, sent.map(|sent| Upward { word: Word::Accept, ..sent }))
                        }
                        _ => (next, sent),
                    }
                });
                let task = self.robots[robot].task();
                let asked = |task: Task| match task {
                    Task::Asking { call, .. } => Some(call),
                    Task::Free | Task::Leased { .. } => None,
                };
                let takes = task != before && matches!(task, Task::Leased { .. });
                let is_wanted = task == (Task::Leased { call: resb.call })
                    && resb.chosen == Some(resb.robot)
                    && asked(before) == Some(resb.call);
                if takes && !is_wanted {
                    self.tell(Demand::TakesWhatItAsksFor);
                }
            }
            Message::Up(upward) => {
                let Upward { call, robot, word, .. } = upward;
                let wfr = place(call.wfr);
                let is_bid = matches!(word, Word::Move { .. }) && call == self.wfrs[wfr].call();
                if is_bid && self.notes.open[wfr] {
                    let hops = self.hops[usize::from(robot.0)][wfr];
                    let bids = self.notes.best[wfr].into_iter().chain([Bid { hops, robot }]);
                    self.notes.best[wfr] = bids.min_by_key(|&Bid { hops, robot: RobotId(id) }| (hops, id));
                    self.notes.heard[wfr] |= 1 << robot.0;
                }
                self.turn_wfr(setting, wfr, is_bid.then_some(robot), |wfr| wfr.receive(upward));
            }
        }
    }

    fn expire(&mut self, setting: &Setting, actor: Actor) {
        match actor {
            Actor::Robot(robot) => {
                if let Some(timer) = self.robots[robot].timer() {
                    self.turn_robot(setting, robot, |robot| robot.expire(timer));
                }
            }
            Actor::Wfr(wfr) => {
                if let Some(timer) = self.wfrs[wfr].timer() {
                    self.turn_wfr(setting, wfr, None, |wfr| wfr.expire(timer));
                    let has_chosen = match self.wfrs[wfr].phase() {
                        Phase::Offered { .. } | Phase::Leased { .. } => true,
                        Phase::Idle | Phase::Collecting { .. } | Phase::Rescued { .. } => false,
                    };
                    if has_chosen && matches!(timer, WfrTimer::Window(_)) {
                        self.notes.open[wfr] = false;
                    }
                }
            }
        }
    }

    fn turn_robot(
        &mut self,
        setting: &Setting,
        robot: usize,
        turn: impl FnOnce(Robot<WFRS>) -> (Robot<WFRS>, Option<Upward>),
    ) {
        let before = self.robots[robot].task();
        let (next, sent) = turn(self.robots[robot]);
        self.robots[robot] = next;
        self.touch(robot);
        let rank = |call: Call| (self.hops[robot][place(call.wfr)], call.wfr.0);
        let open = || next.requests().filter(|request| request.served == ServiceBit::No);
        let nearest = || open().map(|request| request.call).min_by_key(|&call| rank(call));
        let has_strayed = match (before, next.task()) {
            (Task::Asking { call: before, .. }, Task::Asking { call, .. }) if before == call => {
                open().all(|request| request.call.wfr != call.wfr)
            }
            (Task::Asking { call: before, .. }, Task::Free | Task::Asking { .. })
                if open().any(|request| request.call == before) =>
            {
                true
            }
            (_, Task::Asking { call, .. }) => nearest() != Some(call),
            (_, Task::Free) => nearest().is_some() && !setting.reading.collects(&next),
            (_, Task::Leased { .. }) => false,
        };
        if has_strayed {
            self.tell(Demand::AsksNearest);
        }
        if let Task::Leased { call } = next.task() {
            self.notes.taken[robot][place(call.wfr)] = Some(call.epoch);
        }
        self.send(sent.map(Message::Up));
    }

    /// `bidder` is the robot, if one has, whose MOVE of the present call has arrived.
    fn turn_wfr(
        &mut self,
        setting: &Setting,
        wfr: usize,
        bidder: Option<RobotId>,
        turn: impl FnOnce(Wfr<ROBOTS>) -> (Wfr<ROBOTS>, Mail<ROBOTS>),
    ) {
        let before = self.wfrs[wfr];
        let (mut next, sent) = turn(before);
        if setting.misread == Some(Misreading::Askers) && next.call() != before.call() {
            let mut asked = before.asked();
            next = Wfr::kept(*next.rule(), next.call(), next.phase(), array::from_fn(|_| asked.next()));
        }
        self.wfrs[wfr] = next;
        self.touch(FIRST_WFR + wfr);
        let sent: [Option<Message>; ROBOTS] = match sent {
            Mail::Nothing => [None; ROBOTS],
            Mail::One(resb) => array::from_fn(|place| (place == 0).then_some(Message::Resb(resb))),
            Mail::All(resbs) => resbs.map(|resb| resb.map(Message::Resb)),
            Mail::Notice(notice) => {
                self.notes.open[wfr] = true;
                (self.notes.best[wfr], self.notes.heard[wfr]) = (None, 0);
                let to = |robot: usize| {
                    // The last sender on the way is one hop nearer to the WFR than the robot.
                    let hops = self.hops[robot][wfr] - 1;
                    Message::Notice(robot_id(robot), Notice { hops, ..notice })
                };
                array::from_fn(|robot| (robot < setting.robots).then(|| to(robot)))
            }
        };
        let sent = sent.into_iter().flatten();
        self.judge_telling(wfr, (before.phase(), bidder), sent.clone());
        self.send(sent);
    }

    /// Looks whether a WFR has told its choice, to whom it is to tell it and to nobody else.
    fn judge_telling(
        &mut self,
        wfr: usize,
        (before, bidder): (Phase, Option<RobotId>),
        sent: impl Iterator<Item = Message>,
    ) {
        let choice = |phase: Phase| match phase {
            Phase::Offered { choice, .. } | Phase::Leased { choice } => Some(choice.robot),
            Phase::Idle | Phase::Collecting { .. } | Phase::Rescued { .. } => None,
        };
        let bit = |robot: Option<RobotId>| robot.map_or(0, |robot| 1 << robot.0);
        let (call, phase, heard) = (self.wfrs[wfr].call(), self.wfrs[wfr].phase(), self.notes.heard[wfr]);
        let chosen = choice(phase);
        let has_decided = chosen.is_some() || matches!(phase, Phase::Rescued { .. });
        let due = if choice(before) != chosen && chosen.is_some() { heard } else { 0 }
            | if has_decided { bit(bidder) } else { 0 };
        let may_be_told = heard | bit(bidder) | bit(chosen);
        let resbs =
            sent.filter_map(|message| if let Message::Resb(resb) = message { Some(resb) } else { None });
        let (mut told, mut is_right) = (0, true);
        for resb in resbs {
            told |= bit(Some(resb.robot));
            is_right &= (resb.call, resb.chosen) == (call, chosen);
        }
        if due & !told != 0 || told & !may_be_told != 0 || !is_right {
            self.tell(Demand::TellsWhoAsked);
        }
    }

    fn send(&mut self, messages: impl IntoIterator<Item = Message>) {
        for message in messages {
            if self.gets_through(message) {
                let at = self.network.partition_point(|other| *other < message);
                self.network.insert(at, message);
                self.touch(of_network(message.robot()));
            }
        }
    }

    /// Whether a message that is sent now is on its way: the robot lives, and so do the nodes between.
    fn gets_through(&self, message: Message) -> bool {
        let robot = usize::from(message.robot().0);
        let call = message.call();
        match message {
            Message::Notice(..) => !self.failed[robot],
            Message::Resb(_) | Message::Up(_) => {
                !self.failed[robot] && self.cut[robot][place(call.wfr)] != Some(call.epoch)
            }
        }
    }

    /// Closes windows that no timer closes, and forgets what can no longer play a part.
    fn note(&mut self, setting: &Setting) {
        for wfr in 0..setting.wfrs {
            let call = self.wfrs[wfr].call();
            let is_of_wfr = |message: &Message| message.call().wfr == node(wfr);
            if !self.wfrs[wfr].is_waiting() {
                (self.notes.open[wfr], self.notes.best[wfr]) = (false, None);
            }
            if self.notes.open[wfr]
                && !setting.rule.has(Condition::Window)
                && !self.network.iter().any(is_of_wfr)
            {
                self.notes.open[wfr] = false;
                self.touch(FIRST_WFR + wfr);
            }
            if !self.notes.open[wfr] {
                self.notes.heard[wfr] = 0;
            }
            for robot in 0..setting.robots {
                let Some(epoch) = self.cut[robot][wfr] else { continue };
                let cut = Call { epoch, ..call };
                let task = match self.robots[robot].task() {
                    Task::Free => None,
                    Task::Asking { call, .. } | Task::Leased { call } => Some(call),
                };
                let known = self.robots[robot].request(node(wfr)).map(|request| request.call);
                let is_of_use = cut == call
                    || task == Some(cut)
                    || known == Some(cut)
                    || self.network.iter().any(|message| message.call() == cut);
                if !is_of_use {
                    self.cut[robot][wfr] = None;
                    self.touch(robot);
                }
            }
        }
    }
}

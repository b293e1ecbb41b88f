//! MRC under a network that misbehaves: the kernel's robots and WFRs, the messages between them, and everything that can
//! go wrong within a [`Setting`]. What is searched for all states that can be reached is in [`space`]; a run is drawn
//! by [`chart`].
//!
//! A message takes any time and overtakes others. A timer runs longer than what it waits for: it goes off when none of
//! that is on its way, whatever goes on elsewhere, or earlier, which is one of the [`Faults`]. Epochs are only compared:
//! two states that differ by a renumbering that keeps their order are one, and so the states are finitely many.

use std::hash::{Hash, Hasher};

use tautline_kernel::mrc::{
    Bid, Condition, Downward, Phase, Resb, Robot, Rule, Sent, Served, Task, Upward, Wfr, WfrTimer, Word,
};
use tautline_kernel::net::{Call, Epoch, NodeId, Notice, RobotId};

/// Most robots of a setting.
pub const ROBOTS: usize = 3;
/// Most WFRs of a setting.
pub const WFRS: usize = 3;

/// How much may still go wrong in a run.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Default)]
pub struct Faults {
    /// Faults of all kinds together.
    pub in_all: u8,
    /// Messages that are lost.
    pub losses: u8,
    /// Messages that arrive once more.
    pub duplicates: u8,
    /// Timers that go off while what they wait for is on its way: a delay beyond what the timers allow for.
    pub delays: u8,
    /// Robots that fail.
    pub robots: u8,
    /// Path nodes that fail, each on the way between a robot and a WFR: until the next call, which makes a new tree, no
    /// message gets through between the two, and the robot does not find its way.
    pub nodes: u8,
}

/// Which messages can be lost.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Lossy {
    /// Any.
    All,
    /// Those that tell of a choice.
    Resb,
}

/// How long a robot holds a lease if it does not come.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Leases {
    /// Until it hears the WFR's next call.
    UntilCalled,
    /// Or until the WFR no longer counts on it under that call: longer than the WFR.
    UntilOver,
    /// Or for any time: it may let go earlier than the WFR.
    Any,
}

/// What is searched.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Setting {
    /// The rule of robots and WFRs.
    pub rule: Rule,
    /// Robots, at most [`ROBOTS`].
    pub robots: usize,
    /// WFRs, at most [`WFRS`].
    pub wfrs: usize,
    /// Events, each at one of the WFRs; the next at the same WFR when a robot has come.
    pub events: u8,
    /// Hops from each robot to each WFR: all combinations of 1 to this.
    pub max_hops: u16,
    /// What may go wrong.
    pub faults: Faults,
    /// Which messages may be lost.
    pub lossy: Lossy,
    /// How long robots hold leases.
    pub leases: Leases,
}

/// A message on its way.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum Message {
    /// A NOTICE, on its way to one of the robots.
    Notice(RobotId, Notice),
    /// A RESB, on its way to its robot.
    Resb(Resb),
    /// A robot's message, on its way to the WFR.
    Up(Upward),
}

impl Message {
    /// The robot that has sent it or is to get it.
    pub const fn robot(self) -> RobotId {
        match self {
            Self::Notice(robot, _) => robot,
            Self::Resb(resb) => resb.robot,
            Self::Up(upward) => upward.robot,
        }
    }

    /// The call that it is about.
    pub const fn call(self) -> Call {
        match self {
            Self::Notice(_, notice) => notice.call,
            Self::Resb(resb) => resb.call,
            Self::Up(upward) => upward.call,
        }
    }
}

/// A robot or a WFR, by its place.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum Actor {
    /// A robot.
    Robot(usize),
    /// A WFR.
    Wfr(usize),
}

/// What happens next.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum Action {
    /// Something happens at a WFR.
    Raise(usize),
    /// The message at this place arrives.
    Deliver(usize),
    /// A timer goes off.
    Expire(Actor),
    /// A robot reaches the WFR to which it is on its way.
    Arrive(usize),
    /// A robot's lease lapses before it comes.
    Lapse(usize),
    /// The message at this place is lost.
    Lose(usize),
    /// The message at this place will arrive once more.
    Duplicate(usize),
    /// A robot fails.
    FailRobot(usize),
    /// A path node between a robot and a WFR fails.
    FailNode {
        /// The robot.
        robot: usize,
        /// The WFR.
        wfr: usize,
    },
}

/// What the clauses MRC-1 to MRC-9 demand of a run.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum Demand {
    /// MRC-1.
    OneRobotForACall,
    /// MRC-2.
    OneCallForARobot,
    /// MRC-3.
    BestOfTheWindow,
    /// MRC-4.
    CountsOnConsent,
    /// MRC-5.
    IsServed,
    /// MRC-6.
    AsksAnew,
    /// MRC-7.
    AsksNearest,
    /// MRC-8.
    TakesWhatItAsksFor,
    /// MRC-9.
    TellsWhoAsked,
}

impl Demand {
    /// Every demand.
    pub const ALL: [Self; 9] = [
        Self::OneRobotForACall,
        Self::OneCallForARobot,
        Self::BestOfTheWindow,
        Self::CountsOnConsent,
        Self::IsServed,
        Self::AsksAnew,
        Self::AsksNearest,
        Self::TakesWhatItAsksFor,
        Self::TellsWhoAsked,
    ];

    /// The id of its clause.
    pub const fn clause(self) -> &'static str {
        match self {
            Self::OneRobotForACall => "MRC-1",
            Self::OneCallForARobot => "MRC-2",
            Self::BestOfTheWindow => "MRC-3",
            Self::CountsOnConsent => "MRC-4",
            Self::IsServed => "MRC-5",
            Self::AsksAnew => "MRC-6",
            Self::AsksNearest => "MRC-7",
            Self::TakesWhatItAsksFor => "MRC-8",
            Self::TellsWhoAsked => "MRC-9",
        }
    }

    /// What is not so when it is broken.
    pub const fn broken(self) -> &'static str {
        match self {
            Self::OneRobotForACall => "two robots are on their way for one call",
            Self::OneCallForARobot => "two WFRs count on one robot",
            Self::BestOfTheWindow => {
                "the robot chosen is not the best of those heard while the window was open"
            }
            Self::CountsOnConsent => "a WFR counts on a robot that has not taken its lease",
            Self::IsServed => "a WFR waits for ever, and a robot lives",
            Self::AsksAnew => "a robot has heard a new call, and its SBit is set",
            Self::AsksNearest => "a robot does not ask for the nearest call whose SBit is clear",
            Self::TakesWhatItAsksFor => "a robot has taken the lease of a call for which it did not ask",
            Self::TellsWhoAsked => {
                "a WFR has not told its choice to those that have sent MOVE, and to them alone"
            }
        }
    }
}

/// What an observer notes down beside the machines' own states, to see whether a demand is broken.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
struct Notes {
    /// The best MOVE of each WFR's latest call that arrived while its window was open, by the hops that it is away.
    best: [Option<Bid>; WFRS],
    /// The robots, a bit for each, whose MOVE of each WFR's latest call arrived while its window was open.
    heard: [u8; WFRS],
    /// The WFRs whose window is open.
    open: [bool; WFRS],
    /// The latest call of each WFR whose lease each robot has taken.
    taken: [[Option<Epoch>; WFRS]; ROBOTS],
    /// The demands, a bit for each, that something which happened has broken.
    broken: u16,
}

impl Notes {
    /// `demand` is not met.
    fn tell(&mut self, demand: Demand) {
        self.broken |= 1 << demand as u16;
    }
}

/// Robots, WFRs and what is between them.
#[derive(Clone, Debug)]
pub struct State {
    pub(super) hops: [[u16; WFRS]; ROBOTS],
    pub(super) robots: [Robot<WFRS>; ROBOTS],
    pub(super) wfrs: [Wfr<ROBOTS>; WFRS],
    pub(super) failed: [bool; ROBOTS],
    /// The call on whose tree a path node between robot and WFR has failed.
    pub(super) cut: [[Option<Epoch>; WFRS]; ROBOTS],
    /// Sorted.
    pub(super) network: Vec<Message>,
    pub(super) left: Faults,
    pub(super) events_left: u8,
    notes: Notes,
}

pub(super) const fn node(wfr: usize) -> NodeId {
    NodeId(wfr as u32)
}

pub(super) const fn place(id: NodeId) -> usize {
    id.0 as usize
}

pub(super) const fn robot_id(robot: usize) -> RobotId {
    RobotId(robot as u16)
}

impl Faults {
    /// At most `in_all` faults, of whichever kinds.
    pub const fn any(in_all: u8) -> Self {
        Self { in_all, losses: in_all, duplicates: in_all, delays: in_all, robots: in_all, nodes: in_all }
    }

    /// What it allows, in words.
    fn bound(self) -> String {
        let Self { in_all, losses, duplicates, delays, robots, nodes } = self;
        let kinds = [
            (losses, "losses"),
            (duplicates, "duplicates"),
            (delays, "delays"),
            (robots, "failed robots"),
            (nodes, "failed nodes"),
        ];
        let fewer = kinds.into_iter().filter(|&(most, _)| most < in_all);
        let fewer: Vec<String> = fewer.map(|(most, kind)| format!("at most {most} {kind}")).collect();
        let of_them = if fewer.is_empty() { String::new() } else { format!(" ({})", fewer.join(", ")) };
        format!("at most {in_all} fault{}{of_them}", if in_all == 1 { "" } else { "s" })
    }

    /// What is left of one kind.
    fn left(self, kind: impl Fn(&Self) -> u8) -> u8 {
        kind(&self).min(self.in_all)
    }

    /// One fault less.
    fn spend(&mut self, kind: impl Fn(&mut Self) -> &mut u8) {
        *kind(self) -= 1;
        self.in_all -= 1;
    }
}

impl Setting {
    /// What it covers, in words.
    pub fn bound(&self) -> String {
        let Self { rule: _, robots, wfrs, events, max_hops, faults, lossy, leases } = *self;
        let count =
            |number: usize, one: &str| format!("{number} {one}{}", if number == 1 { "" } else { "s" });
        let hops = match max_hops {
            1 => "all one hop away".to_owned(),
            2 => "1 or 2 hops".to_owned(),
            most => format!("1 to {most} hops"),
        };
        let mut words = vec![
            count(robots, "robot"),
            count(wfrs, "WFR"),
            count(events.into(), "event"),
            faults.bound(),
            hops,
        ];
        match lossy {
            Lossy::All => {}
            Lossy::Resb => words.push("of messages only RESBs lost".to_owned()),
        }
        match leases {
            Leases::UntilCalled => {}
            Leases::UntilOver => words.push("leases end no earlier than the WFR's".to_owned()),
            Leases::Any => words.push("leases end at any time".to_owned()),
        }
        words.join(", ")
    }

    /// The states in which nothing has happened, one for each combination of hops.
    pub fn starts(&self) -> Vec<State> {
        let ways = self.robots * self.wfrs;
        let all = u32::from(self.max_hops).pow(ways as u32);
        (0..all).map(|number| self.start(number)).collect()
    }

    /// Which of [`Self::starts`], one after the other, without the others.
    pub fn start(&self, mut number: u32) -> State {
        let mut hops = [[1; WFRS]; ROBOTS];
        for row in &mut hops[..self.robots] {
            for hops in &mut row[..self.wfrs] {
                *hops = 1 + (number % u32::from(self.max_hops)) as u16;
                number /= u32::from(self.max_hops);
            }
        }
        State {
            hops,
            robots: std::array::from_fn(|robot| Robot::new(self.rule, robot_id(robot))),
            wfrs: std::array::from_fn(|wfr| Wfr::new(self.rule, node(wfr))),
            failed: [false; ROBOTS],
            cut: [[None; WFRS]; ROBOTS],
            network: Vec::new(),
            left: self.faults,
            events_left: self.events,
            notes: Notes::default(),
        }
    }
}

impl State {
    /// A robot.
    pub const fn robot(&self, robot: usize) -> &Robot<WFRS> {
        &self.robots[robot]
    }

    /// A WFR.
    pub const fn wfr(&self, wfr: usize) -> &Wfr<ROBOTS> {
        &self.wfrs[wfr]
    }

    /// Hops from a robot to a WFR.
    pub const fn hops(&self, robot: usize, wfr: usize) -> u16 {
        self.hops[robot][wfr]
    }

    /// The messages on their way.
    pub fn network(&self) -> &[Message] {
        &self.network
    }

    /// Everything that can happen next in `setting`.
    pub fn actions(&self, setting: &Setting) -> Vec<Action> {
        let mut actions = Vec::new();
        let (robots, wfrs) = (0..setting.robots, 0..setting.wfrs);
        let can_expire = |actor: Actor| {
            self.timer_runs(actor) && (self.left.left(|left| left.delays) > 0 || self.is_due(setting, actor))
        };
        for (at, message) in self.network.iter().enumerate() {
            if at > 0 && self.network[at - 1] == *message {
                continue;
            }
            actions.push(Action::Deliver(at));
            let can_be_lost = match (setting.lossy, message) {
                (Lossy::All, _) | (Lossy::Resb, Message::Resb(_)) => true,
                (Lossy::Resb, Message::Notice(..) | Message::Up(_)) => false,
            };
            if can_be_lost && self.left.left(|left| left.losses) > 0 {
                actions.push(Action::Lose(at));
            }
            if self.left.left(|left| left.duplicates) > 0 {
                actions.push(Action::Duplicate(at));
            }
        }
        for wfr in wfrs.clone() {
            if self.events_left > 0 && !self.wfrs[wfr].is_waiting() {
                actions.push(Action::Raise(wfr));
            }
            if can_expire(Actor::Wfr(wfr)) {
                actions.push(Action::Expire(Actor::Wfr(wfr)));
            }
        }
        for robot in robots.filter(|&robot| !self.failed[robot]) {
            if self.comes_for(robot).is_some() {
                actions.push(Action::Arrive(robot));
            }
            if self.can_lapse(setting, robot) {
                actions.push(Action::Lapse(robot));
            }
            if can_expire(Actor::Robot(robot)) {
                actions.push(Action::Expire(Actor::Robot(robot)));
            }
            if self.left.left(|left| left.robots) > 0 {
                actions.push(Action::FailRobot(robot));
            }
            for wfr in wfrs.clone().filter(|_| self.left.left(|left| left.nodes) > 0) {
                let epoch = Some(self.wfrs[wfr].call().epoch);
                if self.wfrs[wfr].is_waiting() && self.cut[robot][wfr] != epoch {
                    actions.push(Action::FailNode { robot, wfr });
                }
            }
        }
        actions
    }

    /// Whether `action` is bound to happen sooner or later if nothing else does: no fault, and no event.
    pub fn is_bound_to_happen(&self, setting: &Setting, action: Action) -> bool {
        match action {
            Action::Deliver(_) | Action::Arrive(_) | Action::Lapse(_) => true,
            Action::Expire(actor) => self.is_due(setting, actor),
            Action::Raise(_)
            | Action::Lose(_)
            | Action::Duplicate(_)
            | Action::FailRobot(_)
            | Action::FailNode { .. } => false,
        }
    }

    /// Whether the timer of a robot that lives, or of a WFR, runs.
    pub fn timer_runs(&self, actor: Actor) -> bool {
        match actor {
            Actor::Robot(robot) => !self.failed[robot] && self.robots[robot].timer().is_some(),
            Actor::Wfr(wfr) => self.wfrs[wfr].timer().is_some(),
        }
    }

    /// Whether a timer that runs may go off without a fault: what it waits for is no longer on its way. A WFR waits for
    /// its messages and for robots that come to it; a robot for the messages between it and the WFR that it asks, and
    /// until the window of that call is closed.
    fn is_due(&self, setting: &Setting, actor: Actor) -> bool {
        match actor {
            Actor::Robot(robot) => self.robots[robot].timer().is_some_and(|timer| {
                let Call { wfr, epoch } = timer.call;
                let is_between =
                    |message: &Message| (message.robot(), message.call().wfr) == (robot_id(robot), wfr);
                let is_window_open = self.wfrs[place(wfr)].timer() == Some(WfrTimer::Window(epoch));
                !is_window_open && !self.network.iter().any(is_between)
            }),
            Actor::Wfr(wfr) => {
                let is_of_wfr = |call: Call| call.wfr == node(wfr);
                let comes = |robot| self.comes_for(robot).is_some_and(is_of_wfr);
                let is_on_its_way = |message: &Message| is_of_wfr(message.call());
                !self.network.iter().any(is_on_its_way) && !(0..setting.robots).any(comes)
            }
        }
    }

    /// The call for which a robot is on its way, if it finds it.
    pub(super) fn comes_for(&self, robot: usize) -> Option<Call> {
        match self.robots[robot].task() {
            Task::Leased { call }
                if !self.failed[robot] && self.cut[robot][place(call.wfr)] != Some(call.epoch) =>
            {
                Some(call)
            }
            Task::Free | Task::Asking { .. } | Task::Leased { .. } => None,
        }
    }

    fn can_lapse(&self, setting: &Setting, robot: usize) -> bool {
        let Task::Leased { call } = self.robots[robot].task() else { return false };
        let wfr = &self.wfrs[place(call.wfr)];
        match setting.leases {
            Leases::UntilCalled => false,
            Leases::UntilOver => wfr.call() != call || !wfr.is_waiting(),
            Leases::Any => true,
        }
    }

    /// The state after `action`, which must be one of [`Self::actions`].
    #[must_use]
    pub fn after(&self, setting: &Setting, action: Action) -> Self {
        let mut next = self.clone();
        match action {
            Action::Raise(wfr) => {
                next.events_left -= 1;
                next.turn_wfr(setting, wfr, None, Wfr::raise);
            }
            Action::Deliver(at) => {
                let message = next.network.remove(at);
                next.deliver(setting, message);
            }
            Action::Expire(actor) => {
                if !self.is_due(setting, actor) {
                    next.left.spend(|left| &mut left.delays);
                }
                next.expire(setting, actor);
            }
            Action::Arrive(robot) => {
                if let Task::Leased { call } = self.robots[robot].task() {
                    let wfr = place(call.wfr);
                    next.wfrs[wfr] = self.wfrs[wfr].reach(robot_id(robot));
                    next.turn_robot(robot, Robot::arrive);
                }
            }
            Action::Lapse(robot) => {
                if let Task::Leased { call } = self.robots[robot].task() {
                    next.turn_robot(robot, |robot| robot.lapse(call));
                }
            }
            Action::Lose(at) => {
                next.left.spend(|left| &mut left.losses);
                next.network.remove(at);
            }
            Action::Duplicate(at) => {
                next.left.spend(|left| &mut left.duplicates);
                next.network.insert(at, self.network[at]);
            }
            Action::FailRobot(robot) => {
                next.left.spend(|left| &mut left.robots);
                next.failed[robot] = true;
                next.network.retain(|message| match message {
                    Message::Notice(..) | Message::Resb(_) => message.robot() != robot_id(robot),
                    Message::Up(_) => true,
                });
            }
            Action::FailNode { robot, wfr } => {
                next.left.spend(|left| &mut left.nodes);
                let call = self.wfrs[wfr].call();
                next.cut[robot][wfr] = Some(call.epoch);
                next.network.retain(|message| match message {
                    Message::Notice(..) => true,
                    Message::Resb(_) | Message::Up(_) => {
                        (message.robot(), message.call()) != (robot_id(robot), call)
                    }
                });
            }
        }
        next.note(setting);
        next
    }

    fn deliver(&mut self, setting: &Setting, message: Message) {
        match message {
            Message::Notice(id, notice) => {
                let robot = usize::from(id.0);
                let wfr = notice.call.wfr;
                let known = self.robots[robot].request(wfr).map(|request| request.call.epoch);
                self.turn_robot(robot, |robot| robot.receive(Downward::Notice(notice)));
                let is_new = known.is_none_or(|known| known < notice.call.epoch);
                let is_served =
                    self.robots[robot].request(wfr).is_some_and(|request| request.served == Served::Yes);
                if is_new && is_served {
                    self.notes.tell(Demand::AsksAnew);
                }
            }
            Message::Resb(resb) => {
                let (robot, before) =
                    (usize::from(resb.robot.0), self.robots[usize::from(resb.robot.0)].task());
                self.turn_robot(robot, |robot| robot.receive(Downward::Resb(resb)));
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
                    self.notes.tell(Demand::TakesWhatItAsksFor);
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
                    self.turn_robot(robot, |robot| robot.expire(timer));
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

    fn turn_robot(&mut self, robot: usize, turn: impl FnOnce(Robot<WFRS>) -> (Robot<WFRS>, Option<Upward>)) {
        let before = self.robots[robot].task();
        let (next, sent) = turn(self.robots[robot]);
        self.robots[robot] = next;
        let rank = |call: Call| (self.hops[robot][place(call.wfr)], call.wfr.0);
        let open = || next.requests().filter(|request| request.served == Served::No);
        let nearest = open().map(|request| request.call).min_by_key(|&call| rank(call));
        let has_strayed = match (before, next.task()) {
            (Task::Asking { call: before, .. }, Task::Asking { call, .. }) if before == call => {
                open().all(|request| request.call.wfr != call.wfr)
            }
            (_, Task::Asking { call, .. }) => nearest != Some(call),
            (_, Task::Free) => nearest.is_some(),
            (_, Task::Leased { .. }) => false,
        };
        if has_strayed {
            self.notes.tell(Demand::AsksNearest);
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
        turn: impl FnOnce(Wfr<ROBOTS>) -> (Wfr<ROBOTS>, Sent<ROBOTS>),
    ) {
        let before = self.wfrs[wfr];
        let (next, sent) = turn(before);
        self.wfrs[wfr] = next;
        let sent: Vec<Message> = match sent {
            Sent::Nothing => Vec::new(),
            Sent::One(resb) => vec![Message::Resb(resb)],
            Sent::All(resbs) => resbs.into_iter().flatten().map(Message::Resb).collect(),
            Sent::Notice(notice) => {
                self.notes.open[wfr] = true;
                (self.notes.best[wfr], self.notes.heard[wfr]) = (None, 0);
                let to = |robot: usize| {
                    // The last sender on the way is one hop nearer to the WFR than the robot.
                    let hops = self.hops[robot][wfr] - 1;
                    Message::Notice(robot_id(robot), Notice { hops, ..notice })
                };
                (0..setting.robots).map(to).collect()
            }
        };
        self.judge_telling(wfr, (before.phase(), bidder), &sent);
        self.send(sent);
    }

    /// Looks whether a WFR has told its choice, to whom it is to tell it and to nobody else.
    fn judge_telling(&mut self, wfr: usize, (before, bidder): (Phase, Option<RobotId>), sent: &[Message]) {
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
        let resb = |message: &Message| if let Message::Resb(resb) = message { Some(*resb) } else { None };
        let told = sent.iter().filter_map(resb).fold(0, |told, resb| told | bit(Some(resb.robot)));
        let is_right = sent.iter().filter_map(resb).all(|resb| (resb.call, resb.chosen) == (call, chosen));
        if due & !told != 0 || told & !may_be_told != 0 || !is_right {
            self.notes.tell(Demand::TellsWhoAsked);
        }
    }

    fn send(&mut self, messages: impl IntoIterator<Item = Message>) {
        for message in messages {
            if self.gets_through(message) {
                self.network.push(message);
            }
        }
        self.network.sort_unstable();
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
            if !setting.rule.has(Condition::Window) && !self.network.iter().any(is_of_wfr) {
                self.notes.open[wfr] = false;
            }
            if !self.wfrs[wfr].is_waiting() {
                (self.notes.open[wfr], self.notes.best[wfr]) = (false, None);
            }
            if !self.notes.open[wfr] {
                self.notes.heard[wfr] = 0;
            }
            for robot in 0..setting.robots {
                let task = match self.robots[robot].task() {
                    Task::Free => None,
                    Task::Asking { call, .. } | Task::Leased { call } => Some(call),
                };
                let known = self.robots[robot].request(node(wfr)).map(|request| request.call);
                let is_of_use = |epoch: Epoch| {
                    let cut = Call { epoch, ..call };
                    cut == call
                        || task == Some(cut)
                        || known == Some(cut)
                        || self.network.iter().any(|message| message.call() == cut)
                };
                self.cut[robot][wfr] = self.cut[robot][wfr].filter(|&epoch| is_of_use(epoch));
            }
        }
    }

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

    /// This state in bytes, epochs by their order among those of the same WFR: equal for states that differ in no other
    /// way.
    pub fn key(&self) -> Box<[u8]> {
        let mut writer = Writer { bytes: Vec::with_capacity(160), epochs: Vec::with_capacity(48) };
        self.write(&mut writer);
        writer.ranked()
    }

    fn write(&self, out: &mut Writer) {
        out.bytes(self.hops.as_flattened().iter().map(|&hops| hops as u8));
        for (robot, machine) in self.robots.iter().enumerate() {
            out.byte(u8::from(self.failed[robot]));
            for request in machine.requests() {
                out.byte(1 + u8::from(request.served == Served::Yes));
                out.call(request.call);
            }
            out.byte(0);
            for wfr in 0..WFRS {
                out.epoch(wfr, self.cut[robot][wfr]);
                let current = self.wfrs[wfr].call().epoch;
                out.byte(u8::from(self.notes.taken[robot][wfr] == Some(current)));
            }
            match machine.task() {
                Task::Free => out.byte(0),
                Task::Asking { call, repeats_left } => {
                    out.bytes([1, repeats_left]);
                    out.call(call);
                }
                Task::Leased { call } => {
                    out.byte(2);
                    out.call(call);
                }
            }
        }
        let bid = |bid: Option<Bid>| bid.map_or(0, |bid| 1 + bid.robot.0 as u8);
        for (wfr, machine) in self.wfrs.iter().enumerate() {
            out.call(machine.call());
            out.bytes([u8::from(self.notes.open[wfr]), bid(self.notes.best[wfr]), self.notes.heard[wfr]]);
            out.byte(machine.asked().map(|robot| 1 << robot.0).sum());
            match machine.phase() {
                Phase::Idle => out.byte(0),
                Phase::Collecting { best } => out.bytes([1, bid(best)]),
                Phase::Offered { choice, repeats_left } => out.bytes([2, bid(Some(choice)), repeats_left]),
                Phase::Leased { choice } => out.bytes([3, bid(Some(choice))]),
                Phase::Rescued { by } => out.bytes([4, by.0 as u8]),
            }
        }
        let Faults { in_all, losses, duplicates, delays, robots, nodes } = self.left;
        out.bytes([in_all, losses, duplicates, delays, robots, nodes, self.events_left]);
        out.bytes(self.notes.broken.to_be_bytes());
        for message in &self.network {
            let kind = match message {
                Message::Notice(..) => 0,
                Message::Resb(resb) => 1 + resb.chosen.map_or(0, |robot| 1 + robot.0 as u8),
                Message::Up(Upward { word: Word::Move { .. }, .. }) => 100,
                Message::Up(Upward { word: Word::Accept, .. }) => 101,
                Message::Up(Upward { word: Word::Decline, .. }) => 102,
            };
            out.bytes([kind, message.robot().0 as u8]);
            out.call(message.call());
        }
    }
}

impl PartialEq for State {
    fn eq(&self, other: &Self) -> bool {
        self.key() == other.key()
    }
}

impl Eq for State {}

impl Hash for State {
    fn hash<H: Hasher>(&self, hasher: &mut H) {
        self.key().hash(hasher);
    }
}

/// Bytes among which the epochs stay marked until all are known.
struct Writer {
    bytes: Vec<u8>,
    epochs: Vec<(usize, usize, Epoch)>,
}

impl Writer {
    fn byte(&mut self, byte: u8) {
        self.bytes.push(byte);
    }

    fn bytes(&mut self, bytes: impl IntoIterator<Item = u8>) {
        self.bytes.extend(bytes);
    }

    fn call(&mut self, call: Call) {
        self.byte(call.wfr.0 as u8);
        self.epoch(place(call.wfr), Some(call.epoch));
    }

    /// A byte that is 0 for no epoch, and otherwise will be the epoch's place among those of the WFR.
    fn epoch(&mut self, wfr: usize, epoch: Option<Epoch>) {
        if let Some(epoch) = epoch {
            self.epochs.push((self.bytes.len(), wfr, epoch));
        }
        self.byte(0);
    }

    fn ranked(mut self) -> Box<[u8]> {
        self.epochs.sort_unstable_by_key(|&(_, wfr, epoch)| (wfr, epoch));
        let mut last = None;
        for &(at, wfr, epoch) in &self.epochs {
            let rank = match last {
                Some((of, other, rank)) if of == wfr => rank + u8::from(other < epoch),
                Some(_) | None => 1,
            };
            self.bytes[at] = rank;
            last = Some((wfr, epoch, rank));
        }
        self.bytes.into_boxed_slice()
    }
}

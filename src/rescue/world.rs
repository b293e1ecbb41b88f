//! Everybody on the air: nodes that broadcast, carry messages and guide, WFRs that call and choose, robots that ask and go.
//! Each reacts by its kernel machine; here is who hears whom, which timer runs how long, and where the robots are.

use tautline_kernel::broadcast::{NodeId, Stage};
use tautline_kernel::choice::Source;
use tautline_kernel::homing::{Conduct, Guide, Nav, Order, ReqNav, Stage as Leg};
use tautline_kernel::rescue::{
    Bid, Call, Condition, Downward, Epoch, Hop, Notice, Phase, Relay, Request, Resb, Robot, RobotId,
    RobotTimer, Sent, Task, Upward, Wfr, WfrTimer, Word,
};
use tautline_proofs::engine::Seeded;
use tautline_proofs::rescue::Demand;

use super::agenda::Agenda;
use super::event::millimetres;
use super::judge::{Judge, Seen};
use super::letters::{ANSWER_WAIT_NS, Content, Letter, Letters};
use super::pace::{self, ASK_NS, SIGNAL_NS, TRY_NS};
use super::plan::Plan;
use super::rover::{Onward, Rover, Way};
use super::timers::Timers;
use super::{Event, Fate, Journey, Logged, MAX_ROBOTS, MAX_WFRS, Problem, Report, Setting, Spread};
use crate::homing::{Signal, Walker, hops, shortest_m};
use crate::radio::{Air, Broadcast, Heard, Link, Protocol, Reach, run};

/// Nothing that would happen later happens: six hours for each event. A WFR to which nobody can come calls until then.
const HORIZON_NS: u64 = 6 * 3_600 * 1_000_000_000;

/// How long a robot serves at a WFR before it is free again, which the paper leaves open: ten seconds.
const SERVICE_NS: u64 = 10_000_000_000;

/// Ways back that a path node remembers.
const ROUTES: usize = MAX_ROBOTS * MAX_WFRS;

/// The rescue of `setting` and `seed`.
///
/// # Errors
/// A [`Problem`] if the setting makes none.
pub fn rescue(setting: &Setting, seed: u64) -> Result<Report, Problem> {
    let plan = setting.plan(&mut Seeded::new(seed, 0))?;
    plan.rescue(&mut Seeded::new(seed, 1))
}

impl Plan {
    /// The rescue, as it goes with these answers.
    pub(super) fn rescue(&self, chance: &mut dyn Source) -> Result<Report, Problem> {
        let mut world = World::new(self);
        let begin = world.begin();
        let air = run(&self.network, self.channel, &self.faults, &mut world, &begin, chance)?;
        Ok(world.report(air))
    }
}

/// What is on the air.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Message {
    /// NOTICE.
    Notice(tautline_kernel::broadcast::Notice),
    /// MOVE, RESB, or a robot's answer to it, for one hop.
    Letter(Letter),
    /// A letter has arrived: its sender, and its number.
    Receipt { to: Hop, frame: u32 },
    /// A robot asks for a signal.
    ReqNav(ReqNav),
    /// A path node's signal, as it begins.
    Nav(Nav),
}

/// What is due at a station.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Duty {
    /// It fails.
    Fail,
    /// Something happens at a WFR.
    Raise(usize),
    /// A node's wait before it forwards is over, for a call of this WFR.
    Forward(usize),
    /// A letter, by its number, is repeated unless it has been acknowledged.
    Repeat(u32),
    /// T_x has passed.
    Quiet,
    /// A WFR's timer.
    Wfr(usize, WfrTimer),
    /// A robot's timer.
    Robot(RobotTimer),
    /// A robot's lease lapses, unless it has been prolonged: the number of its timers so far.
    Lease(Call, u32),
    /// A robot has waited for NAV in vain, in this leg of its journey.
    NoSignal(u32),
    /// A robot asks again for the signal that it waits for or follows, in this leg of its journey.
    AskOn(u32),
    /// A robot has turned its antenna or gone a little, in this leg of its journey.
    GoOn(u32),
    /// A robot has served.
    Served(Call),
}

/// What a node remembers beside the broadcasts.
struct Sensor {
    has_failed: bool,
    guide: Guide,
    /// Until when it signals or keeps silent.
    until_ns: u64,
    /// Once it has carried a message.
    relay: Option<Box<Relay<ROUTES>>>,
}

/// An event that has happened at a WFR.
struct Happening {
    at_ns: u64,
    /// The epoch of the first call for it.
    epoch: Epoch,
    /// What became of that call, once there was another.
    spread: Option<Spread>,
    /// How many robots have come.
    visits: u32,
}

struct World<'a> {
    plan: &'a Plan,
    timers: Vec<Timers>,
    /// Of the nodes, then of the robots.
    agendas: Vec<Agenda<Duty, Message>>,
    /// Likewise.
    letters: Vec<Letters>,
    sensors: Vec<Sensor>,
    rovers: Vec<Rover>,
    wfrs: Vec<Wfr<MAX_ROBOTS>>,
    broadcasts: Vec<Broadcast<'a>>,
    /// What has happened so far, WFR by WFR.
    happenings: Vec<Vec<Happening>>,
    journeys: Vec<Journey>,
    judge: Judge,
    log: Vec<Logged>,
}

impl<'a> World<'a> {
    fn new(plan: &'a Plan) -> Self {
        let stations = plan.network.nodes() + plan.robots.len();
        let leg_ns = pace::leg_ns(&plan.equipment, plan.radio.reach_m(), plan.noise_db);
        let sensor = || Sensor { has_failed: false, guide: Guide::IDLE, until_ns: 0, relay: None };
        Self {
            plan,
            timers: plan.wfrs.iter().map(|wfr| Timers::new(wfr.depth, leg_ns)).collect(),
            agendas: (0..stations).map(|_| Agenda::new()).collect(),
            letters: (0..stations).map(|_| Letters::default()).collect(),
            sensors: (0..plan.network.nodes()).map(|_| sensor()).collect(),
            rovers: (0..)
                .zip(&plan.robots)
                .map(|(robot, place)| Rover::new(plan.rule, RobotId(robot), place.at))
                .collect(),
            wfrs: plan.wfrs.iter().map(|wfr| Wfr::new(plan.rule, wfr.node)).collect(),
            broadcasts: plan
                .wfrs
                .iter()
                .map(|wfr| Broadcast::new(&plan.network, plan.broadcast, wfr.node))
                .collect(),
            happenings: plan.wfrs.iter().map(|_| Vec::new()).collect(),
            journeys: Vec::new(),
            judge: Judge::new(plan.robots.len(), plan.wfrs.len()),
            log: Vec::new(),
        }
    }

    /// Puts what is due from the start, and returns when the stations' timers go off first.
    fn begin(&mut self) -> Vec<(NodeId, u64)> {
        let plan = self.plan;
        for (wfr, caller) in plan.wfrs.iter().enumerate() {
            self.put(caller.node, caller.at_ns, Duty::Raise(wfr));
        }
        for &(node, at_ns) in &plan.failing {
            self.put(node, at_ns, Duty::Fail);
        }
        for (robot, place) in plan.robots.iter().enumerate() {
            if let Some(at_ns) = place.fails_ns {
                self.put(self.station(robot), at_ns, Duty::Fail);
            }
        }
        let first = |(number, agenda): (u32, &mut Agenda<Duty, Message>)| {
            agenda.wind(0).map(|at_ns| (NodeId(number), at_ns))
        };
        (0..).zip(&mut self.agendas).filter_map(first).collect()
    }

    /// The number under which a robot is on the air.
    fn station(&self, robot: usize) -> NodeId {
        NodeId((self.plan.network.nodes() + robot) as u32)
    }

    /// Which robot is on the air under this number; a node is none.
    fn robot(&self, at: NodeId) -> Option<usize> {
        (at.0 as usize).checked_sub(self.plan.network.nodes())
    }

    fn put(&mut self, at: NodeId, at_ns: u64, duty: Duty) {
        if at_ns <= HORIZON_NS * self.plan.events() as u64 {
            self.agendas[at.0 as usize].put(at_ns, duty);
        }
    }

    fn send(&mut self, at: NodeId, message: Message) {
        self.agendas[at.0 as usize].send(message);
    }

    fn tell(&mut self, at_ns: u64, event: Event) {
        self.log.push(Logged { at_ns, event });
    }

    fn has_failed(&self, at: NodeId) -> bool {
        match self.robot(at) {
            None => self.sensors[at.0 as usize].has_failed,
            Some(robot) => self.rovers[robot].has_failed,
        }
    }

    fn look(&mut self, now_ns: u64) {
        let seen: Vec<Seen<'_>> = self
            .rovers
            .iter()
            .map(|rover| Seen { machine: &rover.machine, has_failed: rover.has_failed })
            .collect();
        self.judge.look(&seen, &self.wfrs, now_ns);
    }

    fn node_hears(&mut self, at: NodeId, heard: Heard<Message>, chance: &mut dyn Source) {
        let Heard { message, distance_um, now_ns } = heard;
        match message {
            Message::Notice(message) => {
                let Some(wfr) = self.plan.wfr(message.source) else { return };
                let heard = Heard { message, distance_um, now_ns };
                if let Some(at_ns) = self.broadcasts[wfr].receive(at, heard, chance) {
                    self.put(at, at_ns, Duty::Forward(wfr));
                }
            }
            Message::Letter(letter) => match self.open(at, letter) {
                Some(Content::Up(message)) => self.carry(at, message, letter.from, now_ns),
                Some(Content::Down(resb)) => self.send_down(at, resb, now_ns),
                None => {}
            },
            Message::Receipt { to, frame } => self.close(at, to, frame),
            Message::ReqNav(request) => self.guide(at, request, now_ns),
            Message::Nav(_) => {
                let guide = self.sensors[at.0 as usize].guide;
                self.conduct(at, guide.overhear(), now_ns);
            }
        }
    }

    /// Something for this node to send on, or for the WFR that it is.
    fn carry(&mut self, at: NodeId, message: Upward, from: Hop, now_ns: u64) {
        let Some(wfr) = self.plan.wfr(message.call.wfr) else { return };
        let is_goal = message.call.wfr == at;
        let parent = if is_goal {
            Some(at)
        } else {
            self.place_in_tree(at, wfr, message.call.epoch).map(|nav| nav.parent)
        };
        let Some(parent) = parent else { return };
        let relay = &mut self.sensors[at.0 as usize].relay;
        let known = relay.as_deref().copied().unwrap_or_else(|| Relay::new(at));
        let (known, onward) = known.up(message, from, parent);
        *relay = Some(Box::new(known));
        if is_goal {
            if let Word::Move { hops } = message.word
                && message.call == self.wfrs[wfr].call()
            {
                self.judge.bids(wfr, Bid { hops, robot: message.robot });
            }
            self.turn_wfr(wfr, now_ns, |machine| machine.receive(message));
        } else if let Some(message) = onward {
            self.post(at, Hop::Node(message.parent), Content::Up(message), now_ns);
        }
    }

    /// Who a station is to its neighbours.
    fn hop(&self, at: NodeId) -> Hop {
        self.robot(at).map_or(Hop::Node(at), |robot| Hop::Robot(self.rovers[robot].machine.id()))
    }

    fn post(&mut self, at: NodeId, to: Hop, content: Content, now_ns: u64) {
        let from = self.hop(at);
        let letter = self.letters[at.0 as usize].write(from, to, content);
        self.send(at, Message::Letter(letter));
        self.put(at, now_ns + ANSWER_WAIT_NS, Duty::Repeat(letter.frame));
    }

    /// What is in a letter, if it is for this station, and new.
    fn open(&mut self, at: NodeId, letter: Letter) -> Option<Content> {
        if letter.to != self.hop(at) {
            return None;
        }
        self.send(at, Message::Receipt { to: letter.from, frame: letter.frame });
        self.letters[at.0 as usize].is_news(&letter).then_some(letter.content)
    }

    fn close(&mut self, at: NodeId, to: Hop, frame: u32) {
        if to == self.hop(at) {
            self.letters[at.0 as usize].close(frame);
        }
    }

    /// A node's place in the tree of a call, if it is one of its path nodes, or the WFR.
    fn place_in_tree(&self, at: NodeId, wfr: usize, epoch: Epoch) -> Option<Nav> {
        let node = self.broadcasts[wfr].nodes()[at.0 as usize];
        let is_path_node = node.stage() == Stage::Forwarded && node.event() == Some(epoch.0);
        let hops = node.hops().filter(|_| is_path_node)?;
        Some(Nav { wfr: self.plan.wfrs[wfr].node, node: at, hops, parent: node.parent().unwrap_or(at) })
    }

    fn send_down(&mut self, at: NodeId, resb: Resb, now_ns: u64) {
        let relay = self.sensors[at.0 as usize].relay.as_deref();
        if let Some(to) = relay.and_then(|relay| relay.down(resb)) {
            self.post(at, to, Content::Down(resb), now_ns);
        }
    }

    fn guide(&mut self, at: NodeId, request: ReqNav, now_ns: u64) {
        let Some(wfr) = self.plan.wfr(request.wfr) else { return };
        let epoch = self.broadcasts[wfr].nodes()[at.0 as usize].event();
        // Whoever comes to a WFR that is rescued comes in vain: it answers a MOVE with nobody's name, and a REQNAV not at
        // all.
        let is_over = self.wfrs[wfr].call().wfr == at
            && !self.wfrs[wfr].is_waiting()
            && self.plan.rule.has(Condition::AnswersAgain);
        let own = epoch.filter(|_| !is_over).and_then(|epoch| self.place_in_tree(at, wfr, Epoch(epoch)));
        let guide = self.sensors[at.0 as usize].guide.request(request, at, own);
        match guide.conduct {
            Conduct::Signals(nav) if request.node == at => {
                self.sensors[at.0 as usize].guide = Guide::IDLE;
                self.conduct(at, guide, now_ns);
                self.send(at, Message::Nav(nav));
            }
            Conduct::Signals(_) | Conduct::Silent | Conduct::Idle => self.conduct(at, guide, now_ns),
        }
    }

    /// What a node begins to do lasts for T_x from now. A silence that has begun is not prolonged: two robots could else
    /// keep each other's guides silent for ever.
    fn conduct(&mut self, at: NodeId, guide: Guide, now_ns: u64) {
        let sensor = &mut self.sensors[at.0 as usize];
        if sensor.guide != guide {
            let until_ns = now_ns + SIGNAL_NS;
            (sensor.guide, sensor.until_ns) = (guide, until_ns);
            self.put(at, until_ns, Duty::Quiet);
        }
    }

    fn robot_hears(&mut self, robot: usize, message: Message, now_ns: u64) {
        let station = self.station(robot);
        match message {
            Message::Notice(notice) => {
                let notice = Notice::from(notice);
                let Some(wfr) = self.plan.wfr(notice.call.wfr) else { return };
                let known = |rover: &Rover| rover.machine.request(notice.call.wfr).copied();
                let before = known(&self.rovers[robot]).map(|request| request.call.epoch);
                let place = self.log.len();
                self.turn_robot(robot, now_ns, |machine| machine.receive(Downward::Notice(notice)));
                let Some(after) = known(&self.rovers[robot]) else { return };
                if before.is_none_or(|epoch| epoch < notice.call.epoch) {
                    let Epoch(epoch) = notice.call.epoch;
                    self.judge.hears(wfr, after.served, now_ns);
                    let event = Event::Hears { robot: robot + 1, wfr: wfr + 1, epoch, hops: after.hops };
                    // Before what it makes the robot do.
                    self.log.insert(place, Logged { at_ns: now_ns, event });
                }
            }
            Message::Letter(letter) => match self.open(station, letter) {
                Some(Content::Down(resb)) => {
                    self.turn_robot(robot, now_ns, |machine| machine.receive(Downward::Resb(resb)));
                }
                Some(Content::Up(_)) | None => {}
            },
            Message::Receipt { to, frame } => self.close(station, to, frame),
            Message::Nav(nav) => {
                if let Some(way) = &mut self.rovers[robot].way
                    && matches!(way.walker.stage(), Leg::Asking { .. })
                {
                    way.walker.hear(nav);
                    if way.walker.guide().is_some() {
                        let leg = way.leg;
                        self.put(station, now_ns, Duty::GoOn(leg));
                    }
                }
            }
            Message::ReqNav(_) => {}
        }
    }

    fn turn_wfr(
        &mut self,
        wfr: usize,
        now_ns: u64,
        turn: impl FnOnce(Wfr<MAX_ROBOTS>) -> (Wfr<MAX_ROBOTS>, Sent<MAX_ROBOTS>),
    ) {
        let (before, node) = (self.wfrs[wfr], self.plan.wfrs[wfr].node);
        let (after, sent) = turn(before);
        self.wfrs[wfr] = after;
        let (Epoch(epoch), hops) =
            (after.call().epoch, choice(after.phase()).map_or(0, |choice| choice.hops));
        match sent {
            Sent::Nothing => {}
            Sent::Notice(_) => self.call(wfr, now_ns),
            Sent::One(resb) => self.send_down(node, resb, now_ns),
            Sent::All(resbs) => {
                resbs.into_iter().flatten().for_each(|resb| self.send_down(node, resb, now_ns));
            }
        }
        if choice(after.phase()) != choice(before.phase())
            && let Some(choice) = choice(after.phase())
        {
            self.tell(now_ns, Event::Chooses { wfr: wfr + 1, epoch, robot: 1 + usize::from(choice.robot.0) });
        }
        if let Phase::Leased { choice } = after.phase()
            && after.phase() != before.phase()
        {
            self.tell(
                now_ns,
                Event::CountsOn { wfr: wfr + 1, epoch, robot: 1 + usize::from(choice.robot.0) },
            );
        }
        if after.timer() != before.timer()
            && let Some(timer) = after.timer()
        {
            self.put(node, now_ns + self.timers[wfr].wfr_ns(timer, hops), Duty::Wfr(wfr, timer));
        }
        self.look(now_ns);
    }

    /// A WFR's NOTICE, under whichever epoch, is its next event to the nodes.
    fn call(&mut self, wfr: usize, now_ns: u64) {
        let node = self.plan.wfrs[wfr].node;
        let Epoch(epoch) = self.wfrs[wfr].call().epoch;
        self.measure_spread(wfr);
        self.judge.calls(wfr);
        self.tell(now_ns, Event::Calls { wfr: wfr + 1, node: node.0, epoch });
        if let Some(notice) = self.broadcasts[wfr].originate() {
            self.send(node, Message::Notice(notice));
        }
    }

    /// Something happens at a WFR.
    fn raise(&mut self, wfr: usize, now_ns: u64) {
        let event = self.happenings[wfr].len();
        if event > 0 {
            self.tell(now_ns, Event::Recurs { wfr: wfr + 1, event: event + 1 });
        }
        self.judge.happens(wfr, event);
        self.turn_wfr(wfr, now_ns, Wfr::raise);
        let epoch = self.wfrs[wfr].call().epoch;
        self.happenings[wfr].push(Happening { at_ns: now_ns, epoch, spread: None, visits: 0 });
    }

    /// How far the first call for the latest event so far has come: to be asked before another call.
    fn measure_spread(&mut self, wfr: usize) {
        let Some(Happening { epoch, spread, .. }) = self.happenings[wfr].last_mut() else { return };
        spread.get_or_insert_with(|| {
            let Reach { reached, rebroadcasts } = self.broadcasts[wfr].reach(epoch.0);
            let component = self.plan.network.component(self.plan.wfrs[wfr].node) as u32;
            Spread { reached, component, rebroadcasts }
        });
    }

    fn turn_robot(
        &mut self,
        robot: usize,
        now_ns: u64,
        turn: impl FnOnce(Robot<MAX_WFRS>) -> (Robot<MAX_WFRS>, Option<Upward>),
    ) {
        let before = self.rovers[robot].machine;
        let (after, sent) = turn(before);
        self.rovers[robot].machine = after;
        let station = self.station(robot);
        if let Some(message) = sent {
            self.say(robot, message, now_ns);
            self.post(station, Hop::Node(message.parent), Content::Up(message), now_ns);
        }
        if after.timer() != before.timer()
            && let Some(timer) = after.timer()
            && let Some(wfr) = self.plan.wfr(timer.call.wfr)
        {
            let wait_ns = self.timers[wfr].resb_ns(timer.call.epoch);
            self.put(station, now_ns + wait_ns, Duty::Robot(timer));
        }
        let lease = |machine: &Robot<MAX_WFRS>| match machine.task() {
            Task::Leased { call } => Some(call),
            Task::Free | Task::Asking { .. } => None,
        };
        if lease(&after) != lease(&before) {
            self.stop(robot, now_ns);
            if let Some(call) = lease(&after) {
                self.set_out(robot, call, now_ns);
            }
        }
        self.look(now_ns);
    }

    /// What a robot has to say, for the log; an answer that it comes prolongs its lease.
    fn say(&mut self, robot: usize, message: Upward, now_ns: u64) {
        let Some(wfr) = self.plan.wfr(message.call.wfr) else { return };
        let Epoch(epoch) = message.call.epoch;
        match message.word {
            Word::Move { hops } => {
                let bid = &mut self.rovers[robot].bid;
                let most =
                    bid.filter(|&(call, _)| call == message.call).map_or(hops, |(_, most)| most.max(hops));
                *bid = Some((message.call, most));
                self.tell(now_ns, Event::Asks { robot: robot + 1, wfr: wfr + 1, epoch, hops });
            }
            Word::Decline => self.tell(now_ns, Event::Declines { robot: robot + 1, wfr: wfr + 1, epoch }),
            Word::Accept => {
                let rover = &mut self.rovers[robot];
                rover.leases += 1;
                let hops = rover.bid.filter(|&(call, _)| call == message.call).map_or(0, |(_, hops)| hops);
                let lapse = Duty::Lease(message.call, rover.leases);
                self.put(self.station(robot), now_ns + self.timers[wfr].robot_lease_ns(hops), lapse);
            }
        }
    }

    fn set_out(&mut self, robot: usize, call: Call, now_ns: u64) {
        let Some(wfr) = self.plan.wfr(call.wfr) else { return };
        let rover = &self.rovers[robot];
        let Some(&Request { parent, hops, .. }) = rover.machine.request(call.wfr) else { return };
        let (start, id) = (rover.at, rover.machine.id());
        let walker = Walker::new(self.plan.equipment, start, id, call.wfr, (parent, hops));
        self.rovers[robot].way = Some(Way { call, wfr, walker, leg: 0, passed: None, has_come: false });
        self.judge.takes(robot, wfr, call.epoch);
        self.tell(
            now_ns,
            Event::SetsOut { robot: robot + 1, wfr: wfr + 1, epoch: call.epoch.0, at: millimetres(start) },
        );
        self.begin_leg(robot, now_ns);
    }

    /// A robot has no longer the lease that it had.
    fn stop(&mut self, robot: usize, now_ns: u64) {
        let rover = &mut self.rovers[robot];
        let Some(Way { call, wfr, walker, has_come, .. }) = rover.way.take() else { return };
        if !has_come {
            rover.moved_m += walker.walked_m();
            let at = millimetres(rover.at);
            self.tell(now_ns, Event::LetsGo { robot: robot + 1, wfr: wfr + 1, epoch: call.epoch.0, at });
        }
    }

    /// Asks the next node for its signal, or the same once more, and says what comes of it if there is none to be asked.
    fn begin_leg(&mut self, robot: usize, now_ns: u64) {
        let station = self.station(robot);
        let rover = &mut self.rovers[robot];
        let at = millimetres(rover.at);
        let Some(way) = &mut rover.way else { return };
        rover.legs += 1;
        way.leg = rover.legs;
        let leg = way.leg;
        match way.walker.stage() {
            Leg::Asking { .. } => {
                self.put(station, now_ns, Duty::AskOn(leg));
                self.put(station, now_ns + TRY_NS, Duty::NoSignal(leg));
            }
            Leg::Scanning { .. } | Leg::Walking { .. } => {}
            Leg::Arrived => self.arrive(robot, now_ns),
            Leg::Lost => self.tell(now_ns, Event::LosesItsWay { robot: robot + 1, at }),
        }
    }

    /// Asks the node whose signal a robot waits for or follows; the paper has it do so continuously.
    fn ask_on(&mut self, robot: usize, now_ns: u64, chance: &mut dyn Source) {
        let station = self.station(robot);
        let rover = &self.rovers[robot];
        let Some(way) = &rover.way else { return };
        let asked = match way.walker.stage() {
            Leg::Asking { node } => Some(node),
            Leg::Scanning { .. } | Leg::Walking { .. } | Leg::Arrived | Leg::Lost => way.walker.guide(),
        };
        let Some(node) = asked else { return };
        let (leg, request) = (way.leg, ReqNav { wfr: way.call.wfr, robot: rover.machine.id(), node });
        // Not all at the same time: robots that ask in turn could else silence each other's nodes for ever.
        let wait_ns = ASK_NS / 2 + u64::from(chance.pick(ASK_NS as u32));
        self.send(station, Message::ReqNav(request));
        self.put(station, now_ns + wait_ns, Duty::AskOn(leg));
    }

    /// Points the antenna or walks a step, as ordered, and comes back when that is done.
    fn go_on(&mut self, robot: usize, now_ns: u64, chance: &mut dyn Source) {
        let station = self.station(robot);
        let rover = &mut self.rovers[robot];
        let Some(way) = &mut rover.way else { return };
        match way.walker.order() {
            Order::Point(_) | Order::Walk(_) => {}
            Order::Ask(_) | Order::Stop => return self.begin_leg(robot, now_ns),
        }
        let sends = |node: &NodeId| {
            let sensor = &self.sensors[node.0 as usize];
            let is_for = |nav: Nav| nav.wfr == way.call.wfr;
            !sensor.has_failed && matches!(sensor.guide.conduct, Conduct::Signals(nav) if is_for(nav))
        };
        let guide = way.walker.guide();
        let signal = guide.filter(sends).map(|node| self.plan.signal(node, rover.place));
        let (hops, places) = (way.walker.hops(), way.walker.trail().len());
        let takes_ns = way.walker.act(&self.plan.field, signal, chance);
        let (to, done_ns, leg) = (way.walker.at(), now_ns + takes_ns, way.leg);
        let onward = if way.walker.trail().len() > places { Onward::Turned } else { Onward::Straight };
        let reached = guide.filter(|_| way.walker.hops() < hops);
        rover.place = reached.or(rover.place);
        let is_news = |node: &NodeId| *node != way.call.wfr && way.passed.replace(*node) != Some(*node);
        let passed = reached.filter(is_news);
        if rover.at != to {
            rover.go(to, now_ns, done_ns, onward);
        }
        if let Some(node) = passed {
            let at = millimetres(to);
            self.tell(now_ns, Event::Passes { robot: robot + 1, node: node.0, at });
        }
        self.put(station, done_ns, Duty::GoOn(leg));
    }

    fn arrive(&mut self, robot: usize, now_ns: u64) {
        let station = self.station(robot);
        let rover = &mut self.rovers[robot];
        let Some(way) = &mut rover.way else { return };
        way.has_come = true;
        let (wfr, call, id, at) = (way.wfr, way.call, rover.machine.id(), rover.at);
        let goal = self.plan.field.nodes()[self.plan.wfrs[wfr].node.0 as usize];
        let event = self.happenings[wfr].len() - 1;
        let happening = &mut self.happenings[wfr][event];
        happening.visits += 1;
        let is_first = self.wfrs[wfr].is_waiting();
        if is_first {
            let shortest_m = shortest_m(&self.plan.field, rover.since, goal);
            let moved_m = rover.moved_m + way.walker.walked_m();
            let waited_ns = now_ns - happening.at_ns;
            let journey = Journey { robot, wfr, event, at_ns: now_ns, waited_ns, moved_m, shortest_m };
            self.journeys.push(journey);
        }
        (rover.since, rover.moved_m) = (at, 0.0);
        self.wfrs[wfr] = self.wfrs[wfr].reach(id);
        self.tell(now_ns, Event::Arrives { robot: robot + 1, wfr: wfr + 1, at: millimetres(at) });
        self.put(station, now_ns + SERVICE_NS, Duty::Served(call));
        let caller = &self.plan.wfrs[wfr];
        if let Some(pause_ns) = caller.pauses_ns.get(event).filter(|_| is_first) {
            self.put(caller.node, now_ns + SERVICE_NS + pause_ns, Duty::Raise(wfr));
        }
        self.look(now_ns);
    }

    fn perform(&mut self, at: NodeId, duty: Duty, now_ns: u64, chance: &mut dyn Source) {
        match (duty, self.robot(at)) {
            (Duty::Fail, None) => {
                self.sensors[at.0 as usize].has_failed = true;
                self.agendas[at.0 as usize].clear();
                self.tell(now_ns, Event::NodeFails { node: at.0 });
            }
            (Duty::Fail, Some(robot)) => {
                let rover = &mut self.rovers[robot];
                rover.has_failed = true;
                let at_mm = millimetres(rover.at);
                self.agendas[at.0 as usize].clear();
                self.tell(now_ns, Event::RobotFails { robot: robot + 1, at: at_mm });
            }
            (Duty::Raise(wfr), _) => self.raise(wfr, now_ns),
            (Duty::Forward(wfr), _) => {
                if let Some(notice) = self.broadcasts[wfr].expire(at, now_ns, chance) {
                    self.send(at, Message::Notice(notice));
                }
            }
            (Duty::Repeat(frame), _) => {
                if let Some(letter) = self.letters[at.0 as usize].repeat(frame) {
                    self.send(at, Message::Letter(letter));
                    self.put(at, now_ns + ANSWER_WAIT_NS, Duty::Repeat(frame));
                }
            }
            (Duty::Quiet, _) => {
                let sensor = &mut self.sensors[at.0 as usize];
                if sensor.until_ns <= now_ns {
                    sensor.guide = sensor.guide.expire();
                }
            }
            (Duty::Wfr(wfr, timer), _) => {
                if self.wfrs[wfr].timer() == Some(timer) {
                    if let (WfrTimer::Window(_), Phase::Collecting { best: Some(_) }) =
                        (timer, self.wfrs[wfr].phase())
                    {
                        self.judge.closes(wfr);
                    }
                    self.turn_wfr(wfr, now_ns, |machine| machine.expire(timer));
                }
            }
            (Duty::Robot(timer), Some(robot)) => {
                self.turn_robot(robot, now_ns, |machine| machine.expire(timer));
            }
            (Duty::Lease(call, lease), Some(robot)) => {
                let rover = &self.rovers[robot];
                let is_there = rover.way.as_ref().is_some_and(|way| way.has_come);
                if rover.leases == lease && !is_there {
                    self.turn_robot(robot, now_ns, |machine| machine.lapse(call));
                }
            }
            (Duty::NoSignal(leg), Some(robot)) => {
                if let Some(way) = self.way_in(robot, leg)
                    && matches!(way.walker.stage(), Leg::Asking { .. })
                {
                    way.walker.expire();
                    self.begin_leg(robot, now_ns);
                }
            }
            (Duty::AskOn(leg), Some(robot)) => {
                if self.way_in(robot, leg).is_some() {
                    self.ask_on(robot, now_ns, chance);
                }
            }
            (Duty::GoOn(leg), Some(robot)) => {
                if self.way_in(robot, leg).is_some() {
                    self.go_on(robot, now_ns, chance);
                }
            }
            (Duty::Served(call), Some(robot)) => {
                if self.rovers[robot].machine.task() == (Task::Leased { call }) {
                    self.turn_robot(robot, now_ns, Robot::arrive);
                }
            }
            (
                Duty::Robot(_)
                | Duty::Lease(..)
                | Duty::NoSignal(_)
                | Duty::AskOn(_)
                | Duty::GoOn(_)
                | Duty::Served(_),
                None,
            ) => {}
        }
    }

    /// The link of a node with a robot, to either; `None` if they do not hear each other.
    fn link(&self, node: NodeId, rover: &Rover, to: NodeId) -> Option<Link> {
        self.plan.link(to, self.plan.signal(node, rover.place), rover.at)
    }

    /// A robot's journey, if it is still in this leg.
    fn way_in(&mut self, robot: usize, leg: u32) -> Option<&mut Way> {
        self.rovers[robot].way.as_mut().filter(|way| way.leg == leg)
    }

    fn report(mut self, air: Air) -> Report {
        for wfr in 0..self.wfrs.len() {
            self.measure_spread(wfr);
        }
        let mut fates = Vec::new();
        for wfr in 0..self.wfrs.len() {
            let of_wfr = (0..self.plan.events()).map(|event| self.fate(wfr, event));
            let place = fates.len();
            fates.extend(of_wfr);
            if fates[place..].contains(&Fate::Abandoned) {
                self.judge.tell(Demand::IsServed, wfr, air.end_ns);
            }
        }
        let happenings = self.happenings.iter().flatten();
        Report {
            spreads: happenings.filter_map(|happening| happening.spread).collect(),
            fates,
            journeys: self.journeys,
            violations: self.judge.violations,
            log: self.log,
            paths: self.rovers.into_iter().map(|rover| rover.path).collect(),
            field: self.plan.field.clone(),
            wfrs: self.plan.wfrs.iter().map(|wfr| self.plan.field.nodes()[wfr.node.0 as usize]).collect(),
            air,
        }
    }

    fn fate(&self, wfr: usize, event: usize) -> Fate {
        let Some(&Happening { epoch, visits, .. }) = self.happenings[wfr].get(event) else {
            return Fate::StillToCome;
        };
        let first = self.journeys.iter().find(|journey| (journey.wfr, journey.event) == (wfr, event));
        if let Some(first) = first {
            return Fate::Served { by: first.robot, visits };
        }
        let node = self.plan.wfrs[wfr].node;
        let lives = |node: NodeId| !self.sensors[node.0 as usize].has_failed;
        let hops = hops(&self.plan.network, node, lives);
        let linked = (0..).map(NodeId).zip(hops).filter(|&(node, hops)| hops.is_some() && lives(node));
        let nodes: Vec<NodeId> = linked.map(|(node, _)| node).collect();
        let is_linked = |rover: &&Rover| {
            !rover.has_failed && nodes.iter().any(|&node| self.link(node, rover, node).is_some())
        };
        let mut linked = self.rovers.iter().filter(is_linked).peekable();
        if linked.peek().is_none() {
            return Fate::CutOff;
        }
        let has_heard = |request: &Request| request.call.epoch >= epoch;
        if linked.any(|rover| rover.machine.request(node).is_some_and(has_heard)) {
            Fate::Abandoned
        } else {
            Fate::Unheard
        }
    }
}

/// The robot that a WFR has chosen and not yet seen.
const fn choice(phase: Phase) -> Option<Bid> {
    match phase {
        Phase::Offered { choice, .. } | Phase::Leased { choice } => Some(choice),
        Phase::Idle | Phase::Collecting { .. } | Phase::Rescued { .. } => None,
    }
}

impl Protocol for World<'_> {
    type Message = Message;

    fn receive(&mut self, at: NodeId, heard: Heard<Message>, chance: &mut dyn Source) -> Option<u64> {
        if self.has_failed(at) {
            return None;
        }
        let now_ns = heard.now_ns;
        match self.robot(at) {
            None => self.node_hears(at, heard, chance),
            Some(robot) => self.robot_hears(robot, heard.message, now_ns),
        }
        self.agendas[at.0 as usize].wind(now_ns)
    }

    fn expire(&mut self, at: NodeId, now_ns: u64, chance: &mut dyn Source) -> Option<Message> {
        self.agendas[at.0 as usize].went_off(now_ns);
        while let Some(duty) = self.agendas[at.0 as usize].take(now_ns) {
            self.perform(at, duty, now_ns, chance);
        }
        self.agendas[at.0 as usize].post()
    }

    fn again(&mut self, at: NodeId, now_ns: u64) -> Option<u64> {
        self.agendas[at.0 as usize].wind(now_ns)
    }

    fn rovers(&self) -> usize {
        self.rovers.len()
    }

    fn roving(&self, at: NodeId, links: &mut Vec<Link>) {
        let robots = || self.rovers.iter().enumerate().map(|(robot, rover)| (self.station(robot), rover));
        match self.robot(at).map(|robot| &self.rovers[robot]) {
            None => links.extend(robots().filter_map(|(to, rover)| self.link(at, rover, to))),
            Some(sender) => {
                let nodes = (0..self.plan.network.nodes() as u32).map(NodeId);
                links.extend(nodes.filter_map(|to| self.link(to, sender, to)));
                let others = robots().filter(|&(to, _)| to != at);
                links.extend(
                    others.filter_map(|(to, rover)| self.plan.link(to, Signal::plain(rover.at), sender.at)),
                );
            }
        }
    }
}

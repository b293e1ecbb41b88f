//! Everybody on the air: nodes that broadcast, carry messages and guide, WFRs that call and choose, robots that ask and
//! go. Each reacts by its kernel machine; here is who hears whom, which timer runs how long, and where the robots are.

mod calling;
mod ending;
mod relaying;
mod walking;

use tautline_kernel::choice::Oracle;
use tautline_kernel::mrc::{Hop, Phase, Relay, Robot, RobotTimer, Task, Wfr, WfrTimer};
use tautline_kernel::net::{Call, Epoch, NodeId, Reception, RobotId};
use tautline_kernel::tan::{Guide, Nav, ReqNav, Stage as Leg};
use tautline_proofs::engine::SeededOracle;

use super::acks::{ANSWER_WAIT_NS, Letter, Letters};
use super::agenda::Agenda;
use super::event::millimetres;
use super::judge::{Judge, RobotView};
use super::pace;
use super::rover::Rover;
use super::scenario::Scenario;
use super::timers::Timers;
use super::{
    Event, Journey, LogEntry, MAX_ROBOTS, MAX_WFRS, Ordinal, Packets, Problem, Report, Setting, Spread,
};
use crate::radio::{Broadcast, Link, Protocol, run};
use crate::tan::Signal;

/// Nothing that would happen later happens: six hours for each event. A WFR to which nobody can come calls until then.
const HORIZON_NS: u64 = 6 * 3_600 * 1_000_000_000;

/// Ways back that a path node remembers.
const ROUTES: usize = MAX_ROBOTS * MAX_WFRS;

/// The rescue of `setting` and `seed`.
///
/// # Errors
/// A [`Problem`] if the setting makes none.
pub fn rescue(setting: &Setting, seed: u64) -> Result<Report, Problem> {
    let scenario = setting.lay_out(&mut SeededOracle::new(seed, 0))?;
    scenario.rescue(&mut SeededOracle::new(seed, 1))
}

impl Scenario {
    /// The rescue, as it goes with these answers.
    pub(super) fn rescue(&self, chance: &mut dyn Oracle) -> Result<Report, Problem> {
        let mut world = World::new(self);
        let begin = world.begin();
        let air = run(&self.network, self.channel, &self.faults, &mut world, &begin, chance)?;
        Ok(world.report(air))
    }
}

/// A message on the air.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Message {
    /// NOTICE.
    Notice(tautline_kernel::net::Notice),
    /// MOVE, RESB, or a robot's answer to it, for one hop.
    Letter(Letter),
    /// A letter has arrived: its sender, and its number.
    Receipt { to: Hop, frame: u32 },
    /// A robot asks for a signal.
    ReqNav(ReqNav),
    /// A path node's signal, as it begins.
    Nav(Nav),
}

/// A duty that is due at a station.
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

/// A node's memory beside the broadcasts.
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
    /// How many nodes were connected with the WFR then.
    component: u32,
    /// The spread of that call, once there was another.
    spread: Option<Spread>,
    /// How many robots have come.
    visits: u32,
}

struct World<'a> {
    scenario: &'a Scenario,
    timers: Vec<Timers>,
    /// Of the nodes, then of the robots.
    agendas: Vec<Agenda<Duty, Message>>,
    /// Likewise.
    letters: Vec<Letters>,
    sensors: Vec<Sensor>,
    rovers: Vec<Rover>,
    wfrs: Vec<Wfr<MAX_ROBOTS>>,
    broadcasts: Vec<Broadcast<'a>>,
    /// The events so far, WFR by WFR.
    happenings: Vec<Vec<Happening>>,
    journeys: Vec<Journey>,
    judge: Judge,
    log: Vec<LogEntry>,
    packets: Packets,
}

impl<'a> World<'a> {
    fn new(scenario: &'a Scenario) -> Self {
        let stations = scenario.network.nodes() + scenario.robots.len();
        let leg_ns = pace::leg_ns(&scenario.equipment, scenario.radio.reach_m(), scenario.noise_db);
        let sensor = || Sensor { has_failed: false, guide: Guide::Idle, until_ns: 0, relay: None };
        Self {
            scenario,
            timers: scenario.wfrs.iter().map(|wfr| Timers::new(wfr.depth, leg_ns)).collect(),
            agendas: (0..stations).map(|_| Agenda::new()).collect(),
            letters: (0..stations).map(|_| Letters::default()).collect(),
            sensors: (0..scenario.network.nodes()).map(|_| sensor()).collect(),
            rovers: (0..)
                .zip(&scenario.robots)
                .map(|(robot, place)| Rover::new(scenario.rule, RobotId(robot), place.at))
                .collect(),
            wfrs: scenario.wfrs.iter().map(|wfr| Wfr::new(scenario.rule, wfr.node)).collect(),
            broadcasts: scenario
                .wfrs
                .iter()
                .map(|wfr| Broadcast::new(&scenario.network, scenario.broadcast, wfr.node))
                .collect(),
            happenings: scenario.wfrs.iter().map(|_| Vec::new()).collect(),
            journeys: Vec::new(),
            judge: Judge::new(scenario.robots.len(), scenario.wfrs.len()),
            log: Vec::new(),
            packets: Packets::default(),
        }
    }

    /// Puts what is due from the start, and returns when the stations' timers go off first.
    fn begin(&mut self) -> Vec<(NodeId, u64)> {
        let scenario = self.scenario;
        for (wfr, caller) in scenario.wfrs.iter().enumerate() {
            self.put(caller.node, caller.at_ns, Duty::Raise(wfr));
        }
        for &(node, at_ns) in &scenario.failing {
            self.put(node, at_ns, Duty::Fail);
        }
        for (robot, place) in scenario.robots.iter().enumerate() {
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
        NodeId((self.scenario.network.nodes() + robot) as u32)
    }

    /// Which robot is on the air under this number; a node is none.
    fn robot(&self, at: NodeId) -> Option<usize> {
        (at.0 as usize).checked_sub(self.scenario.network.nodes())
    }

    fn put(&mut self, at: NodeId, at_ns: u64, duty: Duty) {
        if at_ns <= HORIZON_NS * self.scenario.events() as u64 {
            self.agendas[at.0 as usize].put(at_ns, duty);
        }
    }

    fn send(&mut self, at: NodeId, message: Message) {
        self.agendas[at.0 as usize].send(message);
    }

    fn tell(&mut self, at_ns: u64, event: Event) {
        self.log.push(LogEntry { at_ns, event });
    }

    fn has_failed(&self, at: NodeId) -> bool {
        match self.robot(at) {
            None => self.sensors[at.0 as usize].has_failed,
            Some(robot) => self.rovers[robot].has_failed,
        }
    }

    fn look(&mut self, now_ns: u64) {
        let seen: Vec<RobotView<'_>> = self
            .rovers
            .iter()
            .map(|rover| RobotView { machine: &rover.machine, has_failed: rover.has_failed })
            .collect();
        self.judge.look(&seen, &self.wfrs, now_ns);
    }

    fn perform(&mut self, at: NodeId, duty: Duty, now_ns: u64, chance: &mut dyn Oracle) {
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
                self.tell(now_ns, Event::RobotFails { robot: Ordinal(robot), at: at_mm });
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
            (Duty::Wfr(wfr, timer), _) if self.wfrs[wfr].timer() == Some(timer) => {
                if let (WfrTimer::Window(_), Phase::Collecting { best: Some(_) }) =
                    (timer, self.wfrs[wfr].phase())
                {
                    self.judge.closes(wfr);
                }
                self.turn_wfr(wfr, now_ns, None, |machine| machine.expire(timer));
            }
            (Duty::Robot(timer), Some(robot)) => {
                self.turn_robot(robot, now_ns, None, |machine| machine.expire(timer));
            }
            (Duty::Lease(call, lease), Some(robot)) => {
                let rover = &self.rovers[robot];
                let is_there = rover.way.as_ref().is_some_and(|way| way.has_come);
                if rover.leases == lease && !is_there {
                    self.turn_robot(robot, now_ns, None, |machine| machine.lapse(call));
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
            (Duty::AskOn(leg), Some(robot)) if self.way_in(robot, leg).is_some() => {
                self.ask_on(robot, now_ns, chance);
            }
            (Duty::GoOn(leg), Some(robot)) if self.way_in(robot, leg).is_some() => {
                self.go_on(robot, now_ns, chance);
            }
            (Duty::Served(call), Some(robot))
                if self.rovers[robot].machine.task() == (Task::Leased { call }) =>
            {
                self.turn_robot(robot, now_ns, None, Robot::arrive);
            }
            (
                Duty::Wfr(..)
                | Duty::Robot(_)
                | Duty::Lease(..)
                | Duty::NoSignal(_)
                | Duty::AskOn(_)
                | Duty::GoOn(_)
                | Duty::Served(_),
                _,
            ) => {}
        }
    }

    /// The link of a node with a robot, to either; `None` if they do not hear each other.
    fn link(&self, node: NodeId, rover: &Rover, to: NodeId) -> Option<Link> {
        self.scenario.link(to, self.scenario.signal(node, rover.place), rover.at)
    }
}

impl Protocol for World<'_> {
    type Message = Message;

    fn receive(&mut self, at: NodeId, heard: Reception<Message>, chance: &mut dyn Oracle) -> Option<u64> {
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

    fn expire(&mut self, at: NodeId, now_ns: u64, chance: &mut dyn Oracle) -> Option<Message> {
        self.agendas[at.0 as usize].went_off(now_ns);
        while let Some(duty) = self.agendas[at.0 as usize].take(now_ns) {
            self.perform(at, duty, now_ns, chance);
        }
        let message = self.agendas[at.0 as usize].post()?;
        *match message {
            Message::Notice(_) => &mut self.packets.notices,
            Message::Letter(_) | Message::Receipt { .. } => &mut self.packets.control,
            Message::ReqNav(_) | Message::Nav(_) => &mut self.packets.guiding,
        } += 1;
        Some(message)
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
                let nodes = self.scenario.grid.nodes_near(sender.at).into_iter();
                links.extend(nodes.filter_map(|to| self.link(to, sender, to)));
                let others = robots().filter(|&(to, _)| to != at);
                links
                    .extend(others.filter_map(|(to, rover)| {
                        self.scenario.link(to, Signal::plain(rover.at), sender.at)
                    }));
            }
        }
    }
}

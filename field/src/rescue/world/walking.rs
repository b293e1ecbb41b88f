//! A robot's way to a WFR by TAN over the air, leg by leg.

use tautline_kernel::choice::Oracle;
use tautline_kernel::mrc::Request;
use tautline_kernel::net::{Call, NodeId};
use tautline_kernel::tan::{Guide, Nav, Order, ReqNav, Stage as Leg};

use super::{Duty, Message, World};
use crate::rescue::event::millimetres;
use crate::rescue::pace::{ASK_NS, TRY_NS};
use crate::rescue::rover::{Onward, Way};
use crate::rescue::{Event, Journey, Ordinal};
use crate::tan::{Walker, shortest_m};

/// How long a robot serves at a WFR before it is free again, which the paper leaves open: ten seconds.
const SERVICE_NS: u64 = 10_000_000_000;

impl World<'_> {
    pub(super) fn set_out(&mut self, robot: usize, call: Call, now_ns: u64) {
        let Some(wfr) = self.scenario.wfr(call.wfr) else { return };
        let rover = &self.rovers[robot];
        let Some(&Request { parent, hops, .. }) = rover.machine.request(call.wfr) else { return };
        let (start, id) = (rover.at, rover.machine.id());
        let walker = Walker::new(self.scenario.equipment, start, id, call.wfr, (parent, hops));
        self.rovers[robot].way = Some(Way { call, wfr, walker, leg: 0, passed: None, has_come: false });
        let (epoch, at) = (call.epoch.0, millimetres(start));
        self.tell(now_ns, Event::SetsOut { robot: Ordinal(robot), wfr: Ordinal(wfr), epoch, at });
        self.begin_leg(robot, now_ns);
    }

    /// A robot has no longer the lease that it had.
    pub(super) fn stop(&mut self, robot: usize, now_ns: u64) {
        let rover = &mut self.rovers[robot];
        let Some(Way { call, wfr, walker, has_come, .. }) = rover.way.take() else { return };
        if !has_come {
            rover.moved_m += walker.walked_m();
            let (epoch, at) = (call.epoch.0, millimetres(rover.at));
            self.tell(now_ns, Event::LetsGo { robot: Ordinal(robot), wfr: Ordinal(wfr), epoch, at });
        }
    }

    /// Asks the next node for its signal, or the same once more, and says what comes of it if there is none to be
    /// asked.
    pub(super) fn begin_leg(&mut self, robot: usize, now_ns: u64) {
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
            Leg::Lost => self.tell(now_ns, Event::LosesItsWay { robot: Ordinal(robot), at }),
        }
    }

    /// Asks the node whose signal a robot waits for or follows; the paper has it do so continuously.
    pub(super) fn ask_on(&mut self, robot: usize, now_ns: u64, chance: &mut dyn Oracle) {
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
    pub(super) fn go_on(&mut self, robot: usize, now_ns: u64, chance: &mut dyn Oracle) {
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
            !sensor.has_failed && matches!(sensor.guide, Guide::Signals(nav) if is_for(nav))
        };
        let guide = way.walker.guide();
        let signal = guide.filter(sends).map(|node| self.scenario.signal(node, rover.place));
        let (hops, places) = (way.walker.hops(), way.walker.trail().len());
        let takes_ns = way.walker.act(&self.scenario.field, signal, chance);
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
            self.tell(now_ns, Event::Passes { robot: Ordinal(robot), node: node.0, at });
        }
        self.put(station, done_ns, Duty::GoOn(leg));
    }

    fn arrive(&mut self, robot: usize, now_ns: u64) {
        let station = self.station(robot);
        let rover = &mut self.rovers[robot];
        let Some(way) = &mut rover.way else { return };
        way.has_come = true;
        let (wfr, call, id, at) = (way.wfr, way.call, rover.machine.id(), rover.at);
        let goal = self.scenario.field.at(call.wfr);
        let event = self.happenings[wfr].len() - 1;
        let happening = &mut self.happenings[wfr][event];
        happening.visits += 1;
        let is_first = self.wfrs[wfr].is_waiting();
        if is_first {
            let shortest_m = shortest_m(&self.scenario.field, rover.since, goal);
            let moved_m = rover.moved_m + way.walker.walked_m();
            let waited_ns = now_ns - happening.at_ns;
            let journey = Journey { robot, wfr, event, at_ns: now_ns, waited_ns, moved_m, shortest_m };
            self.journeys.push(journey);
        }
        (rover.since, rover.moved_m) = (at, 0.0);
        self.wfrs[wfr] = self.wfrs[wfr].reach(id);
        self.tell(now_ns, Event::Arrives { robot: Ordinal(robot), wfr: Ordinal(wfr), at: millimetres(at) });
        self.put(station, now_ns + SERVICE_NS, Duty::Served(call));
        let caller = &self.scenario.wfrs[wfr];
        if let Some(pause_ns) = caller.pauses_ns.get(event).filter(|_| is_first) {
            self.put(caller.node, now_ns + SERVICE_NS + pause_ns, Duty::Raise(wfr));
        }
        self.look(now_ns);
    }

    /// A robot's journey, if it is still in this leg.
    pub(super) fn way_in(&mut self, robot: usize, leg: u32) -> Option<&mut Way> {
        self.rovers[robot].way.as_mut().filter(|way| way.leg == leg)
    }
}

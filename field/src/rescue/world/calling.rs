//! MRC over the air: each turn of a WFR's or a robot's machine, what it sends, which timers it starts, and what is told
//! of it.

use tautline_kernel::mrc::{Bid, Downward, Hop, Mail, Phase, Resb, Robot, Task, Upward, Wfr, Word};
use tautline_kernel::net::{Epoch, RobotId};
use tautline_kernel::tan::Stage as Leg;

use super::{Duty, Happening, Message, World};
use crate::radio::Reach;
use crate::rescue::acks::Content;
use crate::rescue::judge::choice;
use crate::rescue::rover::Rover;
use crate::rescue::{Event, LogEntry, MAX_ROBOTS, MAX_WFRS, Ordinal, Spread};

impl World<'_> {
    pub(super) fn robot_hears(&mut self, robot: usize, message: Message, now_ns: u64) {
        let station = self.station(robot);
        match message {
            Message::Notice(notice) => {
                let Some(wfr) = self.scenario.wfr(notice.call.wfr) else { return };
                let known = |rover: &Rover| rover.machine.request(notice.call.wfr).copied();
                let before = known(&self.rovers[robot]).map(|request| request.call.epoch);
                let place = self.log.len();
                self.turn_robot(robot, now_ns, None, |machine| machine.receive(Downward::Notice(notice)));
                let Some(after) = known(&self.rovers[robot]) else { return };
                if before.is_none_or(|epoch| epoch < notice.call.epoch) {
                    let Epoch(epoch) = notice.call.epoch;
                    self.judge.hears(wfr, after.served, now_ns);
                    let event =
                        Event::Hears { robot: Ordinal(robot), wfr: Ordinal(wfr), epoch, hops: after.hops };
                    // Before what it makes the robot do.
                    self.log.insert(place, LogEntry { at_ns: now_ns, event });
                }
            }
            Message::Letter(letter) => match self.open(station, letter) {
                Some(Content::Down(resb)) => {
                    self.turn_robot(robot, now_ns, Some(resb), |machine| {
                        machine.receive(Downward::Resb(resb))
                    });
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

    /// `bidder` is the robot, if one has, whose MOVE of the present call has arrived.
    pub(super) fn turn_wfr(
        &mut self,
        wfr: usize,
        now_ns: u64,
        bidder: Option<RobotId>,
        turn: impl FnOnce(Wfr<MAX_ROBOTS>) -> (Wfr<MAX_ROBOTS>, Mail<MAX_ROBOTS>),
    ) {
        let (before, node) = (self.wfrs[wfr], self.scenario.wfrs[wfr].node);
        let (after, sent) = turn(before);
        self.wfrs[wfr] = after;
        let (Epoch(epoch), hops) =
            (after.call().epoch, choice(after.phase()).map_or(0, |choice| choice.hops));
        let told: Vec<Resb> = match sent {
            Mail::Nothing | Mail::Notice(_) => Vec::new(),
            Mail::One(resb) => vec![resb],
            Mail::All(resbs) => resbs.into_iter().flatten().collect(),
        };
        self.judge.tells(wfr, (before.phase(), &after), bidder, &told, now_ns);
        match sent {
            Mail::Notice(_) => self.call(wfr, now_ns),
            Mail::Nothing | Mail::One(_) | Mail::All(_) => {
                for resb in told {
                    self.send_down(node, resb, now_ns);
                }
            }
        }
        let robot = |choice: Bid| Ordinal(choice.robot.0.into());
        if choice(after.phase()) != choice(before.phase())
            && let Some(choice) = choice(after.phase())
        {
            self.tell(now_ns, Event::Chooses { wfr: Ordinal(wfr), epoch, robot: robot(choice) });
        }
        if let Phase::Leased { choice } = after.phase()
            && after.phase() != before.phase()
        {
            self.tell(now_ns, Event::CountsOn { wfr: Ordinal(wfr), epoch, robot: robot(choice) });
        }
        if after.timer() != before.timer()
            && let Some(timer) = after.timer()
        {
            self.put(node, now_ns + self.timers[wfr].wfr_ns(timer, hops), Duty::Wfr(wfr, timer));
        }
        self.look(now_ns);
    }

    /// A WFR's NOTICE, under whichever epoch, is its next event to the nodes.
    pub(super) fn call(&mut self, wfr: usize, now_ns: u64) {
        let node = self.scenario.wfrs[wfr].node;
        let Epoch(epoch) = self.wfrs[wfr].call().epoch;
        self.measure_spread(wfr);
        self.judge.calls(wfr);
        self.tell(now_ns, Event::Calls { wfr: Ordinal(wfr), node: node.0, epoch });
        if let Some(notice) = self.broadcasts[wfr].originate() {
            self.send(node, Message::Notice(notice));
        }
    }

    /// Something happens at a WFR.
    pub(super) fn raise(&mut self, wfr: usize, now_ns: u64) {
        let event = self.happenings[wfr].len();
        if event > 0 {
            self.tell(now_ns, Event::Recurs { wfr: Ordinal(wfr), event: Ordinal(event) });
        }
        self.judge.happens(wfr, event);
        self.turn_wfr(wfr, now_ns, None, Wfr::raise);
        let epoch = self.wfrs[wfr].call().epoch;
        let component = self.linked(self.scenario.wfrs[wfr].node).len() as u32;
        self.happenings[wfr].push(Happening { at_ns: now_ns, epoch, component, spread: None, visits: 0 });
    }

    /// How far the first call for the latest event so far has come: to be asked before another call.
    pub(super) fn measure_spread(&mut self, wfr: usize) {
        let Some(Happening { epoch, component, spread, .. }) = self.happenings[wfr].last_mut() else {
            return;
        };
        spread.get_or_insert_with(|| {
            let Reach { reached, rebroadcasts } = self.broadcasts[wfr].reach(*epoch);
            Spread { reached, component: *component, rebroadcasts }
        });
    }

    /// `resb` is what has arrived, if it is a RESB.
    pub(super) fn turn_robot(
        &mut self,
        robot: usize,
        now_ns: u64,
        resb: Option<Resb>,
        turn: impl FnOnce(Robot<MAX_WFRS>) -> (Robot<MAX_WFRS>, Option<Upward>),
    ) {
        let before = self.rovers[robot].machine;
        let (after, sent) = turn(before);
        self.rovers[robot].machine = after;
        self.judge.turns(robot, (before.task(), &after), resb, |wfr| self.scenario.wfr(wfr), now_ns);
        let station = self.station(robot);
        if let Some(message) = sent {
            self.say(robot, message, now_ns);
            self.post(station, Hop::Node(message.parent), Content::Up(message), now_ns);
        }
        if after.timer() != before.timer()
            && let Some(timer) = after.timer()
            && let Some(wfr) = self.scenario.wfr(timer.call.wfr)
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

    /// Logs a robot's message; an answer that it comes prolongs its lease.
    fn say(&mut self, robot: usize, message: Upward, now_ns: u64) {
        let Some(wfr) = self.scenario.wfr(message.call.wfr) else { return };
        let Epoch(epoch) = message.call.epoch;
        match message.word {
            Word::Move { hops } => {
                let bid = &mut self.rovers[robot].bid;
                let most =
                    bid.filter(|&(call, _)| call == message.call).map_or(hops, |(_, most)| most.max(hops));
                *bid = Some((message.call, most));
                self.tell(now_ns, Event::Asks { robot: Ordinal(robot), wfr: Ordinal(wfr), epoch, hops });
            }
            Word::Decline => {
                self.tell(now_ns, Event::Declines { robot: Ordinal(robot), wfr: Ordinal(wfr), epoch });
            }
            Word::Accept => {
                let rover = &mut self.rovers[robot];
                rover.leases += 1;
                let hops = rover.bid.filter(|&(call, _)| call == message.call).map_or(0, |(_, hops)| hops);
                let lapse = Duty::Lease(message.call, rover.leases);
                self.put(self.station(robot), now_ns + self.timers[wfr].robot_lease_ns(hops), lapse);
            }
        }
    }
}

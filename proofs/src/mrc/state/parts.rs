//! The parts that tell one state from another, with epochs by their order among those of the same WFR.

use std::array;
use std::hash::{Hash, Hasher};

use tautline_kernel::mrc::{Bid, Condition, Phase, Request, Robot, Task, Wfr};
use tautline_kernel::net::{Call, Epoch, NodeId, RobotId};

use super::action::Message;
use super::demand::Notes;
use super::setting::{Faults, ROBOTS, WFRS};
use super::{State, node, place, robot_id};
use crate::engine::states::Places;

/// A part of a [`State`]. What concerns one robot or one WFR is a part, and so are the messages between a robot and the
/// WFRs: of each there are few, and so the many that they make together cost little.
#[derive(Clone, PartialEq, Eq, Hash, Debug)]
pub enum Part {
    /// A robot.
    Robot(RobotPart),
    /// A WFR.
    Wfr(WfrPart),
    /// The messages between a robot and the WFRs.
    Network(Vec<Message>),
    /// All else.
    Rest(Rest),
}

/// A robot and what concerns it alone.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub struct RobotPart {
    robot: Robot<WFRS>,
    hops: [u16; WFRS],
    has_failed: bool,
    cut: [Option<Epoch>; WFRS],
    taken: [Option<Epoch>; WFRS],
}

/// A WFR and what concerns it alone.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub struct WfrPart {
    wfr: Wfr<ROBOTS>,
    best: Option<Bid>,
    heard: u8,
    is_open: bool,
}

/// The part that concerns all.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub struct Rest {
    left: Faults,
    events_left: u8,
    broken: u16,
}

/// The places of the first WFR, behind the robots, of the first robot's messages, and of the rest.
pub(super) const FIRST_WFR: usize = ROBOTS;
const NETWORK: usize = FIRST_WFR + WFRS;
pub(super) const REST: usize = NETWORK + ROBOTS;

/// Epochs from this one on are always renamed.
const LARGE: u32 = u64::BITS - 1;

/// The place of the messages between a robot and the WFRs.
pub(super) const fn of_network(robot: RobotId) -> usize {
    NETWORK + robot.0 as usize
}

impl State {
    /// The parts: the robots, the WFRs, the messages of each robot, and the rest.
    pub(in crate::mrc) const PARTS: usize = REST + 1;

    /// Names epochs by their places among those of the same WFR, and leaves out what plays no part any more: what a
    /// robot knew that has failed, who took the lease of a call that is over, and what the machines themselves will not
    /// look at. Then states that differ in no other way are one. What comes of them is one, too.
    pub(in crate::mrc) fn make_canonical(&mut self) {
        for robot in (0..ROBOTS).filter(|&robot| self.failed[robot]) {
            self.robots[robot] = Robot::new(*self.robots[robot].rule(), self.robots[robot].id());
            self.cut[robot] = [None; WFRS];
        }
        for wfr in 0..WFRS {
            if self.wfrs[wfr].is_waiting() {
                continue;
            }
            for robot in 0..ROBOTS {
                if self.notes.taken[robot][wfr].take().is_some() {
                    self.touch(robot);
                }
            }
        }
        if self.is_renamed() {
            let touched = |place: usize| self.touched >> place & 1 == 1;
            for robot in (0..ROBOTS).filter(|&robot| touched(robot)) {
                self.robots[robot] = renamed_robot(&self.robots[robot], |call| call);
            }
            for wfr in (0..WFRS).filter(|&wfr| touched(FIRST_WFR + wfr)) {
                self.wfrs[wfr] = renamed_wfr(&self.wfrs[wfr], |call| call);
            }
        } else {
            *self = self.renamed();
            self.touched = Places::MAX;
        }
        self.is_canonical = true;
    }

    fn canonical(&self) -> Self {
        let mut state = self.clone();
        state.make_canonical();
        state
    }

    /// The part in this place.
    pub(in crate::mrc) fn part(&self, place: usize) -> Part {
        if place < FIRST_WFR {
            Part::Robot(self.of_robot(place))
        } else if place < NETWORK {
            Part::Wfr(self.of_wfr(place - FIRST_WFR))
        } else if place < REST {
            Part::Network(self.messages(place - NETWORK).collect())
        } else {
            Part::Rest(self.rest())
        }
    }

    /// The places whose parts may differ from those of the canonical state that it comes from.
    pub(in crate::mrc) const fn touched(&self) -> Places {
        self.touched
    }

    const fn of_robot(&self, robot: usize) -> RobotPart {
        RobotPart {
            robot: self.robots[robot],
            hops: self.hops[robot],
            has_failed: self.failed[robot],
            cut: self.cut[robot],
            taken: self.notes.taken[robot],
        }
    }

    const fn of_wfr(&self, wfr: usize) -> WfrPart {
        let Notes { best, heard, open, .. } = &self.notes;
        WfrPart { wfr: self.wfrs[wfr], best: best[wfr], heard: heard[wfr], is_open: open[wfr] }
    }

    /// The messages to and from a robot.
    fn messages(&self, robot: usize) -> impl Iterator<Item = Message> {
        self.network.iter().copied().filter(move |message| message.robot() == robot_id(robot))
    }

    const fn rest(&self) -> Rest {
        Rest { left: self.left, events_left: self.events_left, broken: self.notes.broken }
    }

    /// Whether the epochs of each WFR are 1, 2, … without a gap, and leases that were taken are those of present calls.
    fn is_renamed(&self) -> bool {
        let mut epochs = [0_u64; WFRS];
        self.for_each_epoch(|wfr, Epoch(epoch)| epochs[wfr] |= 1 << epoch.min(LARGE));
        let is_current =
            |wfr: usize, epoch: Option<Epoch>| epoch.is_none_or(|it| it == self.wfrs[wfr].call().epoch);
        let mut taken = self.notes.taken.iter().flat_map(|taken| taken.iter().copied().enumerate());
        // 1, 2, … k set bits 1 to k.
        epochs.iter().all(|&set| set & (1 | 1 << LARGE) == 0 && (set | 1) & ((set | 1) + 1) == 0)
            && taken.all(|(wfr, epoch)| is_current(wfr, epoch))
    }

    /// The state with its epochs by their places among those of the same WFR, from 1 on.
    fn renamed(&self) -> Self {
        let mut epochs = Vec::with_capacity(48);
        self.for_each_epoch(|wfr, epoch| epochs.push((wfr, epoch)));
        epochs.sort_unstable();
        epochs.dedup();
        let rename = |call: Call| {
            let is_not_later =
                |&&(wfr, epoch): &&(usize, Epoch)| wfr == place(call.wfr) && epoch <= call.epoch;
            Call { epoch: Epoch(epochs.iter().filter(is_not_later).count() as u32), ..call }
        };
        let epoch = |wfr: usize, epoch: Epoch| rename(Call { wfr: node(wfr), epoch }).epoch;
        let mut state = self.clone();
        for (cut, taken) in state.cut.iter_mut().zip(&mut state.notes.taken) {
            for wfr in 0..WFRS {
                let current = self.wfrs[wfr].call().epoch;
                cut[wfr] = cut[wfr].map(|of| epoch(wfr, of));
                taken[wfr] = taken[wfr].filter(|&of| of == current).map(|of| epoch(wfr, of));
            }
        }
        state.robots.iter_mut().for_each(|robot| *robot = renamed_robot(robot, rename));
        state.wfrs.iter_mut().for_each(|wfr| *wfr = renamed_wfr(wfr, rename));
        state.network.iter_mut().for_each(|message| *message = message.renamed(rename));
        state
    }

    /// Every epoch that is told apart from others of its WFR.
    fn for_each_epoch(&self, mut hear: impl FnMut(usize, Epoch)) {
        let mut of = |call: Call| hear(place(call.wfr), call.epoch);
        for robot in &self.robots {
            robot.requests().for_each(|request| of(request.call));
            match robot.task() {
                Task::Free => {}
                Task::Asking { call, .. } | Task::Leased { call } => of(call),
            }
        }
        self.wfrs.iter().for_each(|wfr| of(wfr.call()));
        self.network.iter().for_each(|message| of(message.call()));
        for (wfr, epoch) in self.cut.iter().flat_map(|cut| cut.iter().enumerate()) {
            if let &Some(epoch) = epoch {
                hear(wfr, epoch);
            }
        }
    }

    /// Makes `part` the one in this place.
    pub(in crate::mrc) fn put(&mut self, place: usize, part: &Part) {
        match part {
            &Part::Robot(RobotPart { robot, hops, has_failed, cut, taken }) => {
                (self.robots[place], self.hops[place], self.failed[place]) = (robot, hops, has_failed);
                (self.cut[place], self.notes.taken[place]) = (cut, taken);
            }
            &Part::Wfr(WfrPart { wfr, best, heard, is_open }) => {
                let place = place - FIRST_WFR;
                self.wfrs[place] = wfr;
                (self.notes.best[place], self.notes.heard[place]) = (best, heard);
                self.notes.open[place] = is_open;
            }
            Part::Network(messages) => {
                let robot = robot_id(place - NETWORK);
                self.network.retain(|message| message.robot() != robot);
                self.network.extend(messages);
                self.network.sort_unstable();
            }
            &Part::Rest(Rest { left, events_left, broken }) => {
                (self.left, self.events_left, self.notes.broken) = (left, events_left, broken);
            }
        }
    }
}

impl PartialEq for State {
    fn eq(&self, other: &Self) -> bool {
        let (one, other) = (self.canonical(), other.canonical());
        (0..Self::PARTS).all(|place| one.part(place) == other.part(place))
    }
}

impl Eq for State {}

impl Hash for State {
    fn hash<H: Hasher>(&self, hasher: &mut H) {
        let state = self.canonical();
        (0..Self::PARTS).for_each(|place| state.part(place).hash(hasher));
    }
}

/// The robot with the calls that it knows under other epochs, and its records in the order of their WFRs where ties are
/// settled by identity. Rules compare epochs of one WFR and do nothing else with them, and the order of records tells
/// which one goes when the table is full: if `rename` keeps the order of epochs and there are at most `CALLS` WFRs, the
/// robot goes on as before.
fn renamed_robot<const CALLS: usize>(robot: &Robot<CALLS>, rename: impl Fn(Call) -> Call) -> Robot<CALLS> {
    let mut heard = robot.requests().map(|&request| Request { call: rename(request.call), ..request });
    let mut requests: [Option<Request>; CALLS] = array::from_fn(|_| heard.next());
    if robot.rule().has(Condition::LeastIdentity) {
        requests.sort_unstable_by_key(|request| match request {
            Some(Request { call, .. }) => (false, call.wfr),
            None => (true, NodeId(0)),
        });
    }
    let task = match robot.task() {
        Task::Free => Task::Free,
        Task::Asking { call, repeats_left } => Task::Asking { call: rename(call), repeats_left },
        Task::Leased { call } => Task::Leased { call: rename(call) },
    };
    Robot::kept(*robot.rule(), robot.id(), requests, task)
}

/// The WFR with its call under another epoch and without what plays no part any more: in which order robots have asked,
/// and by whom it was rescued. If `rename` keeps the order of epochs, the WFR goes on as before. Who has asked it
/// keeps: that a new call forgets them is to be shown.
fn renamed_wfr<const ROBOTS: usize>(wfr: &Wfr<ROBOTS>, rename: impl Fn(Call) -> Call) -> Wfr<ROBOTS> {
    let mut heard = wfr.asked();
    let mut asked: [Option<RobotId>; ROBOTS] = array::from_fn(|_| heard.next());
    asked.sort_unstable_by_key(|robot| (robot.is_none(), *robot));
    let phase = match wfr.phase() {
        Phase::Rescued { .. } => Phase::Rescued { by: RobotId(0) },
        phase @ (Phase::Idle | Phase::Collecting { .. } | Phase::Offered { .. } | Phase::Leased { .. }) => {
            phase
        }
    };
    Wfr::kept(*wfr.rule(), rename(wfr.call()), phase, asked)
}

#[cfg(test)]
mod tests {
    use tautline_kernel::mrc::{Downward, Rule, Upward, Word};
    use tautline_kernel::net::Notice;

    use super::*;

    const fn call(wfr: u32, epoch: u32) -> Call {
        Call { wfr: NodeId(wfr), epoch: Epoch(epoch) }
    }

    #[test]
    fn records_are_put_in_order_where_ties_are_settled_by_identity() {
        let notice = |call, hops| Downward::Notice(Notice { call, hops, sender: NodeId(3) });
        let heard = [notice(call(9, 4), 1), notice(call(8, 7), 6)];
        let earlier = |Call { wfr, epoch }| Call { wfr, epoch: Epoch(epoch.0 - 3) };
        let by_first_heard = Rule::REPAIRED.without(Condition::LeastIdentity);
        let in_order =
            [(Rule::REPAIRED, [call(8, 4), call(9, 1)]), (by_first_heard, [call(9, 1), call(8, 4)])];
        for (rule, calls) in in_order {
            let fresh = Robot::<2>::new(rule, RobotId(5));
            let robot = heard.iter().fold(fresh, |robot, &message| robot.receive(message).0);
            let renamed = renamed_robot(&robot, earlier);
            assert!(renamed.requests().map(|request| request.call).eq(calls));
            assert!(matches!(renamed.task(), Task::Asking { call: asked, .. } if asked == call(9, 1)));
            let one = fresh.receive(heard[0]).0;
            assert_eq!(renamed_robot(&one, |call| call), one);
        }
    }

    #[test]
    fn who_has_asked_is_kept_in_order_and_by_whom_a_wfr_was_rescued_is_not() {
        let same = |wfr: Wfr<2>| renamed_wfr(&wfr, |call| call);
        let asked = |wfr: Wfr<2>| -> [Option<RobotId>; 2] {
            let renamed = same(wfr);
            let mut asked = renamed.asked();
            array::from_fn(|_| asked.next())
        };
        let up = |robot, word| Upward { call: call(7, 1), robot: RobotId(robot), word, parent: NodeId(7) };
        let both = [Some(RobotId(1)), Some(RobotId(2))];
        for rule in [Rule::REPAIRED, Rule::REPAIRED.without(Condition::ChoiceStands)] {
            let raised = Wfr::<2>::new(rule, NodeId(7)).raise().0;
            let bids = [2, 1].map(|robot| up(robot, Word::Move { hops: 3 }));
            let collecting = bids.into_iter().fold(raised, |wfr, bid| wfr.receive(bid).0);
            assert_eq!((asked(collecting), same(collecting).call()), (both, collecting.call()));
            let offered = collecting.expire(collecting.timer().expect("a window")).0;
            let leased = offered.receive(up(1, Word::Accept)).0;
            let phases = (offered.phase(), leased.phase());
            assert!(matches!(phases, (Phase::Offered { .. }, Phase::Leased { .. })));
            assert_eq!((asked(offered), asked(leased)), (both, both));
            let rescued = [RobotId(1), RobotId(2)].map(|by| same(leased.reach(by)));
            assert_eq!((asked(rescued[0]), rescued[0]), (both, rescued[1]));
            assert!(matches!(rescued[0].phase(), Phase::Rescued { .. }));
        }
    }
}

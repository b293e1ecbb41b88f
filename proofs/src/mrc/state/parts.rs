//! What tells one state from another: its parts, with epochs by their order among those of the same WFR.

use std::hash::{Hash, Hasher};

use tautline_kernel::mrc::{Robot, Task, Wfr};
use tautline_kernel::net::{Call, Epoch};

use super::action::Message;
use super::demand::Notes;
use super::setting::{Faults, ROBOTS, WFRS};
use super::{State, node, place};

/// A part of a [`State`].
#[derive(Clone, PartialEq, Eq, Hash, Debug)]
pub(in crate::mrc) enum Part {
    Robot(Robot<WFRS>),
    Wfr(Wfr<ROBOTS>),
    Network(Vec<Message>),
    Rest(Rest),
}

/// What is neither a machine nor on its way.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(in crate::mrc) struct Rest {
    hops: [[u16; WFRS]; ROBOTS],
    failed: [bool; ROBOTS],
    cut: [[Option<Epoch>; WFRS]; ROBOTS],
    left: Faults,
    events_left: u8,
    notes: Notes,
}

/// The places of the first WFR, behind the robots, of the network and of the rest.
const FIRST_WFR: usize = ROBOTS;
const NETWORK: usize = FIRST_WFR + WFRS;
const REST: usize = NETWORK + 1;

impl State {
    /// The parts: the robots, the WFRs, the network and the rest.
    pub(in crate::mrc) const PARTS: usize = REST + 1;

    /// Names epochs by their places among those of the same WFR: then states that differ in no other way are one. What
    /// comes of them is one, too.
    pub(in crate::mrc) fn make_canonical(&mut self) {
        if self.is_renamed() {
            self.wfrs = self.wfrs.map(|wfr| wfr.renamed(|call| call));
        } else {
            *self = self.renamed();
        }
    }

    fn canonical(&self) -> Self {
        let mut state = self.clone();
        state.make_canonical();
        state
    }

    /// The part in this place.
    pub(in crate::mrc) fn part(&self, place: usize) -> Part {
        if place < FIRST_WFR {
            Part::Robot(self.robots[place])
        } else if place < NETWORK {
            Part::Wfr(self.wfrs[place - FIRST_WFR])
        } else if place < REST {
            Part::Network(self.network.clone())
        } else {
            Part::Rest(self.rest())
        }
    }

    /// Whether `part` is the one in this place.
    pub(in crate::mrc) fn is_part(&self, place: usize, part: &Part) -> bool {
        match part {
            Part::Robot(robot) => self.robots[place] == *robot,
            Part::Wfr(wfr) => self.wfrs[place - FIRST_WFR] == *wfr,
            Part::Network(network) => self.network == *network,
            Part::Rest(rest) => self.rest() == *rest,
        }
    }

    const fn rest(&self) -> Rest {
        let Self { hops, failed, cut, left, events_left, notes, .. } = *self;
        Rest { hops, failed, cut, left, events_left, notes }
    }

    /// Whether the epochs of each WFR are 1, 2, … without a gap, and leases that were taken are those of present calls.
    fn is_renamed(&self) -> bool {
        let mut epochs = [0_u64; WFRS];
        let mut is_small = true;
        self.for_each_epoch(|wfr, Epoch(epoch)| {
            is_small &= epoch < u64::BITS;
            epochs[wfr] |= 1_u64.unbounded_shl(epoch);
        });
        let is_current =
            |wfr: usize, epoch: Option<Epoch>| epoch.is_none_or(|it| it == self.wfrs[wfr].call().epoch);
        let mut taken = self.notes.taken.iter().flat_map(|taken| taken.iter().copied().enumerate());
        // 1, 2, … k set bits 1 to k.
        is_small
            && epochs.iter().all(|&set| set & 1 == 0 && (set | 1) & (set | 1).wrapping_add(1) == 0)
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
        state.robots = state.robots.map(|robot| robot.renamed(rename));
        state.wfrs = state.wfrs.map(|wfr| wfr.renamed(rename));
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
            Part::Robot(robot) => self.robots[place] = *robot,
            Part::Wfr(wfr) => self.wfrs[place - FIRST_WFR] = *wfr,
            Part::Network(network) => self.network.clone_from(network),
            &Part::Rest(Rest { hops, failed, cut, left, events_left, notes }) => {
                (self.hops, self.failed, self.cut) = (hops, failed, cut);
                (self.left, self.events_left, self.notes) = (left, events_left, notes);
            }
        }
    }
}

impl PartialEq for State {
    fn eq(&self, other: &Self) -> bool {
        let (one, other) = (self.canonical(), other.canonical());
        (0..Self::PARTS).all(|place| one.is_part(place, &other.part(place)))
    }
}

impl Eq for State {}

impl Hash for State {
    fn hash<H: Hasher>(&self, hasher: &mut H) {
        let state = self.canonical();
        (0..Self::PARTS).for_each(|place| state.part(place).hash(hasher));
    }
}

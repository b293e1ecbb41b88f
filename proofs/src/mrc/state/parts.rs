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

/// The parts of a state: its robots, its WFRs, its network and the rest.
const PARTS: usize = ROBOTS + WFRS + 2;

impl State {
    /// The parts of this state, epochs by their places among those of the same WFR: equal for states that differ in no
    /// other way. So is what comes of these states.
    pub(in crate::mrc) fn parts(&self) -> [Part; PARTS] {
        let epochs = self.epochs();
        let rename = |call: Call| {
            let is_not_later = |&&(wfr, epoch): &&(usize, Epoch)| wfr == place(call.wfr) && epoch <= call.epoch;
            Call { epoch: Epoch(epochs.iter().filter(is_not_later).count() as u32), ..call }
        };
        let renamed = |wfr: usize, epoch: Epoch| rename(Call { wfr: node(wfr), epoch }).epoch;
        let mut notes = self.notes;
        let mut cut = self.cut;
        for (cut, taken) in cut.iter_mut().zip(&mut notes.taken) {
            for wfr in 0..WFRS {
                let current = self.wfrs[wfr].call().epoch;
                cut[wfr] = cut[wfr].map(|epoch| renamed(wfr, epoch));
                taken[wfr] = taken[wfr].filter(|&epoch| epoch == current).map(|epoch| renamed(wfr, epoch));
            }
        }
        let Self { hops, failed, left, events_left, .. } = *self;
        let rest = Rest { hops, failed, cut, left, events_left, notes };
        let network = self.network.iter().map(|message| message.renamed(rename)).collect();
        let [first, second, third] = self.robots.map(|robot| Part::Robot(robot.renamed(rename)));
        let [fourth, fifth, sixth] = self.wfrs.map(|wfr| Part::Wfr(wfr.renamed(rename)));
        [first, second, third, fourth, fifth, sixth, Part::Network(network), Part::Rest(rest)]
    }

    /// Makes `part` the one in this place.
    pub(in crate::mrc) fn put(&mut self, place: usize, part: &Part) {
        match part {
            Part::Robot(robot) => self.robots[place] = *robot,
            Part::Wfr(wfr) => self.wfrs[place - ROBOTS] = *wfr,
            Part::Network(network) => self.network.clone_from(network),
            &Part::Rest(Rest { hops, failed, cut, left, events_left, notes }) => {
                (self.hops, self.failed, self.cut) = (hops, failed, cut);
                (self.left, self.events_left, self.notes) = (left, events_left, notes);
            }
        }
    }

    /// The epochs that are told apart, each with its WFR.
    fn epochs(&self) -> Vec<(usize, Epoch)> {
        let of = |call: Call| (place(call.wfr), call.epoch);
        let mut epochs = Vec::with_capacity(48);
        for robot in &self.robots {
            epochs.extend(robot.requests().map(|request| of(request.call)));
            match robot.task() {
                Task::Free => {}
                Task::Asking { call, .. } | Task::Leased { call } => epochs.push(of(call)),
            }
        }
        epochs.extend(self.wfrs.iter().map(|wfr| of(wfr.call())));
        epochs.extend(self.network.iter().map(|message| of(message.call())));
        for cut in &self.cut {
            epochs.extend(cut.iter().enumerate().filter_map(|(wfr, epoch)| Some((wfr, (*epoch)?))));
        }
        epochs.sort_unstable();
        epochs.dedup();
        epochs
    }
}

impl PartialEq for State {
    fn eq(&self, other: &Self) -> bool {
        self.parts() == other.parts()
    }
}

impl Eq for State {}

impl Hash for State {
    fn hash<H: Hasher>(&self, hasher: &mut H) {
        self.parts().hash(hasher);
    }
}

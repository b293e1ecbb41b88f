//! What tells one state from another.

use std::hash::{Hash, Hasher};

use tautline_kernel::mrc::{Bid, Phase, Served, Task, Upward, Word};
use tautline_kernel::net::{Call, Epoch};

use super::action::Message;
use super::setting::{Faults, WFRS};
use super::{State, place};

impl State {
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

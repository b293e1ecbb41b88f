//! The states that are known, each as the numbers of its parts: the last ones in memory, those before perhaps on disk.

use std::hash::Hash;
use std::mem;
use std::ops::Range;

use super::System;
use super::code::{Code, HashOfState, number, widened};
use super::spill::{Disk, SpillError};
use super::tables::{Codes, Slots};

/// Parts that were met, each once.
pub(super) struct Parts<P> {
    slots: Slots,
    pub(super) parts: Vec<P>,
}

impl<P: Clone + Eq> Parts<P> {
    pub(super) fn new() -> Self {
        Self { slots: Slots::default(), parts: Vec::new() }
    }

    /// The number of a part with this hash, if it was met.
    pub(super) fn find(&self, hash: HashOfState, part: &P) -> Option<u32> {
        self.slots.find(hash, |number| self.parts[number as usize] == *part)
    }

    /// The number of a part with this hash.
    pub(super) fn number(&mut self, hash: HashOfState, part: &P) -> u32 {
        self.find(hash, part).unwrap_or_else(|| {
            let number = self.parts.len() as u32;
            self.slots.insert(hash, number);
            self.parts.push(part.clone());
            number
        })
    }
}

/// A state that is shown, and the numbers of its parts: of the next one only the parts are put that they do not share.
#[derive(Clone)]
pub(super) struct Cursor<T> {
    pub(super) state: T,
    pub(super) code: Code,
}

/// States by the numbers of their parts, of which each takes as many bytes as the largest needs; or, where states have
/// no parts, in bytes of their own.
pub(super) struct StateTable<P> {
    pub(super) parts: Parts<P>,
    /// Bytes of a number.
    pub(super) width: usize,
    /// Parts of a state.
    pub(super) places: usize,
    pub(super) codes: Codes,
    /// The states in memory by their hashes.
    pub(super) nodes: Slots,
    /// The states on disk, and how many they are.
    pub(super) disk: Option<Disk>,
    pub(super) on_disk: usize,
}

impl<P: Clone + Eq + Hash> StateTable<P> {
    pub(super) fn new() -> Self {
        Self {
            parts: Parts::new(),
            width: 1,
            places: 0,
            codes: Codes::default(),
            nodes: Slots::default(),
            disk: None,
            on_disk: 0,
        }
    }

    /// The number of states.
    pub(super) const fn len(&self) -> usize {
        self.on_disk + self.codes.length
    }

    /// The bytes that they take, and will have taken once the next one is there.
    pub(super) fn bytes(&self) -> u64 {
        let table = self.nodes.bytes_with_the_next();
        let parts = self.parts.parts.capacity() * size_of::<P>() + self.parts.slots.bytes();
        self.codes.bytes() + table + parts as u64 + self.disk.as_ref().map_or(0, Disk::bytes)
    }

    /// The code of a state that is in memory or was loaded.
    pub(super) fn code(&self, node: usize) -> Option<&[u8]> {
        match node.checked_sub(self.on_disk) {
            Some(place) => Some(self.codes.entry(place)),
            None => self.disk.as_ref()?.code(node),
        }
    }

    /// Loads those of these states that are on disk. False if they cannot be read.
    pub(super) fn load(&mut self, nodes: Range<usize>) -> bool {
        nodes.start >= self.on_disk || self.disk.as_mut().is_some_and(|disk| disk.load(nodes))
    }

    /// Writes the states in memory to disk, with these numbers, and empties it. False if they cannot be written.
    pub(super) fn spill(&mut self, numbers: impl Iterator<Item = u64>) -> bool {
        if self.places > 0 {
            self.widen(size_of::<u32>());
        }
        let Some(disk) = &mut self.disk else { return false };
        let sorted = mem::take(&mut self.nodes).into_sorted();
        let is_written = disk.write((&self.codes, &sorted), numbers);
        if is_written {
            (self.codes, self.on_disk) = (Codes::default(), disk.len());
        }
        is_written
    }

    /// Takes up the states on this disk, if there are any.
    pub(super) fn take_up(&mut self, disk: Disk) {
        self.on_disk = disk.len();
        self.disk = (disk.len() > 0 || disk.fault().is_some()).then_some(disk);
    }

    /// Why states cannot be written or read.
    pub(super) fn fault(&self) -> Option<&SpillError> {
        self.disk.as_ref().and_then(Disk::fault)
    }

    /// The states on disk are of another system.
    pub(super) fn is_foreign(&mut self) {
        self.disk.iter_mut().for_each(Disk::is_foreign);
    }

    /// Removes what is on disk if the search is over, or cannot be taken up.
    pub(super) fn leave_disk(&self, is_over: bool) {
        self.disk.iter().for_each(|disk| disk.leave(is_over));
    }

    /// Shows the state of a node; nothing if it cannot be read.
    pub(super) fn show<S: System<Part = P>>(
        &mut self,
        system: &S,
        node: usize,
        shown: &mut Cursor<S::State>,
    ) -> Option<()> {
        self.load(node..node + 1).then(|| self.show_loaded(system, node, shown))?
    }

    /// Shows the state of a node that is loaded.
    pub(super) fn show_loaded<S: System<Part = P>>(
        &self,
        system: &S,
        node: usize,
        Cursor { state, code: shown }: &mut Cursor<S::State>,
    ) -> Option<()> {
        let code = self.code(node)?;
        if self.places == 0 {
            system.read(state, code);
            return Some(());
        }
        shown.widen(self.width);
        for (place, number) in code.chunks_exact(self.width).map(number).enumerate() {
            match shown.at(place) {
                Some(before) if before == number => continue,
                Some(_) => shown.put(place, number),
                None => shown.push(number),
            }
            system.put(state, place, &self.parts.parts[number as usize]);
        }
        Some(())
    }

    /// Whether states are kept in bytes of their own.
    pub(super) const fn is_bytes(&self) -> bool {
        self.places == 0
    }

    /// Writes all numbers with at least so many bytes.
    pub(super) fn widen(&mut self, width: usize) {
        if width <= self.width {
            return;
        }
        let mut codes = Codes::default();
        for node in 0..self.codes.length {
            codes.push(&widened(self.codes.entry(node), self.width, width));
        }
        (self.codes, self.width) = (codes, width);
    }
}

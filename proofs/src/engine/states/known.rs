//! The states that are known, each as the numbers of its parts.

use std::hash::{BuildHasher, Hash};

use hashbrown::HashTable;
use rustc_hash::FxBuildHasher;

use super::System;

/// Things in the order in which they came, in pieces, so that none is ever moved.
pub(super) struct Pile<T> {
    pieces: Vec<Vec<T>>,
    /// Things of one entry, which stay together.
    width: usize,
    /// Entries.
    length: usize,
}

/// Entries of a piece.
const PIECE: usize = 1 << 16;

impl<T: Copy> Pile<T> {
    /// No entries; each is to be of `width` things.
    pub(super) const fn new(width: usize) -> Self {
        Self { pieces: Vec::new(), width, length: 0 }
    }

    pub(super) const fn len(&self) -> usize {
        self.length
    }

    /// The bytes that it takes.
    pub(super) fn bytes(&self) -> u64 {
        let full = self.pieces.len().saturating_sub(1) * PIECE * self.width;
        ((full + self.pieces.last().map_or(0, Vec::capacity)) * size_of::<T>()) as u64
    }

    pub(super) fn push(&mut self, entry: impl IntoIterator<Item = T>) {
        if self.length.is_multiple_of(PIECE) {
            self.pieces.push(Vec::new());
        }
        if let Some(piece) = self.pieces.last_mut() {
            piece.extend(entry);
            self.length += 1;
        }
    }

    pub(super) fn entry(&self, place: usize) -> &[T] {
        let first = place % PIECE * self.width;
        &self.pieces[place / PIECE][first..first + self.width]
    }
}

impl<T: Copy> Pile<T> {
    /// The only thing of an entry.
    pub(super) fn at(&self, place: usize) -> T {
        self.entry(place)[0]
    }
}

/// The parts that were met, each once.
struct Parts<P> {
    places: HashTable<u32>,
    parts: Vec<P>,
}

impl<P: Eq + Hash> Parts<P> {
    fn number(&mut self, part: P) -> u32 {
        let Self { places, parts } = self;
        let hash = FxBuildHasher.hash_one(&part);
        let same = |&place: &u32| parts[place as usize] == part;
        if let Some(&place) = places.find(hash, same) {
            return place;
        }
        let place = parts.len() as u32;
        places.insert_unique(hash, place, |&place| FxBuildHasher.hash_one(&parts[place as usize]));
        parts.push(part);
        place
    }
}

/// States by the numbers of their parts. A number takes as many bytes as the largest needs.
pub(super) struct Known<P> {
    parts: Parts<P>,
    /// Bytes of a number.
    width: usize,
    /// Parts of a state.
    places: usize,
    codes: Pile<u8>,
    nodes: HashTable<u32>,
    /// The numbers of the parts of the state whose steps are made: most are those of the states after them.
    before: Vec<u32>,
    /// The numbers of the parts of a state in the making, and as bytes.
    numbers: Vec<u32>,
    code: Vec<u8>,
}

impl<P: Clone + Eq + Hash> Known<P> {
    pub(super) const fn new() -> Self {
        Self {
            parts: Parts { places: HashTable::new(), parts: Vec::new() },
            width: 1,
            places: 0,
            codes: Pile::new(0),
            nodes: HashTable::new(),
            before: Vec::new(),
            numbers: Vec::new(),
            code: Vec::new(),
        }
    }

    /// The number of states.
    pub(super) const fn len(&self) -> usize {
        self.codes.len()
    }

    /// The bytes that they take, and will have taken once the next one is there.
    pub(super) fn bytes(&self) -> u64 {
        let grows = self.nodes.len() == self.nodes.capacity();
        let table = self.nodes.allocation_size() as u64 * if grows { 3 } else { 1 };
        let parts = self.parts.parts.capacity() * size_of::<P>() + self.parts.places.allocation_size();
        self.codes.bytes() + table + parts as u64
    }

    /// Makes ready for the states that steps from this one lead to.
    pub(super) fn go_on_from(&mut self, node: usize) {
        let mut before = std::mem::take(&mut self.before);
        before.clear();
        before.extend((0..self.places).map(|place| self.number(node, place)));
        self.before = before;
    }

    /// The number of `state`, and whether it is new.
    pub(super) fn meet<S: System<Part = P>>(&mut self, system: &S, state: &S::State) -> (u32, bool) {
        self.encode(system, state);
        let hash = hash(&self.code);
        let (codes, code) = (&self.codes, &self.code[..]);
        if let Some(&node) = self.nodes.find(hash, |&node| codes.entry(node as usize) == code) {
            return (node, false);
        }
        let node = codes.len() as u32;
        self.nodes.insert_unique(hash, node, |&node| self::hash(codes.entry(node as usize)));
        self.codes.push(self.code.iter().copied());
        (node, true)
    }

    /// The number of `state`, if it is known.
    pub(super) fn find<S: System<Part = P>>(&mut self, system: &S, state: &S::State) -> Option<u32> {
        self.encode(system, state);
        let (codes, code) = (&self.codes, &self.code[..]);
        self.nodes.find(hash(code), |&node| codes.entry(node as usize) == code).copied()
    }

    fn encode<S: System<Part = P>>(&mut self, system: &S, state: &S::State) {
        let Self { numbers, before, parts, .. } = self;
        numbers.clear();
        for place in 0..system.places(state) {
            let number = match before.get(place) {
                Some(&number) if system.is_part(state, place, &parts.parts[number as usize]) => number,
                Some(_) | None => parts.number(system.part(state, place)),
            };
            numbers.push(number);
        }
        if self.codes.len() == 0 {
            self.places = self.numbers.len();
            self.codes = Pile::new(self.places * self.width);
        }
        assert_eq!(self.numbers.len(), self.places, "all states of a system have the same number of parts");
        while self.parts.parts.len() > 1 << (8 * self.width) {
            self.widen();
        }
        self.code.clear();
        for number in &self.numbers {
            self.code.extend_from_slice(&number.to_le_bytes()[..self.width]);
        }
    }

    /// Writes all numbers with a byte more.
    fn widen(&mut self) {
        let mut codes = Pile::new(self.places * (self.width + 1));
        for node in 0..self.codes.len() {
            let numbers = self.codes.entry(node).chunks_exact(self.width);
            codes.push(numbers.flat_map(|number| number.iter().copied().chain([0])));
        }
        self.width += 1;
        self.codes = codes;
        self.nodes.clear();
        for node in 0..self.codes.len() {
            let codes = &self.codes;
            let hash_of = |&node: &u32| hash(codes.entry(node as usize));
            self.nodes.insert_unique(hash(codes.entry(node)), node as u32, hash_of);
        }
    }

    /// The number of the part of a state in this place.
    fn number(&self, node: usize, place: usize) -> u32 {
        let bytes = &self.codes.entry(node)[place * self.width..][..self.width];
        bytes.iter().rev().fold(0, |number, &byte| number << 8 | u32::from(byte))
    }

    /// The parts of a state that it does not share with `shown`.
    pub(super) fn parts(&self, node: usize, shown: Option<usize>) -> impl Iterator<Item = (usize, &P)> {
        (0..self.places).filter_map(move |place| {
            let number = self.number(node, place);
            let is_shown = shown.is_some_and(|shown| self.number(shown, place) == number);
            (!is_shown).then(|| (place, &self.parts.parts[number as usize]))
        })
    }
}

fn hash(code: &[u8]) -> u64 {
    FxBuildHasher.hash_one(code)
}

#[cfg(test)]
mod tests {
    use std::iter;

    use super::super::Step;
    use super::*;

    /// States of three parts.
    struct Triples;

    impl System for Triples {
        type State = [u32; 3];
        type Part = u32;
        type Demand = ();

        fn places(&self, _: &[u32; 3]) -> usize {
            3
        }

        fn part(&self, state: &[u32; 3], place: usize) -> u32 {
            state[place]
        }

        fn put(&self, state: &mut [u32; 3], place: usize, &part: &u32) {
            state[place] = part;
        }

        fn steps(&self, _: &[u32; 3]) -> impl Iterator<Item = Step<[u32; 3], ()>> {
            iter::empty()
        }
    }

    /// More parts than one and two bytes can number; each state shares one part with the one before.
    #[test]
    fn states_stay_apart_and_come_back_when_their_numbers_grow() {
        const STATES: u32 = 70_000;
        let mut known = Known::new();
        let parts = |state: u32| [state, state + 1, 7];
        for state in 0..STATES {
            assert_eq!(known.meet(&Triples, &parts(state)), (state, true));
            known.go_on_from(state as usize);
        }
        assert_eq!(known.width, 3);
        for state in (0..STATES).step_by(97) {
            assert_eq!(known.meet(&Triples, &parts(state)), (state, false));
            let shown: Vec<(usize, &u32)> = known.parts(state as usize, None).collect();
            assert_eq!(shown, [(0, &state), (1, &(state + 1)), (2, &7)]);
        }
        assert_eq!(known.find(&Triples, &[1, 1, 7]), None);
        let shared: Vec<(usize, &u32)> = known.parts(5, Some(0)).collect();
        assert_eq!(shared, [(0, &5), (1, &6)]);
    }

    #[test]
    fn bytes_are_those_of_full_pieces_and_of_the_last_one() {
        let mut pile = Pile::new(2);
        (0..=PIECE as u32).for_each(|entry| pile.push([entry, !entry]));
        assert_eq!((pile.len(), pile.entry(PIECE)), (PIECE + 1, &[PIECE as u32, !(PIECE as u32)][..]));
        let full = (PIECE * 2 * size_of::<u32>()) as u64;
        assert!((full + 8..full + 64).contains(&pile.bytes()), "{}", pile.bytes());
    }
}

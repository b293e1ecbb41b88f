//! The states that are known, each as the numbers of its parts.

use std::hash::{BuildHasher, Hash};

use hashbrown::HashTable;
use hashbrown::hash_table::Entry;
use rustc_hash::FxBuildHasher;

use super::{Places, System};

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

/// The hash of a state.
type HashOfState = u32;

/// A state by the numbers of its parts: most of them are also those of the states before and after it.
#[derive(Default)]
struct Code {
    bytes: Vec<u8>,
    hash: HashOfState,
}

impl Code {
    /// The state of so many parts whose numbers, of `width` bytes, are all 0.
    fn zero(places: usize, width: usize) -> Self {
        Self {
            bytes: vec![0; places * width],
            hash: (0..places).fold(0, |hash, place| hash ^ hash_at(place, 0)),
        }
    }

    /// Makes `number` the one in this place.
    fn put(&mut self, place: usize, width: usize, number: u32) {
        let bytes = &mut self.bytes[place * width..(place + 1) * width];
        self.hash ^= hash_at(place, self::number(bytes)) ^ hash_at(place, number);
        bytes.iter_mut().zip(number.to_le_bytes()).for_each(|(byte, of)| *byte = of);
    }

    fn set_to(&mut self, other: &Self) {
        self.bytes.clone_from(&other.bytes);
        self.hash = other.hash;
    }
}

/// States by the numbers of their parts. A number takes as many bytes as the largest needs.
pub(super) struct StateTable<P> {
    parts: Parts<P>,
    /// Bytes of a number.
    width: usize,
    /// Parts of a state.
    places: usize,
    codes: Pile<u8>,
    /// The states by their hashes, each with its own beside it: the table grows without a look at the numbers.
    nodes: HashTable<(u32, HashOfState)>,
    /// The state that is shown; at first none, and all numbers are 0.
    shown: Code,
    /// The state in the making.
    made: Code,
}

impl<P: Clone + Eq + Hash> StateTable<P> {
    pub(super) fn new() -> Self {
        Self {
            parts: Parts { places: HashTable::new(), parts: Vec::new() },
            width: 1,
            places: 0,
            codes: Pile::new(0),
            nodes: HashTable::new(),
            shown: Code::default(),
            made: Code::default(),
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

    /// Makes a state the one that is shown: `put` gets the parts that it does not share with the one that was before,
    /// each with its place.
    pub(super) fn show(&mut self, node: usize, mut put: impl FnMut(usize, &P)) {
        let Self { parts, codes, places, width, shown, .. } = self;
        let code = codes.entry(node);
        for place in 0..*places {
            let number_in = |bytes: &[u8]| number(&bytes[place * *width..(place + 1) * *width]);
            let number = number_in(code);
            if number != number_in(&shown.bytes) {
                put(place, &parts.parts[number as usize]);
                shown.put(place, *width, number);
            }
        }
    }

    /// Makes the state in the making, whose parts are all put, the one that is shown.
    pub(super) fn show_last(&mut self) {
        self.shown.set_to(&self.made);
    }

    /// The number of `state`, and whether it is new. It has the parts of the state that is shown, but for those that
    /// are `differing`.
    pub(super) fn meet<S: System<Part = P>>(
        &mut self,
        system: &S,
        state: &S::State,
        differing: Places,
    ) -> (u32, bool) {
        self.take_apart(system, state, differing);
        let Self { nodes, codes, made, .. } = self;
        match nodes.entry(spread(made.hash), is_same(made, codes), |&(_, hash)| spread(hash)) {
            Entry::Occupied(known) => (known.get().0, false),
            Entry::Vacant(vacant) => {
                let node = codes.len() as u32;
                vacant.insert((node, made.hash));
                codes.push(made.bytes.iter().copied());
                (node, true)
            }
        }
    }

    /// The number of `state`, if it is known.
    pub(super) fn find<S: System<Part = P>>(&mut self, system: &S, state: &S::State) -> Option<u32> {
        self.take_apart(system, state, Places::MAX);
        let same = is_same(&self.made, &self.codes);
        self.nodes.find(spread(self.made.hash), same).map(|&(node, _)| node)
    }

    /// Makes `state` the one in the making.
    fn take_apart<S: System<Part = P>>(&mut self, system: &S, state: &S::State, differing: Places) {
        if self.codes.len() == 0 {
            self.places = system.places(state);
            self.codes = Pile::new(self.places * self.width);
            self.shown = Code::zero(self.places, self.width);
        }
        assert_eq!(system.places(state), self.places, "all states of a system have the same number of parts");
        while self.parts.parts.len() + self.places > 1 << (8 * self.width) {
            self.widen();
        }
        let Self { parts, places, width, shown, made, .. } = self;
        made.set_to(shown);
        let differs = |place: usize| place >= Places::BITS as usize || differing >> place & 1 == 1;
        for place in (0..*places).filter(|&place| differs(place)) {
            made.put(place, *width, parts.number(system.part(state, place)));
        }
        debug_assert!(
            (0..*places).all(|place| {
                let number = number(&made.bytes[place * *width..(place + 1) * *width]);
                parts.parts[number as usize] == system.part(state, place)
            }),
            "it does differ"
        );
    }

    /// Writes all numbers with a byte more.
    fn widen(&mut self) {
        let mut codes = Pile::new(self.places * (self.width + 1));
        for node in 0..self.codes.len() {
            codes.push(widened(self.codes.entry(node), self.width));
        }
        self.codes = codes;
        self.shown.bytes = widened(&self.shown.bytes, self.width).collect();
        self.width += 1;
    }
}

/// The numbers of `code`, which are of `width` bytes, each with a byte more.
fn widened(code: &[u8], width: usize) -> impl Iterator<Item = u8> {
    code.chunks_exact(width).flat_map(|number| number.iter().copied().chain([0]))
}

fn number(bytes: &[u8]) -> u32 {
    match *bytes {
        [a] => u32::from(a),
        [a, b] => u32::from_le_bytes([a, b, 0, 0]),
        [a, b, c] => u32::from_le_bytes([a, b, c, 0]),
        _ => bytes.iter().rev().fold(0, |number, &byte| number << 8 | u32::from(byte)),
    }
}

/// The share of a place in the hash of a state, so that where one part changes, one share does (Zobrist 1970):
/// splitmix64 (Steele, Lea and Flood 2014) of place and number.
const fn hash_at(place: usize, number: u32) -> HashOfState {
    let mixed = ((place as u64 + 1) << u32::BITS | number as u64).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    let mixed = (mixed ^ mixed >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let mixed = (mixed ^ mixed >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
    (mixed >> u32::BITS) as HashOfState
}

/// Whether a state in the table has this code.
fn is_same(code: &Code, codes: &Pile<u8>) -> impl Fn(&(u32, HashOfState)) -> bool {
    |&(node, hash)| hash == code.hash && codes.entry(node as usize) == code.bytes
}

/// The bits that a table asks for: it looks at the highest and at the lowest.
const fn spread(hash: HashOfState) -> u64 {
    (hash as u64).wrapping_mul(0x9e37_79b9_7f4a_7c15)
}

#[cfg(test)]
mod tests {
    use tautline_kernel::choice::Oracle;

    use super::*;
    use crate::engine::world::{Turn, World};

    /// States of three parts.
    struct Triples;

    impl World for Triples {
        type State = [u32; 3];
        type Plan = ();
        type Event = ();
        type Demand = ();

        fn plan(&self, _: &mut [u32; 3], _: &[u8]) -> Option<()> {
            None
        }

        fn settle(&self, _: &mut [u32; 3], (): &(), _: &mut Vec<u8>, _: &mut impl Oracle) {}

        fn broken_by(&self, _: &Turn<'_, Self>) -> Vec<()> {
            Vec::new()
        }
    }

    impl System for Triples {
        type Part = u32;

        fn places(&self, _: &[u32; 3]) -> usize {
            3
        }

        fn part(&self, state: &[u32; 3], place: usize) -> u32 {
            state[place]
        }

        fn put(&self, state: &mut [u32; 3], place: usize, &part: &u32) {
            state[place] = part;
        }
    }

    /// More parts than one and two bytes can number; each state shares one part with the one before.
    #[test]
    fn states_stay_apart_and_come_back_when_their_numbers_grow() {
        const STATES: u32 = 70_000;
        let mut known = StateTable::new();
        let parts = |state: u32| [state, state + 1, 7];
        for state in 0..STATES {
            let differing = if state == 0 { Places::MAX } else { 0b011 };
            assert_eq!(known.meet(&Triples, &parts(state), differing), (state, true));
            known.show_last();
        }
        assert_eq!(known.width, 3);
        let put = |known: &mut StateTable<u32>, state: u32| {
            let mut put = Vec::new();
            known.show(state as usize, |place, &part| put.push((place, part)));
            put
        };
        for state in (0..STATES).step_by(97) {
            put(&mut known, state);
            assert_eq!(known.meet(&Triples, &parts(state + 1), 0b011), (state + 1, false));
            assert_eq!(known.meet(&Triples, &[state, 7, 7], 0b010), (known.len() as u32 - 1, true));
        }
        assert_eq!(known.find(&Triples, &[1, 1, 7]), None);
        assert_eq!(put(&mut known, 5), [(0, 5), (1, 6)]);
        assert_eq!(put(&mut known, 5), []);
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

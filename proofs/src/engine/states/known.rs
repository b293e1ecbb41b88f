//! The states that are known, each as the numbers of its parts: the last ones in memory, those before perhaps on disk.

use std::hash::{BuildHasher, Hash, Hasher};
use std::hint::black_box;
use std::mem;
use std::ops::Range;

use rustc_hash::FxBuildHasher;

use super::spill::{Disk, SpillError, Wanted};
use super::tables::{Codes, Slots};
use super::{Places, System};

/// The parts that were met, each once.
struct Parts<P> {
    slots: Slots,
    parts: Vec<P>,
}

impl<P: Eq + Hash> Parts<P> {
    fn number(&mut self, part: P) -> u32 {
        let Self { slots, parts } = self;
        let hash = folded(FxBuildHasher.hash_one(&part));
        slots.find(hash, |number| parts[number as usize] == part).unwrap_or_else(|| {
            let number = parts.len() as u32;
            slots.insert(hash, number);
            parts.push(part);
            number
        })
    }
}

/// The hash of a state.
pub(super) type HashOfState = u32;

/// A state by the numbers of its parts, most of which are also those of the states before and after it, or in bytes of
/// its own.
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

/// States by the numbers of their parts, of which each takes as many bytes as the largest needs; or, where states have
/// no parts, in bytes of their own.
pub(super) struct StateTable<P> {
    parts: Parts<P>,
    /// Bytes of a number.
    width: usize,
    /// Parts of a state.
    places: usize,
    codes: Codes,
    /// The states in memory by their hashes.
    nodes: Slots,
    /// The states on disk, and how many they are.
    pub(super) disk: Option<Disk>,
    on_disk: usize,
    /// States that are looked up together, so that the memory answers for all of them at once.
    queue: Queue,
    /// The state that is shown; at first none, and all numbers are 0.
    shown: Code,
    /// The state in the making.
    made: Code,
}

impl<P: Clone + Eq + Hash> StateTable<P> {
    pub(super) fn new() -> Self {
        Self {
            parts: Parts { slots: Slots::default(), parts: Vec::new() },
            width: 1,
            places: 0,
            codes: Codes::default(),
            nodes: Slots::default(),
            disk: None,
            on_disk: 0,
            queue: Queue::default(),
            shown: Code::default(),
            made: Code::default(),
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
    fn code(&self, node: usize) -> Option<&[u8]> {
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
        while self.places > 0 && self.width < size_of::<u32>() {
            self.widen();
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

    /// Looks on disk for the states of queues that are not in memory, by so many workers. False if it cannot be read.
    pub(super) fn look_up_on_disk<'a>(
        &mut self,
        queues: impl Iterator<Item = &'a mut Queue>,
        workers: usize,
    ) -> bool {
        let Some(disk) = &mut self.disk else { return true };
        disk.look_up(queues.flat_map(Queue::unknown).collect(), workers)
    }

    /// Makes of `state`, which was shown last, the state of a node: only the parts that they do not share are put.
    /// False if it cannot be read.
    pub(super) fn show<S: System<Part = P>>(
        &mut self,
        system: &S,
        node: usize,
        state: &mut S::State,
    ) -> bool {
        if !self.load(node..node + 1) {
            return false;
        }
        let mut shown = mem::take(&mut self.shown);
        let (code, width) = (self.code(node).unwrap_or_default(), self.width);
        if self.places == 0 {
            system.read(state, code);
        }
        for place in 0..self.places {
            let number_in = |bytes: &[u8]| number(&bytes[place * width..(place + 1) * width]);
            let number = number_in(code);
            if number != number_in(&shown.bytes) {
                system.put(state, place, &self.parts.parts[number as usize]);
                shown.put(place, width, number);
            }
        }
        self.shown = shown;
        true
    }

    /// Makes the state in the making, whose parts are all put, the one that is shown.
    pub(super) fn show_last(&mut self) {
        self.shown.set_to(&self.made);
    }

    /// Puts `state` into the queue. It has the parts of the state that is shown, but for those that are `differing`.
    pub(super) fn queue<S: System<Part = P>>(&mut self, system: &S, state: &S::State, differing: Places) {
        self.take_apart(system, state, differing);
        self.queue.push(&self.made);
    }

    /// The bytes that the queue takes.
    pub(super) const fn queued_bytes(&self) -> u64 {
        self.queue.bytes() as u64
    }

    /// The states that were put into the queue, looked up in memory.
    pub(super) fn queued(&mut self) -> Queue {
        let mut queue = mem::take(&mut self.queue);
        self.look_up(&mut queue);
        queue
    }

    /// Looks for the states of a queue among those in memory.
    pub(super) fn look_up(&self, queue: &mut Queue) {
        let Self { nodes, codes, on_disk, .. } = self;
        // No look waits for the one before it: first into the table, then among the codes.
        black_box(queue.states.iter().fold(0, |all, state| all ^ nodes.slot(state.hash)));
        for state in &mut queue.states {
            state.node = nodes.first(state.hash);
        }
        let mut first = 0;
        for state in &mut queue.states {
            let code = &queue.bytes[first..state.end];
            first = state.end;
            state.node = state.node.filter(|&node| codes.entry(node as usize - on_disk) == code);
        }
    }

    /// Meets the next state of a queue in which all were looked up: its number, and whether it is new.
    pub(super) fn meet_next(&mut self, queue: &mut Queue) -> (u32, bool) {
        let Self { nodes, codes, on_disk, .. } = self;
        let state = &queue.states[queue.met];
        let code = &queue.bytes[queue.first..state.end];
        (queue.met, queue.first) = (queue.met + 1, state.end);
        let is_it = |node: u32| codes.entry(node as usize - *on_disk) == code;
        // Since it was looked up, it may have been met.
        let known = state.node.or_else(|| nodes.find(state.hash, is_it));
        let node = known.unwrap_or_else(|| {
            let node = (*on_disk + codes.length) as u32;
            nodes.insert(state.hash, node);
            codes.push(code);
            node
        });
        (node, known.is_none())
    }

    /// Makes `state`, which has no parts, that of a node that is loaded.
    pub(super) fn read<S: System<Part = P>>(&self, system: &S, node: usize, state: &mut S::State) -> bool {
        self.code(node).map(|code| system.read(state, code)).is_some()
    }

    /// Whether `state` is that of a node.
    pub(super) fn is_at<S: System<Part = P>>(&mut self, system: &S, state: &S::State, node: usize) -> bool {
        self.take_apart(system, state, Places::MAX);
        self.load(node..node + 1) && self.code(node) == Some(&self.made.bytes)
    }

    /// Whether states are kept in bytes of their own.
    pub(super) const fn is_bytes(&self) -> bool {
        self.places == 0
    }

    /// The number of `state`, if it is in memory.
    pub(super) fn find<S: System<Part = P>>(&mut self, system: &S, state: &S::State) -> Option<u32> {
        self.take_apart(system, state, Places::MAX);
        let Self { nodes, codes, made, on_disk, .. } = self;
        nodes.find(made.hash, |node| codes.entry(node as usize - *on_disk) == made.bytes)
    }

    /// Makes `state` the one in the making.
    fn take_apart<S: System<Part = P>>(&mut self, system: &S, state: &S::State, differing: Places) {
        if self.len() == 0 {
            self.places = system.places(state);
            self.shown = Code::zero(self.places, self.width);
        }
        if self.places == 0 {
            self.made.bytes.clear();
            system.write(state, &mut self.made.bytes);
            self.made.hash = hash_of(&self.made.bytes);
            return;
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
        let (mut codes, mut code) = (Codes::default(), Vec::new());
        for node in 0..self.codes.length {
            code.clear();
            code.extend(widened(self.codes.entry(node), self.width));
            codes.push(&code);
        }
        self.codes = codes;
        self.shown.bytes = widened(&self.shown.bytes, self.width).collect();
        self.queue.bytes = widened(&self.queue.bytes, self.width).collect();
        for state in &mut self.queue.states {
            state.end += state.end / self.width;
        }
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

/// The hash of bytes.
pub(super) fn hash_of(bytes: &[u8]) -> HashOfState {
    let mut hasher = FxBuildHasher.build_hasher();
    hasher.write(bytes);
    folded(hasher.finish())
}

/// The bits of a hash that depend on all of it.
const fn folded(hash: u64) -> HashOfState {
    (hash.wrapping_mul(0x9e37_79b9_7f4a_7c15) >> u32::BITS) as HashOfState
}

/// States that wait to be looked up.
#[derive(Default)]
pub(super) struct Queue {
    /// Their codes, one after the other.
    bytes: Vec<u8>,
    states: Vec<Queued>,
    /// How many were met, and where the code of the next one begins.
    met: usize,
    first: usize,
}

struct Queued {
    hash: HashOfState,
    /// Where its code ends.
    end: usize,
    /// Its number, if it is known.
    node: Option<u32>,
}

impl Queue {
    fn push(&mut self, code: &Code) {
        self.bytes.extend_from_slice(&code.bytes);
        self.states.push(Queued { hash: code.hash, end: self.bytes.len(), node: None });
    }

    /// Puts a state without parts into it.
    pub(super) fn write<S: System>(&mut self, system: &S, state: &S::State) {
        let first = self.bytes.len();
        system.write(state, &mut self.bytes);
        let hash = hash_of(&self.bytes[first..]);
        self.states.push(Queued { hash, end: self.bytes.len(), node: None });
    }

    /// The numbers of the states, of those that were found.
    pub(super) fn found(&self) -> impl Iterator<Item = Option<u32>> {
        self.states.iter().map(|state| state.node)
    }

    /// The states that were not found, to be looked for on disk.
    fn unknown(&mut self) -> impl Iterator<Item = Wanted<'_>> {
        let (bytes, mut first) = (&self.bytes, 0);
        let all = self.states.iter_mut().map(move |state| {
            let code = &bytes[mem::replace(&mut first, state.end)..state.end];
            Wanted { hash: state.hash, code, node: &mut state.node }
        });
        all.filter(|wanted| wanted.node.is_none())
    }

    /// The bytes that it takes while its states are looked for on disk.
    pub(super) const fn bytes(&self) -> usize {
        self.bytes.len() + self.states.len() * (size_of::<Queued>() + size_of::<Wanted<'_>>())
    }
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

    fn meet(known: &mut StateTable<u32>, state: &[u32; 3], differing: Places) -> (u32, bool) {
        known.queue(&Triples, state, differing);
        let mut queue = known.queued();
        known.meet_next(&mut queue)
    }

    /// The second one needs numbers of two bytes.
    #[test]
    fn states_that_are_looked_up_together_are_met_in_their_order() {
        let mut known = StateTable::new();
        meet(&mut known, &[0, 0, 0], Places::MAX);
        known.show_last();
        let states = [[1, 2, 3], [4, 5, 6], [1, 2, 3], [0, 0, 0]];
        for part in 7..260 {
            known.parts.number(part);
        }
        for state in states {
            known.queue(&Triples, &state, Places::MAX);
        }
        let mut queue = known.queued();
        let met = states.map(|_| known.meet_next(&mut queue));
        assert_eq!(known.width, 2);
        assert_eq!(met, [(1, true), (2, true), (1, false), (0, false)]);
    }

    /// More parts than one and two bytes can number; each state shares one part with the one before.
    #[test]
    fn states_stay_apart_and_come_back_when_their_numbers_grow() {
        const STATES: u32 = 70_000;
        let mut known = StateTable::new();
        let parts = |state: u32| [state, state + 1, 7];
        for state in 0..STATES {
            let differing = if state == 0 { Places::MAX } else { 0b011 };
            assert_eq!(meet(&mut known, &parts(state), differing), (state, true));
            known.show_last();
        }
        assert_eq!(known.width, 3);
        let mut shown = parts(STATES - 1);
        for state in (0..STATES).step_by(97) {
            known.show(&Triples, state as usize, &mut shown);
            assert_eq!(shown, parts(state));
            assert_eq!(meet(&mut known, &parts(state + 1), 0b011), (state + 1, false));
            assert_eq!(meet(&mut known, &[state, 7, 7], 0b010), (known.len() as u32 - 1, true));
        }
        assert_eq!(known.find(&Triples, &[1, 1, 7]), None);
        // The part that both share is not put.
        shown[2] = 0;
        known.show(&Triples, 5, &mut shown);
        assert_eq!(shown, [5, 6, 0]);
    }
}

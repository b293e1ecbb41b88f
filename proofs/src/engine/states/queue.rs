//! States that wait to be looked up. Whoever makes them only reads the table of states: parts that it does not have are
//! numbered behind its own, in the order in which they were met. The table takes them in the order of the states from
//! which they were made, so that their numbers in it are the same whoever has made them.

use std::hash::Hash;
use std::hint::black_box;
use std::mem;

use super::code::{Code, HashOfState, hash_of, hash_of_part, number};
use super::spill::Lookup;
use super::state_table::{Parts, StateTable};
use super::{Places, System, has};

/// Of so many states that are met in a debug build one is compared as a whole with what is told to differ.
const COMPARED: HashOfState = 32;

/// States that wait to be looked up in a table, in the order in which they are to be met.
pub(super) struct Queue<P> {
    /// Their codes, one after the other.
    bytes: Vec<u8>,
    states: Vec<QueueEntry>,
    /// How many were met, and where the code of the next one begins.
    met: usize,
    first: usize,
    /// Parts of a state.
    places: usize,
    /// The parts that the table had when the queue was begun.
    had: usize,
    /// The parts that it did not have.
    new: Parts<P>,
    /// The numbers that those of them have in the table that were taken, and whether they are those of the queue.
    numbers: Vec<u32>,
    is_renumbered: bool,
    made: Code,
}

struct QueueEntry {
    hash: HashOfState,
    /// Where its code ends.
    end: usize,
    /// Its number, if it is known.
    node: Option<u32>,
    /// Whether the table did not have a part of it.
    has_new: bool,
}

impl<P: Clone + Eq + Hash> Queue<P> {
    /// An empty one, for no table yet.
    pub(super) fn new() -> Self {
        Self {
            bytes: Vec::new(),
            states: Vec::new(),
            met: 0,
            first: 0,
            places: 0,
            had: 0,
            new: Parts::new(),
            numbers: Vec::new(),
            is_renumbered: false,
            made: Code::default(),
        }
    }

    /// An empty one.
    pub(super) fn for_table(table: &StateTable<P>) -> Self {
        let mut queue = Self::new();
        queue.begin(table);
        queue
    }

    /// Makes it an empty one for this table.
    pub(super) fn begin(&mut self, table: &StateTable<P>) {
        self.bytes.clear();
        self.states.clear();
        self.numbers.clear();
        (self.met, self.first, self.is_renumbered) = (0, 0, false);
        (self.places, self.had) = (table.places, table.parts.parts.len());
        if self.new_parts() > 0 {
            self.new = Parts::new();
        }
    }

    /// Puts a state into it, which has the parts of the one with the code `shown`, but for those that are `differing`;
    /// or parts of its own alone, if `shown` has none.
    pub(super) fn put<S: System<Part = P>>(
        &mut self,
        (system, table): (&S, &StateTable<P>),
        shown: &Code,
        state: &S::State,
        differing: Places,
    ) {
        if self.places == 0 {
            let first = self.bytes.len();
            system.write(state, &mut self.bytes);
            self.push(hash_of(&self.bytes[first..]), false);
            return;
        }
        assert_eq!(system.places(state), self.places, "all states of a system have the same number of parts");
        let Self { had, places, new, made, .. } = self;
        let mut has_new = false;
        let mut number = |place| {
            let part = system.part(state, place);
            let hash = hash_of_part(&part);
            table.parts.find(hash, &part).unwrap_or_else(|| {
                has_new = true;
                *had as u32 + new.number(hash, &part)
            })
        };
        if shown.bytes.is_empty() {
            made.clear(table.width);
            (0..*places).for_each(|place| made.push(number(place)));
        } else {
            made.set_to(shown);
            (0..*places)
                .filter(|&place| has(differing, place))
                .for_each(|place| made.put(place, number(place)));
        }
        debug_assert!(
            !made.hash.is_multiple_of(COMPARED)
                || (0..*places).all(|place| made.at(place) == Some(number(place))),
            "it does differ"
        );
        self.bytes.extend_from_slice(&self.made.bytes);
        self.push(self.made.hash, has_new);
    }

    /// How many parts of its states the table did not have.
    pub(super) const fn new_parts(&self) -> usize {
        self.new.parts.len()
    }

    fn push(&mut self, hash: HashOfState, has_new: bool) {
        self.states.push(QueueEntry { hash, end: self.bytes.len(), node: None, has_new });
    }

    /// Gives the next new parts their numbers in the table.
    pub(super) fn renumber(&mut self, count: usize, table: &mut Parts<P>) {
        for part in &self.new.parts[self.numbers.len()..][..count] {
            let number = table.number(hash_of_part(part), part);
            self.is_renumbered |= number as usize != self.had + self.numbers.len();
            self.numbers.push(number);
        }
    }

    /// The next state, whose new parts have their numbers: its hash, its code in a table of numbers of so many bytes,
    /// and its own number if it was found.
    pub(super) fn next(&mut self, width: usize) -> (HashOfState, &[u8], Option<u32>) {
        let QueueEntry { hash, end, node, has_new } = self.states[self.met];
        let code = &self.bytes[mem::replace(&mut self.first, end)..end];
        self.met += 1;
        let is_renumbered = has_new && self.is_renumbered;
        if node.is_some() || !is_renumbered && (self.places == 0 || code.len() == self.places * width) {
            return (hash, code, node);
        }
        let before = code.len() / self.places;
        self.made.clear(width);
        for number in code.chunks_exact(before).map(number) {
            let new = (number as usize).checked_sub(self.had);
            self.made.push(new.map_or(number, |new| self.numbers[new]));
        }
        (self.made.hash, &self.made.bytes, None)
    }

    /// Looks for the states in memory, but for those that cannot be there.
    pub(super) fn look_up(&mut self, StateTable { nodes, codes, on_disk, .. }: &StateTable<P>) {
        // No look waits for the one before it: first into the table, then among the codes.
        black_box(self.states.iter().fold(0, |all, state| all ^ nodes.slot(state.hash)));
        for state in self.states.iter_mut().filter(|state| !state.has_new) {
            state.node = nodes.first(state.hash);
        }
        let mut first = 0;
        for state in &mut self.states {
            let code = &self.bytes[mem::replace(&mut first, state.end)..state.end];
            state.node = state.node.filter(|&node| codes.entry(node as usize - on_disk) == code);
        }
    }

    /// The states that were not found, to be looked for on disk.
    pub(super) fn unknown(&mut self) -> impl Iterator<Item = Lookup<'_>> {
        let (bytes, mut first) = (&self.bytes, 0);
        let all = self.states.iter_mut().map(move |state| {
            let code = &bytes[mem::replace(&mut first, state.end)..state.end];
            (!state.has_new).then_some(Lookup { hash: state.hash, code, node: &mut state.node })
        });
        all.flatten().filter(|wanted| wanted.node.is_none())
    }

    /// The numbers of the states, of those that were found.
    pub(super) fn found(&self) -> impl Iterator<Item = Option<u32>> {
        self.states.iter().map(|state| state.node)
    }

    /// The hash and the code of the first state.
    pub(super) fn front(&self) -> Option<(HashOfState, &[u8])> {
        self.states.first().map(|state| (state.hash, &self.bytes[..state.end]))
    }

    /// The bytes that it takes while its states are looked for on disk.
    pub(super) const fn bytes(&self) -> usize {
        self.bytes.len() + self.states.len() * (size_of::<QueueEntry>() + size_of::<Lookup<'_>>())
    }
}

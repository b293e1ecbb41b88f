//! States that wait to be looked up. Whoever makes them only reads the table of states: parts that it does not have are
//! numbered behind its own, in the order in which they were met. The table takes them in the order of the states from
//! which they were made, so that their numbers in it are the same whoever has made them.

use std::hash::Hash;
use std::hint::black_box;
use std::mem;

use super::code::{Code, HashOfState, hash_of, hash_of_part, number, width_of};
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

    /// The next state, whose new parts have their numbers: its hash, its code in a table of numbers of so many bytes,
    /// and its own number if it was found.
    fn next(&mut self, width: usize) -> (HashOfState, &[u8], Option<u32>) {
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
    fn unknown(&mut self) -> impl Iterator<Item = Lookup<'_>> {
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
    fn front(&self) -> Option<(HashOfState, &[u8])> {
        self.states.first().map(|state| (state.hash, &self.bytes[..state.end]))
    }

    /// The bytes that it takes while its states are looked for on disk.
    pub(super) const fn bytes(&self) -> usize {
        self.bytes.len() + self.states.len() * (size_of::<QueueEntry>() + size_of::<Lookup<'_>>())
    }
}

/// A table as queues find it.
impl<P: Clone + Eq + Hash> StateTable<P> {
    /// Looks on disk for the states of queues that are not in memory, by so many workers. False if it cannot be read.
    pub(super) fn look_up_on_disk<'a>(
        &mut self,
        queues: impl Iterator<Item = &'a mut Queue<P>>,
        workers: usize,
    ) -> bool
    where
        P: 'a,
    {
        let Some(disk) = &mut self.disk else { return true };
        disk.look_up(queues.flat_map(Queue::unknown).collect(), workers)
    }

    /// Takes the next new parts of the states of a queue, and gives them their numbers.
    pub(super) fn take_parts(&mut self, queue: &mut Queue<P>, count: usize) {
        for part in &queue.new.parts[queue.numbers.len()..][..count] {
            let number = self.parts.number(hash_of_part(part), part);
            queue.is_renumbered |= number as usize != queue.had + queue.numbers.len();
            queue.numbers.push(number);
        }
        self.widen(width_of(self.parts.parts.len() as u32));
    }

    /// Meets the next state of a queue in which all were looked up and whose parts are taken: its number, and whether
    /// it is new.
    pub(super) fn meet_next(&mut self, queue: &mut Queue<P>) -> (u32, bool) {
        let Self { nodes, codes, on_disk, width, .. } = self;
        let (hash, code, found) = queue.next(*width);
        // Since it was looked up, it may have been met.
        let known = found.or_else(|| nodes.find(hash, |node| codes.entry(node as usize - *on_disk) == code));
        let node = known.unwrap_or_else(|| {
            let node = (*on_disk + codes.length) as u32;
            nodes.insert(hash, node);
            codes.push(code);
            node
        });
        (node, known.is_none())
    }

    /// Whether `state` is that of a node.
    pub(super) fn is_at<S: System<Part = P>>(&mut self, system: &S, state: &S::State, node: usize) -> bool {
        let queue = self.queue_of(system, state);
        self.load(node..node + 1) && self.code(node) == queue.front().map(|(_, code)| code)
    }

    /// The number of `state`, if it is in memory.
    pub(super) fn find<S: System<Part = P>>(&self, system: &S, state: &S::State) -> Option<u32> {
        let queue = self.queue_of(system, state);
        let (hash, code) = queue.front()?;
        self.nodes.find(hash, |node| self.codes.entry(node as usize - self.on_disk) == code)
    }

    /// A queue with `state` alone.
    fn queue_of<S: System<Part = P>>(&self, system: &S, state: &S::State) -> Queue<P> {
        let mut queue = Queue::for_table(self);
        queue.put((system, self), &Code::default(), state, Places::MAX);
        queue
    }
}

#[cfg(test)]
mod tests {
    use tautline_kernel::choice::Oracle;

    use super::*;
    use crate::engine::states::state_table::Cursor;
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

    /// The table, and the state that is shown.
    struct TestTable(StateTable<u32>, Cursor<[u32; 3]>);

    impl TestTable {
        fn new() -> Self {
            let table = StateTable { places: 3, ..StateTable::new() };
            Self(table, Cursor { state: [0; 3], code: Code::default() })
        }

        fn meet(&mut self, states: &[[u32; 3]], differing: Places) -> Vec<(u32, bool)> {
            let Self(table, shown) = self;
            let mut queue = Queue::for_table(table);
            for state in states {
                queue.put((&Triples, table), &shown.code, state, differing);
            }
            queue.look_up(table);
            let count = queue.new_parts();
            table.take_parts(&mut queue, count);
            states.iter().map(|_| table.meet_next(&mut queue)).collect()
        }

        fn show(&mut self, node: u32) {
            self.0.show(&Triples, node as usize, &mut self.1).expect("it is in memory");
        }
    }

    /// The parts of the last one need numbers of two bytes.
    #[test]
    fn states_that_are_looked_up_together_are_met_in_their_order() {
        let mut known = TestTable::new();
        known.meet(&[[0, 0, 0]], Places::MAX);
        let many: Vec<_> = (0..84).map(|state| [3 * state + 1, 3 * state + 2, 3 * state + 3]).collect();
        known.meet(&many, Places::MAX);
        let met =
            known.meet(&[[1, 2, 3], [254, 0, 255], [254, 0, 255], [0, 0, 0], [256, 0, 257]], Places::MAX);
        assert_eq!(known.0.width, 2);
        assert_eq!(met, [(1, false), (85, true), (85, false), (0, false), (86, true)]);
    }

    /// The second queue was begun before the parts of the first one were taken, and has one of them.
    #[test]
    fn parts_that_two_queues_have_numbered_are_one() {
        let TestTable(mut table, shown) = TestTable::new();
        let mut queues = [[[1, 2, 3], [1, 2, 2]], [[4, 2, 1], [3, 2, 1]]].map(|states| {
            let mut queue = Queue::for_table(&table);
            for state in &states {
                queue.put((&Triples, &table), &shown.code, state, Places::MAX);
            }
            queue.look_up(&table);
            queue
        });
        for queue in &mut queues {
            let count = queue.new_parts();
            table.take_parts(queue, count);
            let met = [(); 2].map(|()| table.meet_next(queue).1);
            assert_eq!(met, [true, true]);
        }
        assert_eq!(table.parts.parts, [1, 2, 3, 4]);
        let known =
            [[1, 2, 3], [1, 2, 2], [4, 2, 1], [3, 2, 1], [2, 2, 2]].map(|state| table.find(&Triples, &state));
        assert_eq!(known, [Some(0), Some(1), Some(2), Some(3), None]);
    }

    /// Among so many states some have the hash of another one.
    #[test]
    fn states_with_one_hash_are_found_each_for_itself() {
        let mut known = TestTable::new();
        let states: Vec<_> = (0..200_000).map(|state| [state, state / 2, state % 7]).collect();
        known.meet(&states, Places::MAX);
        let TestTable(table, _) = known;
        let mut collisions = 0;
        for (node, state) in (0..).zip(&states) {
            let hash = table.queue_of(&Triples, state).front().map(|(hash, _)| hash);
            collisions += u32::from(hash.and_then(|hash| table.nodes.first(hash)) != Some(node));
            assert_eq!(table.find(&Triples, state), Some(node));
        }
        assert!(collisions > 0);
    }

    /// More parts than one and two bytes can number; each state shares one part with the one before.
    #[test]
    fn states_stay_apart_and_come_back_when_their_numbers_grow() {
        const STATES: u32 = 70_000;
        let mut known = TestTable::new();
        let parts = |state: u32| [state, state + 1, 7];
        for state in 0..STATES {
            assert_eq!(known.meet(&[parts(state)], 0b011), [(state, true)]);
            known.show(state);
        }
        assert_eq!(known.0.width, 3);
        for state in (0..STATES).step_by(97) {
            known.show(state);
            assert_eq!(known.1.state, parts(state));
            assert_eq!(known.meet(&[parts(state + 1)], 0b011), [(state + 1, false)]);
            assert_eq!(known.meet(&[[state, 7, 7]], 0b010), [(known.0.len() as u32 - 1, true)]);
        }
        assert_eq!(known.0.find(&Triples, &[1, 1, 7]), None);
        // The part that both share is not put.
        known.1.state[2] = 0;
        known.show(5);
        assert_eq!(known.1.state, [5, 6, 0]);
    }
}

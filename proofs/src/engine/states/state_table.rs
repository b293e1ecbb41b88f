//! The states that are known, each as the numbers of its parts: the last ones in memory, those before perhaps on disk.

use std::hash::Hash;
use std::mem;
use std::ops::Range;

use super::code::{Code, HashOfState, number, widened, width_of};
use super::queue::Queue;
use super::spill::{Disk, SpillError};
use super::tables::{Codes, Slots};
use super::{Places, System};

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

    /// Takes the next new parts of the states of a queue.
    pub(super) fn take_parts(&mut self, queue: &mut Queue<P>, count: usize) {
        queue.renumber(count, &mut self.parts);
        self.widen(width_of(self.parts.parts.len() as u32));
    }

    /// Meets the next state of a queue in which all were looked up and whose parts are
    /// taken: its number, and whether it is new.
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

    /// Whether states are kept in bytes of their own.
    pub(super) const fn is_bytes(&self) -> bool {
        self.places == 0
    }

    /// Writes all numbers with at least so many bytes.
    fn widen(&mut self, width: usize) {
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

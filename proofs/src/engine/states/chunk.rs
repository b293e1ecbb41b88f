//! Several workers on one search. Each makes the steps from some of the states that wait, and looks for where they lead
//! among the states that were known before. What they have made is taken in the order of the states, by one of them, so
//! that counts, runs and memory are the same for any number of workers.

use std::ops::{ControlFlow, Range};

use super::queue::Queue;
use super::state_table::{Cursor, StateTable};
use super::{Bits, Scratch, Step, System};
use crate::engine::threads;
use crate::engine::watchdog::Steps;

/// The fewest states that are shared out: a thread takes as long to begin as tens of steps.
pub(super) const FEWEST: usize = 1 << 10;

/// The most states that are shared out at a time.
pub const MOST: usize = 1 << 14;

/// The steps from states that follow one another, and where they lead; in memory that is kept from chunk to chunk.
pub(super) struct Chunk<S: System> {
    pub(super) queue: Queue<S::Part>,
    /// Of each step the situations that it is, who acts if it is bound to be made, and the demands that it breaks.
    pub(super) steps: Vec<(u64, Option<Bits>, Vec<S::Demand>)>,
    pub(super) nodes: Vec<Expansion<S::Demand>>,
    scratch: Scratch<S::State>,
}

/// A state from which all steps were made.
pub(super) struct Expansion<D> {
    pub(super) steps: usize,
    /// The parts of the states to which they lead that neither the table had nor a state of the chunk before.
    pub(super) new_parts: usize,
    pub(super) owed: Bits,
    /// The demands that a run breaks by staying there; `None` if it is bound to go on.
    pub(super) at_end: Option<Vec<D>>,
}

impl<S: System> Chunk<S> {
    /// No steps.
    pub(super) fn new() -> Self {
        Self { queue: Queue::new(), steps: Vec::new(), nodes: Vec::new(), scratch: Scratch::default() }
    }

    /// Makes the steps from these nodes in the place of all others, up to one that breaks enough.
    pub(super) fn fill(
        &mut self,
        (system, known): (&S, &StateTable<S::Part>),
        range: Range<usize>,
        shown: &mut Cursor<S::State>,
    ) {
        let making = Steps::begin();
        let Self { queue, steps, nodes, scratch } = self;
        queue.begin(known);
        steps.clear();
        nodes.clear();
        let is_enough = |breaks: &[S::Demand]| breaks.iter().any(|&demand| system.is_enough(demand));
        for node in range {
            making.next();
            if known.show_loaded(system, node, shown).is_none() {
                break;
            }
            let Cursor { state, code } = &*shown;
            let (steps_before, parts_before, mut is_still) = (steps.len(), queue.new_parts(), true);
            let mut flow = system.each_step(state, scratch, |step| {
                making.next();
                let Step { state: to, occurs, acting, is_bound, breaks, .. } = step;
                system.make_canonical(to);
                queue.put((system, known), code, to, system.differing(state, to));
                is_still &= !is_bound;
                let flow =
                    if is_enough(&breaks) { ControlFlow::Break(()) } else { ControlFlow::Continue(()) };
                steps.push((occurs, is_bound.then_some(acting), breaks));
                flow
            });
            let at_end = is_still.then(|| system.broken_at_end(state, &[]));
            if at_end.as_deref().is_some_and(is_enough) {
                flow = ControlFlow::Break(());
            }
            nodes.push(Expansion {
                steps: steps.len() - steps_before,
                new_parts: queue.new_parts() - parts_before,
                owed: system.owed(state),
                at_end,
            });
            if flow.is_break() {
                break;
            }
        }
        queue.look_up(known);
    }

    /// The bytes that it takes while its states are looked for on disk.
    pub(super) fn bytes(&self) -> u64 {
        (self.queue.bytes() + size_of_val(&self.steps[..]) + size_of_val(&self.nodes[..])) as u64
    }
}

/// The pieces in which so many workers take what is shared out, some eight for each: whoever is done with one takes the
/// next.
pub fn pieces(nodes: Range<usize>, workers: usize) -> impl Iterator<Item = Range<usize>> {
    // A piece has its own memory, which takes as long as some states.
    let each = (nodes.len() / (8 * workers)).max(16);
    nodes.clone().step_by(each).map(move |first| first..nodes.end.min(first + each))
}

/// The steps from all these nodes, by so many workers.
pub(super) fn share_out<S: System>(
    of: (&S, &StateTable<S::Part>),
    shown: &Cursor<S::State>,
    nodes: Range<usize>,
    workers: usize,
) -> Vec<Chunk<S>> {
    let pieces = pieces(nodes, workers).map(|nodes| (nodes, shown.clone()));
    threads::each_by(workers, pieces, |(nodes, mut shown)| {
        let mut chunk = Chunk::new();
        chunk.fill(of, nodes, &mut shown);
        chunk
    })
}

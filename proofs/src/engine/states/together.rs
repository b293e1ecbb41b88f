//! Several workers on one search. Each makes the steps from some of the states that wait, and looks for where they lead
//! among the states that were known before. What they have made is taken in the order of the states, by one of them, so
//! that counts, runs and memory are the same for any number of workers.

use std::ops::{ControlFlow, Range};

use super::known::{Queue, StateTable};
use super::search::Search;
use super::{Bits, Findings, Limits, Scratch, Step, System};
use crate::engine::threads;
use crate::engine::watchdog::Steps;

/// The fewest states that are shared out: a thread takes as long to begin as tens of steps.
pub(super) const FEWEST: usize = 1 << 10;

/// The most states that are shared out at a time.
pub(super) const MOST: usize = 1 << 14;

/// The steps from states that follow one another, and where they lead.
pub(super) struct Chunk<D> {
    pub(super) queue: Queue,
    /// Of each step the situations that it is, who acts if it is bound to be made, and the demands that it breaks.
    pub(super) steps: Vec<(u64, Option<Bits>, Vec<D>)>,
    /// Of each state its steps, what is owed in it, and the demands that a run breaks by staying there; `None` if it is
    /// bound to go on.
    pub(super) nodes: Vec<(usize, Bits, Option<Vec<D>>)>,
}

impl<D> Chunk<D> {
    /// The bytes that it takes while its states are looked for on disk.
    pub(super) fn bytes(&self) -> u64 {
        (self.queue.bytes() + size_of_val(&self.steps[..]) + size_of_val(&self.nodes[..])) as u64
    }
}

/// Searches as [`search`](super::search) does, on so many threads at a time if states are kept in bytes of their own.
pub fn search_together<S>(
    system: &S,
    starts: impl IntoIterator<Item = S::State>,
    limits: Limits<'_>,
    workers: usize,
) -> Findings<S::Demand>
where
    S: System + Sync,
    S::State: Send,
    S::Part: Send + Sync,
    S::Demand: Send,
{
    let mut search = Search::new(system, limits);
    search.share_out = (workers > 1).then_some((workers, share_out::<S>));
    search.run_from(&mut starts.into_iter(), limits.most_steps, &mut |_| ControlFlow::Continue(()))
}

/// The steps from all these nodes, by so many workers.
fn share_out<S>(
    (system, known): (&S, &StateTable<S::Part>),
    state: &S::State,
    nodes: Range<usize>,
    workers: usize,
) -> Vec<Chunk<S::Demand>>
where
    S: System + Sync,
    S::State: Send,
    S::Part: Send + Sync,
    S::Demand: Send,
{
    let each = nodes.len().div_ceil(workers);
    threads::each_in_its_own(nodes.clone().step_by(each).map(|first| {
        let (nodes, mut state) = (first..nodes.end.min(first + each), state.clone());
        move || {
            let mut table = (known, Queue::default());
            let chunk = chunk(system, &mut table, nodes, &mut state);
            known.look_up(&mut table.1);
            Chunk { queue: table.1, ..chunk }
        }
    }))
}

/// The table of states as a worker that makes steps uses it.
pub(super) trait Table<S: System> {
    /// Makes of `state`, which was shown last, that of a node. False if it cannot be read.
    fn show(&mut self, system: &S, node: usize, state: &mut S::State) -> bool;

    /// Puts a state into the queue to which a step leads from the one that is shown.
    fn queue(&mut self, system: &S, shown: &S::State, to: &S::State);
}

/// For one worker alone.
impl<S: System> Table<S> for StateTable<S::Part> {
    fn show(&mut self, system: &S, node: usize, state: &mut S::State) -> bool {
        Self::show(self, system, node, state)
    }

    fn queue(&mut self, system: &S, shown: &S::State, to: &S::State) {
        Self::queue(self, system, to, system.differing(shown, to));
    }
}

/// For one of several, if states have no parts.
impl<S: System> Table<S> for (&StateTable<S::Part>, Queue) {
    fn show(&mut self, system: &S, node: usize, state: &mut S::State) -> bool {
        self.0.read(system, node, state)
    }

    fn queue(&mut self, system: &S, _: &S::State, to: &S::State) {
        self.1.write(system, to);
    }
}

/// The steps from these nodes, up to one that breaks enough. The states to which they lead are in the table's queue.
pub(super) fn chunk<S: System>(
    system: &S,
    table: &mut impl Table<S>,
    nodes: Range<usize>,
    state: &mut S::State,
) -> Chunk<S::Demand> {
    let making = Steps::begin();
    let mut chunk = Chunk { queue: Queue::default(), steps: Vec::new(), nodes: Vec::new() };
    let mut scratch = Scratch::default();
    let is_enough = |breaks: &[S::Demand]| breaks.iter().any(|&demand| system.is_enough(demand));
    for node in nodes {
        making.next();
        if !table.show(system, node, state) {
            break;
        }
        let (before, mut is_still) = (chunk.steps.len(), true);
        let mut flow = system.each_step(state, &mut scratch, |step| {
            making.next();
            let Step { state: to, occurs, acting, is_bound, breaks, .. } = step;
            system.make_canonical(to);
            table.queue(system, state, to);
            is_still &= !is_bound;
            let flow = if is_enough(&breaks) { ControlFlow::Break(()) } else { ControlFlow::Continue(()) };
            chunk.steps.push((occurs, is_bound.then_some(acting), breaks));
            flow
        });
        let at_end = is_still.then(|| system.broken_at_end(state, &[]));
        if at_end.as_deref().is_some_and(is_enough) {
            flow = ControlFlow::Break(());
        }
        chunk.nodes.push((chunk.steps.len() - before, system.owed(state), at_end));
        if flow.is_break() {
            break;
        }
    }
    chunk
}

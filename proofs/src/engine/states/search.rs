//! The search itself: it makes all steps from each state in the order in which they were met, and keeps of each demand
//! the first run that breaks it.

use std::ops::{ControlFlow, Range};

use super::graph::{Arc, Graph};
use super::known::{Queue, StateTable};
use super::limits::{Limits, MemoryShare};
use super::rounds::TooLarge;
use super::together::{self, Chunk};
use super::{Bits, END, Ending, Findings, Places, Run, Step, System, steps};
use crate::engine::watchdog::Steps;
use crate::engine::world::World;

/// Searches all states that `system` gets to from `starts`, until enough is broken or one of the `limits` is reached.
pub fn search<S: System>(
    system: &S,
    starts: impl IntoIterator<Item = S::State>,
    limits: Limits<'_>,
) -> Findings<S::Demand> {
    watched(system, starts, limits, &mut |_| ControlFlow::Continue(()))
}

/// Searches as [`search`] does. `watch` hears before each state is looked at how many will have been, and may end the
/// search, which is then not whole.
pub fn watched<S: System>(
    system: &S,
    starts: impl IntoIterator<Item = S::State>,
    limits: Limits<'_>,
    watch: &mut dyn FnMut(u64) -> ControlFlow<()>,
) -> Findings<S::Demand> {
    Search::new(system, limits).run_from(starts, limits.most_steps, watch)
}

/// Why a search stops although there are states ahead.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Stop {
    Enough,
    Unfinished,
}

struct Violation<D> {
    demand: D,
    node: usize,
    how: How,
}

enum How {
    /// By the step from the node with this number.
    Step(u32),
    /// By staying in the node.
    Still,
    /// By these steps from the node back to it, each by its number among those that are bound to be made.
    Round(Vec<u32>),
}

/// A way to make the steps from many nodes by several workers; the state is any.
type ShareOut<S> = fn(
    (&S, &StateTable<<S as System>::Part>),
    &<S as World>::State,
    Range<usize>,
    usize,
) -> Vec<Chunk<<S as World>::Demand>>;

pub(super) struct Search<'a, S: System> {
    pub(super) system: &'a S,
    /// How many workers there are, and how they share the steps.
    pub(super) share_out: Option<(usize, ShareOut<S>)>,
    pub(super) known: StateTable<S::Part>,
    pub(super) graph: Graph,
    looked_at: usize,
    steps: u64,
    /// The state that is shown: of the next one only what differs is put.
    pub(super) shown: Option<Box<S::State>>,
    taken: MemoryShare<'a>,
    /// The situations that occurred, a bit for each.
    occurred: u64,
    has_ended: bool,
    broken: Vec<Violation<S::Demand>>,
}

/// States that are looked at between two looks at the memory that they take.
const BETWEEN: usize = 64;

impl<'a, S: System> Search<'a, S> {
    pub(super) fn new(system: &'a S, limits: Limits<'a>) -> Self {
        Self {
            system,
            share_out: None,
            known: StateTable::new(),
            graph: Graph::new(system.broken_by_endless_runs().is_some()),
            looked_at: 0,
            steps: 0,
            shown: None,
            taken: MemoryShare::new(limits.room),
            occurred: 0,
            has_ended: false,
            broken: Vec::new(),
        }
    }

    /// Searches from these starts.
    pub(super) fn run_from(
        &mut self,
        starts: impl IntoIterator<Item = S::State>,
        most_steps: u64,
        watch: &mut dyn FnMut(u64) -> ControlFlow<()>,
    ) -> Findings<S::Demand> {
        for (start, state) in (0..).zip(starts) {
            self.meet_start(start, state);
        }
        let making = Steps::begin();
        let mut stop = self.look_at_all(most_steps, &making, watch).break_value();
        // What follows makes no step that was not made before, and may take its time.
        making.leave();
        if let (None, Some(demand)) = (stop, self.system.broken_by_endless_runs()) {
            stop = self.look_for_rounds(demand).err().map(|TooLarge| Stop::Unfinished);
        }
        let broken = std::mem::take(&mut self.broken);
        let situations = self.system.covers().into_iter().zip(0..);
        let occurred = situations.filter(|(_, bit)| self.occurred >> bit & 1 == 1).map(|(name, _)| name);
        let mut covered: Vec<_> = occurred.chain(self.has_ended.then_some(END)).collect();
        covered.sort_unstable();
        Findings {
            states: self.known.len() as u64,
            looked_at: self.looked_at as u64,
            steps: self.steps,
            bytes: self.taken.most,
            is_whole: stop != Some(Stop::Unfinished),
            broken: broken.into_iter().map(|broken| self.run(broken)).collect(),
            covered,
        }
    }

    fn meet_start(&mut self, start: u32, mut state: S::State) {
        self.system.make_canonical(&mut state);
        self.known.queue(self.system, &state, Places::MAX);
        let mut queue = self.known.queued();
        if self.known.meet_next(&mut queue).1 {
            self.graph.add_start(start);
        }
        self.known.give_back(queue);
        self.known.show_last();
        self.shown = Some(Box::new(state));
    }

    /// The state of a node. It is to be given back as what is shown.
    pub(super) fn state(&mut self, node: usize) -> Option<Box<S::State>> {
        let mut state = self.shown.take()?;
        self.known.show(self.system, node, &mut state);
        Some(state)
    }

    /// Makes all steps from all nodes.
    fn look_at_all(
        &mut self,
        most_steps: u64,
        making: &Steps,
        watch: &mut dyn FnMut(u64) -> ControlFlow<()>,
    ) -> ControlFlow<Stop> {
        while self.looked_at < self.known.len() {
            let waiting = self.known.len() - self.looked_at;
            if let (Some((workers, share_out)), Some(state)) = (self.share_out, &self.shown)
                && waiting >= together::FEWEST
                && self.known.is_bytes()
            {
                making.leave();
                let nodes = self.looked_at..self.looked_at + waiting.min(together::MOST);
                for chunk in share_out((self.system, &self.known), state, nodes.clone(), workers) {
                    self.take(chunk, most_steps, watch)?;
                }
                continue;
            }
            let Some(state) = self.state(self.looked_at) else { break };
            // A search may wait for memory that another one has.
            making.leave();
            self.may_go_on(watch)?;
            let node = self.looked_at;
            let flow = self.look((node, &state), most_steps, making);
            self.shown = Some(state);
            flow?;
        }
        ControlFlow::Continue(())
    }

    /// Whether there is memory for the next node, and nobody ends the search before it.
    fn may_go_on(&mut self, watch: &mut dyn FnMut(u64) -> ControlFlow<()>) -> ControlFlow<Stop> {
        let is_due = self.looked_at.is_multiple_of(BETWEEN);
        let has_room = !is_due || self.taken.hold(self.known.bytes() + self.graph.bytes());
        if has_room && watch(1 + self.looked_at as u64).is_continue() {
            ControlFlow::Continue(())
        } else {
            ControlFlow::Break(Stop::Unfinished)
        }
    }

    /// Takes the steps from the next nodes, which a worker has made.
    fn take(
        &mut self,
        chunk: Chunk<S::Demand>,
        most_steps: u64,
        watch: &mut dyn FnMut(u64) -> ControlFlow<()>,
    ) -> ControlFlow<Stop> {
        let Chunk { mut queue, steps, nodes } = chunk;
        let mut steps = steps.into_iter();
        for (count, owed, at_end) in nodes {
            self.may_go_on(watch)?;
            let node = self.looked_at;
            self.looked_at += 1;
            self.graph.go_on(|| owed);
            for (number, (occurs, acting, breaks)) in (0..).zip(steps.by_ref().take(count)) {
                self.step(node, most_steps, &mut queue, (occurs, acting))?;
                for demand in breaks {
                    self.note(Violation { demand, node, how: How::Step(number) })?;
                }
            }
            self.has_ended |= count == 0;
            for demand in at_end.into_iter().flatten() {
                self.note(Violation { demand, node, how: How::Still })?;
            }
        }
        ControlFlow::Continue(())
    }

    /// Takes a step from a node to the next state of a queue: the situations that it is, and who acts if it is bound to
    /// be made.
    fn step(
        &mut self,
        node: usize,
        most_steps: u64,
        queue: &mut Queue,
        (occurs, acting): (u64, Option<Bits>),
    ) -> ControlFlow<Stop> {
        if self.steps == most_steps || self.graph.is_full() {
            return ControlFlow::Break(Stop::Unfinished);
        }
        let (to, is_new) = self.known.meet_next(queue);
        self.steps += 1;
        self.occurred |= occurs;
        if is_new {
            self.graph.add(node as u32);
        }
        if let Some(acting) = acting {
            self.graph.add_arc(Arc { to, acting });
        }
        ControlFlow::Continue(())
    }

    /// Makes all steps from the next node, whose state it is.
    fn look(
        &mut self,
        (node, state): (usize, &S::State),
        most_steps: u64,
        making: &Steps,
    ) -> ControlFlow<Stop> {
        making.next();
        let system = self.system;
        self.looked_at += 1;
        self.graph.go_on(|| system.owed(state));
        let (mut made, before) = (Vec::new(), self.steps);
        let mut is_still = true;
        system.each_step(state, |step| {
            making.next();
            let Step { state: mut to, occurs, acting, is_bound, breaks, .. } = step;
            system.make_canonical(&mut to);
            self.known.queue(system, &to, system.differing(state, &to));
            is_still &= !is_bound;
            made.push((occurs, is_bound.then_some(acting)));
            if breaks.is_empty() {
                return ControlFlow::Continue(());
            }
            // What is broken is noted at once, whatever becomes of the next step.
            self.meet(node, most_steps, &mut made)?;
            let number = (self.steps - before - 1) as u32;
            breaks
                .into_iter()
                .try_for_each(|demand| self.note(Violation { demand, node, how: How::Step(number) }))
        })?;
        self.meet(node, most_steps, &mut made)?;
        let is_last = self.steps == before;
        self.has_ended |= is_last;
        if is_still {
            for demand in system.broken_at_end(state, &[]) {
                self.note(Violation { demand, node, how: How::Still })?;
            }
        }
        ControlFlow::Continue(())
    }

    /// Meets the states that are queued, to which steps from the node lead: of each step the situations that it is, and
    /// who acts if it is bound to be made.
    fn meet(
        &mut self,
        node: usize,
        most_steps: u64,
        made: &mut Vec<(u64, Option<Bits>)>,
    ) -> ControlFlow<Stop> {
        let mut queue = self.known.queued();
        for step in made.drain(..) {
            self.step(node, most_steps, &mut queue, step)?;
        }
        self.known.give_back(queue);
        ControlFlow::Continue(())
    }

    /// Keeps what is broken for the first time.
    fn note(&mut self, new: Violation<S::Demand>) -> ControlFlow<Stop> {
        if self.broken.iter().any(|broken| broken.demand == new.demand) {
            return ControlFlow::Continue(());
        }
        let is_enough = self.system.is_enough(new.demand);
        self.broken.push(new);
        if is_enough { ControlFlow::Break(Stop::Enough) } else { ControlFlow::Continue(()) }
    }

    fn run(&mut self, broken: Violation<S::Demand>) -> Run<S::Demand> {
        let Violation { demand, node, how } = broken;
        let (start, mut steps) = self.way(node);
        let ending = match how {
            How::Step(number) => {
                steps.push(number);
                Ending::There
            }
            How::Still => Ending::Still,
            How::Round(round) => Ending::Round(self.numbers(node, &round)),
        };
        Run { demand, start, steps, ending }
    }

    /// The number of the start, and those of the steps from it that first led to a node.
    fn way(&mut self, node: usize) -> (usize, Vec<u32>) {
        let (start, way) = self.graph.way(node);
        let mut numbers = Vec::new();
        for pair in way.windows(2) {
            let Some(state) = self.state(pair[0]) else { break };
            let number = steps(self.system, &state).position(|mut step| {
                self.system.make_canonical(&mut step.state);
                self.known.find(self.system, &step.state) == Some(pair[1] as u32)
            });
            numbers.extend(number.map(|number| number as u32));
            self.shown = Some(state);
        }
        (start, numbers)
    }

    /// The numbers of the steps of a round from a node, each among all steps.
    fn numbers(&mut self, mut node: usize, round: &[u32]) -> Vec<u32> {
        let mut numbers = Vec::new();
        for &bound in round {
            let (Some(state), Some(arc)) = (self.state(node), self.graph.arc(node, bound)) else { break };
            let numbered = (0..).zip(steps(self.system, &state));
            let mut bound_ones = numbered.filter(|(_, step)| step.is_bound).map(|(number, _)| number);
            numbers.extend(bound_ones.nth(bound as usize));
            drop(bound_ones);
            self.shown = Some(state);
            node = arc.to as usize;
        }
        numbers
    }

    /// Looks for runs that go round and owe the same thing throughout. The one that gets there first counts, unless a
    /// run that breaks the same demand stays in a state that is found before.
    fn look_for_rounds(&mut self, demand: S::Demand) -> Result<(), TooLarge> {
        let Self { system, known, graph, shown, taken, .. } = self;
        let awake = |node: usize| -> Bits {
            let Some(state) = shown else { return 0 };
            known.show(*system, node, state);
            system.awake(state)
        };
        let Some((node, round)) = graph.first_round(awake, taken)? else { return Ok(()) };
        let new = Violation { demand, node, how: How::Round(round) };
        match self.broken.iter_mut().find(|broken| broken.demand == demand) {
            Some(known) if known.node <= node => {}
            Some(known) => *known = new,
            None => self.broken.push(new),
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests;

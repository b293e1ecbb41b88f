//! The search itself: it makes all steps from each state in the order in which they were met, and keeps of each demand
//! the first run that breaks it.

use std::num::NonZeroUsize;
use std::ops::{ControlFlow, Range};
use std::{io, iter, mem};

use super::chunk::{self, Chunk, Expansion};
use super::code::Code;
use super::graph::{Arc, Graph};
use super::limits::{Limits, Memory, MemoryShare};
use super::queue::Queue;
use super::rounds::{Round, ShortestRound, TooLarge};
use super::spill::{Disk, Numbers};
use super::state_table::{Cursor, StateTable};
use super::{Bits, END, Ending, Findings, Places, Run, System, TRIED, steps};
use crate::engine::threads;

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
    Search::new(system, limits).run_from(&mut starts.into_iter(), limits.most_steps, watch)
}

/// Why a search stops although there are states ahead.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Stop {
    Enough,
    /// Memory does not suffice.
    Full,
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

pub(super) struct Search<'a, S: System> {
    pub(super) system: &'a S,
    workers: Option<NonZeroUsize>,
    pub(super) known: StateTable<S::Part>,
    pub(super) graph: Graph,
    /// Starts that were met.
    begun: u32,
    looked_at: usize,
    steps: u64,
    /// The bytes of steps that are made and not taken yet, where states are on disk.
    making: u64,
    pub(super) shown: Option<Box<Cursor<S::State>>>,
    /// A chunk that was taken.
    spare: Chunk<S>,
    memory: Memory<'a>,
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
            workers: limits.workers,
            known: StateTable::new(),
            graph: Graph::new(system.broken_by_endless_runs().is_some()),
            begun: 0,
            looked_at: 0,
            steps: 0,
            making: 0,
            shown: None,
            spare: Chunk::new(),
            memory: limits.memory,
            taken: MemoryShare::new(limits.memory),
            occurred: 0,
            has_ended: false,
            broken: Vec::new(),
        }
    }

    /// Searches from these starts.
    pub(super) fn run_from(
        &mut self,
        starts: &mut dyn Iterator<Item = S::State>,
        most_steps: u64,
        watch: &mut dyn FnMut(u64) -> ControlFlow<()>,
    ) -> Findings<S::Demand> {
        let mut starts = starts.peekable();
        if let Some(first) = starts.peek() {
            self.known.places = self.system.places(first);
            self.take_up(first);
        }
        let mut stop = self.meet_starts(starts.skip(self.begun as usize)).break_value();
        stop = stop.or_else(|| self.look_at_all(most_steps, watch).break_value());
        let mut is_shortest = true;
        if let Some(demand) = self.system.broken_by_endless_runs() {
            // One that is broken by an end may be broken by a shorter run that goes round.
            let is_broken = self.broken.last().is_some_and(|last| last.demand == demand);
            if stop.is_none() || stop == Some(Stop::Enough) && is_broken {
                match self.look_for_rounds(demand) {
                    Ok(is_known) => is_shortest = is_known,
                    Err(_) if stop.is_some() => is_shortest = false,
                    Err(short) => stop = Some(short),
                }
            }
        }
        if stop == Some(Stop::Full) {
            self.taken.was_too_small();
        }
        let broken = mem::take(&mut self.broken).into_iter().map(|broken| self.run(broken)).collect();
        // The last word: a run may have to be read, too.
        let is_whole = matches!(stop, None | Some(Stop::Enough)) && self.known.fault().is_none();
        self.known.leave_disk(is_whole);
        if let (Some(spill), Some(fault)) = (self.memory.spill, self.known.fault()) {
            spill.note(fault.clone());
        }
        let situations = self.system.covers().into_iter().zip(0..);
        let occurred = situations.filter(|(_, bit)| self.occurred >> bit & 1 == 1).map(|(name, _)| name);
        let mut covered: Vec<_> = occurred.chain(self.has_ended.then_some(END)).collect();
        covered.sort_unstable();
        Findings {
            states: self.known.len() as u64,
            looked_at: self.looked_at as u64,
            steps: self.steps,
            bytes: self.taken.most,
            is_whole,
            is_shortest: is_whole && is_shortest,
            broken: if self.known.fault().is_some() { Vec::new() } else { broken },
            covered,
        }
    }

    /// Meets the starts that are left.
    fn meet_starts(&mut self, mut starts: impl Iterator<Item = S::State>) -> ControlFlow<Stop> {
        loop {
            let most = if self.known.disk.is_some() { self.for_steps() } else { 0 };
            // They take at most as much in the table as in the queue.
            if !self.taken.hold(self.bytes() + 2 * most) {
                self.spill()?;
            }
            let (mut queue, mut queued) = (Queue::for_table(&self.known), 0);
            while queued < BETWEEN || (queue.bytes() as u64) < most {
                let Some(mut state) = starts.next() else { break };
                self.system.make_canonical(&mut state);
                queue.put((self.system, &self.known), &Code::default(), &state, Places::MAX);
                self.shown.get_or_insert_with(|| Box::new(Cursor { state, code: Code::default() }));
                queued += 1;
            }
            if queued == 0 {
                return ControlFlow::Continue(());
            }
            queue.look_up(&self.known);
            if !self.known.look_up_on_disk(iter::once(&mut queue), self.workers()) {
                return ControlFlow::Break(Stop::Unfinished);
            }
            let new_parts = queue.new_parts();
            self.known.take_parts(&mut queue, new_parts);
            for _ in 0..queued {
                if self.known.meet_next(&mut queue).1 {
                    self.graph.add_start(self.begun);
                }
                self.begun += 1;
            }
        }
    }

    fn workers(&self) -> usize {
        self.workers.map_or_else(|| 1 + threads::idle(), NonZeroUsize::get)
    }

    /// The state of a node, to be given back as what is shown.
    pub(super) fn show(&mut self, node: usize) -> Option<Box<Cursor<S::State>>> {
        let mut shown = self.shown.take()?;
        self.known.show(self.system, node, &mut shown)?;
        Some(shown)
    }

    /// Makes all steps from all nodes.
    fn look_at_all(
        &mut self,
        most_steps: u64,
        watch: &mut dyn FnMut(u64) -> ControlFlow<()>,
    ) -> ControlFlow<Stop> {
        while self.looked_at < self.known.len() {
            let (before, chunks) = (self.looked_at, self.make_steps()?);
            match chunks.into_iter().try_for_each(|chunk| self.take(chunk, most_steps, watch)) {
                // What was not taken is made again.
                ControlFlow::Break(Stop::Full) if self.looked_at > before || self.known.disk.is_none() => {
                    self.spill()?;
                }
                flow => flow?,
            }
        }
        ControlFlow::Continue(())
    }

    /// The steps from the next nodes: if states are on disk, from as many as there is memory for.
    fn make_steps(&mut self) -> ControlFlow<Stop, Vec<Chunk<S>>> {
        if self.known.fault().is_some() {
            return ControlFlow::Break(Stop::Unfinished);
        }
        let (mut chunks, mut next) = (Vec::new(), self.looked_at);
        self.making = 0;
        loop {
            let workers = self.workers();
            let nodes = next..self.known.len().min(next + self.at_once(next, workers));
            let made = self.make_steps_from(nodes.clone(), workers)?;
            next += made.iter().map(|chunk| chunk.nodes.len()).sum::<usize>();
            if self.known.disk.is_none() {
                return ControlFlow::Continue(made);
            }
            self.making += made.iter().map(Chunk::bytes).sum::<u64>();
            chunks.extend(made);
            if next < nodes.end || next == self.known.len() || self.making >= self.for_steps() {
                break;
            }
        }
        // The states to which they lead take at most as much as they do.
        if !self.taken.fits(self.bytes() + self.for_steps()) {
            self.spill()?;
        }
        let queues = chunks.iter_mut().map(|chunk| &mut chunk.queue);
        if !self.known.look_up_on_disk(queues, self.workers()) {
            return ControlFlow::Break(Stop::Unfinished);
        }
        ControlFlow::Continue(chunks)
    }

    /// The number of nodes from this one on whose steps so many workers make at once.
    fn at_once(&self, next: usize, workers: usize) -> usize {
        if workers == 1 || self.known.len() - next < chunk::FEWEST {
            return BETWEEN;
        }
        // They take a quarter of the memory for steps, if those from one state take 1 KiB.
        let most = if self.known.disk.is_some() { self.for_steps() >> 12 } else { u64::MAX };
        (chunk::MOST as u64).min(most.max(BETWEEN as u64)) as usize
    }

    fn make_steps_from(&mut self, nodes: Range<usize>, workers: usize) -> ControlFlow<Stop, Vec<Chunk<S>>> {
        let Some(mut shown) = self.shown.take().filter(|_| self.known.load(nodes.clone())) else {
            return ControlFlow::Break(Stop::Unfinished);
        };
        let of = (self.system, &self.known);
        let chunks = if workers > 1 && nodes.len() >= chunk::FEWEST {
            chunk::share_out(of, &shown, nodes, workers)
        } else {
            let mut chunk = mem::replace(&mut self.spare, Chunk::new());
            chunk.fill(of, nodes, &mut shown);
            vec![chunk]
        };
        self.shown = Some(shown);
        ControlFlow::Continue(chunks)
    }

    /// The bytes that the search takes.
    fn bytes(&self) -> u64 {
        self.known.bytes() + self.graph.bytes() + self.making
    }

    /// The bytes that steps may take at a time where states are on disk.
    fn for_steps(&self) -> u64 {
        self.taken.for_steps(self.graph.bytes() + self.known.disk.as_ref().map_or(0, Disk::bytes))
    }

    /// Writes the states in memory to disk, if there is a folder for them, and memory for steps.
    fn spill(&mut self) -> ControlFlow<Stop> {
        if self.for_steps() == 0 {
            return ControlFlow::Break(Stop::Full);
        }
        self.write()
    }

    /// Writes the states in memory to disk, if there is a folder for them.
    fn write(&mut self) -> ControlFlow<Stop> {
        let Some(spill) = self.memory.spill else { return ControlFlow::Break(Stop::Full) };
        let question = self.memory.question.filter(|_| self.known.is_bytes());
        let disk = self.known.disk.get_or_insert_with(|| Disk::new(spill, question));
        // What is broken is not written down.
        if !self.broken.is_empty() {
            disk.forget_question();
        }
        let counts = [self.begun.into(), self.looked_at as u64, self.steps];
        let seen = [self.occurred, self.has_ended.into()];
        if !self.known.spill(counts.into_iter().chain(seen).chain(self.graph.added())) {
            return ControlFlow::Break(Stop::Unfinished);
        }
        self.graph.is_on_disk();
        ControlFlow::Continue(())
    }

    /// Takes up the search from this start that was killed, if there was one.
    fn take_up(&mut self, start: &S::State) {
        let (Some(spill), Some(question)) = (self.memory.spill, self.memory.question) else { return };
        if self.system.places(start) > 0 {
            return;
        }
        let mut disk = Disk::new(spill, Some(question));
        while let Some(mut numbers) = disk.take_up() {
            if let Err(error) = self.go_back_to(&mut numbers) {
                disk.is_damaged(&error);
            }
        }
        self.known.take_up(disk);
        if self.known.disk.is_some() && self.known.fault().is_none() && !self.leads_where_it_led(start) {
            self.known.is_foreign();
        }
    }

    /// Is as far as the search was that wrote these numbers.
    fn go_back_to(&mut self, numbers: &mut Numbers) -> io::Result<()> {
        self.begun = numbers.next()? as u32;
        self.looked_at = numbers.next()? as usize;
        self.steps = numbers.next()?;
        self.occurred = numbers.next()?;
        self.has_ended = numbers.next()? != 0;
        self.graph.add_again(|| numbers.next())
    }

    /// Whether it begins with the first state on disk, and the steps from some states find there what they found.
    fn leads_where_it_led(&mut self, start: &S::State) -> bool {
        let mut state = start.clone();
        self.system.make_canonical(&mut state);
        let is_first = self.known.is_at(self.system, &state, 0);
        self.shown = Some(Box::new(Cursor { state, code: Code::default() }));
        let ends = [0..self.looked_at.min(TRIED), self.looked_at.saturating_sub(TRIED)..self.looked_at];
        is_first && ends.into_iter().all(|nodes| self.finds_again(nodes))
    }

    /// Whether the steps from these nodes, all of which are on disk, lead to those that were first found from them, in
    /// their order, and to others that were found before.
    fn finds_again(&mut self, nodes: Range<usize>) -> bool {
        let mut found = self.graph.found_from(&nodes);
        let ControlFlow::Continue(mut chunks) = self.make_steps_from(nodes, 1) else { return false };
        if !self.known.look_up_on_disk(chunks.iter_mut().map(|chunk| &mut chunk.queue), self.workers()) {
            return false;
        }
        let is_again = |node: Option<u32>| {
            let Some(node) = node.map(|node| node as usize) else { return false };
            if found.contains(&node) && node == found.start {
                found.start += 1;
            }
            node < found.start
        };
        chunks.iter().flat_map(|chunk| chunk.queue.found()).all(is_again) && found.is_empty()
    }

    /// Whether there is memory for the next node, and nobody ends the search before it.
    fn may_go_on(&mut self, watch: &mut dyn FnMut(u64) -> ControlFlow<()>) -> ControlFlow<Stop> {
        let is_due = self.looked_at.is_multiple_of(BETWEEN);
        if is_due && !self.taken.hold(self.bytes()) {
            return ControlFlow::Break(Stop::Full);
        }
        if watch(1 + self.looked_at as u64).is_break() {
            return ControlFlow::Break(Stop::Unfinished);
        }
        ControlFlow::Continue(())
    }

    /// Takes the steps from the next nodes, which a worker has made.
    fn take(
        &mut self,
        mut chunk: Chunk<S>,
        most_steps: u64,
        watch: &mut dyn FnMut(u64) -> ControlFlow<()>,
    ) -> ControlFlow<Stop> {
        let Chunk { queue, steps, nodes, .. } = &mut chunk;
        let mut steps = steps.drain(..);
        for Expansion { steps: count, new_parts, owed, at_end } in nodes.drain(..) {
            self.may_go_on(watch)?;
            self.known.take_parts(queue, new_parts);
            let node = self.looked_at;
            self.looked_at += 1;
            self.graph.go_on(|| owed);
            for (number, (occurs, acting, breaks)) in (0..).zip(steps.by_ref().take(count)) {
                self.step(node, most_steps, queue, (occurs, acting))?;
                for demand in breaks {
                    self.note(Violation { demand, node, how: How::Step(number) })?;
                }
            }
            self.has_ended |= count == 0;
            for demand in at_end.into_iter().flatten() {
                self.note(Violation { demand, node, how: How::Still })?;
            }
        }
        drop(steps);
        self.spare = chunk;
        ControlFlow::Continue(())
    }

    /// Takes a step from a node to the next state of a queue: the situations that it is, and who acts if it is bound to
    /// be made.
    fn step(
        &mut self,
        node: usize,
        most_steps: u64,
        queue: &mut Queue<S::Part>,
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
            let Some(shown) = self.show(pair[0]) else { break };
            let number = steps(self.system, &shown.state).position(|mut step| {
                self.system.make_canonical(&mut step.state);
                self.known.is_at(self.system, &step.state, pair[1])
            });
            numbers.extend(number.map(|number| number as u32));
            self.shown = Some(shown);
        }
        (start, numbers)
    }

    /// The numbers of the steps of a round from a node, each among all steps.
    fn numbers(&mut self, mut node: usize, round: &[u32]) -> Vec<u32> {
        let mut numbers = Vec::new();
        for &bound in round {
            let (Some(shown), Some(arc)) = (self.show(node), self.graph.arc(node, bound)) else { break };
            let numbered = (0..).zip(steps(self.system, &shown.state));
            let mut bound_ones = numbered.filter(|(_, step)| step.is_bound).map(|(number, _)| number);
            numbers.extend(bound_ones.nth(bound as usize));
            drop(bound_ones);
            self.shown = Some(shown);
            node = arc.to as usize;
        }
        numbers
    }

    /// Looks for a shortest run that goes round and owes the same thing throughout, and takes it if no run that breaks
    /// the same demand is as short; whether none is shorter than the one that is taken, or known.
    fn look_for_rounds(&mut self, demand: S::Demand) -> Result<bool, Stop> {
        let known = self.broken.iter().position(|broken| broken.demand == demand);
        let fewer_than = known.map_or(usize::MAX, |place| self.length(&self.broken[place]));
        let mut round = self.shortest_round(fewer_than);
        if round.is_err() {
            // Without the states there may be memory for the graph.
            self.write().break_value().map_or(Ok(()), Err)?;
            round = self.shortest_round(fewer_than);
        }
        let shortest = round.map_err(|TooLarge| Stop::Full)?;
        let is_known = shortest.is_known();
        if let Some(Round { node, steps }) = shortest.round {
            let new = Violation { demand, node, how: How::Round(steps) };
            match known {
                Some(place) => self.broken[place] = new,
                None => self.broken.push(new),
            }
        }
        Ok(is_known)
    }

    /// How many steps the run has that breaks something.
    fn length(&self, broken: &Violation<S::Demand>) -> usize {
        let (_, way) = self.graph.way(broken.node);
        way.len() - 1
            + match &broken.how {
                How::Step(_) => 1,
                How::Still => 0,
                How::Round(steps) => steps.len(),
            }
    }

    fn shortest_round(&mut self, fewer_than: usize) -> Result<ShortestRound, TooLarge> {
        self.making = 0;
        let bytes = self.bytes();
        let Self { system, known, graph, shown, taken, .. } = self;
        taken.hold(bytes);
        let mut awake = |node: usize| {
            let shown = shown.as_mut()?;
            known.show(*system, node, shown)?;
            Some(system.awake(&shown.state))
        };
        let mut shortest = ShortestRound::new(fewer_than);
        graph.look_for_rounds(&mut shortest, &mut |node| awake(node).unwrap_or_default(), taken)?;
        Ok(shortest)
    }
}

#[cfg(test)]
mod tests;

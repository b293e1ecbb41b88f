//! The search itself: it makes all steps from each state in the order in which they were met, and keeps of each demand
//! the first run that breaks it.

use std::ops::ControlFlow;

use super::graph::{Arc, Graph};
use super::known::StateTable;
use super::limits::{Limits, MemoryShare};
use super::rounds::TooLarge;
use super::{Bits, END, Ending, Findings, Places, Run, Step, System, steps};
use crate::engine::watchdog::Steps;

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
    let mut search = Search::new(system, limits);
    for (start, state) in (0..).zip(starts) {
        search.meet_start(start, state);
    }
    let making = Steps::begin();
    let mut stop = search.look_at_all(limits.most_steps, &making, watch).break_value();
    // What follows makes no step that was not made before, and may take its time.
    making.leave();
    if let (None, Some(demand)) = (stop, system.broken_by_endless_runs()) {
        stop = search.look_for_rounds(demand).err().map(|TooLarge| Stop::Unfinished);
    }
    let broken = std::mem::take(&mut search.broken);
    let situations = system.covers().into_iter().zip(0..);
    let occurred = situations.filter(|(_, bit)| search.occurred >> bit & 1 == 1).map(|(name, _)| name);
    let mut covered: Vec<_> = occurred.chain(search.has_ended.then_some(END)).collect();
    covered.sort_unstable();
    Findings {
        states: search.known.len() as u64,
        looked_at: search.looked_at as u64,
        steps: search.steps,
        bytes: search.taken.most,
        is_whole: stop != Some(Stop::Unfinished),
        broken: broken.into_iter().map(|broken| search.run(broken)).collect(),
        covered,
    }
}

/// Why a search stops although there are states ahead.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Stop {
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

struct Search<'a, S: System> {
    system: &'a S,
    known: StateTable<S::Part>,
    graph: Graph,
    looked_at: usize,
    steps: u64,
    /// The state that is shown: of the next one only what differs is put.
    shown: Option<Box<S::State>>,
    taken: MemoryShare<'a>,
    /// The situations that occurred, a bit for each.
    occurred: u64,
    has_ended: bool,
    broken: Vec<Violation<S::Demand>>,
}

/// States that are looked at between two looks at the memory that they take.
const BETWEEN: usize = 64;

impl<'a, S: System> Search<'a, S> {
    fn new(system: &'a S, limits: Limits<'a>) -> Self {
        Self {
            system,
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

    fn meet_start(&mut self, start: u32, mut state: S::State) {
        self.system.make_canonical(&mut state);
        self.known.queue(self.system, &state, Places::MAX);
        let graph = &mut self.graph;
        self.known.meet(1, |_, is_new| {
            if is_new {
                graph.add_start(start);
            }
        });
        self.known.show_last();
        self.shown = Some(Box::new(state));
    }

    /// The state of a node. It is to be given back as what is shown.
    fn state(&mut self, node: usize) -> Option<Box<S::State>> {
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
        while self.looked_at < self.known.len()
            && let Some(state) = self.state(self.looked_at)
        {
            // A search may wait for memory that another one has.
            making.leave();
            let is_due = self.looked_at.is_multiple_of(BETWEEN);
            let has_room = !is_due || self.taken.hold(self.known.bytes() + self.graph.bytes());
            if !has_room || watch(1 + self.looked_at as u64).is_break() {
                return ControlFlow::Break(Stop::Unfinished);
            }
            let node = self.looked_at;
            let flow = self.look((node, &state), most_steps, making);
            self.shown = Some(state);
            flow?;
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
        let Self { known, graph, steps, occurred, .. } = self;
        let most = graph.room().min(usize::try_from(most_steps - *steps).unwrap_or(usize::MAX));
        let is_cut_off = made.len() > most;
        let mut made = made.drain(..);
        known.meet(most, |to, is_new| {
            let Some((occurs, acting)) = made.next() else { return };
            *steps += 1;
            *occurred |= occurs;
            if is_new {
                graph.add(node as u32);
            }
            if let Some(acting) = acting {
                graph.add_arc(Arc { to, acting });
            }
        });
        if is_cut_off { ControlFlow::Break(Stop::Unfinished) } else { ControlFlow::Continue(()) }
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
mod tests {
    use tautline_kernel::choice::Oracle;

    use super::super::{Bits, MemoryLimit};
    use super::*;
    use crate::engine::world::{Turn, World};

    /// An arc of a graph that one can look at: where it leads, and who acts.
    type SketchArc = (usize, Bits);

    /// Such a graph, and the demands on it. Node 0 is the start.
    struct Graphic {
        arcs: &'static [&'static [SketchArc]],
        /// No step leads there.
        forbidden: usize,
        /// No run ends there.
        dead: usize,
        /// Where something is owed.
        owing: &'static [usize],
        /// Whom nothing but their own acts puts to sleep.
        awake: Bits,
        /// Whether one demand is enough.
        is_enough: bool,
    }

    const STEP: &str = "a step";
    const ROUND: &str = "no run owes something for ever";

    impl World for Graphic {
        type State = usize;
        type Plan = &'static [SketchArc];
        type Event = SketchArc;
        type Demand = &'static str;

        fn plan(&self, &mut node: &mut usize, _: &[u8]) -> Option<&'static [SketchArc]> {
            Some(self.arcs[node]).filter(|arcs| !arcs.is_empty())
        }

        fn settle(
            &self,
            node: &mut usize,
            arcs: &&'static [SketchArc],
            _: &mut Vec<u8>,
            world: &mut impl Oracle,
        ) -> SketchArc {
            let arc = arcs[world.pick(arcs.len() as u32) as usize];
            *node = arc.0;
            arc
        }

        fn broken_by(&self, turn: &Turn<'_, Self>) -> Vec<&'static str> {
            if *turn.after == self.forbidden { vec!["not there"] } else { Vec::new() }
        }

        fn broken_at_end(&self, &node: &usize, _: &[u8]) -> Vec<&'static str> {
            if node == self.dead { vec!["no end there", "no end at all"] } else { Vec::new() }
        }

        fn covers(&self) -> Vec<&'static str> {
            vec![STEP]
        }

        fn occurs(&self, _: &Turn<'_, Self>) -> u64 {
            1
        }
    }

    impl System for Graphic {
        type Part = usize;

        fn part(&self, &node: &usize, _: usize) -> usize {
            node
        }

        fn put(&self, state: &mut usize, _: usize, &node: &usize) {
            *state = node;
        }

        fn acting(&self, turn: &Turn<'_, Self>) -> Bits {
            turn.event.1
        }

        fn is_bound(&self, turn: &Turn<'_, Self>) -> bool {
            turn.event.1 != 0
        }

        fn broken_by_endless_runs(&self) -> Option<&'static str> {
            Some(ROUND)
        }

        fn owed(&self, node: &usize) -> Bits {
            self.owing.contains(node).into()
        }

        fn awake(&self, _: &usize) -> Bits {
            self.awake
        }

        fn is_enough(&self, _: &'static str) -> bool {
            self.is_enough
        }
    }

    const NOWHERE: usize = 99;

    /// 0, 1 and 2 go round, and so do 3 and 4, and 6; a fault leads from 5 to 6. A second agent acts only between 0 and 2.
    const GRAPH: Graphic = Graphic {
        arcs: &[&[(1, 1)], &[(2, 1), (3, 1)], &[(0, 2)], &[(4, 1)], &[(3, 1), (5, 1)], &[(6, 0)], &[(6, 1)]],
        forbidden: NOWHERE,
        dead: NOWHERE,
        owing: &[],
        awake: 0,
        is_enough: true,
    };

    fn found(graph: &Graphic) -> Findings<&'static str> {
        search(graph, [0], Limits::NONE)
    }

    fn broken(graph: &Graphic) -> Option<Run<&'static str>> {
        found(graph).broken.pop()
    }

    #[test]
    fn every_state_is_looked_at_once() {
        let bytes = found(&GRAPH).bytes;
        let all = Findings {
            states: 7,
            looked_at: 7,
            steps: 9,
            bytes,
            is_whole: true,
            covered: vec![STEP],
            broken: Vec::new(),
        };
        assert_eq!(found(&GRAPH), all);
        assert_eq!(search(&GRAPH, [0, 3, 0], Limits::steps(9)), all);
    }

    #[test]
    fn a_search_stops_at_the_most_steps() {
        let some = search(&GRAPH, [0], Limits::steps(4));
        assert_eq!((some.states, some.looked_at, some.steps, some.is_whole), (4, 4, 4, false));
    }

    #[test]
    fn whoever_watches_a_search_hears_of_each_state_and_may_end_it() {
        let mut heard = Vec::new();
        let mut watch = |looked_at| {
            heard.push(looked_at);
            if looked_at == 3 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        };
        let some = watched(&GRAPH, [0], Limits::NONE, &mut watch);
        assert_eq!((some.looked_at, some.is_whole, heard), (2, false, vec![1, 2, 3]));
    }

    #[test]
    fn a_shortest_run_comes_from_the_nearest_start() {
        let graph = Graphic { forbidden: 5, ..GRAPH };
        let run = |start, steps| Run { demand: "not there", start, steps, ending: Ending::There };
        assert_eq!(broken(&graph), Some(run(0, vec![0, 1, 0, 1])));
        assert_eq!(search(&graph, [0, 3], Limits::NONE).broken, [run(1, vec![0, 1])]);
    }

    #[test]
    fn a_run_ends_where_no_step_is_bound_to_be_made() {
        let run = Run { demand: "no end there", start: 0, steps: vec![0, 1, 0, 1], ending: Ending::Still };
        assert_eq!(broken(&Graphic { dead: 5, ..GRAPH }), Some(run));
        assert_eq!(broken(&Graphic { dead: 4, ..GRAPH }), None);
    }

    /// The step to 1 is forbidden, and all runs make it first.
    #[test]
    fn a_demand_that_is_broken_first_hides_none_of_the_others() {
        let alone = |graph: Graphic| broken(&Graphic { is_enough: true, ..graph }).expect("it is broken");
        let (forbidden, dead, owing) = (1, 5, &[6]);
        let all = Graphic { forbidden, dead, owing, is_enough: false, ..GRAPH };
        let step = alone(Graphic { forbidden, ..GRAPH });
        let end = alone(Graphic { dead, ..GRAPH });
        let other_end = Run { demand: "no end at all", ..end.clone() };
        let round = alone(Graphic { owing, ..GRAPH });
        assert_eq!(found(&all).broken, [step, end, other_end, round]);
    }

    #[test]
    fn an_endless_run_goes_round_where_something_is_owed_throughout() {
        let round = |steps, round| Run { demand: ROUND, start: 0, steps, ending: Ending::Round(round) };
        let owing = |owing| Graphic { owing, ..GRAPH };
        assert_eq!(broken(&owing(&[0, 2, 3, 5])), None);
        assert_eq!(broken(&owing(&[0, 1, 2, 3, 4])), Some(round(vec![], vec![0, 0, 0])));
        assert_eq!(broken(&owing(&[0, 3, 4, 6])), Some(round(vec![0, 1], vec![0, 0])));
        assert_eq!(broken(&owing(&[5, 6])), Some(round(vec![0, 1, 0, 1, 0], vec![0])));
    }

    #[test]
    fn an_endless_run_keeps_nobody_from_acting() {
        let owing = &[1, 2, 3, 4, 5, 6];
        assert_eq!(broken(&Graphic { awake: 3, owing, ..GRAPH }), None);
        let round = |steps, round| Run { demand: ROUND, start: 0, steps, ending: Ending::Round(round) };
        assert_eq!(broken(&Graphic { awake: 1, owing, ..GRAPH }), Some(round(vec![0, 1], vec![0, 0])));
        let owing = &[0, 1, 2];
        assert_eq!(broken(&Graphic { awake: 3, owing, ..GRAPH }), Some(round(vec![], vec![0, 0, 0])));
    }

    #[test]
    fn everybody_who_is_awake_acts_in_a_round() {
        const SHARED: &[&[SketchArc]] = &[&[(0, 1), (1, 2)], &[(0, 2)]];
        const FAR: &[&[SketchArc]] = &[&[(0, 1), (1, 1)], &[(1, 2), (2, 1), (0, 1)], &[(1, 1), (2, 4)]];
        let round = |awake, arcs| {
            let found = broken(&Graphic { awake, arcs, owing: &[0, 1, 2], ..GRAPH });
            found.map(|run| run.ending)
        };
        assert_eq!(round(1, SHARED), Some(Ending::Round(vec![0])));
        assert_eq!(round(3, SHARED), Some(Ending::Round(vec![0, 1, 0])));
        assert_eq!(round(1, FAR), Some(Ending::Round(vec![0])));
        assert_eq!(round(3, FAR), Some(Ending::Round(vec![0, 1, 0, 2])));
        assert_eq!(round(7, FAR), Some(Ending::Round(vec![0, 1, 0, 1, 1, 0, 2])));
        assert_eq!(round(15, FAR), None);
    }

    #[test]
    fn a_search_that_would_take_too_much_memory_is_not_whole() {
        let all = found(&GRAPH);
        let in_room =
            |bytes| search(&GRAPH, [0], Limits { room: &MemoryLimit::of(bytes, 1), ..Limits::NONE });
        assert_eq!(in_room(2 * all.bytes), all);
        let cut_off = in_room(8);
        assert_eq!((cut_off.is_whole, cut_off.looked_at, cut_off.broken), (false, 0, vec![]));
        // The states have room, and the search for rounds has not.
        let owing = Graphic { owing: &[3, 4], ..GRAPH };
        let all = found(&owing);
        assert!(all.is_whole && all.broken.len() == 1);
        let cut_off =
            search(&owing, [0], Limits { room: &MemoryLimit::of(all.bytes * 4 / 3 - 4, 1), ..Limits::NONE });
        assert_eq!((cut_off.is_whole, cut_off.looked_at, cut_off.broken), (false, 7, vec![]));
    }

    /// From 0 a fault and then a step to 1 and back.
    #[test]
    fn the_steps_of_a_round_are_numbered_among_all_steps() {
        const FAULTY: &[&[SketchArc]] = &[&[(2, 0), (1, 1)], &[(2, 0), (2, 0), (0, 1)], &[]];
        let round = broken(&Graphic { arcs: FAULTY, owing: &[0, 1], ..GRAPH });
        assert_eq!(round.map(|run| run.ending), Some(Ending::Round(vec![1, 2])));
    }
}

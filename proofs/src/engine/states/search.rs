//! The search itself: it makes all steps from each state in the order in which they were met, and keeps of each demand
//! the first run that breaks it.

use std::collections::VecDeque;
use std::ops::ControlFlow;

use rustc_hash::FxHashMap;

use super::graph::{Arc, Graph, Node, Way};
use super::{END, Ending, Found, Run, Step, System};
use crate::engine::cover;

/// Searches all states that `system` gets to from `starts`, until enough is broken or `most_steps` are made.
pub fn search<S: System>(
    system: &S,
    starts: impl IntoIterator<Item = S::State>,
    most_steps: u32,
) -> Found<S::Demand> {
    let mut search = Search::new(system);
    for (start, state) in starts.into_iter().enumerate() {
        search.meet(state, Way::Start(start as u32));
    }
    let stop = search.look_at_all(most_steps).break_value();
    if let (None, Some(demand)) = (stop, system.broken_by_endless_runs()) {
        search.look_for_rounds(demand);
    }
    Found {
        states: search.graph.nodes.len() as u64,
        looked_at: search.graph.first_arc.len() as u64,
        steps: search.graph.arcs.len() as u64,
        is_whole: stop != Some(Stop::TooMany),
        broken: search.broken.iter().map(|broken| search.run(broken)).collect(),
        covered: search.covered,
    }
}

/// Why a search stops although there are states ahead.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Stop {
    Enough,
    TooMany,
}

struct Broken<D> {
    demand: D,
    node: usize,
    how: How,
}

enum How {
    /// By the step from the node with this number.
    Step(u32),
    /// By staying in the node.
    Still,
    /// By these steps from the node back to it.
    Round(Vec<u32>),
}

struct Search<'a, S: System> {
    system: &'a S,
    known: FxHashMap<S::Key, u32>,
    /// The states that have yet to be gone on from, in the order of their nodes, which are the last ones.
    ahead: VecDeque<S::State>,
    graph: Graph,
    covered: Vec<&'static str>,
    broken: Vec<Broken<S::Demand>>,
}

impl<'a, S: System> Search<'a, S> {
    fn new(system: &'a S) -> Self {
        Self {
            system,
            known: FxHashMap::default(),
            ahead: VecDeque::new(),
            graph: Graph::default(),
            covered: Vec::new(),
            broken: Vec::new(),
        }
    }

    /// The number of the node of `state`, which may be new.
    fn meet(&mut self, state: S::State, way: Way) -> u32 {
        let next = self.graph.nodes.len() as u32;
        let place = *self.known.entry(self.system.key(&state)).or_insert(next);
        if place == next {
            let (owed, awake) = (self.system.owed(&state), self.system.awake(&state));
            self.graph.nodes.push(Node { way, owed, awake });
            self.ahead.push_back(state);
        }
        place
    }

    /// Makes all steps from all nodes.
    fn look_at_all(&mut self, most_steps: u32) -> ControlFlow<Stop> {
        while let Some(state) = self.ahead.pop_front() {
            self.look(&state, most_steps)?;
        }
        ControlFlow::Continue(())
    }

    /// Makes all steps from the next node, whose state it is.
    fn look(&mut self, state: &S::State, most_steps: u32) -> ControlFlow<Stop> {
        let node = self.graph.first_arc.len();
        self.graph.first_arc.push(self.graph.arcs.len() as u32);
        let (mut is_last, mut is_still) = (true, true);
        for (number, step) in (0..).zip(self.system.steps(state)) {
            let Step { state, situation, acting, is_bound, breaks } = step;
            if self.graph.arcs.len() as u32 == most_steps {
                return ControlFlow::Break(Stop::TooMany);
            }
            is_last = false;
            is_still &= !is_bound;
            cover(&mut self.covered, situation);
            let to = self.meet(state, Way::Step(node as u32));
            self.graph.arcs.push(Arc { to, acting, is_bound });
            for demand in breaks {
                self.note(Broken { demand, node, how: How::Step(number) })?;
            }
        }
        if is_last {
            cover(&mut self.covered, END);
        }
        if is_still && let Some(demand) = self.system.broken_at_end(state) {
            self.note(Broken { demand, node, how: How::Still })?;
        }
        ControlFlow::Continue(())
    }

    /// Keeps what is broken for the first time.
    fn note(&mut self, new: Broken<S::Demand>) -> ControlFlow<Stop> {
        if self.broken.iter().any(|broken| broken.demand == new.demand) {
            return ControlFlow::Continue(());
        }
        let is_enough = self.system.is_enough(new.demand);
        self.broken.push(new);
        if is_enough { ControlFlow::Break(Stop::Enough) } else { ControlFlow::Continue(()) }
    }

    fn run(&self, broken: &Broken<S::Demand>) -> Run<S::Demand> {
        let (start, mut steps) = self.graph.way(broken.node);
        let ending = match &broken.how {
            How::Step(number) => {
                steps.push(*number);
                Ending::There
            }
            How::Still => Ending::Still,
            How::Round(round) => Ending::Round(round.clone()),
        };
        Run { demand: broken.demand, start, steps, ending }
    }

    /// Looks for runs that go round and owe the same thing throughout. The one that gets there first counts, unless a
    /// run that breaks the same demand stays in a state that is found before.
    fn look_for_rounds(&mut self, demand: S::Demand) {
        let Some((node, round)) = self.graph.first_round() else { return };
        let known = self.broken.iter().position(|broken| broken.demand == demand);
        match known {
            Some(place) if self.broken[place].node <= node => {}
            Some(place) => self.broken[place] = Broken { demand, node, how: How::Round(round) },
            None => self.broken.push(Broken { demand, node, how: How::Round(round) }),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::Bits;
    use super::*;

    /// An arc of a graph that one can look at: where it leads, and who acts.
    type Drawn = (usize, Bits);

    /// Such a graph, and the demands on it. Node 0 is the start.
    struct Graphic {
        arcs: &'static [&'static [Drawn]],
        /// No step leads there.
        forbidden: usize,
        /// No run ends there.
        dead: usize,
        /// Where something is owed.
        owing: &'static [usize],
        /// Whom nothing but their own acts puts to sleep.
        awake: Bits,
    }

    const STEP: &str = "a step";
    const ROUND: &str = "no run owes something for ever";

    impl System for Graphic {
        type State = usize;
        type Key = usize;
        type Demand = &'static str;

        fn key(&self, &node: &usize) -> usize {
            node
        }

        fn steps(&self, &node: &usize) -> impl Iterator<Item = Step<usize, &'static str>> {
            self.arcs[node].iter().map(|&(state, acting)| {
                let breaks = if state == self.forbidden { vec!["not there"] } else { Vec::new() };
                Step { state, situation: STEP, acting, is_bound: acting != 0, breaks }
            })
        }

        fn broken_at_end(&self, &node: &usize) -> Option<&'static str> {
            (node == self.dead).then_some("no end there")
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
    }

    const NOWHERE: usize = 99;

    /// 0, 1 and 2 go round, and so do 3 and 4, and 6; a fault leads from 5 to 6. A second agent acts only between 0 and 2.
    const GRAPH: Graphic = Graphic {
        arcs: &[&[(1, 1)], &[(2, 1), (3, 1)], &[(0, 2)], &[(4, 1)], &[(3, 1), (5, 1)], &[(6, 0)], &[(6, 1)]],
        forbidden: NOWHERE,
        dead: NOWHERE,
        owing: &[],
        awake: 0,
    };

    fn found(graph: &Graphic) -> Found<&'static str> {
        search(graph, [0], u32::MAX)
    }

    fn broken(graph: &Graphic) -> Option<Run<&'static str>> {
        found(graph).broken.pop()
    }

    #[test]
    fn every_state_is_looked_at_once() {
        let all = Found {
            states: 7,
            looked_at: 7,
            steps: 9,
            is_whole: true,
            covered: vec![STEP],
            broken: Vec::new(),
        };
        assert_eq!(found(&GRAPH), all);
        assert_eq!(search(&GRAPH, [0, 3, 0], 9), all);
    }

    #[test]
    fn a_search_stops_at_the_most_steps() {
        let some = search(&GRAPH, [0], 4);
        assert_eq!((some.states, some.looked_at, some.steps, some.is_whole), (4, 4, 4, false));
    }

    #[test]
    fn a_shortest_run_comes_from_the_nearest_start() {
        let graph = Graphic { forbidden: 5, ..GRAPH };
        let run = |start, steps| Run { demand: "not there", start, steps, ending: Ending::There };
        assert_eq!(broken(&graph), Some(run(0, vec![0, 1, 0, 1])));
        assert_eq!(search(&graph, [0, 3], u32::MAX).broken, [run(1, vec![0, 1])]);
    }

    #[test]
    fn a_run_ends_where_no_step_is_bound_to_be_made() {
        let run = Run { demand: "no end there", start: 0, steps: vec![0, 1, 0, 1], ending: Ending::Still };
        assert_eq!(broken(&Graphic { dead: 5, ..GRAPH }), Some(run));
        assert_eq!(broken(&Graphic { dead: 4, ..GRAPH }), None);
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
        const SHARED: &[&[Drawn]] = &[&[(0, 1), (1, 2)], &[(0, 2)]];
        const FAR: &[&[Drawn]] = &[&[(0, 1), (1, 1)], &[(1, 2), (2, 1), (0, 1)], &[(1, 1), (2, 4)]];
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
}

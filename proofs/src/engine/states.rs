//! The search over all states of a system whose ways merge: what happens next is open at every step, so most ways lead
//! to states that others have led to. States are found in breadth, so that the way to each is as short as can be. When
//! there are no more, those that the system can come back to are looked at for runs that go on for ever and owe the same
//! thing throughout, although everybody acts who is not kept from it: the strongly connected components (Tarjan 1972).
//!
//! Of a state that has been gone on from only what tells it from others is kept. A run is given by the numbers of its
//! steps, each among all steps from its state.

use std::collections::VecDeque;
use std::collections::hash_map::Entry;
use std::hash::Hash;
use std::ops::ControlFlow;

use rustc_hash::FxHashMap;

use super::cover;

/// A set of at most sixteen things, one bit each.
pub type Bits = u16;

/// A system whose states are searched.
pub trait System {
    /// All that it is.
    type State;
    /// What tells one state from another.
    type Key: Eq + Hash;
    /// What can be broken.
    type Demand: Copy + Eq;

    /// What tells `state` from others.
    fn key(&self, state: &Self::State) -> Self::Key;

    /// Every step from `state`, always in the same order.
    fn steps(&self, state: &Self::State) -> impl Iterator<Item = Step<Self::State, Self::Demand>>;

    /// What is broken by staying in `state`, from which no step is bound to be made.
    fn broken_at_end(&self, _: &Self::State) -> Option<Self::Demand> {
        None
    }

    /// What is broken by a run that never ends and owes the same thing throughout, everybody acting who is awake
    /// throughout; `None` if that is not looked for.
    fn broken_by_endless_runs(&self) -> Option<Self::Demand> {
        None
    }

    /// What is owed in `state`: the same one thing always, unless there is more to tell.
    fn owed(&self, _: &Self::State) -> Bits {
        1
    }

    /// Who has something left to do in `state`.
    fn awake(&self, _: &Self::State) -> Bits {
        0
    }

    /// Whether nothing more is looked for once a step or an end breaks `demand`.
    fn is_enough(&self, _: Self::Demand) -> bool {
        true
    }
}

/// A step to another state.
pub struct Step<S, D> {
    /// Where it leads.
    pub state: S,
    /// Which of the situations that are to be covered it is.
    pub situation: &'static str,
    /// Who acts in it.
    pub acting: Bits,
    /// Whether it is bound to be made if no other one is.
    pub is_bound: bool,
    /// What it breaks.
    pub breaks: Vec<D>,
}

/// The situation in which a run ends.
pub const END: &str = "an end";

/// What was found.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Found<D> {
    /// States, the starts among them.
    pub states: u64,
    /// States from which all steps were made, or the one that broke enough.
    pub looked_at: u64,
    /// Steps between states.
    pub steps: u64,
    /// Whether the search came to its end, and not to the most steps that it may make.
    pub is_whole: bool,
    /// The situations that occurred, sorted.
    pub covered: Vec<&'static str>,
    /// A shortest run for each demand that is broken.
    pub broken: Vec<Run<D>>,
}

/// A run that breaks a demand.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Run<D> {
    /// What it breaks.
    pub demand: D,
    /// The number of its start.
    pub start: usize,
    /// The numbers of its steps.
    pub steps: Vec<u32>,
    /// How it breaks it.
    pub ending: Ending,
}

/// How a run breaks a demand.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Ending {
    /// By its last step.
    There,
    /// No step is bound to be made from its last state.
    Still,
    /// These steps lead from its last state back to it.
    Round(Vec<u32>),
}

impl<D> Run<D> {
    /// The numbers of the steps of its round; none if it ends.
    pub fn round(&self) -> &[u32] {
        match &self.ending {
            Ending::There | Ending::Still => &[],
            Ending::Round(round) => round,
        }
    }
}

/// Searches all states that `system` gets to from `starts`, until enough is broken or `most_steps` are made.
pub fn search<S: System>(
    system: &S,
    starts: impl IntoIterator<Item = S::State>,
    most_steps: u32,
) -> Found<S::Demand> {
    let mut graph = Graph::new(system);
    for (start, state) in starts.into_iter().enumerate() {
        graph.meet(state, Way::Start(start as u32));
    }
    let stop = graph.look_at_all(most_steps).break_value();
    if let (None, Some(demand)) = (stop, system.broken_by_endless_runs()) {
        graph.look_for_rounds(demand);
    }
    Found {
        states: graph.nodes.len() as u64,
        looked_at: graph.first_arc.len() as u64,
        steps: graph.arcs.len() as u64,
        is_whole: stop != Some(Stop::TooMany),
        broken: graph.broken.iter().map(|broken| graph.run(broken)).collect(),
        covered: graph.covered,
    }
}

/// In place of a number of a node.
const NONE: u32 = u32::MAX;

/// Why a search stops although there are states ahead.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Stop {
    Enough,
    TooMany,
}

/// How a state was first found.
#[derive(Clone, Copy)]
enum Way {
    /// It is the start with this number.
    Start(u32),
    /// By a step from this node.
    Step(u32),
}

struct Node {
    way: Way,
    owed: Bits,
    awake: Bits,
}

struct Arc {
    to: u32,
    acting: Bits,
    is_bound: bool,
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

struct Graph<'a, S: System> {
    system: &'a S,
    known: FxHashMap<S::Key, u32>,
    nodes: Vec<Node>,
    /// The states that have yet to be gone on from, in the order of their nodes, which are the last ones.
    ahead: VecDeque<S::State>,
    /// Of each node that is gone on from, where its arcs begin.
    first_arc: Vec<u32>,
    arcs: Vec<Arc>,
    covered: Vec<&'static str>,
    broken: Vec<Broken<S::Demand>>,
}

impl<'a, S: System> Graph<'a, S> {
    fn new(system: &'a S) -> Self {
        Self {
            system,
            known: FxHashMap::default(),
            nodes: Vec::new(),
            ahead: VecDeque::new(),
            first_arc: Vec::new(),
            arcs: Vec::new(),
            covered: Vec::new(),
            broken: Vec::new(),
        }
    }

    /// The number of the node of `state`, which may be new.
    fn meet(&mut self, state: S::State, way: Way) -> u32 {
        let next = self.nodes.len() as u32;
        let place = *self.known.entry(self.system.key(&state)).or_insert(next);
        if place == next {
            let (owed, awake) = (self.system.owed(&state), self.system.awake(&state));
            self.nodes.push(Node { way, owed, awake });
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
        let node = self.first_arc.len();
        self.first_arc.push(self.arcs.len() as u32);
        let (mut is_last, mut is_still) = (true, true);
        for (number, step) in (0..).zip(self.system.steps(state)) {
            let Step { state, situation, acting, is_bound, breaks } = step;
            if self.arcs.len() as u32 == most_steps {
                return ControlFlow::Break(Stop::TooMany);
            }
            is_last = false;
            is_still &= !is_bound;
            cover(&mut self.covered, situation);
            let to = self.meet(state, Way::Step(node as u32));
            self.arcs.push(Arc { to, acting, is_bound });
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

    fn arcs(&self, node: usize) -> &[Arc] {
        let end = self.first_arc.get(node + 1).map_or(self.arcs.len(), |&end| end as usize);
        &self.arcs[self.first_arc[node] as usize..end]
    }

    fn run(&self, broken: &Broken<S::Demand>) -> Run<S::Demand> {
        let (start, mut steps) = self.way(broken.node);
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

    /// The start, and the steps from it that first led to a node.
    fn way(&self, mut node: usize) -> (usize, Vec<u32>) {
        let mut steps = Vec::new();
        loop {
            match self.nodes[node].way {
                Way::Start(start) => {
                    steps.reverse();
                    return (start as usize, steps);
                }
                Way::Step(from) => {
                    let before = from as usize;
                    let number = self.arcs(before).iter().position(|arc| arc.to as usize == node);
                    steps.extend(number.map(|number| number as u32));
                    node = before;
                }
            }
        }
    }

    /// Looks for runs that go round and owe the same thing throughout. The one that gets there first counts, unless a
    /// run that breaks the same demand stays in a state that is found before.
    fn look_for_rounds(&mut self, demand: S::Demand) {
        let all = self.nodes.iter().fold(0, |all, node| all | node.owed);
        let each = (0..Bits::BITS).map(|bit| 1 << bit).filter(|owed| all & owed != 0);
        let Some((node, round)) = each.filter_map(|owed| self.round(owed)).min_by_key(|&(node, _)| node)
        else {
            return;
        };
        let known = self.broken.iter().position(|broken| broken.demand == demand);
        match known {
            Some(place) if self.broken[place].node <= node => {}
            Some(place) => self.broken[place] = Broken { demand, node, how: How::Round(round) },
            None => self.broken.push(Broken { demand, node, how: How::Round(round) }),
        }
    }

    /// The first node from which a run can go round in which `owed` is owed and all act who are awake throughout; and
    /// the numbers of the steps of such a round.
    fn round(&self, owed: Bits) -> Option<(usize, Vec<u32>)> {
        let part = self.components(owed);
        let mut awake = vec![Bits::MAX; self.nodes.len()];
        let mut acting = vec![None; self.nodes.len()];
        for (node, _) in part.iter().enumerate().filter(|&(_, &part)| part != NONE) {
            let home = part[node] as usize;
            awake[home] &= self.nodes[node].awake;
            for arc in
                self.arcs(node).iter().filter(|arc| arc.is_bound && part[arc.to as usize] == part[node])
            {
                acting[home] = Some(acting[home].unwrap_or(0) | arc.acting);
            }
        }
        let is_fair = |home: usize| acting[home].is_some_and(|acting| awake[home] & !acting == 0);
        let first = (0..self.nodes.len()).find(|&node| part[node] != NONE && is_fair(part[node] as usize))?;
        Some((first, self.way_round(&part, first, awake[part[first] as usize])))
    }

    /// The numbers of the steps of a way from `home` round to it within its part in which all of `due` act: a shortest
    /// one, and for each whom it leaves out a way on to the nearest step of theirs and home.
    fn way_round(&self, part: &[u32], home: usize, due: Bits) -> Vec<u32> {
        let (mut steps, mut node, mut left) = (Vec::new(), home, due);
        loop {
            let is_homeward = |arc: &Arc| arc.to as usize == home;
            let is_due = |arc: &Arc| arc.acting & left != 0;
            let onward = if steps.is_empty() || left == 0 {
                self.way_within(part, node, is_homeward)
            } else {
                self.way_within(part, node, is_due)
            };
            for &number in &onward {
                let arc = &self.arcs(node)[number as usize];
                (node, left) = (arc.to as usize, left & !arc.acting);
            }
            let is_over = onward.is_empty() || node == home && left == 0;
            steps.extend(onward);
            if is_over {
                return steps;
            }
        }
    }

    /// The numbers of the steps of a shortest way from `start` within its part, up to the first step that `is_last`.
    fn way_within(&self, part: &[u32], start: usize, is_last: impl Fn(&Arc) -> bool) -> Vec<u32> {
        let mut before = FxHashMap::default();
        let mut ahead = VecDeque::from([start]);
        while let Some(node) = ahead.pop_front() {
            for (number, arc) in (0..).zip(self.arcs(node)) {
                let to = arc.to as usize;
                if !arc.is_bound || part[to] != part[start] {
                    continue;
                }
                if is_last(arc) {
                    let mut steps = vec![number];
                    let mut last = node;
                    while last != start
                        && let Some(&(from, number)) = before.get(&last)
                    {
                        steps.push(number);
                        last = from;
                    }
                    steps.reverse();
                    return steps;
                }
                if let Entry::Vacant(entry) = before.entry(to) {
                    entry.insert((node, number));
                    ahead.push_back(to);
                }
            }
        }
        Vec::new()
    }

    /// The strongly connected component of each node in which `owed` is owed, among such nodes and steps that are bound
    /// to be made; it goes by the number of one of its nodes, and is [`NONE`] for the other nodes.
    fn components(&self, owed: Bits) -> Vec<u32> {
        let size = self.nodes.len();
        let is_inside = |node: usize| self.nodes[node].owed & owed != 0;
        let (mut order, mut low, mut component) = (vec![NONE; size], vec![0; size], vec![NONE; size]);
        let (mut count, mut open, mut path) = (0, Vec::new(), Vec::new());
        for root in (0..size).filter(|&node| is_inside(node)) {
            if order[root] != NONE {
                continue;
            }
            path.push((root, 0));
            while let Some(&mut (node, ref mut next)) = path.last_mut() {
                if *next == 0 {
                    order[node] = count;
                    low[node] = count;
                    count += 1;
                    open.push(node);
                }
                if let Some(arc) = self.arcs(node).get(*next) {
                    *next += 1;
                    let to = arc.to as usize;
                    if !arc.is_bound || !is_inside(to) {
                        continue;
                    }
                    if order[to] == NONE {
                        path.push((to, 0));
                    } else if component[to] == NONE {
                        low[node] = low[node].min(order[to]);
                    }
                    continue;
                }
                path.pop();
                if let Some(&(before, _)) = path.last() {
                    low[before] = low[before].min(low[node]);
                }
                if low[node] == order[node] {
                    while let Some(member) = open.pop() {
                        component[member] = node as u32;
                        if member == node {
                            break;
                        }
                    }
                }
            }
        }
        component
    }
}

#[cfg(test)]
mod tests {
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

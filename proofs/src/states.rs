//! The search over all states of a system whose ways merge: which of several agents acts next is open at every step,
//! so most ways lead to states that others have led to. States are found in breadth, so that the way to each is as
//! short as can be. When there are no more, those that the system can come back to are looked at for runs that go on
//! for ever although no agent is kept from acting.

use std::hash::Hash;

use rustc_hash::FxHashMap;
use tautline_kernel::choice::Source;

use crate::engine::Odometer;

/// A system whose steps are answers to choices.
pub(crate) trait System {
    /// All that it is.
    type State: Clone + Eq + Hash;

    /// One step from `state`; `None` if nobody has anything left to do. Then nothing was asked of `world`.
    fn step(&self, state: &Self::State, world: &mut dyn Source) -> Option<Step<Self::State>>;

    /// What is wrong with the end of a run in `state`.
    fn broken_at_end(&self, state: &Self::State) -> Option<&'static str>;

    /// What is broken by a run that never ends although every agent acts again and again; `None` if that is not looked
    /// for.
    fn broken_by_endless_runs(&self) -> Option<&'static str>;

    /// The agents that have something left to do in `state`, as bits.
    fn awake(&self, state: &Self::State) -> u32;
}

/// A step to another state.
pub(crate) struct Step<S> {
    /// The number of the agent that made it.
    pub(crate) agent: u32,
    pub(crate) state: S,
    /// What it breaks.
    pub(crate) breaks: Option<&'static str>,
}

/// What was found.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) struct Found {
    /// States, the starts among them.
    pub(crate) states: u64,
    /// Steps between them.
    pub(crate) steps: u64,
    /// A shortest run that breaks something.
    pub(crate) broken: Option<Run>,
}

/// A run: which start it has, the answers of each step, and what it breaks.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) struct Run {
    pub(crate) start: usize,
    pub(crate) answers: Vec<Vec<u32>>,
    pub(crate) demand: &'static str,
}

/// Searches all states that `system` gets to from `starts`, until something is broken.
pub(crate) fn search<S: System>(system: &S, starts: impl IntoIterator<Item = S::State>) -> Found {
    let mut graph =
        Graph { nodes: Vec::new(), places: FxHashMap::default(), first_arc: vec![0], arcs: Vec::new() };
    for (start, state) in starts.into_iter().enumerate() {
        graph.place(&state, Way::Start(start));
    }
    let mut next = 0;
    let mut broken = None;
    while broken.is_none() && next < graph.nodes.len() {
        broken = graph.expand(system, next);
        next += 1;
    }
    let endless = || {
        let demand = system.broken_by_endless_runs()?;
        graph.endless(system).map(|node| graph.run(system, node, demand))
    };
    let broken = broken.or_else(endless);
    Found { states: graph.nodes.len() as u64, steps: graph.arcs.len() as u64, broken }
}

/// How a state was first found.
#[derive(Clone, Copy)]
enum Way {
    /// It is a start.
    Start(usize),
    /// From another one, by the alternative with this number.
    Step(u32, u32),
}

struct Node<S> {
    state: S,
    way: Way,
}

struct Arc {
    to: u32,
    agent: u32,
}

struct Graph<S> {
    nodes: Vec<Node<S>>,
    places: FxHashMap<S, u32>,
    /// Of each node that is expanded, where its arcs begin; and where the last ones end.
    first_arc: Vec<usize>,
    arcs: Vec<Arc>,
}

impl<S: Clone + Eq + Hash> Graph<S> {
    /// The number of the node of `state`, which may be new.
    fn place(&mut self, state: &S, way: Way) -> u32 {
        let next = self.nodes.len() as u32;
        let place = *self.places.entry(state.clone()).or_insert(next);
        if place == next {
            self.nodes.push(Node { state: state.clone(), way });
        }
        place
    }

    /// Makes all steps from a node; the run that breaks something, if one does.
    fn expand(&mut self, system: &impl System<State = S>, node: usize) -> Option<Run> {
        let state = self.nodes[node].state.clone();
        let mut odometer = Odometer::default();
        for alternative in 0.. {
            let Some(step) = system.step(&state, &mut odometer) else {
                self.first_arc.push(self.arcs.len());
                return system.broken_at_end(&state).map(|demand| self.run(system, node, demand));
            };
            let to = self.place(&step.state, Way::Step(node as u32, alternative));
            self.arcs.push(Arc { to, agent: step.agent });
            if let Some(demand) = step.breaks {
                let mut run = self.run(system, node, demand);
                run.answers.push(odometer.answers());
                return Some(run);
            }
            if !odometer.advance() {
                break;
            }
        }
        self.first_arc.push(self.arcs.len());
        None
    }

    /// The run to a node.
    fn run(&self, system: &impl System<State = S>, mut node: usize, demand: &'static str) -> Run {
        let mut answers = Vec::new();
        loop {
            match self.nodes[node].way {
                Way::Start(start) => {
                    answers.reverse();
                    return Run { start, answers, demand };
                }
                Way::Step(from, alternative) => {
                    node = from as usize;
                    let mut odometer = Odometer::default();
                    for _ in 0..alternative {
                        system.step(&self.nodes[node].state, &mut odometer);
                        odometer.advance();
                    }
                    system.step(&self.nodes[node].state, &mut odometer);
                    answers.push(odometer.answers());
                }
            }
        }
    }

    fn arcs(&self, node: usize) -> &[Arc] {
        &self.arcs[self.first_arc[node]..self.first_arc[node + 1]]
    }

    /// The first node from which a run can come back, all agents that are awake having acted.
    fn endless(&self, system: &impl System<State = S>) -> Option<usize> {
        let component = self.components();
        let mut acting = vec![0_u32; self.nodes.len()];
        for node in 0..self.nodes.len() {
            for arc in self.arcs(node) {
                if component[arc.to as usize] == component[node] {
                    acting[component[node] as usize] |= 1 << arc.agent;
                }
            }
        }
        (0..self.nodes.len()).find(|&node| {
            let acts = acting[component[node] as usize];
            let awake = system.awake(&self.nodes[node].state);
            acts != 0 && acts & awake == awake
        })
    }

    /// The strongly connected component of each node, named by one of its nodes (Tarjan 1972).
    fn components(&self) -> Vec<u32> {
        const NEW: u32 = u32::MAX;
        let size = self.nodes.len();
        let (mut order, mut low, mut component) = (vec![NEW; size], vec![0; size], vec![NEW; size]);
        let (mut count, mut open, mut path) = (0, Vec::new(), Vec::new());
        for root in 0..size {
            if order[root] != NEW {
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
                    if order[to] == NEW {
                        path.push((to, 0));
                    } else if component[to] == NEW {
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

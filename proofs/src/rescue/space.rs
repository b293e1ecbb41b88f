//! All states of a [`Setting`], fewest actions first, and in them the shortest run that breaks each demand. That a WFR is
//! served in the end (MRC-5) is broken by a state in which nothing more is bound to happen, or by states that can go
//! round for ever, no timer that runs being left out: of the waiting states the strongly connected components.

use std::collections::HashMap;
use std::collections::hash_map::Entry;

use super::{Action, Actor, Demand, ROBOTS, Setting, State, WFRS};

/// When to stop.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Until {
    /// When all states are known.
    Exhausted,
    /// When this demand is broken.
    Broken(Demand),
}

/// How a run breaks a demand.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Ending {
    /// Its last state does.
    There,
    /// Nothing more is bound to happen.
    Still,
    /// These actions lead from its last state back to it.
    Round(Vec<Action>),
}

/// The shortest run that breaks a demand.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Broken {
    /// Which.
    pub demand: Demand,
    /// Which of [`Setting::starts`] it starts from.
    pub start: usize,
    /// What happens.
    pub actions: Vec<Action>,
    /// How it ends.
    pub ending: Ending,
}

/// What the states have shown.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Found {
    /// States.
    pub states: usize,
    /// Steps from state to state.
    pub steps: usize,
    /// Whether these are all.
    pub complete: bool,
    /// The demands that are broken, each by its shortest run.
    pub broken: Vec<Broken>,
}

impl Found {
    /// The shortest run that breaks `demand`.
    pub fn broken(&self, demand: Demand) -> Option<&Broken> {
        self.broken.iter().find(|broken| broken.demand == demand)
    }
}

/// Searches all states of `setting`, at most `most_states` of them.
pub fn search(setting: &Setting, until: Until, most_states: usize) -> Found {
    let mut space = Space::new(*setting);
    space.explore(until, most_states);
    let safety = Demand::ALL.into_iter().zip(space.first_broken);
    let mut broken: Vec<Broken> = safety
        .filter_map(|(demand, state)| {
            let (start, actions) = space.way(state? as usize);
            Some(Broken { demand, start, actions, ending: Ending::There })
        })
        .collect();
    let complete = space.nodes.len() == space.offsets.len();
    if complete && matches!(until, Until::Exhausted | Until::Broken(Demand::IsServed)) {
        broken.extend(space.never_served());
    }
    broken.sort_by_key(|broken| broken.demand);
    Found { states: space.nodes.len(), steps: space.edges.len(), complete, broken }
}

/// A state, by what matters once it has been gone on from.
#[derive(Clone, Copy)]
struct Node {
    /// The state from which it was first reached, or the place of the start.
    parent: u32,
    /// By what; nothing leads to a start.
    action: Option<Action>,
    /// The WFRs that wait while a robot lives, one bit each.
    owed: u8,
    /// The actors whose timer runs, one bit each.
    armed: u8,
}

#[derive(Clone, Copy)]
struct Edge {
    to: u32,
    /// The actors whose timer goes off or starts anew, one bit each.
    timers: u8,
    /// Whether it is bound to happen.
    bound: bool,
}

struct Space {
    setting: Setting,
    known: HashMap<Box<[u8]>, u32>,
    nodes: Vec<Node>,
    /// Where the edges of each state end that has been gone on from.
    offsets: Vec<u32>,
    edges: Vec<Edge>,
    first_broken: [Option<u32>; Demand::ALL.len()],
}

const fn bit(actor: Actor) -> u8 {
    match actor {
        Actor::Robot(robot) => 1 << robot,
        Actor::Wfr(wfr) => 1 << (ROBOTS + wfr),
    }
}

fn actors() -> impl Iterator<Item = Actor> {
    (0..ROBOTS).map(Actor::Robot).chain((0..WFRS).map(Actor::Wfr))
}

fn bits(actors: impl Iterator<Item = Actor>) -> u8 {
    actors.map(bit).sum()
}

/// The actors whose timer is another one after `action`.
fn timers(before: &State, action: Action, after: &State) -> u8 {
    let has_changed = |&actor: &Actor| {
        action == Action::Expire(actor)
            || match actor {
                Actor::Robot(robot) => before.robots[robot].timer() != after.robots[robot].timer(),
                Actor::Wfr(wfr) => before.wfrs[wfr].timer() != after.wfrs[wfr].timer(),
            }
    };
    bits(actors().filter(has_changed))
}

impl Space {
    fn new(setting: Setting) -> Self {
        Self {
            setting,
            known: HashMap::new(),
            nodes: Vec::new(),
            offsets: Vec::new(),
            edges: Vec::new(),
            first_broken: [None; Demand::ALL.len()],
        }
    }

    /// Goes on from every state, those that fewest actions lead to first.
    fn explore(&mut self, until: Until, most_states: usize) {
        let starts = self.setting.starts();
        let mut level: Vec<State> = Vec::new();
        for (place, start) in starts.into_iter().enumerate() {
            self.meet(start, place as u32, None, &mut level);
        }
        while !level.is_empty() {
            let mut next = Vec::new();
            for state in &level {
                let is_settled = match until {
                    Until::Exhausted => false,
                    Until::Broken(demand) => self.first_broken[demand as usize].is_some(),
                };
                if is_settled || self.nodes.len() > most_states {
                    return;
                }
                let from = self.offsets.len() as u32;
                for action in state.actions(&self.setting) {
                    let after = state.after(&self.setting, action);
                    let timers = timers(state, action, &after);
                    let bound = state.is_bound_to_happen(&self.setting, action);
                    let to = self.meet(after, from, Some(action), &mut next);
                    self.edges.push(Edge { to, timers, bound });
                }
                self.offsets.push(self.edges.len() as u32);
            }
            level = next;
        }
    }

    /// The number of a state; a new one is put down for the next level.
    fn meet(&mut self, state: State, parent: u32, action: Option<Action>, next: &mut Vec<State>) -> u32 {
        let number = self.nodes.len() as u32;
        match self.known.entry(state.key()) {
            Entry::Occupied(known) => *known.get(),
            Entry::Vacant(place) => {
                place.insert(number);
                let owed = (0..self.setting.wfrs).filter(|&wfr| state.is_owed_service(&self.setting, wfr));
                let owed = owed.map(|wfr| 1 << wfr).sum();
                let armed = bits(actors().filter(|&actor| state.timer_runs(actor)));
                self.nodes.push(Node { parent, action, owed, armed });
                for (demand, first) in Demand::ALL.into_iter().zip(&mut self.first_broken) {
                    if first.is_none() && state.breaks(demand) {
                        *first = Some(number);
                    }
                }
                next.push(state);
                number
            }
        }
    }

    fn edges(&self, state: usize) -> &[Edge] {
        let from = if state == 0 { 0 } else { self.offsets[state - 1] as usize };
        &self.edges[from..self.offsets[state] as usize]
    }

    /// The start and the actions that first led to a state.
    fn way(&self, mut state: usize) -> (usize, Vec<Action>) {
        let mut actions = Vec::new();
        while let Node { parent, action: Some(action), .. } = self.nodes[state] {
            actions.push(action);
            state = parent as usize;
        }
        actions.reverse();
        (self.nodes[state].parent as usize, actions)
    }

    /// The shortest run in which a WFR waits for ever.
    fn never_served(&self) -> Option<Broken> {
        let is_still =
            |&state: &usize| self.nodes[state].owed != 0 && !self.edges(state).iter().any(|edge| edge.bound);
        let still = (0..self.nodes.len()).find(is_still).map(|state| (state, Ending::Still));
        let rounds = (0..self.setting.wfrs).filter_map(|wfr| {
            let round = self.first_round(1 << wfr)?;
            Some((round[0], Ending::Round(self.round(&round))))
        });
        let (state, ending) = still.into_iter().chain(rounds).min_by_key(|&(state, _)| state)?;
        let (start, actions) = self.way(state);
        Some(Broken { demand: Demand::IsServed, start, actions, ending })
    }

    /// Of the components in which a WFR waits for ever the one that is reached first, its states in order.
    fn first_round(&self, owed: u8) -> Option<Vec<usize>> {
        let inside = |state: usize| self.nodes[state].owed & owed != 0;
        let components = components(self.nodes.len(), |state| {
            let edges = if inside(state) { self.edges(state) } else { &[] };
            edges.iter().filter(|edge| edge.bound).map(|edge| edge.to as usize).filter(|&to| inside(to))
        });
        let mut first: Option<Vec<usize>> = None;
        for mut component in components {
            component.sort_unstable();
            let is_first = first.as_ref().is_none_or(|first| component[0] < first[0]);
            if is_first && inside(component[0]) && self.goes_round_for_ever(&component) {
                first = Some(component);
            }
        }
        first
    }

    /// Whether a run can stay in a component, every timer that runs throughout going off in it.
    fn goes_round_for_ever(&self, component: &[usize]) -> bool {
        let within = |edge: &&Edge| edge.bound && component.binary_search(&(edge.to as usize)).is_ok();
        let (mut armed, mut moved, mut has_edge) = (u8::MAX, 0, false);
        for &state in component {
            armed &= self.nodes[state].armed;
            for edge in self.edges(state).iter().filter(within) {
                has_edge = true;
                moved |= edge.timers;
            }
        }
        has_edge && armed & !moved == 0
    }

    /// The shortest way from the first state of a component round to it.
    fn round(&self, component: &[usize]) -> Vec<Action> {
        let home = component[0];
        let (start, actions) = self.way(home);
        let first = actions.iter().fold(self.setting.starts().swap_remove(start), |state, &action| {
            state.after(&self.setting, action)
        });
        let mut known = vec![home];
        let mut queue: Vec<(State, Vec<Action>)> = vec![(first, Vec::new())];
        while !queue.is_empty() {
            let mut next = Vec::new();
            for (state, way) in queue {
                for action in state.actions(&self.setting) {
                    let after = state.after(&self.setting, action);
                    let Some(&number) = self.known.get(&after.key()) else { continue };
                    let number = number as usize;
                    let is_bound = state.is_bound_to_happen(&self.setting, action);
                    if !is_bound || component.binary_search(&number).is_err() {
                        continue;
                    }
                    let way: Vec<Action> = way.iter().copied().chain([action]).collect();
                    if number == home {
                        return way;
                    }
                    if !known.contains(&number) {
                        known.push(number);
                        next.push((after, way));
                    }
                }
            }
            queue = next;
        }
        Vec::new()
    }
}

/// The strongly connected components of a graph of `count` nodes (Tarjan), without recursion.
fn components<I: Iterator<Item = usize>>(count: usize, next: impl Fn(usize) -> I) -> Vec<Vec<usize>> {
    const UNSEEN: u32 = u32::MAX;
    const DONE: u32 = u32::MAX - 1;
    let mut order = vec![UNSEEN; count];
    let mut low = vec![UNSEEN; count];
    let (mut open, mut found, mut seen) = (Vec::new(), Vec::new(), 0);
    for root in 0..count {
        if order[root] != UNSEEN {
            continue;
        }
        let mut stack = vec![(root, next(root))];
        (order[root], low[root]) = (seen, seen);
        seen += 1;
        open.push(root);
        while let Some((node, successors)) = stack.last_mut() {
            let node = *node;
            if let Some(to) = successors.next() {
                if order[to] == UNSEEN {
                    (order[to], low[to]) = (seen, seen);
                    seen += 1;
                    open.push(to);
                    stack.push((to, next(to)));
                } else if order[to] != DONE {
                    low[node] = low[node].min(order[to]);
                }
                continue;
            }
            stack.pop();
            if let Some(&(parent, _)) = stack.last() {
                low[parent] = low[parent].min(low[node]);
            }
            if low[node] == order[node] {
                let from = open.iter().rposition(|&other| other == node).unwrap_or(0);
                let component = open.split_off(from);
                for &state in &component {
                    order[state] = DONE;
                }
                found.push(component);
            }
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn components_are_those_of_a_graph_that_one_can_look_at() {
        let edges: [&[usize]; 7] = [&[1], &[2, 3], &[0], &[4], &[3, 5], &[], &[6]];
        let mut found = components(edges.len(), |node| edges[node].iter().copied());
        for component in &mut found {
            component.sort_unstable();
        }
        assert_eq!(found, [vec![5], vec![3, 4], vec![0, 1, 2], vec![6]]);
    }
}

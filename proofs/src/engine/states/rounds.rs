//! Runs that go round: among the states that owe the same thing throughout, the strongly connected components (Tarjan
//! 1972, with the memory of Pearce 2016) in which everybody acts who is awake throughout, and in these a shortest
//! round.

use rustc_hash::{FxHashMap, FxHashSet};

use super::Bits;
use super::graph::Graph;
use super::limits::MemoryShare;

/// In place of a component of a node that owes nothing.
pub(super) const NONE: u32 = 0;

/// The search would take more memory than it may.
pub(super) struct TooLarge;

/// A way back to a state.
pub(super) struct Round {
    pub(super) node: usize,
    /// The numbers of its steps, each among those that are bound to be made.
    pub(super) steps: Vec<u32>,
}

/// The search for a shortest run that goes round.
pub(super) struct ShortestRound {
    /// Only runs with fewer steps are looked for.
    pub(super) fewer_than: usize,
    pub(super) round: Option<Round>,
    /// Walks that may still be gone on from.
    walks: u32,
}

/// Walks that are gone on from in the search for a shortest round. Where there are more, as may be where many robots go
/// a long way round among a million states, the shortest of those that were found counts.
const MOST_WALKS: u32 = 1 << 20;

/// The bytes that a walk takes, if tables are half full.
const WALK: usize = 2 * (size_of::<(Walk, u32, u32)>() + size_of::<Walk>());

impl ShortestRound {
    pub(super) const fn new(fewer_than: usize) -> Self {
        Self { fewer_than, round: None, walks: MOST_WALKS }
    }

    fn take(&mut self, node: usize, depth: usize, steps: Vec<u32>) {
        self.fewer_than = depth + steps.len();
        self.round = Some(Round { node, steps });
    }

    /// Whether no run that goes round has fewer steps than it was looked for, or than the one that was found.
    pub(super) const fn is_known(&self) -> bool {
        self.walks > 0
    }
}

/// A component's properties beside its nodes.
#[derive(Clone, Copy)]
struct Component {
    /// Who acts in a step within it.
    acting: Bits,
    /// Who is awake in all its states.
    awake: Bits,
}

impl Component {
    const fn is_fair(self) -> bool {
        self.awake & !self.acting == 0
    }
}

/// A node on the way of the search for components.
struct Visit {
    node: u32,
    /// The number of its next arc.
    next: u32,
    /// Its place in the order of the search.
    order: u32,
}

/// The components of the nodes in which the same thing is owed.
struct Parts<'a> {
    graph: &'a Graph,
    /// The component of each node.
    part: Vec<u32>,
    /// Who is awake in each node of a component that has steps.
    awake: Vec<Bits>,
}

/// A walk within a component: where it is, and who has been awake all the way and has not acted.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
struct Walk {
    node: u32,
    idle: Bits,
}

impl Parts<'_> {
    const fn bytes(&self) -> u64 {
        (self.part.len() * size_of::<(u32, Bits, bool)>()) as u64
    }

    /// A shortest walk on from another one, up to the first that `is_over`, through nodes from `least` on, and its
    /// steps; `None` if it has as many steps as `fewer_than`, or not `may` as many walks be gone on from.
    fn walk(
        &self,
        (from, least): (Walk, usize),
        fewer_than: usize,
        is_over: impl Fn(Walk) -> bool,
        may: &mut dyn FnMut(usize) -> Result<bool, TooLarge>,
    ) -> Result<Option<(Walk, Vec<u32>)>, TooLarge> {
        // Of each walk the place of the one that it goes on from, and the number of its last step.
        let (mut all, mut known) = (vec![(from, 0, 0)], FxHashSet::default());
        let (mut next, mut last, mut length) = (0, all.len(), 1);
        while next < all.len() && length < fewer_than && may(all.len())? {
            let (walk, ..) = all[next];
            for (number, arc) in (0..).zip(self.graph.arcs(walk.node as usize)) {
                let to = arc.to as usize;
                if to < least || self.part[to] != self.part[from.node as usize] {
                    continue;
                }
                let onward = Walk { node: arc.to, idle: walk.idle & !arc.acting & self.awake[to] };
                if is_over(onward) {
                    let (mut steps, mut place) = (vec![number], next);
                    while place > 0 {
                        let (_, before, number) = all[place];
                        steps.push(number);
                        place = before as usize;
                    }
                    steps.reverse();
                    return Ok(Some((onward, steps)));
                }
                if known.insert(onward) {
                    all.push((onward, next as u32, number));
                }
            }
            next += 1;
            if next == last {
                (last, length) = (all.len(), length + 1);
            }
        }
        Ok(None)
    }

    /// A fair walk from `home` back to it, which need not be a shortest one: each of its ways leads to the nearest step
    /// after which somebody less is idle, the last one home.
    fn short_round(
        &self,
        home: Walk,
        may: &mut dyn FnMut(usize) -> Result<bool, TooLarge>,
    ) -> Result<Vec<u32>, TooLarge> {
        let (mut walk, mut steps) = (home, Vec::new());
        loop {
            let is_over = |onward: Walk| {
                if walk.idle == 0 { onward.node == home.node } else { onward.idle != walk.idle }
            };
            let Some((onward, way)) = self.walk((walk, 0), usize::MAX, is_over, may)? else {
                return Ok(steps);
            };
            walk = onward;
            steps.extend(way);
            if walk == (Walk { idle: 0, ..home }) {
                return Ok(steps);
            }
        }
    }
}

impl Graph {
    /// Looks for a shortest run that goes round and owes the same thing throughout, everybody acting who is awake
    /// throughout.
    pub(super) fn look_for_rounds(
        &self,
        shortest: &mut ShortestRound,
        awake: &mut dyn FnMut(usize) -> Bits,
        taken: &mut MemoryShare<'_>,
    ) -> Result<(), TooLarge> {
        let all = (0..self.owed.len()).fold(0, |all, node| all | self.owed.at(node));
        for owed in (0..Bits::BITS).map(|bit| 1 << bit).filter(|owed| all & owed != 0) {
            self.look_for_rounds_that_owe(owed, shortest, awake, taken)?;
        }
        Ok(())
    }

    fn look_for_rounds_that_owe(
        &self,
        owed: Bits,
        shortest: &mut ShortestRound,
        awake: &mut dyn FnMut(usize) -> Bits,
        taken: &mut MemoryShare<'_>,
    ) -> Result<(), TooLarge> {
        let part = self.components(owed, taken)?;
        let mut components: FxHashMap<u32, Component> = FxHashMap::default();
        // To which a step leads from a node that was met no earlier: a run that goes round may as well begin to do so
        // in the first of its nodes.
        let mut is_first = vec![false; part.len()];
        let inside = || (0..self.owed.len()).filter(|&node| part[node] != NONE);
        for node in inside() {
            for arc in self.arcs(node).filter(|arc| part[arc.to as usize] == part[node]) {
                let new = Component { acting: 0, awake: Bits::MAX };
                components.entry(part[node]).or_insert(new).acting |= arc.acting;
                is_first[arc.to as usize] |= arc.to as usize <= node;
            }
        }
        let mut awake_in = vec![0; part.len()];
        for node in inside() {
            if let Some(component) = components.get_mut(&part[node]) {
                awake_in[node] = awake(node);
                component.awake &= awake_in[node];
            }
        }
        components.retain(|_, component| component.is_fair());
        let parts = Parts { graph: self, part, awake: awake_in };
        let before = taken.held + parts.bytes();
        let mut fits = |walks: usize| {
            if taken.reaches(before + (walks * WALK) as u64) { Ok(true) } else { Err(TooLarge) }
        };
        for (node, depth) in self.depths().take(self.owed.len()) {
            if depth + 1 >= shortest.fewer_than {
                break;
            }
            if !is_first[node] || !components.contains_key(&parts.part[node]) {
                continue;
            }
            let home = Walk { node: node as u32, idle: parts.awake[node] };
            if shortest.fewer_than == usize::MAX {
                let steps = parts.short_round(home, &mut fits)?;
                shortest.take(node, depth, steps);
            }
            let is_over = |walk| walk == Walk { idle: 0, ..home };
            let mut may = |walks| {
                shortest.walks = shortest.walks.saturating_sub(1);
                Ok(shortest.walks > 0 && fits(walks)?)
            };
            if let Some((_, steps)) =
                parts.walk((home, node), shortest.fewer_than - depth, is_over, &mut may)?
            {
                shortest.take(node, depth, steps);
            }
        }
        Ok(())
    }

    /// The strongly connected component of each node in which `owed` is owed, among such nodes, by a number; [`NONE`]
    /// for the other nodes.
    pub(super) fn components(&self, owed: Bits, taken: &mut MemoryShare<'_>) -> Result<Vec<u32>, TooLarge> {
        let is_inside = |node: usize| node < self.owed.len() && self.owed.at(node) & owed != 0;
        let before = taken.held + (self.len() * size_of::<u32>()) as u64;
        let mut fits = |path: &Vec<Visit>, open: &Vec<u32>| {
            let bytes = path.capacity() * size_of::<Visit>() + open.capacity() * size_of::<u32>();
            taken.reaches(before + bytes as u64)
        };
        let (mut path, mut open) = (Vec::new(), Vec::new());
        if !fits(&path, &open) {
            return Err(TooLarge);
        }
        // Of a node on the way or left open: the place in the order of the earliest one that it gets back to. Of a node
        // that is done with: its component, whose numbers come down from above.
        let mut part = vec![NONE; self.len()];
        let (mut order, mut component) = (1, u32::MAX);
        for root in (0..self.len()).filter(|&node| is_inside(node)) {
            if part[root] != NONE {
                continue;
            }
            part[root] = order;
            path.push(Visit { node: root as u32, next: 0, order });
            order += 1;
            while let Some(visit) = path.last_mut() {
                let node = visit.node as usize;
                if let Some(arc) = self.arc(node, visit.next) {
                    visit.next += 1;
                    let to = arc.to as usize;
                    if !is_inside(to) {
                        continue;
                    }
                    if part[to] == NONE {
                        part[to] = order;
                        if path.len() == path.capacity() {
                            path.reserve(1);
                            if !fits(&path, &open) {
                                return Err(TooLarge);
                            }
                        }
                        path.push(Visit { node: to as u32, next: 0, order });
                        order += 1;
                    } else {
                        part[node] = part[node].min(part[to]);
                    }
                    continue;
                }
                if part[node] == visit.order {
                    order -= 1;
                    while let Some(member) = open.pop_if(|&mut member| part[member as usize] >= part[node]) {
                        part[member as usize] = component;
                        order -= 1;
                    }
                    part[node] = component;
                    component -= 1;
                } else {
                    open.push(node as u32);
                }
                path.pop();
                if let Some(before) = path.last() {
                    let before = before.node as usize;
                    part[before] = part[before].min(part[node]);
                }
            }
        }
        Ok(part)
    }
}

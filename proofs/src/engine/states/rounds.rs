//! Runs that go round: among the states that owe the same thing throughout, the strongly connected components (Tarjan
//! 1972, with the memory of Pearce 2016) in which everybody acts who is awake throughout.

use std::collections::VecDeque;
use std::collections::hash_map::Entry;

use rustc_hash::FxHashMap;

use super::Bits;
use super::graph::{Arc, Graph};
use super::limits::MemoryShare;

/// In place of a component of a node that owes nothing.
pub(super) const NONE: u32 = 0;

/// The search would take more memory than it may.
pub(super) struct TooLarge;

/// A way back to a state: its node, and the numbers of its steps, each among those that are bound to be made.
pub(super) type Round = (usize, Vec<u32>);

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

impl Graph {
    /// The first node from which a run can go round and owe the same thing throughout, all acting who are awake
    /// throughout; and such a round.
    pub(super) fn first_round(
        &self,
        awake: &mut dyn FnMut(usize) -> Bits,
        taken: &mut MemoryShare<'_>,
    ) -> Result<Option<Round>, TooLarge> {
        let all = (0..self.len()).fold(0, |all, node| all | self.owed.at(node));
        let mut first: Option<Round> = None;
        for owed in (0..Bits::BITS).map(|bit| 1 << bit).filter(|owed| all & owed != 0) {
            if let Some(round) = self.round(owed, awake, taken)?
                && first.as_ref().is_none_or(|first| round.0 < first.0)
            {
                first = Some(round);
            }
        }
        Ok(first)
    }

    /// The first node from which a run can go round in which `owed` is owed and all act who are awake throughout; and
    /// such a round.
    fn round(
        &self,
        owed: Bits,
        awake: &mut dyn FnMut(usize) -> Bits,
        taken: &mut MemoryShare<'_>,
    ) -> Result<Option<Round>, TooLarge> {
        let part = self.components(owed, taken)?;
        let mut components: FxHashMap<u32, Component> = FxHashMap::default();
        let inside = || (0..self.len()).filter(|&node| part[node] != NONE);
        for node in inside() {
            for arc in self.arcs(node).filter(|arc| part[arc.to as usize] == part[node]) {
                let new = Component { acting: 0, awake: Bits::MAX };
                components.entry(part[node]).or_insert(new).acting |= arc.acting;
            }
        }
        for node in inside() {
            if let Some(component) = components.get_mut(&part[node]) {
                component.awake &= awake(node);
            }
        }
        let fair = inside().find_map(|node| {
            let component = components.get(&part[node]).filter(|component| component.is_fair())?;
            Some((node, component.awake))
        });
        Ok(fair.map(|(first, due)| (first, self.way_round(&part, (first, due), awake))))
    }

    /// A way from `home` round to it within its part in which all of `due` act: a shortest one, and for each whom it
    /// leaves out a way on to the nearest step of theirs and home. Whoever is not due and has been awake all the way
    /// without acting gets a way on, too, to a step of theirs or to a state in which they are not awake.
    fn way_round(
        &self,
        part: &[u32],
        (home, due): (usize, Bits),
        awake: &mut dyn FnMut(usize) -> Bits,
    ) -> Vec<u32> {
        let (mut steps, mut node, mut left, mut idle) = (Vec::new(), home, due, awake(home));
        loop {
            let onward = if !steps.is_empty() && left != 0 {
                self.way_within(part, node, |arc| arc.acting & left != 0)
            } else if !steps.is_empty() && node == home {
                self.way_within(part, node, |arc| (arc.acting | !awake(arc.to as usize)) & idle != 0)
            } else {
                self.way_within(part, node, |arc| arc.to as usize == home)
            };
            for &number in &onward {
                if let Some(arc) = self.arc(node, number) {
                    (node, left) = (arc.to as usize, left & !arc.acting);
                    idle &= !arc.acting & awake(node);
                }
            }
            let is_over = onward.is_empty() || node == home && left == 0 && idle == 0;
            steps.extend(onward);
            if is_over {
                return steps;
            }
        }
    }

    /// A shortest way from `start` within its part, up to the first step that `is_last`.
    fn way_within(&self, part: &[u32], start: usize, mut is_last: impl FnMut(Arc) -> bool) -> Vec<u32> {
        let mut before = FxHashMap::default();
        let mut ahead = VecDeque::from([start]);
        while let Some(node) = ahead.pop_front() {
            for (number, arc) in (0..).zip(self.arcs(node)) {
                let to = arc.to as usize;
                if part[to] != part[start] {
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

    /// The strongly connected component of each node in which `owed` is owed, among such nodes, by a number; [`NONE`]
    /// for the other nodes.
    pub(super) fn components(&self, owed: Bits, taken: &mut MemoryShare<'_>) -> Result<Vec<u32>, TooLarge> {
        let is_inside = |node: usize| self.owed.at(node) & owed != 0;
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

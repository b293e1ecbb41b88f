//! Runs that go round: among the states that owe the same thing throughout, the strongly connected components (Tarjan
//! 1972) in which everybody acts who is awake throughout.

use std::collections::VecDeque;
use std::collections::hash_map::Entry;

use rustc_hash::FxHashMap;

use super::Bits;
use super::graph::{Arc, Graph};

/// In place of a number of a node.
const NONE: u32 = u32::MAX;

impl Graph {
    /// The first node from which a run can go round and owe the same thing throughout, all acting who are awake
    /// throughout; and the numbers of the steps of such a round.
    pub(super) fn first_round(&self) -> Option<(usize, Vec<u32>)> {
        let all = self.nodes.iter().fold(0, |all, node| all | node.owed);
        let each = (0..Bits::BITS).map(|bit| 1 << bit).filter(|owed| all & owed != 0);
        each.filter_map(|owed| self.round(owed)).min_by_key(|&(node, _)| node)
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

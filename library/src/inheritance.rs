//! Priority inheritance with backtracking, one step of it: PIBT makes such steps, and LaCAM tries what they come to
//! first. A robot takes the cell nearest its goal; who stands there inherits the priority, and plans next, but not into
//! the cell of the robot that pushes it; if it can go nowhere, the pushing robot tries its next cell.

use crate::prelude::*;

/// The conditions of the rule.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) struct Pibt {
    /// A robot tries its next cell if the one that it pushes can go nowhere.
    pub(crate) backtracks: bool,
    /// A robot that is pushed does not go to where the pushing one is.
    pub(crate) has_no_swap: bool,
    /// Robots at their goals come last.
    pub(crate) rotates: bool,
}

pub(crate) const PIBT: Pibt = Pibt { backtracks: true, has_no_swap: true, rotates: true };

/// A step under way: where robots are and go, and to where they wish.
pub(crate) struct Plan<'a> {
    pub(crate) rule: Pibt,
    pub(crate) graph: &'a Graph,
    pub(crate) now: &'a [u8],
    pub(crate) goals: &'a [u8],
    pub(crate) next: Vec<Option<u8>>,
}

impl Plan<'_> {
    /// Plans for a robot, and for those that it pushes. Whether it finds a cell.
    pub(crate) fn plan(&mut self, robot: usize) -> bool {
        let (here, goal) = (self.now[robot], self.goals[robot]);
        let mut wishes = [self.graph.beside(here), &[here]].concat();
        wishes.sort_by_key(|&cell| (self.graph.steps(cell, goal), self.now.contains(&cell), cell));
        for cell in wishes {
            let comes = |one: usize| self.now[one] == cell && self.next[one] == Some(here) && one != robot;
            let is_swap = self.rule.has_no_swap && (0..self.now.len()).any(comes);
            if self.next.contains(&Some(cell)) || is_swap {
                continue;
            }
            let other = (0..self.now.len()).find(|&one| self.now[one] == cell && one != robot);
            let pushed = other.filter(|&other| self.next[other].is_none());
            self.next[robot] = Some(cell);
            if pushed.is_none_or(|other| self.plan(other)) {
                return true;
            }
            if !self.rule.backtracks {
                break;
            }
        }
        self.next[robot] = Some(here);
        false
    }
}

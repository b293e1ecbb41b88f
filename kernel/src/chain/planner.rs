//! A plan in the making: what is planned so far, what it has cost, and what a robot can do next. The descent and the
//! [`Choices`](super::choices::Choices) both work on it.

use core::ops::ControlFlow;

use super::rule::{Budget, Condition, Move, Role, Rule};
use crate::ground::{Avoid, Cell, Edge, EdgeMark, Grid, Step, Steps};

/// The candidates of followers that a plan has looked at, and may look at.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) struct Looks {
    pub(super) used: u32,
    most: u32,
    /// Whether more were wanted than there are.
    pub(super) is_over: bool,
}

impl Looks {
    /// None so far, for a plan of `robots`.
    pub(super) const fn new(budget: Budget, robots: usize) -> Self {
        let most = match budget {
            Budget::Unlimited => u32::MAX,
            // At most 256 robots: the product fits.
            Budget::LooksPerRobot(looks) => looks as u32 * robots as u32,
        };
        Self { used: 0, most, is_over: false }
    }

    /// Looks at `candidates` more; if they are too many, at none of them, nor of any later ones.
    pub(super) const fn take(&mut self, candidates: u32) {
        if self.is_over || candidates > self.most - self.used {
            self.is_over = true;
        } else {
            self.used += candidates;
        }
    }

    /// Looks at `candidates` more, one by one, as far as there are looks left.
    pub(super) const fn take_each(&mut self, candidates: u32) {
        let left = self.most - self.used;
        if candidates > left {
            self.used += left;
            self.is_over = true;
        } else if !self.is_over {
            self.used += candidates;
        }
    }
}

/// The making of one plan.
pub(super) struct Planner<'a, G, const ROBOTS: usize> {
    pub(super) rule: &'a Rule,
    pub(super) grid: &'a mut G,
    /// P_1 … P_N.
    pub(super) team: &'a [Cell],
    /// The steps planned so far, from the leader backwards.
    pub(super) steps: [Step; ROBOTS],
    pub(super) looks: Looks,
}

impl<'a, G: Grid, const ROBOTS: usize> Planner<'a, G, ROBOTS> {
    /// A planner for the robots in `team`, base first, at least two and at most `ROBOTS`.
    pub(super) fn new(rule: &'a Rule, grid: &'a mut G, team: &'a [Cell], looks: Looks) -> Self {
        Self { rule, grid, team, steps: [Step::Stay; ROBOTS], looks }
    }

    /// The steps that the conditions on a follower alone admit.
    pub(super) fn candidates(&self, robot: usize) -> Steps {
        let (at, behind) = (self.team[robot], self.team[robot - 1]);
        let free = Steps::ALL.minus(self.grid.sides(EdgeMark::Wall, at));
        self.rule.may_enter(self.grid, Role::Follower, at, free.and(self.rule.steps_behind(at, behind)))
    }

    /// The first of the steps that `fit` a follower, in the order of the paper: staying, if it is in P_high; then
    /// P_high; then the nearest to the frontier; then in direction order. Distances are only looked at where they
    /// decide. Second, how many steps have been looked at for it, whether they fit or not.
    pub(super) fn preferred(&mut self, at: Cell, ahead: Move, fit: Steps) -> (Option<Step>, u32) {
        let high = self.rule.high_steps(at, ahead);
        let best = fit.and(high);
        if best.has(Step::Stay) {
            return (Some(Step::Stay), 1);
        }
        let (best, looks) = if best.is_empty() { (fit, Steps::ALL.len()) } else { (best, high.len()) };
        let mut nearest = best;
        if best.len() > 1 {
            self.grid.approach(at, best, Avoid::Walls, |first| {
                nearest = first;
                ControlFlow::Break(())
            });
        }
        (nearest.iter().next(), looks)
    }

    pub(super) fn planned(&self, robot: usize) -> Move {
        self.as_move(robot, self.steps[robot])
    }

    pub(super) fn as_move(&self, robot: usize, step: Step) -> Move {
        let from = self.team[robot];
        let known_open = match step {
            // Of no other condition it matters.
            Step::Cross(side) if self.rule.has(Condition::UnsureAhead) => {
                self.grid.edge_has(EdgeMark::Open, Edge::new(from, side))
            }
            Step::Cross(_) | Step::Stay => false,
        };
        Move { from, step, known_open }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ten() -> Looks {
        Looks::new(Budget::LooksPerRobot(5), 2)
    }

    #[test]
    fn a_budget_is_over_as_soon_as_more_is_wanted_than_there_is() {
        let mut looks = ten();
        for (candidates, used, is_over) in
            [(4, 4, false), (6, 10, false), (0, 10, false), (1, 10, true), (0, 10, true)]
        {
            looks.take(candidates);
            assert_eq!((looks.used, looks.is_over), (used, is_over));
        }
        let mut looks = ten();
        for (candidates, used, is_over) in
            [(3, 3, false), (7, 10, false), (0, 10, false), (1, 10, true), (0, 10, true)]
        {
            looks.take_each(candidates);
            assert_eq!((looks.used, looks.is_over), (used, is_over));
        }
        let mut unlimited = Looks::new(Budget::Unlimited, 2);
        unlimited.take(u32::MAX);
        assert_eq!((unlimited.used, unlimited.is_over), (u32::MAX, false));
    }

    #[test]
    fn of_too_many_candidates_none_is_looked_at_or_each_as_far_as_there_are_looks() {
        let (mut at_once, mut each) = (ten(), ten());
        at_once.take(3);
        each.take_each(3);
        at_once.take(8);
        each.take_each(8);
        assert_eq!((at_once.used, at_once.is_over), (3, true));
        assert_eq!((each.used, each.is_over), (10, true));
        // Nor is any later one.
        at_once.take(1);
        assert_eq!(at_once.used, 3);
        at_once.take_each(7);
        assert_eq!((at_once.used, at_once.is_over), (3, true));
    }
}

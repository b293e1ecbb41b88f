//! A plan in the making: what is planned so far, what it has cost, and what a robot can do next. The descent and the
//! [`Choices`](super::choices::Choices) both work on it.

use super::rule::{Budget, Move, Role, Rule};
use crate::ground::{Avoid, Cell, CellMark, Edge, EdgeMark, Grid, Step, Steps};

/// The candidates of followers that a plan has looked at, and may look at.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) struct Looks {
    used: u32,
    most: u32,
    /// Whether more were wanted than there are.
    is_over: bool,
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

    /// Looks at `candidates` more; false if they are too many, then and from then on.
    pub(super) const fn take(&mut self, candidates: u32) -> bool {
        if self.is_over || candidates > self.most - self.used {
            self.is_over = true;
        } else {
            self.used += candidates;
        }
        !self.is_over
    }

    pub(super) const fn used(self) -> u32 {
        self.used
    }

    pub(super) const fn is_over(self) -> bool {
        self.is_over
    }
}

/// The making of one plan.
pub(super) struct Planner<'a, G, const ROBOTS: usize> {
    pub(super) rule: &'a Rule,
    pub(super) grid: &'a mut G,
    /// P_1 … P_N.
    pub(super) team: &'a [Cell],
    /// What is planned so far, from the leader backwards.
    pub(super) steps: [Step; ROBOTS],
    pub(super) looks: Looks,
}

impl<'a, G: Grid, const ROBOTS: usize> Planner<'a, G, ROBOTS> {
    /// A planner for the robots in `team`, base first, at least two and at most `ROBOTS`.
    pub(super) fn new(rule: &'a Rule, grid: &'a mut G, team: &'a [Cell], looks: Looks) -> Self {
        Self { rule, grid, team, steps: [Step::Stay; ROBOTS], looks }
    }

    /// Whether the conditions on a follower alone admit `step`.
    pub(super) fn is_candidate(&self, robot: usize, step: Step) -> bool {
        let (at, behind) = (self.team[robot], self.team[robot - 1]);
        !self.meets_wall(at, step)
            && self.rule.admits_behind(at.after(step), behind)
            && self.may_enter(Role::Follower, at, step)
    }

    /// The first of a follower's steps that fit, in the order of the paper: staying, if it is in P_high; then
    /// P_high; then the nearest to the frontier; then in direction order. Steps and distances are only looked at
    /// where they decide.
    pub(super) fn preferred(
        &mut self,
        robot: usize,
        ahead: Move,
        mut fits: impl FnMut(&mut Self, Step) -> bool,
    ) -> Option<Step> {
        let at = self.team[robot];
        let high = Steps::ALL.filter(|step| self.rule.is_high(at.after(step), ahead));
        if high.has(Step::Stay) && fits(self, Step::Stay) {
            return Some(Step::Stay);
        }
        let mut best = high.without(Step::Stay).filter(|step| fits(self, step));
        if best.is_empty() {
            best = Steps::ALL.minus(high).filter(|step| fits(self, step));
        }
        if best.len() <= 1 {
            return best.iter().next();
        }
        let distances = self.grid.distances(at, best, Avoid::Walls);
        best.iter().min_by_key(|&step| distances[step.place()].unwrap_or(u32::MAX))
    }

    pub(super) fn may_enter(&self, role: Role, at: Cell, step: Step) -> bool {
        let occupants =
            if step != Step::Stay && self.grid.has(CellMark::Full, at.after(step)) { 2 } else { 0 };
        self.rule.admits_entry(role, occupants)
    }

    fn meets_wall(&self, at: Cell, step: Step) -> bool {
        match step {
            Step::Cross(side) => self.grid.edge_has(EdgeMark::Wall, Edge::new(at, side)),
            Step::Stay => false,
        }
    }

    pub(super) fn base(&self) -> Cell {
        self.team[0]
    }

    pub(super) fn planned(&self, robot: usize) -> Move {
        self.as_move(robot, self.steps[robot])
    }

    pub(super) fn as_move(&self, robot: usize, step: Step) -> Move {
        let from = self.team[robot];
        let known_open = match step {
            Step::Cross(side) => self.grid.edge_has(EdgeMark::Open, Edge::new(from, side)),
            Step::Stay => false,
        };
        Move { from, step, known_open }
    }
}

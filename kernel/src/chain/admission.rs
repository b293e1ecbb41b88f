//! Certified plans: the admission relation of a whole team move, decided where a plan is returned (CHAIN-4, CHAIN-5),
//! in O(N), or O(N²) where exchanges are forbidden. [`Chain::plan`](super::Chain::plan) returns nothing else, whoever
//! made the plan. So the lemmas about the relation, CHAIN-1, CHAIN-2 and CHAIN-3, speak of every run of every planner.

use super::plan::{mark_occupied, unmark_occupied};
use super::rule::{Condition, Move, Role, Rule};
use crate::ground::{Cell, CellMark, Edge, EdgeMark, Grid, Step, Steps};

impl Rule {
    /// Whether the conditions of this rule admit the `steps` of the robots in `team`, both base first, all at once, if
    /// the team knows what `grid` knows: the base stays, no robot crosses a known wall, every robot is where the rule
    /// wants it behind and ahead of its neighbours, enters no full cell, and has a planned cell of its own. The grid is
    /// left as it was.
    pub fn admits_plan(&self, grid: &mut impl Grid, team: &[Cell], steps: &[Step]) -> bool {
        if team.is_empty() {
            return steps.is_empty();
        }
        if team.len() != steps.len() || steps[0] != Step::Stay {
            return false;
        }
        let is_distinct = !self.has(Condition::Distinct) || are_distinct(grid, team, steps);
        let is_apart = is_distinct && self.keeps_sides(team, steps);
        is_apart && self.admits_pairs(grid, team, steps) && self.admits_entries(grid, team, steps)
    }

    /// The conditions on each robot and its neighbours.
    fn admits_pairs(&self, grid: &impl Grid, team: &[Cell], steps: &[Step]) -> bool {
        let mut behind = Move::stay(team[0]);
        (1..team.len()).all(|robot| {
            let (from, step) = (team[robot], steps[robot]);
            let crosses =
                |mark| matches!(step, Step::Cross(side) if grid.edge_has(mark, Edge::new(from, side)));
            let own = Move { from, step, known_open: crosses(EdgeMark::Open) };
            // The leader may always fall back on the null move.
            let is_null = robot + 1 == team.len() && step == Step::Stay;
            let is_covered = is_null || self.admits_behind(own.to(), behind.from);
            let admits = !crosses(EdgeMark::Wall) && is_covered && self.admits_ahead(behind, own);
            behind = own;
            admits
        })
    }

    /// Whether no two robots in `team`, base first, exchange their cells by these `steps`, where this is forbidden.
    pub(super) fn keeps_sides(&self, team: &[Cell], steps: &[Step]) -> bool {
        let moves = |robot: usize| (team[robot], team[robot].after(steps[robot]));
        let is_exchanged = |robot: usize| {
            let (from, to) = moves(robot);
            from != to && ![from, to].contains(&team[0]) && (1..robot).any(|other| moves(other) == (to, from))
        };
        !self.has(Condition::NoExchange) || !(2..team.len()).any(is_exchanged)
    }

    /// The conditions on cells that two others occupy.
    fn admits_entries(&self, grid: &mut impl Grid, team: &[Cell], steps: &[Step]) -> bool {
        if !self.counts_occupants() {
            return true;
        }
        mark_occupied(grid, team);
        let admits = (1..team.len()).all(|robot| {
            let role = if robot + 1 == team.len() { Role::Leader } else { Role::Follower };
            let to = team[robot].after(steps[robot]);
            steps[robot] == Step::Stay || self.admits_entry(role, 2) || !grid.has(CellMark::Full, to)
        });
        unmark_occupied(grid, team);
        admits
    }

    /// Whether it matters how many robots are in a cell.
    pub(super) fn counts_occupants(&self) -> bool {
        [Role::Leader, Role::Follower].iter().any(|&role| !self.admits_entry(role, 2))
    }

    /// Those of the `steps` that do not lead into a cell where there are too many to enter it.
    pub(super) fn may_enter(&self, grid: &impl Grid, role: Role, at: Cell, steps: Steps) -> Steps {
        if self.admits_entry(role, 2) {
            return steps;
        }
        steps.minus(grid.steps_to(CellMark::Full, at, steps.without(Step::Stay)))
    }
}

/// Whether no two of the planned cells are the same, the base excepted; of steps that stay, whether no two robots meet.
pub(super) fn are_distinct(grid: &mut impl Grid, team: &[Cell], steps: &[Step]) -> bool {
    let planned = || team.iter().zip(steps).map(|(cell, &step)| cell.after(step));
    let outside = || planned().skip(1).filter(|&cell| cell != team[0]);
    let are_distinct = outside().all(|cell| {
        let is_free = !grid.has(CellMark::Planned, cell);
        grid.put(CellMark::Planned, cell);
        is_free
    });
    outside().for_each(|cell| grid.take(CellMark::Planned, cell));
    are_distinct
}

//! The planning of one team move: the leader's priority list, and for each of its candidates the search for
//! followers (paper 000, III.D, Algorithm 1, equation (2)). Mostly every follower finds a step at once, in one
//! descent from the leader to the base; where one does not, [`Choices`] find the plan that the paper's recursion
//! would return, without its cost (clauses CHAIN-4, CHAIN-11 and CHAIN-12).

use super::choices::Choices;
use super::planner::{Looks, Planner};
use super::rule::{Condition, Move, Role};
use crate::ground::{Avoid, Cell, CellMark, Edge, EdgeMark, Grid, Side, Step, Steps};

/// Whether a team move seeks new cells or takes an earlier move back.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "kebab-case"))]
pub enum Kind {
    /// A planned exploration move.
    Advance,
    /// A backtrack: every robot makes its last open move in reverse, over edges already crossed.
    Backtrack,
}

/// What every robot of a team is to do in one team move.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Plan<const ROBOTS: usize> {
    /// Why.
    pub kind: Kind,
    pub(super) steps: [Step; ROBOTS],
    pub(super) robots: usize,
    /// The log entry that a further backtrack would take back, after this move.
    pub(super) last_open: Option<u32>,
}

impl<const ROBOTS: usize> Plan<ROBOTS> {
    /// The steps of R_1, the base, to R_N, the leader.
    pub fn steps(&self) -> &[Step] {
        &self.steps[..self.robots]
    }
}

/// Marks the cells other than the base in which robots of `team` are, [`CellMark::Occupied`] with one and
/// [`CellMark::Full`] with more; whether three or more are in one.
pub(super) fn mark_occupied(grid: &mut impl Grid, team: impl Iterator<Item = Cell>, base: Cell) -> bool {
    let mut is_crowded = false;
    for cell in team.filter(|&cell| cell != base) {
        is_crowded |= grid.has(CellMark::Full, cell);
        let mark = if grid.has(CellMark::Occupied, cell) { CellMark::Full } else { CellMark::Occupied };
        grid.put(mark, cell);
    }
    is_crowded
}

/// Takes the marks of [`mark_occupied`] off again.
pub(super) fn unmark_occupied(grid: &mut impl Grid, team: impl Iterator<Item = Cell>) {
    for cell in team {
        grid.take(CellMark::Occupied, cell);
        grid.take(CellMark::Full, cell);
    }
}

impl<G: Grid, const ROBOTS: usize> Planner<'_, G, ROBOTS> {
    /// Makes the plan, and says what is looked at by then. `None` if the leader has no candidate that the others can
    /// follow, or the budget ends before one is found. Refused candidates of the leader become virtual obstacles.
    pub(super) fn make(mut self) -> (Option<[Step; ROBOTS]>, Looks) {
        mark_occupied(self.grid, self.team.iter().copied(), self.base());
        let found = self.lead();
        unmark_occupied(self.grid, self.team.iter().copied());
        (found.then_some(self.steps), self.looks)
    }

    /// Algorithm 2: the first candidate of the leader that can be completed to a team move.
    fn lead(&mut self) -> bool {
        let leader = self.team.len() - 1;
        let (at, behind) = (self.team[leader], self.team[leader - 1]);
        let (mut list, count) = self.leader_list();
        for candidate in &mut list[..count] {
            let (side, step) = *candidate;
            // A move out of E_C of the robot behind is replaced, in its place, by the null move.
            if !self.rule.admits_behind(at.after(step), behind) {
                self.grid.put_edge(EdgeMark::Virtual, Edge::new(at, side));
                *candidate = (side, Step::Stay);
            }
        }
        let leads = list[..count].iter().fold(Steps::NONE, |steps, &(_, step)| steps.with(step));
        let mut choices = None;
        for &(side, step) in &list[..count] {
            if !self.looks.is_over() && self.may_enter(Role::Leader, at, step) {
                self.steps[leader] = step;
                if choices.is_none() && self.descend() {
                    return true;
                }
                if choices.get_or_insert_with(|| Choices::new(self, leads)).follow(self, step) {
                    return true;
                }
            }
            if self.rule.has(Condition::RefusedIsVirtual) {
                self.grid.put_edge(EdgeMark::Virtual, Edge::new(at, side));
            }
        }
        false
    }

    /// PLN_N: the sides that the leader may cross, nearest to the frontier first, then away from the base
    /// ((P′−P)·P), then in direction order.
    fn leader_list(&mut self) -> ([(Side, Step); 4], usize) {
        let at = self.team[self.team.len() - 1];
        let base = self.base();
        let outward = |side| match side {
            Side::East => i32::from(at.x) - i32::from(base.x),
            Side::South => i32::from(at.y) - i32::from(base.y),
            Side::West => i32::from(base.x) - i32::from(at.x),
            Side::North => i32::from(base.y) - i32::from(at.y),
        };
        let is_shut = |side| {
            let edge = Edge::new(at, side);
            self.grid.edge_has(EdgeMark::Wall, edge) || self.grid.edge_has(EdgeMark::Virtual, edge)
        };
        let sides = Side::ALL.into_iter().filter(|&side| !is_shut(side));
        let steps = sides.fold(Steps::NONE, |steps, side| steps.with(Step::Cross(side)));
        let distances = self.grid.distances(at, steps, Avoid::WallsAndVirtual);
        let mut keyed = [((0, 0), Side::East); 4];
        let mut count = 0;
        for (side, distance) in Side::ALL.into_iter().zip(distances) {
            if let Some(distance) = distance {
                keyed[count] = ((distance, -outward(side)), side);
                count += 1;
            }
        }
        keyed[..count].sort_unstable();
        (keyed.map(|(_, side)| (side, Step::Cross(side))), count)
    }

    /// Algorithm 1 as long as every follower finds a step at once: true if all did, and the chain closes.
    fn descend(&mut self) -> bool {
        let leader = self.team.len() - 1;
        let mut planned = leader;
        self.claim(leader);
        let mut closes = false;
        while let Some(robot) = planned.checked_sub(1) {
            let ahead = self.planned(planned);
            if robot == 0 {
                closes = self.rule.admits_ahead(Move::stay(self.base()), ahead);
                break;
            }
            let at = self.team[robot];
            let distinct = self.rule.has(Condition::Distinct);
            let fits = |planner: &mut Self, step| {
                planner.looks.take(1)
                    && planner.is_candidate(robot, step)
                    && planner.rule.admits_ahead(planner.as_move(robot, step), ahead)
                    && !(distinct && planner.grid.has(CellMark::Planned, at.after(step)))
            };
            let Some(step) = self.preferred(robot, ahead, fits) else { break };
            self.steps[robot] = step;
            self.claim(robot);
            planned = robot;
        }
        for robot in planned..=leader {
            self.grid.take(CellMark::Planned, self.planned(robot).to());
        }
        closes && !self.looks.is_over()
    }

    /// Takes the cell that `robot` is to be in.
    fn claim(&mut self, robot: usize) {
        let to = self.planned(robot).to();
        if to != self.base() {
            self.grid.put(CellMark::Planned, to);
        }
    }
}

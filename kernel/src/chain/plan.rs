//! The planning of one team move: the leader's priority list, and for each of its candidates the search for
//! followers [Kovács 2011, III.D, Algorithm 1, equation (2)]. Mostly every follower finds a step at once, in one
//! descent from the leader to the base; where one does not, [`Choices`] find the plan that the paper's recursion
//! would return, without its cost (clauses CHAIN-4, CHAIN-11 and CHAIN-12).

use core::ops::ControlFlow;

use super::choices::Choices;
use super::planner::{Looks, Planner};
use super::rule::{Condition, Move, Role};
use crate::ground::{Avoid, Cell, CellMark, Edge, EdgeMark, Grid, Side, Step, Steps};

/// Whether a team move seeks new cells or takes an earlier move back.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "kebab-case"))]
pub enum Kind {
    /// A planned exploration move.
    Advance,
    /// A backtrack: every robot makes its last open move in reverse, over edges already crossed.
    Backtrack,
}

/// A step for every robot of a team, for one team move.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Plan<const ROBOTS: usize> {
    /// Why.
    pub kind: Kind,
    pub(super) steps: [Step; ROBOTS],
    pub(super) robots: usize,
    /// The log entry that a further backtrack would take back, after this move.
    pub(super) last_open: Option<u32>,
    /// The robot, counted from 0, that has died before it went; the base, which does not go, if none has.
    pub(super) mute: usize,
}

impl<const ROBOTS: usize> Plan<ROBOTS> {
    /// The steps of R_1, the base, to R_N, the leader.
    pub fn steps(&self) -> &[Step] {
        &self.steps[..self.robots]
    }

    /// This plan where `robot`, numbered from 1, the base, has died and does not go. Nobody hears of it.
    #[must_use]
    pub const fn without(self, robot: usize) -> Self {
        Self { mute: robot.saturating_sub(1), ..self }
    }
}

/// Marks the cells other than the base in which robots of `team`, base first, are, [`CellMark::Occupied`] with one and
/// [`CellMark::Full`] with more; whether three or more are in one.
pub(super) fn mark_occupied(grid: &mut impl Grid, team: &[Cell]) -> bool {
    let mut is_crowded = false;
    for &cell in team.iter().filter(|&&cell| cell != team[0]) {
        is_crowded |= grid.has(CellMark::Full, cell);
        let mark = if grid.has(CellMark::Occupied, cell) { CellMark::Full } else { CellMark::Occupied };
        grid.put(mark, cell);
    }
    is_crowded
}

/// Takes the marks of [`mark_occupied`] off again.
pub(super) fn unmark_occupied(grid: &mut impl Grid, team: &[Cell]) {
    for &cell in team {
        grid.take(CellMark::Occupied, cell);
        grid.take(CellMark::Full, cell);
    }
}

impl<'a, G: Grid, const ROBOTS: usize> Planner<'a, G, ROBOTS> {
    /// Makes the plan, and says what is looked at by then. `None` if the leader has no candidate that the others can
    /// follow, or the budget ends before one is found. Refused candidates of the leader become virtual obstacles.
    pub(super) fn make(self) -> (Option<[Step; ROBOTS]>, Looks) {
        self.among_occupants(Self::lead)
    }

    /// As [`Self::make`], for the candidates of the leader that are unexplored cells beside it, in the same order; none
    /// of them becomes a virtual obstacle.
    pub(super) fn touch(self) -> (Option<[Step; ROBOTS]>, Looks) {
        self.among_occupants(Self::lead_beside)
    }

    /// Plans by `lead`, the cells that are occupied being marked.
    fn among_occupants(mut self, lead: impl Fn(&mut Self) -> bool) -> (Option<[Step; ROBOTS]>, Looks) {
        let counts_occupants = self.rule.counts_occupants();
        if counts_occupants {
            mark_occupied(self.grid, self.team);
        }
        let found = lead(&mut self);
        if counts_occupants {
            unmark_occupied(self.grid, self.team);
        }
        (found.then_some(self.steps), self.looks)
    }

    /// Algorithm 2: the first candidate of the leader that can be completed to a team move.
    fn lead(&mut self) -> bool {
        let leader = self.team.len() - 1;
        let (at, behind) = (self.team[leader], self.team[leader - 1]);
        let shut = self.grid.sides(EdgeMark::Wall, at).or(self.grid.sides(EdgeMark::Virtual, at));
        let steps = Steps::ALL.without(Step::Stay).minus(shut);
        let admitted = self.rule.steps_behind(at, behind);
        // Mostly the team can follow the first candidate. Then the others
        // matter only if a move of them is not admitted.
        let mut has_descended = false;
        if steps.minus(admitted).is_empty() {
            let (first, count) = self.leader_list(at, steps, ControlFlow::Break(()));
            let first = if count == 0 { Steps::NONE } else { Steps::only(Step::Cross(first[0])) };
            if let Some(step) = self.rule.may_enter(self.grid, Role::Leader, at, first).iter().next() {
                self.steps[leader] = step;
                if self.descend() && self.rule.keeps_sides(self.team, &self.steps) {
                    return true;
                }
                has_descended = true;
            }
        }
        let (list, count) = self.leader_list(at, steps, ControlFlow::Continue(()));
        let list = &list[..count];
        // A move out of E_C of the robot behind is replaced, in its place, by the null move.
        let replaced = |side| {
            let step = Step::Cross(side);
            if admitted.has(step) { step } else { Step::Stay }
        };
        let mut leads = Steps::NONE;
        for &side in list {
            let step = replaced(side);
            if step == Step::Stay {
                self.grid.put_edge(EdgeMark::Virtual, Edge::new(at, side));
            }
            leads = leads.with(step);
        }
        let enterable = self.rule.may_enter(self.grid, Role::Leader, at, leads);
        let mut choices = has_descended.then(|| Choices::new(self, leads));
        for &side in list {
            let step = replaced(side);
            if !self.looks.is_over && enterable.has(step) && self.can_follow(step, leads, &mut choices) {
                return true;
            }
            if self.rule.has(Condition::RefusedIsVirtual) {
                self.grid.put_edge(EdgeMark::Virtual, Edge::new(at, side));
            }
        }
        false
    }

    /// The first unexplored cell beside the leader into which it can go, the others following.
    fn lead_beside(&mut self) -> bool {
        let leader = self.team.len() - 1;
        let (at, behind) = (self.team[leader], self.team[leader - 1]);
        let steps = Steps::ALL.without(Step::Stay).minus(self.grid.sides(EdgeMark::Wall, at));
        let steps = steps.minus(self.grid.steps_to(CellMark::Explored, at, steps));
        let steps = steps.and(self.rule.steps_behind(at, behind));
        let leads = self.rule.may_enter(self.grid, Role::Leader, at, steps);
        if leads.is_empty() {
            return false;
        }
        let (list, count) = self.leader_list(at, leads, ControlFlow::Break(()));
        let mut choices = None;
        list[..count].iter().any(|&side| self.can_follow(Step::Cross(side), leads, &mut choices))
    }

    /// Whether the others can follow the leader's `step`, one of its `leads`: by a descent, if there are no `choices`
    /// yet, or by these.
    fn can_follow(&mut self, step: Step, leads: Steps, choices: &mut Option<Choices<'a, ROBOTS>>) -> bool {
        self.steps[self.team.len() - 1] = step;
        let follow = choices.is_none() && self.descend()
            || choices.get_or_insert_with(|| Choices::new(self, leads)).follow(self, step);
        follow && self.rule.keeps_sides(self.team, &self.steps)
    }

    /// PLN_N: the sides that the leader may cross, nearest to the frontier first, then away from the base
    /// ((P′−P)·P), then in direction order. If they are not to be continued, only those nearest to the frontier.
    fn leader_list(&mut self, at: Cell, steps: Steps, farther: ControlFlow<()>) -> ([Side; 4], usize) {
        let base = self.team[0];
        let outward = |side| {
            let (dx, dy) = (i32::from(at.x) - i32::from(base.x), i32::from(at.y) - i32::from(base.y));
            [dx, dy, -dx, -dy][side as usize]
        };
        let mut list = [Side::East; 4];
        let mut count = 0_usize;
        self.grid.approach(at, steps, Avoid::WallsAndVirtual, |nearest| {
            let nearer = count;
            for side in Side::ALL.into_iter().filter(|&side| nearest.has(Step::Cross(side))) {
                // In its place behind those that are as near and lead as far away from the base.
                let mut place = count;
                while place > nearer && outward(list[place - 1]) < outward(side) {
                    list[place] = list[place - 1];
                    place -= 1;
                }
                list[place] = side;
                count += 1;
            }
            farther
        });
        (list, count)
    }

    /// Algorithm 1 as long as every follower finds a step at once: true if all did, and the chain closes.
    fn descend(&mut self) -> bool {
        let leader = self.team.len() - 1;
        let is_distinct = self.rule.has(Condition::Distinct);
        let mut planned = leader;
        self.claim(leader);
        let mut closes = false;
        while let Some(robot) = planned.checked_sub(1) {
            let ahead = self.planned(planned);
            if robot == 0 {
                closes = self.rule.admits_ahead(Move::stay(self.team[0]), ahead);
                break;
            }
            let at = self.team[robot];
            let mut fit = self.candidates(robot).and(self.rule.steps_ahead(at, ahead));
            if is_distinct {
                fit = fit.minus(self.grid.steps_to(CellMark::Planned, at, fit));
            }
            let (step, looks) = self.preferred(at, ahead, fit);
            self.looks.take_each(looks);
            let Some(step) = step.filter(|_| !self.looks.is_over) else { break };
            self.steps[robot] = step;
            planned = robot;
            self.claim(robot);
        }
        if is_distinct {
            for robot in planned..=leader {
                self.grid.take(CellMark::Planned, self.team[robot].after(self.steps[robot]));
            }
        }
        closes
    }

    /// Takes the cell that `robot` is to be in.
    fn claim(&mut self, robot: usize) {
        let to = self.team[robot].after(self.steps[robot]);
        if self.rule.has(Condition::Distinct) && to != self.team[0] {
            self.grid.put(CellMark::Planned, to);
        }
    }
}

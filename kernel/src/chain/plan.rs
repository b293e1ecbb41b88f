//! The planning of one team move: the leader's priority list, and for each of its candidates the search for
//! followers (paper 000, III.D, Algorithm 1, equation (2)). It returns the plan that the paper's recursion
//! returns, without its cost: a dead end is remembered for the whole plan, with the robots it depends on
//! (clauses CHAIN-4 and CHAIN-11).

use super::rule::{Condition, Move, Role, Rule};
use crate::grid::{Avoid, CellMark, EdgeMark, Grid};
use crate::lattice::{Cell, Edge, Side, Step};

/// Whether a team move seeks new cells or takes an earlier move back.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
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

/// A set of steps, one bit each in direction order.
#[derive(Clone, Copy, PartialEq, Eq)]
struct Steps(u8);

impl Steps {
    const NONE: Self = Self(0);

    const fn with(self, step: Step) -> Self {
        Self(self.0 | 1 << place(step))
    }

    const fn without(self, step: Step) -> Self {
        Self(self.0 & !(1 << place(step)))
    }

    const fn has(self, step: Step) -> bool {
        self.0 & (1 << place(step)) != 0
    }

    const fn len(self) -> u32 {
        self.0.count_ones()
    }

    fn iter(self) -> impl Iterator<Item = Step> {
        Step::ALL.into_iter().filter(move |&step| self.has(step))
    }
}

/// A step's place in direction order.
const fn place(step: Step) -> usize {
    match step {
        Step::Cross(side) => side as usize,
        Step::Stay => 4,
    }
}

/// Cells that robots farther ahead had taken, when a follower was refused them.
#[derive(Clone, Copy)]
struct Taken {
    cells: [Cell; Taken::MOST],
    /// How many there are; one more than `MOST` if they were too many to remember.
    count: u8,
}

impl Taken {
    const MOST: usize = KK;
    const NONE: Self = Self { cells: [Cell::new(0, 0); Self::MOST], count: 0 };

    /// The cells, unless they were too many to remember.
    fn cells(&self) -> Option<&[Cell]> {
        self.cells.get(..usize::from(self.count))
    }

    fn insert(&mut self, cell: Cell) {
        let Some(cells) = self.cells() else { return };
        if !cells.contains(&cell) {
            if let Some(free) = self.cells.get_mut(usize::from(self.count)) {
                *free = cell;
            }
            self.count += 1;
        }
    }

    fn unite(&mut self, other: &Self, except: Cell) {
        match other.cells() {
            Some(cells) => cells.iter().filter(|&&cell| cell != except).for_each(|&cell| self.insert(cell)),
            None => self.count = Self::MOST as u8 + 1,
        }
    }
}
const KK: usize = 24;
const SLOTS: usize = 8;

/// The state of one follower in the search.
#[derive(Clone, Copy)]
struct Level {
    /// Candidates not tried yet.
    untried: Steps,
    /// The step it has now.
    step: Step,
    /// The cells that it, or a robot behind it, was refused because they were taken.
    taken: Taken,
    /// Dead ends, by the step of the robot ahead.
    dead: [[Taken; SLOTS]; 5],
    dead_count: [u8; 5],
}

impl Level {
    const IDLE: Self = Self {
        untried: Steps::NONE,
        step: Step::Stay,
        taken: Taken::NONE,
        dead: [[Taken::NONE; SLOTS]; 5],
        dead_count: [0; 5],
    };
}

/// The making of one plan.
pub(super) struct Planner<'a, G, const ROBOTS: usize> {
    rule: &'a Rule,
    grid: &'a mut G,
    /// P_1 … P_N.
    team: &'a [Cell],
    levels: [Level; ROBOTS],
    /// Follower candidates looked at.
    looked_at: u32,
}

impl<'a, G: Grid, const ROBOTS: usize> Planner<'a, G, ROBOTS> {
    /// A planner for the robots in `team`, base first, at least two and at most `ROBOTS`.
    pub(super) fn new(rule: &'a Rule, grid: &'a mut G, team: &'a [Cell]) -> Self {
        Self { rule, grid, team, levels: [Level::IDLE; ROBOTS], looked_at: 0 }
    }

    fn base(&self) -> Cell {
        self.team[0]
    }

    /// Makes the plan, and says how many follower candidates it looked at. `None` if the leader has no
    /// candidate that the others can follow. Refused candidates of the leader become virtual obstacles.
    pub(super) fn make(mut self) -> (Option<[Step; ROBOTS]>, u32) {
        self.mark_occupied();
        let found = self.lead();
        for &cell in self.team {
            self.grid.take(CellMark::Occupied, cell);
            self.grid.take(CellMark::Full, cell);
        }
        if !found {
            return (None, self.looked_at);
        }
        for (level, &cell) in self.levels.iter().zip(self.team) {
            self.grid.take(CellMark::Planned, cell.after(level.step));
        }
        (Some(self.levels.map(|level| level.step)), self.looked_at)
    }

    fn mark_occupied(&mut self) {
        for &cell in self.team {
            if cell == self.base() {
                continue;
            }
            let mark =
                if self.grid.has(CellMark::Occupied, cell) { CellMark::Full } else { CellMark::Occupied };
            self.grid.put(mark, cell);
        }
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
        for &(side, step) in &list[..count] {
            if self.may_enter(Role::Leader, at, step) {
                self.assign(leader, step);
                if self.follow() {
                    return true;
                }
                self.release(leader);
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
        let mut keyed = [((0, 0), Side::East); 4];
        let mut count = 0;
        for side in Side::ALL {
            let edge = Edge::new(at, side);
            if self.grid.edge_has(EdgeMark::Wall, edge) || self.grid.edge_has(EdgeMark::Virtual, edge) {
                continue;
            }
            if let Some(steps) = self.grid.distance(at.beyond(side), Avoid::WallsAndVirtual) {
                keyed[count] = ((steps, -outward(side)), side);
                count += 1;
            }
        }
        keyed[..count].sort_unstable();
        (keyed.map(|(_, side)| (side, Step::Cross(side))), count)
    }

    /// Finds steps for all followers, the leader's being planned: the first that the paper's recursion finds.
    fn follow(&mut self) -> bool {
        let mut robot = self.team.len() - 2;
        self.enter(robot);
        loop {
            if robot == 0 && !self.levels[0].untried.has(Step::Stay) {
                // The base cannot close the chain, whoever took which cell.
                self.give_up(0);
            } else if robot == 0 {
                return true;
            } else if let Some(step) = self.next_candidate(robot) {
                self.levels[robot].untried = self.levels[robot].untried.without(step);
                self.assign(robot, step);
                robot -= 1;
                self.enter(robot);
                continue;
            } else {
                self.give_up(robot);
            }
            robot += 1;
            if robot == self.team.len() - 1 {
                return false;
            }
            self.release(robot);
        }
    }

    /// PLN_i as a set: the steps that the conditions admit for `robot`.
    fn enter(&mut self, robot: usize) {
        self.levels[robot].taken = Taken::NONE;
        self.levels[robot].untried = Steps::NONE;
        let ahead = self.planned(robot + 1);
        if robot == 0 {
            if self.rule.admits_ahead(Move::stay(self.base()), ahead) {
                self.levels[0].untried = Steps::NONE.with(Step::Stay);
            }
            return;
        }
        if let Some(taken) = self.known_dead(robot, self.levels[robot + 1].step) {
            self.levels[robot].taken = taken;
            return;
        }
        let (at, behind) = (self.team[robot], self.team[robot - 1]);
        for step in Step::ALL {
            self.looked_at += 1;
            let own = self.as_move(robot, step);
            if self.meets_wall(at, step)
                || !self.rule.admits_ahead(own, ahead)
                || !self.rule.admits_behind(own.to(), behind)
                || !self.may_enter(Role::Follower, at, step)
            {
                continue;
            }
            if self.rule.has(Condition::Distinct) && self.grid.has(CellMark::Planned, own.to()) {
                self.levels[robot].taken.insert(own.to());
            } else {
                self.levels[robot].untried = self.levels[robot].untried.with(step);
            }
        }
    }

    /// The first untried candidate: staying, if it is in P_high; then P_high; then the nearest to the
    /// frontier; then in direction order. The distance is only asked for where it decides.
    fn next_candidate(&mut self, robot: usize) -> Option<Step> {
        let untried = self.levels[robot].untried;
        let ahead = self.planned(robot + 1);
        let at = self.team[robot];
        let high = untried
            .iter()
            .filter(|&step| self.rule.is_high(at.after(step), ahead))
            .fold(Steps::NONE, Steps::with);
        if high.has(Step::Stay) {
            return Some(Step::Stay);
        }
        let best = if high == Steps::NONE { untried } else { high };
        if best.len() <= 1 {
            return best.iter().next();
        }
        best.iter().min_by_key(|&step| self.grid.distance(at.after(step), Avoid::Walls).unwrap_or(u32::MAX))
    }

    /// Remembers that no step of `robot` is left behind the present step of the robot ahead.
    fn give_up(&mut self, robot: usize) {
        let ahead = self.planned(robot + 1).to();
        let mut taken = Taken::NONE;
        taken.unite(&self.levels[robot].taken, ahead);
        let p = place(self.levels[robot + 1].step);
        if taken.cells().is_some() && self.known_dead(robot, self.levels[robot + 1].step).is_none() {
            let l = &mut self.levels[robot];
            l.dead[p][l.dead_count[p] as usize % SLOTS] = taken;
            l.dead_count[p] = l.dead_count[p].wrapping_add(1);
            if l.dead_count[p] == 0 {
                l.dead_count[p] = SLOTS as u8;
            }
        }
        self.levels[robot + 1].taken.unite(&taken, ahead);
    }

    fn known_dead(&self, robot: usize, ahead: Step) -> Option<Taken> {
        let p = place(ahead);
        let l = &self.levels[robot];
        l.dead[p][..SLOTS.min(l.dead_count[p] as usize)]
            .iter()
            .find(|t| t.cells().is_some_and(|c| c.iter().all(|&c| self.grid.has(CellMark::Planned, c))))
            .copied()
    }

    fn assign(&mut self, robot: usize, step: Step) {
        self.levels[robot].step = step;
        let to = self.team[robot].after(step);
        if to != self.base() {
            self.grid.put(CellMark::Planned, to);
        }
    }

    fn release(&mut self, robot: usize) {
        let to = self.team[robot].after(self.levels[robot].step);
        self.grid.take(CellMark::Planned, to);
    }

    fn may_enter(&self, role: Role, at: Cell, step: Step) -> bool {
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

    fn planned(&self, robot: usize) -> Move {
        self.as_move(robot, self.levels[robot].step)
    }

    fn as_move(&self, robot: usize, step: Step) -> Move {
        let from = self.team[robot];
        let known_open = match step {
            Step::Cross(side) => self.grid.edge_has(EdgeMark::Open, Edge::new(from, side)),
            Step::Stay => false,
        };
        Move { from, step, known_open }
    }
}

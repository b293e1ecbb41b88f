//! The chain as the paper writes it down, without any of the kernel's machinery: growing lists, the plain recursion of
//! Algorithms 1 to 3, a flood fill for every candidate, the history as a list of team moves. It shares no search, flood
//! fill or bookkeeping with the planner, and says the conditions in its own words: of the kernel's [`Rule`] it uses
//! only the names of the conditions and the reading of P_high. What the repair *Unfold* adds is written down here once
//! more, too; a budget it does not know. CHAIN-11 compares the two; the benchmarks measure the one by the other.

use std::collections::VecDeque;

use tautline_kernel::chain::{Condition, High, Kind, Rule};
use tautline_kernel::ground::{Area, Avoid, Cell, Edge, Side, Step};

use super::environment::{in_covered, in_safe};
use super::plain_walk::{Walk, walk};
use super::readings::Reading::{LastMoved, NullLast, OnceExamined, Pathless, Unfollowed};
use super::readings::{Readings, starts};
use super::subject::Subject;

/// A chain on an area of its own.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct PlainChain {
    rule: Rule,
    area: Area,
    cells: Vec<Cell>,
    explored: Vec<bool>,
    east: Vec<Marks>,
    south: Vec<Marks>,
    /// The steps that were really made and not taken back, one for each robot and team move.
    history: Vec<Step>,
    gained: bool,
    /// Whether this epoch began by unfolding the chain.
    unfolds: bool,
    /// Whether it takes nobody for sure to arrive.
    doubts_all: bool,
    floods: Floods,
    readings: Readings,
    /// Of equal candidates the first in this order comes first.
    order: [Step; 5],
}

/// How many flood fills a plan takes.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Floods {
    /// One for each candidate.
    Many,
    /// One for all candidates of the leader, and one for those of the followers.
    Few,
}

/// The marks of an edge, as far as it is known.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
struct Marks {
    wall: bool,
    open: bool,
    virtual_obstacle: bool,
}

/// The team's intended move, base first.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum PlainIntent {
    /// A planned exploration move.
    Advance(Vec<Step>),
    /// The last move that can be, taken back.
    Backtrack(Vec<Step>),
    /// Every cell is explored.
    Explored,
    /// An epoch gained nothing.
    Exhausted,
}

impl PlainIntent {
    /// The steps of a team move, base first; `None` at the end.
    pub fn steps(&self) -> Option<&[Step]> {
        match self {
            Self::Advance(steps) | Self::Backtrack(steps) => Some(steps),
            Self::Explored | Self::Exhausted => None,
        }
    }

    /// Whether it takes a team move back.
    pub fn kind(&self) -> Kind {
        if matches!(self, Self::Backtrack(_)) { Kind::Backtrack } else { Kind::Advance }
    }
}

/// The recursion was stopped: it had looked at too many candidates.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct TooMany;

/// How the distances from candidates are found.
enum Distances {
    /// By a flood fill for each.
    Each(Avoid),
    /// By one for all, which gave these, row by row.
    Known(Vec<Option<u32>>),
}

/// The making of one plan.
struct Recursion<'a> {
    chain: &'a PlainChain,
    distances: &'a Distances,
    /// P′, from the leader backwards; the rest still to come.
    planned: Vec<Option<Step>>,
    looked_at: u64,
    most: u64,
}

impl PlainChain {
    /// `robots`, at least two, base included, in the `base` cell of an `area` of which only the border is known.
    pub fn new(rule: Rule, robots: usize, base: Cell, area: Area) -> Self {
        let cells = area.width() * area.height();
        let mut chain = Self {
            rule,
            area,
            cells: vec![base; robots],
            explored: vec![false; cells],
            east: vec![Marks::default(); cells],
            south: vec![Marks::default(); cells],
            history: Vec::new(),
            gained: true,
            unfolds: false,
            doubts_all: false,
            floods: Floods::Many,
            readings: Readings::of(&[]),
            order: Step::ALL,
        };
        for cell in area.cells() {
            for side in Side::ALL {
                if !area.contains(cell.beyond(side)) {
                    chain.mark(Edge::new(cell, side), |marks| marks.wall = true);
                }
            }
        }
        chain.explore(base);
        chain
    }

    /// A chain as [`Self::new`] makes it, with the rule, the readings and the order of equal candidates of `subject`;
    /// the walk on which it unfolds knows no order. `None` if the area has no room for its start.
    pub fn of(subject: &Subject, robots: usize, base: Cell, area: Area) -> Option<Self> {
        let Subject { rule, readings, order, .. } = *subject;
        let cells = starts(readings, base, robots).collect();
        let mut chain = Self { cells, readings, order, ..Self::new(rule, robots, base, area) };
        for robot in 0..robots {
            let (behind, cell) = (chain.cells[robot.saturating_sub(1)], chain.cells[robot]);
            chain.index(cell)?;
            chain.explore(cell);
            if cell != behind {
                chain.mark(Edge::new(behind, Side::East), |marks| marks.open = true);
            }
        }
        Some(chain)
    }

    /// This chain, wrong in one thing: *UnsureAhead* binds it also behind a robot that is sure to arrive.
    #[must_use]
    pub fn that_doubts_all(self) -> Self {
        Self { doubts_all: true, ..self }
    }

    /// This chain with one flood fill for all candidates of a plan, from the unexplored cells: the same plans in less
    /// time where an area is large and most of it explored.
    #[must_use]
    pub fn that_floods_once(self) -> Self {
        Self { floods: Floods::Few, ..self }
    }

    /// Where the robots are, base first.
    pub fn cells(&self) -> &[Cell] {
        &self.cells
    }

    /// The cells that it may explore.
    pub const fn area(&self) -> Area {
        self.area
    }

    /// Whether `edge` is known to be a wall.
    pub(super) fn has_wall(&self, edge: Edge) -> bool {
        self.marks(edge).wall
    }

    /// Whether a robot has been in `cell`.
    pub(super) fn has_explored(&self, cell: Cell) -> bool {
        self.index(cell).is_some_and(|index| self.explored[index])
    }

    /// The steps that can be taken back.
    pub(super) const fn history(&self) -> usize {
        self.history.len()
    }

    /// Whether it is where the `other` chain is, and knows as much, whatever there is to take back.
    pub(super) fn is_where(&self, other: &Self) -> bool {
        let Self { cells, explored, east, south, gained, unfolds, .. } = self;
        (cells, explored, east, south) == (&other.cells, &other.explored, &other.east, &other.south)
            && (gained, unfolds) == (&other.gained, &other.unfolds)
    }

    /// Whether the team knows if `edge` is open.
    pub fn is_known(&self, edge: Edge) -> bool {
        let marks = self.marks(edge);
        marks.open || marks.wall
    }

    /// The edges that the leader may not cross in this epoch.
    pub fn virtual_obstacles(&self) -> impl Iterator<Item = Edge> {
        let sides = self.area.cells().zip(self.east.iter().zip(&self.south));
        sides.flat_map(|(cell, (east, south))| {
            let on = |side: Side, marks: &Marks| marks.virtual_obstacle.then(|| Edge::new(cell, side));
            [on(Side::East, east), on(Side::South, south)].into_iter().flatten()
        })
    }

    /// The team's intended move, and how many candidates of followers it looked at.
    ///
    /// # Errors
    /// [`TooMany`] if these are more than `most`; the chain is of no use then.
    pub fn plan(&mut self, most: u64) -> Result<(PlainIntent, u64), TooMany> {
        if self.explored.iter().all(|&explored| explored) {
            return Ok((PlainIntent::Explored, 0));
        }
        let mut looked_at = 0;
        for fresh_epoch in [false, true] {
            if self.unfolds
                && !self.gained
                && let Some(steps) = self.unfold()
            {
                return Ok((PlainIntent::Advance(steps), looked_at));
            }
            if let Some(steps) = self.lead(most, &mut looked_at)? {
                return Ok((PlainIntent::Advance(steps), looked_at));
            }
            if let Some(steps) = self.history.rchunks_exact(self.cells.len()).next() {
                let back = steps.iter().map(|step| step.reverse()).collect();
                return Ok((PlainIntent::Backtrack(back), looked_at));
            }
            self.unfolds = self.rule.has(Condition::Unfold) && self.walk().is_some();
            let gainless = !self.gained && self.rule.has(Condition::EpochMustGain);
            if fresh_epoch || (gainless && !self.unfolds) {
                break;
            }
            self.gained = false;
            for marks in self.east.iter_mut().chain(&mut self.south) {
                marks.virtual_obstacle = false;
            }
        }
        Ok((PlainIntent::Exhausted, looked_at))
    }

    /// Carries `intent` out; `is_open` answers for every edge that is crossed without being known.
    pub fn settle(&mut self, intent: &PlainIntent, mut is_open: impl FnMut(Edge) -> bool) {
        let made = match intent {
            PlainIntent::Advance(steps) => {
                let made: Vec<Step> = (0..steps.len())
                    .map(|robot| {
                        let Step::Cross(side) = steps[robot] else { return Step::Stay };
                        let edge = Edge::new(self.cells[robot], side);
                        let marks = self.marks(edge);
                        if marks.open {
                            return steps[robot];
                        }
                        if !marks.wall && is_open(edge) {
                            self.mark(edge, |marks| marks.open = true);
                            return steps[robot];
                        }
                        self.gained |= !marks.wall;
                        self.mark(edge, |marks| marks.wall = true);
                        Step::Stay
                    })
                    .collect();
                if !self.readings.has(LastMoved) || made.iter().any(|&step| step != Step::Stay) {
                    self.history.extend_from_slice(&made);
                }
                made
            }
            PlainIntent::Backtrack(steps) => {
                self.history.truncate(self.history.len() - steps.len());
                steps.clone()
            }
            PlainIntent::Explored | PlainIntent::Exhausted => return,
        };
        for (robot, step) in made.into_iter().enumerate() {
            self.cells[robot] = self.cells[robot].after(step);
            self.explore(self.cells[robot]);
        }
    }

    /// Algorithm 2.
    fn lead(&mut self, most: u64, looked_at: &mut u64) -> Result<Option<Vec<Step>>, TooMany> {
        let leader = self.cells.len() - 1;
        let (at, base) = (self.cells[leader], self.cells[0]);
        let is_open = |&side: &Side| {
            let marks = self.marks(Edge::new(at, side));
            !marks.wall && !marks.virtual_obstacle
        };
        if !Side::ALL.iter().any(is_open) {
            return Ok(None);
        }
        let distances = self.distances(Avoid::WallsAndVirtual);
        let sides = self.order.into_iter().filter_map(|step| match step {
            Step::Cross(side) => Some(side),
            Step::Stay => None,
        });
        let mut list: Vec<(Side, Step)> = sides
            .filter(is_open)
            .filter(|&side| self.distance(at.beyond(side), &distances).is_some())
            .map(|side| (side, Step::Cross(side)))
            .collect();
        if list.is_empty() {
            return Ok(None);
        }
        list.sort_by_key(|&(side, _)| {
            let to = at.beyond(side);
            let outward = i32::from(to.x - at.x) * i32::from(at.x - base.x)
                + i32::from(to.y - at.y) * i32::from(at.y - base.y);
            (self.distance(to, &distances), -outward)
        });
        for (side, step) in &mut list {
            if !self.admits_behind(at.after(*step), self.cells[leader - 1]) {
                if !self.readings.has(OnceExamined) {
                    self.mark(Edge::new(at, *side), |marks| marks.virtual_obstacle = true);
                }
                *step = Step::Stay;
            }
        }
        if self.readings.has(NullLast) {
            list.sort_by_key(|&(_, step)| step == Step::Stay);
        }
        let distances = self.distances(Avoid::Walls);
        for (side, step) in list {
            if step == Step::Stay {
                self.mark(Edge::new(at, side), |marks| marks.virtual_obstacle = true);
            }
            let to = at.after(step);
            let may_enter =
                !self.rule.has(Condition::FullForLeader) || step == Step::Stay || !self.is_full(to);
            if may_enter {
                let mut planned = vec![None; self.cells.len()];
                planned[leader] = Some(step);
                let mut recursion =
                    Recursion { chain: self, distances: &distances, planned, looked_at: *looked_at, most };
                let found = recursion.follow(leader - 1)?;
                *looked_at = recursion.looked_at;
                if found {
                    return Ok(recursion.planned.into_iter().collect());
                }
            }
            let is_asked = may_enter || !self.readings.has(Unfollowed);
            if self.rule.has(Condition::RefusedIsVirtual) && is_asked {
                self.mark(Edge::new(at, side), |marks| marks.virtual_obstacle = true);
            }
        }
        Ok(None)
    }

    /// The walk on which the chain unfolds, if it is to: its cells, and which of them are stops.
    fn walk(&self) -> Option<Walk> {
        let is_open = |edge| !self.marks(edge).wall;
        let is_explored = |cell| self.index(cell).is_none_or(|index| self.explored[index]);
        walk((self.area, &is_open, &is_explored), self.cells[0], self.cells.len() - 1)
    }

    /// The steps of all robots that unfold the chain further.
    fn unfold(&self) -> Option<Vec<Step>> {
        let (walk, stops) = self.walk()?;
        let leader = self.cells.len() - 1;
        let at = |robot: usize| walk.iter().position(|&cell| cell == self.cells[robot]).unwrap_or(0);
        // Where on the walk each robot is to be, the leader first.
        let mut planned = vec![at(leader) + 1];
        for robot in (0..leader).rev() {
            let behind = leader - robot;
            let last = if behind < stops.len() { stops[stops.len() - 1 - behind] } else { 0 };
            let waits = at(robot) == last || planned[behind - 1] <= at(robot) + 1;
            planned.push(if waits { at(robot) } else { at(robot) + 1 });
        }
        let steps = self.cells.iter().zip(planned.into_iter().rev()).map(|(&cell, planned)| {
            Step::ALL.into_iter().find(|&step| Some(cell.after(step)) == walk.get(planned).copied())
        });
        steps.collect()
    }

    /// P′_i ∈ E_C(P_{i−1}).
    fn admits_behind(&self, to: Cell, behind: Cell) -> bool {
        !self.rule.has(Condition::CoveredBehind) || in_covered(behind, to)
    }

    /// P′_i ∈ E_S(P′_{i+1}), and unless R_{i+1} is sure to arrive P′_i ∈ E_C(P_{i+1}).
    fn admits_ahead(&self, to: Cell, (from, step): (Cell, Step)) -> bool {
        let is_sure = match step {
            Step::Stay => true,
            Step::Cross(side) => !self.doubts_all && self.marks(Edge::new(from, side)).open,
        };
        let is_safe = !self.rule.has(Condition::SafeAhead) || in_safe(from.after(step), to);
        is_safe && (is_sure || !self.rule.has(Condition::UnsureAhead) || in_covered(from, to))
    }

    fn is_full(&self, cell: Cell) -> bool {
        cell != self.cells[0] && self.cells.iter().filter(|&&other| other == cell).count() >= 2
    }

    /// Steps from `from` to the nearest unexplored cell.
    fn distance(&self, from: Cell, distances: &Distances) -> Option<u32> {
        match distances {
            Distances::Each(avoid) => {
                let mut nearest = None;
                self.flood([from], *avoid, |index, steps| {
                    nearest = (!self.explored[index]).then_some(steps);
                    nearest.is_some()
                });
                nearest
            }
            Distances::Known(all) => all[self.index(from)?],
        }
    }

    fn distances(&self, avoid: Avoid) -> Distances {
        if self.floods == Floods::Many {
            return Distances::Each(avoid);
        }
        let is_unexplored = |&cell: &Cell| self.index(cell).is_some_and(|index| !self.explored[index]);
        let mut all = vec![None; self.explored.len()];
        self.flood(self.area.cells().filter(is_unexplored), avoid, |index, steps| {
            all[index] = Some(steps);
            false
        });
        Distances::Known(all)
    }

    /// Goes to all cells that can be reached from `starts`, near ones first, until one is the last.
    fn flood(
        &self,
        starts: impl IntoIterator<Item = Cell>,
        avoid: Avoid,
        mut is_last: impl FnMut(usize, u32) -> bool,
    ) {
        let mut seen = vec![false; self.explored.len()];
        let mut queue: VecDeque<(Cell, u32)> = starts.into_iter().map(|start| (start, 0)).collect();
        for &(start, _) in &queue {
            if let Some(index) = self.index(start) {
                seen[index] = true;
            }
        }
        while let Some((cell, steps)) = queue.pop_front() {
            if self.index(cell).is_none_or(|index| is_last(index, steps)) {
                return;
            }
            for side in Side::ALL {
                let marks = self.marks(Edge::new(cell, side));
                let is_blocked = marks.wall || (avoid == Avoid::WallsAndVirtual && marks.virtual_obstacle);
                if let (false, Some(index)) = (is_blocked, self.index(cell.beyond(side)))
                    && !std::mem::replace(&mut seen[index], true)
                {
                    queue.push_back((cell.beyond(side), steps + 1));
                }
            }
        }
    }

    fn explore(&mut self, cell: Cell) {
        if let Some(index) = self.index(cell) {
            self.gained |= !std::mem::replace(&mut self.explored[index], true);
        }
    }

    fn index(&self, cell: Cell) -> Option<usize> {
        self.area.locate(cell).map(|(column, row)| row * self.area.width() + column)
    }

    /// Beyond the border there are walls only.
    fn marks(&self, edge: Edge) -> Marks {
        let wall = Marks { wall: true, ..Marks::default() };
        self.index(edge.cell()).map_or(wall, |index| match edge.side() {
            Side::East | Side::West => self.east[index],
            Side::South | Side::North => self.south[index],
        })
    }

    fn mark(&mut self, edge: Edge, change: impl FnOnce(&mut Marks)) {
        if let Some(index) = self.index(edge.cell()) {
            change(match edge.side() {
                Side::East | Side::West => &mut self.east[index],
                Side::South | Side::North => &mut self.south[index],
            });
        }
    }
}

impl Recursion<'_> {
    /// Algorithm 1: whether R_i, and all behind it, can follow.
    fn follow(&mut self, robot: usize) -> Result<bool, TooMany> {
        let chain = self.chain;
        let ahead = (chain.cells[robot + 1], self.planned[robot + 1].unwrap_or(Step::Stay));
        if robot == 0 {
            self.planned[0] = Some(Step::Stay);
            return Ok(chain.admits_ahead(chain.cells[0], ahead));
        }
        let at = chain.cells[robot];
        let mut list = Vec::new();
        for step in chain.order {
            self.looked_at += 1;
            if self.looked_at > self.most {
                return Err(TooMany);
            }
            let to = at.after(step);
            let is_wall = matches!(step, Step::Cross(side) if chain.marks(Edge::new(at, side)).wall);
            let is_full =
                step != Step::Stay && chain.rule.has(Condition::FullForFollower) && chain.is_full(to);
            if is_wall
                || is_full
                || self.is_taken(robot, to)
                || !chain.admits_behind(to, chain.cells[robot - 1])
                || !chain.admits_ahead(to, ahead)
            {
                continue;
            }
            let target = match chain.rule.high {
                High::Planned => ahead.0.after(ahead.1),
                High::Present => ahead.0,
            };
            let (dx, dy) = target.apart(to);
            let is_high = dx + dy <= 1;
            let distance = chain.distance(to, self.distances).unwrap_or(u32::MAX);
            list.push(((!(is_high && step == Step::Stay), !is_high, distance), step));
        }
        if chain.readings.has(Pathless) && list.iter().any(|&((.., distance), _)| distance == u32::MAX) {
            list.clear();
        }
        list.sort_by_key(|&(key, _)| key);
        for (_, step) in list {
            self.planned[robot] = Some(step);
            if self.follow(robot - 1)? {
                return Ok(true);
            }
        }
        self.planned[robot] = None;
        Ok(false)
    }

    fn is_taken(&self, robot: usize, cell: Cell) -> bool {
        self.chain.rule.has(Condition::Distinct)
            && cell != self.chain.cells[0]
            && (robot + 1..self.planned.len()).any(|ahead| {
                self.planned[ahead].is_some_and(|step| self.chain.cells[ahead].after(step) == cell)
            })
    }
}

//! A pack: its robots, and how it makes a team move.
//!
//! Each robot has an aim, a frontier cell, and keeps it until it is a frontier cell no longer. In a team move the
//! robots take their steps in the order of their numbers, each step admitted by where the others are at that moment.
//! Two robots that are in each other's way change aims. If no robot can take its step, the paper's definitions say no
//! more, and [`Rule::PUBLISHED`] ends. Else the robot with the shortest way leads: it goes on, and the others go to it,
//! nearest first. If that does not work either, the team takes 1, 2, 4, 8 … team moves back and tries again. Where all
//! robots were side by side nothing is left to take back, and it goes as a caterpillar. So the distance to one frontier
//! cell falls until that is reached, and then something new is seen.

use super::MAX_ROBOTS;
use super::aim::Aim;
use super::chart::Chart;
use super::choice::{choose, way};
use super::flood::{Flood, Scratch};
use super::march::{caterpillar, is_side_by_side, joined};
use super::rule::{Condition, Rule};
use crate::error::sentences;
use crate::ground::{Cell, Side, Step};

/// The history of a pack: its team moves, the last one first. One that forgets the oldest moves, since it is full,
/// brings a team back less far: PACK-3 is not promised then.
pub trait Past {
    /// Notes the step of each robot.
    fn push(&mut self, steps: &[Step]);

    /// Takes the last team move out, and returns whether there was one.
    fn pop(&mut self, steps: &mut [Step]) -> bool;

    /// Forgets all of it.
    fn clear(&mut self);
}

/// Why robots are no pack.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum SetupError {
    /// There are no robots, or more than [`MAX_ROBOTS`].
    Robots(usize),
    /// Two robots are in this cell.
    Together(Cell),
    /// The robots are not connected: so many are, of so many.
    Apart(usize, usize),
}

sentences!(SetupError {
    Self::Robots(0) => "no robots are no pack";
    Self::Robots(robots) => "{robots} robots are too many for a pack: it has at most {MAX_ROBOTS}";
    Self::Together(cell) => "two robots of a pack are in the cell {cell}";
    Self::Apart(joined, robots) => "the pack is not connected: links join {joined} of its {robots} robots";
});

/// Why there is no team move.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum End {
    /// No robot reaches a frontier cell: all that can be reached is explored.
    Explored,
    /// There are frontier cells, but the team cannot go to them.
    Stuck,
}

/// The kind of a team move.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum MoveKind {
    /// Each robot goes its own way.
    Spread,
    /// This robot, counted from 0, leads, and the others go to it.
    Led(usize),
    /// A team move is taken back.
    TakenBack,
    /// The robots go as a caterpillar.
    Marched,
}

/// Stages that a team goes through at most before it makes a team move or finds none: it spreads, leads, takes back,
/// leads where all began, finds nothing more to take back, and marches.
const STAGES: usize = 6;

/// The team's stage.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
enum Stage {
    Spread,
    Lead { leader: usize, goal: Cell },
    Back { goal: Cell, moves: u32 },
    March { goal: Cell },
}

/// A pack.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Team {
    rule: Rule,
    cells: [Cell; MAX_ROBOTS],
    aims: [Option<Aim>; MAX_ROBOTS],
    robots: usize,
    stage: Stage,
    /// How many team moves are to be taken back when the next leader is stuck.
    back: u32,
    /// Whether the whole history was taken back for the present goal.
    was_home: bool,
}

/// Whether links of `rule` join all robots in these cells.
pub fn is_connected(rule: &Rule, cells: &[Cell]) -> bool {
    joined(cells, |one, other| rule.links(one, other)) == cells.len()
}

impl Team {
    /// Robots that start in these cells.
    ///
    /// # Errors
    /// [`SetupError`] if they are no pack.
    pub fn new(rule: Rule, starts: &[Cell]) -> Result<Self, SetupError> {
        let robots = starts.len();
        if !(1..=MAX_ROBOTS).contains(&robots) {
            return Err(SetupError::Robots(robots));
        }
        let together =
            (1..).zip(starts).find(|&(after, start)| starts.iter().skip(after).any(|other| other == start));
        if let Some((_, &cell)) = together {
            return Err(SetupError::Together(cell));
        }
        let joined = joined(starts, |one, other| rule.links(one, other));
        if joined < robots && rule.has(Condition::Connect) {
            return Err(SetupError::Apart(joined, robots));
        }
        let mut cells = [Cell::default(); MAX_ROBOTS];
        cells.iter_mut().zip(starts).for_each(|(cell, &start)| *cell = start);
        let aims = [None; MAX_ROBOTS];
        Ok(Self { rule, cells, aims, robots, stage: Stage::Spread, back: 1, was_home: false })
    }

    /// Its rule.
    pub const fn rule(&self) -> &Rule {
        &self.rule
    }

    /// Where its robots are.
    pub fn cells(&self) -> &[Cell] {
        &self.cells[..self.robots]
    }

    /// Where its robots are going, as far as they have decided.
    pub fn aims(&self) -> impl Iterator<Item = Option<Cell>> + Clone {
        self.aims.iter().take(self.robots).map(|aim| aim.map(|aim| aim.cell))
    }

    /// Makes a team move by what is on the `chart`, and returns what it is, with the step of each robot in `steps`.
    /// Each robot must have looked round before.
    ///
    /// # Errors
    /// [`End`] if there is none.
    pub fn advance<W: AsRef<[[u64; 2]]>>(
        &mut self,
        chart: &Chart<W>,
        past: &mut impl Past,
        memory: &mut Scratch<'_>,
        steps: &mut [Step; MAX_ROBOTS],
    ) -> Result<MoveKind, End> {
        if self.rule.has(Condition::Lead) && is_side_by_side(self.cells()) {
            past.clear();
        }
        for _ in 0..STAGES {
            *steps = [Step::Stay; MAX_ROBOTS];
            if let Stage::Lead { goal, .. } | Stage::Back { goal, .. } | Stage::March { goal } = self.stage
                && !chart.is_frontier(goal)
            {
                self.aims = [None; MAX_ROBOTS];
                (self.stage, self.back, self.was_home) = (Stage::Spread, 1, false);
            }
            let stage = self.stage;
            let mut making = MovePlanner { team: self, chart, memory, steps };
            let made = match stage {
                Stage::Spread => making.spread()?,
                Stage::Lead { leader, goal } => making.lead(leader, goal),
                Stage::Back { goal, moves } => making.take_back(goal, moves, past)?,
                Stage::March { goal } => Some(making.march(goal).ok_or(End::Stuck)?),
            };
            let Some(made) = made else { continue };
            if made != MoveKind::TakenBack {
                past.push(&steps[..self.robots]);
            }
            return Ok(made);
        }
        Err(End::Stuck)
    }

    fn who_is_in(&self, cell: Cell) -> Option<usize> {
        self.cells().iter().position(|&other| other == cell)
    }

    /// The robot goes through a side, if that is admitted; whether it is.
    fn go(&mut self, robot: usize, side: Side, steps: &mut [Step; MAX_ROBOTS]) -> bool {
        let from = self.cells[robot];
        let to = from.beyond(side);
        if !self.rule.admits_entry(to, self.cells().iter().copied()) {
            return false;
        }
        self.cells[robot] = to;
        if self.rule.has(Condition::Connect) && !is_connected(&self.rule, self.cells()) {
            self.cells[robot] = from;
            return false;
        }
        steps[robot] = Step::Cross(side);
        true
    }
}

/// A team move in the making.
struct MovePlanner<'a, 'm, W> {
    team: &'a mut Team,
    chart: &'a Chart<W>,
    memory: &'a mut Scratch<'m>,
    steps: &'a mut [Step; MAX_ROBOTS],
}

impl<W: AsRef<[[u64; 2]]>> MovePlanner<'_, '_, W> {
    /// A team move in which each robot goes its own way; `None` if the team goes on otherwise.
    fn spread(&mut self) -> Result<Option<MoveKind>, End> {
        for aim in &mut self.team.aims {
            *aim = aim.filter(|aim| self.chart.is_frontier(aim.cell));
        }
        for robot in 0..self.team.robots {
            if self.team.aims[robot].is_some() {
                continue;
            }
            let from = self.team.cells[robot];
            let aim = choose(&self.team.rule, self.chart, from, &self.team.aims().flatten(), self.memory);
            self.team.aims[robot] = aim;
        }
        for robot in 0..self.team.robots {
            self.take_own_step(robot);
        }
        if self.steps.iter().any(|&step| step != Step::Stay) {
            return Ok(Some(MoveKind::Spread));
        }
        let nearest = (0..self.team.robots)
            .filter_map(|robot| Some((self.team.aims[robot]?, robot)))
            .min_by_key(|(aim, _)| aim.far);
        let (aim, leader) = nearest.ok_or(End::Explored)?;
        if !self.team.rule.has(Condition::Lead) {
            return Err(End::Stuck);
        }
        self.team.stage = Stage::Lead { leader, goal: aim.cell };
        Ok(None)
    }

    /// The robot takes the next step on its own way, if it is admitted.
    fn take_own_step(&mut self, robot: usize) {
        let (Some(aim), from) = (self.team.aims[robot], self.team.cells[robot]) else { return };
        let aim = match aim.side() {
            Some(_) => Some(aim),
            None => way(self.chart, from, aim.cell, self.memory),
        };
        self.team.aims[robot] = aim;
        let Some((aim, side)) = aim.and_then(|aim| Some((aim, aim.side()?))) else { return };
        if let Some(other) =
            self.team.who_is_in(from.beyond(side)).filter(|_| self.team.rule.has(Condition::Single))
        {
            // Two robots that want into each other's cells go on as each other would.
            let is_back = |aim: &Aim| aim.side() == Some(side.opposite());
            if let Some(back) = self.team.aims[other].filter(is_back) {
                self.team.aims[robot] = Some(back.after_step());
                self.team.aims[other] = Some(aim.after_step());
            }
            return;
        }
        if self.team.go(robot, side, self.steps) {
            self.team.aims[robot] = Some(aim.after_step());
        }
    }

    /// A team move in which the leader goes on and the others go to it; `None` if nobody can go.
    fn lead(&mut self, leader: usize, goal: Cell) -> Option<MoveKind> {
        // A robot that is in the leader's way leads from there: it is nearer.
        let leader = self.hand_over(leader, goal);
        self.take_own_step(leader);
        let to = self.team.cells[leader];
        let mut flood = Flood::new(self.chart, self.memory, to);
        let mut left = self.team.robots;
        while let Some((cell, ..)) = flood.next() {
            // Robots that have taken their steps are not asked again.
            let is_here = |&robot: &usize| {
                robot != leader && self.team.cells[robot] == cell && self.steps[robot] == Step::Stay
            };
            let here = (0..self.team.robots).find(is_here);
            left = left.saturating_sub(usize::from(self.team.cells().contains(&cell)));
            if let Some((robot, side)) = here.and_then(|robot| Some((robot, flood.side_before(cell)?))) {
                self.team.go(robot, side.opposite(), self.steps);
            }
            if left == 0 {
                break;
            }
        }
        if self.steps.iter().any(|&step| step != Step::Stay) {
            return Some(MoveKind::Led(leader));
        }
        let moves = self.team.back;
        if self.team.rule.has(Condition::Double) {
            self.team.back = self.team.back.saturating_mul(2);
        }
        self.team.stage = Stage::Back { goal, moves };
        None
    }

    /// The robot that leads now, with its way to the goal.
    fn hand_over(&mut self, mut leader: usize, goal: Cell) -> usize {
        for _ in 0..self.team.robots {
            let from = self.team.cells[leader];
            let known = self.team.aims[leader].filter(|aim| aim.cell == goal && aim.side().is_some());
            let Some(aim) = known.or_else(|| way(self.chart, from, goal, self.memory)) else { break };
            self.team.aims[leader] = Some(aim);
            let Some(other) = aim.side().and_then(|side| self.team.who_is_in(from.beyond(side))) else {
                break;
            };
            self.team.aims[leader] = None;
            self.team.aims[other] = Some(aim.after_step());
            leader = other;
        }
        self.team.stage = Stage::Lead { leader, goal };
        leader
    }

    /// A team move that takes the last one back; `None` if the team goes on otherwise.
    fn take_back(&mut self, goal: Cell, moves: u32, past: &mut impl Past) -> Result<Option<MoveKind>, End> {
        if !self.team.rule.has(Condition::Back) {
            return Err(End::Stuck);
        }
        let mut taken = [Step::Stay; MAX_ROBOTS];
        if moves > 0 && past.pop(&mut taken[..self.team.robots]) {
            for (robot, step) in taken.into_iter().enumerate().take(self.team.robots) {
                self.steps[robot] = step.reverse();
                self.team.cells[robot] = self.team.cells[robot].after(step.reverse());
            }
            if self.team.rule.has(Condition::Anew) {
                self.team.aims = [None; MAX_ROBOTS];
            }
            self.team.stage = Stage::Back { goal, moves: moves - 1 };
            return Ok(Some(MoveKind::TakenBack));
        }
        let is_home = moves > 0;
        if is_home && is_side_by_side(self.team.cells()) {
            self.team.stage = Stage::March { goal };
            return Ok(None);
        }
        if is_home && self.team.was_home {
            return Err(End::Stuck);
        }
        self.team.was_home |= is_home;
        let leader = self.nearest(goal).map_or(0, |(robot, _)| robot);
        self.team.stage = Stage::Lead { leader, goal };
        Ok(None)
    }

    /// The robot nearest to a cell, and the side through which it goes there; `None` if no robot can.
    fn nearest(&mut self, to: Cell) -> Option<(usize, Side)> {
        let mut flood = Flood::new(self.chart, self.memory, to);
        let mut cells = core::iter::from_fn(|| flood.next());
        let (robot, cell) = cells.find_map(|(cell, ..)| Some((self.team.who_is_in(cell)?, cell)))?;
        flood.side_before(cell).map(|side| (robot, side.opposite()))
    }

    /// A team move as a caterpillar.
    fn march(&mut self, goal: Cell) -> Option<MoveKind> {
        let (head, side) = self.nearest(goal)?;
        let (length, path) = caterpillar(self.team.cells(), head);
        let mut left = self.team.cells[head];
        self.team.go(head, side, self.steps).then_some(())?;
        for &robot in &path[1..length] {
            let from = self.team.cells[robot];
            let side = Side::ALL.into_iter().find(|&side| from.beyond(side) == left)?;
            self.team.go(robot, side, self.steps).then_some(())?;
            left = from;
        }
        Some(MoveKind::Marched)
    }
}

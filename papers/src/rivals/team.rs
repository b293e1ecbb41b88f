//! A team of rivals: where it is, what it knows, and how it makes a team move.

use tautline_kernel::chain::Kind;
use tautline_kernel::ground::{Area, Cell, Edge, Step};
use tautline_proofs::run::Frame;

use super::joint::{Candidate, Joint};
use super::knowledge::Map;
use super::parameters::{Deadlock, Moves, ParameterError, Parameters, Search, Weights};
use super::{full, pool};
use tautline_grids::chance::Dice;

/// A team.
#[derive(Clone, Debug)]
pub struct Team {
    parameters: Parameters,
    /// Where the robots are, the base first.
    cells: Vec<Cell>,
    map: Map,
    dice: Dice,
    /// Team moves since something was gained.
    idle: u32,
    /// Team moves that are still to be scattered.
    scattered: u32,
}

/// Why a team makes no team move.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Standstill {
    /// Every cell is explored.
    Explored,
    /// The cells left cannot be reached: known walls are round them, or round the base.
    Enclosed,
    /// It has gained nothing for as long as its patience lasts.
    Stuck,
}

impl Team {
    /// `robots` robots, the base counted, all of them at the base; they explore the cells of `area`. Ties are drawn
    /// from `seed`.
    ///
    /// # Errors
    /// [`ParameterError`] if so many cannot explore so.
    pub fn new(
        parameters: Parameters,
        robots: usize,
        base: Cell,
        area: Area,
        seed: u64,
    ) -> Result<Self, ParameterError> {
        parameters.check(robots)?;
        let mut map = Map::new(area);
        map.explore(base);
        let dice = Dice::new(seed, *b"rivals  ");
        Ok(Self { parameters, cells: vec![base; robots], map, dice, idle: 0, scattered: 0 })
    }

    /// Where the robots are, the base first.
    pub fn cells(&self) -> &[Cell] {
        &self.cells
    }

    /// The cells that they explore.
    pub const fn area(&self) -> Area {
        self.map.area()
    }

    /// The robots' candidates now, and their costs; `None` if no unexplored cell can be reached.
    pub fn joint(&mut self) -> Option<Joint> {
        self.map.refresh();
        let weights = if self.scattered > 0 { Weights::NONE } else { self.parameters.weights };
        let steps = match self.parameters.moves {
            Moves::Four => &Step::ALL[..Step::Stay.place()],
            Moves::Five => &Step::ALL[..],
        };
        let map = &self.map;
        let options = |(place, &from): (usize, &Cell)| {
            let weights = weights.of(place == 1);
            let free = steps
                .iter()
                .filter(|&&step| !matches!(step, Step::Cross(side) if map.is_wall(Edge::new(from, side))));
            let mut options: Vec<Candidate> = free
                .filter_map(|&step| {
                    let to = from.after(step);
                    Some(Candidate { step, to, price: weights.price(map.distance(to)?) })
                })
                .collect();
            options.sort_by_key(|candidate| candidate.price);
            Some(options).filter(|options| !options.is_empty())
        };
        let robots: Option<Vec<_>> = self.cells.iter().enumerate().skip(1).map(options).collect();
        let Parameters { links, cells, .. } = self.parameters;
        Some(Joint { base: self.cells[0], robots: robots?, links, cells })
    }

    /// Makes one team move; `is_open` answers for the sides that are not known yet.
    ///
    /// # Errors
    /// [`Standstill`] if there is none.
    pub fn advance(&mut self, is_open: &mut dyn FnMut(Edge) -> bool) -> Result<Frame, Standstill> {
        if self.map.is_whole() {
            return Err(Standstill::Explored);
        }
        if self.idle >= self.parameters.patience {
            return Err(Standstill::Stuck);
        }
        let joint = self.joint().ok_or(Standstill::Enclosed)?;
        let moves = match self.parameters.moves {
            Moves::Four => &Step::ALL[..Step::Stay.place()],
            Moves::Five => &Step::ALL[..],
        };
        let chosen = match self.parameters.search {
            Search::Full => full::best(&joint, &mut self.dice).map(|found| found.steps),
            Search::Pool(pool) => pool::best(&joint, pool, self.parameters.null, moves, &mut self.dice),
        };
        let mut steps = vec![Step::Stay];
        // A pool in which every team move crosses a wall leaves the team where it is.
        steps.extend(chosen.unwrap_or_else(|| vec![Step::Stay; joint.robots.len()]));
        Ok(self.make(steps, is_open))
    }

    fn make(&mut self, steps: Vec<Step>, is_open: &mut dyn FnMut(Edge) -> bool) -> Frame {
        let mut gains = false;
        let mut blocked = vec![false; steps.len()];
        for (robot, &step) in steps.iter().enumerate() {
            let Step::Cross(side) = step else { continue };
            let edge = Edge::new(self.cells[robot], side);
            let can_go = self.map.is_open(edge) || is_open(edge);
            gains |= self.map.meet(edge, can_go);
            blocked[robot] = !can_go;
        }
        for ((cell, &step), &blocked) in self.cells.iter_mut().zip(&steps).zip(&blocked) {
            if !blocked {
                *cell = cell.after(step);
            }
            gains |= self.map.explore(*cell);
        }
        self.idle = if gains { 0 } else { self.idle + 1 };
        self.scattered = match self.parameters.deadlock {
            Deadlock::Scatter { .. } if gains => 0,
            Deadlock::Scatter { after, moves }
                if self.scattered == 0 && self.idle.is_multiple_of(after.max(1)) && self.idle > 0 =>
            {
                moves
            }
            Deadlock::Wait | Deadlock::Scatter { .. } => self.scattered.saturating_sub(1),
        };
        Frame { kind: Kind::Advance, steps, blocked, cells: self.cells.clone() }
    }
}

//! A robot's repository: the status of each cell, and the way to the cells that it knows nothing of.

use core::ops::ControlFlow;

use crate::ground::{Area, Cell, Side};

/// What a robot knows of a cell.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Status {
    /// Nothing: status 0.
    Unexplored,
    /// A robot was there: status 1.
    Explored,
    /// It cannot be entered.
    Obstacle,
}

/// A repository.
pub trait Map {
    /// The cells it spans.
    fn area(&self) -> Area;

    /// The status of `cell`; outside the area all are obstacles.
    fn status(&self, cell: Cell) -> Status;

    /// Notes that `cell` is explored, whatever was known of it; no effect outside the area.
    fn explore(&mut self, cell: Cell);

    /// Notes that `cell` is an obstacle, unless it is known to be explored; no effect outside the area.
    fn block(&mut self, cell: Cell);
}

/// The sides of a cell in the order of the numbers of the cells beyond them.
pub(super) const BY_NUMBER: [Side; 4] = [Side::North, Side::West, Side::East, Side::South];

/// A repository of at most 64 cells, in two machine words.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct TinyMap {
    explored: u64,
    obstacles: u64,
    area: Area,
}

impl TinyMap {
    /// Most cells.
    pub const CELLS: usize = 64;

    /// Nothing known of `area`; `None` if it has more than 64 cells.
    pub fn new(area: Area) -> Option<Self> {
        let cells = area.width().checked_mul(area.height())?;
        (cells <= Self::CELLS).then_some(Self { explored: 0, obstacles: 0, area })
    }

    /// Joins what `other` knows of the same area.
    pub const fn join(&mut self, other: &Self) {
        self.explored |= other.explored;
        self.obstacles = (self.obstacles | other.obstacles) & !self.explored;
    }

    /// Whether it knows nothing that is not so in `truth`, which is of the same area.
    pub const fn is_within(&self, truth: &Self) -> bool {
        self.explored & !truth.explored == 0 && self.obstacles & !truth.obstacles == 0
    }

    /// How many cells are known to be obstacles.
    pub const fn obstacles(&self) -> u32 {
        self.obstacles.count_ones()
    }

    /// The bit of a cell, by its number; none outside the area.
    const fn bit(&self, cell: Cell) -> u64 {
        match self.area.locate(cell) {
            Some((column, row)) => 1 << (row * self.area.width() + column),
            None => 0,
        }
    }
}

impl Map for TinyMap {
    fn area(&self) -> Area {
        self.area
    }

    fn status(&self, cell: Cell) -> Status {
        let bit = self.bit(cell);
        match (self.explored & bit, self.obstacles & bit) {
            (0, 0) if bit != 0 => Status::Unexplored,
            (0, _) => Status::Obstacle,
            _ => Status::Explored,
        }
    }

    fn explore(&mut self, cell: Cell) {
        self.explored |= self.bit(cell);
        self.obstacles &= !self.explored;
    }

    fn block(&mut self, cell: Cell) {
        self.obstacles |= self.bit(cell) & !self.explored;
    }
}

/// What a search knows of a cell.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Reached {
    /// The search that has reached it last.
    round: u32,
    distance: u32,
    first: Side,
}

impl Reached {
    /// No search has reached it.
    pub const NEVER: Self = Self { round: 0, distance: 0, first: Side::East };
}

/// The memory of searches, for as many cells as the area has.
#[derive(Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Scratch<'a> {
    /// One for each cell.
    pub reached: &'a mut [Reached],
    /// One for each cell.
    pub queue: &'a mut [Cell],
    /// Searches so far: it goes on from the last one with the same memory.
    pub rounds: &'a mut u32,
}

/// A cell that a search has reached.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub(super) struct Found {
    pub(super) cell: Cell,
    /// Moves to it.
    pub(super) distance: u32,
    /// The side through which the first of them goes.
    pub(super) first: Side,
}

/// Tells of the unexplored cells that are reached from `from` through explored ones, the nearest first, until it is told to
/// stop. Of ways as short the one counts whose first side leads to the lowest number.
pub(super) fn search<M: Map>(
    map: &M,
    from: Cell,
    scratch: &mut Scratch<'_>,
    mut tell: impl FnMut(Found) -> ControlFlow<()>,
) {
    let area = map.area();
    let place = |cell| area.locate(cell).map(|(column, row)| row * area.width() + column);
    *scratch.rounds = scratch.rounds.wrapping_add(1);
    let round = *scratch.rounds;
    let (mut head, mut tail) = (0, 0);
    let mut at = Found { cell: from, distance: 0, first: Side::East };
    if let Some(reached) = place(from).and_then(|place| scratch.reached.get_mut(place)) {
        *reached = Reached { round, ..Reached::NEVER };
    }
    loop {
        for side in BY_NUMBER {
            let cell = at.cell.beyond(side);
            let Some(reached) = place(cell).and_then(|place| scratch.reached.get_mut(place)) else {
                continue;
            };
            let status = map.status(cell);
            if reached.round == round || status == Status::Obstacle {
                continue;
            }
            let first = if at.distance == 0 { side } else { at.first };
            *reached = Reached { round, distance: at.distance + 1, first };
            let found = Found { cell, distance: at.distance + 1, first };
            if status == Status::Unexplored {
                if tell(found).is_break() {
                    return;
                }
            } else if let Some(next) = scratch.queue.get_mut(tail) {
                *next = cell;
                tail += 1;
            }
        }
        let Some(&cell) = scratch.queue.get(head).filter(|_| head < tail) else { return };
        head += 1;
        let Some(reached) = place(cell).and_then(|place| scratch.reached.get(place)) else { return };
        at = Found { cell, distance: reached.distance, first: reached.first };
    }
}

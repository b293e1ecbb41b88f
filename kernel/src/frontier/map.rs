//! A robot's repository: the status of each cell.

use crate::ground::{Area, Cell, Side};

/// A robot's knowledge of a cell. What is greater counts for more: where a robot was there is no obstacle, and a body
/// stays.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Status {
    /// Nothing: status 0.
    Unexplored,
    /// It cannot be entered.
    Obstacle,
    /// A robot was there: status 1.
    Explored,
    /// A dead robot is in it, or between it and the next one: it cannot be entered any more.
    Body,
}

/// A repository.
pub trait Map {
    /// The cells it spans.
    fn area(&self) -> Area;

    /// The status of `cell`; outside the area all are obstacles.
    fn status(&self, cell: Cell) -> Status;

    /// How many unexplored cells are beside explored ones, or more: a search that has found so many looks no farther.
    fn frontier(&self) -> usize {
        usize::MAX
    }

    /// Notes that `cell` has this status, unless it has a greater one; no effect outside the area.
    fn learn(&mut self, cell: Cell, status: Status);
}

/// The sides of a cell in the order of the numbers of the cells beyond them.
pub(super) const BY_NUMBER: [Side; 4] = [Side::North, Side::West, Side::East, Side::South];

/// A repository of at most 64 cells, in two machine words: a cell that is in both has a body in it.
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
        let bodies = self.explored & self.obstacles | other.explored & other.obstacles;
        self.explored |= other.explored;
        self.obstacles = (self.obstacles | other.obstacles) & !self.explored | bodies;
    }

    /// Whether it knows nothing that is not so in `truth`, which is of the same area.
    pub const fn is_within(&self, truth: &Self) -> bool {
        self.explored & !truth.explored == 0 && self.obstacles & !truth.obstacles == 0
    }

    /// How many cells are known to be obstacles.
    pub const fn obstacles(&self) -> u32 {
        (self.obstacles & !self.explored).count_ones()
    }

    /// The bit of a cell, by its number; none outside the area.
    #[inline]
    const fn bit(&self, cell: Cell) -> u64 {
        match self.area.place(cell) {
            Some(place) => 1 << place,
            None => 0,
        }
    }
}

impl Map for TinyMap {
    fn area(&self) -> Area {
        self.area
    }

    #[inline]
    fn status(&self, cell: Cell) -> Status {
        let bit = self.bit(cell);
        match (self.explored & bit, self.obstacles & bit) {
            (0, 0) if bit != 0 => Status::Unexplored,
            (0, _) => Status::Obstacle,
            (_, 0) => Status::Explored,
            _ => Status::Body,
        }
    }

    fn frontier(&self) -> usize {
        self.area.width() * self.area.height() - (self.explored | self.obstacles).count_ones() as usize
    }

    fn learn(&mut self, cell: Cell, status: Status) {
        if self.status(cell) < status {
            let bit = self.bit(cell);
            self.explored |= if status == Status::Obstacle { 0 } else { bit };
            self.obstacles = self.obstacles & !bit | if status == Status::Explored { 0 } else { bit };
        }
    }
}

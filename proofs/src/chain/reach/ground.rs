//! The ground that a chain could explore.

use std::collections::VecDeque;

use tautline_kernel::chain;
use tautline_kernel::ground::{Area, Cell, Edge, Side, Step};

use super::cells::{CellSet, cells_of, index};
use super::limits::{MAX_CELLS, TooLarge};

/// The part of a layout that a chain could explore: no cell farther than N−1 columns or rows from the base.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Ground {
    area: Area,
    base: Cell,
    robots: usize,
    /// By cell, row by row: whether each of its [`Side::ALL`] is open.
    open: Vec<[bool; 4]>,
}

impl Ground {
    /// The ground of `robots`, the base counted, all in the cell `base` of `area`. `is_open` tells of every edge inside
    /// the area whether it can be crossed; the border is closed. `None` if the base is outside the area.
    pub fn new(area: Area, base: Cell, robots: usize, is_open: impl Fn(Edge) -> bool) -> Option<Self> {
        let area = chain::area(area, base, robots)?;
        let mut open = vec![[false; 4]; cells_of(area)];
        for edge in area.edges() {
            let (one, other) = (edge.cell(), edge.cell().beyond(edge.side()));
            if let (true, Some(one), Some(other)) = (is_open(edge), index(area, one), index(area, other)) {
                open[one][edge.side() as usize] = true;
                open[other][edge.side().opposite() as usize] = true;
            }
        }
        Some(Self { area, base, robots, open })
    }

    /// The cells it spans.
    pub const fn area(&self) -> Area {
        self.area
    }

    /// The base.
    pub const fn base(&self) -> Cell {
        self.base
    }

    /// Robots, base included.
    pub const fn robots(&self) -> usize {
        self.robots
    }

    /// Whether a robot in `cell` can make `step`: it stays, or crosses an open edge.
    pub fn admits(&self, cell: Cell, step: Step) -> bool {
        match step {
            Step::Stay => true,
            Step::Cross(side) => index(self.area, cell).is_some_and(|index| self.open[index][side as usize]),
        }
    }

    /// The cells that can be walked to from the base.
    pub(super) fn walkable(&self) -> CellSet {
        let mut seen = CellSet::new(self.area);
        seen.insert(self.base);
        let mut queue = VecDeque::from([self.base]);
        while let Some(cell) = queue.pop_front() {
            for side in Side::ALL {
                let beyond = cell.beyond(side);
                if self.admits(cell, Step::Cross(side)) && !seen.contains(beyond) {
                    seen.insert(beyond);
                    queue.push_back(beyond);
                }
            }
        }
        seen
    }

    /// The set as bits, if the ground is small enough.
    pub(crate) fn bits(&self, cells: &CellSet) -> Result<u128, TooLarge> {
        let count = cells_of(self.area);
        if count > MAX_CELLS {
            return Err(TooLarge::Cells { cells: count });
        }
        let bits = cells.iter().filter_map(|cell| index(self.area, cell));
        Ok(bits.fold(0, |bits, index| bits | 1 << index))
    }
}

//! Sets of cells of an area, one bit each.

use std::fmt;

use tautline_kernel::ground::{Area, Cell};

/// Cells of an area.
#[derive(Clone, PartialEq, Eq)]
pub struct CellSet {
    area: Area,
    /// Row by row, one bit each.
    words: Vec<u64>,
}

impl CellSet {
    /// No cell of `area`.
    pub fn new(area: Area) -> Self {
        Self { area, words: vec![0; cells_of(area).div_ceil(64)] }
    }

    /// Adds `cell`; no effect outside the area.
    pub fn insert(&mut self, cell: Cell) {
        if let Some(index) = index(self.area, cell) {
            self.words[index / 64] |= 1 << (index % 64);
        }
    }

    /// Whether `cell` is in the set.
    pub fn contains(&self, cell: Cell) -> bool {
        index(self.area, cell).is_some_and(|index| self.words[index / 64] >> (index % 64) & 1 == 1)
    }

    /// How many cells it holds.
    pub fn len(&self) -> usize {
        self.words.iter().map(|word| word.count_ones() as usize).sum()
    }

    /// Whether it holds none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Its cells, row by row.
    pub fn iter(&self) -> impl Iterator<Item = Cell> {
        self.area.cells().filter(|&cell| self.contains(cell))
    }

    pub(crate) fn of_bits(area: Area, bits: u128) -> Self {
        let words = (0..cells_of(area).div_ceil(64)).map(|word| (bits >> (64 * word)) as u64).collect();
        Self { area, words }
    }
}

impl fmt::Debug for CellSet {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_set().entries(self.iter()).finish()
    }
}

/// How many cells an area has.
pub(super) const fn cells_of(area: Area) -> usize {
    area.width() * area.height()
}

/// The place of a cell in its area, row by row.
pub(super) fn index(area: Area, cell: Cell) -> Option<usize> {
    area.locate(cell).map(|(column, row)| row * area.width() + column)
}

//! Sets of cells in machine words, one bit each, moved about all at once.

use core::ops::{BitAnd, BitOr, Not, Shl, Shr};

/// A set of cells by column and row, both less than [`Plane::COLUMNS`] and [`Plane::ROWS`].
///
/// Whole sets are moved along open sides: `open` holds the cells whose east side is open, or whose south side is.
/// No side open may lead out of the plane; an area's border sees to that.
pub trait Plane: Copy + Eq {
    /// Cells in a row.
    const COLUMNS: usize;
    /// Rows.
    const ROWS: usize;
    /// No cell.
    const NONE: Self;

    /// Whether the cell is in the set.
    fn has(&self, column: usize, row: usize) -> bool;
    /// Adds the cell.
    fn put(&mut self, column: usize, row: usize);
    /// Takes the cell out.
    fn take(&mut self, column: usize, row: usize);
    /// The cells in both sets.
    fn and(&self, other: &Self) -> Self;
    /// The cells in either set.
    fn or(&self, other: &Self) -> Self;
    /// The cells of the plane, and what bits there are beyond, that are not in the set.
    fn not(&self) -> Self;
    /// The cells beyond the open east and west sides of these.
    fn along_rows(&self, open: &Self) -> Self;
    /// The cells beyond the open south and north sides of these.
    fn along_columns(&self, open: &Self) -> Self;
}

/// Small planes in one word, row after row.
macro_rules! in_one_word {
    ($($word:ty: $side:literal),*) => {$(
        impl Plane for $word {
            const COLUMNS: usize = $side;
            const ROWS: usize = $side;
            const NONE: Self = 0;

            fn has(&self, column: usize, row: usize) -> bool {
                self >> ($side * row + column) & 1 == 1
            }

            fn put(&mut self, column: usize, row: usize) {
                *self |= 1 << ($side * row + column);
            }

            fn take(&mut self, column: usize, row: usize) {
                *self &= !(1 << ($side * row + column));
            }

            fn and(&self, other: &Self) -> Self {
                self & other
            }

            fn or(&self, other: &Self) -> Self {
                self | other
            }

            fn not(&self) -> Self {
                !self
            }

            fn along_rows(&self, open: &Self) -> Self {
                (self & open) << 1 | self >> 1 & open
            }

            fn along_columns(&self, open: &Self) -> Self {
                (self & open) << $side | self >> $side & open
            }
        }
    )*};
}
in_one_word!(u64: 8, u128: 11);

/// A row of cells, one bit each.
pub trait Word:
    Copy
    + Eq
    + BitAnd<Output = Self>
    + BitOr<Output = Self>
    + Not<Output = Self>
    + Shl<usize, Output = Self>
    + Shr<usize, Output = Self>
{
    /// Cells in a row.
    const BITS: usize;
    /// No cell.
    const NONE: Self;
    /// The westernmost cell alone.
    const FIRST: Self;
}

macro_rules! words {
    ($($word:ty),*) => {$(
        impl Word for $word {
            const BITS: usize = <$word>::BITS as usize;
            const NONE: Self = 0;
            const FIRST: Self = 1;
        }
    )*};
}
words!(u16, u32, u64, u128);

impl<W: Word, const HEIGHT: usize> Plane for [W; HEIGHT] {
    const COLUMNS: usize = W::BITS;
    const ROWS: usize = HEIGHT;
    const NONE: Self = [W::NONE; HEIGHT];

    fn has(&self, column: usize, row: usize) -> bool {
        self[row] & W::FIRST << column != W::NONE
    }

    fn put(&mut self, column: usize, row: usize) {
        self[row] = self[row] | W::FIRST << column;
    }

    fn take(&mut self, column: usize, row: usize) {
        self[row] = self[row] & !(W::FIRST << column);
    }

    fn and(&self, other: &Self) -> Self {
        core::array::from_fn(|row| self[row] & other[row])
    }

    fn or(&self, other: &Self) -> Self {
        core::array::from_fn(|row| self[row] | other[row])
    }

    fn not(&self) -> Self {
        self.map(W::not)
    }

    fn along_rows(&self, open: &Self) -> Self {
        core::array::from_fn(|row| (self[row] & open[row]) << 1 | self[row] >> 1 & open[row])
    }

    fn along_columns(&self, open: &Self) -> Self {
        let mut beyond = Self::NONE;
        for row in 1..HEIGHT {
            beyond[row] = self[row - 1] & open[row - 1];
            beyond[row - 1] = beyond[row - 1] | self[row] & open[row - 1];
        }
        beyond
    }
}

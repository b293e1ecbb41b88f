//! Sets of cells in machine words, one bit each, moved about all at once.

use core::ops::{BitAnd, BitOr};

use super::Steps;

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
    /// The steps from a cell that lead into the set. A step that leads out of the plane may be among them or not.
    fn steps_from(&self, column: usize, row: usize) -> Steps;
    /// The steps across the sides of a cell, if `east` holds the cells of which the east side is meant, and `south`
    /// those of which the south side is. Before the first column stands what is in the last, before the first row too.
    fn steps_across(east: &Self, south: &Self, column: usize, row: usize) -> Steps;
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
    /// Adds the cells beyond the open sides of these, the `east` and the `south` ones from either side, in the `rows`
    /// from the first to the last, and perhaps in others. Returns rows, the first and the last, that hold all the new
    /// cells; `None` if there are no new cells.
    #[inline]
    fn spread(&mut self, east: &Self, south: &Self, rows: (usize, usize)) -> Option<(usize, usize)> {
        let wider = self.or(&self.along_rows(east)).or(&self.along_columns(south));
        let is_wider = wider != *self;
        *self = wider;
        is_wider.then_some(rows)
    }
}

/// Small planes in one word, row after row.
macro_rules! in_one_word {
    ($($word:ty: $side:literal),*) => {$(
        impl Plane for $word {
            const COLUMNS: usize = $side;
            const ROWS: usize = $side;
            const NONE: Self = 0;

            #[inline]
            fn has(&self, column: usize, row: usize) -> bool {
                self >> ($side * row + column) & 1 == 1
            }

            #[inline]
            fn put(&mut self, column: usize, row: usize) {
                *self |= 1 << ($side * row + column);
            }

            #[inline]
            fn take(&mut self, column: usize, row: usize) {
                *self &= !(1 << ($side * row + column));
            }

            #[inline]
            fn steps_from(&self, column: usize, row: usize) -> Steps {
                // The cell and its neighbours.
                const CROSS: $word = 0b11 | 1 << $side | 1 << (<$word>::BITS - 1) | 1 << (<$word>::BITS - $side);
                let round = self.rotate_right(($side * row + column) as u32);
                if round & CROSS == 0 {
                    return Steps::NONE;
                }
                let [east, south] = [round >> 1 & 1, round >> ($side - 1) & 2];
                let [west, north] = [round >> (Self::BITS - 3) & 4, round >> (Self::BITS - $side - 3) & 8];
                Steps::of_bits((east | south | west | north | (round & 1) << 4) as u8)
            }

            #[inline]
            fn steps_across(east: &Self, south: &Self, column: usize, row: usize) -> Steps {
                let place = ($side * row + column) as u32;
                let (east, south) = (east.rotate_right(place), south.rotate_right(place));
                let [west, north] = [east >> (Self::BITS - 3) & 4, south >> (Self::BITS - $side - 3) & 8];
                Steps::of_bits((east & 1 | (south & 1) << 1 | west | north) as u8)
            }

            #[inline]
            fn and(&self, other: &Self) -> Self {
                self & other
            }

            #[inline]
            fn or(&self, other: &Self) -> Self {
                self | other
            }

            #[inline]
            fn not(&self) -> Self {
                !self
            }

            #[inline]
            fn along_rows(&self, open: &Self) -> Self {
                (self & open) << 1 | self >> 1 & open
            }

            #[inline]
            fn along_columns(&self, open: &Self) -> Self {
                (self & open) << $side | self >> $side & open
            }
        }
    )*};
}
in_one_word!(u64: 8, u128: 11);

/// Adds to each row those cells of another that have an open side in between.
#[inline]
fn add_open<W>(rows: &mut [W], others: &[W], open: &[W])
where
    W: Copy + BitAnd<Output = W> + BitOr<Output = W>,
{
    for ((row, &other), &open) in rows.iter_mut().zip(others).zip(open) {
        *row = *row | other & open;
    }
}

/// Larger planes, a word for each row.
macro_rules! in_rows {
    ($($word:ty),*) => {$(
        impl<const HEIGHT: usize> Plane for [$word; HEIGHT] {
            const COLUMNS: usize = <$word>::BITS as usize;
            const ROWS: usize = HEIGHT;
            const NONE: Self = [0; HEIGHT];

            #[inline]
            fn has(&self, column: usize, row: usize) -> bool {
                self[row] >> column & 1 == 1
            }

            #[inline]
            fn put(&mut self, column: usize, row: usize) {
                self[row] |= 1 << column;
            }

            #[inline]
            fn take(&mut self, column: usize, row: usize) {
                self[row] &= !(1 << column);
            }

            #[inline]
            fn steps_from(&self, column: usize, row: usize) -> Steps {
                let at = self[row];
                let south = self[(row + 1) % HEIGHT];
                let north = self[(row + HEIGHT - 1) % HEIGHT];
                let bit = |row: $word, column: usize| (row.rotate_right(column as u32) & 1) as u8;
                let [east, south] = [bit(at, column + 1), bit(south, column)];
                let [west, north] = [bit(at, column + Self::COLUMNS - 1), bit(north, column)];
                Steps::of_bits(east | south << 1 | west << 2 | north << 3 | bit(at, column) << 4)
            }

            #[inline]
            fn steps_across(east: &Self, south: &Self, column: usize, row: usize) -> Steps {
                let at = east[row];
                let (south, north) = (south[row], south[(row + HEIGHT - 1) % HEIGHT]);
                let bit = |row: $word, column: usize| (row.rotate_right(column as u32) & 1) as u8;
                let west = bit(at, column + Self::COLUMNS - 1);
                Steps::of_bits(bit(at, column) | bit(south, column) << 1 | west << 2 | bit(north, column) << 3)
            }

            #[inline]
            fn and(&self, other: &Self) -> Self {
                core::array::from_fn(|row| self[row] & other[row])
            }

            #[inline]
            fn or(&self, other: &Self) -> Self {
                core::array::from_fn(|row| self[row] | other[row])
            }

            #[inline]
            fn not(&self) -> Self {
                self.map(|row| !row)
            }

            #[inline]
            fn along_rows(&self, open: &Self) -> Self {
                core::array::from_fn(|row| (self[row] & open[row]) << 1 | self[row] >> 1 & open[row])
            }

            #[inline]
            fn spread(&mut self, east: &Self, south: &Self, (first, last): (usize, usize)) -> Option<(usize, usize)> {
                let (last, old) = (last.min(HEIGHT - 1), *self);
                let rows = || first..=last;
                // No row waits for what comes of another: as many are done at once as the machine can.
                for ((wider, &old), &open) in self[rows()].iter_mut().zip(&old[rows()]).zip(&east[rows()]) {
                    *wider = old | (old & open) << 1 | old >> 1 & open;
                }
                let below = first.max(1);
                add_open(&mut self[below..=last], &old[below - 1..last], &south[below - 1..last]);
                let above = first..(last + 1).min(HEIGHT - 1);
                add_open(&mut self[above.clone()], &old[above.start + 1..], &south[above]);
                let mut changed = rows().filter(|&row| self[row] != old[row]);
                let first = changed.next()?;
                Some((first, changed.next_back().unwrap_or(first)))
            }

            #[inline]
            fn along_columns(&self, open: &Self) -> Self {
                let mut beyond = Self::NONE;
                for row in 1..HEIGHT {
                    beyond[row] = self[row - 1] & open[row - 1];
                    beyond[row - 1] |= self[row] & open[row - 1];
                }
                beyond
            }
        }
    )*};
}
in_rows!(u16, u32, u64, u128);

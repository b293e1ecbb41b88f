//! The map that the robots of a pack share: two bits a cell, row by row in machine words.

use crate::ground::{Area, Cell, Side};

/// A pack's knowledge of a cell.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Status {
    /// No robot has seen it: it is unexplored.
    Unknown,
    /// A robot has seen that it is free: it is explored.
    Free,
    /// A robot has seen that it is an obstacle; all cells outside the area are.
    Obstacle,
}

/// The places of the two bits of a cell in a pair of words.
const UNKNOWN: usize = 0;
const OBSTACLE: usize = 1;

/// The words outside the area: no cell is unknown, all are obstacles.
const OUTSIDE: [u64; 2] = [0, u64::MAX];

/// A map in words that the caller stores: a vector, an array, or a lent slice.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Chart<W> {
    area: Area,
    words: W,
}

const WORD: usize = u64::BITS as usize;

/// Words of a row.
const fn stride(area: Area) -> usize {
    area.width().div_ceil(WORD)
}

impl<W: AsRef<[[u64; 2]]> + AsMut<[[u64; 2]]>> Chart<W> {
    /// Pairs of words that the map of `area` takes.
    pub const fn words(area: Area) -> usize {
        stride(area) * area.height()
    }

    /// Nothing known of `area`, in `words`, whatever they are; `None` if there are fewer than [`Chart::words`].
    pub fn new(area: Area, mut words: W) -> Option<Self> {
        let own = words.as_mut().get_mut(..Self::words(area))?;
        for row in own.chunks_mut(stride(area)) {
            let mut columns = area.width();
            for word in row {
                // The cells of the area are unknown; the bits beyond its east side are obstacles.
                let inside = if columns >= WORD { u64::MAX } else { (1 << columns) - 1 };
                *word = [inside, !inside];
                columns = columns.saturating_sub(WORD);
            }
        }
        Some(Self { area, words })
    }

    /// Notes that `cell` is free, or an obstacle; no effect outside the area.
    pub fn put(&mut self, cell: Cell, is_obstacle: bool) {
        let Some((place, bit)) = self.place(cell) else { return };
        if let Some(word) = self.words.as_mut().get_mut(place) {
            word[UNKNOWN] &= !bit;
            word[OBSTACLE] = if is_obstacle { word[OBSTACLE] | bit } else { word[OBSTACLE] & !bit };
        }
    }
}

impl<W: AsRef<[[u64; 2]]>> Chart<W> {
    /// The cells that it spans.
    pub const fn area(&self) -> Area {
        self.area
    }

    /// The place of a cell's word, and its bit.
    fn place(&self, cell: Cell) -> Option<(usize, u64)> {
        let (column, row) = self.area.locate(cell)?;
        Some((row * stride(self.area) + column / WORD, 1 << (column % WORD)))
    }

    /// The status of `cell`.
    pub fn status(&self, cell: Cell) -> Status {
        let Some((place, bit)) = self.place(cell) else { return Status::Obstacle };
        match self.words.as_ref().get(place) {
            Some(word) if word[UNKNOWN] & bit != 0 => Status::Unknown,
            Some(word) if word[OBSTACLE] & bit == 0 => Status::Free,
            Some(_) | None => Status::Obstacle,
        }
    }

    /// Whether `cell` is a frontier cell: known to be free, and beside an unknown one.
    pub fn is_frontier(&self, cell: Cell) -> bool {
        let is_unknown = |side: Side| self.status(cell.beyond(side)) == Status::Unknown;
        self.status(cell) == Status::Free && Side::ALL.into_iter().any(is_unknown)
    }

    /// The cells of a row from `column` on eastwards, one bit each: which are unknown, and which are obstacles.
    pub(super) fn row(&self, column: i32, row: i32) -> [u64; 2] {
        let (column, row) = (column - i32::from(self.area.first().x), row - i32::from(self.area.first().y));
        if row < 0 || row >= self.area.height() as i32 {
            return OUTSIDE;
        }
        let stride = stride(self.area);
        let word = |number: i32| -> [u64; 2] {
            let inside = usize::try_from(number).ok().filter(|&number| number < stride);
            let place = inside.map(|number| row as usize * stride + number);
            place.and_then(|place| self.words.as_ref().get(place)).copied().unwrap_or(OUTSIDE)
        };
        let (number, shift) = (column.div_euclid(WORD as i32), column.rem_euclid(WORD as i32));
        let (low, high) = (word(number), word(number + 1));
        let joined = |plane: usize| {
            let beyond = if shift == 0 { 0 } else { high[plane] << (WORD as i32 - shift) };
            low[plane] >> shift | beyond
        };
        [joined(UNKNOWN), joined(OBSTACLE)]
    }
}

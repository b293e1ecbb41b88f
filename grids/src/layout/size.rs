//! Columns and rows of a layout, within bounds that keep memory and coordinates small; and a bit for each of its cells.

use std::fmt;

use serde::{Deserialize, Serialize};
use tautline_io::diagnostic::Diagnostic;
use tautline_kernel::ground::{Area, Cell};

/// The most cells on a side.
pub const MAX_SIDE_CELLS: u64 = 32_000;
/// The most cells of a layout.
pub const MAX_CELLS: u64 = 1 << 24;

/// Columns and rows, both at least 1.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Serialize, Deserialize)]
#[serde(try_from = "(u64, u64)", into = "(i16, i16)")]
pub struct Size {
    width: i16,
    height: i16,
}

impl TryFrom<(u64, u64)> for Size {
    type Error = Diagnostic;

    fn try_from((width, height): (u64, u64)) -> Result<Self, Diagnostic> {
        Self::new(width, height)
    }
}

impl From<Size> for (i16, i16) {
    fn from(Size { width, height }: Size) -> Self {
        (width, height)
    }
}

impl Size {
    /// `width` columns and `height` rows.
    ///
    /// # Errors
    /// [`Diagnostic`] when a side is 0 or above [`MAX_SIDE_CELLS`], or the area above [`MAX_CELLS`].
    pub fn new(width: u64, height: u64) -> Result<Self, Diagnostic> {
        let sides_fit = 0 < width && width <= MAX_SIDE_CELLS && 0 < height && height <= MAX_SIDE_CELLS;
        if sides_fit && width * height <= MAX_CELLS {
            Ok(Self { width: width as i16, height: height as i16 })
        } else {
            Err(of_size(width, height))
        }
    }

    /// Columns.
    pub const fn width(self) -> i16 {
        self.width
    }

    /// Rows.
    pub const fn height(self) -> i16 {
        self.height
    }

    /// Columns times rows.
    pub const fn cells(self) -> usize {
        self.width as usize * self.height as usize
    }

    /// All of them.
    pub fn area(self) -> Area {
        let first = Cell::new(0, 0);
        Area::new(first, Cell::new(self.width - 1, self.height - 1)).unwrap_or(Area::of(first))
    }

    /// Columns and rows of all areas up to this size, fewest cells first.
    pub fn areas(self) -> Vec<(i16, i16)> {
        let all = (1..=self.height).flat_map(|height| (1..=self.width).map(move |width| (width, height)));
        let mut areas: Vec<(i16, i16)> = all.collect();
        areas.sort_by_key(|&(width, height)| (width * height, height));
        areas
    }

    /// Whether `cell` is one of them.
    #[inline]
    pub const fn contains(self, cell: Cell) -> bool {
        0 <= cell.x && cell.x < self.width && 0 <= cell.y && cell.y < self.height
    }

    /// The place of `cell` in row order.
    #[inline]
    pub(super) fn index(self, cell: Cell) -> Option<usize> {
        self.contains(cell).then(|| cell.y as usize * self.width as usize + cell.x as usize)
    }
}

/// `15x10`: columns, then rows.
impl fmt::Display for Size {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}x{}", self.width, self.height)
    }
}

/// A side or the area is out of bounds.
pub fn of_size(width: u64, height: u64) -> Diagnostic {
    Diagnostic::usage(format_args!("the size {width}x{height} is out of bounds"), sizes())
}

/// The base, or what else is called so, is not inside the rim.
pub fn outside(what: &str, cell: Cell, size: Size) -> Diagnostic {
    let (width, height) = (size.width() - 1, size.height() - 1);
    let remedy = format!("columns go from 0 to {width}, rows from 0 to {height}");
    Diagnostic::usage(format_args!("the {what} {cell} is outside the {size} cells"), remedy)
}

/// How large a layout can be.
pub(super) fn sizes() -> String {
    format!("a layout has 1 to {MAX_SIDE_CELLS} cells on a side and at most {MAX_CELLS} in all")
}

/// One bit for each cell of a layout.
#[derive(Clone, PartialEq, Eq, Hash)]
pub(super) struct Bitmap(Vec<u64>);

impl Bitmap {
    /// A plane of `bits` bits, none of them set.
    pub(super) fn new(bits: usize) -> Self {
        Self(vec![0; bits.div_ceil(64)])
    }

    #[inline]
    pub(super) fn has(&self, index: usize) -> bool {
        self.0.get(index / 64).is_some_and(|word| word >> (index % 64) & 1 == 1)
    }

    pub(super) fn put(&mut self, index: usize) {
        if let Some(word) = self.0.get_mut(index / 64) {
            *word |= 1 << (index % 64);
        }
    }

    pub(super) fn take(&mut self, index: usize) {
        if let Some(word) = self.0.get_mut(index / 64) {
            *word &= !(1 << (index % 64));
        }
    }

    /// How many bits are set.
    pub(super) fn count(&self) -> usize {
        self.0.iter().map(|word| word.count_ones() as usize).sum()
    }
}

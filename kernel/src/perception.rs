//! How an agent finds the sensors round it with its camera [Ferranti 2009, IV]: blobs of light in a picture ([`blob`]),
//! who they are from their blinking ([`blink`]), where they are ([`polar`]), and how long it takes ([`time`]). Pure
//! functions over lent buffers, in whole numbers. Where the paper leaves a choice, the docs say which reading is ours.

pub mod blink;
pub mod blob;
pub mod polar;
pub mod time;

/// A place in a picture: `x` grows to the right, `y` downwards, both from the middle of the pixel in the upper left
/// corner, in 256ths of a pixel.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Default, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Point {
    /// To the right, in 256ths of a pixel.
    pub x: u32,
    /// Downwards, in 256ths of a pixel.
    pub y: u32,
}

impl Point {
    /// How many there are of the unit of coordinates in a pixel.
    pub const UNITS_PER_PIXEL: u32 = 256;

    /// The middle of the pixel in `column` and `row`.
    #[inline]
    pub const fn of_pixel(column: u16, row: u16) -> Self {
        Self { x: column as u32 * Self::UNITS_PER_PIXEL, y: row as u32 * Self::UNITS_PER_PIXEL }
    }

    /// Whether the straight way from here to `other` is at most `bound` long, in 256ths of a pixel.
    #[inline]
    pub const fn is_within(self, bound: u32, other: Self) -> bool {
        let (x, y) = (self.x.abs_diff(other.x) as u64, self.y.abs_diff(other.y) as u64);
        // A sum that does not fit is longer than any bound.
        (x * x).saturating_add(y * y) <= bound as u64 * bound as u64
    }
}

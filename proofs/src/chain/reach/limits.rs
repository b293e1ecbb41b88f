//! How large a ground may be for the exact answer of [`Ground::reachable`](super::Ground::reachable).

use std::fmt;

/// Most cells of a ground for an exact answer: one bit each in a word.
pub const MAX_CELLS: usize = 128;

/// Most places of the followers for an exact answer: up to six robots in the open.
pub const MAX_PLACES: usize = 1 << 20;

/// Most followers for an exact answer: in two cells already more have more than [`MAX_PLACES`].
pub const MAX_FOLLOWERS: usize = 20;

/// Why it cannot be said exactly what is reachable.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum TooLarge {
    /// The chain's area has more than [`MAX_CELLS`].
    Cells {
        /// Cells it has.
        cells: usize,
    },
    /// The followers can be placed in more than [`MAX_PLACES`] ways, or are more than [`MAX_FOLLOWERS`].
    Places,
}

impl fmt::Display for TooLarge {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Cells { cells } => {
                write!(f, "{cells} cells are too many to say what is reachable: at most {MAX_CELLS}")
            }
            Self::Places => {
                write!(f, "the followers have too many places to say what is reachable: at most {MAX_PLACES}")
            }
        }
    }
}

impl std::error::Error for TooLarge {}

//! A lap: loop detection (ours; the paper leaves loop closure out). An agent leaves a cell through a thin side and
//! walks with its left hand along the material until it is about to leave through the same side again. If it has not
//! come back through that side before, the material on its left is not the material on its right, so the side can be
//! shut and what is left stays connected (BRICKS-2).

use crate::lattice::{Cell, Side};

/// A lap under way, as an agent remembers it.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub struct Lap {
    /// The side that it began with.
    pub first: Side,
    /// Whether another agent's lap takes precedence: then it ends where it began and shuts nothing.
    pub is_void: bool,
    /// The sensors around its start, by their identifiers. If one has been replaced, the material beside the first
    /// side is not what it was.
    pub(super) around: [u16; 8],
    /// Where the agent is, the start being 0,0: an agent can count its own moves.
    at: Cell,
    /// A place and heading on the way, moved on at powers of two (Brent's search for cycles).
    mark: (Cell, Side),
    moved: u32,
    due: u32,
}

impl Lap {
    /// Moves after which the first mark is set.
    const FIRST: u32 = 64;

    /// A lap that begins through `first`.
    pub(super) const fn new(first: Side, around: [u16; 8]) -> Self {
        let start = Cell::new(0, 0);
        Self { first, is_void: false, around, at: start, mark: (start, first), moved: 0, due: Self::FIRST }
    }

    /// Whether the agent is where the lap began.
    pub(super) fn is_home(&self) -> bool {
        self.at == Cell::new(0, 0)
    }

    /// The lap after a move through `side`; `None` if it goes round without coming home: the claim was taken away and the
    /// start marked, or a sensor was missed.
    pub(super) fn moved(self, side: Side) -> Option<Self> {
        let (at, moved) = (self.at.beyond(side), self.moved + 1);
        if moved >= self.due {
            return Some(Self { at, moved, mark: (at, side), due: self.due.checked_mul(2)?, ..self });
        }
        let comes_round = moved > Self::FIRST && (at, side) == self.mark;
        (!comes_round).then_some(Self { at, moved, ..self })
    }
}

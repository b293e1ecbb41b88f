//! A lap: loop detection (ours; the paper leaves loop closure out). An agent leaves a cell through a thin side and
//! walks with its left hand along the material until it is about to leave through the same side again. If it has not
//! come back through that side before, the material on its left is not the material on its right, so the side can be
//! shut and what is left stays connected (BRICKS-2).
//!
//! A lap that has not come round after so many moves is cut short: the agent turns and goes back with its right hand on
//! the same material. It arrives with the other piece of material on its left, so the next lap goes round that one, and
//! after two in vain the reach is doubled. So a side costs a small multiple of the way round the smaller piece.

use crate::ground::{Cell, Side};

/// The hand that an agent keeps on the material.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub(super) enum Hand {
    Left,
    Right,
}

/// A lap under way, as an agent remembers it.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Lap {
    /// The side that it began with.
    pub first: Side,
    /// The left until the lap is cut short, the right on the way back.
    pub(super) hand: Hand,
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
        let at = Cell::new(0, 0);
        let hand = Hand::Left;
        Self { first, hand, is_void: false, around, at, mark: (at, first), moved: 0, due: Self::FIRST }
    }

    /// The moves made since it began or was cut short.
    pub(super) const fn moved(&self) -> u32 {
        self.moved
    }

    /// Whether the agent is on its way back before the lap has come round.
    pub(super) const fn is_cut_short(&self) -> bool {
        matches!(self.hand, Hand::Right)
    }

    /// The way back, for an agent that would have gone on through `onward`.
    pub(super) const fn cut_short(self, onward: Side) -> Self {
        let mark = (self.at, onward);
        Self { hand: Hand::Right, mark, moved: 0, due: Self::FIRST, ..self }
    }

    /// Whether the agent is where the lap began.
    pub(super) fn is_home(&self) -> bool {
        self.at == Cell::new(0, 0)
    }

    /// The lap after a move through `side`; `None` if it goes round without coming home: the claim was taken away and the
    /// start marked, or a sensor was missed.
    pub(super) fn through(self, side: Side) -> Option<Self> {
        let (at, moved) = (self.at.beyond(side), self.moved + 1);
        if moved >= self.due {
            return Some(Self { at, moved, mark: (at, side), due: self.due.checked_mul(2)?, ..self });
        }
        let comes_round = moved > Self::FIRST && (at, side) == self.mark;
        (!comes_round).then_some(Self { at, moved, ..self })
    }
}

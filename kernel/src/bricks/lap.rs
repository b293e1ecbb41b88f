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
    /// The moves made since it began or was cut short.
    pub(super) moved: u32,
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

    /// Whether the agent is on its way back before the lap has come round.
    pub(super) const fn is_cut_short(&self) -> bool {
        matches!(self.hand, Hand::Right)
    }

    /// The way back, on which moves and marks are counted anew.
    pub(super) const fn cut_short(self) -> Self {
        Self { hand: Hand::Right, moved: 0, due: Self::FIRST, ..self }
    }

    /// Whether the agent is where the lap began.
    pub(super) fn is_home(&self) -> bool {
        self.at == Cell::new(0, 0)
    }

    /// The lap after a move through `side`; `None` if it goes round without coming home: the claim was taken away and
    /// the start marked, or a sensor was missed.
    pub(super) fn through(self, side: Side) -> Option<Self> {
        let (at, moved) = (self.at.beyond(side), self.moved + 1);
        if moved >= self.due {
            return Some(Self { at, moved, mark: (at, side), due: self.due.checked_mul(2)?, ..self });
        }
        let comes_round = moved > Self::FIRST && (at, side) == self.mark;
        (!comes_round).then_some(Self { at, moved, ..self })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Moves in a rectangle of so many columns and rows, from outside of which
    /// the lap began, until the lap is given up.
    fn given_up_after(mut lap: Lap, columns: usize, rows: usize) -> u32 {
        let sides = [
            (Side::East, columns - 1),
            (Side::South, rows - 1),
            (Side::West, columns - 1),
            (Side::North, rows - 1),
        ];
        let mut round = sides.into_iter().flat_map(|(side, moves)| core::iter::repeat_n(side, moves)).cycle();
        let mut moves = 0;
        loop {
            let side = round.next().expect("it goes round and round");
            moves += 1;
            let Some(next) = lap.through(side) else { return moves };
            lap = next;
            assert_eq!(lap.moved, moves);
        }
    }

    #[test]
    fn a_lap_that_goes_round_without_coming_home_is_given_up_one_round_after_a_mark() {
        let begun = Lap::new(Side::North, [0; 8]).through(Side::North).expect("it has left");
        let out =
            |moves| (0..moves).fold(begun, |lap, _| lap.through(Side::North).expect("it goes straight on"));
        for before in [0, 1, 62, 63, 64, 100, 127, 128, 500] {
            let back = out(before).cut_short();
            assert!(back.is_cut_short() && !out(before).is_cut_short() && !back.is_home());
            assert_eq!((out(before).moved, back.moved), (before + 1, 0));
            // A mark after 64, 128, 256 and so on moves, each of which finds rounds that end before the next.
            for (columns, rows, moves) in
                [(2, 2, 64 + 4), (17, 16, 64 + 62), (17, 17, 128 + 64), (50, 20, 256 + 136)]
            {
                assert_eq!(given_up_after(back, columns, rows), moves, "after {before}");
            }
        }
    }
}

//! The note that one sensor stores for agents that search in trees, in 48 bits.

use core::hash::{Hash, Hasher};

use crate::floor::{Floor, Mark};
use crate::ground::{Cell, Side};

/// The state of a cell's exploration.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Default)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum State {
    /// No agent has been in it.
    #[default]
    Unexplored,
    /// Agents have been in it, and it belongs to no tree.
    Explored,
    /// It belongs to a tree.
    Open,
    /// It is done with: nobody needs to go through it again.
    Visited,
}

/// The name of a tree. No two trees have the same, and of trees that meet the one with the greater label grows.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Default)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Label(u32);

impl Label {
    /// How many trees an agent can found: as many as the largest layout has cells, since no cell is founded on twice.
    pub const TREES: u32 = 1 << 24;

    /// The label of the tree that the agent `id` founds after so many others; `None` after [`Label::TREES`]. Earlier
    /// trees have greater labels.
    pub const fn new(founded: u32, id: u8) -> Option<Self> {
        if founded < Self::TREES { Some(Self((Self::TREES - 1 - founded) << 8 | id as u32)) } else { None }
    }

    /// So many bits of it, the lowest ones.
    #[must_use]
    pub const fn lowest(self, bits: u8) -> Self {
        match 1_u32.checked_shl(bits as u32) {
            Some(end) => Self(self.0 & (end - 1)),
            None => self,
        }
    }

    /// The label as a number.
    pub const fn number(self) -> u32 {
        self.0
    }
}

/// The memory of one sensor.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug, Default)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Note {
    /// The state of the cell's exploration.
    pub state: State,
    /// Of an open cell, the tree that it belongs to.
    pub label: Label,
    /// Of an open cell, the side of its parent, if it is not the root; of a visited one the side that leads to where
    /// more was left to do, if there was.
    pub side: Option<Side>,
    /// How many times an agent has entered; it stays at [`Note::MOST_CROSSINGS`].
    pub crossings: u16,
    /// Of an open cell, how many cells are on its way to the root, where that is stored ([`Condition::Restores`]).
    ///
    /// [`Condition::Restores`]: super::Condition::Restores
    pub depth: u32,
}

impl Note {
    /// The bits that a sensor stores: 2 for the state, 32 for the label, 3 for the side, 11 for the crossings.
    pub const BITS: u32 = 48;

    /// The bits that a sensor stores which stores its depth, too: 24 for it, and 24 for the label.
    pub const BITS_WITH_DEPTH: u32 = Self::BITS - 8 + 24;

    /// The greatest number of crossings that fits.
    pub const MOST_CROSSINGS: u16 = (1 << 11) - 1;

    /// The cell as other schemes name it: one of a tree is explored.
    pub const fn mark(self) -> Mark {
        match self.state {
            State::Unexplored => Mark::Unexplored,
            State::Explored | State::Open => Mark::Explored,
            State::Visited => Mark::Visited,
        }
    }

    /// Whether an agent has just placed it, and no other has been here since.
    pub const fn is_new(self) -> bool {
        self.crossings == 1
    }

    /// Whether the cell, beyond `side` of another, is a child of that one.
    pub fn is_child_beyond(self, side: Side) -> bool {
        self.state == State::Open && self.side == Some(side.opposite())
    }

    /// The label, if the cell belongs to a tree.
    pub fn tree(self) -> Option<Label> {
        (self.state == State::Open).then_some(self.label)
    }

    /// The note of a cell of the tree `label`, with its parent beyond `side`.
    #[must_use]
    pub const fn of_tree(self, label: Label, side: Option<Side>) -> Self {
        Self { state: State::Open, label, side, ..self }
    }

    /// This note at `depth` in its tree, at most as deep as fits.
    #[must_use]
    pub const fn at_depth(self, depth: u32) -> Self {
        Self { depth: if depth < Label::TREES { depth } else { Label::TREES - 1 }, ..self }
    }

    /// The note of a cell that is done with, `side` leading to where more is left to do.
    #[must_use]
    pub const fn visited(self, side: Option<Side>) -> Self {
        Self { state: State::Visited, label: Label(0), side, depth: 0, ..self }
    }

    /// The note once one agent more has entered.
    pub(super) fn entered(self) -> Self {
        let state = match self.state {
            State::Unexplored => State::Explored,
            state @ (State::Explored | State::Open | State::Visited) => state,
        };
        Self { state, crossings: Self::MOST_CROSSINGS.min(self.crossings + 1), ..self }
    }

    /// All that it stores but its depth, in the lowest [`Note::BITS`] bits.
    pub const fn to_bits(self) -> u64 {
        let side = match self.side {
            None => 0,
            Some(side) => 1 + side as u64,
        };
        self.state as u64 | side << 2 | (self.crossings as u64) << 5 | (self.label.0 as u64) << 16
    }

    /// The sensor that stores `bits`, and no depth; `None` if no sensor does.
    pub fn from_bits(bits: u64) -> Option<Self> {
        const STATES: [State; 4] = [State::Unexplored, State::Explored, State::Open, State::Visited];
        let state = STATES[(bits & 0b11) as usize];
        let side = match bits >> 2 & 0b111 {
            0 => None,
            side @ 1..=4 => Some(Side::ALL[side as usize - 1]),
            _ => return None,
        };
        if bits >> Self::BITS != 0 {
            return None;
        }
        Some(Self {
            state,
            label: Label((bits >> 16) as u32),
            side,
            crossings: (bits >> 5) as u16 & Self::MOST_CROSSINGS,
            depth: 0,
        })
    }
}

/// In two words, not field by field: searches spend much of their time hashing floors.
impl Hash for Note {
    fn hash<H: Hasher>(&self, hasher: &mut H) {
        hasher.write_u64(self.to_bits());
        hasher.write_u32(self.depth);
    }
}

/// Puts agents into the cells where they start.
pub fn settle(floor: &mut impl Floor<Note>, starts: &[Cell]) {
    for &start in starts {
        let note = floor.sensor(start).unwrap_or_default();
        floor.put(start, note.entered());
    }
}

#[cfg(test)]
mod tests {
    use super::super::Rule;
    use super::*;

    #[test]
    fn a_note_fits_into_its_bits_and_comes_back() {
        let full = Note {
            state: State::Open,
            label: Label(u32::MAX),
            side: Some(Side::North),
            crossings: Note::MOST_CROSSINGS,
            depth: 0,
        };
        assert_eq!(full.to_bits() >> Note::BITS, 0);
        for note in [full, full.visited(None), Note::default().entered(), Note::default()] {
            assert_eq!(Note::from_bits(note.to_bits()), Some(note));
        }
        assert_eq!((full.entered(), Note::from_bits(1 << Note::BITS)), (full, None));
        assert_eq!(Note::from_bits(7 << 2), None);
    }

    #[test]
    fn a_sensor_counts_who_enters_up_to_what_fits() {
        let mut note = Note::default();
        for entered in 1..=Note::MOST_CROSSINGS {
            note = note.entered();
            assert_eq!((note.crossings, note.is_new()), (entered, entered == 1));
        }
        assert_eq!(note.entered(), note);
    }

    #[test]
    fn a_depth_fits_into_the_bits_that_a_shorter_label_leaves() {
        let label = Label(u32::MAX).lowest(Rule::DOUBTING.label_bits);
        let deepest = Note::default().of_tree(label, None).at_depth(u32::MAX);
        let bits = u32::BITS - deepest.depth.leading_zeros() + u32::BITS - label.number().leading_zeros();
        assert_eq!((Note::BITS_WITH_DEPTH, Note::BITS - u32::BITS + bits), (64, 64));
        assert_eq!(deepest.visited(None).depth, 0);
    }

    #[test]
    fn no_two_trees_have_the_same_label_and_the_earlier_one_has_the_greater() {
        let label = |founded, id| Label::new(founded, id).expect("a label");
        assert!(label(0, 0) > label(1, 255) && label(0, 1) > label(0, 0));
        assert_eq!(label(Label::TREES - 1, 0).number(), 0);
        assert_eq!(Label::new(Label::TREES, 0), None);
    }
}

//! The rule of a pack as a set of named conditions, how far its robots see, and how far they hear each other.

use super::sight::Sight;
use crate::error::sentences;
use crate::ground::{Cell, Circle};

crate::conditions! {
    /// A condition of the rule.
    pub enum Condition of Rule in u16 {
        /// A robot takes a step only if the team is connected after it: the links join all robots, so they have a
        /// spanning tree.
        Connect,
        /// Two robots have a link only if all four corners of the cell of the one are within R_c of the midpoint of the
        /// cell of the other; else, as the paper defines it, if the midpoints are.
        Corners,
        /// A robot enters no cell in which another robot is.
        Single,
        /// A team of which no robot can take its step follows one robot, the leader, to a frontier cell.
        Lead,
        /// If nobody can follow the leader, the team takes its last team moves back; at last, side by side, it goes on
        /// as a caterpillar.
        Back,
        /// Each time for the same frontier cell it takes twice as many back.
        Double,
        /// After a team move is taken back each robot looks for its way anew: the one that it knew began elsewhere.
        Anew,
    }
}

/// A pack's conditions, and how far its robots see and hear.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Rule {
    conditions: Conditions,
    sight: Sight,
    range_cells: u16,
}

/// Why robots cannot see or hear so far.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum RangeError {
    /// A robot sees from 1 to [`Sight::MOST_CELLS`] cells far.
    Sight,
    /// Robots hear each other from [`Rule::LEAST_RANGE_CELLS`] cells on.
    Range,
}

sentences!(RangeError {
    Self::Sight => "a robot of a pack sees from 1 to {} cells far", Sight::MOST_CELLS;
    Self::Range => "robots of a pack hear each other {} cells far or more", Rule::LEAST_RANGE_CELLS;
});

impl Rule {
    /// R_s where nobody says otherwise; the paper gives none.
    pub const SIGHT_CELLS: u8 = 20;
    /// R_c where nobody says otherwise; the paper gives none.
    pub const RANGE_CELLS: u16 = 60;
    /// The least R_c. With 2 cells a link joins cells side by side alone, and
    /// no robot of two can take a step by itself.
    pub const LEAST_RANGE_CELLS: u16 = 3;

    /// The definitions and no more: each robot goes to its frontier cell with the greatest metric gain, and waits where
    /// its step would cut a link by midpoints or lead into another robot's cell.
    pub const PUBLISHED: Self = Self {
        conditions: Conditions::of(&[Condition::Connect, Condition::Single]),
        sight: Sight::of(Self::SIGHT_CELLS),
        range_cells: Self::RANGE_CELLS,
    };

    /// With four corners, and a leader where nobody can go on.
    pub const REPAIRED: Self = Self { conditions: Conditions::of(&Condition::ALL), ..Self::PUBLISHED };

    /// These conditions for robots that see and hear so far.
    ///
    /// # Errors
    /// [`RangeError`] if robots cannot.
    pub const fn within(self, sight_cells: u16, range_cells: u16) -> Result<Self, RangeError> {
        let Some(sight) = Sight::new(sight_cells) else { return Err(RangeError::Sight) };
        if range_cells < Self::LEAST_RANGE_CELLS {
            return Err(RangeError::Range);
        }
        Ok(Self { sight, range_cells, ..self })
    }

    /// How far its robots see.
    pub const fn sight(&self) -> &Sight {
        &self.sight
    }

    /// How far its robots hear each other: R_c, in cells.
    pub const fn range_cells(&self) -> u16 {
        self.range_cells
    }

    /// Whether a robot may enter a cell while others are in these cells.
    pub fn admits_entry(&self, to: Cell, mut others: impl Iterator<Item = Cell>) -> bool {
        !self.has(Condition::Single) || others.all(|other| other != to)
    }

    /// Whether robots in these cells have a link.
    pub const fn links(&self, one: Cell, other: Cell) -> bool {
        let circle = Circle::new(4 * (self.range_cells as u64) * (self.range_cells as u64));
        if self.has(Condition::Corners) { circle.covers(one, other) } else { circle.reaches(one, other) }
    }
}

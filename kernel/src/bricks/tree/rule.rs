//! The rule of agents that search in trees, as a set of named conditions.

use crate::conditions;

conditions! {
    /// One condition of the rule, by the sentence it stands for.
    pub enum Condition of Rule in u16 {
        /// An agent marks its cell as soon as the cell does not block (BRICKS-1), and a cell joins a tree only if it
        /// blocks.
        Bricks,
        /// A cell that has a child is not marked.
        Childless,
        /// A cell of a tree is marked only if all cells of trees beside it are of its own.
        OneLabel,
        /// A cell becomes another one's child only if it belongs to no tree, or to one with a lower label.
        LowerOnly,
        /// A cell that is marked says which side leads to where more is left to do.
        Exit,
        /// Robustness: an agent remembers which cells around it have sensors. What reads as unexplored and is none it
        /// scans again.
        Remembers,
        /// Robustness: an agent that has come into a cell places a sensor only if there is none underfoot.
        Underfoot,
        /// Robustness: a cell of a tree stores how deep it is, and one whose children are less deep than its own
        /// children would be, or have a greater label, has been replaced: it is made their parent again.
        Restores,
    }
}

/// The rule of a team of agents.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Rule {
    /// The conditions in force.
    pub conditions: Conditions,
    /// The lowest bits of a label that a sensor stores.
    pub label_bits: u8,
    /// How many scans in a row must miss a cell's sensor before the agent takes the cell for unexplored; from 1 to
    /// [`Rule::MOST_READINGS`].
    pub readings: u8,
}

impl Rule {
    /// Brick-tree, for sensors that are not missed.
    pub const TREE: Self = Self {
        conditions: Conditions::of(&[
            Condition::Bricks,
            Condition::Childless,
            Condition::OneLabel,
            Condition::LowerOnly,
            Condition::Exit,
        ]),
        label_bits: 32,
        readings: 1,
    };

    /// Depth first search with helpers, for sensors that are not missed.
    pub const HELPERS: Self = Self::TREE.without(Condition::Bricks);

    /// Helpers, robust against missed sensors.
    pub const ROBUST: Self = Self::HELPERS.with(Condition::Remembers).with(Condition::Underfoot);

    /// Helpers that place sensors unasked, as the paper's agents do, and doubt what
    /// they miss: being done is likely to be right.
    pub const DOUBTING: Self = Self {
        label_bits: 24,
        readings: 3,
        ..Self::HELPERS.with(Condition::Remembers).with(Condition::Restores)
    };

    /// The most scans that an agent counts for a cell.
    pub const MOST_READINGS: u8 = 4;

    /// The rule with so many readings.
    #[must_use]
    pub const fn reading(self, readings: u8) -> Self {
        Self { readings, ..self }
    }
}

//! The rule of Brick&Mortar as a set of named conditions.

use crate::conditions;
use crate::floor::SensorFate;

conditions! {
    /// One condition of the rule, by the sentence it stands for.
    pub enum Condition of Rule in u16 {
        /// Two side neighbours are connected past the cell only if the corner between them can be gone through.
        Corners,
        /// Repair: an agent marks its cell as visited only if no other agent is in it or on its way into it.
        Alone,
        /// Repair: an agent that can neither mark its cell nor see an unexplored one walks laps and shuts sides.
        Laps,
        /// Repair: of several explored neighbours an agent goes to the one that was entered least, as Ants does.
        LeastCrossed,
        /// Robustness: an agent that has nowhere to go, or finds nothing, goes over the visited cells again and seals
        /// them. It is done when there is nothing left to seal.
        SecondPass,
        /// Robustness: in the second pass, what reads as unexplored may be a missed sensor, so no connection goes
        /// through it.
        SeenOnly,
    }
}

/// Whose lap is void when an agent on a lap comes to the cell where another's began.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Precedence {
    /// That of the agent with the lower id.
    Higher,
    /// Neither.
    Nobody,
    /// Both.
    Everybody,
}

/// The rule of a team of agents.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Rule {
    /// The conditions in force.
    pub conditions: Conditions,
    /// How laps that meet are told apart.
    pub precedence: Precedence,
    /// Moves without any gain before an agent goes round, under [`Condition::LeastCrossed`].
    pub patience: u8,
    /// Moves after which the first lap is cut short, under [`Condition::Laps`].
    pub reach: u8,
    /// The fate of a missed sensor where a new one is placed. Under [`Condition::SecondPass`] it is lost.
    pub replaced: SensorFate,
}

impl Rule {
    /// The rule as the paper publishes it: no loop closure.
    pub const PUBLISHED: Self = Self {
        conditions: Conditions::of(&[Condition::Corners]),
        precedence: Precedence::Higher,
        patience: 32,
        reach: 255,
        replaced: SensorFate::Lost,
    };

    /// With loop closure.
    pub const REPAIRED: Self = Self {
        conditions: Conditions::of(&[
            Condition::Corners,
            Condition::Alone,
            Condition::Laps,
            Condition::LeastCrossed,
        ]),
        ..Self::PUBLISHED
    };

    /// With loop closure, robust against missed sensors.
    pub const ROBUST: Self = Self::REPAIRED.with(Condition::SecondPass).with(Condition::SeenOnly);

    /// Moves without gain before the second pass: each counts one up, and a gain in the first pass a little down.
    pub(super) const fn hope(self) -> u16 {
        4 * self.patience as u16
    }
}

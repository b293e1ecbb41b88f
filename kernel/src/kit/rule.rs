//! KIT's rule as a set of named conditions, with what the paper leaves open as parameters. The first condition is the
//! paper's; the others repair contact, collisions, deadlocks, coverage and the end of a run.

use super::stance::{Reach, Stance};
use crate::conditions;

conditions! {
    /// One condition of the rule, by the sentence it stands for.
    pub enum Condition of Rule in u16 {
        /// A robot drives to a node in reach of the node where the other one goes (section 4).
        NextInReach,
        /// Repair: and in reach of the node that the other one has left, so that both hear each other at any speeds.
        FromInReach,
        /// Repair: it never drives to either end of the other one's path.
        Apart,
        /// Repair: a robot for which no side is admitted stays; as published it takes the one that leads nearest to the
        /// other.
        Stays,
        /// Repair: only the robot whose turn it is decides. The turn passes on request, when it drives or stays.
        Turn,
        /// Repair: a robot without an admitted uncovered side drives its part of the shortest joint way to one.
        Regroup,
        /// Repair: a side that is seen blocked counts as covered, and all know.
        Marked,
        /// Repair: while another one drives a new path, it may go alone to an uncovered side, the others where they go.
        Meanwhile,
        /// Repair: the four messages have four flags, where the paper has three.
        Flags,
        /// Repair: a request without an answer is repeated, and numbered so that what comes late or twice does no harm.
        Repeats,
        /// Repair, of three robots and more: a robot looks at an unknown side where another one stands. If it sees that
        /// one, the path is known to be free.
        Beside,
        /// Repair, of three robots and more: those that known paths within one field of nodes join, directly or over
        /// others, stay so.
        Tether,
        /// Repair, of three robots and more: where none can come to an uncovered side alone, the nearest to one leads
        /// and the others draw together behind it.
        Caravan,
        /// Repair, of three robots and more: where both ends of an uncovered path are taken, robots shift to a free
        /// node.
        MakesRoom,
    }
}

/// Where a robot runs KIT.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Runs {
    /// At every node.
    Every,
    /// Only where the way ahead is blocked: else it drives straight on (section 3).
    Ahead,
}

/// Whose records tell a robot which sides of its node are covered.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Records {
    /// Its own and the others'.
    Union,
    /// The others' alone.
    Others,
}

/// Which side a robot takes that does not stay although no side is left that is uncovered and in reach.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Fallback {
    /// The one that leads nearest to where the other one goes (section 4).
    Nearest,
    /// Of those that the conditions admit the one that leads nearest to where the
    /// other one goes: if none is left, it stays.
    Admitted,
    /// Any.
    Random,
}

/// Where the conditions on the next node are looked at.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Filter {
    /// Wherever a robot drives, but in the paper's fallback.
    Everywhere,
    /// On a path that was driven before only: a mutant.
    OldPaths,
}

/// When a robot answers a request.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Answers {
    /// While it drives (section 5); under [`Condition::Turn`] also while it stays.
    Driving,
    /// Whatever it does: a mutant.
    Always,
    /// While it drives; and the second robot also while it asks itself, so that the first one goes first: a mutant.
    FirstGoesFirst,
}

/// The rule of a team.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Rule {
    /// The conditions in force.
    pub conditions: Conditions,
    /// Where a robot runs KIT.
    pub runs: Runs,
    /// Whose records count.
    pub records: Records,
    /// The robot's action without [`Condition::Stays`].
    pub fallback: Fallback,
    /// Where the conditions on the next node are looked at.
    pub filter: Filter,
    /// When a robot answers.
    pub answers: Answers,
    /// How far robots hear each other.
    pub reach: Reach,
}

impl Rule {
    /// The rule as the paper publishes it, by our main readings.
    pub const PUBLISHED: Self = Self {
        conditions: Conditions::of(&[Condition::NextInReach]),
        runs: Runs::Every,
        records: Records::Union,
        fallback: Fallback::Nearest,
        filter: Filter::Everywhere,
        answers: Answers::Driving,
        reach: Reach::PAPER,
    };

    /// As published, read by the words of section 3: a robot drives straight on, and runs KIT where the way ahead is
    /// blocked.
    pub const AHEAD: Self = Self { runs: Runs::Ahead, ..Self::PUBLISHED };

    /// With all repairs.
    pub const REPAIRED: Self =
        Self { conditions: Conditions::of(&Condition::ALL), ..Self::PUBLISHED }.without(Condition::Repeats);

    /// With all repairs, in a network that loses messages.
    pub const ROBUST: Self = Self::REPAIRED.with(Condition::Repeats);

    /// Whether robots with these stances count as sure to hear each other.
    pub fn hears(&self, one: Stance, other: Stance) -> bool {
        let next = self.reach.joins(one.to(), other.to());
        let from = self.reach.joins(one.from(), other.to())
            && self.reach.joins(one.to(), other.from())
            && self.reach.joins(one.from(), other.from());
        (next || !self.has(Condition::NextInReach)) && (from || !self.has(Condition::FromInReach))
    }

    /// Whether a robot may drive `path` for all that it may come too near to one with the stance `other`.
    pub fn keeps_apart(&self, path: Stance, other: Stance) -> bool {
        !self.has(Condition::Apart) || !other.has(path.to())
    }
}

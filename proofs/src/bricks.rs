//! Brick&Mortar (BRICKS): what is promised of agents that mark cells, over every neighbourhood and over all states on
//! small floors.

pub mod clauses;
mod floors;
mod marking;
mod team;
pub mod tree;
mod walk;

use tautline_kernel::bricks::{Condition, Rule};

/// How the observer of a mutant is deceived.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Deception {
    /// Not at all.
    None,
    /// Agents beside each other scan and write at once.
    ActsAtOnce,
    /// Sensors are localised with errors of more than half a cell.
    LocalisesBadly,
    /// An agent does not see the corners around it.
    MissesCorners,
}

/// Agents that are observed.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Observed {
    /// The rule that they follow.
    pub rule: Rule,
    /// What is done to them behind their back.
    pub deception: Deception,
}

impl Observed {
    /// Agents that follow `rule`.
    pub const fn marking(rule: Rule) -> Self {
        Self { rule, deception: Deception::None }
    }

    /// Agents that follow the robust rule without one condition.
    pub const fn marking_twice_without(condition: Condition) -> Self {
        Self::marking(Rule::ROBUST.without(condition))
    }

    /// Agents that follow the repaired rule, deceiving.
    pub const fn deceiving(deception: Deception) -> Self {
        Self { rule: Rule::REPAIRED, deception }
    }
}

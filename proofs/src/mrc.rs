//! MRC (MRC): what is promised of robots and of those that wait for rescue, under a network that misbehaves.

pub mod chart;
pub mod clauses;
mod records;
pub mod space;
mod state;
mod within;

use tautline_kernel::mrc::Rule;

pub use state::{Action, Actor, Demand, Faults, Leases, LossKind, Message, ROBOTS, Setting, State, WFRS};

/// How a message is misread where it arrives.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Misreading {
    /// A path node takes all robots for one.
    OneRobot,
    /// A path node takes all calls of a WFR for one.
    OneCall,
}

/// Robots and WFRs that are observed.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Subject {
    /// The rule that they follow.
    pub rule: Rule,
    /// How they misread what they hear, as a mutant does.
    pub misread: Option<Misreading>,
}

impl Subject {
    /// Robots and WFRs that follow `rule`.
    pub const fn rescuing(rule: Rule) -> Self {
        Self { rule, misread: None }
    }

    /// The repaired rule, misreading.
    pub const fn misreading(misread: Misreading) -> Self {
        Self { rule: Rule::REPAIRED, misread: Some(misread) }
    }
}

//! MRC (MRC): what is promised of robots and of those that wait for rescue, under a network that misbehaves.

pub mod chart;
pub mod clauses;
mod reading;
mod records;
pub mod space;
mod state;
mod within;

use tautline_kernel::mrc::Rule;

pub use reading::{Records, RobotReading, Service, Start};
pub use state::{Action, Actor, Demand, Faults, Leases, LossKind, Message, ROBOTS, Setting, State, WFRS};

/// How a message is misread where it arrives, as a mutant does.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Misreading {
    /// A path node takes all robots for one.
    OneRobot,
    /// A path node takes all calls of a WFR for one.
    OneCall,
    /// A WFR that calls anew takes who has asked under the call before for who asks under this one.
    Askers,
    /// A robot on its way takes another WFR's choice for that of the one to which it goes.
    Offers,
    /// A robot whose records are full takes a new WFR's call for the end of its way.
    Ends,
    /// A robot that asks and a WFR that has chosen take an answer for none.
    Answers,
}

/// Robots and WFRs that are observed.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Subject {
    /// The rule that they follow.
    pub rule: Rule,
    /// How they misread what they hear.
    pub misread: Option<Misreading>,
    /// How robots read the paper.
    pub reading: RobotReading,
}

impl Subject {
    /// Robots and WFRs that follow `rule`.
    pub const fn rescuing(rule: Rule) -> Self {
        Self { rule, misread: None, reading: RobotReading::PUBLISHED }
    }

    /// The repaired rule, misreading.
    pub const fn misreading(misread: Misreading) -> Self {
        Self { misread: Some(misread), ..Self::rescuing(Rule::REPAIRED) }
    }
}

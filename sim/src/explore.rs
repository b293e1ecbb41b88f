//! Exploration: a scheme is a row in the [`Catalogue`], a [`Setup`] is a run of it before its start, and [`explore`]
//! makes the run. Every team move becomes a [`Frame`](tautline_proofs::run::Frame) and is checked for the sentences of
//! `SPEC.md` that the scheme is bound to. A team that is in no catalogue is run by [`run`].

pub mod agents;
pub mod ants;
mod bounds;
pub mod bricks;
mod by_layout;
mod catalogue;
pub mod chain;
mod clause;
mod connectivity;
pub mod depth_first;
mod features;
pub mod floor;
pub mod frontier;
pub mod hunt;
mod hunt_states;
pub mod judge_input;
pub mod kit;
mod own;
mod own_rule;
pub mod pack;
mod rule;
mod run;
mod scan_time;
mod scene;
mod scheme;
mod script;
mod setup;
mod states;
mod survey;
mod switches;
mod team;

pub use self::clause::ClauseId;
pub use self::connectivity::{has_double, unlinked};
pub use self::features::{By, Completeness, Knowledge, Look, RandomPart, Senses, Starts};
pub use self::own::Own;
pub use self::own_rule::OwnRule;
pub use self::rule::{RuleId, RuleName};
pub use self::run::{
    Course, CourseMove, Limits, Milestone, OnViolation, Report, StopReason, TeamMove, Violation, Watcher, run,
};
pub use self::scene::{
    Change, Hearers, Ink, Joins, Kind, Layer, Mark, Place, Refusal, Scene, Shape, Value, Zone,
};
pub use self::scheme::{Catalogue, Clause, Profile, Rule, Scheme, Setup, Start, Switches, WriteCase};
pub use self::setup::{ExplorationRequest, Play, explore, team};
pub use self::survey::Survey;
pub use self::team::{End, Reach, Surroundings, Team};

tautline_io::written_as! { ClauseId as str, Profile as str, Scheme as str, RuleId as str }

/// The schemes of this library. A program may have others, too.
pub const SCHEMES: &[&Profile] = &[
    &chain::CHAIN,
    &ants::ANTS,
    &bricks::BRICKS,
    &bricks::BRICKS_ANTS,
    &depth_first::MDFS,
    &depth_first::HELPERS,
    &kit::KIT,
    &frontier::FRONTIER,
    &pack::PACK,
];

impl Catalogue {
    /// The schemes of this library and no others.
    pub const OWN: Self = Self(&[SCHEMES]);
}

impl From<&'static Profile> for Scheme {
    fn from(row: &'static Profile) -> Self {
        Self { row, among: Catalogue::OWN }
    }
}

//! Exploration: a scheme is a row in the [`catalogue`], a [`Setup`] is a run of it before its start, and [`explore`]
//! makes the run. Every team move becomes a [`Frame`](tautline_proofs::run::Frame) and is checked for the sentences of
//! `SPEC.md` that the scheme is bound to. A team that is in no catalogue is run by [`run`].

pub mod agents;
pub mod ants;
pub mod bricks;
mod by_layout;
pub mod catalogue;
pub mod chain;
mod clause;
mod connectivity;
mod course;
pub mod depth_first;
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
mod script;
mod setup;
mod states;

pub use self::catalogue::{
    By, Catalogue, Completeness, Knowledge, Look, Profile, RandomPart, Scheme, Senses, Starts,
};
pub use self::clause::{Clause, ClauseId};
pub use self::connectivity::{has_double, unlinked};
pub use self::course::{Course, CourseMove};
pub use self::own::Own;
pub use self::own_rule::OwnRule;
pub use self::rule::{Rule, RuleId, RuleName, Start, Switches};
pub use self::run::{
    End, Limits, Milestone, OnViolation, Reach, Report, StopReason, Surroundings, Survey, Team, TeamMove,
    Violation, Watcher, run,
};
pub use self::scene::{
    Change, Hearers, Ink, Joins, Kind, Layer, Mark, Place, Refusal, Scene, Shape, Value, Zone,
};
pub use self::setup::{ExplorationRequest, Play, Setup, explore, team};

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

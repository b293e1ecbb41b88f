//! Exploration: a scheme is a row in the [`catalogue`], a [`Setup`] is a run of it before its start, and [`explore`]
//! makes the run. Every team move becomes a [`Frame`](tautline_proofs::run::Frame) and is checked for the sentences of
//! `SPEC.md` that the scheme is bound to. A team that is in no catalogue is run by [`run`].

pub mod agents;
pub mod ants;
pub mod bricks;
pub mod catalogue;
pub mod chain;
mod clause;
pub mod depth_first;
mod each;
mod fit;
pub mod floor;
pub mod frontier;
pub mod hunt;
mod hunt_states;
pub mod kit;
mod own;
pub mod pack;
mod rule;
mod run;
mod scan_time;
mod scene;
mod setup;
mod states;
mod survey;

pub use self::catalogue::{Catalogue, Scheme};
pub use self::clause::ClauseId;
pub use self::own::Own;
pub use self::rule::{RuleId, RuleName};
pub use self::run::{
    End, Limits, Milestone, OnViolation, Report, Stopped, Team, TeamMove, Violation, Watcher, run,
};
pub use self::scene::{Change, Hearers, Ink, Joins, Kind, Layer, Place, Scene, Shape, Value, Zone};
pub use self::setup::{
    Asked, By, Clause, Drawn, Judge, Knowledge, Look, Play, Profile, Rule, Senses, Setup, Start, Starts,
};
pub use self::survey::Survey;

use tautline_kernel::ground::Cell;

use crate::diagnostic::{Diagnostic, Halt};

/// The team of `setup` at its start.
///
/// # Errors
/// A [`Diagnostic`] if the setup does not fit its scheme.
pub fn team(setup: &Setup) -> Result<Box<dyn Team>, Diagnostic> {
    (setup.check()?.start)(setup)
}

/// Runs `setup`. `watch` sees every team move, and may stop the run for good.
///
/// # Errors
/// [`Halt`] if the setup does not fit its scheme, or whatever `watch` returned.
pub fn explore(setup: &Setup, watch: &mut Watcher<'_>) -> Result<Report, Halt> {
    run(&mut *team(setup)?, &setup.layout, setup.limits, watch)
}

impl Play for Setup {
    fn setup(&self) -> &Setup {
        self
    }

    fn play(&self, watch: &mut Watcher<'_>) -> Result<Report, Halt> {
        explore(self, watch)
    }

    fn told(&self, clause: ClauseId, chart: &Survey, made: &TeamMove<'_>) -> Vec<String> {
        self.scheme.clause(clause).map_or_else(Vec::new, |clause| (clause.told)(self, chart, made))
    }

    fn missed(&self, clause: ClauseId, chart: &Survey) -> Option<(&'static str, Vec<Cell>)> {
        let words = self.scheme.clause(clause)?.missed?;
        Some((words, team(self).ok()?.missed(&self.layout, chart)))
    }
}

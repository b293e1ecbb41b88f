//! Agents of a scheme under one of its rules, and the outcome of a run of theirs.

use std::fmt;

use tautline_kernel::bricks::tree;
use tautline_kernel::floor::SensorFate;
use tautline_kernel::ground::Cell;
use tautline_kernel::{ants, bricks};
use tautline_proofs::bricks::tree::mdfs::Mdfs;
use tautline_proofs::floor::crew::Scheme;

use super::super::prelude::*;
use tautline_grids::chance::Probability;
use tautline_sim::explore::agents as explore;
use tautline_sim::explore::ants::ANTS;
use tautline_sim::explore::bricks::{BRICKS, BRICKS_ANTS};
use tautline_sim::explore::depth_first::{HELPERS, MDFS};
use tautline_sim::explore::floor::Component;
use tautline_sim::explore::{Profile, RuleId};

/// A scheme under one of its rules.
#[derive(Clone, Copy, Debug, JsonSchema, Serialize)]
pub struct Team {
    /// The scheme.
    pub scheme: &'static Profile,
    /// Its rule.
    pub rule: RuleId,
    #[serde(skip)]
    pub(in crate::tables) crew: &'static dyn Crew,
}

/// Agents of a scheme that can be run.
pub(in crate::tables) trait Crew: fmt::Debug + Sync {
    /// A run of agents that start in these cells of `layout`, of at most so many steps of all of them.
    fn run(&self, layout: &Layout, starts: &[Cell], chance: Chance, max_steps: u32) -> Outcome;
}

/// How likely a sensor is missed, and the seed of what is left to chance.
type Chance = (Probability, u64);

impl<S: Scheme> Crew for S {
    fn run(&self, layout: &Layout, starts: &[Cell], (miss, seed): Chance, max_steps: u32) -> Outcome {
        let mut team = explore::Agents::new(*self, layout, starts, miss, seed);
        let (mut team_moves, mut steps, mut exploration, mut is_early) = (0, 0, None, false);
        let now =
            |team: &explore::Agents<S>, team_moves| Moment { team_moves, milliseconds: team.milliseconds() };
        while !team.is_over() && steps < max_steps {
            team_moves += 1;
            steps += u32::from(team.whole().active);
            team.advance();
            is_early |= team.is_premature();
            let whole = team.whole();
            if exploration.is_none() && whole.explored == whole.cells {
                exploration = Some(now(&team, team_moves));
            }
        }
        let Component { cells, explored, visited, active, .. } = team.whole();
        Outcome {
            cells,
            explored,
            visited,
            exploration,
            termination: (active == 0).then(|| now(&team, team_moves)),
            is_ended: !team.is_over(),
            is_early,
        }
    }
}

impl PartialEq for Team {
    fn eq(&self, other: &Self) -> bool {
        (self.scheme, self.rule) == (other.scheme, other.rule)
    }
}

impl Team {
    const fn new(scheme: &'static Profile, rule: RuleId, crew: &'static dyn Crew) -> Self {
        Self { scheme, rule, crew }
    }

    /// Its name: the scheme, with its rule where that is not the repaired one.
    pub fn name(self) -> String {
        match self.rule {
            RuleId::REPAIRED => self.scheme.name.to_owned(),
            rule => format!("{} ({rule})", self.scheme.name),
        }
    }
}

/// The teams that are compared.
pub const TEAMS: [Team; 7] = [
    Team::new(&BRICKS, RuleId::REPAIRED, &bricks::Rule::REPAIRED),
    Team::new(&BRICKS_ANTS, RuleId::REPAIRED, &bricks::Rule::ROBUST),
    Team::new(&ANTS, RuleId::REPAIRED, &ants::Rule::Repaired),
    Team::new(&ANTS, RuleId::PUBLISHED, &ants::Rule::PUBLISHED),
    Team::new(&BRICKS, RuleId::new("tree"), &tree::Rule::TREE),
    Team::new(&HELPERS, RuleId::REPAIRED, &tree::Rule::ROBUST),
    Team::new(&MDFS, RuleId::PUBLISHED, &Mdfs),
];

/// Brick&Mortar as published, without the loop closure that the paper omits: beside the repaired one, whose laps are
/// ours, in the figures of agents.
pub(super) const BRICKS_PUBLISHED: Team = Team::new(&BRICKS, RuleId::PUBLISHED, &bricks::Rule::PUBLISHED);

/// Ants by the other readings of what becomes of a missed sensor, whose old content those of [`TEAMS`] lose.
pub(super) const READINGS: [Team; 2] = [
    Team::new(&ANTS, RuleId::new("beside"), &ants::Rule::Published(SensorFate::Beside)),
    Team::new(&ANTS, RuleId::new("counted"), &ants::Rule::Published(SensorFate::Counted)),
];

/// When something was so.
#[derive(Clone, Copy, PartialEq, Eq, Debug, JsonSchema, Serialize, Deserialize)]
pub(in crate::tables) struct Moment {
    pub(super) team_moves: u32,
    pub(super) milliseconds: u64,
}

/// The outcome of one run.
#[derive(Clone, Copy, PartialEq, Eq, Debug, JsonSchema, Serialize, Deserialize)]
pub struct Outcome {
    pub(in crate::tables) cells: u32,
    pub(super) explored: u32,
    pub(super) visited: u32,
    pub(in crate::tables) exploration: Option<Moment>,
    pub(in crate::tables) termination: Option<Moment>,
    pub(in crate::tables) is_ended: bool,
    /// Whether an agent was done although another cell was unexplored or left to go through.
    pub(in crate::tables) is_early: bool,
}

impl Outcome {
    /// Team moves until a moment of the run, over the lower bound: its cells by its agents.
    pub(in crate::tables) fn ratio(&self, moment: Option<Moment>, agents: u16) -> Option<f64> {
        let bound = f64::from(self.cells) / f64::from(agents);
        moment.map(|moment| f64::from(moment.team_moves) / bound)
    }

    /// The mean of that over the runs that have such a moment.
    pub(in crate::tables) fn ratios(
        all: &[&Self],
        of: fn(&Self) -> Option<Moment>,
        agents: u16,
    ) -> Option<Estimate> {
        mean(all.iter().filter_map(|outcome| outcome.ratio(of(outcome), agents)))
    }
}

//! The teams that the figures compare, and the means of their runs in a family of lattices.

use std::num::NonZeroU32;

use super::super::prelude::*;
use super::drive::{EXPLORED, Outcome, in_percent, until};
use super::lattice::{Family, PATHS};
use tautline_sim::kit::Pace;

/// The rule of a team.
#[derive(Clone, Copy, PartialEq, Eq, Debug, JsonSchema, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum TeamRule {
    /// As published, KIT at every node.
    Published,
    /// As published, KIT only where the way ahead is blocked.
    Ahead,
    /// With the repairs of its refuted claims.
    Repaired,
}

/// Robots under one rule.
#[derive(Clone, Copy, PartialEq, Eq, Debug, JsonSchema, Serialize)]
pub struct Team {
    /// The rule.
    pub rule: TeamRule,
    /// How many.
    pub robots: usize,
}

/// The teams that are compared.
pub const TEAMS: [Team; 7] = [
    Team { rule: TeamRule::Published, robots: 1 },
    Team { rule: TeamRule::Published, robots: 2 },
    Team { rule: TeamRule::Ahead, robots: 1 },
    Team { rule: TeamRule::Ahead, robots: 2 },
    Team { rule: TeamRule::Repaired, robots: 1 },
    Team { rule: TeamRule::Repaired, robots: 2 },
    Team { rule: TeamRule::Repaired, robots: 3 },
];

#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Figure {
    Time,
    Overlap,
}

settings! {
    /// How much is measured.
    #[derive(Copy, Eq)]
    pub struct Settings {
        /// Random layouts of each family
        pub layouts: u32 = 1000, one("runs", "COUNT", from_to(1..=100_000));
        /// The seed of the first layout and its runs; the others have the seeds after it
        pub seed: u64 = 0, one("seed", "SEED", number);
        /// How fast robots drive, in metres a second
        pub speed: NonZeroU32 = Pace::STEADY.speed, thousandths("speed", "METRES", 1..=100_000);
        /// By which share a drive may be faster or slower
        pub spread: u32 = 100, thousandths("spread", "SHARE", 0..=900);
    }
}

/// The whole figure.
#[derive(Clone, PartialEq, Debug, JsonSchema, Serialize)]
pub struct Summary {
    #[serde(flatten)]
    pub(super) settings: Settings,
    /// Family by family, each of all teams.
    pub lines: Vec<Line>,
    /// Two robots against one, and repaired against published, for each family.
    pub races: Vec<Race>,
    /// Two robots as published against two that never talk, for each family.
    pub silence: Vec<Contest>,
    pub(super) paper: Vec<PrintedFigure>,
}

/// A team in a family.
#[derive(Clone, PartialEq, Debug, JsonSchema, Serialize)]
pub struct Line {
    /// The family.
    pub family: &'static str,
    /// The team.
    #[serde(flatten)]
    pub team: Team,
    /// Of the paths explored at 88 %, those driven by one robot alone, in percent; of one robot there is none.
    pub efficiency: Option<Estimate>,
    /// Seconds until 88 % of the paths are explored.
    pub most: Option<Estimate>,
    /// Seconds until all are.
    pub all: Option<Estimate>,
    /// Runs in which a robot was out of contact, in percent.
    pub cut: Option<Estimate>,
    /// Runs that reach 88 %, in percent.
    pub reached: Option<Estimate>,
    /// Paths explored when the run ends, in percent.
    pub explored: Option<Estimate>,
    /// Runs that were ended before all paths were driven, in percent.
    pub ended: Option<Estimate>,
    /// Runs that were ended before all nodes were found, in percent.
    pub lost: Option<Estimate>,
    /// Seconds until each node is found, over the runs that find all.
    pub nodes: Vec<Estimate>,
    /// Directions explored at nodes by then, two for each path that is driven.
    pub directions: Option<Estimate>,
    /// The efficiency when so many paths are explored, from 1 on.
    pub efficiencies: Vec<Estimate>,
}

/// A team against another one.
#[derive(Clone, PartialEq, Debug, JsonSchema, Serialize)]
pub struct Race {
    /// The family.
    pub family: &'static str,
    /// The other one.
    pub other: Team,
    /// The team that is to be sooner.
    pub team: Team,
    /// Seconds by which it finds all nodes sooner, over the layouts in which both do.
    pub gain: Option<Estimate>,
    /// Of these layouts, those in which it is sooner, in percent.
    pub sooner: Option<Estimate>,
    /// Of all layouts, those in which both find all nodes, in percent.
    pub both: Option<Estimate>,
    /// Of all layouts, those in which it finds all nodes sooner, or the other one never does, in percent.
    pub ahead: Option<Estimate>,
    /// Of all layouts, those in which it is the other way round, in percent.
    pub behind: Option<Estimate>,
}

/// Two robots as published against two under the same rule, each by itself, that never talk.
#[derive(Clone, PartialEq, Debug, JsonSchema, Serialize)]
pub struct Contest {
    /// The family.
    pub family: &'static str,
    /// The rule.
    pub rule: TeamRule,
    /// Of all layouts, those in which robots that talk are sooner, or the others never there, in percent: when all
    /// nodes are found where the figure is of time, else when 88 % of the paths are explored.
    pub ahead: Option<Estimate>,
    /// Of all layouts, those in which it is the other way round, in percent.
    pub behind: Option<Estimate>,
}

/// Of all layouts, in percent, those in which the second of two teams is sooner, or the first never there; and those in
/// which it is the other way round.
fn first(all: &[[Option<u64>; 2]]) -> [Option<Estimate>; 2] {
    let is_sooner =
        |one: Option<u64>, other: Option<u64>| one.is_some_and(|one| other.is_none_or(|other| one < other));
    let ahead = in_percent(all, |&[other, team]| is_sooner(team, other));
    [ahead, in_percent(all, |&[other, team]| is_sooner(other, team))]
}

impl Contest {
    pub(super) fn of(
        figure: Figure,
        family: Family,
        rule: TeamRule,
        [silent, team]: [&[&Outcome]; 2],
    ) -> Self {
        let when = |outcome: &Outcome| match figure {
            Figure::Time => outcome.found(family.nodes()),
            Figure::Overlap => outcome.paths.get(EXPLORED - 1).copied(),
        };
        let all: Vec<_> = silent.iter().zip(team).map(|(silent, team)| [when(silent), when(team)]).collect();
        let [ahead, behind] = first(&all);
        Self { family: family.name, rule, ahead, behind }
    }
}

impl Line {
    pub(super) fn of(family: Family, team: Team, outcomes: &[&Outcome]) -> Self {
        let (is_team, all_nodes) = (team.robots > 1, family.nodes());
        let efficiency = |explored| mean(outcomes.iter().filter_map(|outcome| outcome.efficiency(explored)));
        let node = |number: usize| {
            let found = outcomes.iter().filter(|outcome| outcome.found(all_nodes).is_some());
            mean(found.filter_map(|outcome| outcome.nodes.get(number)).map(|&end| seconds(end)))
        };
        let explored = |one: &&Outcome| 100.0 * f64::from(one.paths.len() as u32) / f64::from(PATHS as u32);
        let directions = |outcome: &&Outcome| Some(outcome.directions_by(outcome.found(all_nodes)?));
        Self {
            family: family.name,
            team,
            efficiency: efficiency(EXPLORED).filter(|_| is_team),
            most: until(EXPLORED, outcomes),
            all: until(PATHS, outcomes),
            cut: in_percent(outcomes, |outcome| outcome.is_cut).filter(|_| is_team),
            reached: in_percent(outcomes, |outcome| outcome.paths.len() >= EXPLORED),
            explored: mean(outcomes.iter().map(explored)),
            ended: in_percent(outcomes, |outcome| !outcome.is_whole()),
            lost: in_percent(outcomes, |outcome| outcome.found(all_nodes).is_none()),
            nodes: (0..all_nodes).filter_map(node).collect(),
            directions: mean(outcomes.iter().filter_map(directions)),
            efficiencies: if is_team { (1..=PATHS).filter_map(efficiency).collect() } else { Vec::new() },
        }
    }
}

impl Race {
    pub(super) fn of(family: Family, places: [usize; 2], [other, team]: [&[&Outcome]; 2]) -> Self {
        let found = |outcome: &Outcome| outcome.found(family.nodes());
        let all: Vec<[Option<u64>; 2]> =
            other.iter().zip(team).map(|(other, team)| [found(other), found(team)]).collect();
        let both: Vec<[u64; 2]> = all.iter().filter_map(|&[other, team]| Some([other?, team?])).collect();
        let [ahead, behind] = first(&all);
        let [other, team] = places.map(|place| TEAMS[place]);
        Self {
            family: family.name,
            other,
            team,
            gain: mean(both.iter().map(|&[other, team]| seconds(other) - seconds(team))),
            sooner: in_percent(&both, |[other, team]| team < other),
            both: in_percent(&all, |times| times.iter().all(Option::is_some)),
            ahead,
            behind,
        }
    }
}

//! Agents on the floors of offices [Ferranti 2009, V.B]: how much is explored and marked as visited by Brick&Mortar,
//! Ants and Brick&Mortar with ants' ways where sensors are missed, by the number of agents (Fig. 11) and by the area
//! (Fig. 12); and how long they take where none is (the idealized conditions that the paper takes from its reference
//! 2).
//!
//! Layouts are `office:SIDExSIDE:4x4`, all agents start at the cell nearest the centre, and all teams get the same
//! layouts and seeds. A run that goes on is ended after a number of agents' steps, and counted.

mod charts;
mod text;

use std::fmt;

use tautline_kernel::bricks::tree;
use tautline_kernel::floor::SensorFate;
use tautline_kernel::ground::Cell;
use tautline_kernel::{ants, bricks};
use tautline_proofs::bricks::tree::mdfs::Mdfs;
use tautline_proofs::floor::crew::Scheme;

use super::paper;
use super::prelude::*;
use tautline_grids::chance::Probability;
use tautline_grids::layout::Layout;
use tautline_sim::explore::agents as explore;
use tautline_sim::explore::ants::ANTS;
use tautline_sim::explore::bricks::{BRICKS, BRICKS_ANTS};
use tautline_sim::explore::depth_first::{HELPERS, MDFS};
use tautline_sim::explore::{Knowledge, Profile, RuleId};

/// A scheme under one of its rules.
#[derive(Clone, Copy, Debug, JsonSchema, Serialize)]
pub struct Team {
    /// The scheme.
    pub scheme: &'static Profile,
    /// Its rule.
    pub rule: RuleId,
    #[serde(skip)]
    pub(super) crew: &'static dyn Crew,
}

/// Agents of a scheme that can be run.
pub(super) trait Crew: fmt::Debug + Sync {
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
            steps += team.active();
            team.advance();
            is_early |= team.is_premature();
            if exploration.is_none() && team.explored() == team.due() {
                exploration = Some(now(&team, team_moves));
            }
        }
        Outcome {
            cells: team.due(),
            explored: team.explored(),
            visited: team.visited(),
            exploration,
            termination: (team.active() == 0).then(|| now(&team, team_moves)),
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

/// Ants by the other readings of what becomes of a missed sensor, whose old content those of [`TEAMS`] lose.
const READINGS: [Team; 2] = [
    Team::new(&ANTS, RuleId::new("beside"), &ants::Rule::Published(SensorFate::Beside)),
    Team::new(&ANTS, RuleId::new("counted"), &ants::Rule::Published(SensorFate::Counted)),
];

/// The sensors that the paper's agents miss, of all.
const MISS: Probability = Probability::new(0.0556).expect("a probability");

/// The paper's area, and its team where it varies the area.
const SIDE: u16 = 30;
const AGENTS: u16 = 20;

/// The description that all figures of agents share.
const ABOUT: Description = Description {
    examples: &["bricks-fig11 --svg fig11.svg", "bricks-ideal --runs 20 --format json"],
    doing: "exploring",
    pictures: &[("svg", "Store a chart")],
    ..Description::NOTHING
};

/// Figure 11.
pub const BRICKS_FIG11: Agents = Agents {
    figure: Figure::Agents,
    about: Description {
        id: "bricks-fig11",
        shows: "Brick&Mortar, Ants and both together in offices, 5.56 % of the sensors missed: what they \
            explore and mark as visited, by the number of agents",
        help: "What agents explore by their number, with missed sensors",
        takes: "a minute",
        ..ABOUT
    },
};

/// Figure 12.
pub const BRICKS_FIG12: Agents = Agents {
    figure: Figure::Area,
    about: Description {
        id: "bricks-fig12",
        shows: "Brick&Mortar, Ants and both together in offices, 5.56 % of the sensors missed: what 20 \
            agents explore and mark as visited, by the area",
        help: "What agents explore by the area, with missed sensors",
        takes: "a minute",
        ..ABOUT
    },
};

/// The work of agents where no sensor is missed.
pub const BRICKS_IDEAL: Agents = Agents {
    figure: Figure::Ideal,
    about: Description {
        id: "bricks-ideal",
        shows: "Brick&Mortar, Ants and both together in offices, no sensor missed: how long until \
            everything is explored, and until all agents know it, by the number of agents",
        help: "How long agents take, with none missed",
        takes: "some seconds",
        ..ABOUT
    },
};

/// Agents on the floors of offices.
#[derive(Clone, Copy, Debug)]
pub struct Agents {
    figure: Figure,
    about: Description,
}

/// The number that is varied in a figure.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Figure {
    /// The number of agents, with missed sensors.
    Agents,
    /// The area, with missed sensors.
    Area,
    /// The number of agents, nothing missed.
    Ideal,
}

impl Figure {
    /// Cells on a side, and agents, of each of its points.
    fn points(self) -> Vec<(u16, u16)> {
        match self {
            Self::Agents => [1, 2, 5, 10, 15, 20, 25, 30, 35, 40].map(|agents| (SIDE, agents)).into(),
            Self::Area => [10, 15, 20, 25, 30, 40, 50, 60].map(|side| (side, AGENTS)).into(),
            Self::Ideal => [1, 2, 5, 10, 20, 40].map(|agents| (SIDE, agents)).into(),
        }
    }

    /// The teams that are compared, in Fig. 11 by every reading of the ants as well.
    fn teams(self) -> Vec<Team> {
        match self {
            Self::Agents => [&TEAMS[..], &READINGS].concat(),
            Self::Area | Self::Ideal => TEAMS.into(),
        }
    }

    /// How likely a sensor is missed.
    const fn miss(self) -> Probability {
        match self {
            Self::Agents | Self::Area => MISS,
            Self::Ideal => Probability::NEVER,
        }
    }
}

settings! {
    /// How much is measured.
    #[derive(Copy, Eq)]
    pub struct Settings {
        /// Random layouts at each point
        pub layouts: u32 = 200, one("runs", "COUNT", from_to(1..=100_000));
        /// The seed of the first layout and its runs; the others have the seeds after it
        pub seed: u64 = 0, one("seed", "SEED", number);
        /// Steps of all agents together after which a run is ended
        pub max_steps: u32 = 200_000, one("max-steps", "STEPS", from_to(1..=u32::MAX.into()));
    }
}

/// A run of every team in one layout with so many cells on a side, and of so many agents.
type Job = Run<(u16, u16)>;

/// The whole figure.
#[derive(Clone, PartialEq, Debug, JsonSchema, Serialize)]
pub struct Summary {
    layouts: u32,
    seed: u64,
    miss: f64,
    max_steps: u32,
    /// Point by point, each of all teams.
    pub lines: Vec<Line>,
    paper: Vec<PrintedFigure>,
}

/// A team at a point.
#[derive(Clone, PartialEq, Debug, JsonSchema, Serialize)]
pub struct Line {
    /// Who explores.
    #[serde(flatten)]
    pub team: Team,
    /// Cells on a side.
    pub side: u16,
    /// Agents.
    pub agents: u16,
    /// Cells explored, in percent.
    pub explored: Estimate,
    /// Cells visited in the end, in percent; ants mark none.
    pub visited: Option<Estimate>,
    /// Of the runs that explored every cell: how long until then.
    pub exploration: Option<Duration>,
    /// Of the runs in which all agents were done: how long until then.
    pub termination: Option<Duration>,
    /// Runs that were ended after too many steps.
    pub ended: u32,
}

/// How long something took; of how many runs, says the count.
#[derive(Clone, Copy, PartialEq, Debug, JsonSchema, Serialize)]
pub struct Duration {
    /// In team moves.
    pub team_moves: Estimate,
    /// In seconds of the slowest agent.
    pub seconds: Estimate,
}

/// When something was so.
#[derive(Clone, Copy, PartialEq, Eq, Debug, JsonSchema, Serialize, Deserialize)]
pub(super) struct Moment {
    pub(super) team_moves: u32,
    milliseconds: u64,
}

/// The outcome of one run.
#[derive(Clone, Copy, PartialEq, Eq, Debug, JsonSchema, Serialize, Deserialize)]
pub struct Outcome {
    pub(super) cells: u32,
    explored: u32,
    visited: u32,
    pub(super) exploration: Option<Moment>,
    pub(super) termination: Option<Moment>,
    pub(super) is_ended: bool,
    /// Whether an agent was done although another cell was unexplored or left to go through.
    pub(super) is_early: bool,
}

impl Outcome {
    /// Team moves until a moment of the run, over the lower bound: its cells by its agents.
    pub(super) fn ratio(&self, moment: Option<Moment>, agents: u16) -> Option<f64> {
        let bound = f64::from(self.cells) / f64::from(agents);
        moment.map(|moment| f64::from(moment.team_moves) / bound)
    }

    /// The mean of that over the runs that have such a moment.
    pub(super) fn ratios(all: &[&Self], of: fn(&Self) -> Option<Moment>, agents: u16) -> Option<Estimate> {
        mean(all.iter().filter_map(|outcome| outcome.ratio(of(outcome), agents)))
    }
}

impl Table for Agents {
    type Settings = Settings;
    type Job = Job;
    type Sample = Vec<Outcome>;
    type Summary = Summary;

    fn about(&self) -> Description {
        self.about
    }

    fn jobs(&self, settings: &Settings) -> Result<Vec<Job>, Halt> {
        Ok(runs(self.figure.points(), |_| settings.layouts))
    }

    fn parts(&self, _: &Job) -> u64 {
        self.figure.teams().len() as u64
    }

    fn measure(&self, settings: &Settings, run: &Job, _: &dyn Observer) -> Result<Self::Sample, Halt> {
        let ((side, agents), seed) = (run.at, run.seed(settings.seed));
        let layout = generated(&format!("office:{side}x{side}:4x4"), seed)?;
        let starts = vec![layout.default_base()?; agents.into()];
        let chance = (self.figure.miss(), seed);
        let run = |team: Team| team.crew.run(&layout, &starts, chance, settings.max_steps);
        Ok(self.figure.teams().into_iter().map(run).collect())
    }

    fn merge(&self, settings: &Settings, results: Results<Self>) -> Result<Summary, Halt> {
        let Settings { layouts, seed, max_steps } = *settings;
        let lines_at = |(side, agents)| {
            let here = at(&results, (side, agents));
            let line = |(place, team)| {
                let outcomes: Vec<&Outcome> =
                    here.iter().filter_map(|outcomes| outcomes.get(place)).collect();
                Line::of(team, side, agents, &outcomes)
            };
            self.figure.teams().into_iter().enumerate().filter_map(line).collect::<Vec<_>>()
        };
        let lines: Vec<Line> = self.figure.points().into_iter().flat_map(lines_at).collect();
        let paper = text::of(self.figure, &lines);
        Ok(Summary { layouts, seed, miss: self.figure.miss().into(), max_steps, lines, paper })
    }

    fn text(&self, _: &Settings, merged: &Summary) -> Result<String, Halt> {
        Ok(text::text(self.figure, merged))
    }

    fn sentences(&self, merged: &Summary) -> Vec<Judgement> {
        let mut judged = paper::judged(&merged.paper);
        judged.extend(text::judged(self.figure, merged));
        judged
    }

    fn draw(&self, _: usize, _: &Settings, merged: &Summary) -> Result<String, Halt> {
        Ok(charts::chart(self.figure, &merged.lines).svg())
    }
}

impl Line {
    fn of(team: Team, side: u16, agents: u16, outcomes: &[&Outcome]) -> Option<Self> {
        let percent = |number: fn(&Outcome) -> u32| {
            mean(outcomes.iter().map(|outcome| 100.0 * f64::from(number(outcome)) / f64::from(outcome.cells)))
        };
        let marks = team.scheme.knowledge == Some(Knowledge::Visited);
        Some(Self {
            team,
            side,
            agents,
            explored: percent(|outcome| outcome.explored)?,
            visited: percent(|outcome| outcome.visited).filter(|_| marks),
            exploration: Duration::of(outcomes.iter().filter_map(|outcome| outcome.exploration)),
            termination: Duration::of(outcomes.iter().filter_map(|outcome| outcome.termination)),
            ended: count(outcomes, |outcome| outcome.is_ended),
        })
    }
}

impl Duration {
    fn of(moments: impl Iterator<Item = Moment> + Clone) -> Option<Self> {
        Some(Self {
            team_moves: mean(moments.clone().map(|moment| f64::from(moment.team_moves)))?,
            seconds: mean(moments.map(|moment| seconds(moment.milliseconds)))?,
        })
    }
}

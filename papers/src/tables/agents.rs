//! Agents on the floors of offices [Ferranti 2009, V.B]: how much is explored and marked as visited by Brick&Mortar,
//! Ants and Brick&Mortar with ants' ways where sensors are missed, by the number of agents (Fig. 11) and by the area
//! (Fig. 12); and how long they take where none is (the idealized conditions that the paper takes from its reference
//! 2).
//!
//! Layouts are `office:SIDExSIDE:4x4`, all agents start at the cell nearest the centre, and all teams get the same
//! layouts and seeds. A run that goes on is ended after a number of agents' steps, and counted.

mod drawn;
mod printed;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use tautline_kernel::ground::Cell;
use tautline_kernel::{ants, bricks};
use tautline_proofs::bricks::tree;

use self::printed::Printed;
use super::parameter::{Parameter, put, shown};
use super::{About, Chart, Observer, Table, unfit};
use tautline_field::stats::Estimate;
use tautline_sim::diagnostic::Halt;
use tautline_sim::explore::agents::{self as explore, Crew, Way};
use tautline_sim::explore::ants::ANTS;
use tautline_sim::explore::bricks::{BRICKS, BRICKS_ANTS};
use tautline_sim::explore::depth_first::{HELPERS, MDFS};
use tautline_sim::explore::trees::{HELPERS_ROBUST, TREE};
use tautline_sim::explore::{Profile, RuleId};
use tautline_sim::layout::generate::Probability;
use tautline_sim::layout::{Generator, Layout};
use tautline_sim::value_parser::{number, within};

/// A scheme under one of its rules.
#[derive(Clone, Copy, PartialEq, Eq, Debug, JsonSchema, Serialize)]
pub struct Team {
    /// The scheme.
    pub scheme: &'static Profile,
    /// Its rule.
    pub rule: RuleId,
    #[serde(skip)]
    way: Explorer,
}

/// How the agents of a team decide.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Explorer {
    Marks(Way),
    Trees(tree::Way),
}

impl Explorer {
    /// A run of agents that start in these cells of `layout`, of at most so many steps of all of them.
    pub(super) fn run(
        self,
        layout: &Layout,
        starts: &[Cell],
        (miss, seed): (Probability, u64),
        max_steps: u32,
    ) -> Outcome {
        match self {
            Self::Marks(way) => follow(explore::Agents::new(way, layout, starts, miss, seed), max_steps),
            Self::Trees(way) => follow(explore::Agents::new(way, layout, starts, miss, seed), max_steps),
        }
    }
}

impl Team {
    const fn new(scheme: &'static Profile, rule: RuleId, way: Explorer) -> Self {
        Self { scheme, rule, way }
    }

    /// A run of its agents, as [`Explorer::run`] has it.
    pub(super) fn run(
        self,
        layout: &Layout,
        starts: &[Cell],
        chance: (Probability, u64),
        max_steps: u32,
    ) -> Outcome {
        self.way.run(layout, starts, chance, max_steps)
    }
}

const REPAIRED: Explorer = Explorer::Marks(Way::Bricks(bricks::Rule::REPAIRED));
pub(super) const ROBUST: Explorer = Explorer::Marks(Way::Bricks(bricks::Rule::ROBUST));
const ANTS_REPAIRED: Explorer = Explorer::Marks(Way::Ants(ants::Rule::Repaired));
const ANTS_PUBLISHED: Explorer = Explorer::Marks(Way::Ants(ants::Rule::Published));

/// The teams that are compared.
pub const TEAMS: [Team; 7] = [
    Team::new(&BRICKS, RuleId::REPAIRED, REPAIRED),
    Team::new(&BRICKS_ANTS, RuleId::REPAIRED, ROBUST),
    Team::new(&ANTS, RuleId::REPAIRED, ANTS_REPAIRED),
    Team::new(&ANTS, RuleId::PUBLISHED, ANTS_PUBLISHED),
    Team::new(&BRICKS, RuleId::new("tree"), Explorer::Trees(TREE)),
    Team::new(&HELPERS, RuleId::REPAIRED, Explorer::Trees(HELPERS_ROBUST)),
    Team::new(&MDFS, RuleId::PUBLISHED, Explorer::Trees(tree::Way::Mdfs)),
];

/// The sensors that the paper's agents miss, of all.
pub const MISS: Probability = Probability::new(0.0556).expect("a probability");

/// The paper's area, and its team where it varies the area.
const SIDE: u16 = 30;
const AGENTS: u16 = 20;

/// Figure 11.
pub const BRICKS_FIG11: Agents = Agents {
    figure: Figure::Agents,
    id: "bricks-fig11",
    shows: "Brick&Mortar, Ants and both together in offices, 5.56 % of the sensors missed: what they explore and mark as \
            visited, by the number of agents",
    help: "What agents explore by their number, with missed sensors",
};

/// Figure 12.
pub const BRICKS_FIG12: Agents = Agents {
    figure: Figure::Area,
    id: "bricks-fig12",
    shows: "Brick&Mortar, Ants and both together in offices, 5.56 % of the sensors missed: what 20 agents explore and mark \
            as visited, by the area",
    help: "What agents explore by the area, with missed sensors",
};

/// What agents do where no sensor is missed.
pub const BRICKS_IDEAL: Agents = Agents {
    figure: Figure::Ideal,
    id: "bricks-ideal",
    shows: "Brick&Mortar, Ants and both together in offices, no sensor missed: how long until everything is explored, and \
            until all agents know it, by the number of agents",
    help: "How long agents take, with none missed",
};

/// Agents on the floors of offices.
#[derive(Clone, Copy, Debug)]
pub struct Agents {
    figure: Figure,
    id: &'static str,
    shows: &'static str,
    help: &'static str,
}

/// What is varied.
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

    /// How likely a sensor is missed.
    const fn miss(self) -> Probability {
        match self {
            Self::Agents | Self::Area => MISS,
            Self::Ideal => Probability::NEVER,
        }
    }
}

/// How much is measured.
#[derive(Clone, Copy, PartialEq, Eq, Debug, JsonSchema, Serialize, Deserialize)]
pub struct Settings {
    /// Layouts at each point.
    pub layouts: u32,
    /// The seed of the first one.
    pub seed: u64,
    /// Steps of all agents after which a run is ended.
    pub max_steps: u32,
}

impl Default for Settings {
    fn default() -> Self {
        Self { layouts: 200, seed: 0, max_steps: 200_000 }
    }
}

/// One layout with so many agents, for every team.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize)]
pub struct Job {
    side: u16,
    agents: u16,
    seed: u64,
}

/// The whole figure.
#[derive(Clone, PartialEq, Debug, JsonSchema, Serialize)]
pub struct Merged {
    layouts: u32,
    seed: u64,
    miss: f64,
    max_steps: u32,
    /// Point by point, each of all teams.
    pub lines: Vec<Line>,
    paper: Vec<Printed>,
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

/// What came of one run.
#[derive(Clone, Copy, PartialEq, Eq, Debug, JsonSchema, Serialize, Deserialize)]
pub struct Outcome {
    pub(super) cells: u32,
    explored: u32,
    visited: u32,
    pub(super) exploration: Option<Moment>,
    pub(super) termination: Option<Moment>,
    pub(super) is_ended: bool,
    /// Whether an agent was done although it could have got to an unexplored cell.
    pub(super) is_early: bool,
}

impl Outcome {
    /// Team moves until a moment of the run, over the lower bound: its cells by its agents.
    pub(super) fn ratio(&self, moment: Option<Moment>, agents: u16) -> Option<f64> {
        let bound = f64::from(self.cells) / f64::from(agents);
        moment.map(|moment| f64::from(moment.team_moves) / bound)
    }

    /// The mean of that over the runs that have such a moment.
    pub(super) fn mean_ratio(all: &[Self], of: fn(&Self) -> Option<Moment>, agents: u16) -> Option<Estimate> {
        let ratios = all.iter().filter_map(|outcome| outcome.ratio(of(outcome), agents));
        Estimate::of_values(&ratios.collect::<Vec<_>>())
    }
}

impl Table for Agents {
    type Settings = Settings;
    type Job = Job;
    type Measured = [Outcome; TEAMS.len()];
    type Merged = Merged;

    fn about(&self) -> About {
        About {
            id: self.id,
            shows: self.shows,
            help: self.help,
            more: "",
            examples: &["bricks-fig11 --svg fig11.svg", "bricks-ideal --layouts 20 --format json"],
            doing: "exploring",
        }
    }

    fn parameters(&self) -> Vec<Parameter<Settings>> {
        vec![
            Parameter::one(
                "layouts",
                "COUNT",
                "Random layouts at each point",
                |all| shown(&all.layouts),
                |all, texts| put(&mut all.layouts, texts, |text| within(text, &(1..=100_000_i64))),
            ),
            Parameter::one(
                "seed",
                "SEED",
                "The seed of the first layout and its runs; the others have the seeds after it",
                |all| shown(&all.seed),
                |all, texts| put(&mut all.seed, texts, number),
            ),
            Parameter::one(
                "max-steps",
                "STEPS",
                "Steps of all agents together after which a run is ended",
                |all| shown(&all.max_steps),
                |all, texts| put(&mut all.max_steps, texts, |text| within(text, &(1..=i64::from(u32::MAX)))),
            ),
        ]
    }

    fn charts(&self) -> Vec<Chart<Self>> {
        let draw = |agents: &Self, _: &Settings, merged: &Merged| {
            Ok(drawn::chart(agents.figure, &merged.lines).svg())
        };
        vec![Chart { name: "svg", about: "Store a chart", draw }]
    }

    fn jobs(&self, settings: &Settings) -> Result<Vec<Job>, Halt> {
        let at = |(side, agents)| {
            let first = settings.seed;
            let job = move |index| Job { side, agents, seed: first.wrapping_add(index) };
            (0..u64::from(settings.layouts)).map(job)
        };
        Ok(self.figure.points().into_iter().flat_map(at).collect())
    }

    fn parts(&self, _: &Job) -> u64 {
        TEAMS.len() as u64
    }

    fn measure(&self, settings: &Settings, job: &Job, _: &dyn Observer) -> Result<Self::Measured, Halt> {
        let Job { side, agents, seed } = *job;
        let description = format!("office:{side}x{side}:4x4");
        let generator: Generator = description.parse().map_err(|problem| unfit(&problem))?;
        let layout = generator.generate(seed).map_err(|problem| unfit(&problem))?;
        let start = layout.default_base().map_err(|problem| unfit(&problem))?;
        let miss = self.figure.miss();
        let run = |team: Team| {
            let starts = vec![start; agents.into()];
            team.run(&layout, &starts, (miss, seed), settings.max_steps)
        };
        Ok(TEAMS.map(run))
    }

    fn merge(&self, settings: &Settings, results: Vec<(Job, Self::Measured)>) -> Result<Merged, Halt> {
        let Settings { layouts, seed, max_steps } = *settings;
        let at = |(side, agents): (u16, u16)| {
            let here = results.iter().filter(move |(job, _)| (job.side, job.agents) == (side, agents));
            let line = move |(place, team): (usize, Team)| {
                let outcomes: Vec<Outcome> = here.clone().map(|(_, outcomes)| outcomes[place]).collect();
                Line::of(team, side, agents, &outcomes)
            };
            TEAMS.into_iter().enumerate().filter_map(line)
        };
        let lines: Vec<Line> = self.figure.points().into_iter().flat_map(at).collect();
        let paper = printed::of(self.figure, &lines);
        Ok(Merged { layouts, seed, miss: self.figure.miss().into(), max_steps, lines, paper })
    }

    fn text(&self, _: &Settings, merged: &Merged) -> Result<String, Halt> {
        Ok(printed::text(self.figure, merged))
    }
}

fn follow<K: Crew>(mut team: explore::Agents<K>, max_steps: u32) -> Outcome {
    let (mut team_moves, mut steps, mut exploration, mut is_early) = (0, 0, None, false);
    let now =
        |team: &explore::Agents<K>, team_moves| Moment { team_moves, milliseconds: team.milliseconds() };
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

impl Team {
    /// Its name: the scheme, with its rule where that is not the repaired one.
    pub fn name(self) -> String {
        match self.rule {
            RuleId::REPAIRED => self.scheme.name.to_owned(),
            rule => format!("{} ({rule})", self.scheme.name),
        }
    }
}

impl Line {
    fn of(team: Team, side: u16, agents: u16, outcomes: &[Outcome]) -> Option<Self> {
        let percent = |number: fn(&Outcome) -> u32| {
            let share = |outcome: &Outcome| 100.0 * f64::from(number(outcome)) / f64::from(outcome.cells);
            Estimate::of_values(&outcomes.iter().map(share).collect::<Vec<_>>())
        };
        let visited = match team.way {
            Explorer::Marks(Way::Ants(_)) => None,
            Explorer::Marks(Way::Bricks(_)) | Explorer::Trees(_) => percent(|outcome| outcome.visited),
        };
        Some(Self {
            team,
            side,
            agents,
            explored: percent(|outcome| outcome.explored)?,
            visited,
            exploration: Duration::of(outcomes.iter().filter_map(|outcome| outcome.exploration)),
            termination: Duration::of(outcomes.iter().filter_map(|outcome| outcome.termination)),
            ended: outcomes.iter().filter(|outcome| outcome.is_ended).count() as u32,
        })
    }
}

impl Duration {
    #[expect(clippy::cast_precision_loss, reason = "no run takes 2⁵³ milliseconds")]
    fn of(moments: impl Iterator<Item = Moment>) -> Option<Self> {
        let (moves, seconds): (Vec<f64>, Vec<f64>) =
            moments.map(|moment| (f64::from(moment.team_moves), moment.milliseconds as f64 / 1000.0)).unzip();
        Some(Self { team_moves: Estimate::of_values(&moves)?, seconds: Estimate::of_values(&seconds)? })
    }
}

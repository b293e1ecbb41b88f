//! Agents on the floors of offices (paper 004, V.B): how much is explored and marked as visited by Brick&Mortar, Ants and
//! Brick&Mortar with ants' ways where sensors are missed, by the number of agents (Fig. 11) and by the area (Fig. 12); and
//! how long they take where none is (the idealized conditions that the paper takes from its reference 2).
//!
//! Layouts are `office:SIDExSIDE:4x4`, all agents start at the cell nearest the centre, and all teams get the same
//! layouts and seeds. A run that goes on is ended after a number of agents' steps, and counted.

use rayon::prelude::*;
use serde::Serialize;
use tautline_kernel::ground::Cell;
use tautline_kernel::{ants, bricks};

use super::interval::Estimate;
use crate::explore::agents::{self as explore, Way};
use crate::explore::bricks::{BRICKS, BRICKS_ANTS};
use crate::explore::{Profile, RuleName, ants::ANTS};
use crate::fault::{Fault, Halt, Watch};
use crate::layout::generate::Probability;
use crate::layout::{Generator, Layout, Problem};

/// A scheme under one of its rules.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize)]
pub struct Team {
    /// The scheme.
    pub scheme: &'static Profile,
    /// Its rule.
    pub rule: RuleName,
    #[serde(skip)]
    way: Way,
}

/// The teams that are compared.
pub const TEAMS: [Team; 4] = [
    Team { scheme: &BRICKS, rule: RuleName::Repaired, way: Way::Bricks(bricks::Rule::REPAIRED) },
    Team { scheme: &BRICKS_ANTS, rule: RuleName::Repaired, way: Way::Bricks(bricks::Rule::ROBUST) },
    Team { scheme: &ANTS, rule: RuleName::Repaired, way: Way::Ants(ants::Rule::Repaired) },
    Team { scheme: &ANTS, rule: RuleName::Published, way: Way::Ants(ants::Rule::Published) },
];

/// The sensors that the paper's agents miss, of all.
pub const MISS: Probability = Probability::new(0.0556).expect("a probability");

/// The paper's area, and its team where it varies the area.
const SIDE: u16 = 30;
const AGENTS: u16 = 20;

/// What is varied.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Figure {
    /// The number of agents, with missed sensors.
    Agents,
    /// The area, with missed sensors.
    Area,
    /// The number of agents, nothing missed.
    Ideal,
}

impl Figure {
    /// Cells on a side, and agents, of each of its points.
    pub fn points(self) -> Vec<(u16, u16)> {
        match self {
            Self::Agents => [1, 2, 5, 10, 15, 20, 25, 30, 35, 40].map(|agents| (SIDE, agents)).into(),
            Self::Area => [10, 15, 20, 25, 30, 40, 50, 60].map(|side| (side, AGENTS)).into(),
            Self::Ideal => [1, 2, 5, 10, 20, 40].map(|agents| (SIDE, agents)).into(),
        }
    }

    /// How likely a sensor is missed.
    pub const fn miss(self) -> Probability {
        match self {
            Self::Agents | Self::Area => MISS,
            Self::Ideal => Probability::NEVER,
        }
    }
}

/// How much is measured.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Extent {
    /// Layouts at each point.
    pub layouts: u32,
    /// The seed of the first one.
    pub seed: u64,
    /// Steps of all agents after which a run is ended.
    pub max_steps: u32,
}

/// A team at a point.
#[derive(Clone, PartialEq, Debug, Serialize)]
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
#[derive(Clone, Copy, PartialEq, Debug, Serialize)]
pub struct Duration {
    /// In team moves.
    pub team_moves: Estimate,
    /// In seconds of the slowest agent.
    pub seconds: Estimate,
}

/// When something was so.
#[derive(Clone, Copy)]
struct Moment {
    team_moves: u32,
    milliseconds: u64,
}

/// What came of one run.
#[derive(Clone, Copy)]
struct Outcome {
    cells: u32,
    explored: u32,
    visited: u32,
    exploration: Option<Moment>,
    termination: Option<Moment>,
    is_ended: bool,
}

/// Measures every point of `figure`. `watch` is called after each run.
///
/// # Errors
/// [`Halt`], as `watch` returned it.
pub fn measure(figure: Figure, extent: Extent, watch: &Watch<'_>) -> Result<Vec<Line>, Halt> {
    let miss = figure.miss();
    let mut lines = Vec::new();
    for (side, agents) in figure.points() {
        let description = format!("office:{side}x{side}:4x4");
        let generator: Generator = description.parse().map_err(|problem| fault(&problem))?;
        let runs = (0..u64::from(extent.layouts)).into_par_iter().map(|index| {
            let seed = extent.seed.wrapping_add(index);
            let layout = generator.generate(seed).map_err(|problem| fault(&problem))?;
            let start = layout.default_base().map_err(|problem| fault(&problem))?;
            let run = |team: Team| {
                let outcome = follow(team.way, &layout, start, agents, miss, seed, extent.max_steps);
                watch().map(|()| outcome)
            };
            TEAMS.into_iter().map(run).collect()
        });
        let runs: Vec<Vec<Outcome>> = runs.collect::<Result<_, Halt>>()?;
        for (place, team) in TEAMS.into_iter().enumerate() {
            let outcomes: Vec<Outcome> = runs.iter().map(|run| run[place]).collect();
            lines.extend(Line::of(team, side, agents, &outcomes));
        }
    }
    Ok(lines)
}

fn fault(problem: &Problem) -> Fault {
    Fault::usage(problem, problem.remedy())
}

fn follow(
    way: Way,
    layout: &Layout,
    start: Cell,
    agents: u16,
    miss: Probability,
    seed: u64,
    max_steps: u32,
) -> Outcome {
    let mut team = explore::Agents::new(way, layout, &vec![start; agents.into()], miss, seed);
    let (mut team_moves, mut steps, mut exploration) = (0, 0, None);
    let now = |team: &explore::Agents, team_moves| Moment { team_moves, milliseconds: team.milliseconds() };
    while !team.is_over() && steps < max_steps {
        team_moves += 1;
        steps += team.active();
        team.advance();
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
    }
}

impl Team {
    /// Its name: the scheme, with its rule where that is the published one.
    pub fn name(self) -> String {
        match self.rule {
            RuleName::Repaired => self.scheme.name.to_owned(),
            RuleName::Published => format!("{} ({})", self.scheme.name, self.rule),
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
            Way::Ants(_) => None,
            Way::Bricks(_) => percent(|outcome| outcome.visited),
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

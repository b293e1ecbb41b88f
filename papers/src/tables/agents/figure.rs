//! The points of a figure, and the means of the runs of a team at one of them.

use super::super::prelude::*;
use super::start::Start;
use super::team::{BRICKS_PUBLISHED, Moment, Outcome, READINGS, TEAMS, Team};
use tautline_grids::chance::Probability;
use tautline_sim::explore::Knowledge;

/// The sensors that the paper's agents miss, of all.
const MISS: Probability = Probability::new(0.0556).expect("a probability");

/// The paper's area, and its team where it varies the area.
const SIDE: u16 = 30;
const AGENTS: u16 = 20;

/// The number that is varied in a figure.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Figure {
    /// The number of agents, with missed sensors.
    Agents,
    /// The area, with missed sensors.
    Area,
    /// The number of agents, nothing missed.
    Ideal,
}

impl Figure {
    /// Cells on a side, and agents, of each of its points.
    pub(super) fn points(self) -> Vec<(u16, u16)> {
        match self {
            Self::Agents => [1, 2, 5, 10, 15, 20, 25, 30, 35, 40].map(|agents| (SIDE, agents)).into(),
            Self::Area => [10, 15, 20, 25, 30, 40, 50, 60].map(|side| (side, AGENTS)).into(),
            Self::Ideal => [1, 2, 5, 10, 20, 40].map(|agents| (SIDE, agents)).into(),
        }
    }

    /// The teams that are compared: Brick&Mortar as published too, and in Fig. 11 ants by every reading.
    pub(super) fn teams(self) -> Vec<Team> {
        let [bricks, others @ ..] = TEAMS;
        let readings: &[Team] = match self {
            Self::Agents => &READINGS,
            Self::Area | Self::Ideal => &[],
        };
        [&[bricks, BRICKS_PUBLISHED], &others[..], readings].concat()
    }

    /// The teams that are run with no sensor missed, too: in Fig. 11 the paper's, of which ants have one reading then.
    pub(super) fn unmissed(self) -> Vec<Team> {
        let [bricks, _, _, ants, ..] = TEAMS;
        match self {
            Self::Agents => vec![bricks, BRICKS_PUBLISHED, ants],
            Self::Area | Self::Ideal => Vec::new(),
        }
    }

    /// The runs at each point: the teams, then those that miss nothing.
    pub(super) fn runs(self) -> Vec<(Team, Probability)> {
        let teams = self.teams().into_iter().map(|team| (team, self.miss()));
        teams.chain(self.unmissed().into_iter().map(|team| (team, Probability::NEVER))).collect()
    }

    /// How likely a sensor is missed.
    pub(super) const fn miss(self) -> Probability {
        match self {
            Self::Agents | Self::Area => MISS,
            Self::Ideal => Probability::NEVER,
        }
    }
}

/// The whole figure.
#[derive(Clone, PartialEq, Debug, JsonSchema, Serialize)]
pub struct Summary {
    pub(super) layouts: u32,
    pub(super) seed: u64,
    pub(super) miss: f64,
    pub(super) max_steps: u32,
    /// Where the agents start, if not all in the cell nearest the centre.
    #[serde(skip_serializing_if = "Start::is_default")]
    pub(super) starts: Start,
    /// Point by point, each of all teams.
    pub lines: Vec<Line>,
    /// The paper's teams with no sensor missed, point by point, in Fig. 11.
    pub unmissed: Vec<Line>,
    pub(super) paper: Vec<PrintedFigure>,
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

impl Line {
    pub(super) fn of(team: Team, side: u16, agents: u16, outcomes: &[&Outcome]) -> Option<Self> {
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

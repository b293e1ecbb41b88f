//! What of a setup does not fit its scheme, wherever it comes from.

use std::fmt;

use tautline_kernel::chain::MAX_ROBOTS;
use tautline_proofs::words::counted;

use super::{Crew, RuleName, SchemeName, Setup};
use crate::layout::Problem;
use crate::words::Worded;

/// The most agents on a floor: a sensor keeps an id in eight bits, and counts agents in as many.
const MAX_AGENTS: usize = 255;

/// What does not fit: `Display` says what, [`Misfit::remedy`] what would be right.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Misfit {
    /// No team of the scheme has so many.
    Robots {
        /// The scheme.
        scheme: SchemeName,
        /// So many.
        robots: u64,
    },
    /// The scheme is not published.
    Rule(SchemeName),
    /// The scheme has no sensors to miss.
    Miss,
    /// The same, one by one.
    MissedByChain,
    /// All sensors are missed, and nothing ends the run.
    MissAll,
    /// The numbers of the sensors that are missed do not grow from 1 on.
    Missed,
    /// The scheme starts at the base.
    StartsOfChain,
    /// There are starts for another number of agents.
    Starts {
        /// So many starts.
        starts: usize,
        /// So many agents.
        robots: u16,
    },
    /// A start is not a free cell.
    Start(Problem),
}

impl Misfit {
    /// The field of a setup that does not fit.
    pub const fn field(&self) -> &'static str {
        match self {
            Self::Robots { .. } => "robots",
            Self::Rule(_) => "rule",
            Self::Miss | Self::MissAll => "miss",
            Self::MissedByChain | Self::Missed => "missed",
            Self::StartsOfChain | Self::Starts { .. } | Self::Start(_) => "starts",
        }
    }

    /// What would be right.
    pub fn remedy(&self) -> String {
        match self {
            Self::Robots { scheme: SchemeName::Chain, .. } => {
                format!("a chain has 2 to {MAX_ROBOTS} robots, the base counted")
            }
            Self::Robots { .. } => format!("a team has 1 to {MAX_AGENTS} agents"),
            Self::Rule(scheme) => format!("take the rule repaired, or another scheme than {}", scheme.word()),
            Self::Miss => "take ants, bricks or bricks-ants, or leave out how likely that is".to_owned(),
            Self::MissedByChain => "take ants, bricks or bricks-ants, or leave out what is missed".to_owned(),
            Self::MissAll => "give a probability below 1, or end the run by --max-moves".to_owned(),
            Self::Missed => "number them from 1 on, in order, each once".to_owned(),
            Self::StartsOfChain => "give the base another place by --base".to_owned(),
            Self::Starts { .. } => "give one start for all, or one for each agent".to_owned(),
            Self::Start(problem) => problem.remedy(),
        }
    }
}

impl fmt::Display for Misfit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Robots { scheme: SchemeName::Chain, robots: 0 } => f.write_str("no robots are no chain"),
            Self::Robots { scheme: SchemeName::Chain, robots: 1 } => {
                f.write_str("the base alone is no chain")
            }
            Self::Robots { scheme: SchemeName::Chain, robots } => write!(f, "{robots} robots are no chain"),
            Self::Robots { robots: 0, .. } => f.write_str("no agents are no team"),
            Self::Robots { robots, .. } => write!(f, "{robots} agents are too many for a team"),
            Self::Rule(scheme) => write!(f, "{} is ours: nobody has published it", scheme.word()),
            Self::Miss | Self::MissedByChain => {
                f.write_str("the robots of a chain have no floor sensors to miss")
            }
            Self::MissAll => f.write_str("agents that miss every sensor go on for ever"),
            Self::Missed => f.write_str("the numbers of the sensors that are missed are not in order"),
            Self::StartsOfChain => f.write_str("the robots of a chain start at the base"),
            Self::Starts { starts, robots } => {
                write!(f, "{} for {}", counted(*starts, "start"), counted(*robots, "agent"))
            }
            Self::Start(problem) => problem.fmt(f),
        }
    }
}

impl std::error::Error for Misfit {}

impl Setup {
    /// `robots` as the number of a team of `scheme`.
    ///
    /// # Errors
    /// [`Misfit::Robots`].
    pub fn count(scheme: SchemeName, robots: u64) -> Result<u16, Misfit> {
        let allowed = match scheme {
            SchemeName::Chain => 2..=MAX_ROBOTS,
            SchemeName::Ants | SchemeName::Bricks | SchemeName::BricksAnts => 1..=MAX_AGENTS,
        };
        let count = u16::try_from(robots).ok().filter(|&count| allowed.contains(&count.into()));
        count.ok_or(Misfit::Robots { scheme, robots })
    }

    /// Whether everything fits the scheme.
    ///
    /// # Errors
    /// [`Misfit`], the first in the order of its variants.
    pub fn check(&self) -> Result<(), Misfit> {
        Self::count(self.scheme, self.robots.into())?;
        if (self.scheme, self.rule) == (SchemeName::BricksAnts, RuleName::Published) {
            return Err(Misfit::Rule(self.scheme));
        }
        match (self.crew(), &self.starts) {
            (Crew::Chain, _) if !self.miss.is_never() => Err(Misfit::Miss),
            (Crew::Chain, _) if !self.missed.is_empty() => Err(Misfit::MissedByChain),
            (Crew::Agents(_), _) if self.miss.is_certain() && self.limits.max_moves.is_none() => {
                Err(Misfit::MissAll)
            }
            (Crew::Agents(_), _)
                if self.missed.first() == Some(&0) || !self.missed.is_sorted_by(|a, b| a < b) =>
            {
                Err(Misfit::Missed)
            }
            (Crew::Chain, Some(_)) => Err(Misfit::StartsOfChain),
            (Crew::Agents(_), Some(starts)) if starts.len() != usize::from(self.robots) => {
                Err(Misfit::Starts { starts: starts.len(), robots: self.robots })
            }
            (Crew::Agents(_), Some(starts)) => {
                starts.iter().try_for_each(|&start| self.layout.check_start(start)).map_err(Misfit::Start)
            }
            (Crew::Agents(_), None) => self.layout.check_start(self.base).map_err(Misfit::Start),
            (Crew::Chain, None) => Ok(()),
        }
    }
}

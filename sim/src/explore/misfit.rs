//! What of a setup does not fit its scheme, wherever it comes from.

use std::fmt;

use tautline_proofs::words::counted;

use super::catalogue::sensing;
use super::rule::RuleId;
use super::setup::{Profile, Rule, Senses, Setup, Starts};
use crate::fault::Fault;
use crate::layout::Problem;

/// What does not fit: `Display` says what, [`Misfit::remedy`] what would be right.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Misfit {
    /// No team of the scheme has so many.
    Robots {
        /// The scheme.
        scheme: &'static Profile,
        /// So many.
        robots: u64,
    },
    /// The scheme does not offer the rule.
    Rule {
        /// The scheme.
        scheme: &'static Profile,
        /// The rule.
        rule: RuleId,
    },
    /// The scheme has no sensors to miss.
    Miss(&'static Profile),
    /// The same, one by one.
    MissedByNone(&'static Profile),
    /// All sensors are missed, and nothing ends the run.
    MissAll,
    /// The numbers of the sensors that are missed do not grow from 1 on.
    Missed,
    /// The scheme starts at the base.
    StartsAtBase(&'static Profile),
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
            Self::Rule { .. } => "rule",
            Self::Miss(_) | Self::MissAll => "miss",
            Self::MissedByNone(_) | Self::Missed => "missed",
            Self::StartsAtBase(_) | Self::Starts { .. } | Self::Start(_) => "starts",
        }
    }

    /// What would be right.
    pub fn remedy(&self) -> String {
        match self {
            Self::Robots { scheme, .. } => {
                let Profile { team, robots, look, .. } = scheme;
                let base = if look.has_base() { ", the base counted" } else { "" };
                format!("a {team} has {} to {} {}s{base}", robots.start(), robots.end(), look.robot())
            }
            Self::Rule { scheme, .. } => {
                let names: Vec<&str> = scheme.rules.iter().map(|rule| rule.name.as_str()).collect();
                format!("take the rule {}, or another scheme than {}", names.join(" or "), scheme.name)
            }
            Self::Miss(_) => {
                format!("take {}, or leave out how likely that is", sensing(Senses::Floor, "or"))
            }
            Self::MissedByNone(_) => {
                format!("take {}, or leave out what is missed", sensing(Senses::Floor, "or"))
            }
            Self::MissAll => "give a probability below 1, or end the run by `max-moves`".to_owned(),
            Self::Missed => "number them from 1 on, in order, each once".to_owned(),
            Self::StartsAtBase(_) => "give the base another place by `base`".to_owned(),
            Self::Starts { .. } => "give one start for all, or one for each agent".to_owned(),
            Self::Start(problem) => problem.remedy(),
        }
    }
}

impl fmt::Display for Misfit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Robots { scheme, robots } => {
                let Profile { team, look, .. } = scheme;
                let robot = look.robot();
                match (*robots, look.has_base()) {
                    (0, _) => write!(f, "no {robot}s are no {team}"),
                    (1, true) => write!(f, "the base alone is no {team}"),
                    (robots, true) => write!(f, "{robots} {robot}s are no {team}"),
                    (robots, false) => write!(f, "{robots} {robot}s are too many for a {team}"),
                }
            }
            Self::Rule { scheme, rule: RuleId::PUBLISHED } => {
                write!(f, "{} is ours: nobody has published it", scheme.name)
            }
            Self::Rule { scheme, rule } => write!(f, "{} has no rule {rule}", scheme.name),
            Self::Miss(scheme) | Self::MissedByNone(scheme) => {
                write!(f, "the {}s of a {} have no floor sensors to miss", scheme.look.robot(), scheme.team)
            }
            Self::MissAll => f.write_str("agents that miss every sensor go on for ever"),
            Self::Missed => f.write_str("the numbers of the sensors that are missed are not in order"),
            Self::StartsAtBase(scheme) => {
                write!(f, "the {}s of a {} start at the base", scheme.look.robot(), scheme.team)
            }
            Self::Starts { starts, robots } => {
                write!(f, "{} for {}", counted(*starts, "start"), counted(*robots, "agent"))
            }
            Self::Start(problem) => problem.fmt(f),
        }
    }
}

impl std::error::Error for Misfit {}

impl From<Misfit> for Fault {
    fn from(misfit: Misfit) -> Self {
        Self::of_field(misfit.field(), &misfit, misfit.remedy())
    }
}

impl Setup {
    /// `robots` as the number of a team of `scheme`.
    ///
    /// # Errors
    /// [`Misfit::Robots`].
    pub fn count(scheme: &'static Profile, robots: u64) -> Result<u16, Misfit> {
        let count = u16::try_from(robots).ok().filter(|&count| scheme.robots.contains(&count.into()));
        count.ok_or(Misfit::Robots { scheme, robots })
    }

    /// The rule of its scheme, if everything fits that.
    ///
    /// # Errors
    /// [`Misfit`], the first in the order of its variants.
    pub fn check(&self) -> Result<&'static Rule, Misfit> {
        let Self { scheme, rule, robots, starts, .. } = self;
        Self::count(scheme, (*robots).into())?;
        let rule = scheme.rule(*rule).ok_or(Misfit::Rule { scheme, rule: *rule })?;
        match scheme.senses {
            Senses::Bumps if !self.miss.is_never() => return Err(Misfit::Miss(scheme)),
            Senses::Bumps if !self.missed.is_empty() => return Err(Misfit::MissedByNone(scheme)),
            Senses::Floor if self.miss.is_certain() && self.limits.max_moves.is_none() => {
                return Err(Misfit::MissAll);
            }
            Senses::Floor if self.missed.first() == Some(&0) || !self.missed.is_sorted_by(|a, b| a < b) => {
                return Err(Misfit::Missed);
            }
            Senses::Bumps | Senses::Floor => {}
        }
        match (scheme.starts, starts) {
            (Starts::Base, Some(_)) => return Err(Misfit::StartsAtBase(scheme)),
            (Starts::Base, None) => {}
            (Starts::Anywhere | Starts::Beside, Some(starts)) if starts.len() != usize::from(*robots) => {
                return Err(Misfit::Starts { starts: starts.len(), robots: *robots });
            }
            (Starts::Anywhere | Starts::Beside, starts) => {
                let starts = starts.as_deref().unwrap_or(std::slice::from_ref(&self.base));
                starts.iter().try_for_each(|&start| self.layout.check_start(start)).map_err(Misfit::Start)?;
            }
        }
        Ok(rule)
    }
}

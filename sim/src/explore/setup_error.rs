//! What of a setup does not fit its scheme, wherever it comes from.

use std::fmt;

use tautline_kernel::ground::Cell;
use tautline_proofs::plural::counted;

use super::catalogue::Scheme;
use super::hunt::Hunt;
use super::rule::RuleId;
use super::setup::{Drawn, Profile, Rule, Senses, Setup, Starts};
use crate::diagnostic::Diagnostic;
use crate::layout::Problem;
use crate::options::{Extra, Wrong};

/// What does not fit: `Display` says what, [`SetupError::remedy`] what would be right.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum SetupError {
    /// No team of the scheme has so many.
    Robots {
        /// The scheme.
        scheme: Scheme,
        /// So many.
        robots: u64,
    },
    /// The scheme does not offer the rule.
    Rule {
        /// The scheme.
        scheme: Scheme,
        /// The rule.
        rule: RuleId,
    },
    /// The scheme has no sensors to miss.
    Miss(Scheme),
    /// The same, one by one.
    MissedByNone(Scheme),
    /// All sensors are missed, and nothing ends the run.
    MissAll,
    /// The numbers of the sensors that are missed do not grow from 1 on.
    Missed,
    /// The scheme starts at the base.
    StartsAtBase(Scheme),
    /// There are starts for another number of agents.
    Starts {
        /// The scheme.
        scheme: Scheme,
        /// So many starts.
        starts: usize,
        /// So many agents or robots.
        robots: u16,
    },
    /// A start is not a free cell.
    Start(Problem),
    /// Two robots start in one cell, and the scheme lets none do so.
    Together(Cell),
    /// There are more robots than free cells for them.
    Full {
        /// So many robots.
        robots: u16,
        /// So many cells that the base is connected with.
        cells: usize,
    },
    /// The scheme cannot be told that.
    Extra(Scheme, &'static Extra),
    /// What is told makes no run.
    Wrong(&'static Extra, Wrong),
    /// Nothing is drawn by the seed that is given.
    Seed(Scheme),
}

impl SetupError {
    /// The field of a setup that does not fit.
    pub const fn field(&self) -> &'static str {
        match self {
            Self::Robots { .. } | Self::Full { .. } => "robots",
            Self::Rule { .. } => "rule",
            Self::Miss(_) | Self::MissAll => "miss",
            Self::MissedByNone(_) | Self::Missed => "missed",
            Self::StartsAtBase(_) | Self::Starts { .. } | Self::Start(_) | Self::Together(_) => "starts",
            Self::Extra(_, extra) | Self::Wrong(extra, _) => extra.field,
            Self::Seed(_) => "seed",
        }
    }

    /// What would be right.
    pub fn remedy(&self) -> String {
        match self {
            Self::Robots { scheme, .. } => {
                let Profile { team, robots, look, .. } = &**scheme;
                let base = if look.has_base() { ", the base counted" } else { "" };
                format!("a {team} has {} to {} {}s{base}", robots.start(), robots.end(), look.robot())
            }
            Self::Rule { scheme, .. } => {
                let names: Vec<&str> = scheme.rules.iter().map(|rule| rule.name.as_str()).collect();
                format!("take the rule {}, or another scheme than {}", names.join(" or "), scheme.name)
            }
            Self::Miss(scheme) => {
                format!("take {}, or leave out how likely that is", scheme.sensing(Senses::Floor))
            }
            Self::MissedByNone(scheme) => {
                format!("take {}, or leave out what is missed", scheme.sensing(Senses::Floor))
            }
            Self::MissAll => "give a probability below 1, or end the run by `max-moves`".to_owned(),
            Self::Missed => "number them from 1 on, in order, each once".to_owned(),
            Self::StartsAtBase(_) => "give the base another place by `base`".to_owned(),
            Self::Starts { scheme, .. } => {
                format!("give one start for all, or one for each {}", scheme.look.robot())
            }
            Self::Start(problem) => problem.remedy(),
            Self::Together(_) => "give each robot a start of its own".to_owned(),
            Self::Full { cells, .. } => {
                format!("give `robots` a number up to {cells}, or take a larger layout")
            }
            Self::Extra(scheme, extra) => {
                let names = scheme.among.names(|scheme| scheme.extras.contains(extra));
                format!("take the scheme {}, or leave it out", names.join(" or "))
            }
            Self::Wrong(_, (_, remedy)) => remedy.clone(),
            Self::Seed(scheme) => {
                let Profile { name, drawn, .. } = &**scheme;
                let each: Vec<String> = drawn.iter().map(Drawn::to_string).collect();
                if drawn.is_empty() {
                    format!(
                        "leave it out: in runs of {name} nothing is drawn but layouts, such as cells:15x15:0.1"
                    )
                } else {
                    format!("leave it out; of {name} there would be drawn: {}", each.join("; "))
                }
            }
        }
    }
}

impl fmt::Display for SetupError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Robots { scheme, robots } => {
                let Profile { team, look, .. } = &**scheme;
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
            Self::Starts { scheme, starts, robots } => {
                let robots = counted(*robots, scheme.look.robot());
                write!(f, "{} for {robots}", counted(*starts, "start"))
            }
            Self::Start(problem) => problem.fmt(f),
            Self::Together(cell) => write!(f, "two robots start in the cell {cell}"),
            Self::Full { robots, cells } => {
                let (robots, cells) = (counted(*robots, "robot"), counted(*cells, "cell"));
                write!(f, "{robots} do not find room: from the base {cells} can be reached")
            }
            Self::Extra(scheme, extra) => {
                write!(f, "`{}` says nothing to the scheme {}", extra.field, scheme.name)
            }
            Self::Wrong(_, (what, _)) => f.write_str(what),
            Self::Seed(_) => f.write_str("`seed` has no effect: nothing here is left to chance"),
        }
    }
}

impl std::error::Error for SetupError {}

impl From<SetupError> for Diagnostic {
    fn from(misfit: SetupError) -> Self {
        Self::of_field(misfit.field(), &misfit, misfit.remedy())
    }
}

/// The fault of choices that no search has made.
pub(super) fn of_choices(what: impl fmt::Display) -> Diagnostic {
    Diagnostic::of_field("choices", what, "hunt again: choices come from a counterexample alone")
}

impl Scheme {
    /// The rule with this name.
    ///
    /// # Errors
    /// [`SetupError::Rule`] if the scheme does not offer it.
    pub fn find_rule(self, rule: RuleId) -> Result<&'static Rule, SetupError> {
        self.rule(rule).ok_or(SetupError::Rule { scheme: self, rule })
    }

    /// How a rule is hunted.
    ///
    /// # Errors
    /// A [`Diagnostic`] if the scheme does not offer it, or it is not hunted.
    pub fn hunt(self, rule: RuleId) -> Result<&'static dyn Hunt, Diagnostic> {
        self.find_rule(rule)?.hunt.ok_or_else(|| {
            Diagnostic::usage(format_args!("nothing is hunted of {}", self.name), "hunt another scheme")
        })
    }
}

impl Setup {
    /// `robots` as the number of a team of `scheme`.
    ///
    /// # Errors
    /// [`SetupError::Robots`].
    pub fn count(scheme: Scheme, robots: u64) -> Result<u16, SetupError> {
        let count = u16::try_from(robots).ok().filter(|&count| scheme.robots.contains(&count.into()));
        count.ok_or(SetupError::Robots { scheme, robots })
    }

    /// The rule of its scheme, if everything fits that.
    ///
    /// # Errors
    /// [`SetupError`], the first in the order of its variants.
    pub fn check(&self) -> Result<&'static Rule, SetupError> {
        let Self { scheme, robots, starts, .. } = self;
        Self::count(*scheme, (*robots).into())?;
        let (rule, scheme) = (scheme.find_rule(self.rule)?, *scheme);
        match scheme.senses {
            Senses::Bumps if !self.miss.is_never() => return Err(SetupError::Miss(scheme)),
            Senses::Bumps if !self.missed.is_empty() => return Err(SetupError::MissedByNone(scheme)),
            Senses::Floor if self.miss.is_certain() && self.limits.max_moves.is_none() => {
                return Err(SetupError::MissAll);
            }
            Senses::Floor if self.missed.first() == Some(&0) || !self.missed.is_sorted_by(|a, b| a < b) => {
                return Err(SetupError::Missed);
            }
            Senses::Bumps | Senses::Floor => {}
        }
        self.check_extras()?;
        match (scheme.starts, starts) {
            (Starts::Alone, None) => return Err(SetupError::Starts { scheme, starts: 1, robots: *robots }),
            (Starts::Alone | Starts::Beside, Some(starts)) if self.is_full(starts) => {
                return Err(SetupError::Full { robots: *robots, cells: starts.len() });
            }
            (Starts::Base, Some(_)) => return Err(SetupError::StartsAtBase(scheme)),
            (Starts::Base, None) => {}
            (Starts::Anywhere | Starts::Beside | Starts::Alone, Some(starts))
                if starts.len() != usize::from(*robots) =>
            {
                return Err(SetupError::Starts { scheme, starts: starts.len(), robots: *robots });
            }
            (Starts::Anywhere | Starts::Beside | Starts::Alone, starts) => {
                let starts = starts.as_deref().unwrap_or(std::slice::from_ref(&self.base));
                starts
                    .iter()
                    .try_for_each(|&start| self.layout.check_start(start))
                    .map_err(SetupError::Start)?;
            }
        }
        let is_again = |(place, start): (usize, &Cell)| {
            starts.iter().flatten().take(place).any(|other| other == start).then_some(*start)
        };
        let again = starts.iter().flatten().enumerate().find_map(is_again);
        match again.filter(|_| scheme.starts == Starts::Alone) {
            Some(cell) => Err(SetupError::Together(cell)),
            None => Ok(rule),
        }
    }

    /// Whether there are fewer starts than robots since there is no more room.
    fn is_full(&self, starts: &[Cell]) -> bool {
        let is_default = self.scheme.default_starts(self.rule, &self.layout, self.base, self.robots);
        starts.len() < self.robots.into() && is_default.is_some_and(|found| found == starts)
    }

    /// Refuses what the scheme cannot be told, and what is out of bounds.
    fn check_extras(&self) -> Result<(), SetupError> {
        let Self { scheme, robots, layout, options, .. } = self;
        let is_refused = |extra: &&Extra| extra.is_told_by(options) && !scheme.extras.contains(extra);
        if let Some(extra) = Extra::ALL.into_iter().find(is_refused) {
            return Err(SetupError::Extra(*scheme, extra));
        }
        let wrong =
            |extra: &'static Extra| Some(SetupError::Wrong(extra, (extra.wrong)(options, *robots, layout)?));
        Extra::ALL.into_iter().find_map(wrong).map_or(Ok(()), Err)
    }
}

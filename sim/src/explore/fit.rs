//! Whether a setup fits its scheme, wherever it comes from.

use std::fmt;

use tautline_kernel::ground::Cell;
use tautline_proofs::plural::counted;

use super::catalogue::Scheme;
use super::hunt::Hunt;
use super::rule::RuleId;
use super::setup::{Drawn, Rule, Senses, Setup, Starts};
use crate::diagnostic::Diagnostic;
use crate::options::Extra;

/// The fault of choices that no search has made.
pub(super) fn of_choices(what: impl fmt::Display) -> Diagnostic {
    Diagnostic::of_field("choices", what, "hunt again: choices come from a counterexample alone")
}

impl Scheme {
    /// The rule with this name.
    ///
    /// # Errors
    /// A [`Diagnostic`] if the scheme does not offer it.
    pub fn find_rule(self, rule: RuleId) -> Result<&'static Rule, Diagnostic> {
        self.rule(rule).ok_or_else(|| {
            let what = match rule {
                RuleId::PUBLISHED => format!("{} is ours: nobody has published it", self.name),
                rule => format!("{} has no rule {rule}", self.name),
            };
            Diagnostic::of_field("rule", what, self.which_rule())
        })
    }

    /// Which rules there are, for those who have asked for another one.
    pub fn which_rule(self) -> String {
        let names: Vec<&str> = self.rules.iter().map(|rule| rule.name.as_str()).collect();
        format!("take the rule {}, or another scheme than {}", names.join(" or "), self.name)
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

    /// `robots` as the number of a team of the scheme.
    ///
    /// # Errors
    /// A [`Diagnostic`] if no team has so many.
    pub fn count(self, robots: u64) -> Result<u16, Diagnostic> {
        let count = u16::try_from(robots).ok().filter(|&count| self.robots.contains(&count.into()));
        count.ok_or_else(|| {
            let (team, robot, has_base) = (self.team, self.look.robot(), self.look.has_base());
            let what = match (robots, has_base) {
                (0, _) => format!("no {robot}s are no {team}"),
                (1, true) => format!("the base alone is no {team}"),
                (robots, true) => format!("{robots} {robot}s are no {team}"),
                (robots, false) => format!("{robots} {robot}s are too many for a {team}"),
            };
            let (least, most) = (self.robots.start(), self.robots.end());
            let base = if has_base { ", the base counted" } else { "" };
            Diagnostic::of_field(
                "robots",
                what,
                format_args!("a {team} has {least} to {most} {robot}s{base}"),
            )
        })
    }

    /// The fault of a seed by which nothing is drawn.
    pub fn needless_seed(self) -> Diagnostic {
        let name = self.name;
        let drawn: Vec<String> = self.drawn.iter().map(Drawn::to_string).collect();
        let remedy = match drawn[..] {
            [] => {
                format!(
                    "leave it out: in runs of {name} nothing is drawn but layouts, such as cells:15x15:0.1"
                )
            }
            [..] => format!("leave it out; of {name} there would be drawn: {}", drawn.join("; ")),
        };
        Diagnostic::of_field("seed", "`seed` has no effect: nothing here is left to chance", remedy)
    }

    /// The fault of sensors that are missed where there are none; `what` says what is to be left out.
    pub(super) fn no_sensors(self, field: &'static str, what: &str) -> Diagnostic {
        let wrong = format!("the {}s of a {} have no floor sensors to miss", self.look.robot(), self.team);
        let remedy = format!("take {}, or leave out {what}", self.sensing(Senses::Floor));
        Diagnostic::of_field(field, wrong, remedy)
    }
}

impl Setup {
    /// The rule of its scheme, if everything fits that.
    ///
    /// # Errors
    /// A [`Diagnostic`] that names the first field that does not fit.
    pub fn check(&self) -> Result<&'static Rule, Diagnostic> {
        self.scheme.count(self.robots.into())?;
        let rule = self.scheme.find_rule(self.rule)?;
        self.check_misses()?;
        self.check_extras()?;
        self.check_starts()?;
        Ok(rule)
    }

    /// Refuses missed sensors where there are none, and those that make no run.
    fn check_misses(&self) -> Result<(), Diagnostic> {
        let Self { scheme, missed, .. } = self;
        match scheme.senses {
            Senses::Bumps if !self.miss.is_never() => Err(scheme.no_sensors("miss", "how likely that is")),
            Senses::Bumps if !missed.is_empty() => Err(scheme.no_sensors("missed", "what is missed")),
            Senses::Floor if self.miss.is_certain() && self.limits.max_moves.is_none() => {
                let remedy = "give a probability below 1, or end the run by `max-moves`";
                Err(Diagnostic::of_field("miss", "agents that miss every sensor go on for ever", remedy))
            }
            Senses::Floor if missed.first() == Some(&0) || !missed.is_sorted_by(|a, b| a < b) => {
                let what = "the numbers of the sensors that are missed are not in order";
                Err(Diagnostic::of_field("missed", what, "number them from 1 on, in order, each once"))
            }
            Senses::Bumps | Senses::Floor => Ok(()),
        }
    }

    /// Refuses what the scheme cannot be told, and what is out of bounds.
    fn check_extras(&self) -> Result<(), Diagnostic> {
        let Self { scheme, robots, layout, options, .. } = self;
        let is_refused = |extra: &&Extra| extra.is_told_by(options) && !scheme.extras.contains(extra);
        if let Some(extra) = Extra::ALL.into_iter().find(is_refused) {
            let what = format!("`{}` says nothing to the scheme {}", extra.field, scheme.name);
            let names = scheme.among.names(|scheme| scheme.extras.contains(&extra));
            let remedy = format!("take the scheme {}, or leave it out", names.join(" or "));
            return Err(Diagnostic::of_field(extra.field, what, remedy));
        }
        let wrong = |extra: &Extra| {
            let (what, remedy) = (extra.wrong)(options, *robots, layout)?;
            Some(Diagnostic::of_field(extra.field, what, remedy))
        };
        Extra::ALL.into_iter().find_map(wrong).map_or(Ok(()), Err)
    }

    /// Refuses starts that the scheme does not have.
    fn check_starts(&self) -> Result<(), Diagnostic> {
        let Self { scheme, robots, starts, .. } = self;
        let robot = scheme.look.robot();
        let wrong = |what: String, remedy: &str| Err(Diagnostic::of_field("starts", what, remedy));
        let are_not_for_each = |count: usize| {
            let what = format!("{} for {}", counted(count, "start"), counted(*robots, robot));
            wrong(what, &format!("give one start for all, or one for each {robot}"))
        };
        match (scheme.starts, starts) {
            (Starts::Alone, None) => return are_not_for_each(1),
            (Starts::Alone | Starts::Beside, Some(starts)) if self.is_full(starts) => {
                let (robots, cells) = (counted(*robots, "robot"), starts.len());
                let reached = counted(cells, "cell");
                let what = format!("{robots} do not find room: from the base {reached} can be reached");
                let remedy = format!("give `robots` a number up to {cells}, or take a larger layout");
                return Err(Diagnostic::of_field("robots", what, remedy));
            }
            (Starts::Base, Some(_)) => {
                let what = format!("the {robot}s of a {} start at the base", scheme.team);
                return wrong(what, "give the base another place by `base`");
            }
            (Starts::Base, None) => {}
            (Starts::Anywhere | Starts::Beside | Starts::Alone, Some(starts))
                if starts.len() != usize::from(*robots) =>
            {
                return are_not_for_each(starts.len());
            }
            (Starts::Anywhere | Starts::Beside | Starts::Alone, starts) => {
                for &start in starts.as_deref().unwrap_or(std::slice::from_ref(&self.base)) {
                    self.layout
                        .check_start(start)
                        .or_else(|problem| wrong(problem.to_string(), problem.remedy()))?;
                }
            }
        }
        let starts = starts.as_deref().unwrap_or_default();
        let is_again = |&(place, start): &(usize, &Cell)| starts[..place].contains(start);
        match starts.iter().enumerate().find(is_again).filter(|_| scheme.starts == Starts::Alone) {
            Some((_, cell)) => {
                wrong(format!("two robots start in the cell {cell}"), "give each robot a start of its own")
            }
            None => Ok(()),
        }
    }

    /// Whether there are fewer starts than robots since there is no more room.
    fn is_full(&self, starts: &[Cell]) -> bool {
        let is_default = self.scheme.default_starts(self.rule, &self.layout, self.base, self.robots);
        starts.len() < self.robots.into() && is_default.is_some_and(|found| found == starts)
    }
}

//! What of a setup does not fit its scheme, wherever it comes from.

use std::fmt;
use std::ops::RangeInclusive;

use tautline_kernel::frontier::Threshold;
use tautline_kernel::ground::Cell;
use tautline_proofs::plural::counted;

use super::catalogue::{SCHEMES, sensing};
use super::rule::RuleId;
use super::setup::{Drawn, Extra, Profile, Rule, Senses, Setup, Starts};
use crate::diagnostic::Diagnostic;
use crate::failures::Failure;
use crate::frontier::Options;
use crate::layout::Problem;

/// The greatest standard deviation of the noise of positions, in dB.
const MOST_NOISE_DB: f64 = 100.0;

/// The slowest and the fastest robots, in metres a second.
const SPEEDS_MPS: RangeInclusive<f64> = 0.001..=1000.0;

/// How much speeds may differ.
const SPREADS: RangeInclusive<f64> = 0.0..=0.999;

/// What does not fit: `Display` says what, [`SetupError::remedy`] what would be right.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum SetupError {
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
        /// The scheme.
        scheme: &'static Profile,
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
    Extra(&'static Profile, Extra),
    /// No threshold.
    Threshold,
    /// No noise.
    Noise,
    /// No speed.
    Speed,
    /// No spread of speeds.
    Spread,
    /// No wall can appear there.
    Wall(Cell),
    /// A wall that appears may shut the way over which the others re-form behind a robot that dies.
    WallAndFail,
    /// Nothing is drawn by the seed that is given.
    Seed(&'static Profile),
    /// No such robot can die.
    Fail {
        /// The robot, numbered from 1, the base.
        robot: u16,
        /// Robots that there are.
        robots: u16,
    },
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
            Self::Extra(_, extra) => extra.field(),
            Self::Threshold => Extra::Threshold.field(),
            Self::Noise => Extra::Noise.field(),
            Self::Speed => Extra::Speed.field(),
            Self::Spread => Extra::Spread.field(),
            Self::Wall(_) | Self::WallAndFail => Extra::Wall.field(),
            Self::Seed(_) => "seed",
            Self::Fail { .. } => Extra::Fail.field(),
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
            Self::Starts { scheme, .. } => {
                format!("give one start for all, or one for each {}", scheme.look.robot())
            }
            Self::Start(problem) => problem.remedy(),
            Self::Together(_) => "give each robot a start of its own".to_owned(),
            Self::Full { cells, .. } => {
                format!("give `robots` a number up to {cells}, or take a larger layout")
            }
            Self::Extra(_, extra) => {
                let fitting = SCHEMES.iter().filter(|scheme| scheme.extras.contains(extra));
                let names: Vec<&str> = fitting.map(|scheme| scheme.name).collect();
                format!("take the scheme {}, or leave it out", names.join(" or "))
            }
            Self::Threshold => "give `threshold` a number from 0 to 1".to_owned(),
            Self::Noise => "give `noise-db` a number of decibels from 0 to 100".to_owned(),
            Self::Speed => "give `speed` a number of metres a second from 0.001 to 1000".to_owned(),
            Self::Spread => "give `spread` a share from 0 to 0.999".to_owned(),
            Self::Wall(_) => "name a side between two cells of the layout, as in 7,6,E@20".to_owned(),
            Self::WallAndFail => "give `wall` and `fail` to two runs".to_owned(),
            Self::Seed(Profile { name, drawn: [], .. }) => {
                format!(
                    "leave it out: in runs of {name} nothing is drawn but layouts, such as cells:15x15:0.1"
                )
            }
            Self::Seed(Profile { name, drawn, .. }) => {
                let drawn: Vec<String> = drawn.iter().map(Drawn::to_string).collect();
                format!("leave it out; of {name} there would be drawn: {}", drawn.join("; "))
            }
            Self::Fail { robots, .. } => format!("name a robot from 2 to {robots}, as in {robots}@20"),
        }
    }
}

impl fmt::Display for SetupError {
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
                write!(f, "`{}` says nothing to the scheme {}", extra.field(), scheme.name)
            }
            Self::Threshold => f.write_str("a threshold of the occupancy probability is from 0 to 1"),
            Self::Noise => f.write_str("a standard deviation of noise is from 0 to 100 dB"),
            Self::Speed => f.write_str("a robot drives from 0.001 to 1000 m/s"),
            Self::Spread => f.write_str("drives are faster or slower by less than the whole speed"),
            Self::Wall(cell) => {
                write!(f, "no wall can appear on that side of the cell {cell}: it is not between two cells")
            }
            Self::WallAndFail => f.write_str(
                "a wall that appears may shut the way over which the others re-form behind a robot that dies",
            ),
            Self::Seed(_) => f.write_str("`seed` has no effect: nothing here is left to chance"),
            Self::Fail { robot: 1, .. } => f.write_str("the base cannot fail: there is no chain without it"),
            Self::Fail { robot, robots } => {
                write!(f, "there is no robot {robot} that could fail among {robots}")
            }
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

impl Setup {
    /// `robots` as the number of a team of `scheme`.
    ///
    /// # Errors
    /// [`SetupError::Robots`].
    pub fn count(scheme: &'static Profile, robots: u64) -> Result<u16, SetupError> {
        let count = u16::try_from(robots).ok().filter(|&count| scheme.robots.contains(&count.into()));
        count.ok_or(SetupError::Robots { scheme, robots })
    }

    /// The rule of its scheme, if everything fits that.
    ///
    /// # Errors
    /// [`SetupError`], the first in the order of its variants.
    pub fn check(&self) -> Result<&'static Rule, SetupError> {
        let Self { scheme, rule, robots, starts, .. } = self;
        Self::count(scheme, (*robots).into())?;
        let rule = scheme.rule(*rule).ok_or(SetupError::Rule { scheme, rule: *rule })?;
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
        let Options { noise_db, threshold, speed_mps, spread, fail, wall, .. } = self.options;
        let is_refused =
            |extra: &Extra| extra.is_told_by(&self.options) && !self.scheme.extras.contains(extra);
        if let Some(extra) = Extra::ALL.into_iter().find(is_refused) {
            return Err(SetupError::Extra(self.scheme, extra));
        }
        if let Some(Failure { robot, .. }) = fail.filter(|fail| !(2..=self.robots).contains(&fail.robot)) {
            return Err(SetupError::Fail { robot, robots: self.robots });
        }
        if let Some(wall) = wall {
            let edge = wall.edge();
            let is_between =
                [edge.cell(), edge.cell().beyond(edge.side())].iter().all(|&cell| self.layout.contains(cell));
            if !is_between || !self.layout.contains(wall.cell) {
                return Err(SetupError::Wall(wall.cell));
            }
            if fail.is_some() {
                return Err(SetupError::WallAndFail);
            }
        }
        if Threshold::new(threshold).is_none() {
            return Err(SetupError::Threshold);
        }
        if speed_mps.is_some_and(|speed| !SPEEDS_MPS.contains(&speed)) {
            return Err(SetupError::Speed);
        }
        if spread.is_some_and(|spread| !SPREADS.contains(&spread)) {
            return Err(SetupError::Spread);
        }
        if (0.0..=MOST_NOISE_DB).contains(&noise_db) { Ok(()) } else { Err(SetupError::Noise) }
    }
}

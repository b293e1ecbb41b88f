//! What is asked of an exploration, and what is chosen where nobody says: the same for the program and for others.

use tautline_kernel::ground::Cell;

use super::catalogue::Scheme;
use super::rule::RuleId;
use super::run::Limits;
use super::setup::{Senses, Setup, Starts};
use crate::diagnostic::Diagnostic;
use crate::layout::Layout;
use crate::layout::generate::Probability;
use crate::options::Options;

/// Robots of a team when nobody says how many: the team of the paper.
const DEFAULT_ROBOTS: u16 = 8;

/// What is asked of an exploration.
#[derive(Clone, Debug)]
pub struct Asked {
    /// The scheme.
    pub scheme: Scheme,
    /// One of its rules.
    pub rule: RuleId,
    /// Robots, the base counted if there is one. Else the layout says, or there are 8.
    pub robots: Option<u64>,
    /// The seed of whatever is left to chance.
    pub seed: u64,
    /// The base. Else it is where the first robot starts, or the layout says, or it is the free cell nearest the
    /// centre.
    pub base: Option<Cell>,
    /// Where the agents start: one cell for all, or one for each; none if the scheme is to choose.
    pub starts: Vec<Cell>,
    /// How likely it is that an agent misses a sensor.
    pub miss: Option<Probability>,
    /// What else the run is told.
    pub options: Options,
    /// When the run is stopped.
    pub limits: Limits,
}

impl Asked {
    /// A run of `rule` of which nothing else is said.
    pub fn new(scheme: impl Into<Scheme>, rule: impl Into<RuleId>) -> Self {
        Self {
            scheme: scheme.into(),
            rule: rule.into(),
            robots: None,
            seed: 0,
            base: None,
            starts: Vec::new(),
            miss: None,
            options: Options::default(),
            limits: Limits::default(),
        }
    }

    /// Refuses what fits no layout.
    ///
    /// # Errors
    /// A [`Diagnostic`] that says why.
    pub fn check(&self) -> Result<(), Diagnostic> {
        if self.scheme.senses == Senses::Bumps && self.miss.is_some() {
            return Err(self.scheme.no_sensors("miss", "how likely that is"));
        }
        Ok(())
    }

    /// The run in `layout`, before its start.
    ///
    /// # Errors
    /// A [`Diagnostic`] if it does not fit its scheme or its layout.
    pub fn setup(self, mut layout: Layout) -> Result<Setup, Diagnostic> {
        self.check()?;
        let Self { scheme, rule, seed, starts, options, limits, .. } = self;
        let robots = self.robots.unwrap_or_else(|| layout.robots().unwrap_or(DEFAULT_ROBOTS).into());
        let robots = scheme.count(robots)?;
        if let Some(&first) = starts.first() {
            layout.check_start(first)?;
        }
        let base = Setup::choose_base(&mut layout, self.base.or(starts.first().copied()))?;
        let starts = match (scheme.starts, starts.len()) {
            (_, 0) => scheme.default_starts(rule, &layout, base, robots),
            (Starts::Anywhere | Starts::Beside, 1) => None,
            (Starts::Base | Starts::Anywhere | Starts::Beside | Starts::Alone, _) => Some(starts),
        };
        let miss = self.miss.unwrap_or(Probability::NEVER);
        let setup =
            Setup { seed, starts, miss, options, limits, ..Setup::new(scheme, rule, robots, layout, base) };
        setup.check()?;
        Ok(setup)
    }
}

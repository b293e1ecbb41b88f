//! What is asked of an exploration, and what is chosen where nobody says: the same for the program and for others.

use tautline_kernel::ground::Cell;

use super::rule::RuleId;
use super::run::Limits;
use super::setup::{Profile, Senses, Setup, Starts};
use super::setup_error::SetupError;
use crate::diagnostic::Diagnostic;
use crate::failures::{Appearing, Failure, Going};
use crate::frontier::Options;
use crate::layout::Layout;
use crate::layout::generate::Probability;

/// Robots of a team when nobody says how many: the team of the paper.
const DEFAULT_ROBOTS: u16 = 8;

/// What is asked of an exploration.
#[derive(Clone, Debug)]
pub struct Asked {
    /// The scheme.
    pub scheme: &'static Profile,
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
    /// How many cells a message is heard; else all hear it.
    pub range_cells: Option<u16>,
    /// How many cells robots see.
    pub sight_cells: Option<u16>,
    /// How likely it is that such a message is lost.
    pub loss: Option<Probability>,
    /// The noise of positions, in dB.
    pub noise_db: Option<f64>,
    /// The threshold of the occupancy probability, from 0 to 1.
    pub threshold: Option<f64>,
    /// How fast robots drive, in m/s.
    pub speed_mps: Option<f64>,
    /// How far their speeds differ, as a share of it.
    pub spread: Option<f64>,
    /// Which robot dies, and when.
    pub fail: Option<Failure>,
    /// Which wall appears, and when.
    pub wall: Option<Appearing>,
    /// In what order robots go.
    pub going: Going,
    /// When the run is stopped.
    pub limits: Limits,
}

impl Asked {
    /// A run of `rule` of which nothing else is said.
    pub fn new(scheme: &'static Profile, rule: impl Into<RuleId>) -> Self {
        Self {
            scheme,
            rule: rule.into(),
            robots: None,
            seed: 0,
            base: None,
            starts: Vec::new(),
            miss: None,
            range_cells: None,
            sight_cells: None,
            loss: None,
            noise_db: None,
            threshold: None,
            speed_mps: None,
            spread: None,
            fail: None,
            wall: None,
            going: Going::AtOnce,
            limits: Limits::default(),
        }
    }

    /// Refuses what fits no layout.
    ///
    /// # Errors
    /// A [`Diagnostic`] that says why.
    pub fn check(&self) -> Result<(), Diagnostic> {
        if self.scheme.senses == Senses::Bumps && self.miss.is_some() {
            return Err(SetupError::Miss(self.scheme).into());
        }
        Ok(())
    }

    /// The run in `layout`, before its start.
    ///
    /// # Errors
    /// A [`Diagnostic`] if it does not fit its scheme or its layout.
    pub fn setup(self, mut layout: Layout) -> Result<Setup, Diagnostic> {
        self.check()?;
        let Self { scheme, rule, seed, starts, limits, .. } = self;
        let robots = self.robots.unwrap_or_else(|| layout.robots().unwrap_or(DEFAULT_ROBOTS).into());
        let robots = Setup::count(scheme, robots)?;
        if let Some(&first) = starts.first() {
            layout.check_start(first)?;
        }
        let base = Setup::choose_base(&mut layout, self.base.or(starts.first().copied()))?;
        let starts = match (scheme.starts, starts.len()) {
            (_, 0) => scheme.default_starts(rule, &layout, base, robots),
            (Starts::Anywhere | Starts::Beside, 1) => None,
            (Starts::Base | Starts::Anywhere | Starts::Beside | Starts::Alone, _) => Some(starts),
        };
        let usual = Options::default();
        let options = Options {
            range_cells: self.range_cells,
            sight_cells: self.sight_cells,
            loss: self.loss.unwrap_or(usual.loss),
            noise_db: self.noise_db.unwrap_or(usual.noise_db),
            threshold: self.threshold.unwrap_or(usual.threshold),
            speed_mps: self.speed_mps,
            spread: self.spread,
            fail: self.fail,
            wall: self.wall,
            going: self.going,
        };
        let miss = self.miss.unwrap_or(Probability::NEVER);
        let setup =
            Setup { seed, starts, miss, options, limits, ..Setup::new(scheme, rule, robots, layout, base) };
        setup.check()?;
        Ok(setup)
    }
}

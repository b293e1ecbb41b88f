//! A scheme as a row of data, and what such a row brings: its rules, its clauses and its hunts, which ask for the setup
//! of a run, as that names its scheme. Each of these types needs the others, hence they stand together.

use std::fmt;
use std::ops::RangeInclusive;
use std::path::Path;

use serde::{Deserialize, Serialize};
use serde_json::value::RawValue;
use tautline_io::checkpoint::Part;
use tautline_io::diagnostic::Diagnostic;
use tautline_kernel::ground::Cell;
use tautline_proofs::engine::tree::Progress;
use tautline_proofs::judge::Case;
use tautline_proofs::run::Frame;

use super::bounds::{Bound, CoveredBound, Dealt, Exhibit, Facts, Hunter, RunSize};
use super::clause::ClauseId;
use super::features::{Completeness, Knowledge, Look, RandomPart, Senses, Starts};
use super::rule::RuleId;
use super::run::{Limits, TeamMove};
use super::survey::Survey;
use super::team::Team;
use crate::options::{Extra, Options};
use tautline_grids::chance::Probability;
use tautline_grids::layout::{Layout, Size};

/// The schemes that a program knows, in lists behind each other.
#[derive(Clone, Copy, Debug)]
pub struct Catalogue(pub &'static [&'static [&'static Profile]]);

/// A scheme, and the catalogue that it is chosen from.
#[derive(Clone, Copy, Serialize)]
#[serde(transparent)]
pub struct Scheme {
    pub(super) row: &'static Profile,
    /// That catalogue.
    #[serde(skip)]
    pub among: Catalogue,
}

/// A scheme: a way for a team to explore. Whatever is not the scheme's own asks this row.
pub struct Profile {
    /// The word for it on the command line and in files.
    pub name: &'static str,
    /// One line about it.
    pub about: &'static str,
    /// Its rules.
    pub rules: &'static [Rule],
    /// The noun for its team.
    pub team: &'static str,
    /// How many robots a team can have, the base counted if there is one.
    pub robots: RangeInclusive<usize>,
    /// Where its robots start.
    pub starts: Starts,
    /// How its robots learn of the layout.
    pub senses: Senses,
    /// The options that a run of it can be told.
    pub extras: &'static [&'static Extra],
    /// Why an option has no effect in a run, and what would be right, if it has none.
    pub needless: fn(&Setup, &Extra) -> Option<(&'static str, &'static str)>,
    /// Whether a program that is told where robots are and what they bump into, or the open sides around them on a
    /// sensor floor, can plan as they do.
    pub told: Completeness,
    /// The things that its runs draw by their seed.
    pub drawn: &'static [RandomPart],
    /// How its team is drawn.
    pub look: Look,
    /// The knowledge that its team has of a sensor floor, if it is on one.
    pub knowledge: Option<Knowledge>,
    /// The clauses that its runs can break, in order.
    pub clauses: &'static [Clause],
    /// How its runs are written down for a judge.
    pub case: WriteCase,
}

/// Writes down a run of these team moves that is said to break a clause; `None` if no judge reads it.
pub type WriteCase = fn(&Setup, ClauseId, &[Frame]) -> Option<Box<dyn Case>>;

/// A clause that a run can break.
#[derive(Clone, Copy, Debug)]
pub struct Clause {
    /// Its id.
    pub id: ClauseId,
    /// How a team move breaks it, one line for each pair or cell.
    pub lines: fn(&Setup, &Survey, &TeamMove<'_>) -> Vec<String>,
    /// If it is about the end of a run: what the cells are that are missed.
    pub missed: Option<&'static str>,
}

impl Clause {
    /// The clause with this id, of which the words of the clause itself tell enough.
    pub const fn new(id: &'static str) -> Self {
        Self { id: ClauseId::new(id), lines: |_, _, _| Vec::new(), missed: None }
    }
}

/// A rule of a scheme.
#[derive(Clone, Copy, Debug)]
pub struct Rule {
    /// Its name.
    pub name: RuleId,
    /// One line about it.
    pub about: &'static str,
    /// The team of a setup at its start.
    pub start: Start,
    /// How it is hunted, if it is.
    pub hunt: Option<&'static dyn Hunt>,
    /// Its conditions, if it has any that can be switched.
    pub switches: Option<&'static dyn Switches>,
}

impl Rule {
    /// A rule that is not hunted.
    pub const fn new(name: RuleId, about: &'static str, start: Start) -> Self {
        Self { name, about, start, hunt: None, switches: None }
    }

    /// This rule, hunted so.
    pub const fn hunted(self, hunt: &'static dyn Hunt) -> Self {
        Self { hunt: Some(hunt), ..self }
    }

    /// This rule, whose conditions can be switched.
    pub const fn switched(self, switches: &'static dyn Switches) -> Self {
        Self { switches: Some(switches), ..self }
    }

    /// As the paper publishes it.
    pub const fn published(start: Start) -> Self {
        Self::new(RuleId::PUBLISHED, "As the paper publishes it", start)
    }

    /// With the repairs of its refuted claims.
    pub const fn repaired(start: Start) -> Self {
        Self::new(RuleId::REPAIRED, "With the repairs of its refuted claims", start)
    }
}

/// The team of a setup at its start.
pub type Start = fn(&Setup) -> Result<Box<dyn Team>, Diagnostic>;

/// The conditions of a rule, which can be switched one by one: with one off that the rule has, it is a mutant.
pub trait Switches: fmt::Debug + Sync {
    /// The conditions, each by its name and the sentence that it stands for.
    fn conditions(&self) -> &'static [(&'static str, &'static str)];

    /// Those in force, a bit for each in their order.
    fn in_force(&self) -> u32;

    /// The team of a setup, with these conditions in force and no others.
    ///
    /// # Errors
    /// A [`Diagnostic`] if the setup does not fit its scheme.
    fn start(&self, setup: &Setup, in_force: u32) -> Result<Box<dyn Team>, Diagnostic>;

    /// The hunt with these conditions in force and no others, if there is one.
    fn hunt(&self, in_force: u32) -> Option<Box<dyn Hunt>>;
}

/// A run before its start: what stands still while it goes on. The same setup makes the same run.
#[derive(Clone, Debug)]
pub struct Setup {
    /// The scheme.
    pub scheme: Scheme,
    /// One of its rules.
    pub rule: RuleId,
    /// Robots, the base of a chain included.
    pub robots: u16,
    /// The seed of whatever is left to chance.
    pub seed: u64,
    /// The ground truth.
    pub layout: Layout,
    /// Where the robots start that have no start of their own: a free cell.
    pub base: Cell,
    /// Where each agent starts, if not all start at the base: free cells.
    pub starts: Option<Vec<Cell>>,
    /// How likely it is that an agent misses a sensor that it could see.
    pub miss: Probability,
    /// Which sensors are missed besides: their numbers among all that agents ask about, counted from 1, in order.
    pub missed: Vec<u32>,
    /// The options that the run is told.
    pub options: Options,
    /// The choices that make the run, where a search has found it; else it is left to chance.
    pub choices: Vec<u32>,
    /// When the run is stopped.
    pub limits: Limits,
}

/// A search of all layouts within bounds for runs that break a clause.
pub trait Hunt: fmt::Debug + Sync {
    /// The bounds that it takes besides the number of robots, the size and the budget.
    fn takes(&self) -> &'static [Bound];

    /// Why it does not take `bound`: what is wrong, and what would be right.
    fn refusal(&self, bound: Bound) -> (String, String) {
        bound.refused_by(self.takes())
    }

    /// Searches within what is `asked`, until everything is searched or `hunter` ends the search.
    ///
    /// # Errors
    /// A [`Diagnostic`] if it cannot be searched so.
    fn hunt(&self, asked: &HuntRequest<'_>, hunter: &mut dyn Hunter) -> Result<HuntReport, Diagnostic>;

    /// These bounds, with those within which the choices of the run of `setup` were found.
    fn again(&self, _setup: &Setup, bounds: HuntBounds) -> HuntBounds {
        bounds
    }

    /// The hunt as one that is dealt out among shards, if that is possible.
    fn deals(&self) -> Option<&dyn Deals> {
        None
    }

    /// The hunt for what is `asked` as one that is made a little at a time, if that is possible.
    ///
    /// # Errors
    /// A [`Diagnostic`] if it cannot be searched so.
    fn begin(&self, _asked: &HuntRequest<'_>) -> Result<Option<Box<dyn OngoingHunt>>, Diagnostic> {
        Ok(None)
    }
}

/// The question that a hunt answers.
#[derive(Clone, Copy, Debug)]
pub struct HuntRequest<'a> {
    /// The scheme.
    pub scheme: Scheme,
    /// Its rule.
    pub rule: RuleId,
    /// The bounds.
    pub bounds: HuntBounds,
    /// Team moves after which the search ends, those of earlier calls not counted.
    pub budget: Option<u64>,
    /// [`Bound::Resume`]
    pub resume: Option<&'a Path>,
}

/// The bounds of a hunt, as a plan deals them out, too. Whatever is not given is the hunt's to choose.
#[derive(Clone, Copy, Default, Debug, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct HuntBounds {
    /// Robots.
    pub robots: Option<u64>,
    /// Columns and rows.
    pub size: Option<Size>,
    /// [`Bound::Walls`]
    pub max_walls: Option<u32>,
    /// [`Bound::Cells`]
    pub max_cells: Option<u32>,
    /// [`Bound::Misses`]
    pub max_misses: Option<u8>,
    /// [`Bound::Losses`]
    pub max_losses: Option<u8>,
    /// [`Bound::Error`], in cells.
    pub error_cells: Option<f64>,
    /// [`Bound::Range`], in cells.
    pub range_cells: Option<u16>,
    /// Whether runs of robots at equal speeds alone are looked for.
    pub equal_speeds: bool,
}

/// The outcome of a hunt.
#[derive(Clone, Debug)]
pub struct HuntReport {
    /// Robots.
    pub robots: u64,
    /// The clauses that were looked for, in the order of their families and numbers.
    pub looked_for: Vec<&'static str>,
    /// How much was searched, and within which bounds.
    pub facts: Facts,
    /// Whether every layout within the bounds was covered.
    pub is_complete: bool,
    /// The bound up to which every layout was covered, if any was.
    pub done: CoveredBound,
    /// The first line for people, behind the scheme and its rule.
    pub title: String,
    /// The runs and moves that were searched through, for the log.
    pub through: String,
    /// The conclusion: the second line for people.
    pub outcome: String,
    /// The clauses whose run with the fewest walls was still looked for when the hunt was ended. Of a run that goes
    /// round none may be found then.
    pub not_minimised: Vec<&'static str>,
    /// A run that breaks each clause: the smallest one, unless the hunt was ended before.
    pub found: Vec<Finding>,
}

/// A run that breaks a clause.
#[derive(Clone, Debug)]
pub struct Finding {
    /// The clause.
    pub clause: &'static str,
    /// How large the run is.
    pub facts: RunSize,
    /// The size of the run for people, behind the clause.
    pub title: String,
    /// The run.
    pub setup: Setup,
    /// How it is shown, and whether it is stored.
    pub shown: Exhibit,
}

/// A hunt that is made a little at a time.
pub trait OngoingHunt {
    /// Hunts a little further. Returns whether there is more to do, and to spend.
    fn step(&mut self) -> bool;

    /// How far it is.
    fn progress(&self) -> Progress<'_>;

    /// The report of what was found so far, for what was `asked`.
    ///
    /// # Errors
    /// A [`Diagnostic`] if what was found fits into no layout.
    fn report(&self, asked: &HuntRequest<'_>) -> Result<HuntReport, Diagnostic>;
}

/// A hunt that can be dealt out among shards, each of which is searched where one likes.
pub trait Deals {
    /// Deals out what is `asked` among so many shards.
    ///
    /// # Errors
    /// A [`Diagnostic`] if it cannot be searched so.
    fn deal(&self, asked: &HuntRequest<'_>, shards: usize) -> Result<Dealt, Diagnostic>;

    /// One shard of a deal, the first being 0, of so many, where it was. The scheme, the rule and the budget are
    /// `asked`, all else the deal has.
    ///
    /// # Errors
    /// A [`Diagnostic`] if there is no such deal, or the shard was never there.
    fn part<'a>(
        &'a self,
        asked: &HuntRequest<'_>,
        deal: &RawValue,
        shard: (usize, usize),
        far: Option<&RawValue>,
    ) -> Result<Box<dyn Part + 'a>, Diagnostic>;

    /// The report of what all shards have found. The scheme and the rule are `asked`.
    ///
    /// # Errors
    /// A [`Diagnostic`] if they do not fit their deal.
    fn merge(
        &self,
        asked: &HuntRequest<'_>,
        deal: &RawValue,
        shards: &[&RawValue],
    ) -> Result<HuntReport, Diagnostic>;
}

impl fmt::Debug for Scheme {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.row.fmt(f)
    }
}

impl fmt::Debug for Profile {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name)
    }
}

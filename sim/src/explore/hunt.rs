//! Hunts: what a rule's row brings, so that all small layouts can be searched for runs that break a clause. A hunt says
//! which bounds it takes, and returns what it has found as plain data; storing, drawing and printing are the same for
//! all hunts.

use std::fmt;
use std::ops::ControlFlow;
use std::path::Path;

use schemars::JsonSchema;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use serde_json::value::RawValue;
use tautline_io::checkpoint::{Part, decode, encode};
use tautline_io::diagnostic::Diagnostic;
use tautline_kernel::ground::{Cell, Edge};
use tautline_proofs::chain::areas::AreaSearch;
use tautline_proofs::engine::tree::Progress;
use tautline_proofs::plural::counted;
use tautline_proofs::run::Run;

use super::catalogue::{Profile, Scheme};
use super::clause::ClauseId;
use super::rule::RuleId;
use super::run::Limits;
use super::setup::Setup;
use tautline_grids::layout::{Layout, Size};

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

    /// The request `asked`, with the bounds within which the choices of the run of `setup` were found.
    fn again<'a>(&self, setup: &Setup, asked: HuntRequest<'a>) -> HuntRequest<'a> {
        let _ = setup;
        asked
    }

    /// The hunt as one that is dealt out among shards, if that is possible.
    fn deals(&self) -> Option<&dyn Deals> {
        None
    }

    /// The hunt for what is `asked` as one that is made a little at a time, if that is possible.
    ///
    /// # Errors
    /// A [`Diagnostic`] if it cannot be searched so.
    fn begin(&self, asked: &HuntRequest<'_>) -> Result<Option<Box<dyn OngoingHunt>>, Diagnostic> {
        let _ = asked;
        Ok(None)
    }
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

impl Scheme {
    /// The fault of a rule that is not hunted.
    pub fn not_hunted(self) -> Diagnostic {
        let what = format!("nothing is hunted of {}", self.name);
        let remedy = match self.among.names(Profile::is_hunted) {
            hunted if hunted.is_empty() => "hunt another scheme".to_owned(),
            hunted => format!("hunt {}", hunted.join(", ")),
        };
        Diagnostic::usage(what, remedy)
    }

    /// How a rule is hunted.
    ///
    /// # Errors
    /// A [`Diagnostic`] if the scheme does not offer it, or it is not hunted.
    pub fn hunt(self, rule: RuleId) -> Result<&'static dyn Hunt, Diagnostic> {
        self.find_rule(rule)?.hunt.ok_or_else(|| self.not_hunted())
    }
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

/// A hunt that is dealt out.
#[derive(Clone, Debug)]
pub struct Dealt {
    /// The deal, as a plan has it.
    pub deal: Box<RawValue>,
    /// About how much each shard has.
    pub left: Vec<u64>,
    /// Of what.
    pub of: &'static str,
    /// Team moves that were made to deal it out.
    pub moves: u64,
}

/// The remedy for a shard that was never there.
pub(super) const RUN_AGAIN: &str = "run the shard again";

/// A hunt that is dealt out, and how it is, as a plan has it.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Deal<T> {
    robots: Option<u64>,
    size: Option<(i16, i16)>,
    max_walls: Option<u32>,
    max_misses: Option<u8>,
    max_losses: Option<u8>,
    error_cells: Option<f64>,
    how: T,
}

impl<T: Serialize + DeserializeOwned> Deal<T> {
    /// The deal of what is `asked`, as a plan has it.
    pub(super) fn write(asked: &HuntRequest<'_>, how: T) -> Result<Box<RawValue>, Diagnostic> {
        let &HuntRequest { robots, max_walls, max_misses, max_losses, error_cells, .. } = asked;
        let size = asked.size.map(|size| (size.width(), size.height()));
        encode(&Self { robots, size, max_walls, max_misses, max_losses, error_cells, how })
    }

    /// The hunt that is dealt out, and how it is: the scheme, the rule and the budget stand in `asked`.
    pub(super) fn read<'a>(
        text: &RawValue,
        asked: &HuntRequest<'a>,
    ) -> Result<(HuntRequest<'a>, T), Diagnostic> {
        let deal = decode(text, "plan anew")?;
        let Self { robots, size, max_walls, max_misses, max_losses, error_cells, how } = deal;
        let size = size.map(|(width, height)| Size::new(width as u64, height as u64)).transpose();
        let size = size.map_err(|problem| problem.with_remedy("plan anew"))?;
        Ok((HuntRequest { robots, size, max_walls, max_misses, max_losses, error_cells, ..*asked }, how))
    }
}

/// A bound that some hunts take and others do not.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Bound {
    /// The most walls that are met in one run.
    Walls,
    /// The most cells of an area, where all areas are searched.
    Cells,
    /// The most sensors that are missed in one run.
    Misses,
    /// The most messages that are lost in one run.
    Losses,
    /// How far a fix may be off.
    Error,
    /// How far robots hear each other.
    Range,
    /// The file in which the hunt is kept.
    Resume,
}

impl Bound {
    /// The field that gives it.
    pub const fn field(self) -> &'static str {
        match self {
            Self::Walls => "max-walls",
            Self::Cells => "max-cells",
            Self::Misses => "max-misses",
            Self::Losses => "max-losses",
            Self::Error => "error",
            Self::Range => "range",
            Self::Resume => "resume",
        }
    }

    /// Why a hunt that takes others does not take this one.
    pub(super) fn refused_by(self, takes: &[Self]) -> (String, String) {
        let taken = ["robots", "size", "budget"].into_iter().chain(takes.iter().map(|bound| bound.field()));
        let taken: Vec<String> = taken.map(|field| format!("`{field}`")).collect();
        let field = self.field();
        (
            format!("`{field}` does not bound this hunt"),
            format!("leave it out; this hunt takes {}", taken.join(", ")),
        )
    }
}

/// The question that a hunt answers. Whatever is not given is the hunt's to choose.
#[derive(Clone, Copy, Debug)]
pub struct HuntRequest<'a> {
    /// The scheme.
    pub scheme: Scheme,
    /// Its rule.
    pub rule: RuleId,
    /// Robots.
    pub robots: Option<u64>,
    /// Columns and rows.
    pub size: Option<Size>,
    /// Team moves after which the search ends, those of earlier calls not counted.
    pub budget: Option<u64>,
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
    /// [`Bound::Resume`]
    pub resume: Option<&'a Path>,
}

impl HuntRequest<'_> {
    /// The hunt of a scheme by a rule, everything else being its own to choose.
    pub fn new(scheme: impl Into<Scheme>, rule: RuleId) -> Self {
        Self {
            scheme: scheme.into(),
            rule,
            robots: None,
            size: None,
            budget: None,
            max_walls: None,
            max_cells: None,
            max_misses: None,
            max_losses: None,
            error_cells: None,
            range_cells: None,
            resume: None,
        }
    }

    /// The run of robots from `starts` in `layout`. It stops where it breaks `clause`, and may break others before; if
    /// none is named, it stops at its first violation.
    ///
    /// # Errors
    /// [`Diagnostic`] if the base is no free cell.
    pub(super) fn setup(
        &self,
        mut layout: Layout,
        starts: Vec<Cell>,
        clause: Option<ClauseId>,
    ) -> Result<Setup, Diagnostic> {
        let base = Setup::choose_base(&mut layout, starts.first().copied())?;
        let mut setup = Setup::new(self.scheme, self.rule, starts.len() as u16, layout, base);
        setup.options.range_cells = self.range_cells;
        Ok(Setup { limits: Limits::stopping_at(clause), ..setup.starting_in(starts) })
    }

    /// Refuses a bound that is given and that `hunt` does not take.
    ///
    /// # Errors
    /// A [`Diagnostic`] that says why.
    pub fn check(&self, hunt: &dyn Hunt) -> Result<(), Diagnostic> {
        let given = [
            (Bound::Walls, self.max_walls.is_some()),
            (Bound::Cells, self.max_cells.is_some()),
            (Bound::Misses, self.max_misses.is_some()),
            (Bound::Losses, self.max_losses.is_some()),
            (Bound::Error, self.error_cells.is_some()),
            (Bound::Range, self.range_cells.is_some()),
            (Bound::Resume, self.resume.is_some()),
        ];
        let refused = given.into_iter().find(|(bound, is_given)| *is_given && !hunt.takes().contains(bound));
        refused.map_or(Ok(()), |(bound, _)| {
            let (what, remedy) = hunt.refusal(bound);
            Err(Diagnostic::usage(what, remedy))
        })
    }
}

impl fmt::Display for Dealt {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (shards, sum) = (self.left.len() as u64, self.left.iter().sum::<u64>());
        let (mean, most) = (sum / shards.max(1), self.left.iter().max().copied().unwrap_or(0));
        let (shards, mean, most) = (counted(shards, "shard"), counted(mean, self.of), counted(most, self.of));
        write!(f, "{shards} of about {mean}, the largest {most}")?;
        match self.moves {
            0 => f.write_str("."),
            made => write!(f, "; {made} are made already."),
        }
    }
}

/// Hears how far a hunt is.
pub trait Hunter {
    /// The hunt is so far. Whoever breaks ends it.
    fn hears(&mut self, far: Far<'_>) -> ControlFlow<()>;

    /// The file in which the hunt is kept could not be written at the end.
    fn is_left_out(&mut self, fault: &Diagnostic);
}

/// How far a hunt is.
#[derive(Debug)]
pub enum Far<'a> {
    /// So far in a tree, whose size can be estimated.
    Tree(&'a Progress<'a>),
    /// So far, in words.
    Words(String),
}

/// How much a hunt has searched, and within which bounds, under the names that JSON has for them.
#[derive(Clone, PartialEq, Debug, JsonSchema, Serialize)]
#[serde(untagged)]
#[expect(
    missing_docs,
    reason = "the fields are named as in the options of the hunts and in the text for people"
)]
pub enum Facts {
    /// Of runs in one area.
    Runs { runs: u64, moves: u64, longest: u32, max_walls: u32 },
    /// Of runs in all areas of at most so many cells.
    Areas { runs: u64, moves: u64, max_walls: u32, max_cells: u32, areas: Vec<AreaSearch> },
    /// Of layouts with missed sensors, each searched by itself.
    Layouts { size: String, layouts: u64, states: u64, steps: u64, max_misses: u8 },
    /// Of states, with lost messages and wrong fixes.
    StatesWithLosses {
        size: String,
        states: u64,
        steps: u64,
        max_walls: Option<u32>,
        max_losses: u8,
        error: Option<f64>,
    },
    /// Of states.
    States {
        size: String,
        states: u64,
        steps: u64,
        max_walls: Option<u32>,
        #[serde(skip_serializing_if = "Option::is_none")]
        range: Option<u16>,
    },
}

/// The bound up to which every layout was covered, if any was.
#[derive(Clone, Copy, PartialEq, Eq, Debug, JsonSchema, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum CoveredBound {
    /// So many walls.
    WallsDone(Option<u32>),
    /// Areas of so many cells.
    CellsDone(Option<u32>),
    /// So many missed sensors.
    MissesDone(Option<u8>),
    /// Layouts of so many nodes.
    NodesDone(Option<usize>),
}

/// How large a run is, under the names that JSON has for it.
#[derive(Clone, Copy, PartialEq, Eq, Debug, JsonSchema, Serialize)]
#[serde(untagged)]
#[expect(missing_docs, reason = "the fields are named as in the text for people")]
pub enum RunSize {
    /// In the one area that is searched: `runs` of them break the clause.
    Runs { runs: u64, walls: usize, steps: usize },
    /// In an area of its own. Of KIT `steps` are drives alone, and not decisions to stay.
    Area { columns: usize, rows: usize, walls: usize, steps: usize },
    /// In an area of its own, with missed sensors.
    Misses { misses: usize, columns: i16, rows: i16, steps: u32 },
}

/// The outcome of a hunt.
#[derive(Clone, Debug)]
pub struct HuntReport {
    /// Robots.
    pub robots: u64,
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

/// How a run that was found is shown.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Exhibit {
    /// By its last team move. It is stored as a run that breaks this clause.
    Run(ClauseId),
    /// By its layout. A run without end is not stored.
    Endless,
    /// By what happens in it. It is stored as a run that breaks this clause.
    Story(ClauseId, String),
    /// By what happens in it. No file tells it.
    Told(String),
}

/// The conclusion from what a hunt has found: within its whole bound, or, where it was ended before, among the layouts
/// that it had `covered` by then, if any: what it has found beyond those need not be the smallest.
pub(super) fn outcome(found: &[Finding], is_whole: bool, covered: Option<String>) -> String {
    match (found, is_whole, covered) {
        ([], true, _) => "No clause is broken in any layout within this bound.".to_owned(),
        ([], false, Some(covered)) => {
            format!("No clause is broken in any layout {covered}; the hunt was ended before its bound.")
        }
        ([], false, None) => {
            "No clause is broken so far; the hunt was ended before it had covered any layout.".to_owned()
        }
        (_, true, _) => {
            "The smallest counterexample to each clause that is broken in any layout within this bound:"
                .to_owned()
        }
        (_, false, Some(covered)) => format!(
            "Found before the hunt was ended, when all layouts {covered} were covered; those beyond need not be the \
             smallest:"
        ),
        (_, false, None) => {
            "Found before the hunt was ended, when no layout was covered; they need not be the smallest:"
                .to_owned()
        }
    }
}

/// The run of `scheme` that `found` is, in the area of its search; it stops at the violation of what it was found for,
/// and may break other clauses before.
///
/// # Errors
/// [`Diagnostic`] if the area is too large for a layout, or the base is outside.
pub fn setup(scheme: Scheme, rule: impl Into<RuleId>, found: &Run) -> Result<Setup, Diagnostic> {
    let (layout, starts) = layout(found)?;
    HuntRequest::new(scheme, rule.into()).setup(layout, starts, found.breaks.map(ClauseId::new))
}

/// The layout of a run that was found, which has the walls that were met and no others; and where the robots start in
/// it.
///
/// # Errors
/// [`Diagnostic`] if the area is too large for a layout.
pub fn layout(found: &Run) -> Result<(Layout, Vec<Cell>), Diagnostic> {
    let origin = found.area.first();
    let shifted = |cell: Cell| Cell::new(cell.x - origin.x, cell.y - origin.y);
    let walls = found.walls.iter().map(|wall| Edge::new(shifted(wall.cell()), wall.side()));
    let mut layout = Layout::open(found.area.width() as u64, found.area.height() as u64)?.with_walls(walls);
    for &cell in &found.obstacles {
        layout.block(shifted(cell));
    }
    Ok((layout, found.starts.iter().copied().map(shifted).collect()))
}

//! Hunts: what a rule's row brings, so that all small layouts can be searched for runs that break a clause. A hunt says
//! which bounds it takes, and returns what it has found as plain data; storing, drawing and printing are the same for
//! all hunts.

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use serde_json::value::RawValue;
use tautline_io::checkpoint::{decode, encode};
use tautline_io::diagnostic::Diagnostic;
use tautline_kernel::ground::{Cell, Edge};
use tautline_proofs::run::Run;

pub use super::bounds::{Bound, CoveredBound, Dealt, Exhibit, Facts, Far, Hunter, RunSize};
pub use super::scheme::{Deals, Finding, Hunt, HuntReport, HuntRequest, OngoingHunt};
use super::setup::{ALONE, needless};
use super::{ClauseId, Limits, Profile, RuleId, Scheme, Setup};
use tautline_grids::layout::{Layout, Size};

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
            equal_speeds: false,
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

    /// Refuses a bound that is given, and that `hunt` does not take or that has no effect.
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
        for (bound, _) in given.into_iter().filter(|(_, is_given)| *is_given) {
            if !hunt.takes().contains(&bound) {
                let (what, remedy) = hunt.refusal(bound);
                return Err(Diagnostic::usage(what, remedy));
            }
            if self.robots == Some(1) && matches!(bound, Bound::Losses | Bound::Range) {
                return Err(needless(bound.field(), ALONE));
            }
        }
        Ok(())
    }
}

/// The conclusion from what a hunt has found: within its whole bound, or, where it was ended before, among the layouts
/// that it had `covered` by then, if any: what it has found beyond those need not be the smallest.
pub(super) fn outcome(found: &[Finding], is_whole: bool, covered: Option<String>) -> String {
    let none = "No clause that is looked for is broken";
    match (found, is_whole, covered) {
        ([], true, _) => format!("{none} in any layout within this bound."),
        ([], false, Some(covered)) => {
            format!("{none} in any layout {covered}; the hunt was ended before its bound.")
        }
        ([], false, None) => format!("{none} so far; the hunt was ended before it had covered any layout."),
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

/// All areas up to a size, fewest cells first.
pub(crate) fn areas(size: Size) -> Vec<(i16, i16)> {
    let mut areas: Vec<(i16, i16)> =
        (1..=size.height()).flat_map(|height| (1..=size.width()).map(move |width| (width, height))).collect();
    areas.sort_by_key(|&(width, height)| (width * height, height));
    areas
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
    let layout = Layout::open(found.area.width() as u64, found.area.height() as u64)?.with_walls(walls);
    let layout = layout.with_blocked(found.obstacles.iter().copied().map(shifted));
    Ok((layout, found.starts.iter().copied().map(shifted).collect()))
}

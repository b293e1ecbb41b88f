//! Hunts: what a rule's row brings, so that all small layouts can be searched for runs that break a clause. A hunt says
//! which bounds it takes, and returns what it has found as plain data; storing, drawing and printing are the same for
//! all hunts.

use std::collections::BTreeSet;

use serde::de::DeserializeOwned;
use serde_json::value::RawValue;
use tautline_io::checkpoint::decode;
use tautline_io::diagnostic::Diagnostic;
use tautline_kernel::ground::{Cell, Edge};
use tautline_proofs::run::Run;

pub use super::bounds::{Bound, CoveredBound, Dealt, Exhibit, Facts, Far, Hunter, RunSize};
pub use super::scheme::{Deals, Finding, Hunt, HuntBounds, HuntReport, HuntRequest, OngoingHunt};
use super::setup::{ALONE, needless};
use super::{ClauseId, Limits, Profile, RuleId, Scheme, Setup};
use tautline_grids::layout::Layout;

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

/// The hunt that is dealt out, and how it is: a plan has its bounds and that, and the scheme, the rule and the budget
/// stand in `asked`.
pub(super) fn read_deal<'a, T: DeserializeOwned>(
    deal: &RawValue,
    asked: &HuntRequest<'a>,
) -> Result<(HuntRequest<'a>, T), Diagnostic> {
    let (bounds, how) = decode(deal, "plan anew")?;
    Ok((HuntRequest { bounds, ..*asked }, how))
}

impl HuntRequest<'_> {
    /// The hunt of a scheme by a rule, everything else being its own to choose.
    pub fn new(scheme: impl Into<Scheme>, rule: RuleId) -> Self {
        Self { scheme: scheme.into(), rule, bounds: HuntBounds::default(), budget: None, resume: None }
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
        setup.options.range_cells = self.bounds.range_cells;
        Ok(Setup { limits: Limits::stopping_at(clause), ..setup.starting_in(starts) })
    }

    /// Refuses a bound that is given, and that `hunt` does not take or that has no effect.
    ///
    /// # Errors
    /// A [`Diagnostic`] that says why.
    pub fn check(&self, hunt: &dyn Hunt) -> Result<(), Diagnostic> {
        let bounds = &self.bounds;
        let given = [
            (Bound::Walls, bounds.max_walls.is_some()),
            (Bound::Cells, bounds.max_cells.is_some()),
            (Bound::Misses, bounds.max_misses.is_some()),
            (Bound::Losses, bounds.max_losses.is_some()),
            (Bound::Error, bounds.error_cells.is_some()),
            (Bound::Range, bounds.range_cells.is_some()),
            (Bound::Resume, self.resume.is_some()),
        ];
        for (bound, _) in given.into_iter().filter(|(_, is_given)| *is_given) {
            if !hunt.takes().contains(&bound) {
                let (what, remedy) = hunt.refusal(bound);
                return Err(Diagnostic::usage(what, remedy));
            }
            if bounds.robots == Some(1) && matches!(bound, Bound::Losses | Bound::Range) {
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

/// These clauses in the order of their families and numbers, which is that of the ledger, each once.
pub(super) fn in_order(clauses: impl IntoIterator<Item = &'static str>) -> Vec<&'static str> {
    let clauses: BTreeSet<ClauseId> = clauses.into_iter().map(ClauseId::new).collect();
    clauses.into_iter().map(ClauseId::as_str).collect()
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

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use serde_json::Value;
    use tautline_io::checkpoint::encode;

    use super::super::RuleId;
    use super::super::chain::CHAIN;
    use super::*;

    /// A hunt that takes no bound.
    #[derive(Debug)]
    struct Boundless;

    impl Hunt for Boundless {
        fn takes(&self) -> &'static [Bound] {
            &[]
        }

        fn hunt(&self, _: &HuntRequest<'_>, _: &mut dyn Hunter) -> Result<HuntReport, Diagnostic> {
            Err(self.refusal(Bound::Walls)).map_err(|(what, remedy)| Diagnostic::usage(what, remedy))
        }
    }

    const ALL: &str = concat!(
        r#"{"robots":2,"size":[3,2],"max_walls":1,"max_cells":6,"max_misses":1,"max_losses":1,"#,
        r#""error_cells":1.0,"range_cells":3,"equal_speeds":true}"#
    );

    fn asked(bounds: HuntBounds) -> HuntRequest<'static> {
        HuntRequest { bounds, ..HuntRequest::new(&CHAIN, RuleId::PUBLISHED) }
    }

    #[test]
    fn no_bound_is_lost_in_a_plan() {
        let bounds: HuntBounds = serde_json::from_str(ALL).expect("bounds");
        let deal = encode(&(bounds, ())).expect("a deal");
        let (read, ()) = read_deal(&deal, &asked(HuntBounds::default())).expect("a deal");
        assert_eq!(serde_json::to_string(&read.bounds).expect("bounds"), ALL);
    }

    #[test]
    fn a_plan_with_other_bounds_is_refused() {
        for other in
            [r#"{"robots":null,"how":null}"#, r#"[{"max_width":1},null]"#, r#"[{"size":[0,1]},null]"#]
        {
            let deal = RawValue::from_string(other.to_owned()).expect("JSON");
            let read = read_deal::<()>(&deal, &asked(HuntBounds::default()));
            assert!(read.is_err(), "{other}");
        }
    }

    #[test]
    fn every_bound_that_a_hunt_does_not_take_is_refused() {
        let all: BTreeMap<String, Value> = serde_json::from_str(ALL).expect("bounds");
        for (name, value) in all {
            let bounds = BTreeMap::from([(&name, value)]);
            let bounds = serde_json::to_value(bounds).and_then(serde_json::from_value).expect("a bound");
            let is_taken = asked(bounds).check(&Boundless).is_ok();
            assert_eq!(is_taken, ["robots", "size", "equal_speeds"].contains(&name.as_str()), "{name}");
        }
    }
}

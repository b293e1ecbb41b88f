//! A hunt of a rule of the catalogue: all layouts within a bound, until something breaks.

use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, Ordering};

use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use serde::Serialize;
use tautline_grids::layout::{MAX_SIDE_CELLS, Size};
use tautline_io::diagnostic::Diagnostic;
use tautline_sim::explore::hunt::{Exhibit, Far, Finding, HuntBounds, HuntRequest, Hunter};

use crate::arguments::Int;
use crate::diagnostic::raised;
use crate::explore::{robots, rule, scheme};
use crate::layout::Layout;
use crate::run::Run;
use crate::wait::wait_for;

/// The outcome of a hunt.
#[pyclass(frozen, module = "pytautline", get_all)]
pub(crate) struct HuntReport {
    /// The name of the scheme.
    scheme: &'static str,
    /// The name of its rule.
    rule: &'static str,
    /// Robots.
    robots: u64,
    /// How much was searched, and within which bounds.
    facts: Py<PyAny>,
    /// Whether every layout within the bounds was covered.
    complete: bool,
    /// `holds`, `refuted`, or `open`.
    verdict: &'static str,
    /// The conclusion, in a sentence.
    outcome: String,
    /// The smallest run that breaks each clause.
    counterexamples: Vec<Py<Counterexample>>,
}

/// A clause that is broken, and how.
#[pyclass(frozen, module = "pytautline", get_all)]
pub(crate) struct Counterexample {
    /// The clause.
    clause: &'static str,
    /// How large the run is.
    facts: Py<PyAny>,
    /// How large the run is, in words.
    title: String,
    /// Where it runs.
    layout: Py<Layout>,
    /// The run; none of one without end, and of one that no file tells.
    run: Option<Py<Run>>,
}

#[pymethods]
impl HuntReport {
    fn __repr__(&self) -> String {
        let Self { scheme, rule, verdict, outcome, .. } = self;
        format!("<pytautline.HuntReport {scheme} ({rule}): {verdict}. {outcome}>")
    }
}

#[pymethods]
impl Counterexample {
    fn __repr__(&self) -> String {
        format!("<pytautline.Counterexample {}, {}>", self.clause, self.title)
    }
}

/// Stops a hunt when it is told to.
struct StopHunter<'a>(&'a AtomicBool);

impl Hunter for StopHunter<'_> {
    fn hears(&mut self, _: Far<'_>) -> ControlFlow<()> {
        if self.0.load(Ordering::Relaxed) { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }

    fn is_left_out(&mut self, _: &Diagnostic) {}
}

/// Searches all layouts with few walls for runs that break a clause: see `tautline hunt --help`.
#[pyfunction]
#[pyo3(signature = (
    scheme="chain", *, rule=None, robots=None, size=None, max_walls=None, max_cells=None, max_misses=None,
    max_losses=None, error=None, message_range=None, budget=None
))]
#[expect(clippy::too_many_arguments, reason = "keywords in Python")]
pub(crate) fn hunt(
    py: Python<'_>,
    scheme: &str,
    rule: Option<&str>,
    robots: Option<Int>,
    size: Option<(Int, Int)>,
    max_walls: Option<Int>,
    max_cells: Option<Int>,
    max_misses: Option<Int>,
    max_losses: Option<Int>,
    error: Option<f64>,
    message_range: Option<Int>,
    budget: Option<Int>,
) -> PyResult<HuntReport> {
    let scheme = self::scheme(py, scheme)?;
    let rule = self::rule(py, scheme, rule)?;
    let hunt = scheme.hunt(rule).map_err(|fault| raised(py, &fault))?;
    let cells = |cells: Int| cells.within(py, "size", 1..=MAX_SIDE_CELLS);
    let size = size.map(|(width, height)| {
        Size::new(cells(width)?, cells(height)?).map_err(|problem| raised(py, &problem))
    });
    let asked = HuntRequest {
        scheme,
        rule,
        bounds: HuntBounds {
            robots: self::robots(py, scheme, robots)?,
            size: size.transpose()?,
            max_walls: Int::optional(max_walls, py, "max_walls", 0..=u32::MAX)?,
            max_cells: Int::optional(max_cells, py, "max_cells", 0..=u32::MAX)?,
            max_misses: Int::optional(max_misses, py, "max_misses", 0..=u8::MAX)?,
            max_losses: Int::optional(max_losses, py, "max_losses", 0..=u8::MAX)?,
            error_cells: error,
            range_cells: Int::optional(message_range, py, "message_range", 0..=u16::MAX)?,
            equal_speeds: false,
        },
        budget: Int::optional(budget, py, "budget", 0..=u64::MAX)?,
        resume: None,
    };
    let found = wait_for(py, |is_stopped| {
        asked.check(hunt)?;
        hunt.hunt(&asked, &mut StopHunter(is_stopped))
    })?;
    let found = found.map_err(|fault: Diagnostic| raised(py, &fault))?;
    let (verdict, complete) = (verdict(found.found.is_empty(), found.is_complete), found.is_complete);
    let told = |finding: &Finding| told(py, finding);
    Ok(HuntReport {
        scheme: scheme.name,
        rule: rule.as_str(),
        robots: found.robots,
        facts: facts(py, &found.facts)?,
        complete,
        verdict,
        outcome: found.outcome,
        counterexamples: found.found.iter().map(told).collect::<PyResult<_>>()?,
    })
}

/// The word of the program for it.
pub(crate) const fn verdict(is_unbroken: bool, is_complete: bool) -> &'static str {
    match (is_unbroken, is_complete) {
        (false, _) => "refuted",
        (true, true) => "holds",
        (true, false) => "open",
    }
}

/// Numbers and words by their names.
fn facts(py: Python<'_>, facts: &impl Serialize) -> PyResult<Py<PyAny>> {
    let text = serde_json::to_string(facts).map_err(|error| PyRuntimeError::new_err(error.to_string()))?;
    Ok(py.import("json")?.call_method1("loads", (text,))?.unbind())
}

fn told(py: Python<'_>, finding: &Finding) -> PyResult<Py<Counterexample>> {
    let name = finding.clause.to_owned();
    let run = match &finding.shown {
        Exhibit::Run(clause) | Exhibit::Story(clause, _) => {
            let run = Run::of(py, finding.setup.clone(), name.clone(), Some(*clause))?;
            Some(Py::new(py, run)?)
        }
        Exhibit::Endless | Exhibit::Told(_) => None,
    };
    let layout = Layout { ground: finding.setup.layout.clone(), name };
    let (clause, title) = (finding.clause, finding.title.clone());
    let layout = Py::new(py, layout)?;
    Py::new(py, Counterexample { clause, facts: facts(py, &finding.facts)?, title, layout, run })
}

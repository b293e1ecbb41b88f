//! A rule written in Python, hunted in all layouts within its bound. The rule is asked on one thread: it is pure, but
//! Python has one lock.

mod game;
mod python_rule;
pub(crate) mod team_move;

use std::fs;
use std::sync::Arc;
use std::sync::atomic::Ordering;

use pyo3::prelude::*;
use tautline_grids::layout::Layout;
use tautline_io::atomic_file::{AtomicFile, Replaceable};
use tautline_io::diagnostic::{Diagnostic, Halt};
use tautline_papers::rivals::CATALOGUE;
use tautline_proofs::engine::Until;
use tautline_proofs::engine::tree::{self, Limits as Bounds, Tree, Waves};
use tautline_proofs::run::Frame;
use tautline_proofs::team::{Map, Promise, Setting};
use tautline_sim::explore::hunt::layout as layout_of;
use tautline_sim::explore::{Limits, Own, Report, Setup, run};
use tautline_sim::trace::{self, StoredRun, Writer};

use self::game::{PythonRule, Questions, setting};
use self::python_rule::{Demand, RuleScript};
use crate::arguments::Int;
use crate::diagnostic::{Kind, error, halted};
use crate::hunt::verdict;
use crate::run::{Run, RunSource};

/// The outcome of a hunt of a rule written in Python.
#[pyclass(frozen, module = "pytautline", get_all)]
pub(crate) struct OwnHuntReport {
    /// The name of the scheme.
    scheme: String,
    /// The name of the rule.
    rule: String,
    /// Runs that were made.
    runs: u64,
    /// Team moves that were made.
    moves: u64,
    /// Team moves of the longest run.
    longest: u32,
    /// Runs that were given up, as they neither ended nor came back.
    given_up: u64,
    /// For each number of walls, from none on, the runs and the team moves.
    levels: Vec<(u64, u64)>,
    /// Whether every layout within the bound was covered.
    complete: bool,
    /// The situations that occurred.
    covered: Vec<String>,
    /// `holds`, `refuted`, or `open`.
    verdict: &'static str,
    /// How often Python was called.
    calls: u64,
    /// The run with the fewest walls that breaks each demand.
    counterexamples: Vec<Py<OwnCounterexample>>,
}

/// A demand that is broken, and how.
#[pyclass(frozen, module = "pytautline", get_all)]
pub(crate) struct OwnCounterexample {
    /// The clause.
    clause: &'static str,
    /// The demand, in words.
    words: &'static str,
    /// How many runs break it.
    runs: u64,
    /// The run that meets the fewest walls, and of those the one with the fewest team moves.
    run: Py<Run>,
}

#[pymethods]
impl OwnHuntReport {
    fn __repr__(&self) -> String {
        let Self { scheme, rule, verdict, runs, moves, .. } = self;
        format!("<pytautline.OwnHuntReport {scheme} ({rule}): {verdict}; {runs} runs, {moves} team moves>")
    }
}

#[pymethods]
impl OwnCounterexample {
    fn __repr__(&self) -> String {
        format!("<pytautline.OwnCounterexample {}: not so that {}>", self.clause, self.words)
    }
}

/// A counterexample before Python has it.
struct Plain {
    demand: usize,
    runs: u64,
    run: Run,
}

/// The outcome of a hunt before Python has it.
struct Outcome {
    found: tree::Findings<Promise, (Frame, Option<Map>)>,
    counterexamples: Vec<Plain>,
}

/// Searches all layouts within the bound of a rule for runs that break its demands.
#[pyfunction]
#[pyo3(signature = (rule, *, budget=None, patience_s=10.0))]
pub(crate) fn hunt_rule(
    py: Python<'_>,
    rule: Bound<'_, PyAny>,
    budget: Option<Int>,
    patience_s: f64,
) -> PyResult<OwnHuntReport> {
    let budget = Int::optional(budget, py, "budget", 0..=u64::MAX)?;
    let written = Arc::new(RuleScript::read(&rule)?);
    let worker = Arc::clone(&written);
    let Outcome { found, counterexamples } =
        written.script.work(py, patience_s, move |py| found(py, &worker, budget))?;
    let told = |plain: Plain| {
        let Demand { clause, words, .. } = &written.demands[plain.demand];
        let (clause, words, runs) = (clause.as_str(), *words, plain.runs);
        Py::new(py, OwnCounterexample { clause, words, runs, run: Py::new(py, plain.run)? })
    };
    let is_whole = found.complete && found.given_up == 0 && found.covered.len() == written.covers.len();
    Ok(OwnHuntReport {
        scheme: written.scheme.to_owned(),
        rule: written.script.name.to_owned(),
        runs: found.runs,
        moves: found.moves,
        longest: found.longest,
        given_up: found.given_up,
        levels: found.levels.iter().map(|level| (level.runs, level.moves)).collect(),
        complete: found.complete,
        covered: found.covered.iter().map(|&name| name.to_owned()).collect(),
        verdict: verdict(counterexamples.is_empty(), is_whole),
        calls: written.script.calls.load(Ordering::Relaxed),
        counterexamples: counterexamples.into_iter().map(told).collect::<PyResult<_>>()?,
    })
}

/// The search, and its counterexamples made again. On the thread that asks the rule.
fn found(py: Python<'_>, written: &Arc<RuleScript>, budget: Option<u64>) -> PyResult<Outcome> {
    written.begin(py)?;
    let limits = Bounds { max_walls: written.max_walls, budget_moves: budget, until: Until::Exhausted };
    let questions = Questions::of(written);
    let (demands, covers) = (questions.demands(written), questions.covers(written));
    let rule = |wanted| PythonRule { written: Arc::clone(written), wanted };
    let setting = setting(written, &demands, &covers);
    let refused = |refused: &dyn std::fmt::Display| {
        error(py, Kind::Input, refused, "give fewer max_walls, or a smaller size")
    };
    // Of one start and without faults a tree has several demands on endless runs, which states have one by one.
    let wanted: Vec<Promise> = (0..demands.len()).map(Promise).collect();
    let playing = setting
        .playing(&rule(0..demands.len()), &wanted[..wanted.len().min(1)])
        .map_err(|what| refused(&what))?;
    let playing = playing.wanting(&wanted);
    let mut tree = Tree::new(playing, &limits).map_err(|what| refused(&what))?;
    while tree.wave() {
        written.script.checked(py)?;
    }
    written.script.checked(py)?;
    let found = tree.found();
    written.script.checked(py)?;
    let is_found = |demand: &usize| found.counterexamples.iter().any(|example| example.broken.0 == *demand);
    if !written.seen().iter().all(is_found) {
        return Err(written.script.not_pure(py));
    }
    let mut counterexamples = Vec::new();
    for example in &found.counterexamples {
        let demand = example.broken.0;
        let clause = written.demands[demand].clause;
        let run = setting.run(written.starts().to_vec(), example);
        let told = |halt: Halt| match halt {
            Halt::Interrupted => written.script.not_pure(py),
            Halt::Diagnostic(_) => halted(py, &halt),
        };
        let halted = |halt: Halt| written.script.checked(py).err().unwrap_or_else(|| told(halt));
        let (layout, _) = layout_of(&run).map_err(|problem| halted(problem.into()))?;
        let (made, report) =
            stored(written, (&setting, &rule(demand..demand + 1)), &layout, demand).map_err(halted)?;
        if report.violations.is_empty() {
            return Err(written.script.not_pure(py));
        }
        let run = Run { made, name: clause.to_string(), report, clause: Some(clause) };
        counterexamples.push(Plain { demand, runs: example.runs, run });
    }
    Ok(Outcome { found, counterexamples })
}

/// The run of the rule in `layout`, as far as it breaks the demand with this number, written to a file and read again.
fn stored(
    written: &RuleScript,
    (setting, rule): (&Setting<'_, PythonRule>, &PythonRule),
    layout: &Layout,
    demand: usize,
) -> Result<(RunSource, Report), Halt> {
    let folder =
        tempfile::tempdir().map_err(|error| Diagnostic::usage(error, "make room for temporary files"))?;
    let path = folder.path().join("run.jsonl");
    let clause = written.demands[demand].clause;
    let limits = Limits::stopping_at(Some(clause));
    let setup = Setup::named(written.scheme, written.script.name, layout.clone(), written.starts());
    let setup = Setup { limits, ..setup };
    let file = AtomicFile::new(&path, &Replaceable::default())?;
    let mut writer = Writer::of_demand(file, &setup, Some(clause), written.demands[demand].words)?;
    // The move that breaks the demand may be the last one of a longest run.
    let mut left = written.longest_run.saturating_add(1);
    let team = setting.in_layout(rule, written.starts(), Vec::new()).wanting(&[Promise(demand)]);
    let report = run(&mut Own::new(team, 0), layout, limits, &mut |made| {
        left = left.saturating_sub(1);
        writer.add(made);
        // A rule that is not the same each time may have a run that neither ends nor comes back.
        if written.script.is_over() || left == 0 { Err(Halt::Interrupted) } else { Ok(()) }
    })?;
    if written.script.is_over() {
        return Err(Halt::Interrupted);
    }
    writer.end(&report).keep()?;
    let unread = |error| Diagnostic::in_file(&path, error, "make room for temporary files");
    let text = fs::read_to_string(&path).map_err(unread)?;
    match trace::open(&path, CATALOGUE)? {
        StoredRun::Foreign(recorded) => Ok((RunSource::Recorded(Box::new(recorded), text), report)),
        StoredRun::Known(_) => {
            let what = format!("{} is a scheme of tautline", written.scheme);
            Err(Diagnostic::usage(what, "give the rule's scheme another name").into())
        }
    }
}

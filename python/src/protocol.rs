//! A rule over states that was written in Python: all states within its bound are searched by the engine, for each
//! demand by itself, on one thread.

mod run;
mod script;

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::atomic::Ordering;
use std::sync::{Arc, Mutex};

use pyo3::exceptions::PyKeyError;
use pyo3::prelude::*;
use tautline_proofs::clause::{AnyCheck, Check, Clause, NamedRule};
use tautline_proofs::decide::{MethodError, RandomRuns, Verdict};
use tautline_proofs::engine::Choices;
use tautline_proofs::engine::states::{Limits, Unsound};
use tautline_proofs::plural::counted;
use tautline_proofs::protocol::Keeps;
use tautline_sim::counterexample::refutation::{self, Meant};

pub(crate) use self::run::StateRun;
use self::script::{ScriptCheck, ScriptDemand, StateScript, Words};
use crate::arguments::{Int, whole, whole_or_none};
use crate::diagnostic::{Kind, error, raised};
use crate::hunt::verdict;
use crate::script::held;

/// The outcome of a check of a rule over states.
#[pyclass(frozen, module = "pytautline", get_all)]
pub(crate) struct ProtocolReport {
    /// The name of the rule.
    rule: &'static str,
    /// The bound, in the words of the rule.
    bound: &'static str,
    /// `refuted` if one demand is, else `open` if one is, else `holds`.
    verdict: &'static str,
    /// How often Python was called.
    calls: u64,
    /// The outcome for each demand.
    decisions: Vec<Py<Decision>>,
}

/// The outcome for a demand.
#[pyclass(frozen, module = "pytautline", get_all)]
pub(crate) struct Decision {
    /// The clause.
    clause: &'static str,
    /// The demand, in words.
    words: &'static str,
    /// `holds`, `refuted`, or `open`.
    verdict: &'static str,
    /// States, the starts among them.
    states: u64,
    /// Steps between states.
    steps: u64,
    /// Whether the search came to its end, and not to its budget.
    complete: bool,
    /// The moves that occurred, of those that must.
    covered: Vec<String>,
    /// Why the question is open, in words, if it is.
    note: Option<String>,
    /// A run that breaks the demand: a shortest one if it ends.
    counterexample: Option<Py<StateRun>>,
}

#[pymethods]
impl ProtocolReport {
    fn __getitem__(&self, py: Python<'_>, clause: &str) -> PyResult<Py<Decision>> {
        let found = self.decisions.iter().find(|decision| decision.get().clause == clause);
        found.map(|found| found.clone_ref(py)).ok_or_else(|| PyKeyError::new_err(clause.to_owned()))
    }

    fn __repr__(&self) -> String {
        format!("<pytautline.ProtocolReport {}: {}>", self.rule, self.verdict)
    }
}

#[pymethods]
impl Decision {
    fn __repr__(&self) -> String {
        format!("<pytautline.Decision {}: {}; {} states>", self.clause, self.verdict, self.states)
    }
}

/// Searches all states of a rule for runs that break its demands.
#[pyfunction]
#[pyo3(signature = (rule, *, budget=10_000_000, patience_s=10.0))]
pub(crate) fn decide_protocol(
    py: Python<'_>,
    rule: Bound<'_, PyAny>,
    #[pyo3(from_py_with = whole_or_none)] budget: Option<i128>,
    patience_s: f64,
) -> PyResult<ProtocolReport> {
    let budget = Int::optional(budget.map(Int), py, "budget", 0..=u64::MAX)?;
    let script = Arc::new(StateScript::read(&rule)?);
    let decisions = script.script.work(py, patience_s, |py| {
        script.begin(py)?;
        (0..script.demands.len())
            .map(|demand| decide(py, &script, demand, budget))
            .collect::<PyResult<Vec<_>>>()
    })?;
    let is = |verdict| decisions.iter().any(|decision| decision.verdict == verdict);
    Ok(ProtocolReport {
        rule: script.script.name,
        bound: script.bound,
        verdict: verdict(!is("refuted"), !is("open")),
        calls: script.script.calls.load(Ordering::Relaxed),
        decisions: decisions.into_iter().map(|decision| Py::new(py, decision)).collect::<PyResult<_>>()?,
    })
}

/// Makes at most so many random runs of a rule for each of its demands. The first that breaks it; none if no run does.
#[pyfunction]
#[pyo3(signature = (rule, *, runs, seed=0, max_moves=1000, patience_s=10.0))]
pub(crate) fn hunt_protocol(
    py: Python<'_>,
    rule: Bound<'_, PyAny>,
    runs: Int,
    #[pyo3(from_py_with = whole)] seed: i128,
    #[pyo3(from_py_with = whole)] max_moves: i128,
    patience_s: f64,
) -> PyResult<BTreeMap<&'static str, Option<StateRun>>> {
    let script = Arc::new(StateScript::read(&rule)?);
    let runs = RandomRuns {
        runs: runs.within(py, "runs", 0..=u64::MAX)?,
        seed: Int(seed).within(py, "seed", 0..=u64::MAX)?,
        most_moves: Int(max_moves).within(py, "max_moves", 0..=u32::MAX)?,
    };
    script.script.work(py, patience_s, |py| {
        script.begin(py)?;
        if script.starts().is_empty() {
            return Err(error(py, Kind::Input, "no run can begin", "let starts return at least one state"));
        }
        let hunted = |demand| -> PyResult<_> {
            let DemandCheck { clause, check } = DemandCheck::of(&script, demand);
            script.take_met();
            let found = check.hunt(&runs);
            script.script.checked(py)?;
            let found = found.map_err(|why| refused(py, &script, &why))?;
            let evidence = found.and_then(|answer| answer.counterexample);
            let run = evidence.map(|evidence| run_of(py, &script, demand, &evidence.choices)).transpose()?;
            Ok((clause.id, run))
        };
        (0..script.demands.len()).map(hunted).collect()
    })
}

/// Plays the run in a file that [`StateRun::store`] has written by this rule.
#[pyfunction]
#[pyo3(signature = (rule, path, *, patience_s=10.0))]
pub(crate) fn replay_protocol(
    py: Python<'_>,
    rule: Bound<'_, PyAny>,
    path: PathBuf,
    patience_s: f64,
) -> PyResult<StateRun> {
    let script = Arc::new(StateScript::read(&rule)?);
    if !path.exists() {
        let what = format_args!("{}: there is no such file", path.display());
        return Err(error(py, Kind::Input, what, "name a file that StateRun.store wrote"));
    }
    script.script.work(py, patience_s, |py| {
        script.begin(py)?;
        let asked: Vec<DemandCheck> =
            (0..script.demands.len()).map(|demand| DemandCheck::of(&script, demand)).collect();
        let known: Vec<Meant<'_>> = asked.iter().map(|asked| (&asked.clause, &asked.check as _)).collect();
        let read = refutation::replay_by(&path, &known);
        script.script.checked(py)?;
        let read = read.map_err(|fault| raised(py, &fault))?;
        let demand = script.demands.iter().position(|wanted| wanted.clause == read.clause.id);
        run_of(py, &script, demand.unwrap_or_default(), &read.evidence.choices)
    })
}

/// The checks that there were, by their bounds and the kinds of their demands. They are as few as the bounds, and are
/// kept as long as the process.
static KEEPS: Mutex<BTreeMap<(&str, usize), &Keeps<ScriptCheck>>> = Mutex::new(BTreeMap::new());

fn keeps(bound: &'static str, kind: usize) -> &'static Keeps<ScriptCheck> {
    held(&KEEPS).entry((bound, kind)).or_insert_with(|| Box::leak(Box::new(Keeps(Words(bound), kind))))
}

/// A demand of a rule as a clause, and the check that decides it.
struct DemandCheck {
    clause: Clause,
    check: Check<ScriptCheck>,
}

impl DemandCheck {
    fn of(script: &Arc<StateScript>, demand: usize) -> Self {
        let ScriptDemand { clause, words, kind, .. } = script.demands[demand];
        let about = NamedRule::new(script.script.name, ScriptCheck(Arc::clone(script), demand));
        Self {
            clause: Clause { id: clause, sentence: words, checks: &[] },
            check: Check::new(about, keeps(script.bound, kind), Verdict::Holds, &[]),
        }
    }
}

/// Decides the demand with this number.
fn decide(
    py: Python<'_>,
    script: &Arc<StateScript>,
    demand: usize,
    budget: Option<u64>,
) -> PyResult<Decision> {
    let ScriptDemand { clause, words, kind, .. } = script.demands[demand];
    script.take_met();
    let posed = ScriptCheck(Arc::clone(script), demand);
    let found = keeps(script.bound, kind).search(&posed, Limits::steps(budget.unwrap_or(u64::MAX)));
    script.script.checked(py)?;
    let found = found.map_err(|why| refused(py, script, &why))?;
    let met = script.take_met();
    let covered: Vec<String> =
        script.covers.iter().filter(|words| met.contains(words.as_str())).cloned().collect();
    let run = found.broken.first().map(|run| run_of(py, script, demand, &run.choices())).transpose()?;
    let is_whole = found.is_whole && found.states > 0 && covered.len() == script.covers.len();
    let note = (run.is_none() && !is_whole).then(|| {
        let never = script.covers.iter().filter(|words| !covered.contains(words));
        match (found.is_whole, found.states) {
            (false, states) => format!(
                "budget has ended the search after {}: give it more, bound the rule more closely, or make random \
                 runs by hunt_protocol",
                counted(states, "state")
            ),
            (true, 0) => "there is no start".to_owned(),
            (true, _) => format!("never occurred: {}", never.cloned().collect::<Vec<_>>().join(", ")),
        }
    });
    Ok(Decision {
        clause,
        words,
        verdict: verdict(run.is_none(), is_whole),
        states: found.states,
        steps: found.steps,
        complete: found.is_whole,
        covered,
        note,
        counterexample: run.map(|run| Py::new(py, run)).transpose()?,
    })
}

/// The exception of a rule whose states cannot be searched.
fn refused(py: Python<'_>, script: &StateScript, why: &MethodError) -> PyErr {
    if why.to_string() == Unsound::Unrepeatable.to_string() {
        return script.script.not_pure(py);
    }
    let remedy = "let alike return only states with the same moves of the same actors, in the same words, to states \
                  that are alike, and of which each demand says the same";
    error(py, Kind::WrongType, format_args!("alike is wrong: {why}"), remedy)
}

/// The run that these choices make.
fn run_of(py: Python<'_>, script: &Arc<StateScript>, demand: usize, choices: &Choices) -> PyResult<StateRun> {
    let DemandCheck { clause, check } = DemandCheck::of(script, demand);
    let played = check.replay(choices);
    script.script.checked(py)?;
    let evidence = played.map_err(|_| script.script.not_pure(py))?.evidence;
    let file = refutation::text(&clause, &check, &evidence);
    script.script.checked(py)?;
    let file = file.map_err(|_| script.script.not_pure(py))?;
    StateRun::of(py, script, demand, &evidence, file)
}

//! A local rule written in Python, decided for every number of robots and every layout.

use std::fmt;
use std::sync::OnceLock;
use std::sync::atomic::Ordering;

use pyo3::prelude::*;
use pyo3::types::{PyList, PyTuple};
use tautline_kernel::ground::Step;
use tautline_proofs::decide::{Cache, Context, Depiction, Method, MethodError, Verdict};
use tautline_proofs::engine::Until;
use tautline_proofs::engine::states::MemoryLimit;
use tautline_proofs::engine::tree::unwatched;
use tautline_proofs::local::{Act, EveryNumber, Far, Local, Plan, Robot, all_tuples};
use tautline_sim::trace::step;

use crate::arguments::{At, List};
use crate::diagnostic::{Kind, error, shown};
use crate::hunt::verdict;
use crate::script::{Script, attribute, is_rule_of, kept, number, word, wrong_answer};

/// The most states of a robot, whose words are kept as long as the process.
const MAX_STATES: usize = 256;

/// The farthest that a promise looks: farther on there are more places than the engine takes.
const MAX_REACH: i16 = 1_000;

/// An act as a rule returns it: its letter, and all that may come of it.
type ActAnswer<'py> = (char, List<(bool, Bound<'py, PyAny>)>);

/// A state of a robot by its number, with the words that Python has for it.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct State {
    number: u32,
    words: &'static str,
}

impl fmt::Debug for State {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.words)
    }
}

/// The letter of a step.
#[derive(Clone, Copy, PartialEq, Eq)]
struct Letter(char);

impl fmt::Debug for Letter {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.0)
    }
}

/// A local rule as Python has it.
struct LocalScript {
    script: Script,
    /// The functions of the rule, and the classes of what they are told.
    admits: Py<PyAny>,
    keeps: Py<PyAny>,
    may_start: Py<PyAny>,
    robot: Py<PyAny>,
    plan: Py<PyAny>,
    states: Vec<State>,
    /// For each state what a robot can do in it; before [`LocalScript::begin`] there is nothing.
    acts: OnceLock<Vec<Vec<Act<State, Letter>>>>,
    reach: i16,
    far: Far,
    is_in_a_row: bool,
    /// Of how many robots at once it speaks.
    robots: usize,
    /// Whether a robot may be kept from going by more than walls.
    may_fail: bool,
    /// Whether a robot that goes may be stopped, by a wall or a fault.
    may_be_stopped: bool,
}

impl LocalScript {
    fn read(rule: &Bound<'_, PyAny>) -> PyResult<Self> {
        let py = rule.py();
        is_rule_of(rule, "LocalRule")?;
        let name: String = attribute(rule, "name", "a name, such as \"written\"")?;
        let may_fail: bool = attribute(rule, "may_fail", "may_fail, True or False")?;
        let is_far_fine: bool = attribute(rule, "far_is_fine", "far_is_fine, True or False")?;
        let List(listed): List<Bound<'_, PyAny>> =
            attribute(rule, "states", "states, a list of all that a robot may be in")?;
        if !(1..=MAX_STATES).contains(&listed.len()) {
            let remedy = format!("give the rule 1 to {MAX_STATES} states, or one, such as None");
            return Err(error(py, Kind::Input, format_args!("{} states", listed.len()), remedy));
        }
        let of_module = |name: &str| Ok::<_, PyErr>(py.import("pytautline._local")?.getattr(name)?.unbind());
        let of_rule = |name: &str| attribute::<Bound<'_, PyAny>>(rule, name, name).map(Bound::unbind);
        let mut written = Self {
            script: Script::new(rule, word(py, "name", &name)?),
            admits: of_rule("admits")?,
            keeps: of_rule("keeps")?,
            may_start: of_rule("may_start")?,
            robot: of_module("LocalRobot")?,
            plan: of_module("LocalPlan")?,
            states: Vec::new(),
            acts: OnceLock::new(),
            reach: number(rule, "reach", 0..=MAX_REACH)?,
            far: if is_far_fine { Far::Fine } else { Far::Broken },
            is_in_a_row: attribute(rule, "in_a_row", "in_a_row, True or False")?,
            robots: number(rule, "robots", 2..=3)?,
            may_fail,
            may_be_stopped: attribute(rule, "meets_walls", "meets_walls, True or False")? || may_fail,
        };
        for state in &listed {
            let number = written.script.number(py, "states", state)?;
            if number as usize == written.states.len() {
                // The only one is not worth a word.
                let words = if listed.len() == 1 { "()" } else { kept(&shown(state)) };
                written.states.push(State { number, words });
            }
        }
        Ok(written)
    }

    /// A state that a function of the rule returns: one of those that the rule names.
    fn named(&self, py: Python<'_>, what: &str, state: &Bound<'_, PyAny>) -> PyResult<State> {
        let number = self.script.number(py, what, state)?;
        self.states.iter().find(|known| known.number == number).copied().ok_or_else(|| {
            let what = format!("{what} returned {}, which is none of the rule's states", shown(state));
            error(py, Kind::Input, what, "give the rule states, a list of all that a robot may be in")
        })
    }

    /// Asks the rule what robots can do.
    fn begin(&self, py: Python<'_>) -> PyResult<()> {
        let remedy = "return a list with a letter of E, S, W, N or . for each act, and with all that may come of it: \
                      whether the robot goes, and its next state";
        let acts_in = |state: &State| {
            let state = self.script.state(py, state.number);
            let answer = self.script.called(py, "acts", |rule| rule.call_method1("acts", (state,)))?;
            let wrong = || wrong_answer("acts", &answer, remedy);
            let List(told): List<ActAnswer<'_>> = answer.extract().map_err(|_| wrong())?;
            let act = |(letter, List(ends)): ActAnswer<'_>| {
                let step = step(letter).filter(|_| !ends.is_empty()).ok_or_else(wrong)?;
                let end = |(goes, next): (bool, Bound<'_, PyAny>)| {
                    Ok((goes && step != Step::Stay, self.named(py, "acts", &next)?))
                };
                let ends: Vec<_> = ends.into_iter().map(end).collect::<PyResult<_>>()?;
                if self.may_be_stopped && step != Step::Stay && ends.iter().all(|&(goes, _)| goes) {
                    let what = format!("{letter} goes in every outcome, and there may be a wall");
                    let remedy =
                        "name an outcome (False, state) as well, or give the rule meets_walls = False";
                    return Err(error(py, Kind::Input, what, remedy));
                }
                Ok(Act { act: Letter(letter), step, ends, needs_open: false })
            };
            told.into_iter().map(act).collect::<PyResult<Vec<_>>>()
        };
        let _ = self.acts.set(self.states.iter().map(acts_in).collect::<PyResult<_>>()?);
        Ok(())
    }

    /// Whether a function of the rule says yes to a list of these; no if it fails.
    fn says<'py>(
        &self,
        py: Python<'py>,
        what: &str,
        asked: &Py<PyAny>,
        told: impl Iterator<Item = PyResult<Bound<'py, PyAny>>>,
    ) -> bool {
        if self.script.is_over() {
            return false;
        }
        let listed =
            told.collect::<PyResult<Vec<_>>>().and_then(|told| PyTuple::new(py, [PyList::new(py, told)?]));
        listed.map_or_else(|error| self.script.fail(error), |told| self.script.says(py, what, asked, told))
    }

    fn robots_say(&self, what: &str, asked: &Py<PyAny>, robots: &[Robot<State>]) -> bool {
        Python::attach(|py| {
            let told = |robot: &Robot<State>| {
                let state = self.script.state(py, robot.state.number);
                self.robot.bind(py).call1(((robot.at.x, robot.at.y), state))
            };
            self.says(py, what, asked, robots.iter().map(told))
        })
    }

    fn plans_say(&self, plans: &[Plan<State, Letter>]) -> bool {
        Python::attach(|py| {
            let told = |plan: &Plan<State, Letter>| {
                let (at, to) = (plan.robot.at, plan.to());
                let state = self.script.state(py, plan.robot.state.number);
                self.plan.bind(py).call1(((at.x, at.y), state, plan.act.0, (to.x, to.y)))
            };
            self.says(py, "admits", &self.admits, plans.iter().map(told))
        })
    }

    fn started(&self, py: Python<'_>, robots: usize) -> PyResult<Vec<Robot<State>>> {
        let answer = self.script.called(py, "start", |rule| rule.call_method1("start", (robots,)))?;
        let remedy = "return a list with the cell and the state of each robot";
        let List(told): List<(At, Bound<'_, PyAny>)> =
            answer.extract().map_err(|_| wrong_answer("start", &answer, remedy))?;
        told.iter().map(|(At(at), state)| Ok(Robot::new(*at, self.named(py, "start", state)?))).collect()
    }
}

impl Local for LocalScript {
    type State = State;
    type Act = Letter;

    fn robots(&self) -> usize {
        self.robots
    }

    fn may_fail(&self) -> bool {
        self.may_fail
    }

    fn states(&self) -> Vec<State> {
        self.states.clone()
    }

    fn acts(&self, state: State) -> Vec<Act<State, Letter>> {
        let place = self.states.iter().position(|&known| known == state);
        let acts = place.and_then(|place| self.acts.get()?.get(place));
        acts.cloned().unwrap_or_default()
    }

    fn admits(&self, plans: &[Plan<State, Letter>]) -> bool {
        self.plans_say(plans)
    }

    fn keeps(&self, robots: &[Robot<State>]) -> bool {
        self.robots_say("keeps", &self.keeps, robots)
    }

    fn reach(&self) -> (i16, Far) {
        (self.reach, self.far)
    }

    fn may_start(&self, robots: &[Robot<State>]) -> bool {
        self.robots_say("may_start", &self.may_start, robots)
    }

    fn start(&self, robots: usize) -> Vec<Robot<State>> {
        let start = Python::attach(|py| self.started(py, robots));
        start.unwrap_or_else(|error| self.script.fail(error))
    }

    fn is_sure(&self, _: Letter) -> bool {
        !self.may_be_stopped
    }

    fn tuples(&self, robots: usize) -> Vec<Vec<usize>> {
        if self.is_in_a_row {
            (self.robots..=robots).map(|end| (end - self.robots..end).collect()).collect()
        } else {
            all_tuples(robots, self.robots)
        }
    }
}

/// The outcome of a check of a local rule.
#[pyclass(frozen, module = "pytautline", get_all)]
pub(crate) struct EveryNumberReport {
    /// The name of the rule.
    rule: &'static str,
    /// `holds`, `refuted`, or `open`.
    verdict: &'static str,
    /// Steps of robots that were looked at.
    cases: u64,
    /// The set of places that no step leaves, or why the question is open, in words.
    note: Option<String>,
    /// A run of a team that breaks the promise, drawn.
    counterexample: Option<String>,
    /// A file that Rocq checks, if it was asked for and there is one.
    certificate: Option<String>,
    /// How often Python was called.
    calls: u64,
}

#[pymethods]
impl EveryNumberReport {
    fn __repr__(&self) -> String {
        format!("<pytautline.EveryNumberReport {}: {}>", self.rule, self.verdict)
    }
}

/// Decides the promise of a local rule for every number of robots and every layout.
#[pyfunction]
#[pyo3(signature = (rule, *, certificate=false, patience_s=10.0))]
pub(crate) fn decide_every_number(
    py: Python<'_>,
    rule: Bound<'_, PyAny>,
    certificate: bool,
    patience_s: f64,
) -> PyResult<EveryNumberReport> {
    let written = LocalScript::read(&rule)?;
    written.script.work(py, patience_s, |py| {
        written.begin(py)?;
        decided(py, &written, certificate)
    })
}

fn decided(py: Python<'_>, rule: &LocalScript, with_certificate: bool) -> PyResult<EveryNumberReport> {
    let (script, method) = (&rule.script, EveryNumber::DEFAULT);
    let refused = |why: MethodError| {
        let remedy = "let the rule speak of where robots are from each other, admit something, \
                      name all states, and start with its promise kept";
        error(py, Kind::Input, why, remedy)
    };
    let cache = &mut Cache::default();
    let mut context = Context { cache, watch: &mut unwatched, memory: MemoryLimit::any() };
    let answer = method.decide(rule, Until::Violation, &mut context);
    script.checked(py)?;
    let answer = answer.map_err(refused)?;
    let certificate = with_certificate.then(|| method.certificate(rule)).flatten();
    script.checked(py)?;
    let story = |seen| if let Depiction::Story(story) = seen { Some(story) } else { None };
    Ok(EveryNumberReport {
        rule: script.name,
        verdict: verdict(answer.counterexample.is_none(), answer.verdict != Verdict::Open),
        cases: answer.cases,
        note: answer.note,
        counterexample: answer.counterexample.and_then(|found| story(found.seen)),
        certificate: certificate.transpose().map_err(refused)?,
        calls: script.calls.load(Ordering::Relaxed),
    })
}

//! Rules written in Python, whatever they are rules of: how they are asked, what becomes of an answer that is none, and
//! the states that they have answered.

use std::collections::BTreeSet;
use std::fmt::Display;
use std::ops::RangeInclusive;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use pyo3::PyTypeInfo;
use pyo3::exceptions::{PyAttributeError, PyException, PyTypeError};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple, PyType};
use rayon::ThreadPoolBuilder;
use tautline_proofs::engine::states::Bits;
use tautline_proofs::protocol::set;

use crate::arguments::{Int, entries};
use crate::diagnostic::{Kind, error, shown};
use crate::wait::wait;

/// Letters of a name.
const MAX_WORD: usize = 64;

/// The words that rules bring. There are few, and they are kept as long as the process.
static KEPT: Mutex<BTreeSet<&'static str>> = Mutex::new(BTreeSet::new());

/// The value of the mutex, whatever has become of others who held it.
pub(crate) fn held<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// The text, for as long as the process lives.
pub(crate) fn kept(text: &str) -> &'static str {
    let mut kept = held(&KEPT);
    if let Some(&known) = kept.get(text) {
        return known;
    }
    let new: &'static str = Box::leak(text.into());
    kept.insert(new);
    new
}

/// A name that can stand in every file and drawing.
pub(crate) fn word(py: Python<'_>, what: &str, name: &str) -> PyResult<&'static str> {
    let is_fitting = |letter: char| letter.is_ascii_alphanumeric() || letter == '-';
    if (1..=MAX_WORD).contains(&name.len()) && name.chars().all(is_fitting) {
        return Ok(kept(name));
    }
    let remedy = format!("give {what} at most {MAX_WORD} letters, digits and hyphens");
    Err(error(py, Kind::Input, format_args!("{name:?} is no name"), remedy))
}

/// Refuses what is no rule of this class: a class in place of an instance, or an attribute that is nearly one of those
/// that the rule leaves as they are.
pub(crate) fn is_rule_of(rule: &Bound<'_, PyAny>, class: &str) -> PyResult<()> {
    let py = rule.py();
    if let Ok(given) = rule.cast::<PyType>() {
        let what = format_args!("the rule is the class {}", given.name()?);
        return Err(error(
            py,
            Kind::WrongType,
            what,
            format_args!("give an instance of it: {}()", given.name()?),
        ));
    }
    let near = py.import("pytautline._rule")?.getattr("misspelt")?;
    let found: Option<(String, String)> =
        near.call1((rule, py.import("pytautline")?.getattr(class)?))?.extract()?;
    found.map_or(Ok(()), |(name, meant)| {
        let what = format_args!("the rule has {name}, which no {class} has");
        Err(error(
            py,
            Kind::Input,
            what,
            format_args!("call it {meant}, or, if it is your own, by another name"),
        ))
    })
}

/// Refuses a rule without demands, or of which two have one id.
pub(crate) fn are_demands<'a>(
    py: Python<'_>,
    ids: impl IntoIterator<Item = &'a str, IntoIter: ExactSizeIterator>,
) -> PyResult<()> {
    let (mut ids, mut known) = (ids.into_iter(), BTreeSet::new());
    if ids.len() == 0 {
        let remedy = "give the rule demands, made by pytautline.always and others";
        return Err(error(py, Kind::Input, "nothing is demanded", remedy));
    }
    match ids.find(|&id| !known.insert(id)) {
        Some(id) => {
            let what = format_args!("two demands have the id {id}");
            Err(error(py, Kind::Input, what, "give each demand an id of its own"))
        }
        None => Ok(()),
    }
}

/// An attribute of a rule, of this type.
pub(crate) fn attribute<'py, T: for<'a> FromPyObject<'a, 'py>>(
    rule: &Bound<'py, PyAny>,
    name: &str,
    wanted: &str,
) -> PyResult<T> {
    attribute_of("the rule", rule, name, wanted)
}

/// An attribute of a rule, or of a part of it that is called so, of this type.
pub(crate) fn attribute_of<'py, T: for<'a> FromPyObject<'a, 'py>>(
    owner: &str,
    part: &Bound<'py, PyAny>,
    name: &str,
    wanted: &str,
) -> PyResult<T> {
    let py = part.py();
    let wrong = |what: String| error(py, Kind::WrongType, what, format_args!("give the rule {wanted}"));
    let value = part.getattr(name).map_err(|raised| {
        if raised.is_instance_of::<PyAttributeError>(py) {
            return wrong(format!("{owner} {} has no {name}", shown(part)));
        }
        self::raised(py, &format!("{name} of {owner}"), raised)
    })?;
    value.extract().map_err(|_| wrong(format!("{name} of {owner} is {}", shown(&value))))
}

/// A whole number among the attributes of a rule, within these bounds.
pub(crate) fn number<T>(rule: &Bound<'_, PyAny>, name: &str, bounds: RangeInclusive<T>) -> PyResult<T>
where
    T: TryFrom<i128> + PartialOrd + Display,
{
    let wanted = format!("{name}, a whole number from {} to {}", bounds.start(), bounds.end());
    attribute::<Int>(rule, name, &wanted)?.within(rule.py(), name, bounds)
}

/// The exception for one that Python code of a rule has raised.
fn raised(py: Python<'_>, what: &str, raised: PyErr) -> PyErr {
    let said = format!("{what} raised {raised}");
    let told =
        error(py, Kind::Raised, said, "let it return for all that it is asked; the cause has the place");
    told.set_cause(py, Some(raised));
    told
}

/// The exception of an answer of a function that is not what the function is to return.
pub(crate) fn wrong_answer(what: &str, answer: &Bound<'_, PyAny>, remedy: &str) -> PyErr {
    error(answer.py(), Kind::WrongType, format_args!("{what} returned {}", shown(answer)), remedy)
}

/// The states that Python has answered, each once, by their numbers.
struct States {
    numbers: Py<PyDict>,
    values: Vec<Py<PyAny>>,
}

/// A rule as Python has it, and how it fares.
pub(crate) struct Script {
    /// The name of the rule.
    pub(crate) name: &'static str,
    /// How often Python was called.
    pub(crate) calls: AtomicU64,
    object: Py<PyAny>,
    states: Mutex<States>,
    /// Whether somebody wants the work to end.
    is_stopped: AtomicBool,
    /// How often Python has begun or ended what it was asked: odd while it is at it.
    turns: AtomicU64,
    /// The number that Python has for the thread that asks the rule.
    thread: AtomicU64,
    has_failed: AtomicBool,
    failure: Mutex<Option<PyErr>>,
}

impl Script {
    pub(crate) fn new(rule: &Bound<'_, PyAny>, name: &'static str) -> Self {
        let states = States { numbers: PyDict::new(rule.py()).unbind(), values: Vec::new() };
        Self {
            name,
            calls: AtomicU64::new(0),
            object: rule.clone().unbind(),
            states: Mutex::new(states),
            is_stopped: AtomicBool::new(false),
            turns: AtomicU64::new(0),
            thread: AtomicU64::new(0),
            has_failed: AtomicBool::new(false),
            failure: Mutex::new(None),
        }
    }

    /// Does `work`, which asks the rule, on a thread of its own, and with no other one, as Python has one lock. A call
    /// of the rule may take so many seconds.
    pub(crate) fn work<T: Send>(
        &self,
        py: Python<'_>,
        patience_s: f64,
        work: impl FnOnce(Python<'_>) -> PyResult<T> + Send,
    ) -> PyResult<T> {
        let mut patience = self.patience(py, patience_s)?;
        let begun = |py: Python<'_>| {
            let thread: u64 = py.import("threading")?.call_method0("get_ident")?.extract()?;
            self.thread.store(thread, Ordering::Relaxed);
            work(py)
        };
        let alone = || {
            let pool = ThreadPoolBuilder::new().num_threads(1).build();
            let pool = pool.map_err(|failed| {
                Python::attach(|py| error(py, Kind::Input, failed, "end other programs"))
            })?;
            pool.install(|| Python::attach(begun))
        };
        wait(py, &self.is_stopped, alone, |py| patience.look(py))?
    }

    /// Calls Python, as whoever waits is told.
    pub(crate) fn called<'py, T>(
        &self,
        py: Python<'py>,
        what: &str,
        call: impl FnOnce(&Bound<'py, PyAny>) -> PyResult<T>,
    ) -> PyResult<T> {
        self.calls.fetch_add(1, Ordering::Relaxed);
        self.watched(|| call(self.object.bind(py))).map_err(|raised| self.refused(py, what, raised))
    }

    /// The members of what a function of the rule returns.
    pub(crate) fn listed<'py>(
        &self,
        py: Python<'py>,
        what: &str,
        remedy: &str,
        call: impl FnOnce(&Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>>,
    ) -> PyResult<Vec<Bound<'py, PyAny>>> {
        let listed = self.called(py, what, |rule| {
            let answer = call(rule)?;
            // A function that yields its answers is asked for them here.
            match answer.try_iter() {
                Ok(all) => Ok(Ok(entries(&all)?)),
                Err(_) => Ok(Err(answer)),
            }
        })?;
        listed.map_err(|answer| wrong_answer(what, &answer, remedy))
    }

    /// The obligations that a function of a demand returns, numbers from 0 to 15, a bit for each.
    pub(crate) fn owed(
        &self,
        py: Python<'_>,
        what: &str,
        asked: &Py<PyAny>,
        arguments: Bound<'_, PyTuple>,
    ) -> PyResult<Bits> {
        let remedy = "return a list of what is owed, numbers from 0 to 15";
        let owed = self.listed(py, what, remedy, |_| asked.bind(py).call1(arguments))?;
        let number = |owed: &Bound<'_, PyAny>| {
            let number = owed.extract().ok().filter(|&number: &u32| number < Bits::BITS);
            number.map(|number| number as usize).ok_or_else(|| wrong_answer(what, owed, remedy))
        };
        Ok(set(owed.iter().map(number).collect::<PyResult<Vec<_>>>()?))
    }

    /// Lets Python work, and tells whoever waits that it does.
    fn watched<T>(&self, work: impl FnOnce() -> T) -> T {
        self.turns.fetch_add(1, Ordering::Relaxed);
        let done = work();
        self.turns.fetch_add(1, Ordering::Relaxed);
        done
    }

    /// The exception for one that Python code of the rule has raised.
    fn refused(&self, py: Python<'_>, what: &str, raised: PyErr) -> PyErr {
        let overdue = py.import("pytautline._errors").and_then(|errors| errors.getattr("Overdue"));
        if overdue.is_ok_and(|overdue| raised.matches(py, overdue).unwrap_or(false)) {
            let said = format!("{what} of the rule {} has not returned", self.name);
            return error(py, Kind::NeverEnds, said, "let it return soon, or give a longer patience_s");
        }
        if !raised.is_instance(py, &PyException::type_object(py)) {
            return raised;
        }
        self::raised(py, &format!("{what} of the rule {}", self.name), raised)
    }

    /// The number of a state, which is its own as long as equal states are equal.
    pub(crate) fn number(&self, py: Python<'_>, what: &str, state: &Bound<'_, PyAny>) -> PyResult<u32> {
        let numbers = held(&self.states).numbers.clone_ref(py);
        let numbers = numbers.bind(py);
        let unhashable = |raised: PyErr| {
            if !raised.is_instance_of::<PyTypeError>(py) {
                return self.refused(
                    py,
                    &format!("hashing or comparing a state that {what} returned"),
                    raised,
                );
            }
            let said =
                format!("{what} returned the state {}, which cannot be hashed and compared", shown(state));
            let told =
                error(py, Kind::WrongType, said, "make it a tuple, a string, a number or a frozen dataclass");
            told.set_cause(py, Some(raised));
            told
        };
        if let Some(number) = self.watched(|| numbers.get_item(state)).map_err(unhashable)? {
            return number.extract();
        }
        let mut states = held(&self.states);
        let number = states.values.len() as u32;
        states.values.push(state.clone().unbind());
        drop(states);
        self.watched(|| numbers.set_item(state, number)).map_err(unhashable)?;
        Ok(number)
    }

    /// The state with this number.
    pub(crate) fn state(&self, py: Python<'_>, number: u32) -> Py<PyAny> {
        held(&self.states).values.get(number as usize).map_or_else(|| py.None(), |state| state.clone_ref(py))
    }

    /// Whether a function of the rule says yes to `arguments`; no if it fails.
    pub(crate) fn says(
        &self,
        py: Python<'_>,
        what: &str,
        asked: &Py<PyAny>,
        arguments: Bound<'_, PyTuple>,
    ) -> bool {
        let answer = self.called(py, what, |_| asked.bind(py).call1(arguments)).and_then(|answer| {
            answer.extract().map_err(|_| wrong_answer(what, &answer, "return True or False"))
        });
        answer.unwrap_or_else(|error| self.fail(error))
    }

    /// Notes that the rule has failed, and says no to whatever it was asked.
    pub(crate) fn fail<T: Default>(&self, error: PyErr) -> T {
        held(&self.failure).get_or_insert(error);
        self.has_failed.store(true, Ordering::Relaxed);
        T::default()
    }

    /// Whether nothing more is to be asked.
    pub(crate) fn is_over(&self) -> bool {
        self.has_failed.load(Ordering::Relaxed) || self.is_stopped.load(Ordering::Relaxed)
    }

    /// The exception of a rule that has failed.
    pub(crate) fn failure(&self, py: Python<'_>) -> Option<PyErr> {
        held(&self.failure).as_ref().map(|error| error.clone_ref(py))
    }

    /// Whether all is well so far.
    pub(crate) fn checked(&self, py: Python<'_>) -> PyResult<()> {
        match self.failure(py) {
            Some(failure) => Err(failure),
            // Whoever stopped it knows why.
            None if self.is_over() => Err(pyo3::exceptions::PyKeyboardInterrupt::new_err(())),
            None => Ok(()),
        }
    }

    /// The exception of a rule that does not answer the same to the same.
    pub(crate) fn not_pure(&self, py: Python<'_>) -> PyErr {
        let what = format!("a run of the rule {} came out otherwise when it was made again", self.name);
        let remedy = "let its functions and the demands depend on nothing but their arguments, and let states that \
                      are the same be equal";
        error(py, Kind::NotPure, what, remedy)
    }

    /// Whoever waits for the rule, for at most so long for one call of it.
    fn patience(&self, py: Python<'_>, seconds: f64) -> PyResult<Patience<'_>> {
        let most = Duration::try_from_secs_f64(seconds).ok().filter(|most| !most.is_zero());
        let most = most.ok_or_else(|| {
            let what = format!("patience_s is {seconds}");
            error(py, Kind::Input, what, "give patience_s a number of seconds above 0")
        })?;
        Ok(Patience { script: self, most, since: (0, Instant::now()) })
    }
}

/// Whoever waits for the rule.
struct Patience<'a> {
    script: &'a Script,
    most: Duration,
    /// Which turn it is, and since when.
    since: (u64, Instant),
}

impl Patience<'_> {
    /// Interrupts a call that takes too long, as Python interrupts a thread: as soon as it executes Python code.
    fn look(&mut self, py: Python<'_>) -> PyResult<()> {
        let turn = self.script.turns.load(Ordering::Relaxed);
        if turn != self.since.0 || turn.is_multiple_of(2) {
            self.since = (turn, Instant::now());
        } else if self.since.1.elapsed() > self.most {
            self.since.1 = Instant::now();
            let overdue = py.import("pytautline._errors")?.getattr("interrupt")?;
            overdue.call1((self.script.thread.load(Ordering::Relaxed),))?;
        }
        Ok(())
    }
}

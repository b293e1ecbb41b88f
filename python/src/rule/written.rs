//! The rule itself: what it is asked, what it may answer, and what becomes of an answer that is none.

use std::collections::BTreeSet;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Mutex, MutexGuard, OnceLock, PoisonError};
use std::time::{Duration, Instant};

use pyo3::PyTypeInfo;
use pyo3::exceptions::PyException;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};
use tautline_kernel::ground::{Area, Cell, Side, SmallGrid, Step};
use tautline_papers::rivals::CATALOGUE;
use tautline_sim::explore::ClauseId;

use super::moved::TeamMove;
use crate::diagnostic::{Kind, error};
use crate::layout::{Pair, side};
use crate::run::cell;

/// The most robots of a rule written in Python.
pub(super) const MAX_ROBOTS: usize = 8;

/// Letters of a name.
const MAX_WORD: usize = 64;

/// A hint at what `step` is to return.
const ANSWER: &str = "return None when the run is over, or a state and None if that is what is known then, else the next state and a \
                      string with one letter of E, S, W, N or . for each robot";

/// When a demand is looked at.
#[derive(Debug)]
pub(super) enum When {
    /// After every team move.
    Always(Py<PyAny>),
    /// At the end of every run that ends.
    AtTheEnd(Py<PyAny>),
    /// Where a run comes back to where it was.
    NeverEndless,
}

/// A demand of the rule.
#[derive(Debug)]
pub(super) struct Demand {
    pub(super) clause: ClauseId,
    pub(super) words: &'static str,
    pub(super) when: When,
}

/// Where robots are; what lies behind the last one is not meant.
pub(super) type Cells = [Cell; MAX_ROBOTS];
/// Which robots met a wall.
pub(super) type WallHits = [bool; MAX_ROBOTS];
/// The steps that robots try.
pub(super) type Steps = [Step; MAX_ROBOTS];
/// The question to a rule: the number of its state, where robots are, and which met a wall.
type Question = (u32, Cells, WallHits);

/// The states that Python has answered, each once, by their numbers.
struct States {
    numbers: Py<PyDict>,
    values: Vec<Py<PyAny>>,
}

/// A rule written in Python.
pub(super) struct RuleScript {
    pub(super) scheme: &'static str,
    pub(super) name: &'static str,
    pub(super) robots: usize,
    pub(super) size: (i16, i16),
    pub(super) max_walls: u32,
    pub(super) longest_run: u32,
    pub(super) demands: Vec<Demand>,
    pub(super) covers: Vec<(&'static str, Py<PyAny>)>,
    /// How often Python was called.
    pub(super) calls: AtomicU64,
    /// Whether somebody wants the work to end.
    pub(super) is_stopped: AtomicBool,
    object: Py<PyAny>,
    states: Mutex<States>,
    /// The last question, and the answer.
    last: Mutex<Option<(Question, (u32, Option<Steps>))>>,
    started: OnceLock<(u32, Cells)>,
    is_called: AtomicBool,
    /// The number that Python has for the thread that asks the rule.
    thread: AtomicU64,
    has_failed: AtomicBool,
    failure: Mutex<Option<PyErr>>,
    /// The demands that a run was seen to break.
    seen: Mutex<BTreeSet<usize>>,
}

/// The words that rules bring. There are few, and they are kept as long as the process.
static KEPT: Mutex<BTreeSet<&'static str>> = Mutex::new(BTreeSet::new());

fn held<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

fn kept(text: &str) -> &'static str {
    let mut kept = held(&KEPT);
    if let Some(&known) = kept.get(text) {
        return known;
    }
    let new: &'static str = Box::leak(text.into());
    kept.insert(new);
    new
}

/// A name that can stand in every file and drawing.
fn word(py: Python<'_>, what: &str, name: &str) -> PyResult<&'static str> {
    let is_fitting = |letter: char| letter.is_ascii_alphanumeric() || letter == '-';
    if (1..=MAX_WORD).contains(&name.len()) && name.chars().all(is_fitting) {
        return Ok(kept(name));
    }
    let remedy = format!("give {what} at most {MAX_WORD} letters, digits and hyphens");
    Err(error(py, Kind::Input, format_args!("{name:?} is no name"), remedy))
}

/// An attribute of a rule, of this type.
fn attribute<'py, T: for<'a> FromPyObject<'a, 'py>>(
    rule: &Bound<'py, PyAny>,
    name: &str,
    wanted: &str,
) -> PyResult<T> {
    let py = rule.py();
    let wrong = |what: String| error(py, Kind::WrongType, what, format_args!("give the rule {wanted}"));
    let value = rule.getattr(name).map_err(|_| wrong(format!("the rule has no {name}")))?;
    value.extract().map_err(|_| wrong(format!("the rule's {name} is {}", shown(&value))))
}

/// A value as a person sees it, not too long.
fn shown(value: &Bound<'_, PyAny>) -> String {
    let text =
        value.repr().map_or_else(|_| "something that cannot be shown".to_owned(), |text| text.to_string());
    match text.char_indices().nth(80) {
        Some((end, _)) => format!("{}...", &text[..end]),
        None => text,
    }
}

impl RuleScript {
    /// The rule's description of itself.
    pub(super) fn read(rule: &Bound<'_, PyAny>) -> PyResult<Self> {
        let py = rule.py();
        let scheme: String = attribute(rule, "scheme", "a scheme, the name of what it is a rule of")?;
        if CATALOGUE.scheme(&scheme).is_some() {
            let what = format!("{scheme} is a scheme of tautline");
            return Err(error(py, Kind::Input, what, "give the rule's scheme another name"));
        }
        let name: String = attribute(rule, "name", "a name, such as \"written\"")?;
        let robots: usize = attribute(rule, "robots", "robots, a number from 1 to 8")?;
        if !(1..=MAX_ROBOTS).contains(&robots) {
            let remedy = format!("give the rule robots, a number from 1 to {MAX_ROBOTS}");
            return Err(error(py, Kind::Input, format_args!("{robots} robots"), remedy));
        }
        let demands: Vec<Bound<'_, PyAny>> =
            attribute(rule, "demands", "demands, a list of pytautline.Demand")?;
        let covers: Vec<(String, Py<PyAny>)> =
            attribute(rule, "covers", "covers, a list of names and functions of a move")?;
        let demands = demands.iter().map(demand).collect::<PyResult<Vec<Demand>>>()?;
        if covers.len() > 64 {
            return Err(error(py, Kind::Input, format_args!("{} covers", covers.len()), "give at most 64"));
        }
        let written = Self {
            scheme: word(py, "scheme", &scheme)?,
            name: word(py, "name", &name)?,
            robots,
            size: attribute(rule, "size", "a size, its columns and rows")?,
            max_walls: attribute(rule, "max_walls", "max_walls, a number")?,
            longest_run: attribute(rule, "longest_run", "a longest_run, a number of team moves")?,
            demands,
            covers: covers.into_iter().map(|(name, is_one)| (kept(&name), is_one)).collect(),
            calls: AtomicU64::new(0),
            is_stopped: AtomicBool::new(false),
            object: rule.clone().unbind(),
            states: Mutex::new(States { numbers: PyDict::new(py).unbind(), values: Vec::new() }),
            last: Mutex::new(None),
            started: OnceLock::new(),
            is_called: AtomicBool::new(false),
            thread: AtomicU64::new(0),
            has_failed: AtomicBool::new(false),
            failure: Mutex::new(None),
            seen: Mutex::new(BTreeSet::new()),
        };
        written.area(py)?;
        Ok(written)
    }

    /// The cells that all its layouts have.
    pub(super) fn area(&self, py: Python<'_>) -> PyResult<Area> {
        let (width, height) = self.size;
        let area = Some((width, height)).filter(|&(width, height)| width > 0 && height > 0);
        let area = area.and_then(|_| Area::new(Cell::new(0, 0), Cell::new(width - 1, height - 1)));
        area.filter(|&area| SmallGrid::new(area).is_some()).ok_or_else(|| {
            let remedy = "give the rule a size of 1 to 16 columns and 1 to 16 rows";
            error(py, Kind::Input, format_args!("{width}x{height} cells cannot be searched"), remedy)
        })
    }

    /// Asks the rule where it starts.
    pub(super) fn begin(&self, py: Python<'_>) -> PyResult<()> {
        let thread: u64 = py.import("threading")?.call_method0("get_ident")?.extract()?;
        self.thread.store(thread, Ordering::Relaxed);
        let answer = self.called(py, "start", || self.object.bind(py).call_method0("start"))?;
        let remedy = "return the state at the start and a list of the robots' cells, each a column and a row";
        let wrong = |what: String| error(py, Kind::WrongType, what, remedy);
        let told: PyResult<(Bound<'_, PyAny>, Vec<Pair>)> = answer.extract().map_err(PyErr::from);
        let (state, cells) = told.map_err(|_| wrong(format!("start returned {}", shown(&answer))))?;
        if cells.len() != self.robots {
            return Err(wrong(format!("start returned {} cells of {} robots", cells.len(), self.robots)));
        }
        let area = self.area(py)?;
        let mut all = [Cell::new(0, 0); MAX_ROBOTS];
        for (place, &start) in all.iter_mut().zip(&cells) {
            *place = cell(start);
            if !area.contains(*place) {
                return Err(wrong(format!("start returned the cell {place}, which is outside of the area")));
            }
        }
        let number = self.number(py, "start", &state)?;
        let _ = self.started.set((number, all));
        Ok(())
    }

    /// The state and the cells at the start; before [`RuleScript::begin`] there are none to speak of.
    pub(super) fn start(&self) -> (u32, Cells) {
        self.started.get().copied().unwrap_or((0, [Cell::new(0, 0); MAX_ROBOTS]))
    }

    /// Where the robots start.
    pub(super) fn starts(&self) -> &[Cell] {
        self.started.get().map_or(&[], |(_, cells)| &cells[..self.robots])
    }

    /// Calls Python, and tells whoever waits that it does.
    fn called<'py>(
        &self,
        py: Python<'py>,
        what: &str,
        call: impl FnOnce() -> PyResult<Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        self.calls.fetch_add(1, Ordering::Relaxed);
        self.is_called.store(true, Ordering::Relaxed);
        let answer = call();
        self.is_called.store(false, Ordering::Relaxed);
        answer.map_err(|raised| self.refused(py, what, raised))
    }

    /// The exception for one that Python code of the rule has raised.
    fn refused(&self, py: Python<'_>, what: &str, raised: PyErr) -> PyErr {
        let overdue = py.import("pytautline._errors").and_then(|errors| errors.getattr("Overdue"));
        if overdue.is_ok_and(|overdue| raised.matches(py, overdue).unwrap_or(false)) {
            let said = format!("{what} of the rule {} has not returned", self.name);
            return error(
                py,
                Kind::NeverEnds,
                said,
                "let it return soon, or give hunt_rule a longer patience_s",
            );
        }
        if !raised.is_instance(py, &PyException::type_object(py)) {
            return raised;
        }
        let said = format!("{what} of the rule {} raised {raised}", self.name);
        let told = error(py, Kind::Raised, said, "let it return for every layout; the cause has the place");
        told.set_cause(py, Some(raised));
        told
    }

    /// The number of a state, which is its own as long as equal states are equal.
    fn number(&self, py: Python<'_>, what: &str, state: &Bound<'_, PyAny>) -> PyResult<u32> {
        let numbers = held(&self.states).numbers.clone_ref(py);
        let numbers = numbers.bind(py);
        let unhashable = |_: PyErr| {
            let said = format!("{what} returned the state {}, which cannot be hashed", shown(state));
            error(py, Kind::WrongType, said, "make it a tuple, a string, a number or a frozen dataclass")
        };
        if let Some(number) = numbers.get_item(state).map_err(unhashable)? {
            return number.extract();
        }
        let mut states = held(&self.states);
        let number = states.values.len() as u32;
        states.values.push(state.clone().unbind());
        drop(states);
        numbers.set_item(state, number)?;
        Ok(number)
    }

    fn state(&self, py: Python<'_>, number: u32) -> Py<PyAny> {
        held(&self.states).values.get(number as usize).map_or_else(|| py.None(), |state| state.clone_ref(py))
    }

    fn cells<'py>(&self, py: Python<'py>, cells: &Cells) -> PyResult<Bound<'py, PyTuple>> {
        PyTuple::new(py, cells[..self.robots].iter().map(|cell| (cell.x, cell.y)))
    }

    /// The number of the rule's state next, and what it does; no steps if the run is over, or if the rule has failed.
    pub(super) fn step(&self, state: u32, cells: &Cells, blocked: &WallHits) -> (u32, Option<Steps>) {
        if self.is_over() {
            return (state, None);
        }
        let question = (state, *cells, *blocked);
        if let Some((_, answer)) = held(&self.last).as_ref().filter(|(last, _)| *last == question) {
            return *answer;
        }
        let asked = Python::attach(|py| self.asked(py, state, cells, blocked));
        let answer = asked.unwrap_or_else(|error| (state, self.fail(error)));
        *held(&self.last) = Some((question, answer));
        answer
    }

    fn asked(
        &self,
        py: Python<'_>,
        state: u32,
        cells: &Cells,
        blocked: &WallHits,
    ) -> PyResult<(u32, Option<Steps>)> {
        let blocked = PyTuple::new(py, &blocked[..self.robots])?;
        let arguments = (self.state(py, state), self.cells(py, cells)?, blocked);
        let answer = self.called(py, "step", || self.object.bind(py).call_method1("step", arguments))?;
        if answer.is_none() {
            return Ok((state, None));
        }
        let wrong = || error(py, Kind::WrongType, format_args!("step returned {}", shown(&answer)), ANSWER);
        let (next, letters): (Bound<'_, PyAny>, Option<String>) = answer.extract().map_err(|_| wrong())?;
        let next = |py| self.number(py, "step", &next);
        let Some(letters) = letters else { return Ok((next(py)?, None)) };
        let mut steps = [Step::Stay; MAX_ROBOTS];
        if letters.chars().count() != self.robots {
            return Err(wrong());
        }
        for (step, letter) in steps.iter_mut().zip(letters.chars()) {
            *step = match (letter, side(letter)) {
                (_, Some(side)) => Step::Cross(side),
                ('.', None) => Step::Stay,
                (_, None) => return Err(wrong()),
            };
        }
        Ok((next(py)?, Some(steps)))
    }

    /// Whether a function of the rule says yes to `argument`; no if it fails.
    fn says(&self, py: Python<'_>, what: &str, asked: &Py<PyAny>, arguments: Bound<'_, PyTuple>) -> bool {
        let answer = self.called(py, what, || asked.bind(py).call1(arguments)).and_then(|answer| {
            answer.extract().map_err(|_| {
                let said = format!("{what} returned {}", shown(&answer));
                error(py, Kind::WrongType, said, "return True or False")
            })
        });
        answer.unwrap_or_else(|error| self.fail(error))
    }

    /// Whether a team move breaks the demand with this number.
    pub(super) fn is_broken_by(&self, demand: usize, moved: &Move) -> bool {
        self.is_broken(demand, |py, demand| match &demand.when {
            When::Always(is_kept) => {
                let moved = moved.told(py, self).and_then(|moved| PyTuple::new(py, [moved]));
                let moved = moved.unwrap_or_else(|_| PyTuple::empty(py));
                !self.says(py, demand.clause.as_str(), is_kept, moved)
            }
            When::AtTheEnd(_) | When::NeverEndless => false,
        })
    }

    /// Whether the end of a run breaks the demand with this number.
    pub(super) fn is_broken_at_end(&self, demand: usize, state: u32, cells: &Cells) -> bool {
        self.is_broken(demand, |py, demand| match &demand.when {
            When::AtTheEnd(is_kept) => {
                let end =
                    self.cells(py, cells).and_then(|cells| (self.state(py, state), cells).into_pyobject(py));
                let end = end.unwrap_or_else(|_| PyTuple::empty(py));
                !self.says(py, demand.clause.as_str(), is_kept, end)
            }
            When::Always(_) | When::NeverEndless => false,
        })
    }

    /// Whether this is so of the demand with this number; no if the rule has failed.
    fn is_broken(&self, demand: usize, is_broken: impl Fn(Python<'_>, &Demand) -> bool) -> bool {
        if self.is_over() {
            return false;
        }
        let is_found = Python::attach(|py| is_broken(py, &self.demands[demand])) && !self.is_over();
        if is_found {
            held(&self.seen).insert(demand);
        }
        is_found
    }

    /// Whether a team move is the situation with this number.
    pub(super) fn occurs(&self, cover: usize, moved: &Move) -> bool {
        if self.is_over() {
            return false;
        }
        Python::attach(|py| {
            let (name, is_one) = &self.covers[cover];
            let moved = moved.told(py, self).and_then(|moved| PyTuple::new(py, [moved]));
            moved.is_ok_and(|moved| self.says(py, name, is_one, moved))
        })
    }

    /// The demands that a run was seen to break.
    pub(super) fn seen(&self) -> BTreeSet<usize> {
        held(&self.seen).clone()
    }

    /// Notes that the rule has failed, and says no to whatever it was asked.
    fn fail<T: Default>(&self, error: PyErr) -> T {
        held(&self.failure).get_or_insert(error);
        self.has_failed.store(true, Ordering::Relaxed);
        T::default()
    }

    /// Whether nothing more is to be asked.
    pub(super) fn is_over(&self) -> bool {
        self.has_failed.load(Ordering::Relaxed) || self.is_stopped.load(Ordering::Relaxed)
    }

    /// The exception of a rule that has failed.
    pub(super) fn failure(&self, py: Python<'_>) -> Option<PyErr> {
        held(&self.failure).as_ref().map(|error| error.clone_ref(py))
    }

    /// Whether all is well so far.
    pub(super) fn checked(&self, py: Python<'_>) -> PyResult<()> {
        match self.failure(py) {
            Some(failure) => Err(failure),
            // Whoever stopped it knows why.
            None if self.is_over() => Err(pyo3::exceptions::PyKeyboardInterrupt::new_err(())),
            None => Ok(()),
        }
    }

    /// The exception of a rule that does not answer the same to the same.
    pub(super) fn not_pure(&self, py: Python<'_>) -> PyErr {
        let what = format!("a run of the rule {} came out otherwise when it was made again", self.name);
        error(py, Kind::NotPure, what, "let step and the demands depend on nothing but their arguments")
    }

    /// Whoever waits for the rule, for at most so long for one call of it.
    pub(super) fn patience(&self, seconds: f64) -> PyResult<Patience<'_>> {
        let most = Duration::try_from_secs_f64(seconds).ok().filter(|most| !most.is_zero());
        let most = most.ok_or_else(|| {
            Python::attach(|py| {
                let what = format!("patience_s is {seconds}");
                error(py, Kind::Input, what, "give patience_s a number of seconds above 0")
            })
        })?;
        Ok(Patience { written: self, most, since: (0, Instant::now()) })
    }
}

fn demand(demand: &Bound<'_, PyAny>) -> PyResult<Demand> {
    let py = demand.py();
    let wanted = "demands made by pytautline.always, pytautline.at_the_end and pytautline.never_endless";
    let (id, words): (String, String) =
        (attribute(demand, "id", wanted)?, attribute(demand, "words", wanted)?);
    let when: String = attribute(demand, "when", wanted)?;
    let kept_by: Py<PyAny> = attribute(demand, "kept", wanted)?;
    let when = match when.as_str() {
        "always" => When::Always(kept_by),
        "at-the-end" => When::AtTheEnd(kept_by),
        "never-endless" => When::NeverEndless,
        _ => {
            let what = format!("a demand is looked at {when:?}");
            return Err(error(py, Kind::WrongType, what, format_args!("give the rule {wanted}")));
        }
    };
    Ok(Demand { clause: ClauseId::new(word(py, "the id", &id)?), words: kept(&words), when })
}

/// One team move.
pub(super) struct Move {
    pub(super) before: u32,
    pub(super) after: u32,
    pub(super) from: Cells,
    pub(super) to: Cells,
    pub(super) steps: Steps,
    pub(super) blocked: WallHits,
}

impl Move {
    /// As a demand sees it.
    fn told<'py>(&self, py: Python<'py>, written: &RuleScript) -> PyResult<Bound<'py, TeamMove>> {
        let tried = self.steps[..written.robots].iter().map(|&step| match step {
            Step::Cross(Side::East) => 'E',
            Step::Cross(Side::South) => 'S',
            Step::Cross(Side::West) => 'W',
            Step::Cross(Side::North) => 'N',
            Step::Stay => '.',
        });
        let moved = TeamMove {
            before: written.state(py, self.before),
            after: written.state(py, self.after),
            cells_before: written.cells(py, &self.from)?.unbind(),
            cells: written.cells(py, &self.to)?.unbind(),
            tried: tried.collect(),
            blocked: PyTuple::new(py, &self.blocked[..written.robots])?.unbind(),
        };
        Bound::new(py, moved)
    }
}

/// Whoever waits for the rule.
pub(super) struct Patience<'a> {
    written: &'a RuleScript,
    most: Duration,
    /// Which call it is, and since when.
    since: (u64, Instant),
}

impl Patience<'_> {
    /// Interrupts a call that takes too long, as Python interrupts a thread: as soon as it executes Python code.
    pub(super) fn look(&mut self, py: Python<'_>) -> PyResult<()> {
        let call = self.written.calls.load(Ordering::Relaxed);
        if call != self.since.0 || !self.written.is_called.load(Ordering::Relaxed) {
            self.since = (call, Instant::now());
        } else if self.since.1.elapsed() > self.most {
            self.since.1 = Instant::now();
            let overdue = py.import("pytautline._errors")?.getattr("interrupt")?;
            overdue.call1((self.written.thread.load(Ordering::Relaxed),))?;
        }
        Ok(())
    }
}

//! The rule itself: what it is asked, what it may answer, and what becomes of an answer that is none.

use std::collections::BTreeSet;
use std::sync::{Mutex, OnceLock};

use pyo3::prelude::*;
use pyo3::types::PyTuple;
use tautline_kernel::ground::{Area, Cell, SmallGrid, Step};
use tautline_papers::rivals::CATALOGUE;
use tautline_proofs::engine::states::Bits;
use tautline_sim::explore::ClauseId;
use tautline_sim::trace::{self, letter};

use super::team_move::TeamMove;
use crate::arguments::{At, Int, List};
use crate::diagnostic::{Kind, error, shown};
use crate::script::{
    Script, are_demands, attribute, attribute_of, held, is_rule_of, kept, number, word, wrong_answer,
};

/// The most robots of a rule written in Python.
pub(super) const MAX_ROBOTS: usize = 8;

/// The most columns, and rows, of its layouts.
const MAX_SIDE: i16 = 16;
const SIZE: &str = "a size of 1 to 16 columns and 1 to 16 rows";

/// The most demands: which of them were met is a bit for each.
const MAX_DEMANDS: usize = u64::BITS as usize;

/// A hint at what `step` is to return.
const ANSWER: &str = "return None when the run is over, or a state and None if that is what is known then, else the \
                      next state and a string with one letter of E, S, W, N or . for each robot";

/// When a demand is looked at.
#[derive(Debug)]
pub(super) enum When {
    /// After every team move.
    Always(Py<PyAny>),
    /// At the end of every run that ends.
    AtTheEnd(Py<PyAny>),
    /// Where a run comes back to where it was.
    NeverEndless,
    /// There, and at the end of every run that ends, unless it was so before.
    Eventually(Py<PyAny>),
    /// There, and at the end of every run that ends, for what is owed.
    AgainAndAgain(Py<PyAny>),
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
/// The answer: the number of its next state, and the steps, if the run goes on.
type Answer = (u32, Option<Steps>);

/// A rule written in Python.
pub(super) struct RuleScript {
    pub(super) scheme: &'static str,
    pub(super) robots: usize,
    pub(super) size: (i16, i16),
    pub(super) max_walls: u32,
    pub(super) longest_run: u32,
    pub(super) demands: Vec<Demand>,
    pub(super) covers: Vec<(&'static str, Py<PyAny>)>,
    /// The rule as Python has it.
    pub(super) script: Script,
    /// The last question, and the answer.
    last: Mutex<Option<(Question, Answer)>>,
    started: OnceLock<(u32, Cells)>,
    /// The demands that a run was seen to break.
    seen: Mutex<BTreeSet<usize>>,
}

impl RuleScript {
    /// The rule's description of itself.
    pub(super) fn read(rule: &Bound<'_, PyAny>) -> PyResult<Self> {
        let py = rule.py();
        is_rule_of(rule, "Rule")?;
        let scheme: String = attribute(rule, "scheme", "a scheme, the name of what it is a rule of")?;
        if CATALOGUE.scheme(&scheme).is_some() {
            let what = format!("{scheme} is a scheme of tautline");
            return Err(error(py, Kind::Input, what, "give the rule's scheme another name"));
        }
        let name: String = attribute(rule, "name", "a name, such as \"written\"")?;
        let List(demands): List<Bound<'_, PyAny>> =
            attribute(rule, "demands", "demands, a list of pytautline.Demand")?;
        let List(covers): List<(String, Py<PyAny>)> =
            attribute(rule, "covers", "covers, a list of names and functions of a move")?;
        let demands = demands.iter().map(demand).collect::<PyResult<Vec<Demand>>>()?;
        are_demands(py, demands.iter().map(|demand| demand.clause.as_str()))?;
        if demands.len() > MAX_DEMANDS {
            let what = format_args!("{} demands", demands.len());
            return Err(error(py, Kind::Input, what, format_args!("give at most {MAX_DEMANDS}")));
        }
        if covers.len() > 64 {
            return Err(error(py, Kind::Input, format_args!("{} covers", covers.len()), "give at most 64"));
        }
        let (width, height): (Int, Int) = attribute(rule, "size", SIZE)?;
        let side = |cells: Int| cells.within(py, "a side of size", 1..=MAX_SIDE);
        let written = Self {
            scheme: word(py, "scheme", &scheme)?,
            robots: number(rule, "robots", 1..=MAX_ROBOTS)?,
            size: (side(width)?, side(height)?),
            max_walls: number(rule, "max_walls", 0..=u32::MAX)?,
            longest_run: number(rule, "longest_run", 0..=u32::MAX)?,
            demands,
            covers: covers.into_iter().map(|(name, is_one)| (kept(&name), is_one)).collect(),
            script: Script::new(rule, word(py, "name", &name)?),
            last: Mutex::new(None),
            started: OnceLock::new(),
            seen: Mutex::new(BTreeSet::new()),
        };
        written.area(py)?;
        Ok(written)
    }

    /// The cells that all its layouts have.
    pub(super) fn area(&self, py: Python<'_>) -> PyResult<Area> {
        let (width, height) = self.size;
        let area = Area::new(Cell::new(0, 0), Cell::new(width - 1, height - 1));
        area.filter(|&area| SmallGrid::new(area).is_some()).ok_or_else(|| {
            let what = format_args!("{width}x{height} cells cannot be searched");
            error(py, Kind::Input, what, format_args!("give the rule {SIZE}"))
        })
    }

    /// Asks the rule where it starts.
    pub(super) fn begin(&self, py: Python<'_>) -> PyResult<()> {
        let answer = self.script.called(py, "start", |rule| rule.call_method0("start"))?;
        let remedy = "return the state at the start and a list of the robots' cells, each a column and a row";
        let wrong = |what: String| error(py, Kind::WrongType, what, remedy);
        let told: PyResult<(Bound<'_, PyAny>, List<At>)> = answer.extract();
        let (state, List(cells)) = told.map_err(|_| wrong(format!("start returned {}", shown(&answer))))?;
        if cells.len() != self.robots {
            return Err(wrong(format!("start returned {} cells of {} robots", cells.len(), self.robots)));
        }
        let area = self.area(py)?;
        let mut all = [Cell::new(0, 0); MAX_ROBOTS];
        for (place, &At(start)) in all.iter_mut().zip(&cells) {
            *place = start;
            if !area.contains(*place) {
                return Err(wrong(format!("start returned the cell {place}, which is outside of the area")));
            }
        }
        let number = self.script.number(py, "start", &state)?;
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

    fn cells<'py>(&self, py: Python<'py>, cells: &Cells) -> PyResult<Bound<'py, PyTuple>> {
        PyTuple::new(py, cells[..self.robots].iter().map(|cell| (cell.x, cell.y)))
    }

    /// A state and the cells of the robots, as a demand of them sees it.
    fn scene<'py>(&self, py: Python<'py>, state: u32, cells: &Cells) -> PyResult<Bound<'py, PyTuple>> {
        (self.script.state(py, state), self.cells(py, cells)?).into_pyobject(py)
    }

    /// The number of the rule's state next, and what it does; no steps if the run is over, or if the rule has failed.
    pub(super) fn step(&self, state: u32, cells: &Cells, blocked: WallHits) -> Answer {
        if self.script.is_over() {
            return (state, None);
        }
        let question = (state, *cells, blocked);
        if let Some((_, answer)) = held(&self.last).as_ref().filter(|(last, _)| *last == question) {
            return *answer;
        }
        let asked = Python::attach(|py| self.asked(py, state, cells, blocked));
        let answer = asked.unwrap_or_else(|error| (state, self.script.fail(error)));
        *held(&self.last) = Some((question, answer));
        answer
    }

    fn asked(&self, py: Python<'_>, state: u32, cells: &Cells, blocked: WallHits) -> PyResult<Answer> {
        let blocked = PyTuple::new(py, &blocked[..self.robots])?;
        let arguments = (self.script.state(py, state), self.cells(py, cells)?, blocked);
        let answer = self.script.called(py, "step", |rule| rule.call_method1("step", arguments))?;
        if answer.is_none() {
            return Ok((state, None));
        }
        let wrong = || wrong_answer("step", &answer, ANSWER);
        let (next, letters): (Bound<'_, PyAny>, Option<String>) = answer.extract().map_err(|_| wrong())?;
        let next = |py| self.script.number(py, "step", &next);
        let Some(letters) = letters else { return Ok((next(py)?, None)) };
        let made = trace::steps(&letters, self.robots).map_err(|_| wrong())?;
        let mut steps = [Step::Stay; MAX_ROBOTS];
        steps[..made.len()].copy_from_slice(&made);
        Ok((next(py)?, Some(steps)))
    }

    /// Whether a team move breaks the demand with this number.
    pub(super) fn is_broken_by(&self, demand: usize, moved: &Move) -> bool {
        self.is_broken(demand, |py, demand| match &demand.when {
            When::Always(is_kept) => {
                let moved = moved.told(py, self).and_then(|moved| PyTuple::new(py, [moved]));
                let moved = moved.unwrap_or_else(|_| PyTuple::empty(py));
                !self.script.says(py, demand.clause.as_str(), is_kept, moved)
            }
            When::AtTheEnd(_) | When::NeverEndless | When::Eventually(_) | When::AgainAndAgain(_) => false,
        })
    }

    /// Whether the end of a run breaks the demand with this number.
    pub(super) fn is_broken_at_end(&self, demand: usize, state: u32, cells: &Cells) -> bool {
        self.is_broken(demand, |py, demand| match &demand.when {
            When::AtTheEnd(is_kept) => {
                let end = self.scene(py, state, cells).unwrap_or_else(|_| PyTuple::empty(py));
                !self.script.says(py, demand.clause.as_str(), is_kept, end)
            }
            When::Always(_) | When::NeverEndless | When::Eventually(_) | When::AgainAndAgain(_) => false,
        })
    }

    /// The obligations of the demand with this number, a bit for each; none if the rule has failed.
    pub(super) fn owed(&self, demand: usize, state: u32, cells: &Cells) -> Bits {
        let Demand { clause, when, .. } = &self.demands[demand];
        let When::AgainAndAgain(asked) = when else { return 0 };
        if self.script.is_over() {
            return 0;
        }
        let owed =
            |py: Python<'_>| self.script.owed(py, clause.as_str(), asked, self.scene(py, state, cells)?);
        Python::attach(|py| owed(py).unwrap_or_else(|failed| self.script.fail(failed)))
    }

    /// Whether what the demand with this number waits for is so; no if it waits for nothing, or if the rule has failed.
    pub(super) fn is_met(&self, demand: usize, state: u32, cells: &Cells) -> bool {
        let Demand { clause, when, .. } = &self.demands[demand];
        let When::Eventually(is_so) = when else { return false };
        !self.script.is_over()
            && Python::attach(|py| {
                let scene = self.scene(py, state, cells).unwrap_or_else(|_| PyTuple::empty(py));
                self.script.says(py, clause.as_str(), is_so, scene)
            })
    }

    /// Whether this is so of the demand with this number; no if the rule has failed.
    fn is_broken(&self, demand: usize, is_broken: impl Fn(Python<'_>, &Demand) -> bool) -> bool {
        if self.script.is_over() {
            return false;
        }
        let is_found = Python::attach(|py| is_broken(py, &self.demands[demand])) && !self.script.is_over();
        if is_found {
            held(&self.seen).insert(demand);
        }
        is_found
    }

    /// Whether a team move is the situation with this number.
    pub(super) fn occurs(&self, cover: usize, moved: &Move) -> bool {
        if self.script.is_over() {
            return false;
        }
        Python::attach(|py| {
            let (name, is_one) = &self.covers[cover];
            let moved = moved.told(py, self).and_then(|moved| PyTuple::new(py, [moved]));
            moved.is_ok_and(|moved| self.script.says(py, name, is_one, moved))
        })
    }

    /// The demands that a run was seen to break.
    pub(super) fn seen(&self) -> BTreeSet<usize> {
        held(&self.seen).clone()
    }
}

fn demand(demand: &Bound<'_, PyAny>) -> PyResult<Demand> {
    let py = demand.py();
    let wanted =
        "demands made by pytautline.always, at_the_end, never_endless, eventually and again_and_again";
    let text = |name: &str| attribute_of::<String>("the demand", demand, name, wanted);
    let (id, words, when) = (text("id")?, text("words")?, text("when")?);
    let kept_by: Py<PyAny> = attribute_of("the demand", demand, "kept", wanted)?;
    let when = match when.as_str() {
        "always" => When::Always(kept_by),
        "at-the-end" => When::AtTheEnd(kept_by),
        "never-endless" => When::NeverEndless,
        "eventually" => When::Eventually(kept_by),
        "again-and-again" => When::AgainAndAgain(kept_by),
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
        let tried = self.steps[..written.robots].iter().map(|&step| letter(step));
        let moved = TeamMove {
            before: written.script.state(py, self.before),
            after: written.script.state(py, self.after),
            cells_before: written.cells(py, &self.from)?.unbind(),
            cells: written.cells(py, &self.to)?.unbind(),
            tried: tried.collect(),
            blocked: PyTuple::new(py, &self.blocked[..written.robots])?.unbind(),
        };
        Bound::new(py, moved)
    }
}

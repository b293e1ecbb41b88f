//! A rule over states in Python, as a [`Protocol`]: a state is the number of the value that Python has for it.

use std::collections::BTreeSet;
use std::fmt;
use std::sync::{Arc, Mutex, OnceLock};

use pyo3::prelude::*;
use pyo3::types::PyTuple;
use tautline_proofs::decide::MethodError;
use tautline_proofs::demands;
use tautline_proofs::engine::states::Bits;
use tautline_proofs::protocol::{Bound as StateBound, Demand, Move, Protocol, set};

use crate::arguments::List;
use crate::diagnostic::{Kind, error, shown};
use crate::script::{
    Script, are_demands, attribute, attribute_of, held, is_rule_of, kept, word, wrong_answer,
};

/// Different words of moves that a rule may have, which are kept as long as the process.
const MAX_WORDS: usize = 256;

/// A hint at what `moves` is to return.
const MOVES: &str = "return a list of pytautline.Move, each with the numbers of its actors from 0 \
                     to 15, with words, and with the next state";

/// A demand of the rule.
pub(super) struct ScriptDemand {
    pub(super) clause: &'static str,
    pub(super) words: &'static str,
    /// The number of its kind among the demands of [`ScriptCheck`].
    pub(super) kind: usize,
    asked: Py<PyAny>,
}

/// A rule over states.
pub(super) struct StateScript {
    /// The rule as Python has it.
    pub(super) script: Script,
    pub(super) bound: &'static str,
    pub(super) demands: Vec<ScriptDemand>,
    pub(super) covers: Vec<String>,
    starts: OnceLock<Vec<u32>>,
    /// The words of moves that were possible.
    met: Mutex<BTreeSet<&'static str>>,
}

impl StateScript {
    /// The rule's description of itself.
    pub(super) fn read(rule: &Bound<'_, PyAny>) -> PyResult<Self> {
        let py = rule.py();
        is_rule_of(rule, "Protocol")?;
        let name: String = attribute(rule, "name", "a name, such as \"written\"")?;
        let bound: String = attribute(rule, "bound", "a bound, in words, such as \"3 nodes\"")?;
        let List(demands): List<Bound<'_, PyAny>> =
            attribute(rule, "demands", "demands, a list of pytautline.Demand")?;
        let demands = demands.iter().map(wanted).collect::<PyResult<Vec<_>>>()?;
        are_demands(py, demands.iter().map(|demand| demand.clause))?;
        Ok(Self {
            script: Script::new(rule, word(py, "name", &name)?),
            bound: kept(&bound),
            demands,
            covers: attribute::<List<_>>(rule, "covers", "covers, a list of the words of moves")?.0,
            starts: OnceLock::new(),
            met: Mutex::default(),
        })
    }

    /// Asks the rule where its runs begin.
    pub(super) fn begin(&self, py: Python<'_>) -> PyResult<()> {
        let starts =
            self.states(py, "starts", "return a list of states", |rule| rule.call_method0("starts"))?;
        let _ = self.starts.set(starts);
        Ok(())
    }

    /// The states in which runs begin; before [`StateScript::begin`] there are none.
    pub(super) fn starts(&self) -> &[u32] {
        self.starts.get().map_or(&[], Vec::as_slice)
    }

    /// The words of the moves that were possible since this was asked last.
    pub(super) fn take_met(&self) -> BTreeSet<&'static str> {
        std::mem::take(&mut held(&self.met))
    }

    fn states<'py>(
        &self,
        py: Python<'py>,
        what: &str,
        remedy: &str,
        call: impl FnOnce(&Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>>,
    ) -> PyResult<Vec<u32>> {
        let states = self.script.listed(py, what, remedy, call)?;
        states.iter().map(|state| self.script.number(py, what, state)).collect()
    }

    fn moves(&self, py: Python<'_>, state: u32) -> PyResult<Vec<Move<u32>>> {
        let state = (self.script.state(py, state),);
        let moves = self.script.listed(py, "moves", MOVES, |rule| rule.call_method1("moves", state))?;
        moves.iter().map(|made| self.made(py, made)).collect()
    }

    fn made(&self, py: Python<'_>, made: &Bound<'_, PyAny>) -> PyResult<Move<u32>> {
        let wrong = || wrong_answer("moves", made, MOVES);
        let (List(actors), words, to): (List<u32>, String, Bound<'_, PyAny>) =
            made.extract().map_err(|_| wrong())?;
        let by = made.getattr_opt("by")?.map(|by| by.extract::<Option<usize>>());
        let by = by.transpose().map_err(|_| wrong())?.flatten();
        if actors.iter().any(|&actor| actor >= Bits::BITS) {
            return Err(wrong());
        }
        let actors = set(actors.into_iter().map(|actor| actor as usize));
        let made = Move::of_set(actors, self.met(py, &words)?, self.script.number(py, "moves", &to)?);
        Ok(match by {
            Some(by) => made.by(by),
            None => made,
        })
    }

    /// The words of a move, which are met.
    fn met(&self, py: Python<'_>, words: &str) -> PyResult<&'static str> {
        let mut met = held(&self.met);
        if let Some(known) = met.get(words) {
            return Ok(known);
        }
        if met.len() == MAX_WORDS {
            let what = format!("moves have more than {MAX_WORDS} different words");
            let remedy = "let words be those of a kind of move; what differs stands in the states";
            return Err(error(py, Kind::Input, what, remedy));
        }
        let words = kept(words);
        met.insert(words);
        Ok(words)
    }

    /// An answer about states; the default if the rule has failed or is to stop.
    fn answer<T: Default>(&self, ask: impl FnOnce(Python<'_>) -> PyResult<T>) -> T {
        if self.script.is_over() {
            return T::default();
        }
        Python::attach(|py| ask(py).unwrap_or_else(|failed| self.script.fail(failed)))
    }
}

fn wanted(demand: &Bound<'_, PyAny>) -> PyResult<ScriptDemand> {
    let py = demand.py();
    let made_by = "demands made by pytautline.always, at_the_end, eventually and again_and_again";
    let text = |name: &str| attribute_of::<String>("the demand", demand, name, made_by);
    let (id, words, when) = (text("id")?, text("words")?, text("when")?);
    let kind = KINDS.iter().position(|&kind| kind == when).ok_or_else(|| {
        let what = format!("a demand on states is looked at {when:?}");
        error(py, Kind::WrongType, what, format_args!("give the rule {made_by}"))
    })?;
    let asked = attribute_of("the demand", demand, "kept", made_by)?;
    Ok(ScriptDemand { clause: word(py, "the id", &id)?, words: kept(&words), kind, asked })
}

/// The kinds of demands, in the order of those of [`ScriptCheck`].
const KINDS: [&str; 4] = ["always", "at-the-end", "eventually", "again-and-again"];

/// A rule over states that was written in Python, and the number of the demand that is looked at.
#[derive(Clone)]
pub(super) struct ScriptCheck(pub(super) Arc<StateScript>, pub(super) usize);

/// A bound in the words of its rule.
pub(super) struct Words(pub(super) &'static str);

impl fmt::Display for Words {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.0)
    }
}

impl StateBound for Words {
    /// The rule knows its surroundings.
    type Surroundings = ();

    fn each(&self) -> Result<Vec<()>, MethodError> {
        Ok(vec![()])
    }
}

impl ScriptCheck {
    /// Whether the demand says yes to states.
    fn says<const N: usize>(&self, states: [u32; N]) -> bool {
        let Self(rule, demand) = self;
        let ScriptDemand { clause, asked, .. } = &rule.demands[*demand];
        rule.answer(|py| {
            let states = PyTuple::new(py, states.map(|state| rule.script.state(py, state)))?;
            Ok(rule.script.says(py, clause, asked, states))
        })
    }

    /// The obligations of the demand in a state.
    fn owed(&self, state: u32) -> Bits {
        let Self(rule, demand) = self;
        let ScriptDemand { clause, asked, .. } = &rule.demands[*demand];
        rule.answer(|py| {
            let state = PyTuple::new(py, [rule.script.state(py, state)])?;
            rule.script.owed(py, clause, asked, state)
        })
    }
}

impl Protocol for ScriptCheck {
    type Bound = Words;
    type State = u32;
    demands! {
        always "every move keeps it", |rule, (), &before, &after| rule.says([before, after]);
        at_the_end "it is so at the end", |rule, (), &state| rule.says([state]);
        eventually "it is so at some time", |rule, (), &state| rule.says([state]);
        again_and_again "nothing is owed for ever", |rule, (), &state| rule.owed(state);
    }

    fn starts(&self, (): &()) -> impl IntoIterator<Item = u32> {
        self.0.starts().iter().copied()
    }

    fn moves(&self, (): &(), &state: &u32) -> Vec<Move<u32>> {
        self.0.answer(|py| self.0.moves(py, state))
    }

    fn alike(&self, (): &(), &state: &u32) -> Vec<u32> {
        let Self(rule, _) = self;
        rule.answer(|py| {
            let state = (rule.script.state(py, state),);
            rule.states(py, "alike", "return a list of states", |rule| rule.call_method1("alike", state))
        })
    }

    fn actor(&self, number: usize) -> String {
        let Self(rule, _) = self;
        rule.answer(|py| {
            let name = rule.script.called(py, "actor", |rule| rule.call_method1("actor", (number,)))?;
            name.extract().map_err(|_| wrong_answer("actor", &name, "return a string, in one line"))
        })
    }

    fn draw(&self, (): &(), &state: &u32) -> String {
        let Self(rule, _) = self;
        rule.answer(|py| {
            let state = (rule.script.state(py, state),);
            let drawing = rule.script.called(py, "draw", |rule| rule.call_method1("draw", state))?;
            let remedy = "return a string, in as many lines as it takes";
            drawing.extract().map_err(|_| wrong_answer("draw", &drawing, remedy))
        })
    }

    fn demand_words(&self, _: &Demand<Self>) -> &'static str {
        self.0.demands[self.1].words
    }

    fn words(&self, &state: &u32) -> String {
        Python::attach(|py| shown(self.0.script.state(py, state).bind(py)))
    }
}

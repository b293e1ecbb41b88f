//! How a check is decided: a [`Method`] asks an engine, remembers what may be asked again, and answers with a verdict
//! and what refutes the clause. What is here knows engines and no scheme.

mod bodies;
mod reasons;

use std::any::Any;
use std::fmt;

pub use self::bodies::{Body, EveryAnswer, RandomAnswers};
pub use self::reasons::cut_short;
use crate::engine::model::StatesModel;
use crate::engine::smallest::Certificate;
use crate::engine::states::{self, AnySystem, Limits, Memory, Step, System};
use crate::engine::tree::Watch;
use crate::engine::{Choices, Script, ScriptError, Until};
use crate::floor_trace::Course;
use crate::judge::AnyCase;
use crate::plural::counted;
use crate::run::{Run, ScriptedRun};

/// A check's verdict.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub enum Verdict {
    /// Every case within the bound was looked at, and none breaks the clause.
    Holds,
    /// Cases were sampled, and none of them breaks the clause.
    Unrefuted,
    /// There is a counterexample.
    Refuted,
    /// Neither: the check ended before its bound, or did not cover what it claims to.
    Open,
}

impl Verdict {
    /// The word in the ledger.
    pub const fn word(self) -> &'static str {
        match self {
            Self::Holds => "holds",
            Self::Unrefuted => "unrefuted",
            Self::Refuted => "refuted",
            Self::Open => "open",
        }
    }
}

/// A counterexample that refutes a clause.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Evidence {
    /// The choices that make it again.
    pub choices: Choices,
    /// The demand that is not met, or what is not so.
    pub demand: &'static str,
    /// The counterexample for a person.
    pub seen: Depiction,
}

impl Evidence {
    /// The size of the counterexample, in words.
    pub fn size(&self) -> String {
        match &self.seen {
            Depiction::Choices | Depiction::Story(_) => counted(self.choices.all().count(), "choice"),
            Depiction::Robots(run) => {
                format!("{} and {}", counted(run.walls.len(), "wall"), counted(run.frames.len(), "team move"))
            }
            Depiction::Agents(course) => counted(course.turns.len(), "act"),
            Depiction::Messages { events, .. } => counted(*events, "event"),
        }
    }
}

/// A counterexample as a person sees it.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Depiction {
    /// Its choices alone.
    Choices,
    /// The events, in lines.
    Story(String),
    /// Robots that move together.
    Robots(Box<Run>),
    /// Agents that act in turns.
    Agents(Box<Course>),
    /// Messages, drawn as a chart.
    Messages {
        /// How much happens.
        events: usize,
        /// The chart.
        chart: String,
    },
}

/// A refutation that was played.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct RefutationPlay {
    /// From how many each choice was made, in the order of the choices.
    pub of: Vec<u32>,
    /// The evidence for the verdict.
    pub evidence: Evidence,
}

/// A method's answer about a rule.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Answer {
    /// The verdict.
    pub verdict: Verdict,
    /// Cases of a body that met its assumptions, runs of a search, or states.
    pub cases: u64,
    /// Cases that were given up undecided; they are not among the others.
    pub given_up: u64,
    /// The counterexample, if it is refuted.
    pub counterexample: Option<Evidence>,
    /// Whatever else was found, in words.
    pub note: Option<String>,
}

impl Answer {
    /// A counterexample, or `shown` if everything was looked at, and that was not nothing; else the question is open.
    pub fn new(counterexample: Option<Evidence>, is_whole: bool, shown: Verdict, cases: u64) -> Self {
        let verdict = match counterexample {
            Some(_) => Verdict::Refuted,
            None if is_whole && cases > 0 => shown,
            None => Verdict::Open,
        };
        Self { verdict, cases, given_up: 0, counterexample, note: None }
    }

    /// Nothing was looked at.
    pub const fn open() -> Self {
        Self { verdict: Verdict::Open, cases: 0, given_up: 0, counterexample: None, note: None }
    }

    /// The answer of those to all portions of a check, with the shortest counterexample, of which the first. A portion
    /// in which there was nothing to look at says nothing.
    pub fn merged(answers: impl IntoIterator<Item = Self>) -> Self {
        let key = |answer: &Self| {
            let choices = answer.counterexample.as_ref().map(|found| &found.choices);
            let length = choices
                .map(|choices| (choices.once.len() + choices.again.len(), choices.once.first().copied()));
            let rank = match answer.verdict {
                Verdict::Refuted => 0,
                Verdict::Open if answer.cases + answer.given_up > 0 => 1,
                Verdict::Holds | Verdict::Unrefuted => 2,
                Verdict::Open => 3,
            };
            (rank, length)
        };
        let mut answers: Vec<Self> = answers.into_iter().collect();
        answers.sort_by_key(key);
        let (cases, given_up) =
            answers.iter().fold((0, 0), |sum, one| (sum.0 + one.cases, sum.1 + one.given_up));
        let first = answers.into_iter().next().unwrap_or_else(Self::open);
        Self { cases, given_up, ..first }
    }
}

/// Why a method cannot begin.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct MethodError(String);

impl MethodError {
    /// With this reason.
    pub fn new(reason: impl fmt::Display) -> Self {
        Self(reason.to_string())
    }

    /// Nothing if this is so.
    ///
    /// # Errors
    /// [`MethodError`] with the reason if it is not.
    pub fn unless(is_so: bool, reason: impl fmt::Display) -> Result<(), Self> {
        if is_so { Ok(()) } else { Err(Self::new(reason)) }
    }
}

impl fmt::Display for MethodError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for MethodError {}

/// Results by their questions: one search may answer several checks.
#[derive(Default)]
pub struct Cache(Vec<Box<dyn Any>>);

impl Cache {
    /// The result for `key`; if there is none, that of `find`, which is kept.
    ///
    /// # Errors
    /// Whatever `find` returns.
    #[expect(clippy::missing_panics_doc, reason = "it does not")]
    pub fn recall<K: PartialEq + 'static, V: 'static, E>(
        &mut self,
        key: K,
        find: impl FnOnce(&K) -> Result<V, E>,
    ) -> Result<&V, E> {
        let is_known =
            |entry: &Box<dyn Any>| entry.downcast_ref::<(K, V)>().is_some_and(|(known, _)| *known == key);
        let known = self.0.iter().position(is_known);
        let place = known.unwrap_or(self.0.len());
        if known.is_none() {
            let found = find(&key)?;
            self.0.push(Box::new((key, found)));
        }
        let entry = self.0[place].downcast_ref::<(K, V)>();
        Ok(entry.map(|(_, found)| found).expect("an entry of this type was found or made"))
    }
}

impl fmt::Debug for Cache {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Cache of {} answers", self.0.len())
    }
}

/// The answer of a method, or why it cannot begin.
pub type MethodResult = Result<Answer, MethodError>;

/// A method's surroundings.
pub struct Context<'a, 'w> {
    /// Results found before.
    pub cache: &'a mut Cache,
    /// Hears of searches, and may end them: the check is left open then.
    pub watch: Watch<'w>,
    /// The memory that searches over states may take. Where it does not suffice, the check is left open.
    pub memory: Memory<'a>,
}

/// A portion of a check that is divided: every so many-th part of it, from this one on.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub struct Portion {
    /// The number of its first part.
    pub number: usize,
    /// How many portions there are.
    pub of: usize,
}

impl Portion {
    /// All of a check.
    pub const WHOLE: Self = Self { number: 0, of: 1 };

    /// Those of these that it has.
    pub fn of<T>(self, all: impl IntoIterator<Item = T>) -> impl Iterator<Item = T> {
        all.into_iter().skip(self.number).step_by(self.of)
    }
}

/// Random runs of a rule.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct RandomRuns {
    /// How many.
    pub runs: u64,
    /// The seed of all of them.
    pub seed: u64,
    /// Most moves of each.
    pub most_moves: u32,
}

/// A way to decide a clause about rules of type `R`: a scheme's own, or a stranger's.
pub trait Method<R>: Sync {
    /// The engine's name.
    fn engine(&self) -> &'static str;

    /// The bound, in words that are made from the data that runs.
    fn bound(&self) -> String;

    /// The verdict when no counterexample is found within the bound.
    fn shows(&self) -> Verdict {
        Verdict::Holds
    }

    /// A name for the question that it asks an engine about `rule`, if another check may ask the same one: checks with
    /// the same name are decided one after the other, with one [`Cache`].
    fn family(&self, _: &R) -> Option<String> {
        None
    }

    /// Looks for a counterexample to `rule`.
    ///
    /// # Errors
    /// [`MethodError`] if it cannot begin.
    fn decide(&self, rule: &R, until: Until, context: &mut Context<'_, '_>) -> MethodResult;

    /// Into how many parts it can be divided, of which each is looked at by itself.
    fn portions(&self) -> usize {
        1
    }

    /// Looks for a counterexample to `rule` in a portion of the parts. [`Answer::merged`]
    /// makes one answer of those to all portions.
    ///
    /// # Errors
    /// [`MethodError`] if it cannot begin.
    fn decide_portion(
        &self,
        rule: &R,
        _: Portion,
        until: Until,
        context: &mut Context<'_, '_>,
    ) -> MethodResult {
        self.decide(rule, until, context)
    }

    /// Makes the choices of a counterexample to `rule` again.
    ///
    /// # Errors
    /// [`ScriptError`] if they are none.
    fn replay(&self, rule: &R, choices: &Choices) -> Result<RefutationPlay, ScriptError>;

    /// The answer about `rule` by random runs in place of all cases, up to a counterexample; `None` without such runs.
    ///
    /// # Errors
    /// [`MethodError`] if it cannot begin.
    fn hunt(&self, _: &R, _: &RandomRuns) -> Result<Option<Answer>, MethodError> {
        Ok(None)
    }

    /// The counterexample to `rule` that these choices make, made as short as it can be from its start within `limits`,
    /// and whether it is known that none from there is shorter; `None` if the method cannot tell.
    ///
    /// # Errors
    /// [`MethodError`] if it cannot begin, or these choices make none.
    fn shorten(&self, _: &R, _: &Choices, _: Limits<'_>) -> Result<Option<(Choices, bool)>, MethodError> {
        Ok(None)
    }

    /// A file for Rocq with the theorem that the clause holds of `rule` beyond every bound; `None` without one.
    ///
    /// # Errors
    /// [`MethodError`] if it cannot begin, or if the file would be too large.
    fn certificate(&self, _: &R) -> Option<Result<String, MethodError>> {
        None
    }

    /// All systems whose states or runs it searches for `rule`: a section of a certificate for each.
    ///
    /// # Errors
    /// [`MethodError`] if it cannot begin, or searches something else.
    fn systems(&self, _: &R) -> Result<Systems, MethodError> {
        let reason = format_args!("the engine {} searches neither all states nor all layouts", self.engine());
        Err(MethodError::new(reason))
    }

    /// The counterexample to `rule` that these choices make, written down for a judge; `None` if no judge reads it.
    fn case(&self, _: &R, _: &Choices) -> Option<Box<dyn AnyCase>> {
        None
    }

    /// The counterexample to `rule` that these choices make, as a run of its scheme; `None` if it is none.
    fn scripted(&self, _: &R, _: &Choices) -> Option<ScriptedRun> {
        None
    }

    /// The size of the counterexample to `rule` that these choices make, if smaller ones can be asked for.
    fn size(&self, _: &R, _: &Choices) -> Option<Size> {
        None
    }

    /// The smallest counterexample to `rule` over areas, barriers, robots and starts, or over networks, if it can be
    /// asked for.
    ///
    /// # Errors
    /// [`MethodError`] if it cannot begin.
    fn smallest(&self, _: &R) -> Result<Option<DrawnCertificate>, MethodError> {
        Ok(None)
    }
}

/// Systems whose states or runs are all searched.
pub type Systems = Vec<Box<dyn AnySystem>>;

/// The bound of a body in words, made from the numbers that its choices range over.
pub type Range = fn() -> String;

/// The class of a counterexample, in words, and its moves.
pub type Size = (String, usize);

/// The smallest counterexample, drawn, and all that is smaller, each class in words.
pub type DrawnCertificate = Certificate<String, String>;

/// Every state of a system, in every order: what happens is found by an engine, and what is demanded stands in the
/// system.
pub struct EveryState<R: 'static, S: System> {
    /// The bound in words.
    pub range: Range,
    /// The system in which all follow a rule.
    pub system: fn(&R) -> S,
    /// Where its runs begin.
    pub starts: fn(&S) -> Vec<S::State>,
    /// Steps between states at which the question is left open.
    pub most_steps: u32,
    /// The situations that must occur.
    pub covers: &'static [&'static str],
    /// A step, in words.
    pub tell: fn(before: &S::State, step: &Step<S>) -> String,
}

impl<R, S: System<Demand = &'static str>> EveryState<R, S> {
    /// The events in `run` of `system`, in lines.
    fn story(&self, system: &S, run: &states::Run<&'static str>) -> Depiction {
        let Some(start) = (self.starts)(system).into_iter().nth(run.start) else {
            return Depiction::Choices;
        };
        let lines = run.played(system, start).map(|(before, step)| (self.tell)(&before, &step) + "\n");
        Depiction::Story(lines.collect())
    }
}

impl<R, S> Method<R> for EveryState<R, S>
where
    R: Sync,
    S: System<Demand = &'static str> + Sync + 'static,
    S::State: Send,
{
    fn engine(&self) -> &'static str {
        "states"
    }

    fn bound(&self) -> String {
        (self.range)()
    }

    /// The choices are the number of the start, and those of the steps.
    fn decide(&self, rule: &R, _: Until, context: &mut Context<'_, '_>) -> MethodResult {
        let system = (self.system)(rule);
        states::repeats(&system, (self.starts)(&system)).map_err(MethodError::new)?;
        let limits = Limits { memory: context.memory, ..Limits::steps(self.most_steps.into()) };
        let found = states::search(&system, (self.starts)(&system), limits);
        let evidence = found.broken.first().map(|run| Evidence {
            choices: run.choices(),
            demand: run.demand,
            seen: self.story(&system, run),
        });
        Ok(Answer::of_states(evidence, &found, self.covers.iter().copied(), self.shows()))
    }

    fn systems(&self, rule: &R) -> Result<Systems, MethodError> {
        let system = (self.system)(rule);
        states::repeats(&system, (self.starts)(&system)).map_err(MethodError::new)?;
        Ok(vec![Box::new(StatesModel::new(system, self.starts))])
    }

    fn replay(&self, rule: &R, choices: &Choices) -> Result<RefutationPlay, ScriptError> {
        let system = (self.system)(rule);
        let mut script = Script::new(choices);
        let mut starts = (self.starts)(&system);
        let number = script.choose(starts.len())?;
        let (of, run) = script.play(&system, (number, starts.swap_remove(number)), |_| true)?;
        let seen = self.story(&system, &run);
        Ok(RefutationPlay { of, evidence: Evidence { choices: choices.clone(), demand: run.demand, seen } })
    }
}

//! Clauses. A clause is registered once, in the room of its scheme: its id and sentence, and the checks that decide it,
//! each with the rule it is about, the method, the expected verdict and the mutants that must be rejected. A check is
//! generic over the type of its rule, so that a stranger's rule is checked as ours are.

use std::fmt;

use crate::decide::{Answer, Cache, Context, Evidence, Method, MethodError, RefutationPlay, Verdict};
use crate::engine::states::MemoryLimit;
use crate::engine::tree::Watch;
use crate::engine::{Choices, ScriptError, Until};
use crate::judge::AnyCase;

/// A rule with the name that the ledger prints: "published", "repaired", "robust", or what is wrong with it.
#[derive(Clone, Copy, Debug)]
pub struct NamedRule<R> {
    /// The name.
    pub name: &'static str,
    /// The rule.
    pub rule: R,
}

impl<R> NamedRule<R> {
    /// `rule` under this name.
    pub const fn new(name: &'static str, rule: R) -> Self {
        Self { name, rule }
    }
}

/// One way to decide a clause about rules of type `R`.
pub struct Check<R: 'static> {
    /// The rule it is about.
    pub about: NamedRule<R>,
    /// How it is decided.
    pub method: &'static dyn Method<R>,
    /// The verdict that must come out.
    pub expected: Verdict,
    /// Rules for which the check must fail.
    pub mutants: &'static [NamedRule<R>],
}

impl<R> Check<R> {
    /// A check of `about`.
    pub const fn new(
        about: NamedRule<R>,
        method: &'static dyn Method<R>,
        expected: Verdict,
        mutants: &'static [NamedRule<R>],
    ) -> Self {
        Self { about, method, expected, mutants }
    }
}

/// A clause.
#[derive(Debug)]
pub struct Clause {
    /// Its heading.
    pub id: &'static str,
    /// Its MUST sentence, word for word.
    pub sentence: &'static str,
    /// The checks that decide it.
    pub checks: &'static [&'static dyn AnyCheck],
}

/// The outcome of a check.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Decision {
    /// Its verdict.
    pub verdict: Verdict,
    /// Cases of a body that met its assumptions, runs of a search, or states.
    pub cases: u64,
    /// Cases that were given up undecided; they are not among the others.
    pub given_up: u64,
    /// The counterexample, if it is refuted.
    pub counterexample: Option<Evidence>,
    /// Mutants that were rejected.
    pub killed: Vec<&'static str>,
    /// Mutants that were not: the check is too weak.
    pub survived: Vec<&'static str>,
}

impl Decision {
    /// The decision by a check's own rule, no mutant looked at yet.
    pub fn of(answer: Answer) -> Self {
        let Answer { verdict, cases, given_up, counterexample } = answer;
        Self { verdict, cases, given_up, counterexample, killed: Vec::new(), survived: Vec::new() }
    }

    /// Adds what came of a mutant.
    pub fn add(&mut self, mutant: &'static str, verdict: Verdict) {
        if verdict == Verdict::Refuted { &mut self.killed } else { &mut self.survived }.push(mutant);
    }

    /// Whether `check` came out as it is registered.
    pub fn is_as_registered(&self, check: &dyn AnyCheck) -> bool {
        self.verdict == check.expected() && self.survived.is_empty()
    }
}

/// A check, whatever the type of its rule.
pub trait AnyCheck: Sync {
    /// The name of the rule it is about.
    fn rule(&self) -> &'static str;

    /// The engine's name.
    fn engine(&self) -> &'static str;

    /// The bound, in words.
    fn bound(&self) -> String;

    /// The verdict when no counterexample is found within the bound.
    fn shows(&self) -> Verdict;

    /// The verdict that must come out.
    fn expected(&self) -> Verdict;

    /// The names of its mutants.
    fn mutants(&self) -> Vec<&'static str>;

    /// A name for what it shares with the checks of the same name: see [`Method::family`].
    fn family(&self) -> Option<String>;

    /// As [`AnyCheck::family`], for the mutant with this number.
    fn mutant_family(&self, number: usize) -> Option<String>;

    /// The answer about its own rule.
    ///
    /// # Errors
    /// [`MethodError`] if its method cannot begin.
    fn decide_own(&self, desk: &mut Context<'_, '_>) -> Result<Answer, MethodError>;

    /// The verdict on the mutant with this number; open if there is none. One violation is enough, unless the decision
    /// is to tell of more.
    ///
    /// # Errors
    /// [`MethodError`] if its method cannot begin.
    fn decide_mutant(
        &self,
        number: usize,
        until: Until,
        desk: &mut Context<'_, '_>,
    ) -> Result<Verdict, MethodError>;

    /// Decides it, and whether its mutants are rejected, one after the other. `watch` hears of searches only; a search
    /// that it ends leaves the check open.
    ///
    /// # Errors
    /// [`MethodError`] if its method cannot begin.
    fn decide(&self, memory: &mut Cache, watch: Watch<'_>) -> Result<Decision, MethodError> {
        let mut desk = Context { memory, watch, room: MemoryLimit::any() };
        let mut decision = Decision::of(self.decide_own(&mut desk)?);
        for (number, name) in self.mutants().into_iter().enumerate() {
            decision.add(name, self.decide_mutant(number, Until::Violation, &mut desk)?);
        }
        Ok(decision)
    }

    /// Plays `choices` by the rule of the check.
    ///
    /// # Errors
    /// [`ScriptError`] if they are no refutation.
    fn replay(&self, choices: &Choices) -> Result<RefutationPlay, ScriptError>;

    /// The counterexample that these choices make, written down for a judge; `None` if no judge reads it.
    fn case(&self, choices: &Choices) -> Option<Box<dyn AnyCase>>;
}

impl<R: Sync> AnyCheck for Check<R> {
    fn rule(&self) -> &'static str {
        self.about.name
    }

    fn engine(&self) -> &'static str {
        self.method.engine()
    }

    fn bound(&self) -> String {
        self.method.bound()
    }

    fn shows(&self) -> Verdict {
        self.method.shows()
    }

    fn expected(&self) -> Verdict {
        self.expected
    }

    fn mutants(&self) -> Vec<&'static str> {
        self.mutants.iter().map(|mutant| mutant.name).collect()
    }

    fn family(&self) -> Option<String> {
        self.method.family(&self.about.rule)
    }

    fn mutant_family(&self, number: usize) -> Option<String> {
        self.method.family(&self.mutants.get(number)?.rule)
    }

    fn decide_own(&self, desk: &mut Context<'_, '_>) -> Result<Answer, MethodError> {
        self.method.decide(&self.about.rule, Until::Exhausted, desk)
    }

    fn decide_mutant(
        &self,
        number: usize,
        until: Until,
        desk: &mut Context<'_, '_>,
    ) -> Result<Verdict, MethodError> {
        let Some(mutant) = self.mutants.get(number) else { return Ok(Verdict::Open) };
        Ok(self.method.decide(&mutant.rule, until, desk)?.verdict)
    }

    fn replay(&self, choices: &Choices) -> Result<RefutationPlay, ScriptError> {
        self.method.replay(&self.about.rule, choices)
    }

    fn case(&self, choices: &Choices) -> Option<Box<dyn AnyCase>> {
        self.method.case(&self.about.rule, choices)
    }
}

impl fmt::Debug for dyn AnyCheck {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} by {}: {}", self.rule(), self.engine(), self.bound())
    }
}

//! Clauses. A clause is registered once, in the room of its scheme: its id and sentence, and the checks that decide it,
//! each with the rule it is about, the method, the expected verdict and the mutants that must be rejected. A check is
//! generic over the type of its rule, so that a stranger's rule is checked as ours are.

use std::fmt;

use crate::ambiguity::Paper;
use crate::decide::{
    Answer, Cache, Context, DrawnCertificate, Evidence, Method, MethodError, MethodResult, Portion,
    RandomRuns, RefutationPlay, Size, Systems, Verdict,
};
use crate::engine::states::{Limits, MemoryLimit};
use crate::engine::tree::Watch;
use crate::engine::{Choices, ScriptError, Until};
use crate::judge::AnyCase;
use crate::run::ScriptedRun;

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

/// The rule as another reading of the paper's words has it.
#[derive(Clone, Copy, Debug)]
pub struct Reading<R> {
    /// The rule, and what sets it apart.
    pub rule: NamedRule<R>,
    /// The verdict that must come out under it.
    pub expected: Verdict,
}

impl<R> Reading<R> {
    /// `rule` under this name, for which `expected` must come out.
    pub const fn new(name: &'static str, rule: R, expected: Verdict) -> Self {
        Self { rule: NamedRule::new(name, rule), expected }
    }
}

/// The readings that these rules are, with the verdict that must come out under each.
pub const fn readings<R: Copy, const N: usize>(
    rules: [(&'static str, R); N],
    expected: [Verdict; N],
) -> [Reading<R>; N] {
    let mut readings = [Reading::new(rules[0].0, rules[0].1, expected[0]); N];
    let mut number = 1;
    while number < N {
        readings[number] = Reading::new(rules[number].0, rules[number].1, expected[number]);
        number += 1;
    }
    readings
}

/// The readings that these rules are, of which those with these numbers hold and all others are refuted.
pub const fn holding<R: Copy, const N: usize, const HELD: usize>(
    rules: [(&'static str, R); N],
    numbers: [usize; HELD],
) -> [Reading<R>; N] {
    let mut all = readings(rules, [Verdict::Refuted; N]);
    let mut place = 0;
    while place < HELD {
        all[numbers[place]].expected = Verdict::Holds;
        place += 1;
    }
    all
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
    /// Other readings of the rule, decided in the same way.
    pub readings: &'static [Reading<R>],
    /// Why the check is there although it is refuted, if not as a paper's sentence.
    pub reason: Option<&'static str>,
    /// The ambiguities that these readings are about, if they stand as data.
    pub paper: Option<&'static Paper>,
    /// How its counterexamples are written down for a judge, where its method does not know.
    pub case: Option<Case<R>>,
}

/// The counterexample to a rule that choices make, written down for a judge; `None` if they make none.
pub type Case<R> = fn(&R, &Choices) -> Option<Box<dyn AnyCase>>;

impl<R: Copy> Check<R> {
    /// The check, whose counterexamples `case` writes down for a judge.
    #[must_use]
    pub const fn judged(self, case: Case<R>) -> Self {
        Self { case: Some(case), ..self }
    }

    /// The check, also under these other readings of its rule.
    #[must_use]
    pub const fn under(self, readings: &'static [Reading<R>]) -> Self {
        Self { readings, ..self }
    }

    /// The check, which is refuted for this reason, in a few words, and not as a paper's sentence.
    #[must_use]
    pub const fn because(self, reason: &'static str) -> Self {
        Self { reason: Some(reason), ..self }
    }

    /// The check, whose readings take interpretations of this paper.
    #[must_use]
    pub const fn of(self, paper: &'static Paper) -> Self {
        Self { paper: Some(paper), ..self }
    }
}

impl<R> Check<R> {
    /// A check of `about`.
    pub const fn new(
        about: NamedRule<R>,
        method: &'static dyn Method<R>,
        expected: Verdict,
        mutants: &'static [NamedRule<R>],
    ) -> Self {
        Self { about, method, expected, mutants, readings: &[], reason: None, paper: None, case: None }
    }

    /// A check that holds.
    pub const fn holds(
        about: NamedRule<R>,
        method: &'static dyn Method<R>,
        mutants: &'static [NamedRule<R>],
    ) -> Self {
        Self::new(about, method, Verdict::Holds, mutants)
    }

    /// A check that is sampled, and not refuted.
    pub const fn unrefuted(
        about: NamedRule<R>,
        method: &'static dyn Method<R>,
        mutants: &'static [NamedRule<R>],
    ) -> Self {
        Self::new(about, method, Verdict::Unrefuted, mutants)
    }

    /// A check that is refuted.
    pub const fn refuted(about: NamedRule<R>, method: &'static dyn Method<R>) -> Self {
        Self::new(about, method, Verdict::Refuted, &[])
    }

    /// Its own rule, or that of the variant with this number: of a mutant, or of a reading.
    fn rule_of(&self, variant: Option<usize>) -> Option<&R> {
        let Some(number) = variant else { return Some(&self.about.rule) };
        let readings = self.readings.iter().map(|reading| &reading.rule);
        self.mutants.iter().chain(readings).nth(number).map(|variant| &variant.rule)
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

impl Clause {
    /// The word before the number of its id, which the clauses of a scheme have in common.
    pub fn scheme(&self) -> &'static str {
        self.id.split_once('-').map_or(self.id, |(scheme, _)| scheme)
    }
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
    /// The answers under the other readings of the rule, in their order.
    pub readings: Vec<Answer>,
    /// Whatever else was found, in words.
    pub note: Option<String>,
}

impl Decision {
    /// The decision by a check's own rule, no variant looked at yet.
    pub fn of(answer: Answer) -> Self {
        let Answer { verdict, cases, given_up, counterexample, note } = answer;
        let (killed, survived, readings) = Default::default();
        Self { verdict, cases, given_up, counterexample, killed, survived, readings, note }
    }

    /// The decision that `answer` makes about a check's own rule, and about the variants by their numbers.
    fn made(
        variants: Vec<Variant>,
        answer: &mut dyn FnMut(Option<usize>, Until) -> MethodResult,
    ) -> Result<Self, MethodError> {
        let mut decision = Self::of(answer(None, Until::Exhausted)?);
        for (number, variant) in variants.into_iter().enumerate() {
            decision.add(variant, answer(Some(number), Until::Violation)?);
        }
        Ok(decision)
    }

    /// Adds the answer about a variant.
    pub fn add(&mut self, variant: Variant, answer: Answer) {
        match (variant, answer.verdict) {
            (Variant::Mutant(name), Verdict::Refuted) => self.killed.push(name),
            (Variant::Mutant(name), _) => self.survived.push(name),
            (Variant::Reading { .. }, _) => self.readings.push(answer),
        }
    }

    /// Whether `check` came out as it is registered.
    pub fn is_as_registered(&self, check: &dyn AnyCheck) -> bool {
        let readings =
            check.variants().into_iter().filter_map(Variant::reading).map(|(_, expected)| expected);
        self.verdict == check.expected()
            && self.survived.is_empty()
            && readings.eq(self.readings.iter().map(|answer| answer.verdict))
    }
}

/// A rule beside that of a check, decided in the same way.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub enum Variant {
    /// One for which the check must fail, by its name.
    Mutant(&'static str),
    /// Another reading of the rule.
    Reading {
        /// The name of its difference from the rule.
        name: &'static str,
        /// The verdict that must come out.
        expected: Verdict,
    },
}

impl Variant {
    /// The name and the registered verdict of a reading.
    pub fn reading(self) -> Option<(&'static str, Verdict)> {
        match self {
            Self::Mutant(_) => None,
            Self::Reading { name, expected } => Some((name, expected)),
        }
    }

    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Mutant(name) | Self::Reading { name, .. } => name,
        }
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

    /// Its mutants, and then the other readings of its rule.
    fn variants(&self) -> Vec<Variant>;

    /// Why it is there although it is refuted, if not as a paper's sentence.
    fn reason(&self) -> Option<&'static str>;

    /// The ambiguities that these readings are about, if they stand as data.
    fn paper(&self) -> Option<&'static Paper>;

    /// A name for what it shares with the checks of the same name, about its own rule or about the variant with this
    /// number: see [`Method::family`].
    fn family(&self, variant: Option<usize>) -> Option<String>;

    /// The answer about its own rule, or about the variant with this number; open if there is none.
    ///
    /// # Errors
    /// [`MethodError`] if its method cannot begin.
    fn decide_rule(
        &self,
        variant: Option<usize>,
        until: Until,
        context: &mut Context<'_, '_>,
    ) -> MethodResult;

    /// Into how many parts it can be divided: see [`Method::portions`].
    fn portions(&self) -> usize;

    /// The answer about its own rule, or about the variant with this number, in a portion of the parts: see
    /// [`Method::decide_portion`].
    ///
    /// # Errors
    /// [`MethodError`] if its method cannot begin.
    fn decide_portion(
        &self,
        variant: Option<usize>,
        portion: Portion,
        context: &mut Context<'_, '_>,
    ) -> MethodResult;

    /// Decides it, and its variants, one after the other. `watch` hears of searches only; a search
    /// that it ends leaves the check open.
    ///
    /// # Errors
    /// [`MethodError`] if its method cannot begin.
    fn decide(&self, cache: &mut Cache, watch: Watch<'_>) -> Result<Decision, MethodError> {
        let mut context = Context { cache, watch, memory: MemoryLimit::any() };
        Decision::made(self.variants(), &mut |variant, until| self.decide_rule(variant, until, &mut context))
    }

    /// Plays `choices` by the rule of the check.
    ///
    /// # Errors
    /// [`ScriptError`] if they are no refutation.
    fn replay(&self, choices: &Choices) -> Result<RefutationPlay, ScriptError>;

    /// The answer about its own rule by random runs: see [`Method::hunt`].
    ///
    /// # Errors
    /// [`MethodError`] if its method cannot begin.
    fn hunt(&self, runs: &RandomRuns) -> Result<Option<Answer>, MethodError>;

    /// A shorter counterexample to its own rule: see [`Method::shorten`].
    ///
    /// # Errors
    /// [`MethodError`] if its method cannot begin, or these choices make none.
    fn shorten(&self, choices: &Choices, limits: Limits<'_>) -> Result<Option<(Choices, bool)>, MethodError>;

    /// A file that Rocq checks: see [`Method::certificate`].
    ///
    /// # Errors
    /// [`MethodError`] if its method cannot begin, or if the file would be too large.
    fn certificate(&self) -> Option<Result<String, MethodError>>;

    /// The systems of a certificate: see [`Method::systems`].
    ///
    /// # Errors
    /// [`MethodError`] if its method cannot begin, or searches something else.
    fn systems(&self) -> Result<Systems, MethodError>;

    /// The counterexample that these choices make, written down for a judge; `None` if no judge reads it.
    fn case(&self, choices: &Choices) -> Option<Box<dyn AnyCase>>;

    /// The counterexample that these choices make, as a run of its scheme: see [`Method::scripted`].
    fn scripted(&self, choices: &Choices) -> Option<ScriptedRun>;

    /// The size of the counterexample that these choices make: see [`Method::size`].
    fn size(&self, choices: &Choices) -> Option<Size>;

    /// The smallest counterexample to its own rule: see [`Method::smallest`].
    ///
    /// # Errors
    /// [`MethodError`] if it cannot begin.
    fn smallest(&self) -> Result<Option<DrawnCertificate>, MethodError>;
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

    fn variants(&self) -> Vec<Variant> {
        let mutants = self.mutants.iter().map(|mutant| Variant::Mutant(mutant.name));
        let reading =
            |&Reading { ref rule, expected }: &Reading<R>| Variant::Reading { name: rule.name, expected };
        mutants.chain(self.readings.iter().map(reading)).collect()
    }

    fn reason(&self) -> Option<&'static str> {
        self.reason
    }

    fn paper(&self) -> Option<&'static Paper> {
        self.paper
    }

    fn family(&self, variant: Option<usize>) -> Option<String> {
        self.method.family(self.rule_of(variant)?)
    }

    fn decide_rule(
        &self,
        variant: Option<usize>,
        until: Until,
        context: &mut Context<'_, '_>,
    ) -> MethodResult {
        let Some(rule) = self.rule_of(variant) else { return Ok(Answer::open()) };
        self.method.decide(rule, until, context)
    }

    fn portions(&self) -> usize {
        self.method.portions()
    }

    fn decide_portion(
        &self,
        variant: Option<usize>,
        portion: Portion,
        context: &mut Context<'_, '_>,
    ) -> MethodResult {
        let Some(rule) = self.rule_of(variant) else { return Ok(Answer::open()) };
        let until = if variant.is_some() { Until::Violation } else { Until::Exhausted };
        self.method.decide_portion(rule, portion, until, context)
    }

    fn replay(&self, choices: &Choices) -> Result<RefutationPlay, ScriptError> {
        self.method.replay(&self.about.rule, choices)
    }

    fn hunt(&self, runs: &RandomRuns) -> Result<Option<Answer>, MethodError> {
        self.method.hunt(&self.about.rule, runs)
    }

    fn shorten(&self, choices: &Choices, limits: Limits<'_>) -> Result<Option<(Choices, bool)>, MethodError> {
        self.method.shorten(&self.about.rule, choices, limits)
    }

    fn certificate(&self) -> Option<Result<String, MethodError>> {
        self.method.certificate(&self.about.rule)
    }

    fn systems(&self) -> Result<Systems, MethodError> {
        self.method.systems(&self.about.rule)
    }

    fn case(&self, choices: &Choices) -> Option<Box<dyn AnyCase>> {
        let rule = &self.about.rule;
        self.case.map_or_else(|| self.method.case(rule, choices), |case| case(rule, choices))
    }

    fn scripted(&self, choices: &Choices) -> Option<ScriptedRun> {
        self.method.scripted(&self.about.rule, choices)
    }

    fn size(&self, choices: &Choices) -> Option<Size> {
        self.method.size(&self.about.rule, choices)
    }

    fn smallest(&self) -> Result<Option<DrawnCertificate>, MethodError> {
        self.method.smallest(&self.about.rule)
    }
}

impl fmt::Debug for dyn AnyCheck + '_ {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} by {}: {}", self.rule(), self.engine(), self.bound())
    }
}

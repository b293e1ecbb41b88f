//! Checks that keep what they answer, so that what is decided is told where a signal ends the rest.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Instant;

use tautline_proofs::ambiguity::Paper;
use tautline_proofs::clause::{AnyCheck, Clause, Decision, Variant};
use tautline_proofs::decide::{
    Answer, Context, DrawnCertificate, MethodError, MethodResult, Portion, RandomRuns, RefutationPlay, Size,
    Systems, Verdict,
};
use tautline_proofs::engine::states::Limits;
use tautline_proofs::engine::{Choices, ScriptError, Until};
use tautline_proofs::judge::AnyCase;
use tautline_proofs::ledger::{self, Hear, Row};
use tautline_proofs::run::ScriptedRun;

use crate::interrupt;

/// The answers so far and the seconds that each took, by the place of the check, about its own rule or a variant.
type Answers = Arc<Mutex<BTreeMap<(usize, Option<usize>), (Answer, f64)>>>;

/// A check that keeps its answers.
struct RecordingCheck {
    check: &'static dyn AnyCheck,
    place: usize,
    answers: Answers,
}

/// Methods that are those of the check.
macro_rules! as_the_check {
    ($(fn $name:ident($($value:ident: $of:ty),*) -> $made:ty;)+) => {
        $(fn $name(&self, $($value: $of),*) -> $made {
            self.check.$name($($value),*)
        })+
    };
}

impl AnyCheck for RecordingCheck {
    fn decide_rule(
        &self,
        variant: Option<usize>,
        until: Until,
        context: &mut Context<'_, '_>,
    ) -> MethodResult {
        let start = Instant::now();
        let answer = self.check.decide_rule(variant, until, context)?;
        // A search that a signal has ended has decided nothing.
        if !interrupt::is_requested() {
            let mut answers = self.answers.lock().unwrap_or_else(PoisonError::into_inner);
            answers.insert((self.place, variant), (answer.clone(), start.elapsed().as_secs_f64()));
        }
        Ok(answer)
    }

    as_the_check! {
        fn rule() -> &'static str;
        fn engine() -> &'static str;
        fn bound() -> String;
        fn shows() -> Verdict;
        fn expected() -> Verdict;
        fn variants() -> Vec<Variant>;
        fn reason() -> Option<&'static str>;
        fn paper() -> Option<&'static Paper>;
        fn family(variant: Option<usize>) -> Option<String>;
        fn portions() -> usize;
        fn decide_portion(variant: Option<usize>, portion: Portion, context: &mut Context<'_, '_>) -> MethodResult;
        fn replay(choices: &Choices) -> Result<RefutationPlay, ScriptError>;
        fn hunt(runs: &RandomRuns) -> Result<Option<Answer>, MethodError>;
        fn shorten(choices: &Choices, limits: Limits<'_>) -> Result<Option<(Choices, bool)>, MethodError>;
        fn certificate() -> Option<Result<String, MethodError>>;
        fn systems() -> Result<Systems, MethodError>;
        fn case(choices: &Choices) -> Option<Box<dyn AnyCase>>;
        fn scripted(choices: &Choices) -> Option<ScriptedRun>;
        fn size(choices: &Choices) -> Option<Size>;
        fn smallest() -> Result<Option<DrawnCertificate>, MethodError>;
    }
}

/// The rows of `checks`; where a signal comes first, those that are decided by then, with all their variants.
///
/// # Errors
/// [`MethodError`] if a method cannot begin.
pub(super) fn decide(
    checks: &[(&'static Clause, usize)],
    limits: &ledger::Limits,
    hear: &Hear,
) -> Result<Vec<Row>, MethodError> {
    let answers = Answers::default();
    let keeping = |(place, &(clause, number)): (usize, &(&'static Clause, usize))| {
        let keeping = RecordingCheck { check: clause.checks[number], place, answers: Arc::clone(&answers) };
        // As long as the process: threads that a signal leaves behind go on with it.
        let check: &'static dyn AnyCheck = Box::leak(Box::new(keeping));
        let &Clause { id, sentence, .. } = clause;
        let checks = vec![check; number + 1].leak();
        let clause: &'static Clause = Box::leak(Box::new(Clause { id, sentence, checks }));
        (clause, number)
    };
    let kept: Vec<_> = checks.iter().enumerate().map(keeping).collect();
    let (limits, hear) = (limits.clone(), Arc::clone(hear));
    let rows = interrupt::unless_requested(move || ledger::decide(&kept, &limits, &hear));
    let Some(rows) = rows.transpose()? else { return Ok(decided(checks, &answers)) };
    let own = |(row, &(clause, number)): (Row, &(&'static Clause, usize))| Row {
        clause,
        check: clause.checks[number],
        ..row
    };
    Ok(rows.into_iter().zip(checks).map(own).collect())
}

/// The rows of checks that are answered with all their variants.
fn decided(checks: &[(&'static Clause, usize)], answers: &Answers) -> Vec<Row> {
    let answers = answers.lock().unwrap_or_else(PoisonError::into_inner);
    let row = |(place, &(clause, number)): (usize, &(&'static Clause, usize))| {
        let check = clause.checks[number];
        let (answer, mut seconds) = answers.get(&(place, None))?.clone();
        let mut decision = Decision::of(answer);
        for (variant, of) in check.variants().into_iter().enumerate() {
            let (answer, took) = answers.get(&(place, Some(variant)))?.clone();
            decision.add(of, answer);
            seconds += took;
        }
        Some(Row { clause, number, check, decision, undecided: None, seconds })
    };
    checks.iter().enumerate().filter_map(row).collect()
}

//! Bodies: one case of a clause, made by the choices that an oracle answers, all of them or many at random.

use tautline_kernel::choice::Oracle;

use super::{Answer, Context, Depiction, Evidence, Method, MethodResult, Range, RefutationPlay, Verdict};
use crate::engine::{self, Choices, Outcome, Replay, ScriptError, Stop, Until};

/// A body: one case of a clause about `rule`, made by the choices that the oracle answers.
pub type Body<R> = fn(rule: &R, oracle: &mut dyn Oracle) -> Outcome;

/// Every answer to every choice of a body.
pub struct EveryAnswer<R> {
    /// The body.
    pub body: Body<R>,
    /// The range of its choices.
    pub range: Range,
    /// The situations that must occur.
    pub covers: &'static [&'static str],
}

impl<R> EveryAnswer<R> {
    /// Every answer to every choice of `body`.
    pub const fn new(body: Body<R>, range: Range, covers: &'static [&'static str]) -> Self {
        Self { body, range, covers }
    }
}

/// Many random answers to the choices of a body.
pub struct RandomAnswers<R> {
    /// The body.
    pub body: Body<R>,
    /// How many times.
    pub runs: u64,
    /// The range of its choices, of which so many are drawn.
    pub range: Range,
    /// The situations that must occur.
    pub covers: &'static [&'static str],
}

impl<R> RandomAnswers<R> {
    /// The choices of `body`, drawn so many times.
    pub const fn new(body: Body<R>, runs: u64, range: Range, covers: &'static [&'static str]) -> Self {
        Self { body, runs, range, covers }
    }
}

/// The seed of every sampled check.
const SEED: u64 = 0;

impl<R: Sync> Method<R> for EveryAnswer<R> {
    fn engine(&self) -> &'static str {
        "exhaustive"
    }

    fn bound(&self) -> String {
        (self.range)()
    }

    fn decide(&self, rule: &R, _: Until, _: &mut Context<'_, '_>) -> MethodResult {
        let tally = engine::exhaust(|oracle| (self.body)(rule, oracle));
        Ok(Answer::of_tally(tally, self.covers, self.shows()))
    }

    fn replay(&self, rule: &R, choices: &Choices) -> Result<RefutationPlay, ScriptError> {
        replay(&mut |oracle| (self.body)(rule, oracle), choices)
    }
}

impl<R: Sync> Method<R> for RandomAnswers<R> {
    fn engine(&self) -> &'static str {
        "sampled"
    }

    fn bound(&self) -> String {
        format!("{} {}", self.runs, (self.range)())
    }

    fn shows(&self) -> Verdict {
        Verdict::Unrefuted
    }

    fn decide(&self, rule: &R, _: Until, _: &mut Context<'_, '_>) -> MethodResult {
        let tally = engine::sample(self.runs, SEED, |oracle| (self.body)(rule, oracle));
        Ok(Answer::of_tally(tally, self.covers, self.shows()))
    }

    fn replay(&self, rule: &R, choices: &Choices) -> Result<RefutationPlay, ScriptError> {
        replay(&mut |oracle| (self.body)(rule, oracle), choices)
    }
}

/// Makes the choices of a violation of a body again.
fn replay(
    body: &mut dyn FnMut(&mut dyn Oracle) -> Outcome,
    choices: &Choices,
) -> Result<RefutationPlay, ScriptError> {
    let answers: Vec<u32> = choices.all().collect();
    let mut replay = Replay::new(&answers);
    let outcome = body(&mut replay);
    let of = replay.asked().to_vec();
    let mismatch = (0..).zip(of.iter().zip(&answers)).find(|&(_, (of, answer))| answer >= of);
    if let Some((at, (&of, _))) = mismatch {
        return Err(ScriptError::None { at, of });
    }
    let Err(Stop::Violated(demand)) = outcome else { return Err(ScriptError::Unbroken) };
    if of.len() < answers.len() {
        return Err(ScriptError::Over { at: of.len() });
    }
    if !replay.matches() {
        return Err(ScriptError::Unbroken);
    }
    Ok(RefutationPlay {
        of,
        evidence: Evidence { choices: choices.clone(), demand, seen: Depiction::Choices },
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::decide::Cache;
    use crate::engine::states::MemoryLimit;
    use crate::engine::tree::unwatched;

    /// A rule that ends or goes on for ever, whatever is asked of it.
    fn ends(ends: &bool, oracle: &mut dyn Oracle) -> Outcome {
        if oracle.flip() || *ends { Ok("an end") } else { Err(Stop::GivenUp) }
    }

    fn range() -> String {
        "either way".to_owned()
    }

    #[test]
    fn what_never_ends_leaves_an_exhaustive_check_open_and_is_counted() {
        let (cache, watch) = (&mut Cache::default(), &mut unwatched);
        let mut context = Context { cache, watch, memory: MemoryLimit::any() };
        let method = EveryAnswer { body: ends, range, covers: &["an end"] };
        let mut found = |rule| {
            let answer = method.decide(&rule, Until::Exhausted, &mut context).expect("a body can be decided");
            (answer.verdict, answer.cases, answer.given_up)
        };
        assert_eq!(found(true), (Verdict::Holds, 2, 0));
        assert_eq!(found(false), (Verdict::Open, 1, 1));
    }
}

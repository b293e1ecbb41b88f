//! A check in portions, each of which is decided by itself.

use super::{Answer, Verdict};

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

impl Answer {
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

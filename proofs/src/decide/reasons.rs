//! Why a check is open: nothing was looked at, a search was cut short, or a situation that must occur never did.

use super::{Answer, Choices, Depiction, Evidence, Verdict};
use crate::engine::Tally;
use crate::engine::states::Findings;
use crate::plural::counted;

impl Answer {
    /// The answer to a question without a start.
    pub fn startless() -> Self {
        Self { note: Some("there is no start".to_owned()), ..Self::open() }
    }

    /// The answer of a search over states that is to show `shown` and to meet each of `covers`.
    pub fn of_states<D>(
        counterexample: Option<Evidence>,
        found: &Findings<D>,
        covers: impl IntoIterator<Item = &'static str>,
        shown: Verdict,
    ) -> Self {
        if found.states == 0 && found.is_whole {
            return Self::startless();
        }
        let answer = Self::new(counterexample, found.is_whole, shown, found.states);
        if !found.is_whole && answer.verdict == Verdict::Open {
            return Self { note: Some(cut_short(found.states)), ..answer };
        }
        answer.covering(covers, &found.covered)
    }

    /// This answer, which is open if it is no refutation and one of `covers` never occurred; the note says which.
    #[must_use]
    pub fn covering<'a>(self, covers: impl IntoIterator<Item = &'a str>, covered: &[&str]) -> Self {
        let never: Vec<&str> = covers.into_iter().filter(|situation| !covered.contains(situation)).collect();
        match self.verdict {
            Verdict::Holds | Verdict::Unrefuted if !never.is_empty() => {
                let note = Some(format!("never occurred: {}", never.join(", ")));
                Self { verdict: Verdict::Open, note, ..self }
            }
            Verdict::Holds | Verdict::Unrefuted | Verdict::Refuted | Verdict::Open => self,
        }
    }

    /// A tally without a violation shows `shown`, but not for want of cases: one that did not cover what it claims to
    /// gives no verdict, nor does one that is to hold of every case and has given some up.
    pub fn of_tally(tally: Tally, covers: &[&str], shown: Verdict) -> Self {
        let is_whole = tally.given_up == 0 || shown != Verdict::Holds;
        let evidence = tally.violation.map(|(once, demand)| Evidence {
            choices: Choices { once, again: Vec::new() },
            demand,
            seen: Depiction::Choices,
        });
        let answer = Self::new(evidence, is_whole, shown, tally.cases);
        Self { given_up: tally.given_up, ..answer.covering(covers.iter().copied(), &tally.covered) }
    }
}

/// The words about a search over states that did not come to its end.
pub fn cut_short(states: u64) -> String {
    let states = counted(states, "state");
    format!("cut short after {states}: bound the rule more closely, or give the search more memory or steps")
}

//! A checker's view of a system, and how it enumerates what an oracle may answer.

use std::hash::Hasher;

use tautline_kernel::choice::Oracle;

/// The step function of a system, and what is demanded of it.
pub trait Model: Sync {
    /// All that is at a time.
    type State: Clone + Send;
    /// The intention of a step, before anything is asked.
    type Plan;

    /// The states in which runs begin.
    fn starts(&self) -> Vec<Self::State>;

    /// The plan of the next step from a state, which may be noted in it; `None` if the run is over.
    fn plan(&self, state: &mut Self::State) -> Option<Self::Plan>;

    /// The step from `before` that these answers make of its plan. Of states that are taken for one, the same one comes
    /// out always.
    fn step(
        &self,
        before: &Self::State,
        planned: &Self::State,
        plan: &Self::Plan,
        answers: &mut impl Oracle,
    ) -> Step<Self::State>;

    /// The demand that a run breaks by staying in `state`, in words.
    fn broken_at_end(&self, state: &Self::State) -> Option<String>;

    /// The obligations owed in `state`, a bit each, of which a run breaks the demand if it owes one for ever although
    /// it is weakly fair; none where endless runs break nothing.
    fn owed(&self, state: &Self::State) -> u16;

    /// Who has something left to do in `state`, a bit each.
    fn awake(&self, state: &Self::State) -> u16;

    /// The number of parts of `state`, by which it is told from every other one: as many as every other state has.
    fn parts(&self, _: &Self::State) -> usize {
        1
    }

    /// The parts that may differ in a state and the one to which a step from it leads, a bit each; those from 64 on are
    /// always among them.
    fn differing(&self, _: &Self::State, _: &Self::State) -> u64 {
        u64::MAX
    }

    /// Writes what tells this part of `state` from every other one in this place.
    fn tell(&self, state: &Self::State, part: usize, to: &mut impl Hasher);
}

/// A step.
pub struct Step<S> {
    /// The state to which it leads.
    pub to: S,
    /// Who acts in it, a bit each, if it is bound to be made where no other step is.
    pub acting: Option<u16>,
    /// The demand that it breaks, in words.
    pub breaks: Option<String>,
}

/// Every combination of answers, at most so many of them mishaps: each answer with the number of those that were
/// possible.
#[derive(Clone)]
pub(crate) struct Answers {
    given: Vec<(u32, u32)>,
    pub(crate) asked: QuestionCounts,
    most_mishaps: u32,
}

/// How much was asked for.
#[derive(Clone, Copy, Default)]
pub(crate) struct QuestionCounts {
    pub(crate) answers: usize,
    /// Mishaps among them.
    pub(crate) mishaps: u32,
    /// Answers that say more than that there is no mishap.
    pub(crate) events: u32,
}

impl Answers {
    pub(crate) const fn with_mishaps(most_mishaps: u32) -> Self {
        Self { given: Vec::new(), asked: QuestionCounts { answers: 0, mishaps: 0, events: 0 }, most_mishaps }
    }

    /// The next combination, and the place of the answer that is another one, if there is one. It is asked for from the
    /// first answer on.
    pub(crate) fn advance(&mut self) -> Option<usize> {
        self.given.truncate(self.asked.answers);
        self.asked = QuestionCounts::default();
        while let Some((answer, of)) = self.given.pop() {
            if answer + 1 < of {
                self.given.push((answer + 1, of));
                return Some(self.given.len() - 1);
            }
        }
        None
    }

    /// In how many ways they could have come out.
    pub(crate) fn ways(&self) -> u64 {
        self.given.iter().fold(1, |ways, &(_, of)| ways.saturating_mul(of.into()))
    }

    /// The answers that were asked for.
    pub(crate) fn values(&self) -> Vec<u32> {
        self.given[..self.asked.answers].iter().map(|&(answer, _)| answer).collect()
    }

    #[inline]
    fn next(&mut self, below: u32) -> u32 {
        if self.asked.answers == self.given.len() {
            self.given.push((0, below));
        }
        let (answer, _) = self.given[self.asked.answers];
        self.asked.answers += 1;
        answer
    }
}

impl Oracle for Answers {
    #[inline]
    fn pick(&mut self, below: u32) -> u32 {
        if below <= 1 {
            return 0;
        }
        self.asked.events += 1;
        self.next(below)
    }

    #[inline]
    fn mishap(&mut self) -> bool {
        let is_one = self.asked.mishaps < self.most_mishaps && self.next(2) == 1;
        self.asked.mishaps += u32::from(is_one);
        self.asked.events += u32::from(is_one);
        is_one
    }
}

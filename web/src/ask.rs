//! Questions to the world, and whoever answers them: answers that were given, the layout, the seed, or a person who is
//! asked.

use serde::Serialize;

/// A question that a rule asks of the world.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct Question {
    /// The question in words.
    pub(crate) words: String,
    /// The answers in words.
    pub(crate) options: Vec<String>,
    /// The answer that the layout or the seed would give.
    pub(crate) usual: u32,
    /// The side that it is about, if any.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) side: Option<u32>,
    /// The robots that it is about.
    pub(crate) robots: Vec<usize>,
}

/// An answer that is left to the layout or the seed.
pub(crate) const USUAL: i32 = -1;

/// Answers in their order. What none is given for is answered as usual, or stays open.
#[derive(Clone, Debug, Default)]
pub(crate) struct Answers {
    given: Vec<i32>,
    next: usize,
    /// Whether a question without an answer stays open.
    pub(crate) by_hand: bool,
    /// The first question that stays open. What is answered after it counts for nothing.
    pub(crate) open: Option<Question>,
}

impl Answers {
    pub(crate) fn new(given: Vec<i32>) -> Self {
        Self { given, ..Self::default() }
    }

    /// The answers that were taken so far.
    pub(crate) fn taken(&self) -> &[i32] {
        &self.given[..self.next.min(self.given.len())]
    }

    /// Gives more.
    pub(crate) fn give(&mut self, more: &[i32]) {
        self.given.extend_from_slice(more);
    }

    /// The answer to the next question, which is only put together if it stays open. One that has one option does not.
    pub(crate) fn ask(&mut self, usual: u32, question: impl FnOnce() -> Question) -> u32 {
        if self.open.is_some() {
            return usual;
        }
        let given = self.given.get(self.next).copied();
        if given.is_none() {
            self.open = self.by_hand.then(question).filter(|question| question.options.len() > 1);
            if self.open.is_some() {
                return usual;
            }
            self.given.push(USUAL);
        }
        self.next += 1;
        u32::try_from(given.unwrap_or(USUAL)).unwrap_or(usual)
    }
}

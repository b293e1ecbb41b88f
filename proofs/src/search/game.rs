//! What the search plays: a run against a world that answers when it is asked. The state is a plain value, so it is
//! copied where the world has more than one answer.

use tautline_kernel::choice::Oracle;

use crate::invariant::Invariant;
use crate::run::Frame;

/// A demand that is not met: by which invariant it is made, and in words.
pub(crate) type Demand = (Invariant, &'static str);

/// One team move between its states.
pub(crate) struct Turn<'a, G: Game + ?Sized> {
    /// When the team was asked for a plan.
    pub(crate) before: &'a G::State,
    /// When it had planned.
    pub(crate) planned: &'a G::State,
    /// When it had moved.
    pub(crate) after: &'a G::State,
    pub(crate) plan: &'a G::Plan,
    /// What the log grew by.
    pub(crate) sent: &'a [u8],
}

/// An exploration scheme as the search sees it.
pub(crate) trait Game: Send + Sync + 'static {
    /// All that the team is and knows, but for the log.
    type State: Copy + Send + Sync;
    /// What the team intends to do in one team move.
    type Plan: Copy + Send + Sync;

    /// The state before the first team move.
    fn start(&self) -> Self::State;

    /// What the team does next; `None` if the run is over.
    fn plan(&self, state: &mut Self::State, log: &[u8]) -> Option<Self::Plan>;

    /// Carries the plan out. Whatever the team cannot know is asked of `world`; whatever it needs to remember goes
    /// to the end of `log`.
    fn settle(&self, state: &mut Self::State, plan: &Self::Plan, log: &mut Vec<u8>, world: &mut impl Oracle);

    /// What a team move looks like.
    fn frame(&self, turn: &Turn<'_, Self>) -> Frame;

    /// What a team move breaks.
    fn broken_by(&self, turn: &Turn<'_, Self>) -> Option<Demand>;

    /// What a run breaks that ends in `state`, with all that it remembers in `log`.
    fn broken_at_end(&self, state: &Self::State, log: &[u8]) -> Option<Demand>;

    /// What a run breaks that goes on for ever: it was in the state `then` when the log had `sent` bytes, and is in
    /// `now` without an answer in between.
    fn broken_by_recurring(
        &self,
        then: &Self::State,
        sent: usize,
        now: &Self::State,
        log: &[u8],
    ) -> Option<Demand>;
}

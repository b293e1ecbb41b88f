//! A rule in its surroundings: the one face of whatever moves. Whoever answers its questions makes of it a search over
//! all layouts ([`tree`](super::tree)), a search over all states ([`states`](super::states)), a property, a fuzz target
//! or a Kani harness ([`play`]), a run on a layout, or a replay.
//!
//! A step has two halves. [`plan`](World::plan) is a function of the state alone; [`settle`](World::settle) asks
//! whatever cannot be known. So a search plans once, and settles once for each answer.

use std::fmt;

use tautline_kernel::choice::Oracle;

use super::{Outcome, Stop, require};

/// A rule in its surroundings.
pub trait World {
    /// All that is: where robots are, the memory of each, messages under way, what was found of the layout.
    type State: Clone;
    /// The intention of a step, before anything is asked. Where anything may happen next, the list of all that may.
    type Plan;
    /// The event of a step.
    type Event;
    /// A demand that can be broken. Counterexamples are told in this order.
    type Demand: Copy + Ord + fmt::Debug;

    /// The intention of the next step; `None` if the run is over. `log` is what earlier steps have written.
    fn plan(&self, state: &mut Self::State, log: &[u8]) -> Option<Self::Plan>;

    /// Carries the plan out. Whatever the rule cannot know is asked of `world`: whatever is against the robots is a
    /// [mishap](Oracle::mishap). A rule that takes steps back writes them to the end of `log`; ways of such a rule do
    /// not merge.
    fn settle(
        &self,
        state: &mut Self::State,
        plan: &Self::Plan,
        log: &mut Vec<u8>,
        world: &mut impl Oracle,
    ) -> Self::Event;

    /// The demands that a step breaks.
    fn broken_by(&self, turn: &Turn<'_, Self>) -> Vec<Self::Demand>;

    /// The demands that a run breaks by ending in `state`, with all that was written in `log`.
    fn broken_at_end(&self, state: &Self::State, log: &[u8]) -> Vec<Self::Demand> {
        let _ = (state, log);
        Vec::new()
    }

    /// The situations that must occur, at most [`MOST_COVERS`] of them.
    fn covers(&self) -> Vec<&'static str> {
        Vec::new()
    }

    /// Which of them a step is: a bit for each, in their order.
    fn occurs(&self, turn: &Turn<'_, Self>) -> u64 {
        let _ = turn;
        0
    }
}

/// A step between its states.
pub struct Turn<'a, W: World + ?Sized> {
    /// The state in which the step was planned.
    pub before: &'a W::State,
    /// The state once it was planned.
    pub planned: &'a W::State,
    /// The state after it.
    pub after: &'a W::State,
    /// The plan.
    pub plan: &'a W::Plan,
    /// The event of the step.
    pub event: &'a W::Event,
    /// The bytes that the log grew by.
    pub sent: &'a [u8],
}

/// The plan of a step that may be any of `all`; `None` if there is none.
pub fn any_of<T>(all: Vec<T>) -> Option<Vec<T>> {
    Some(all).filter(|all| !all.is_empty())
}

/// The one of `all` that `world` picks.
pub fn picked<T: Clone>(all: &[T], world: &mut impl Oracle) -> T {
    all[world.pick(all.len() as u32) as usize].clone()
}

/// The most situations that can be said to occur: each has a bit.
pub const MOST_COVERS: usize = u64::BITS as usize;

/// The bit of `situation` among those that must occur; none if it is none of them.
pub fn bit(covers: &[&str], situation: &str) -> u64 {
    covers.iter().position(|&other| other == situation).map_or(0, |place| 1 << place)
}

/// Plays a run of `world` from `state` with these answers, for at most so many steps, until something is broken: the
/// body of a property, a fuzz target or a Kani harness.
///
/// # Errors
/// [`Stop::Violated`] with the words of the demand that is broken, as `words` has them; [`Stop::GivenUp`] if the run is
/// longer.
pub fn play<W: World>(
    world: &W,
    mut state: W::State,
    most_steps: u32,
    answers: &mut impl Oracle,
    words: impl Fn(W::Demand) -> &'static str,
) -> Outcome {
    let mut log = Vec::new();
    let judge =
        |broken: Vec<W::Demand>| broken.first().map_or(Ok(()), |&demand| require(false, words(demand)));
    for _ in 0..most_steps {
        let before = state.clone();
        let Some(plan) = world.plan(&mut state, &log) else {
            judge(world.broken_at_end(&state, &log))?;
            return Ok("an end");
        };
        let (planned, sent) = (state.clone(), log.len());
        let event = world.settle(&mut state, &plan, &mut log, answers);
        let (before, planned, after) = (&before, &planned, &state);
        let turn = Turn { before, planned, after, plan: &plan, event: &event, sent: &log[sent..] };
        judge(world.broken_by(&turn))?;
    }
    Err(Stop::GivenUp)
}

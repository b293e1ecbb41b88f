//! A run that a search has found: the search's world makes it again by its choices.

use std::{iter, mem};

use tautline_io::diagnostic::Diagnostic;
use tautline_proofs::engine::states::{Bits, System, steps};
use tautline_proofs::engine::world::World;

use super::setup::of_choices;
use super::switches::StartBy;
use super::{Setup, Team};

/// The team of `setup`, which has choices: `starts` begin one of one robot, of two, and of three.
pub(super) fn by_robots<R>(
    setup: &Setup,
    rule: R,
    starts: [StartBy<R>; 3],
) -> Result<Box<dyn Team>, Diagnostic> {
    match (1..).zip(starts).find(|&(robots, _)| robots == setup.robots) {
        Some((_, start)) => start(setup, rule),
        None => Err(of_choices(format_args!("{} robots make no choices", setup.robots))),
    }
}

/// A world of a search, and the choices by which it makes a run again.
pub(super) struct Script<S: System> {
    pub(super) system: S,
    pub(super) state: S::State,
    choices: Vec<u32>,
    /// The state before each choice so far, and who acted then.
    past: Vec<(S::State, Bits)>,
    /// The demands that the choices have broken since this was last cleared.
    pub(super) broken: Vec<S::Demand>,
}

impl<S: System> Script<S> {
    pub(super) fn new(system: S, state: S::State, choices: &[u32]) -> Self {
        Self { system, state, choices: choices.to_vec(), past: Vec::new(), broken: Vec::new() }
    }

    /// Makes the next choice, if what happens then `is_wanted`.
    pub(super) fn choose<T>(&mut self, is_wanted: impl FnOnce(&T) -> bool) -> Option<T>
    where
        S: World<Plan = Vec<T>, Event = usize>,
    {
        let number = *self.choices.get(self.past.len())?;
        let step = steps(&self.system, &self.state).nth(number as usize)?;
        let turned = self.system.plan(&mut self.state.clone(), &[])?.swap_remove(step.event);
        if !is_wanted(&turned) {
            return None;
        }
        self.past.push((mem::replace(&mut self.state, step.state), step.acting));
        self.broken.extend(step.breaks);
        Some(turned)
    }

    /// Makes all choices that are left.
    pub(super) fn rest<T>(&mut self) -> Vec<T>
    where
        S: World<Plan = Vec<T>, Event = usize>,
    {
        iter::from_fn(|| self.choose(|_| true)).collect()
    }

    /// Whether nothing can happen any more.
    pub(super) fn is_over(&self) -> bool {
        steps(&self.system, &self.state).next().is_none()
    }

    /// Whether the choices have led back to where the robots were, and keep nobody from acting: so they can go on for
    /// ever.
    pub(super) fn goes_round(&self) -> bool
    where
        S::State: PartialEq,
    {
        let Some(round) = self.round() else { return false };
        let awake = round.iter().fold(Bits::MAX, |awake, (state, _)| awake & self.system.awake(state));
        let acting = round.iter().fold(0, |acting, (_, robots)| acting | robots);
        awake & !acting == 0
    }

    /// The states before the choices that have led back to where the robots were, and who acted then.
    pub(super) fn round(&self) -> Option<&[(S::State, Bits)]>
    where
        S::State: PartialEq,
    {
        let home = self.past.iter().position(|(state, _)| *state == self.state)?;
        Some(&self.past[home..])
    }
}

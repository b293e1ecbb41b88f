//! The plain recursion as the search plays it: a chain under another reading of the paper than the published one.

use std::cmp::Ordering;
use std::ops::ControlFlow;

use tautline_kernel::chain::SetupError;
use tautline_kernel::choice::Oracle;
use tautline_kernel::ground::Step;

use super::bounds::Bounds;
use super::game::{MOVES_OF_A_CELL, left_out, words_of_end};
use super::invariant::{Invariant, exchange, holds_in_any_order, meet_unblocked};
use super::plain::{PlainChain, PlainIntent};
use crate::engine::tree::Game;
use crate::engine::world::{Turn, World};
use crate::run::Frame;

/// A chain within bounds.
pub(super) struct PlainGame {
    bounds: Bounds,
    start: PlainChain,
}

impl PlainGame {
    pub(super) fn new(bounds: &Bounds) -> Result<Self, SetupError> {
        let Bounds { ref observed, robots, base, .. } = *bounds;
        let start = PlainChain::of(observed, robots, base, bounds.reach()?);
        let start = start.ok_or(SetupError::BaseOutside(base))?;
        Ok(Self { bounds: bounds.clone(), start })
    }
}

/// The bytes of the log: one for each team move that can be taken back, and one for each that is.
const MADE: u8 = 0;
const TAKEN_BACK: u8 = 1;

impl World for PlainGame {
    type State = PlainChain;
    type Plan = PlainIntent;
    type Event = ();
    type Demand = Invariant;

    fn plan(&self, chain: &mut PlainChain, _: &[u8]) -> Option<PlainIntent> {
        let (intent, _) = chain.plan(u64::MAX).ok()?;
        intent.steps().is_some().then_some(intent)
    }

    fn settle(
        &self,
        chain: &mut PlainChain,
        intent: &PlainIntent,
        log: &mut Vec<u8>,
        world: &mut impl Oracle,
    ) {
        let before = chain.history();
        chain.settle(intent, |edge| world.is_open(edge));
        match chain.history().cmp(&before) {
            Ordering::Greater => log.push(MADE),
            Ordering::Less => log.push(TAKEN_BACK),
            Ordering::Equal => {}
        }
    }

    fn broken_by(&self, turn: &Turn<'_, Self>) -> Vec<Invariant> {
        let (before, after) = (turn.before.cells(), turn.after.cells());
        let steps = turn.plan.steps().unwrap_or_default();
        let passes = |robot: usize| before[robot] != after[robot] || steps[robot] == Step::Stay;
        let is_in = |demand: &Invariant| match demand {
            Invariant::Without(breach) => breach.is_in(before, after),
            Invariant::AnyOrder => !holds_in_any_order(before, after),
            Invariant::Meets => meet_unblocked(before, after, passes),
            Invariant::Exchanges => exchange(before, after),
            _ => false,
        };
        self.bounds.invariants.iter().copied().filter(is_in).collect()
    }

    fn broken_at_end(&self, chain: &PlainChain, _: &[u8]) -> Vec<Invariant> {
        left_out(&self.bounds, chain.area(), |edge| !chain.has_wall(edge), |cell| !chain.has_explored(cell))
    }
}

impl Game for PlainGame {
    type Frame = Frame;

    fn edges(&self) -> u32 {
        self.start.area().edges().count() as u32
    }

    fn longest_run(&self) -> u32 {
        MOVES_OF_A_CELL * self.start.area().cells().count() as u32
    }

    fn start(&self) -> PlainChain {
        self.start.clone()
    }

    fn frame(&self, turn: &Turn<'_, Self>) -> Frame {
        let steps = turn.plan.steps().unwrap_or_default().to_vec();
        let cells = turn.after.cells().to_vec();
        let blocked = turn.before.cells().iter().zip(&cells).zip(&steps);
        let blocked = blocked.map(|((before, after), &step)| step != Step::Stay && before == after).collect();
        Frame { kind: turn.plan.kind(), steps, blocked, cells }
    }

    fn wanted(&self) -> &[Invariant] {
        &self.bounds.invariants
    }

    fn words(&self, demand: Invariant, turn: Option<&Turn<'_, Self>>) -> &'static str {
        match (turn, demand.breach()) {
            (Some(_), Some(breach)) => breach.words(),
            _ => words_of_end(demand),
        }
    }

    /// The chain is as it was, and has not looked below its history since then.
    fn recurs(
        &self,
        then: &PlainChain,
        sent: usize,
        now: &PlainChain,
        log: &[u8],
    ) -> ControlFlow<Vec<Invariant>> {
        let climb = |height: u32, &byte: &u8| {
            if byte == MADE { Some(height + 1) } else { height.checked_sub(1) }
        };
        let stays_above = || then.history() > 0 && log[sent..].iter().try_fold(0, climb).is_some();
        let recurs = now.is_where(then) && (now == then || stays_above());
        if recurs { ControlFlow::Break(vec![Invariant::Ends]) } else { ControlFlow::Continue(()) }
    }
}

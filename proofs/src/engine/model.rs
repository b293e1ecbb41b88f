//! The step function of a system, as the checker of certificates asks for it. What is here is believed: it plans and
//! settles as the world does, and knows no search.

use std::hash::{Hash, Hasher};
use std::ops::ControlFlow;

use tautline_certificates::{Model, Ready, Runs, Step};
use tautline_kernel::choice::Oracle;

use super::states::System;
use super::tree::Game;
use super::world::Turn;

/// The words where the bytes of a state leave something of it out.
pub(super) const LOST: &str = "a state does not come back from its bytes";

/// A system with its starts, and which demands count.
pub struct StatesModel<S: System> {
    /// The system.
    pub system: S,
    /// Its starts.
    pub starts: fn(&S) -> Vec<S::State>,
    /// Whether it is this demand that is looked at.
    pub is_asked: fn(&S, S::Demand) -> bool,
}

impl<S: System> StatesModel<S> {
    /// A system of which one thing alone is demanded.
    pub fn new(system: S, starts: fn(&S) -> Vec<S::State>) -> Self {
        Self { system, starts, is_asked: |_, _| true }
    }

    /// The first demand that is asked for, in words.
    fn words(&self, broken: Vec<S::Demand>) -> Option<String> {
        let mut asked = broken.into_iter().filter(|&demand| (self.is_asked)(&self.system, demand));
        asked.next().map(|demand| format!("{demand:?}"))
    }
}

impl<S> Model for StatesModel<S>
where
    S: System + Sync,
    S::State: Send,
{
    type State = S::State;
    type Plan = S::Plan;

    fn starts(&self) -> Vec<S::State> {
        let mut starts = (self.starts)(&self.system);
        for state in &mut starts {
            self.system.make_canonical(state);
        }
        starts
    }

    fn plan(&self, state: &mut S::State) -> Option<S::Plan> {
        self.system.plan(state, &[])
    }

    fn step(
        &self,
        before: &S::State,
        planned: &S::State,
        plan: &S::Plan,
        answers: &mut impl Oracle,
    ) -> Step<S::State> {
        let (mut after, mut log) = (planned.clone(), Vec::new());
        let event = self.system.settle(&mut after, plan, &mut log, answers);
        let turn = Turn { before, planned, after: &after, plan, event: &event, sent: &log };
        let breaks = self.words(self.system.broken_by(&turn));
        let acting = self.system.is_bound(&turn).then(|| self.system.acting(&turn));
        self.system.make_canonical(&mut after);
        let breaks = breaks.or_else(|| self.system.is_lost(&after).then(|| LOST.to_owned()));
        Step { to: after, acting, breaks }
    }

    fn broken_at_end(&self, state: &S::State) -> Option<String> {
        self.words(self.system.broken_at_end(state, &[]))
    }

    fn owed(&self, state: &S::State) -> u16 {
        let asked =
            self.system.broken_by_endless_runs().filter(|&demand| (self.is_asked)(&self.system, demand));
        asked.map_or(0, |_| self.system.owed(state))
    }

    fn awake(&self, state: &S::State) -> u16 {
        self.system.awake(state)
    }

    /// A state of no parts is told by its bytes.
    fn parts(&self, state: &S::State) -> usize {
        self.system.places(state).max(1)
    }

    fn differing(&self, one: &S::State, other: &S::State) -> u64 {
        self.system.differing(one, other)
    }

    fn tell(&self, state: &S::State, part: usize, to: &mut impl Hasher) {
        if self.system.places(state) > 0 {
            return self.system.part(state, part).hash(to);
        }
        let mut bytes = Vec::new();
        self.system.write(state, &mut bytes);
        to.write(&bytes);
    }
}

/// A team whose runs are told apart, with at most so many mishaps, of which one thing is demanded.
pub struct RunsModel<'a, G: Game> {
    /// The team.
    pub game: &'a G,
    /// Mishaps in a run, at most.
    pub most_mishaps: u32,
    /// The demand.
    pub demand: G::Demand,
}

impl<G: Game> RunsModel<'_, G> {
    /// The demand in words, if it is broken.
    fn words(&self, broken: &[G::Demand]) -> Option<String> {
        broken.contains(&self.demand).then(|| format!("{:?}", self.demand))
    }
}

impl<G: Game> Runs for RunsModel<'_, G> {
    type State = G::State;
    type Plan = G::Plan;

    fn start(&self) -> G::State {
        self.game.start()
    }

    fn most_mishaps(&self) -> u32 {
        self.most_mishaps
    }

    fn longest_run(&self) -> u32 {
        self.game.longest_run()
    }

    fn plan(&self, state: &mut G::State, log: &[u8]) -> Option<G::Plan> {
        self.game.plan(state, log)
    }

    fn step(
        &self,
        ready: &Ready<G::State, G::Plan>,
        after: &mut G::State,
        log: &mut Vec<u8>,
        answers: &mut impl Oracle,
    ) -> Option<String> {
        let (Ready { before, planned, plan }, sent) = (ready, log.len());
        let event = self.game.settle(after, plan, log, answers);
        let turn = Turn { before, planned, after, plan, event: &event, sent: &log[sent..] };
        self.words(&self.game.broken_by(&turn))
    }

    fn broken_at_end(&self, state: &G::State, log: &[u8]) -> Option<String> {
        self.words(&self.game.broken_at_end(state, log))
    }

    fn recurs(
        &self,
        then: &G::State,
        sent: usize,
        now: &G::State,
        log: &[u8],
    ) -> ControlFlow<Option<String>> {
        self.game.recurs(then, sent, now, log).map_break(|broken| self.words(&broken))
    }
}

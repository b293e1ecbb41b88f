//! A system that somebody watches while it is searched: whoever ends the work makes it a system without further steps.

use std::cell::{Cell, RefCell};

use tautline_kernel::choice::Oracle;
use tautline_proofs::engine::states::{Bits, Found, Limits, Places, System, search};
use tautline_proofs::engine::world::{Turn, World};

use super::hunt::{Asked, Far, Hunter};

/// States between two words about how far the search is.
const BETWEEN: u64 = 1 << 14;

/// How much was searched.
#[derive(Default)]
pub(super) struct Count {
    pub(super) states: u64,
    pub(super) steps: u64,
    /// The cells up to which all areas were searched.
    pub(super) cells: Option<usize>,
    pub(super) is_complete: bool,
}

/// Searches a system, watched, as far as the budget goes; what was found, and whether the work was ended.
pub(super) fn watched<S: System>(
    system: &S,
    starts: Vec<S::State>,
    what: String,
    asked: &Asked<'_>,
    count: &mut Count,
    hunter: &mut dyn Hunter,
) -> (Found<S::Demand>, bool) {
    let left = asked.budget.map_or(u64::MAX, |budget| budget.saturating_sub(count.steps));
    let watched = Watched {
        system,
        hunter: RefCell::new(hunter),
        what,
        states: Cell::new(count.states),
        is_stopped: Cell::new(false),
    };
    let found = search(&watched, starts, Limits { most_steps: left, ..Limits::NONE });
    count.states += found.states;
    count.steps += found.steps;
    (found, watched.is_stopped.get())
}

/// A watched system.
struct Watched<'a, 'h, S> {
    system: &'a S,
    hunter: RefCell<&'h mut dyn Hunter>,
    /// What is searched.
    what: String,
    states: Cell<u64>,
    /// Whether the work was ended.
    is_stopped: Cell<bool>,
}

impl<S: System> World for Watched<'_, '_, S> {
    type State = S::State;
    type Plan = S::Plan;
    type Event = S::Event;
    type Demand = S::Demand;

    fn plan(&self, state: &mut S::State, log: &[u8]) -> Option<S::Plan> {
        let states = self.states.get() + 1;
        self.states.set(states);
        if states.is_multiple_of(BETWEEN) {
            let words = format!("{}, states {states}", self.what);
            let flow = self.hunter.borrow_mut().hears(Far::Words(words));
            self.is_stopped.set(self.is_stopped.get() || flow.is_break());
        }
        if self.is_stopped.get() { None } else { self.system.plan(state, log) }
    }

    fn settle(
        &self,
        state: &mut S::State,
        plan: &S::Plan,
        log: &mut Vec<u8>,
        world: &mut impl Oracle,
    ) -> S::Event {
        self.system.settle(state, plan, log, world)
    }

    fn broken_by(&self, turn: &Turn<'_, Self>) -> Vec<S::Demand> {
        self.system.broken_by(&of_system(turn))
    }

    fn broken_at_end(&self, state: &S::State, log: &[u8]) -> Vec<S::Demand> {
        if self.is_stopped.get() { Vec::new() } else { self.system.broken_at_end(state, log) }
    }

    fn covers(&self) -> Vec<&'static str> {
        self.system.covers()
    }

    fn occurs(&self, turn: &Turn<'_, Self>) -> u64 {
        self.system.occurs(&of_system(turn))
    }
}

impl<S: System> System for Watched<'_, '_, S> {
    type Part = S::Part;

    fn make_canonical(&self, state: &mut S::State) {
        self.system.make_canonical(state);
    }

    fn places(&self, state: &S::State) -> usize {
        self.system.places(state)
    }

    fn part(&self, state: &S::State, place: usize) -> S::Part {
        self.system.part(state, place)
    }

    fn differing(&self, one: &S::State, other: &S::State) -> Places {
        self.system.differing(one, other)
    }

    fn put(&self, state: &mut S::State, place: usize, part: &S::Part) {
        self.system.put(state, place, part);
    }

    fn acting(&self, turn: &Turn<'_, Self>) -> Bits {
        self.system.acting(&of_system(turn))
    }

    fn is_bound(&self, turn: &Turn<'_, Self>) -> bool {
        self.system.is_bound(&of_system(turn))
    }

    fn broken_by_endless_runs(&self) -> Option<S::Demand> {
        self.system.broken_by_endless_runs().filter(|_| !self.is_stopped.get())
    }

    fn owed(&self, state: &S::State) -> Bits {
        self.system.owed(state)
    }

    fn awake(&self, state: &S::State) -> Bits {
        self.system.awake(state)
    }

    fn is_enough(&self, demand: S::Demand) -> bool {
        self.system.is_enough(demand)
    }
}

/// The same step, of the system that is watched.
const fn of_system<'a, S: System>(turn: &Turn<'a, Watched<'_, '_, S>>) -> Turn<'a, S> {
    let Turn { before, planned, after, plan, event, sent } = *turn;
    Turn { before, planned, after, plan, event, sent }
}

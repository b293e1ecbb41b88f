//! A system that somebody watches while it is searched: whoever ends the work makes it a system without further steps.

use std::cell::{Cell, RefCell};

use tautline_proofs::engine::states::{Bits, Found, Limits, Places, Step, System, search};

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

impl<S: System> System for Watched<'_, '_, S> {
    type State = S::State;
    type Part = S::Part;
    type Demand = S::Demand;

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

    fn steps(&self, state: &S::State) -> impl Iterator<Item = Step<S::State, S::Demand>> {
        let states = self.states.get() + 1;
        self.states.set(states);
        if states.is_multiple_of(BETWEEN) {
            let words = format!("{}, states {states}", self.what);
            let flow = self.hunter.borrow_mut().hears(Far::Words(words));
            self.is_stopped.set(self.is_stopped.get() || flow.is_break());
        }
        (!self.is_stopped.get()).then(|| self.system.steps(state)).into_iter().flatten()
    }

    fn broken_at_end(&self, state: &S::State) -> Vec<S::Demand> {
        if self.is_stopped.get() { Vec::new() } else { self.system.broken_at_end(state) }
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

//! Hunts through all states of small layouts: how large they may be, a system that somebody watches while it is
//! searched, and how what was found is told. Whoever ends the work makes it a system without further steps.

use std::cell::{Cell, RefCell};

use tautline_kernel::choice::Oracle;
use tautline_proofs::engine::states::{Bits, Findings, Limits, Places, System, search};
use tautline_proofs::engine::world::{Turn, World};
use tautline_proofs::plural::counted;

use super::hunt::{Asked, Done, Facts, Far, Finding, HuntReport, Hunter, outcome};
use crate::diagnostic::Diagnostic;
use crate::layout::Size;

/// States between two words about how far the search is.
const BETWEEN: u64 = 1 << 14;

/// How large the layouts of a hunt may be, and its teams.
pub(super) struct Small {
    /// The word for a cell.
    pub(super) cell: &'static str,
    /// The most cells of a layout.
    pub(super) most_cells: usize,
    /// The most columns and rows, and how that is said.
    pub(super) most_side: (i16, &'static str),
    /// Columns and rows when nobody says.
    pub(super) default_size: (u64, u64),
    /// Sizes that are right.
    pub(super) examples: &'static str,
    /// The word for the search that holds the robots.
    pub(super) search: &'static str,
    /// The words for a team without a robot.
    pub(super) no_robots: &'static str,
}

impl Small {
    /// Robots when nobody says how many.
    const DEFAULT_ROBOTS: u64 = 2;

    /// The size that is asked for.
    ///
    /// # Errors
    /// A [`Diagnostic`] if it is too large.
    pub(super) fn size(&self, asked: &Asked<'_>) -> Result<Size, Diagnostic> {
        let size = match asked.size {
            Some(size) => size,
            None => Size::new(self.default_size.0, self.default_size.1)?,
        };
        let &Self { cell, most_cells, most_side: (most_side, side), examples, .. } = self;
        if size.cells() <= most_cells && size.width().max(size.height()) <= most_side {
            return Ok(size);
        }
        let what = format!("{size} {cell}s are {}, too many to search all their layouts", size.cells());
        let remedy = format!("give `size` at most {most_cells} {cell}s{side}, for example {examples}");
        Err(Diagnostic::of_field("size", what, remedy))
    }

    /// The number of robots that is asked for, of at most so many, in an area of this size, which is called `area`.
    ///
    /// # Errors
    /// A [`Diagnostic`] if there are none, too many, or too many for the area.
    pub(super) fn robots(
        &self,
        asked: &Asked<'_>,
        most: u64,
        size: Size,
        area: &str,
    ) -> Result<u64, Diagnostic> {
        let robots = asked.robots.unwrap_or(Self::DEFAULT_ROBOTS);
        let room = size.cells() as u64;
        let (what, remedy) = match robots {
            0 => (self.no_robots.to_owned(), format!("from 1 to {most}")),
            _ if robots > most => (
                format!("{} holds {}, and not {robots}", self.search, counted(most, "robot")),
                format!("from 1 to {most}"),
            ),
            _ if robots > room => (
                format!("{robots} robots do not find room in {area} {}s", self.cell),
                format!("up to {room}, or a larger `size`"),
            ),
            _ => return Ok(robots),
        };
        Err(Diagnostic::of_field("robots", what, format_args!("give `robots` a number {remedy}")))
    }
}

/// The report of a hunt for `robots` in layouts up to a size, within these other bounds.
pub(super) fn told(
    (size, robots, within): (Size, u64, &str),
    facts: Facts,
    (done, covered): (Done, Option<String>),
    count: &Count,
    found: Vec<Finding>,
) -> HuntReport {
    let (states, steps) = (counted(count.states, "state"), counted(count.steps, "step"));
    HuntReport {
        robots,
        facts,
        is_complete: count.is_complete,
        done,
        title: format!("{}, layouts up to {size}{within}: {states}, {steps}", counted(robots, "robot")),
        through: format!("{states} and {steps}"),
        outcome: outcome(&found, count.is_complete, covered),
        found,
    }
}

/// How much was searched.
#[derive(Default)]
pub(super) struct Count {
    pub(super) states: u64,
    pub(super) steps: u64,
    /// The cells up to which all areas were searched.
    pub(super) cells: Option<usize>,
    pub(super) is_complete: bool,
}

/// Searches a system, watched, as far as the budget goes; returns what was found, and whether the work was ended.
pub(super) fn watched<S: System>(
    system: &S,
    starts: Vec<S::State>,
    what: String,
    asked: &Asked<'_>,
    count: &mut Count,
    hunter: &mut dyn Hunter,
) -> (Findings<S::Demand>, bool) {
    let left = asked.budget.map_or(u64::MAX, |budget| budget.saturating_sub(count.steps));
    let watched = Monitor {
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

/// A system that is watched.
struct Monitor<'a, 'h, S> {
    system: &'a S,
    hunter: RefCell<&'h mut dyn Hunter>,
    /// The words for the system.
    what: String,
    states: Cell<u64>,
    /// Whether the work was ended.
    is_stopped: Cell<bool>,
}

impl<S: System> World for Monitor<'_, '_, S> {
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

impl<S: System> System for Monitor<'_, '_, S> {
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

/// The step of the system that is watched.
const fn of_system<'a, S: System>(turn: &Turn<'a, Monitor<'_, '_, S>>) -> Turn<'a, S> {
    let Turn { before, planned, after, plan, event, sent } = *turn;
    Turn { before, planned, after, plan, event, sent }
}

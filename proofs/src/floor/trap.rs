//! The search for traps [Ferranti 2009, Fig. 8]: the smallest layout and the fewest missed sensors with which agents on
//! a floor are done, or go round for ever, before every cell is explored (BRICKS-4, BRICKS-5). The agents act in the
//! order of their ids, once each in a team move, as in a simulation; which sensors they miss is open.
//!
//! No miss comes before one, one before two; then areas go by their number of cells, narrow ones first, and within an
//! area every layout of blocked cells and free cells that are all connected, every start. Of the traps in the first
//! area that has one, the one with the fewest team moves is taken, then that of the first layout, blocked cells read
//! as a binary number with the north-western one last.

use std::convert::Infallible;
use std::ops::ControlFlow;

use serde::{Deserialize, Serialize};
use tautline_kernel::choice::Oracle;
use tautline_kernel::floor::{Mark, Sensor};
use tautline_kernel::ground::Cell;

pub use super::agents::{Acted, Agents};
use super::plans::{CELLS, FloorPlan, blocked};
use super::small::{self, Misses, Part, Small, Stored, marked, shut};
pub use super::way::Way;
use crate::engine::lots::{self, Lots};
use crate::engine::outcomes;
use crate::engine::states::{Bits, Limits, Places, Run, System, search};
use crate::engine::world::{Turn, World, any_of, picked};

/// What to search for, and how far.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Bounds<A = Way> {
    /// How the agents decide.
    pub way: A,
    /// How many they are: one or two.
    pub agents: u32,
    /// Sensors that are missed in a run at most.
    pub max_misses: u8,
    /// Columns of the layouts at most.
    pub max_width: i16,
    /// Rows of the layouts at most. No area has more than [`MAX_CELLS`] cells.
    pub max_height: i16,
    /// The search stops after the wave of layouts in which it has made so many steps.
    pub budget_steps: Option<u64>,
}

/// The most cells of an area.
pub const MAX_CELLS: usize = CELLS;

/// The most agents.
pub const MAX_AGENTS: u32 = 2;

/// Steps that are made in one layout before it is given up: its states then take about a gigabyte.
const MAX_STEPS: u64 = 1 << 20;

/// What a search found.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Found {
    /// Layouts that were looked at, anew for each number of misses.
    pub layouts: u64,
    /// States of agents and floors.
    pub states: u64,
    /// Team moves between them.
    pub steps: u64,
    /// Numbers of misses, from none on, with which every layout was covered.
    pub levels: u8,
    /// Whether the search came to its end: the smallest trap, or all there is within the bounds.
    pub is_complete: bool,
    /// The smallest trap.
    pub trap: Option<Trap>,
}

/// A run that ends, or never ends, before every cell is explored.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Trap {
    /// Columns.
    pub width: i16,
    /// Rows.
    pub height: i16,
    /// Cells that are blocked, row by row.
    pub blocked: Vec<Cell>,
    /// Where each agent starts.
    pub starts: Vec<Cell>,
    /// Which sensors are missed: the numbers of the questions, counted from 1, that are answered yes. An agent asks
    /// once for each sensor around it that is not that of an unexplored cell, clockwise from the northern one.
    pub missed: Vec<u32>,
    /// Team moves, up to the one in which an agent is done or from which on they go round.
    pub moves: u32,
    /// How they are trapped.
    pub end: End,
}

/// How agents are trapped.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum End {
    /// One of them is done.
    Done,
    /// They go round for ever.
    Endless,
}

const DONE: &str = "an agent is done only when every cell is explored";
const ENDLESS: &str = "every cell is explored in the end";

/// The smallest trap within `bounds`. `watch` hears after each wave what has been found, and may end the search.
pub fn hunt<A: Agents>(bounds: &Bounds<A>, watch: &mut dyn FnMut(&Found) -> ControlFlow<()>) -> Found {
    match lots::search(bounds, bounds.budget_steps, watch) {
        Ok((found, is_complete)) => found.ended(is_complete),
    }
}

/// Layouts of one area, and the sensors that are missed in each at most.
pub type Stage = (u8, (i16, i16));

/// The stages of a search for traps: no miss before one, and the smallest area first.
pub fn stages(max_misses: u8, (max_width, max_height): (i16, i16)) -> Vec<Stage> {
    let mut areas: Vec<(i16, i16)> = (1..=max_width)
        .flat_map(|width| (1..=max_height).map(move |height| (width, height)))
        .filter(|&(width, height)| width as usize * height as usize <= MAX_CELLS)
        .collect();
    areas.sort_unstable_by_key(|&(width, height)| (width * height, width));
    (0..=max_misses).flat_map(|misses| areas.iter().map(move |&area| (misses, area))).collect()
}

/// About how much there is to look at in a layout with so many free cells: every start, a run for every sensor that can
/// be missed, and runs that are longer the more cells there are.
pub fn weight((misses, _): Stage, free: u32, agents: u32) -> u64 {
    u64::from(free).saturating_pow(agents + 2 * u32::from(misses) + 1)
}

impl<A: Agents> Lots for Bounds<A> {
    type Stage = Stage;
    type Lot = FloorPlan;
    type Look = Look;
    type Found = Found;
    type Error = Infallible;

    fn stages(&self) -> Vec<Stage> {
        stages(self.max_misses, (self.max_width, self.max_height))
    }

    fn lots(&self, (_, (width, height)): Stage) -> Result<Vec<FloorPlan>, Infallible> {
        Ok(blocked(width, height).collect())
    }

    fn weight(&self, stage: Stage, plan: &FloorPlan) -> u64 {
        weight(stage, plan.free.count_ones(), self.agents)
    }

    fn look(&self, (misses, _): Stage, plan: &FloorPlan, most_steps: u64) -> Result<Look, Infallible> {
        let floors = Floors { way: self.way, plan: *plan, misses };
        Ok(floors.look(self.agents, most_steps.min(MAX_STEPS)))
    }

    fn add(&self, found: &mut Found, _: &FloorPlan, look: Look) -> Result<(), Infallible> {
        found.add(look);
        Ok(())
    }

    fn cover(&self, found: &mut Found, stage: Stage) {
        found.cover(stage, &self.stages());
    }
}

impl Found {
    /// Adds what was found in one layout.
    pub fn add(&mut self, look: Look) {
        self.layouts += 1;
        self.states += look.states;
        self.steps += look.steps;
        let is_smaller = |trap: &Trap| self.trap.as_ref().is_none_or(|smallest| trap.moves < smallest.moves);
        self.trap = look.trap.filter(is_smaller).or(self.trap.take());
    }

    /// All layouts of one of these stages were looked at.
    pub fn cover(&mut self, (misses, area): Stage, stages: &[Stage]) {
        if stages.last().is_some_and(|&(_, last)| last == area) {
            self.levels = misses + 1;
        }
    }

    /// What was found by a search that came to its end, or did not: then no trap is known to be the smallest.
    #[must_use]
    pub fn ended(self, is_complete: bool) -> Self {
        Self { is_complete, trap: self.trap.filter(|_| is_complete), ..self }
    }
}

/// What was found in one layout.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Look {
    /// States of agents and floors, or runs.
    pub states: u64,
    /// Team moves.
    pub steps: u64,
    /// Whether it was looked at to its end.
    pub is_whole: bool,
    /// The smallest trap in it.
    pub trap: Option<Trap>,
}

impl lots::Look for Look {
    fn steps(&self) -> u64 {
        self.steps
    }

    fn is_whole(&self) -> bool {
        self.is_whole
    }

    fn is_enough(&self) -> bool {
        self.trap.is_some()
    }
}

/// An agent on the floor.
#[derive(Clone, PartialEq, Eq, Hash)]
struct Body<M> {
    memory: M,
    cell: Cell,
    is_done: bool,
}

/// A floor and its agents.
type State<M> = small::State<Body<M>>;

/// The floors of one plan: a system whose steps are team moves.
struct Floors<A> {
    way: A,
    plan: FloorPlan,
    misses: u8,
}

impl<A: Agents> Floors<A> {
    /// Looks at every start.
    fn look(&self, agents: u32, most_steps: u64) -> Look {
        let starts: Vec<Vec<Cell>> = self.plan.starts(agents).collect();
        let found = search(self, starts.iter().map(|cells| self.start(cells)), Limits::steps(most_steps));
        let trap = found.broken.first().map(|run| self.trap(&starts, run));
        Look { states: found.states, steps: found.steps, is_whole: found.is_whole, trap }
    }

    fn start(&self, cells: &[Cell]) -> State<A::Memory> {
        let body = |(id, &cell)| Body { memory: self.way.memory(id), cell, is_done: false };
        let mut state = State::start(&self.plan, cells, (0..).zip(cells).map(body).collect());
        self.forget(&mut state);
        state
    }

    /// What no agent ever reads is left out of the state.
    fn forget(&self, state: &mut State<A::Memory>) {
        if !self.way.reads_serials() {
            state.forget_serials();
        }
        if !self.way.reads_crossings() {
            state.forget_crossings();
        } else if state.misses == self.misses {
            self.forget_in_trap(state);
        }
    }

    /// Where agents can get to no unexplored cell any more no sensor is placed any more, so that only the differences
    /// between crossings count.
    fn forget_in_trap(&self, state: &mut State<A::Memory>) {
        let awake = state.bodies.iter().filter(|body| !body.is_done);
        let under =
            awake.filter_map(|body| self.plan.place(body.cell)).fold(0, |set, place| set | 1 << place);
        let mut rest = under | self.marked(state, |mark| self.way.passes(mark));
        let unexplored = self.marked(state, |mark| mark == Mark::Unexplored);
        let shut = shut(&self.plan, &state.sensors);
        let mut least = [0; CELLS];
        while rest != 0 {
            let part = self.plan.spread(rest, shut);
            rest &= !part;
            if part & under == 0 {
                continue;
            }
            if part & unexplored != 0 {
                return;
            }
            let places = || (0..CELLS).filter(|place| part >> place & 1 == 1);
            let fewest = places().map(|place| state.sensors[place].sensor().crossings).min().unwrap_or(0);
            places().for_each(|place| least[place] = fewest);
        }
        for (stored, least) in state.sensors.iter_mut().zip(least).filter(|&(_, least)| least > 0) {
            let sensor = stored.sensor();
            *stored = Stored::new(Sensor { crossings: sensor.crossings - least, ..sensor });
        }
    }

    fn marked(&self, state: &State<A::Memory>, is: impl Fn(Mark) -> bool) -> u16 {
        marked(&self.plan, &state.sensors, is)
    }

    fn is_explored(&self, state: &State<A::Memory>) -> bool {
        self.marked(state, |mark| mark == Mark::Unexplored) == 0
    }

    /// Makes a team move; whether an agent is done in it while a cell is unexplored.
    fn advance(&self, state: &mut State<A::Memory>, world: &mut dyn Oracle) -> bool {
        let mut is_early = false;
        for number in 0..state.bodies.len() {
            let State { sensors, placed, bodies, .. } = &mut *state;
            let body = &mut bodies[number];
            if body.is_done {
                continue;
            }
            let mut floor = Small { plan: &self.plan, sensors, placed };
            let acted = self.way.act(&mut floor, &mut body.memory, body.cell, world);
            (body.cell, body.is_done) = (acted.cell, acted.is_done);
            is_early |= acted.is_done && !self.is_explored(state);
        }
        is_early
    }

    /// Every team move from `state`; none once the run is over.
    fn moves(&self, state: &State<A::Memory>) -> impl Iterator<Item = Moved<A::Memory>> {
        outcomes(|world| {
            if self.awake(state) == 0 || self.is_explored(state) {
                return None;
            }
            let (mut next, mut misses) = (state.clone(), state.misses);
            let eyes = Misses { world, count: &mut misses, most: self.misses };
            let mut questions = Questions { eyes, asked: 0, missed: Vec::new() };
            let is_early = self.advance(&mut next, &mut questions);
            let Questions { asked, missed, .. } = questions;
            next.misses = misses;
            self.forget(&mut next);
            Some(Moved { state: next, is_early, asked, missed })
        })
    }

    /// The trap that `run` is, from one of `starts`.
    fn trap(&self, starts: &[Vec<Cell>], run: &Run<&str>) -> Trap {
        let starts = starts[run.start].clone();
        let mut state = self.start(&starts);
        let (mut asked, mut missed) = (0, Vec::new());
        for &number in &run.steps {
            let Some(moved) = self.moves(&state).nth(number as usize) else { break };
            missed.extend(moved.missed.iter().map(|question| asked + question));
            asked += moved.asked;
            state = moved.state;
        }
        let area = (0..self.plan.width * self.plan.height).map(|place| self.plan.cell(place as usize));
        Trap {
            width: self.plan.width,
            height: self.plan.height,
            blocked: area.filter(|&cell| self.plan.place(cell).is_none()).collect(),
            starts,
            missed,
            moves: run.steps.len() as u32,
            end: if run.demand == ENDLESS { End::Endless } else { End::Done },
        }
    }
}

/// What a team move leads to.
#[derive(Clone)]
struct Moved<M> {
    state: State<M>,
    /// Whether an agent is done in it while a cell is unexplored.
    is_early: bool,
    /// Questions that were asked in it.
    asked: u32,
    /// The numbers of those that were answered yes, counted from 1.
    missed: Vec<u32>,
}

/// Counts the questions, and notes which are answered yes.
struct Questions<'a> {
    eyes: Misses<'a>,
    asked: u32,
    missed: Vec<u32>,
}

impl Oracle for Questions<'_> {
    fn pick(&mut self, below: u32) -> u32 {
        self.eyes.pick(below)
    }

    fn mishap(&mut self) -> bool {
        self.asked += 1;
        let is_missed = self.eyes.mishap();
        self.missed.extend(is_missed.then_some(self.asked));
        is_missed
    }
}

impl<A: Agents> World for Floors<A> {
    type State = State<A::Memory>;
    type Plan = Vec<Moved<A::Memory>>;
    type Event = Moved<A::Memory>;
    type Demand = &'static str;

    fn plan(&self, state: &mut State<A::Memory>, _: &[u8]) -> Option<Self::Plan> {
        let all: Vec<_> = self.moves(state).collect();
        any_of(all)
    }

    fn settle(
        &self,
        state: &mut State<A::Memory>,
        all: &Self::Plan,
        _: &mut Vec<u8>,
        world: &mut impl Oracle,
    ) -> Self::Event {
        let mut turned = picked(all, world);
        std::mem::swap(state, &mut turned.state);
        turned
    }

    fn broken_by(&self, turn: &Turn<'_, Self>) -> Vec<&'static str> {
        if turn.event.is_early { vec![DONE] } else { Vec::new() }
    }
}

impl<A: Agents> System for Floors<A> {
    type Part = Part<Body<A::Memory>>;

    fn places(&self, state: &State<A::Memory>) -> usize {
        state.places()
    }

    fn part(&self, state: &State<A::Memory>, place: usize) -> Part<Body<A::Memory>> {
        state.part(place)
    }

    fn differing(&self, one: &State<A::Memory>, other: &State<A::Memory>) -> Places {
        one.differing(other)
    }

    fn put(&self, state: &mut State<A::Memory>, place: usize, part: &Part<Body<A::Memory>>) {
        state.put(place, part);
    }

    fn broken_by_endless_runs(&self) -> Option<&'static str> {
        Some(ENDLESS)
    }

    /// The team as a whole: all that are not done act in every step.
    fn awake(&self, state: &State<A::Memory>) -> Bits {
        state.bodies.iter().any(|body| !body.is_done).into()
    }
}

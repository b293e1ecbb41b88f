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
use tautline_kernel::floor::Mark;
use tautline_kernel::ground::Cell;

use super::crew::{Scheme, SensorData, Sight};
use super::plans::{CELLS, FloorPlan, blocked};
use super::small::{Misses, PartOf, Small, StateOf};
use crate::engine::cases::{self, Cases};
use crate::engine::states::{Bits, Limits, Places, Run, System, search};
use crate::engine::world::{Turn, World};

/// The bounds of a search.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Bounds<S> {
    /// The scheme of the agents.
    pub scheme: S,
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

/// The outcome of a search.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct TrapReport {
    /// Layouts that were looked at, each counted once, for whatever number of misses.
    pub layouts: u64,
    /// States of agents and floors.
    pub states: u64,
    /// Team moves between them.
    pub steps: u64,
    /// Numbers of misses, from none on, with which every layout was covered.
    pub levels: u16,
    /// Whether the search came to its end: the smallest trap, or all there is within the bounds.
    pub is_complete: bool,
    /// The smallest trap; if the search did not come to its end, one that need not be.
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
pub fn hunt<S: Scheme>(
    bounds: &Bounds<S>,
    watch: &mut dyn FnMut(&TrapReport) -> ControlFlow<()>,
) -> TrapReport {
    match cases::search(bounds, bounds.budget_steps, watch) {
        Ok((report, is_complete)) => report.ended(is_complete),
    }
}

/// Layouts of one area, and the sensors that are missed in each at most.
pub type Stage = (u8, (i16, i16));

impl<S: Scheme> Cases for Bounds<S> {
    type Stage = Stage;
    type Case = FloorPlan;
    type Outcome = LayoutOutcome;
    type Findings = TrapReport;
    type Error = Infallible;

    /// No miss before one, and the smallest area first.
    fn stages(&self) -> Vec<Stage> {
        let mut areas: Vec<(i16, i16)> = (1..=self.max_width)
            .flat_map(|width| (1..=self.max_height).map(move |height| (width, height)))
            .filter(|&(width, height)| width as usize * height as usize <= MAX_CELLS)
            .collect();
        areas.sort_unstable_by_key(|&(width, height)| (width * height, width));
        (0..=self.max_misses).flat_map(|misses| areas.iter().map(move |&area| (misses, area))).collect()
    }

    fn cases(&self, (_, (width, height)): Stage) -> Result<Vec<FloorPlan>, Infallible> {
        Ok(blocked(width, height).collect())
    }

    /// Every start, a run for every sensor that can be missed, and runs that are longer the more cells there are.
    fn weight(&self, (misses, _): Stage, plan: &FloorPlan) -> u64 {
        u64::from(plan.free.count_ones()).saturating_pow(self.agents + 2 * u32::from(misses) + 1)
    }

    fn examine(
        &self,
        (misses, _): Stage,
        plan: &FloorPlan,
        most_steps: u64,
    ) -> Result<LayoutOutcome, Infallible> {
        let floors = Floors { scheme: self.scheme, plan: *plan, misses };
        Ok(floors.examine(self.agents, most_steps.min(MAX_STEPS)))
    }

    fn add(&self, report: &mut TrapReport, _: &FloorPlan, outcome: LayoutOutcome) -> Result<(), Infallible> {
        report.layouts += u64::from(report.levels == 0);
        report.states += outcome.states;
        report.steps += outcome.steps;
        let is_smaller =
            |trap: &Trap| report.trap.as_ref().is_none_or(|smallest| trap.moves < smallest.moves);
        report.trap = outcome.trap.filter(is_smaller).or(report.trap.take());
        Ok(())
    }

    fn cover(&self, report: &mut TrapReport, (misses, area): Stage) {
        if self.stages().last().is_some_and(|&(_, last)| last == area) {
            report.levels = u16::from(misses) + 1;
        }
    }
}

impl TrapReport {
    /// The outcome of a search that came to its end, or did not.
    #[must_use]
    pub fn ended(self, is_complete: bool) -> Self {
        Self { is_complete, ..self }
    }
}

/// The outcome of a search of one layout.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LayoutOutcome {
    /// States of agents and floors.
    pub states: u64,
    /// Team moves.
    pub steps: u64,
    /// Whether it was looked at to its end.
    pub is_whole: bool,
    /// The smallest trap in it.
    pub trap: Option<Trap>,
}

impl cases::Outcome for LayoutOutcome {
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

/// The floors of one plan: a world whose steps are team moves.
struct Floors<S> {
    scheme: S,
    plan: FloorPlan,
    misses: u8,
}

/// A team move.
struct TeamMove {
    /// Whether an agent is done in it while a cell is unexplored.
    is_early: bool,
    /// How many questions were asked in it.
    asked: u32,
    /// Those that were answered yes: a bit for each, the first lowest.
    missed: u32,
}

impl<S: Scheme> Floors<S> {
    /// The outcome from every start.
    fn examine(&self, agents: u32, most_steps: u64) -> LayoutOutcome {
        let starts: Vec<Vec<Cell>> = self.plan.starts(agents).collect();
        let found = search(self, starts.iter().map(|cells| self.start(cells)), Limits::steps(most_steps));
        let trap = found.broken.first().map(|run| self.trap(&starts, run));
        LayoutOutcome { states: found.states, steps: found.steps, is_whole: found.is_whole, trap }
    }

    fn start(&self, cells: &[Cell]) -> StateOf<S> {
        let mut state = StateOf::<S>::start(&self.scheme, &self.plan, cells);
        self.forget(&mut state);
        state
    }

    /// Leaves out of the state what no agent ever reads.
    fn forget(&self, state: &mut StateOf<S>) {
        if !self.scheme.reads_serials(Sight::Partial) {
            state.sensors.forget_serials();
        }
        if !self.scheme.reads_crossings(Sight::Partial) {
            state.sensors.count_to(0);
        } else if state.misses == self.misses {
            self.forget_in_trap(state);
        }
    }

    /// Where agents can get to no unexplored cell any more no sensor is placed any more, so that only the differences
    /// between crossings count.
    fn forget_in_trap(&self, state: &mut StateOf<S>) {
        let awake = state.bodies.iter().filter(|body| body.is_awake());
        let under =
            awake.filter_map(|body| self.plan.place(body.cell)).fold(0, |set, place| set | 1 << place);
        let mut rest = under | state.sensors.cells(&self.plan, |sensor| self.scheme.passes(sensor.mark()));
        let unexplored = state.sensors.cells(&self.plan, |sensor| sensor.mark() == Mark::Unexplored);
        let shut = state.sensors.shut(&self.plan);
        let mut spare = [0; CELLS];
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
            let fewest = places().map(|place| state.sensors.all[place].crossings()).min().unwrap_or(0);
            places().for_each(|place| spare[place] = fewest.saturating_sub(S::Sensor::ALIKE_FROM));
        }
        for (sensor, spare) in state.sensors.all.iter_mut().zip(spare).filter(|&(_, spare)| spare > 0) {
            *sensor = sensor.with_crossings(sensor.crossings() - spare);
        }
    }

    /// The trap that `run` is, from one of `starts`.
    fn trap(&self, starts: &[Vec<Cell>], run: &Run<&str>) -> Trap {
        let starts = starts[run.start].clone();
        let (mut asked, mut missed) = (0, Vec::new());
        for (_, made) in run.played(self, self.start(&starts)).take(run.steps.len()) {
            let made = made.event;
            let is_missed = |question: &u32| made.missed >> question & 1 == 1;
            missed.extend((0..made.asked).filter(is_missed).map(|question| asked + question + 1));
            asked += made.asked;
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

impl<S: Scheme> World for Floors<S> {
    type State = StateOf<S>;
    type Plan = ();
    type Event = TeamMove;
    type Demand = &'static str;

    fn plan(&self, state: &mut StateOf<S>, _: &[u8]) -> Option<()> {
        (state.awake() != 0 && !state.sensors.is_explored(&self.plan)).then_some(())
    }

    fn settle(&self, state: &mut StateOf<S>, (): &(), _: &mut Vec<u8>, world: &mut impl Oracle) -> TeamMove {
        let mut is_early = false;
        let mut misses = Misses::new(world, &mut state.misses, self.misses);
        for body in state.bodies.iter_mut().filter(|body| body.is_awake()) {
            let mut floor = Small { plan: &self.plan, sensors: &mut state.sensors, dark: 0 };
            let view = S::Sensor::look(&floor, body.cell, &mut misses);
            let act = self.scheme.decide(&mut body.memory, &view);
            body.carry_out(&self.scheme, &mut floor, &act);
            is_early |= body.is_done && !state.sensors.is_explored(&self.plan);
        }
        let Misses { asked, missed, .. } = misses;
        self.forget(state);
        TeamMove { is_early, asked, missed }
    }

    fn broken_by(&self, turn: &Turn<'_, Self>) -> Vec<&'static str> {
        if turn.event.is_early { vec![DONE] } else { Vec::new() }
    }
}

impl<S: Scheme> System for Floors<S> {
    type Part = PartOf<S>;

    fn places(&self, state: &StateOf<S>) -> usize {
        state.places()
    }

    fn part(&self, state: &StateOf<S>, place: usize) -> PartOf<S> {
        state.part(place)
    }

    fn differing(&self, one: &StateOf<S>, other: &StateOf<S>) -> Places {
        one.differing(other)
    }

    fn put(&self, state: &mut StateOf<S>, place: usize, part: &PartOf<S>) {
        state.put(place, part);
    }

    fn broken_by_endless_runs(&self) -> Option<&'static str> {
        Some(ENDLESS)
    }

    /// The team as a whole: all that are not done act in every step.
    fn awake(&self, state: &StateOf<S>) -> Bits {
        (state.awake() != 0).into()
    }
}

//! Ants on small floors, as systems whose states are all looked at (ANTS-1): which agent acts next and which sensors
//! it misses are choices. A run is over when every cell is explored, since crossings go on to grow for ever.

use tautline_kernel::ants::{Rule, act};
use tautline_kernel::choice::Oracle;
use tautline_kernel::floor::{Mark, Scan, Sensor};
use tautline_kernel::ground::Cell;

use crate::decide::{Answer, Context, Depiction, Evidence, Method, MethodError, RefutationPlay};
use crate::engine::states::{Bits, Limits, Places, System};
use crate::engine::world::{Turn, World};
use crate::engine::{Choices, Script, ScriptError, Until};
use crate::floor::look::Explored;
use crate::floor::plans::{Area, FloorPlan};
use crate::floor::small::{self, Misses, Part, Small, Stored, marked};

/// Ants that are observed.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) struct Observed {
    /// The rule that they follow.
    pub rule: Rule,
    /// Whether sensors count crossings; a mutant's do not.
    pub counts: bool,
}

/// Every state of ants on small floors.
pub(super) struct SmallFloors;

struct Colony {
    plan: FloorPlan,
    observed: Observed,
    max_misses: u8,
}

/// The state of a floor and the cells of its ants.
type State = small::State<Cell>;

impl Colony {
    fn starts(&self, ants: u32) -> Vec<State> {
        let start = |ants: Vec<Cell>| {
            let mut state = State::start(&self.plan, &ants.clone(), ants);
            state.forget_serials();
            state
        };
        self.plan.starts(ants).map(start).collect()
    }

    fn is_explored(&self, state: &State) -> bool {
        marked(&self.plan, &state.sensors, |mark| mark == Mark::Unexplored) == 0
    }
}

impl World for Colony {
    type State = State;
    type Plan = ();
    /// The ant that acts.
    type Event = u32;
    type Demand = &'static str;

    fn plan(&self, state: &mut State, _: &[u8]) -> Option<()> {
        (!self.is_explored(state)).then_some(())
    }

    fn settle(&self, state: &mut State, (): &(), _: &mut Vec<u8>, world: &mut impl Oracle) -> u32 {
        let ant = if state.bodies.len() > 1 { world.pick(state.bodies.len() as u32) } else { 0 };
        let cell = state.bodies[ant as usize];
        let mut floor = Small { plan: &self.plan, sensors: &mut state.sensors, placed: &mut state.placed };
        let mut world = Misses { world, count: &mut state.misses, most: self.max_misses };
        let scan = Scan::new(&floor, cell, &mut world);
        if let Some(side) = act(self.observed.rule, &mut floor, cell, &scan) {
            state.bodies[ant as usize] = cell.beyond(side);
        }
        state.forget_serials();
        if !self.observed.counts {
            let once = |sensor: Sensor| Sensor { crossings: sensor.crossings.min(1), ..sensor };
            state.sensors = state.sensors.map(|sensor| Stored::new(once(sensor.sensor())));
        }
        ant
    }

    fn broken_by(&self, _: &Turn<'_, Self>) -> Vec<&'static str> {
        Vec::new()
    }
}

impl System for Colony {
    type Part = Part<Cell>;

    fn places(&self, state: &State) -> usize {
        state.places()
    }

    fn part(&self, state: &State, place: usize) -> Part<Cell> {
        state.part(place)
    }

    fn differing(&self, one: &State, other: &State) -> Places {
        one.differing(other)
    }

    fn put(&self, state: &mut State, place: usize, part: &Part<Cell>) {
        state.put(place, part);
    }

    fn acting(&self, turn: &Turn<'_, Self>) -> Bits {
        1 << turn.event
    }

    fn broken_by_endless_runs(&self) -> Option<&'static str> {
        Some("every cell is explored: no run goes on for ever before")
    }

    fn awake(&self, state: &State) -> Bits {
        (1 << state.bodies.len()) - 1
    }
}

/// Ants on all plans of an area, in any of their cells.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
struct Series {
    area: Area,
    ants: u32,
    max_misses: u8,
}

const SERIES: [Series; 3] = [
    Series { area: Area::blocked(4, 4), ants: 1, max_misses: 0 },
    Series { area: Area::blocked(3, 3), ants: 1, max_misses: 2 },
    Series { area: Area::blocked(3, 2), ants: 2, max_misses: 0 },
];

impl Series {
    fn colonies(self, observed: Observed) -> Vec<Colony> {
        let Self { area, ants: _, max_misses } = self;
        let colony = |plan| Colony { plan, observed, max_misses };
        area.plans().map(colony).collect()
    }
}

impl Method<Observed> for SmallFloors {
    fn engine(&self) -> &'static str {
        "states"
    }

    fn bound(&self) -> String {
        let words = |Series { area, ants, max_misses }: Series| {
            let missed = if max_misses > 0 { format!(", {max_misses} missed") } else { String::new() };
            let who = if ants == 1 { "ant" } else { "ants" };
            format!("{ants} {who} to {area}{missed}")
        };
        SERIES.map(words).join("; ")
    }

    /// The choices of a violation are as those of [`Explored`].
    fn decide(
        &self,
        observed: &Observed,
        until: Until,
        desk: &mut Context<'_, '_>,
    ) -> Result<Answer, MethodError> {
        let limits = Limits { room: desk.room, ..Limits::NONE };
        let mut explored = Explored::new();
        for (number, series) in (0..).zip(SERIES) {
            let colonies = series.colonies(*observed);
            let starts = |colony: &Colony| colony.starts(series.ants);
            if let Some((_, run)) = explored.look(number, &colonies, starts, (limits, until)) {
                explored.again = run.round().to_vec();
                break;
            }
        }
        Ok(explored.answer(self.shows()))
    }

    fn replay(&self, observed: &Observed, choices: &Choices) -> Result<RefutationPlay, ScriptError> {
        let mut script = Script::new(choices);
        let series = SERIES[script.choose(SERIES.len())?];
        let colonies = series.colonies(*observed);
        let colony = &colonies[script.choose(colonies.len())?];
        let mut starts = colony.starts(series.ants);
        let number = script.choose(starts.len())?;
        let (of, run) = script.play(colony, (number, starts.swap_remove(number)), |_| true)?;
        let evidence = Evidence { choices: choices.clone(), demand: run.demand, seen: Depiction::Choices };
        Ok(RefutationPlay { of, evidence })
    }
}

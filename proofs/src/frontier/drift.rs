//! One robot whose fixes are off by a part of a cell (FRONTIER-5): where it really is, and where it takes itself to be.
//! The obstacles are decided as they are met. An error is 0 or the greatest there is, along each axis.

use std::ops::ControlFlow;

use tautline_kernel::choice::Oracle;
use tautline_kernel::frontier::{
    Condition, HALF, Map, Next, Place, Robot, Rule, SIDE, Sight, Slot, Status, TinyMap, View, clamped,
    taken_for,
};
use tautline_kernel::ground::{Area, Cell};

use super::areas::Size;
use super::world::Demand;
use crate::engine::states::{Run, System, steps};
use crate::engine::world::{Turn, World, any_of, bit, picked};
use crate::engine::{Choices, Replay, outcomes};
use crate::judge::frontier::{Drift as Written, Move};
use crate::judge::{AnyCase, Floor};
use crate::run::place;

/// The parts of a cell's side in which an error is told.
pub const PARTS: i32 = 16;

/// One robot with wrong fixes.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Drift {
    /// Its rule.
    pub rule: Rule,
    /// How far a fix is off at most along each axis, in 1/[`PARTS`] of a cell.
    pub error: u8,
    /// Most obstacles that are met in one run.
    pub max_obstacles: u8,
}

/// The robot, and what is decided of its area.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub struct State {
    robot: Robot<TinyMap>,
    /// Where it really is.
    place: Place,
    /// Where it takes itself to be.
    fix: Place,
    /// The cells entered, and the obstacles that were met.
    truth: TinyMap,
}

/// The cell that a place is in.
fn cell_of(place: Place) -> Cell {
    let line = |coordinate: i32| coordinate.saturating_add(HALF).div_euclid(SIDE) as i16;
    Cell::new(line(place.x), line(place.y))
}

impl Drift {
    /// Every start in areas of these sizes: the robot at the midpoint of any cell, with any first fix.
    pub fn starts(&self, sizes: &[Size]) -> Vec<State> {
        let areas = sizes
            .iter()
            .filter_map(|&(width, height)| Area::new(Cell::new(0, 0), Cell::new(width - 1, height - 1)));
        let mut starts = Vec::new();
        for area in areas {
            let Some(map) = TinyMap::new(area) else { continue };
            for cell in area.cells() {
                let place = Place::midpoint(cell);
                let mut truth = map;
                truth.learn(cell, Status::Explored);
                // The start is known; how far from its midpoint the robot is is not.
                let robot = Robot::new(map, cell, &[cell]);
                starts.extend(outcomes(|oracle| {
                    let fix = clamped(cell, self.fix(place, oracle));
                    Some(State { robot, place, fix, truth })
                }));
            }
        }
        starts
    }

    /// The events of a run in one area, a line for each move, and how many obstacles it meets.
    pub fn story(&self, area: Size, run: &Run<&'static str>) -> (String, usize) {
        let Some(mut state) = self.starts(&[area]).into_iter().nth(run.start) else {
            return (String::new(), 0);
        };
        let mut lines = format!("{}×{} cells, it starts in {}\n", area.0, area.1, state.robot.at());
        for (before, step) in run.played(self, state) {
            lines += &tell(&before, &step.state);
            lines.push('\n');
            state = step.state;
        }
        (lines, state.truth.obstacles() as usize)
    }

    /// A fix of a robot at `place`.
    fn fix(&self, place: Place, oracle: &mut dyn Oracle) -> Place {
        let error = i32::from(self.error) * SIDE / PARTS;
        let mut off = || (oracle.pick(3) as i32 + 1) % 3 - 1;
        Place::new(place.x + off() * error, place.y + off() * error)
    }

    /// The robot's next action.
    fn next(&self, state: &State, oracle: &mut dyn Oracle) -> Next {
        super::next::<1>(&state.robot, &self.rule, View { others: &[], slot: Slot::Own }, oracle)
    }

    /// The run that these choices make in areas of these sizes by the published rule, written down for the judge.
    pub(super) fn case(&self, sizes: &[Size], choices: &Choices) -> Option<Box<dyn AnyCase>> {
        let mut numbers = choices.all();
        let start = self.starts(sizes).into_iter().nth(numbers.next()? as usize)?;
        let sixteenths = |place: Place, from: Place| {
            let part = |far: i32| far * PARTS / SIDE;
            (part(place.x - from.x), part(place.y - from.y))
        };
        let (mut state, mut moves) = (start, Vec::new());
        for number in numbers {
            // The published rule leaves nothing to choose.
            let Next::Tries { side, .. } = self.next(&state, &mut Replay::new(&[])) else { return None };
            let step = steps(self, &state).nth(number as usize)?;
            let is_arrival = step.state.place != state.place;
            state = step.state;
            let off = is_arrival.then(|| sixteenths(state.fix, state.place));
            moves.push(Move { side: side as usize, off });
        }
        let area = state.truth.area();
        let is_barred = |cell: &Cell| state.truth.status(*cell) == Status::Obstacle;
        let barred = area.cells().filter(is_barred).map(place).collect();
        Some(Box::new(Written {
            clause: Demand::Marks.clause(),
            floor: Floor { columns: area.width() as i32, rows: area.height() as i32, barred },
            error: self.error.into(),
            start: place(start.robot.at()),
            off: sixteenths(start.fix, start.place),
            moves,
        }))
    }

    /// A move, and the fix after it; `None` if there is none.
    fn go(&self, state: &State, oracle: &mut dyn Oracle) -> Option<(State, &'static str)> {
        let mut after = *state;
        let Next::Tries { side, aim } = self.next(state, oracle) else { return None };
        after.robot.decided(&self.rule, &[]);
        after.robot.tries(side, aim);
        let to = state.place.moved(state.fix, Place::midpoint(state.robot.at().beyond(side)));
        let way = self.way(&mut after.truth, state.place, to, oracle);
        if way.is_break() {
            after.robot.looked(&self.rule, Sight::Obstacle);
            return Some((after, "an obstacle"));
        }
        after.robot.looked(&self.rule, Sight::Open);
        after.place = to;
        let fix = self.fix(to, oracle);
        after.robot.arrived(&self.rule, taken_for(after.truth.area(), fix));
        let at = after.robot.at();
        after.fix = if self.rule.has(Condition::Track) { clamped(at, fix) } else { fix };
        Some((after, "an arrival"))
    }

    /// Goes from one place to another, and breaks off at an obstacle.
    fn way(&self, truth: &mut TinyMap, from: Place, to: Place, oracle: &mut dyn Oracle) -> ControlFlow<()> {
        let parts = from.distance(to) as i32 + 1;
        let at = |part: i32| {
            let along = |from: i32, to: i32| from + (to - from) * part / parts;
            cell_of(Place::new(along(from.x, to.x), along(from.y, to.y)))
        };
        let mut last = at(0);
        for cell in (1..=parts).map(at) {
            if cell == last {
                continue;
            }
            last = cell;
            let is_blocked = match truth.status(cell) {
                Status::Explored => false,
                Status::Obstacle | Status::Body => true,
                Status::Unexplored => truth.obstacles() < self.max_obstacles.into() && oracle.mishap(),
            };
            if is_blocked {
                truth.learn(cell, Status::Obstacle);
                return ControlFlow::Break(());
            }
            truth.learn(cell, Status::Explored);
        }
        ControlFlow::Continue(())
    }
}

/// The situations that occur.
const SITUATIONS: [&str; 2] = ["an arrival", "an obstacle"];

impl World for Drift {
    type State = State;
    type Plan = Vec<(State, &'static str)>;
    type Event = &'static str;
    type Demand = &'static str;

    fn plan(&self, state: &mut State, _: &[u8]) -> Option<Self::Plan> {
        let all: Vec<_> = outcomes(|oracle| self.go(state, oracle)).collect();
        any_of(all)
    }

    fn settle(
        &self,
        state: &mut State,
        all: &Self::Plan,
        _: &mut Vec<u8>,
        world: &mut impl Oracle,
    ) -> &'static str {
        let (after, situation) = picked(all, world);
        *state = after;
        situation
    }

    fn broken_by(&self, turn: &Turn<'_, Self>) -> Vec<&'static str> {
        let is_right = turn.after.robot.map.is_within(&turn.after.truth);
        if is_right { Vec::new() } else { vec![Demand::Marks.words()] }
    }

    fn covers(&self) -> Vec<&'static str> {
        SITUATIONS.to_vec()
    }

    fn occurs(&self, turn: &Turn<'_, Self>) -> u64 {
        bit(&SITUATIONS, turn.event)
    }
}

impl System for Drift {
    type Part = State;

    fn part(&self, state: &State, _: usize) -> State {
        *state
    }

    fn put(&self, state: &mut State, _: usize, part: &State) {
        *state = *part;
    }
}

/// A step in words.
pub(super) fn tell(before: &State, after: &State) -> String {
    let parts = |place: Place, cell: Cell| {
        let middle = Place::midpoint(cell);
        let part = |far: i32| far * PARTS / SIDE;
        (part(place.x - middle.x), part(place.y - middle.y))
    };
    let area = before.truth.area();
    let (cell, at) = (cell_of(after.place), after.robot.at());
    let ((x, y), (fix_x, fix_y)) = (parts(after.place, cell), parts(after.fix, cell));
    let blocked = area.cells().find(|&cell| {
        after.robot.map.status(cell) == Status::Obstacle && before.robot.map.status(cell) != Status::Obstacle
    });
    match blocked {
        Some(blocked) => {
            format!("it is in {cell}, takes itself to be in {at}, and takes {blocked} for an obstacle")
        }
        None => format!(
            "it arrives in {cell}, {x} and {y} sixteenths east and south of the midpoint; its fix says {fix_x} and \
             {fix_y}, and it takes itself to be in {at}"
        ),
    }
}

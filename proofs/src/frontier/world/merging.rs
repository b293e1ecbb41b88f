//! The team as a world whose ways merge: what its states are made of, and what may happen next.

use tautline_kernel::choice::Oracle;
use tautline_kernel::frontier::{Other, Robot, Sight, TinyMap};
use tautline_kernel::ground::Cell;

use super::{Demand, Event, Setting, Successor, World};
use crate::engine::states::{self, Bits, Places, System};
use crate::engine::world::{self, Turn};
use crate::frontier::has_more;

/// A part of a world.
#[derive(Clone, PartialEq, Eq, Hash)]
pub enum Part<const ROBOTS: usize> {
    /// A repository, or the truth.
    Map(TinyMap),
    /// A robot but for its repository, where it really is, what the others have told it, and whether it is on its way
    /// to its frontier cell.
    Robot(Robot<TinyMap>, Cell, [Option<Other>; ROBOTS], bool),
    /// The mishaps so far, and the slot.
    Clock([u8; 7]),
}

/// All of a world that is no robot's and no map.
fn clock<const ROBOTS: usize>(world: &World<ROBOTS>) -> [u8; 7] {
    [world.lost, world.wrong, world.small, world.dead, world.slot, world.old, world.has_tried.into()]
}

/// The situations that occur.
const SITUATIONS: [&str; 9] = [
    "a decision",
    "a robot",
    "a slot",
    "an arrival",
    "an obstacle",
    "an open cell",
    "a small obstacle",
    "a way back",
    "a body",
];

impl<const ROBOTS: usize> world::World for Setting<ROBOTS> {
    type State = World<ROBOTS>;
    type Plan = Vec<Successor<ROBOTS>>;
    type Event = usize;
    type Demand = Demand;

    fn plan(&self, state: &mut World<ROBOTS>, _: &[u8]) -> Option<Vec<Successor<ROBOTS>>> {
        world::any_of(self.turns(state))
    }

    fn settle(
        &self,
        state: &mut World<ROBOTS>,
        turns: &Vec<Successor<ROBOTS>>,
        _: &mut Vec<u8>,
        world: &mut impl Oracle,
    ) -> usize {
        let number = world.pick(turns.len() as u32) as usize;
        *state = turns[number].world;
        number
    }

    fn broken_by(&self, turn: &Turn<'_, Self>) -> Vec<Demand> {
        turn.plan[*turn.event].breaks.clone()
    }

    fn broken_at_end(&self, state: &World<ROBOTS>, _: &[u8]) -> Vec<Demand> {
        let covers = !self.is_wanted(Demand::Covers) || !self.is_owed(state);
        let knows_all = |robot: &Robot<TinyMap>| !has_more(&robot.map, robot.at());
        let all_know = || state.living().all(|robot| knows_all(&state.robots[robot]));
        let knows = !self.is_wanted(Demand::Knows) || all_know();
        [(covers, Demand::Covers), (knows, Demand::Knows)]
            .into_iter()
            .filter_map(|(is_kept, demand)| (!is_kept).then_some(demand))
            .collect()
    }

    fn covers(&self) -> Vec<&'static str> {
        SITUATIONS.to_vec()
    }

    fn occurs(&self, turn: &Turn<'_, Self>) -> u64 {
        match turn.plan[*turn.event].event {
            Event::Decides(..) => 1,
            Event::Dies(_) => 0,
            Event::Looks(_, _, Sight::Robot, ..) => 1 << 1,
            Event::Ticks => 1 << 2,
            Event::Arrives(..) => 1 << 3,
            Event::Looks(_, _, Sight::Obstacle, ..) => 1 << 4,
            Event::Looks(_, _, Sight::Open, ..) => 1 << 5,
            Event::Looks(_, _, Sight::Small, ..) => 1 << 6,
            Event::Returns(..) => 1 << 7,
            Event::Looks(_, _, Sight::Silent, ..) => 1 << 8,
        }
    }
}

impl<const ROBOTS: usize> System for Setting<ROBOTS> {
    type Part = Part<ROBOTS>;

    fn places(&self, _: &World<ROBOTS>) -> usize {
        2 * ROBOTS + 2
    }

    fn part(&self, state: &World<ROBOTS>, place: usize) -> Part<ROBOTS> {
        match place.checked_sub(ROBOTS) {
            None => Part::Map(state.robots[place].map),
            Some(robot) if robot < ROBOTS => {
                let (bare, cell, told) = (self.bare(state, robot), state.cells[robot], state.told[robot]);
                Part::Robot(bare, cell, told, state.heading[robot])
            }
            Some(rest) if rest == ROBOTS => Part::Map(state.truth),
            Some(_) => Part::Clock(clock(state)),
        }
    }

    fn differing(&self, one: &World<ROBOTS>, other: &World<ROBOTS>) -> Places {
        let robots = || one.robots.iter().zip(&other.robots);
        let maps = robots().map(|(one, other)| one.map != other.map);
        let rest = robots().enumerate().map(|(robot, (its, others))| {
            one.cells[robot] != other.cells[robot]
                || one.heading[robot] != other.heading[robot]
                || one.told[robot] != other.told[robot]
                || its != others && self.bare(one, robot) != self.bare(other, robot)
        });
        states::places(maps.chain(rest).chain([one.truth != other.truth, clock(one) != clock(other)]))
    }

    fn put(&self, state: &mut World<ROBOTS>, place: usize, part: &Part<ROBOTS>) {
        match part {
            Part::Map(map) if place < ROBOTS => state.robots[place].map = *map,
            Part::Map(map) => state.truth = *map,
            Part::Robot(bare, cell, told, is_heading) => {
                let robot = place - ROBOTS;
                let map = state.robots[robot].map;
                (state.robots[robot], state.cells[robot], state.told[robot]) = (*bare, *cell, *told);
                (state.robots[robot].map, state.heading[robot]) = (map, *is_heading);
            }
            Part::Clock([lost, wrong, small, dead, slot, old, has_tried]) => {
                (state.lost, state.wrong, state.small, state.dead) = (*lost, *wrong, *small, *dead);
                (state.slot, state.old, state.has_tried) = (*slot, *old, *has_tried == 1);
            }
        }
    }

    fn acting(&self, turn: &Turn<'_, Self>) -> Bits {
        match turn.plan[*turn.event].event {
            Event::Decides(robot, ..)
            | Event::Looks(robot, ..)
            | Event::Returns(robot, _)
            | Event::Arrives(robot, ..) => 1 << robot,
            Event::Ticks => 1 << ROBOTS,
            Event::Dies(_) => 0,
        }
    }

    fn broken_by_endless_runs(&self) -> Option<Demand> {
        self.is_wanted(Demand::Ends).then_some(Demand::Ends)
    }

    /// Robots under way and those that may decide, and the clock.
    fn awake(&self, state: &World<ROBOTS>) -> Bits {
        let moving = Bits::from(state.moving());
        let deciding = state.living().filter(|&robot| self.may_decide(state, robot));
        let robots = deciding.fold(moving, |set, robot| set | 1 << robot);
        robots | Bits::from(self.ticks(state)) << ROBOTS
    }

    fn is_enough(&self, _: Demand) -> bool {
        self.demand.is_some()
    }
}

impl<const ROBOTS: usize> Setting<ROBOTS> {
    /// A robot without its repository.
    pub(super) fn bare(&self, world: &World<ROBOTS>, robot: usize) -> Robot<TinyMap> {
        let mut bare = world.robots[robot];
        bare.map = TinyMap::new(self.area).unwrap_or(world.truth);
        bare
    }
}

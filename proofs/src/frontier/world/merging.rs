//! The team as a world whose ways merge: what its states are made of, and what may happen next.

use tautline_kernel::choice::Oracle;
use tautline_kernel::frontier::{Next, Sight, TinyMap};

use super::{Demand, Event, Setting, Successor, World};
use crate::engine::states::{self, Bits, Places, System};
use crate::engine::world::{self, Turn};

/// A part of a world.
#[derive(Clone, PartialEq, Eq, Hash)]
pub enum Part<const ROBOTS: usize> {
    /// A repository, or the truth.
    Map(TinyMap),
    /// All but the maps.
    Rest(Box<World<ROBOTS>>),
}

/// The situations that occur.
const SITUATIONS: [&str; 7] =
    ["a decision", "a robot", "a slot", "an arrival", "an obstacle", "an open cell", "a small obstacle"];

impl<const ROBOTS: usize> world::World for Setting<ROBOTS> {
    type State = World<ROBOTS>;
    type Plan = Vec<Successor<ROBOTS>>;
    type Event = Successor<ROBOTS>;
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
    ) -> Successor<ROBOTS> {
        let turned = world::picked(turns, world);
        *state = turned.world;
        turned
    }

    fn broken_by(&self, turn: &Turn<'_, Self>) -> Vec<Demand> {
        turn.event.breaks.clone()
    }

    fn broken_at_end(&self, state: &World<ROBOTS>, _: &[u8]) -> Vec<Demand> {
        let covers = !self.is_wanted(Demand::Covers) || !self.is_owed(state);
        let all_know = || (0..ROBOTS).all(|robot| self.would(state, robot) == Next::Done);
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
        match turn.event.event {
            Event::Decides(..) => 1,
            Event::Looks(_, _, Sight::Robot, ..) => 1 << 1,
            Event::Ticks => 1 << 2,
            Event::Arrives(..) => 1 << 3,
            Event::Looks(_, _, Sight::Obstacle, ..) => 1 << 4,
            Event::Looks(_, _, Sight::Open, ..) => 1 << 5,
            Event::Looks(_, _, Sight::Small, ..) => 1 << 6,
        }
    }
}

impl<const ROBOTS: usize> System for Setting<ROBOTS> {
    type Part = Part<ROBOTS>;

    fn places(&self, _: &World<ROBOTS>) -> usize {
        ROBOTS + 2
    }

    fn part(&self, state: &World<ROBOTS>, place: usize) -> Part<ROBOTS> {
        match place.checked_sub(ROBOTS) {
            None => Part::Map(*state.robots[place].map()),
            Some(0) => Part::Map(state.truth),
            Some(_) => {
                let mut bare = *state;
                if let Some(blank) = TinyMap::new(self.area) {
                    bare.truth = blank;
                    bare.robots.iter_mut().for_each(|robot| *robot.map_mut() = blank);
                }
                Part::Rest(Box::new(bare))
            }
        }
    }

    fn differing(&self, one: &World<ROBOTS>, other: &World<ROBOTS>) -> Places {
        let maps = one.robots.iter().zip(&other.robots).map(|(one, other)| one.map() != other.map());
        states::places(maps.chain([one.truth != other.truth, true]))
    }

    fn put(&self, state: &mut World<ROBOTS>, place: usize, part: &Part<ROBOTS>) {
        match part {
            Part::Map(map) if place == ROBOTS => state.truth = *map,
            Part::Map(map) => *state.robots[place].map_mut() = *map,
            Part::Rest(rest) => {
                let (truth, maps) = (state.truth, state.robots.map(|robot| *robot.map()));
                *state = **rest;
                state.truth = truth;
                for (robot, map) in state.robots.iter_mut().zip(maps) {
                    *robot.map_mut() = map;
                }
            }
        }
    }

    fn acting(&self, turn: &Turn<'_, Self>) -> Bits {
        match turn.event.event {
            Event::Decides(robot, ..) | Event::Looks(robot, ..) | Event::Arrives(robot, ..) => 1 << robot,
            Event::Ticks => 1 << ROBOTS,
        }
    }

    fn broken_by_endless_runs(&self) -> Option<Demand> {
        self.is_wanted(Demand::Ends).then_some(Demand::Ends)
    }

    /// Robots under way and those that may decide, and the clock.
    fn awake(&self, state: &World<ROBOTS>) -> Bits {
        let moving = Bits::from(state.moving());
        let deciding = (0..ROBOTS).filter(|&robot| self.may_decide(state, robot));
        let robots = deciding.fold(moving, |set, robot| set | 1 << robot);
        robots | Bits::from(self.ticks(state)) << ROBOTS
    }

    fn is_enough(&self, _: Demand) -> bool {
        self.demand.is_some()
    }
}

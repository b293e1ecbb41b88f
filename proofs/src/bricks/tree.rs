//! Agents that search in trees on small floors (BRICKS-2 to BRICKS-14): brick-tree, helpers and MDFS, as schemes whose
//! states are all looked at.

pub(super) mod children;
mod demands;
pub(super) mod labels;
pub mod mdfs;

use std::fmt;
use std::hash::Hash;

use tautline_kernel::bricks::tree::{
    Act, Agent, Condition, Next, Note, Rule, State, View, carry_out, settle,
};
use tautline_kernel::choice::Oracle;
use tautline_kernel::floor::{Floor, Mark, Scan};
use tautline_kernel::ground::{Cell, Side, Step};

pub(super) use self::demands::{Own, To, TravelRule};
use crate::floor::crew::{Scheme, SensorData, Sight};

/// A rule by which agents search in trees.
pub trait TreeRule: Copy + PartialEq + fmt::Debug + Send + Sync + 'static {
    /// The memory of an agent.
    type Memory: Copy + Eq + Hash + fmt::Debug + Send + Sync + 'static;

    /// The memory of the agent with this id at the start.
    fn memory(&self, id: u8) -> Self::Memory;

    /// The decision of an agent after a scan.
    fn decide(&self, memory: &mut Self::Memory, view: &View) -> Act;

    /// The rule by which decisions are written.
    fn writes(&self) -> Rule;

    /// The trees that an agent has founded.
    fn founded(memory: &Self::Memory) -> u32;
}

impl TreeRule for Rule {
    type Memory = Agent;

    fn memory(&self, id: u8) -> Agent {
        Agent::new(id)
    }

    fn decide(&self, agent: &mut Agent, view: &View) -> Act {
        agent.decide(*self, view)
    }

    fn writes(&self) -> Rule {
        *self
    }

    fn founded(agent: &Agent) -> u32 {
        agent.founded
    }
}

impl<T: TreeRule> Scheme for T {
    type Sensor = Note;
    type Memory = T::Memory;
    type Act = Act;

    fn memory(&self, id: u8) -> T::Memory {
        TreeRule::memory(self, id)
    }

    fn decide(&self, memory: &mut T::Memory, view: &View) -> Act {
        TreeRule::decide(self, memory, view)
    }

    fn carry_out(&self, floor: &mut impl Floor<Note>, cell: Cell, act: &Act) -> Cell {
        carry_out(self.writes(), floor, cell, act)
    }

    fn is_left(&self, mark: Mark) -> bool {
        mark != Mark::Visited
    }

    fn step(act: &Act) -> Option<Step> {
        (act.next != Next::Done).then(|| act.next.side().map_or(Step::Stay, Step::Cross))
    }

    /// Where sensors are missed, by agents that find out underfoot that they have missed one, so that nothing is lost.
    fn promises(&self, sight: Sight) -> bool {
        sight == Sight::Whole || self.writes().has(Condition::Underfoot)
    }
}

impl SensorData for Note {
    type View = View;

    const STORES_SIDES: bool = true;

    /// An agent asks whether a sensor has counted itself alone.
    const ALIKE_FROM: u32 = 2;

    fn settle(floor: &mut impl Floor<Self>, starts: &[Cell]) {
        settle(floor, starts);
    }

    fn look(floor: &impl Floor<Self>, cell: Cell, world: &mut (impl Oracle + ?Sized)) -> View {
        View::new(floor, cell, world)
    }

    fn scan(view: &View) -> &Scan {
        &view.scan
    }

    fn mark(&self) -> Mark {
        Self::mark(*self)
    }

    fn crossings(&self) -> u32 {
        self.crossings.into()
    }

    fn with_crossings(self, crossings: u32) -> Self {
        Self { crossings: crossings.min(Self::MOST_CROSSINGS.into()) as u16, ..self }
    }

    fn side(&self) -> Option<(Side, u8)> {
        let value = match self.state {
            State::Unexplored | State::Explored => return None,
            State::Open => 1,
            State::Visited => 2,
        };
        Some((self.side?, value))
    }
}

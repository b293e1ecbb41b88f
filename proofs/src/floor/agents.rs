//! What the search on small floors has to know of the agents, whatever their scheme.

use std::hash::Hash;

use tautline_kernel::choice::Oracle;
use tautline_kernel::floor::{Floor, Mark};
use tautline_kernel::ground::Cell;

/// Agents on a floor, as their rule makes them act.
pub trait Agents: Copy + Sync {
    /// What an agent remembers from one action to the next.
    type Memory: Clone + Eq + Hash;

    /// What the agent with this id remembers at the start.
    fn memory(&self, id: u8) -> Self::Memory;

    /// Whether an agent ever reads the serial number of a sensor.
    fn reads_serials(&self) -> bool;

    /// Whether an agent ever reads how many times a cell was entered.
    fn reads_crossings(&self) -> bool;

    /// Whether an agent ever enters a cell with this mark.
    fn passes(&self, mark: Mark) -> bool;

    /// One action of an agent in `cell`; `world` says which sensors it misses.
    fn act(
        &self,
        floor: &mut impl Floor,
        memory: &mut Self::Memory,
        cell: Cell,
        world: &mut dyn Oracle,
    ) -> Acted;
}

/// What an action leads to.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Acted {
    /// Where the agent is after it.
    pub cell: Cell,
    /// Whether the agent takes itself for done.
    pub is_done: bool,
}

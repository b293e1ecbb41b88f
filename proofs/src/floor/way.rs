//! The agents that a trap is searched for by name. Nothing else on the floor knows a scheme.

use tautline_kernel::bricks::Agent;
use tautline_kernel::choice::Oracle;
use tautline_kernel::floor::{Floor, Mark};
use tautline_kernel::ground::Cell;
use tautline_kernel::{ants, bricks};

use super::agents::{Acted, Agents};

/// How agents decide.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Way {
    /// By the crossings of the cells around.
    Ants(ants::Rule),
    /// By marking cells.
    Bricks(bricks::Rule),
}

impl Agents for Way {
    type Memory = Agent;

    fn memory(&self, id: u8) -> Agent {
        Agent::new(id)
    }

    fn reads_serials(&self) -> bool {
        match self {
            Self::Ants(rule) => rule.reads_serials(),
            Self::Bricks(rule) => rule.reads_serials(),
        }
    }

    fn reads_crossings(&self) -> bool {
        match self {
            Self::Ants(rule) => rule.reads_crossings(),
            Self::Bricks(rule) => rule.reads_crossings(),
        }
    }

    fn passes(&self, mark: Mark) -> bool {
        match self {
            Self::Ants(rule) => rule.passes(mark),
            Self::Bricks(rule) => rule.passes(mark),
        }
    }

    fn act(&self, floor: &mut impl Floor, agent: &mut Agent, cell: Cell, world: &mut dyn Oracle) -> Acted {
        match self {
            Self::Ants(rule) => rule.act(floor, &mut (), cell, world),
            Self::Bricks(rule) => rule.act(floor, agent, cell, world),
        }
    }
}

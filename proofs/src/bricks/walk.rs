//! Agents that mark cells as any search on small floors sees them.

use tautline_kernel::bricks::{Agent, Condition, Next, Rule, act};
use tautline_kernel::choice::Oracle;
use tautline_kernel::floor::{Floor, Mark};
use tautline_kernel::ground::Cell;

use crate::floor::trap::{Acted, Agents};

impl Agents for Rule {
    type Memory = Agent;

    fn memory(&self, id: u8) -> Agent {
        Agent::new(id)
    }

    fn reads_serials(&self) -> bool {
        self.has(Condition::SeenOnly)
    }

    fn reads_crossings(&self) -> bool {
        self.has(Condition::LeastCrossed)
    }

    fn passes(&self, mark: Mark) -> bool {
        match mark {
            Mark::Unexplored | Mark::Explored | Mark::Closing => true,
            Mark::Visited => self.has(Condition::SecondPass),
            Mark::Sealed => false,
        }
    }

    fn act(&self, floor: &mut impl Floor, agent: &mut Agent, cell: Cell, world: &mut dyn Oracle) -> Acted {
        let (act, cell) = act(*self, floor, agent, cell, world);
        Acted { cell, is_done: act.next == Next::Done }
    }
}

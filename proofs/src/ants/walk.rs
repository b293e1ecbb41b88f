//! Ants as any search on small floors sees them: they remember nothing and are never done.

use tautline_kernel::ants::{Rule, act};
use tautline_kernel::choice::Oracle;
use tautline_kernel::floor::{Floor, Mark, Scan};
use tautline_kernel::ground::Cell;

use crate::floor::trap::{Acted, Agents};

impl Agents for Rule {
    type Memory = ();

    fn memory(&self, _: u8) {}

    fn reads_serials(&self) -> bool {
        false
    }

    fn reads_crossings(&self) -> bool {
        true
    }

    fn passes(&self, mark: Mark) -> bool {
        match mark {
            Mark::Unexplored | Mark::Explored | Mark::Closing | Mark::Visited => true,
            Mark::Sealed => false,
        }
    }

    fn act(&self, floor: &mut impl Floor, (): &mut (), cell: Cell, world: &mut dyn Oracle) -> Acted {
        let scan = Scan::new(floor, cell, world);
        let side = act(*self, floor, cell, &scan);
        Acted { cell: side.map_or(cell, |side| cell.beyond(side)), is_done: false }
    }
}

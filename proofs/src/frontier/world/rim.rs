//! Who is met in a cell.

use tautline_kernel::frontier::Stance;
use tautline_kernel::ground::Cell;

/// Whether a robot at the rim of a cell counts as one that enters it.
#[derive(Clone, Copy, Debug)]
pub enum Rim {
    /// It does.
    Counts,
    /// It does not.
    No,
}

impl Rim {
    /// Whether a robot in the cell `at` with this stance is in `cell` or entering it.
    pub fn is_met(self, cell: Cell, at: Cell, stance: Stance) -> bool {
        let enters = match (stance, self) {
            (Stance::Enters(side), _) | (Stance::Tries(side), Self::Counts) => Some(at.beyond(side)),
            (Stance::Stands | Stance::Tries(_), _) => None,
        };
        at == cell || enters == Some(cell)
    }
}

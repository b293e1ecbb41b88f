//! The ground (LATTICE): what all schemes on cells rest on.

pub mod clauses;
mod environments;
mod frontier;

use tautline_kernel::ground::Side;

/// The name of a side.
pub const fn name_of(side: Side) -> &'static str {
    ["east", "south", "west", "north"][side as usize]
}

//! The clauses of the ground: the environments of a cell, and the distance to the frontier.

use tautline_kernel::ground::Circle;

use super::environments::{self, Circles};
use super::frontier::{self, Flooding};
use crate::clause::{Check, Clause, NamedRule};
use crate::decide::EveryAnswer;
use crate::step_checks;

/// The next larger circle: E_C with eight cells more.
pub(crate) const WIDER: Circle = Circle::new(34);

/// The next smaller circle than that of E_S: the cell and its four side neighbours.
pub(crate) const NARROWER: Circle = Circle::new(10);

const WHOLE: NamedRule<Flooding> = NamedRule::new("published", Flooding::Whole);

step_checks! { Circles;
    environments_of_circles: environments::environments, NamedRule::new("published", Circles::PUBLISHED),
        environments::offsets, covers ["in E_C alone", "in E_N", "in E_S alone", "in none"], unwind 6, mutants {
            safe_too_wide: "E_S with the radius of E_C" => Circles { safe: Circle::COVERED, ..Circles::PUBLISHED },
            covered_too_narrow: "E_C with the radius of E_S" => Circles { covered: Circle::SAFE, ..Circles::PUBLISHED },
            covered_too_wide: "E_C widened" => Circles { covered: WIDER, ..Circles::PUBLISHED },
        };
}

/// The clauses.
pub const CLAUSES: [Clause; 2] = [
    Clause {
        id: "LATTICE-1",
        sentence: "The environments derived from the radii MUST be the sets that the paper draws: E_N the cell and \
                   its four side neighbours, E_S the block of nine cells, E_C that block and the four cells two \
                   steps straight ahead.",
        checks: &[&environments_of_circles::CHECK],
    },
    Clause {
        id: "LATTICE-2",
        sentence: "The distance of a robot to the frontier MUST be the fewest steps to an unexplored \
                   cell, for a follower over edges that are not known to be walls, for the leader over \
                   those of them without a virtual obstacle.",
        checks: &[
            &Check::holds(
                WHOLE,
                &EveryAnswer::new(
                    frontier::in_six_cells,
                    frontier::small_maps,
                    &["a frontier", "no frontier"],
                ),
                &[NamedRule::new("virtual obstacles bind followers", Flooding::BindsFollowers)],
            ),
            &Check::holds(
                WHOLE,
                &EveryAnswer::new(frontier::along_every_line, frontier::lines, &["a column", "a row"]),
                &[NamedRule::new("a line is not flooded", Flooding::SkipsALine)],
            ),
        ],
    },
];

//! The clauses of Ants.

use std::convert::Infallible;

use tautline_kernel::ants::Rule;

use super::ties;
use crate::clause::{Check, Clause, NamedRule};
use crate::decide::{EveryAnswer, Verdict};
use crate::floor::plans::Area;
use crate::floor::series::{Deception, Floors, Subject};
use crate::floor::team::{Demand, Series};

const PUBLISHED: NamedRule<Subject<Rule>> = NamedRule::new("published", Subject::of(Rule::Published));
const REPAIRED: NamedRule<Subject<Rule>> = NamedRule::new("repaired", Subject::of(Rule::Repaired));

/// Ants whose sensors count nothing.
const fn uncounted(scheme: Rule) -> NamedRule<Subject<Rule>> {
    NamedRule::new("sensors count nothing", Subject { scheme, deception: Deception::CountsNothing })
}

/// A run is over when every cell is explored, since crossings go on to grow for ever.
const EXPLORES: Floors<Infallible> = Floors::new(
    &[
        Series::new(Area::blocked(4, 4), 1),
        Series::missing(Area::blocked(3, 3), 1, 2),
        Series::new(Area::blocked(3, 2), 2),
    ],
    Demand::Explores,
);

/// The clauses.
pub static CLAUSES: [Clause; 2] = [
    Clause {
        id: "ANTS-1",
        sentence: "Ants MUST explore every cell that is connected with their start, whatever sensors are missed a \
               finite number of times.",
        checks: &[
            &Check::new(PUBLISHED, &EXPLORES, Verdict::Holds, &[]),
            &Check::new(REPAIRED, &EXPLORES, Verdict::Holds, &[uncounted(Rule::Repaired)]),
        ],
    },
    Clause {
        id: "ANTS-2",
        sentence: "An ant MUST go to the side neighbour that was entered least, the first in the order of the compass.",
        checks: &[&Check::new(
            PUBLISHED,
            &EveryAnswer { body: ties::ties, range: ties::counts, covers: &["a side", "no side"] },
            Verdict::Holds,
            &[uncounted(Rule::Published)],
        )],
    },
];

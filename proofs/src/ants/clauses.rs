//! The clauses of Ants.

use tautline_kernel::ants::Rule;

use super::colony::{Observed, SmallFloors};
use super::ties;
use crate::clause::{Check, Clause, NamedRule};
use crate::decide::{EveryAnswer, Verdict};

const PUBLISHED: NamedRule<Observed> =
    NamedRule::new("published", Observed { rule: Rule::Published, counts: true });
const REPAIRED: NamedRule<Observed> =
    NamedRule::new("repaired", Observed { rule: Rule::Repaired, counts: true });

/// The clauses.
pub static CLAUSES: [Clause; 2] = [
    Clause {
        id: "ANTS-1",
        sentence: "Ants MUST explore every cell that is connected with their start, whatever sensors are missed a \
               finite number of times.",
        checks: &[
            &Check::new(PUBLISHED, &SmallFloors, Verdict::Holds, &[]),
            &Check::new(
                REPAIRED,
                &SmallFloors,
                Verdict::Holds,
                &[NamedRule::new("sensors count nothing", Observed { counts: false, ..REPAIRED.rule })],
            ),
        ],
    },
    Clause {
        id: "ANTS-2",
        sentence: "An ant MUST go to the side neighbour that was entered least, the first in the order of the compass.",
        checks: &[&Check::new(
            PUBLISHED,
            &EveryAnswer { body: ties::ties, range: ties::counts, covers: &["a side", "no side"] },
            Verdict::Holds,
            &[NamedRule::new("sensors count nothing", Observed { counts: false, ..PUBLISHED.rule })],
        )],
    },
];

//! The clause of Ants.

use tautline_kernel::ants::Rule;

use super::colony::{Observed, SmallFloors};
use crate::clause::{Check, Clause, Named};
use crate::decide::Verdict;

const PUBLISHED: Named<Observed> = Named::new("published", Observed { rule: Rule::Published, counts: true });
const REPAIRED: Named<Observed> = Named::new("repaired", Observed { rule: Rule::Repaired, counts: true });

/// The clauses.
pub static CLAUSES: [Clause; 1] = [Clause {
    id: "ANTS-1",
    sentence: "Ants MUST explore every cell that is connected with their start, whatever sensors are missed a \
               finite number of times.",
    checks: &[
        &Check::new(PUBLISHED, &SmallFloors, Verdict::Holds, &[]),
        &Check::new(
            REPAIRED,
            &SmallFloors,
            Verdict::Holds,
            &[Named::new("sensors count nothing", Observed { counts: false, ..REPAIRED.rule })],
        ),
    ],
}];

//! One more sentence of Kovács, Pásztor and Istenes 2011 about the chain: how soon it explores a share of an open area
//! (II.E). It follows those of [`super::own_clauses`].

use super::clauses::PUBLISHED;
use super::milestones::Milestone;
use crate::clause::{Check, Clause};

/// The clauses.
pub const CLAUSES: [Clause; 1] = [
    Clause {
        id: "CHAIN-26",
        sentence: "Without obstacles the chain MUST have explored half, and three quarters, of the cells after as few \
                   team moves as any chain.",
        checks: &[&Check::refuted(PUBLISHED, &Milestone::<50>), &Check::refuted(PUBLISHED, &Milestone::<75>)],
    },
];

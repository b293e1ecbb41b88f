//! More sentences of Kovács, Pásztor and Istenes 2011 about the chain: how soon it explores a share of an open area
//! (II.E), when two robots arrive in one cell, and how far from each other they are (III.D). They follow those of
//! [`super::own_clauses`].

use tautline_kernel::chain::Condition::{Distinct, NoExchange, PartsAtOnce};

use super::clauses::{APART, AREAS, PUBLISHED, REEL, REPAIRED, fewer_walls, lacking};
use super::every_area::EveryArea;
use super::invariant::Invariant;
use super::milestones::Milestone;
use super::subject::Subject;
use crate::clause::{Check, Clause, NamedRule};
use crate::engine::smallest::Most;

/// The reason why CHAIN-27 is broken by what backtracks.
const TAKEN_BACK: &str = "a backtrack repeats it; of apart none does";

/// The reason why CHAIN-28 is broken.
const UNASKED: &str = "no condition asks for it; one of apart does";

/// All areas in which the reel's robots meet unblocked, and exchange their cells.
const SMALL: Most = Most { cells: 8, barriers: 10, robots: 2..=4 };

/// Robots that stay together where a wall has brought them, and such as exchange their cells.
const MEETING: NamedRule<Subject> = lacking(Subject::APART, PartsAtOnce);
const EXCHANGING: NamedRule<Subject> = lacking(Subject::APART, NoExchange);

/// The clauses.
pub const CLAUSES: [Clause; 3] = [
    Clause {
        id: "CHAIN-26",
        sentence: "Without obstacles the chain MUST have explored half, and three quarters, of the cells after as few \
                   team moves as any chain.",
        checks: &[&Check::refuted(PUBLISHED, &Milestone::<50>), &Check::refuted(PUBLISHED, &Milestone::<75>)],
    },
    Clause {
        id: "CHAIN-27",
        sentence: "Two robots MUST arrive in one cell other than the base only in a team move in which one of them is \
                   blocked.",
        checks: &[
            &Check::refuted(PUBLISHED, &EveryArea(Invariant::Meets, AREAS, AREAS)),
            &Check::holds(
                PUBLISHED,
                &fewer_walls(Invariant::MeetsInAdvance),
                &[lacking(Subject::PUBLISHED, Distinct)],
            ),
            &Check::refuted(REPAIRED, &EveryArea(Invariant::Meets, AREAS, AREAS)).because(TAKEN_BACK),
            &Check::holds(
                REPAIRED,
                &fewer_walls(Invariant::MeetsInAdvance),
                &[lacking(Subject::REPAIRED, Distinct)],
            ),
            &Check::refuted(REEL, &EveryArea(Invariant::Meets, AREAS, AREAS)).because(TAKEN_BACK),
            &Check::holds(REEL, &fewer_walls(Invariant::MeetsInAdvance), &[lacking(Subject::REEL, Distinct)]),
            &Check::holds(APART, &EveryArea(Invariant::Meets, SMALL, SMALL), &[MEETING]),
            &Check::holds(APART, &fewer_walls(Invariant::Meets), &[MEETING]),
        ],
    },
    Clause {
        id: "CHAIN-28",
        sentence: "Two robots MUST never exchange their cells in one team move, unless one of these is the base.",
        checks: &[
            &Check::refuted(PUBLISHED, &EveryArea(Invariant::Exchanges, AREAS, AREAS)),
            &Check::refuted(REPAIRED, &EveryArea(Invariant::Exchanges, AREAS, AREAS)).because(UNASKED),
            &Check::refuted(REEL, &EveryArea(Invariant::Exchanges, AREAS, AREAS)).because(UNASKED),
            &Check::holds(APART, &EveryArea(Invariant::Exchanges, SMALL, SMALL), &[EXCHANGING]),
            &Check::holds(APART, &fewer_walls(Invariant::Exchanges), &[EXCHANGING]),
        ],
    },
];

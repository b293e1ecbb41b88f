//! The clauses of pack exploration, in the order of `SPEC.md`.

use tautline_kernel::pack::Condition::{Anew, Back, Connect, Corners, Double, Lead, Single};
use tautline_kernel::pack::{Condition, Rule};

use super::floors::{Bounds, Drawing, Floors, Size, Starts};
use super::gains::Gains;
use super::local;
use super::rays::{self, Rays};
use super::readings::{Flaw, PAPER, READINGS, Subject};
use super::run::{Demand, SITUATIONS};
use crate::clause::{Check, Clause, NamedRule, holding};
use crate::decide::EveryAnswer;
use crate::local::EveryNumber;

const PUBLISHED: NamedRule<Subject> = NamedRule::new("published", Subject::of(Rule::PUBLISHED));
const REPAIRED: NamedRule<Subject> = NamedRule::new("repaired", Subject::of(Rule::REPAIRED));

/// The repaired rule without one condition.
const fn without(name: &'static str, condition: Condition) -> NamedRule<Subject> {
    NamedRule::new(name, Subject::of(Rule::REPAIRED.without(condition)))
}

const NO_CONNECT: NamedRule<Subject> = without("links do not count", Connect);
const NO_CORNERS: NamedRule<Subject> = without("midpoints count", Corners);
const NO_SINGLE: NamedRule<Subject> = without("robots share cells", Single);
const NO_LEAD: NamedRule<Subject> = without("nobody leads", Lead);
const NO_BACK: NamedRule<Subject> = without("no move is taken back", Back);
const NO_DOUBLE: NamedRule<Subject> = without("always one move is taken back", Double);
const NO_ANEW: NamedRule<Subject> = without("ways are kept when a move is taken back", Anew);
const HEEDS_NO_WAY: NamedRule<Subject> = NamedRule::new(
    "the way does not count",
    Subject { flaw: Some(Flaw::HeedsNoWay), ..Subject::of(Rule::REPAIRED) },
);

const FORGETS: NamedRule<Subject> = NamedRule::new(
    "what was seen is forgotten",
    Subject { flaw: Some(Flaw::Forgets), ..Subject::of(Rule::PUBLISHED) },
);
const TWO_AT_ONCE: NamedRule<Subject> = NamedRule::new(
    "two team moves at once",
    Subject { flaw: Some(Flaw::TwoAtOnce), ..Subject::of(Rule::PUBLISHED) },
);

/// The published rule without the condition that keeps robots in cells of their own.
const SHARED: NamedRule<Subject> =
    NamedRule::new(NO_SINGLE.name, Subject::of(Rule::PUBLISHED.without(Single)));

/// Any number of robots that follow this rule, each in a cell of its own.
const fn of_any_number(named: NamedRule<Subject>) -> NamedRule<local::Single> {
    NamedRule::new(named.name, local::Single(named.rule.rule))
}

/// Any number of obstacles.
const ALL: u32 = u64::BITS;

/// Columns and rows, and the most obstacles where they are not all looked at.
macro_rules! floors {
    ($($columns:literal by $rows:literal $(: $most:literal)?),+) => {
        &[$((($columns, $rows), [$($most,)? ALL][0])),+]
    };
}

/// The floors of two robots.
const TWO: &[(Size, u32)] = floors![
    2 by 1, 3 by 1, 2 by 2, 4 by 1, 5 by 1, 3 by 2, 6 by 1, 7 by 1, 4 by 2, 8 by 1, 3 by 3, 5 by 2, 10 by 1,
    4 by 3, 5 by 3: 4, 5 by 4: 2
];

/// The floors on which the published rule, and robots that start anywhere, are looked at. The last ones are the first
/// where a pack leaves cells out whose frontier is unexplored.
const FEW: &[(Size, u32)] = floors![
    2 by 1, 3 by 1, 2 by 2, 4 by 1, 5 by 1, 3 by 2, 6 by 1, 7 by 1, 4 by 2, 5 by 2, 4 by 3: 1
];

/// Floors on which no two cells are R_c apart: whether robots are linked does not rest on equality.
const NARROW: &[(Size, u32)] = floors![2 by 1, 3 by 1, 2 by 2, 4 by 1, 3 by 2, 4 by 2, 3 by 3, 4 by 3];

/// The floors of robots that see two cells far.
const FAR: &[(Size, u32)] = floors![4 by 1, 3 by 2, 4 by 2, 3 by 3, 5 by 2, 4 by 3, 5 by 3: 4, 5 by 4: 2];

/// The floors on which gains are compared.
const CHOOSING: &[(Size, u32)] = floors![6 by 1, 4 by 2, 3 by 3, 5 by 2, 4 by 3: 4, 5 by 4: 1];

/// The floors of three.
const THREE: &[(Size, u32)] = floors![
    3 by 1, 2 by 2, 4 by 1, 3 by 2, 4 by 2, 3 by 3, 5 by 2, 4 by 3: 4, 5 by 3: 2
];

/// Floors on which three robots lead, take back and march.
const LEADING: [Drawing; 2] = [&[".....", ".##.#", "..#.."], &["...", "#.#", "...", ".#.", "...", "..."]];

/// Floors without obstacles.
const OPEN: &[(Size, u32)] = floors![
    2 by 1: 0, 3 by 1: 0, 2 by 2: 0, 4 by 1: 0, 5 by 1: 0, 3 by 2: 0, 4 by 2: 0, 3 by 3: 0, 5 by 2: 0,
    4 by 3: 0, 5 by 3: 0, 5 by 5: 0
];

const SMALLEST: Bounds = Bounds {
    gains: Gains::Unseen,
    sizes: TWO,
    drawn: &[],
    robots: 2,
    sight_cells: 1,
    range_cells: 3,
    starts: Starts::Beside,
};
const OF_FEW: Bounds = Bounds { sizes: FEW, ..SMALLEST };
const NO_TIES: Bounds = Bounds { sizes: NARROW, range_cells: 4, ..SMALLEST };
const OF_THREE: Bounds = Bounds { sizes: THREE, drawn: &LEADING, robots: 3, ..SMALLEST };
/// Choices are looked at on smaller floors.
const OF_GAINS: Bounds = Bounds { sizes: CHOOSING, gains: Gains::Compared, ..SMALLEST };
const FAR_SIGHTED: Bounds = Bounds { sizes: FAR, sight_cells: 2, ..SMALLEST };
const ANYWHERE: Bounds = Bounds { starts: Starts::Linked, ..OF_FEW };
const ANYWHERE_IN_THE_OPEN: Bounds = Bounds { sizes: OPEN, ..ANYWHERE };

const fn demand(bounds: Bounds, demand: Demand) -> Floors {
    Floors { bounds, demand, covers: &[] }
}

/// Floors on which robots must lead, take back and march.
const fn wholly(bounds: Bounds, demand: Demand) -> Floors {
    Floors { bounds, demand, covers: &SITUATIONS }
}

/// Floors of two robots that see two cells far, which must lead and take back.
const fn far(demand: Demand) -> Floors {
    const COVERS: [&str; 3] = [SITUATIONS[0], SITUATIONS[1], SITUATIONS[2]];
    Floors { bounds: FAR_SIGHTED, demand, covers: &COVERS }
}

/// The clauses of pack exploration.
pub const CLAUSES: [Clause; 9] = [
    Clause {
        id: "PACK-1",
        sentence: "After every team move, links MUST join all robots of a pack: robots are linked if the whole cell of \
                   one is within R_c of the midpoint of the other's.",
        checks: &[
            &Check::refuted(PUBLISHED, &demand(NO_TIES, Demand::Connected))
                .under(&holding(READINGS, []))
                .of(&PAPER),
            &Check::holds(REPAIRED, &wholly(SMALLEST, Demand::Connected), &[NO_CONNECT, NO_CORNERS]),
            &Check::holds(REPAIRED, &far(Demand::Connected), &[NO_CONNECT, NO_CORNERS]),
            &Check::holds(REPAIRED, &wholly(OF_THREE, Demand::Connected), &[NO_CONNECT, NO_CORNERS]),
        ],
    },
    Clause {
        id: "PACK-2",
        sentence: "Two robots of a pack MUST never be in one cell.",
        checks: &[
            &Check::holds(PUBLISHED, &demand(OF_FEW, Demand::Single), &[SHARED]),
            &Check::holds(REPAIRED, &wholly(SMALLEST, Demand::Single), &[NO_SINGLE]),
            &Check::holds(REPAIRED, &far(Demand::Single), &[NO_SINGLE]),
            &Check::holds(REPAIRED, &wholly(OF_THREE, Demand::Single), &[NO_SINGLE]),
            &Check::holds(of_any_number(PUBLISHED), &EveryNumber::DEFAULT, &[of_any_number(SHARED)]),
            &Check::holds(of_any_number(REPAIRED), &EveryNumber::DEFAULT, &[of_any_number(NO_SINGLE)]),
        ],
    },
    Clause {
        id: "PACK-3",
        sentence: "When the run of a pack whose robots start side by side ends, every free cell \
                   that a robot can walk to MUST be explored.",
        checks: &[
            &Check::refuted(PUBLISHED, &demand(OF_FEW, Demand::Covers))
                .under(&holding(READINGS, []))
                .of(&PAPER),
            &Check::holds(REPAIRED, &wholly(SMALLEST, Demand::Covers), &[NO_LEAD, NO_BACK]),
            &Check::holds(REPAIRED, &far(Demand::Covers), &[NO_LEAD, NO_BACK]),
            &Check::holds(REPAIRED, &wholly(OF_THREE, Demand::Covers), &[NO_LEAD, NO_BACK]),
        ],
    },
    Clause {
        id: "PACK-4",
        sentence: "Every run of a pack MUST end.",
        checks: &[
            &Check::holds(PUBLISHED, &demand(OF_FEW, Demand::Ends), &[FORGETS]),
            &Check::holds(REPAIRED, &wholly(SMALLEST, Demand::Ends), &[NO_DOUBLE]),
            &Check::holds(REPAIRED, &far(Demand::Ends), &[NO_DOUBLE]),
            &Check::holds(REPAIRED, &wholly(OF_THREE, Demand::Ends), &[NO_DOUBLE]),
        ],
    },
    Clause {
        id: "PACK-5",
        sentence: "When the run of a pack whose robots start anywhere, but linked, ends, every free cell that \
                   one of them can walk to MUST be explored.",
        checks: &[
            &Check::holds(REPAIRED, &demand(ANYWHERE_IN_THE_OPEN, Demand::Covers), &[NO_LEAD]),
            &Check::refuted(REPAIRED, &demand(ANYWHERE, Demand::Covers))
                .because("no rule can: who is shut in holds the others"),
        ],
    },
    Clause {
        id: "PACK-6",
        sentence: "A robot of a pack MUST always be in a free cell, and in a team move go one step at most.",
        checks: &[
            &Check::holds(PUBLISHED, &demand(OF_FEW, Demand::Free), &[TWO_AT_ONCE]),
            &Check::holds(REPAIRED, &wholly(SMALLEST, Demand::Free), &[NO_ANEW]),
            &Check::holds(REPAIRED, &far(Demand::Free), &[NO_ANEW]),
            &Check::holds(REPAIRED, &wholly(OF_THREE, Demand::Free), &[NO_ANEW]),
        ],
    },
    Clause {
        id: "PACK-7",
        sentence: "A robot of a pack MUST see a cell within R_s if and only if a ray goes there.",
        checks: &[&Check::holds(
            NamedRule::new("published", Rays::Stopped),
            &EveryAnswer::new(rays::sees, rays::views, &rays::COVERS),
            &[
                NamedRule::new("a ray passes between two obstacles", Rays::PassCorners),
                NamedRule::new("one obstacle at a corner stops a ray", Rays::StopAtCorners),
                NamedRule::new("no obstacle is seen", Rays::SeeNoObstacle),
            ],
        )],
    },
    Clause {
        id: "PACK-8",
        sentence: "A robot of a pack that goes its own way MUST choose a frontier cell whose metric gain \
                   no other cell that it may go to exceeds.",
        checks: &[
            &Check::holds(REPAIRED, &demand(OF_GAINS, Demand::Best), &[NO_CORNERS, HEEDS_NO_WAY]),
            &Check::holds(
                REPAIRED,
                &demand(Bounds { sight_cells: 2, ..OF_GAINS }, Demand::Best),
                &[NO_CORNERS, HEEDS_NO_WAY],
            ),
        ],
    },
    Clause {
        id: "PACK-9",
        sentence: "After every team move of a pack, links between midpoints that are at most R_c apart MUST join all \
                   robots.",
        checks: &[&Check::holds(
            PUBLISHED,
            &demand(ANYWHERE, Demand::Near),
            &[NamedRule::new(NO_CONNECT.name, Subject::of(Rule::PUBLISHED.without(Connect)))],
        )],
    },
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::decide::{Cache, Context, Method, Verdict};
    use crate::engine::Until;
    use crate::engine::states::MemoryLimit;
    use crate::engine::tree::unwatched;

    #[test]
    fn under_every_reading_robots_keep_apart_go_step_by_step_and_end() {
        let (cache, watch) = (&mut Cache::default(), &mut unwatched);
        let mut context = Context { cache, watch, memory: MemoryLimit::any() };
        for (name, subject) in READINGS {
            for asked in [Demand::Single, Demand::Free, Demand::Ends] {
                let found = demand(OF_FEW, asked).decide(&subject, Until::Exhausted, &mut context);
                let found = found.expect("it can be decided");
                assert_eq!((found.verdict, found.cases), (Verdict::Holds, 9208), "{name}: {asked:?}");
            }
            // Where frontier cells are unexplored a pack leaves cells out in the last areas alone, of 4×3 cells.
            let covers = demand(OF_FEW, Demand::Covers).decide(&subject, Until::Violation, &mut context);
            let first =
                covers.expect("it can be decided").counterexample.expect("cells are left").choices.once;
            let is_last = first[0] as usize == FEW.len() - 1;
            assert_eq!(is_last, name.ends_with("unexplored"), "{name}: {first:?}");
        }
    }
}

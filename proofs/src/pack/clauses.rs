//! The clauses of pack exploration, in the order of `SPEC.md`.

use tautline_kernel::pack::Condition::{Back, Connect, Corners, Double, Lead, Single};
use tautline_kernel::pack::Rule;

use super::floors::{Bounds, Floors, Size, Starts};
use super::played::Demand;
use crate::clause::{Check, Clause, Named};
use crate::decide::Verdict;

const PUBLISHED: Named<Rule> = Named::new("published", Rule::PUBLISHED);
const REPAIRED: Named<Rule> = Named::new("repaired", Rule::REPAIRED);

const NO_CONNECT: Named<Rule> = Named::new("links do not count", Rule::REPAIRED.without(Connect));
const NO_CORNERS: Named<Rule> = Named::new("midpoints count", Rule::REPAIRED.without(Corners));
const NO_SINGLE: Named<Rule> = Named::new("robots share cells", Rule::REPAIRED.without(Single));
const NO_LEAD: Named<Rule> = Named::new("nobody leads", Rule::REPAIRED.without(Lead));
const NO_BACK: Named<Rule> = Named::new("no move is taken back", Rule::REPAIRED.without(Back));
const NO_DOUBLE: Named<Rule> = Named::new("always one move is taken back", Rule::REPAIRED.without(Double));

/// Any number of obstacles.
const ALL: u32 = u64::BITS;

/// The floors of two robots.
const TWO: [(Size, u32); 16] = [
    ((2, 1), ALL),
    ((3, 1), ALL),
    ((2, 2), ALL),
    ((4, 1), ALL),
    ((5, 1), ALL),
    ((3, 2), ALL),
    ((6, 1), ALL),
    ((7, 1), ALL),
    ((4, 2), ALL),
    ((8, 1), ALL),
    ((3, 3), ALL),
    ((5, 2), ALL),
    ((10, 1), ALL),
    ((4, 3), ALL),
    ((5, 3), 4),
    ((5, 4), 2),
];

/// The floors on which the published rule, and robots that start anywhere, are looked at.
const FEW: [(Size, u32); 10] = [
    ((2, 1), ALL),
    ((3, 1), ALL),
    ((2, 2), ALL),
    ((4, 1), ALL),
    ((5, 1), ALL),
    ((3, 2), ALL),
    ((6, 1), ALL),
    ((7, 1), ALL),
    ((4, 2), ALL),
    ((5, 2), ALL),
];

/// The floors of three.
const THREE: [(Size, u32); 8] = [
    ((3, 1), ALL),
    ((2, 2), ALL),
    ((4, 1), ALL),
    ((3, 2), ALL),
    ((4, 2), ALL),
    ((3, 3), ALL),
    ((5, 2), ALL),
    ((4, 3), 4),
];

/// Floors without obstacles.
const OPEN: [(Size, u32); 12] = [
    ((2, 1), 0),
    ((3, 1), 0),
    ((2, 2), 0),
    ((4, 1), 0),
    ((5, 1), 0),
    ((3, 2), 0),
    ((4, 2), 0),
    ((3, 3), 0),
    ((5, 2), 0),
    ((4, 3), 0),
    ((5, 3), 0),
    ((5, 5), 0),
];

const SMALLEST: Bounds =
    Bounds { sizes: &TWO, robots: 2, sight_cells: 1, range_cells: 3, starts: Starts::Beside };
const OF_FEW: Bounds = Bounds { sizes: &FEW, ..SMALLEST };
const OF_THREE: Bounds = Bounds { sizes: &THREE, robots: 3, ..SMALLEST };
const ANYWHERE: Bounds = Bounds { starts: Starts::Linked, ..OF_FEW };
const ANYWHERE_IN_THE_OPEN: Bounds = Bounds { sizes: &OPEN, ..ANYWHERE };

const fn demand(bounds: Bounds, demand: Demand) -> Floors {
    Floors { bounds, demand, covers: &[] }
}

/// The clauses of pack exploration.
pub static CLAUSES: [Clause; 5] = [
    Clause {
        id: "PACK-1",
        sentence: "After every team move, links MUST join all robots of a pack: robots are linked if the whole cell of one is within R_c of the midpoint of the other's.",
        checks: &[
            &Check::new(PUBLISHED, &demand(OF_FEW, Demand::Connected), Verdict::Refuted, &[]),
            &Check::new(
                REPAIRED,
                &demand(SMALLEST, Demand::Connected),
                Verdict::Holds,
                &[NO_CONNECT, NO_CORNERS],
            ),
            &Check::new(
                REPAIRED,
                &demand(OF_THREE, Demand::Connected),
                Verdict::Holds,
                &[NO_CONNECT, NO_CORNERS],
            ),
        ],
    },
    Clause {
        id: "PACK-2",
        sentence: "Two robots of a pack MUST never be in one cell.",
        checks: &[
            &Check::new(PUBLISHED, &demand(OF_FEW, Demand::Single), Verdict::Holds, &[]),
            &Check::new(REPAIRED, &demand(SMALLEST, Demand::Single), Verdict::Holds, &[NO_SINGLE]),
            &Check::new(REPAIRED, &demand(OF_THREE, Demand::Single), Verdict::Holds, &[NO_SINGLE]),
        ],
    },
    Clause {
        id: "PACK-3",
        sentence: "When the run of a pack whose robots start side by side ends, every free cell that a robot can walk to MUST be explored.",
        checks: &[
            &Check::new(PUBLISHED, &demand(OF_FEW, Demand::Covers), Verdict::Refuted, &[]),
            &Check::new(REPAIRED, &demand(SMALLEST, Demand::Covers), Verdict::Holds, &[NO_LEAD, NO_BACK]),
            &Check::new(REPAIRED, &demand(OF_THREE, Demand::Covers), Verdict::Holds, &[]),
        ],
    },
    Clause {
        id: "PACK-4",
        sentence: "Every run of a pack MUST end.",
        checks: &[
            &Check::new(PUBLISHED, &demand(OF_FEW, Demand::Ends), Verdict::Holds, &[]),
            &Check::new(REPAIRED, &demand(SMALLEST, Demand::Ends), Verdict::Holds, &[NO_DOUBLE]),
            &Check::new(REPAIRED, &demand(OF_THREE, Demand::Ends), Verdict::Holds, &[]),
        ],
    },
    Clause {
        id: "PACK-5",
        sentence: "When the run of a pack whose robots start anywhere, but linked, ends, every free cell that one of them can walk to MUST be explored.",
        checks: &[
            &Check::new(REPAIRED, &demand(ANYWHERE_IN_THE_OPEN, Demand::Covers), Verdict::Holds, &[NO_LEAD]),
            &Check::new(REPAIRED, &demand(ANYWHERE, Demand::Covers), Verdict::Refuted, &[]),
        ],
    },
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::decide::{Memory, Seen};
    use crate::engine::tree::unwatched;

    /// The floors of [`FEW`] take milliseconds, the others seconds: `tautline prove PACK` looks at them.
    #[test]
    fn small_floors_refute_what_the_paper_leaves_open() {
        let mut memory = Memory::default();
        let mut floors = Vec::new();
        for check in CLAUSES
            .iter()
            .flat_map(|clause| clause.checks)
            .filter(|check| check.expected() == Verdict::Refuted)
        {
            let decision = check.decide(&mut memory, &mut unwatched).expect("it can be decided");
            assert!(decision.is_as_registered(*check), "{check:?}: {decision:?}");
            let found = decision.counterexample.expect("it is refuted");
            let Seen::Story(story) = &found.seen else { panic!("it is told") };
            floors.push(story.lines().nth(1).expect("a row").to_owned());
            assert_eq!(check.replay(&found.choices).expect("it is one").evidence, found);
        }
        assert_eq!(floors, ["..12..", "..12.", "1#2.."]);
    }
}

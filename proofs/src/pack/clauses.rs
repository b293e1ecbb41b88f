//! The clauses of pack exploration, in the order of `SPEC.md`.

use tautline_kernel::pack::Condition::{Back, Connect, Corners, Lead, March, Single};
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
const NO_MARCH: Named<Rule> = Named::new("no caterpillar", Rule::REPAIRED.without(March));

/// Any number of obstacles.
const ALL: u32 = u64::BITS;

/// The floors of two robots.
const TWO: [(Size, u32); 9] = [
    ((2, 1), ALL),
    ((3, 1), ALL),
    ((2, 2), ALL),
    ((4, 1), ALL),
    ((5, 1), ALL),
    ((3, 2), ALL),
    ((6, 1), ALL),
    ((4, 2), ALL),
    ((3, 3), ALL),
];

const SMALLEST: Bounds =
    Bounds { sizes: &TWO, robots: 2, sight_cells: 1, range_cells: 3, starts: Starts::Beside };
const ANYWHERE: Bounds = Bounds { starts: Starts::Linked, ..SMALLEST };

const fn demand(bounds: Bounds, demand: Demand) -> Floors {
    Floors { bounds, demand, covers: &[] }
}

/// The clauses of pack exploration.
pub static CLAUSES: [Clause; 5] = [
    Clause {
        id: "PACK-1",
        sentence: "After every team move, links MUST join all robots of a pack: robots are linked if the whole cell of one is within R_c of the midpoint of the other's.",
        checks: &[
            &Check::new(PUBLISHED, &demand(SMALLEST, Demand::Connected), Verdict::Refuted, &[]),
            &Check::new(REPAIRED, &demand(SMALLEST, Demand::Connected), Verdict::Holds, &[NO_CONNECT, NO_CORNERS]),
        ],
    },
    Clause {
        id: "PACK-2",
        sentence: "Two robots of a pack MUST never be in one cell.",
        checks: &[
            &Check::new(PUBLISHED, &demand(SMALLEST, Demand::Single), Verdict::Holds, &[]),
            &Check::new(REPAIRED, &demand(SMALLEST, Demand::Single), Verdict::Holds, &[NO_SINGLE]),
        ],
    },
    Clause {
        id: "PACK-3",
        sentence: "When the run of a pack whose robots start side by side ends, every free cell that a robot can walk to MUST be explored.",
        checks: &[
            &Check::new(PUBLISHED, &demand(SMALLEST, Demand::Covers), Verdict::Refuted, &[]),
            &Check::new(REPAIRED, &demand(SMALLEST, Demand::Covers), Verdict::Holds, &[NO_LEAD, NO_BACK, NO_MARCH]),
        ],
    },
    Clause {
        id: "PACK-4",
        sentence: "Every run of a pack MUST end.",
        checks: &[
            &Check::new(PUBLISHED, &demand(SMALLEST, Demand::Ends), Verdict::Holds, &[]),
            &Check::new(REPAIRED, &demand(SMALLEST, Demand::Ends), Verdict::Holds, &[]),
        ],
    },
    Clause {
        id: "PACK-5",
        sentence: "When the run of a pack whose robots start anywhere, but linked, ends, every free cell that one of them can walk to MUST be explored.",
        checks: &[&Check::new(REPAIRED, &demand(ANYWHERE, Demand::Covers), Verdict::Refuted, &[])],
    },
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::decide::{Memory, Seen};
    use crate::engine::tree::unwatched;

    #[test]
    fn checks_come_out_as_registered() {
        let mut memory = Memory::default();
        for clause in &CLAUSES {
            for check in clause.checks {
                let start = std::time::Instant::now();
                let decision = check.decide(&mut memory, &mut unwatched).expect("it can be decided");
                println!("{} {:?} {} {:?} killed {:?} survived {:?} {:.1?}", clause.id, check, decision.cases, decision.verdict, decision.killed, decision.survived, start.elapsed());
                if let Some(found) = &decision.counterexample {
                    let Seen::Story(story) = &found.seen else { panic!("it is told") };
                    println!("{story}");
                }
            }
        }
    }
}

//! The clauses of what is ours in the chain: certified plans, the reel, and contact in any order. They follow
//! those of [`super::clauses`] in the order of `SPEC.md`.

use tautline_kernel::chain::Condition::{CoveredBehind, SafeAhead};
use tautline_kernel::chain::{Habit, Rule};

use super::clauses::{FOUR_FEWER_WALLS, PUBLISHED, REEL, REPAIRED, UNHELD};
use super::invariant::Invariant;
use super::observed::Observed;
use super::search::EveryLayout;
use super::{pair, whole};
use crate::clause::{Check, Clause, Named};
use crate::decide::{Sampled, Verdict};
use crate::ground::clauses::NARROWER;
use crate::step_checks;

step_checks! { Observed;
    hold: pair::hold, REEL, pair::goers,
        covers ["both have gone", "neither has gone", "the robot ahead has gone", "the robot behind has gone"],
        unwind 6, mutants {
            without_hold: "without hold" => Observed::reeling(Observed::UNHELD.rule),
            without_safe_ahead: "without E_S ahead" => Observed::reeling(Rule::REEL.without(SafeAhead)),
            without_covered_behind: "without E_C behind" => Observed::reeling(Rule::REEL.without(CoveredBehind)),
        };
}

/// Reels that do not end, or gain nothing where they said so.
const UNREHEARSED: Named<Observed> =
    Named::new("tasks are not rehearsed", Observed::without_habits(&[Habit::Rehearses]));
const FICKLE: Named<Observed> = Named::new("stages go back", Observed::without_habits(&[Habit::KeepsTask]));
const NO_NEARER: Named<Observed> = Named::new(
    "an approach gets no nearer",
    Observed::without_habits(&[Habit::Rehearses, Habit::ComesNearer]),
);
const TAKES_BACK_ONE: Named<Observed> =
    Named::new("take-backs always of one", Observed::without_habits(&[Habit::Doubles]));

/// The clauses.
pub static CLAUSES: [Clause; 4] = [
    Clause {
        id: "CHAIN-16",
        sentence: "A planner MUST make no plan that the admission relation refuses.",
        checks: &[
            &Check::new(PUBLISHED, &EveryLayout(Invariant::Certified, FOUR_FEWER_WALLS), Verdict::Holds, &[]),
            &Check::new(
                REPAIRED,
                &EveryLayout(Invariant::Certified, FOUR_FEWER_WALLS),
                Verdict::Holds,
                &[Named::new("E_S narrowed to E_N", Observed::with_safe(NARROWER))],
            ),
            &Check::new(UNHELD, &EveryLayout(Invariant::Certified, FOUR_FEWER_WALLS), Verdict::Holds, &[]),
            &Check::new(
                REEL,
                &EveryLayout(Invariant::Certified, FOUR_FEWER_WALLS),
                Verdict::Holds,
                &[Named::new(
                    "tasks are not rehearsed, E_S narrowed to E_N",
                    Observed::reeling(Rule { safe: NARROWER, ..UNREHEARSED.rule.rule }),
                )],
            ),
        ],
    },
    Clause {
        id: "CHAIN-17",
        sentence: "Each team move of the reel MUST gain, or bring its measure down; so every run ends.",
        checks: &[
            &Check::new(UNHELD, &EveryLayout(Invariant::Falls, FOUR_FEWER_WALLS), Verdict::Holds, &[]),
            &Check::new(
                REEL,
                &EveryLayout(Invariant::Falls, FOUR_FEWER_WALLS),
                Verdict::Holds,
                &[UNREHEARSED, FICKLE, NO_NEARER, TAKES_BACK_ONE],
            ),
            &Check::new(
                REEL,
                &EveryLayout(Invariant::Ends, FOUR_FEWER_WALLS),
                Verdict::Holds,
                &[UNREHEARSED, FICKLE, NO_NEARER],
            ),
        ],
    },
    Clause {
        id: "CHAIN-18",
        sentence: "A rehearsal of the reel that meets no surprise MUST explore a cell in exactly its number of team \
                   moves.",
        checks: &[
            &Check::new(UNHELD, &EveryLayout(Invariant::Arrives, FOUR_FEWER_WALLS), Verdict::Holds, &[]),
            &Check::new(
                REEL,
                &EveryLayout(Invariant::Arrives, FOUR_FEWER_WALLS),
                Verdict::Holds,
                &[UNREHEARSED],
            ),
        ],
    },
    Clause {
        id: "CHAIN-19",
        sentence: "Whichever robots go, and in whatever order, each robot MUST be in E_C of its neighbours in the \
                   chain before, between and after their moves.",
        checks: &[
            &Check::new(REPAIRED, &EveryLayout(Invariant::AnyOrder, FOUR_FEWER_WALLS), Verdict::Refuted, &[]),
            &hold::CHECK,
            &Check::new(
                REEL,
                &EveryLayout(Invariant::AnyOrder, FOUR_FEWER_WALLS),
                Verdict::Holds,
                &[Named::new("as repaired", Observed::reeling(Rule::REPAIRED))],
            ),
            &Check::new(
                REEL,
                &Sampled {
                    body: whole::any_order,
                    runs: 200,
                    range: whole::orders,
                    covers: &["a whole run"],
                },
                Verdict::Unrefuted,
                &[Named::new("without hold", Observed::reeling(Observed::UNHELD.rule))],
            ),
        ],
    },
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::chain::search::{Bounds, search};
    use crate::engine::tree::unwatched;

    /// Runs, team moves, and the longest run of both reels.
    fn searched(robots: usize, walls: u32) -> [(u64, u64, u32); 2] {
        [Observed::REEL, Observed::UNHELD].map(|observed| {
            let invariants = Invariant::Falls.companions(&observed.intended).to_vec();
            let bounds = Bounds { invariants, ..Bounds::new(observed, robots, walls) };
            let found = search(&bounds, &mut unwatched).expect("it can be searched");
            assert!(found.complete && found.counterexamples.is_empty(), "{:?}", found.counterexamples);
            (found.runs, found.moves, found.longest)
        })
    }

    #[test]
    fn two_walls_break_nothing_of_a_reel_of_three_robots() {
        assert_eq!(searched(3, 2).map(|(runs, ..)| runs), [363, 363]);
    }

    #[test]
    #[ignore = "minutes without optimisation"]
    fn no_layout_within_the_wider_bounds_breaks_anything_of_a_reel() {
        assert_eq!(searched(3, 4), [(31_286, 278_665, 52); 2]);
        assert_eq!(searched(4, 3), [(26_389, 346_490, 71); 2]);
        assert_eq!(searched(5, 2), [(3_582, 65_481, 80), (3_574, 64_527, 80)]);
    }
}

//! The clauses of the chain, in the order of `SPEC.md`.

use tautline_kernel::chain::Condition::{
    CoveredBehind, Distinct, EpochMustGain, FullForFollower, FullForLeader, RefusedIsVirtual, SafeAhead,
    Unfold, UnsureAhead,
};
use tautline_kernel::chain::{Budget, High, Rule};
use tautline_kernel::ground::Circle;

use super::breach::Breach;
use super::invariant::Invariant;
use super::observed::{Deception, Observed};
use super::search::EveryLayout;
use super::{crowd, optimum, pair, small, three, walk, whole};
use crate::clause::{Check, Clause, Named};
use crate::decide::{Exhaustive, Sampled, Verdict};
use crate::ground::clauses::{NARROWER, WIDER};
use crate::step_checks;

pub(super) const PUBLISHED: Named<Observed> = Named::new("published", Observed::PUBLISHED);
pub(super) const REPAIRED: Named<Observed> = Named::new("repaired", Observed::REPAIRED);
const UNCOVERED: Named<Observed> = Named::new("uncovered", Observed::UNCOVERED);
pub(super) const REEL: Named<Observed> = Named::new("reel", Observed::REEL);
pub(super) const UNHELD: Named<Observed> = Named::new("unheld", Observed::UNHELD);
const SPARING: Named<Observed> = Named::new("sparing", Observed::SPARING);

step_checks! { Observed;
    contact: pair::contact, REPAIRED, pair::neighbours,
        covers ["both are blocked", "both arrive", "the robot ahead is blocked", "the robot behind is blocked"],
        unwind 6, mutants {
            published: "as published" => Observed::PUBLISHED,
            without_unsure_ahead: "without unsure neighbour" => Observed::without(UnsureAhead),
            without_safe_ahead: "without E_S ahead" => Observed::without(SafeAhead),
            without_covered_behind: "without E_C behind" => Observed::without(CoveredBehind),
            covered_too_wide: "E_C widened" => Observed::with_covered(WIDER),
        };
    crowding: crowd::crowding, REPAIRED, crowd::crowds,
        covers ["none arrives", "one arrives", "two arrive", "two were there"], unwind 6, mutants {
            published: "as published" => Observed::PUBLISHED,
            without_full_for_follower: "without full cell for followers" => Observed::without(FullForFollower),
            without_full_for_leader: "without full cell for the leader" => Observed::without(FullForLeader),
            without_distinct: "without distinctness" => Observed::without(Distinct),
        };
    coverage: pair::coverage, PUBLISHED, pair::neighbours,
        covers ["both are blocked", "both arrive", "the robot ahead is blocked", "the robot behind is blocked"],
        unwind 6, mutants {
            without_safe_ahead: "without E_S ahead" => Observed::following(Rule::PUBLISHED.without(SafeAhead)),
            safe_too_wide: "E_S with the radius of E_C" => Observed::with_safe(Circle::COVERED),
        };
    message: small::message, REPAIRED, small::messages,
        covers ["a byte", "a message", "no message"], unwind 6, mutants {
            swapped_bits: "message bits swapped" => Observed::deceiving(Deception::SwappedBits),
        };
    contact_of_three: three::contact, PUBLISHED, three::places,
        covers ["R_2 may do anything else", "R_2 stays"], unwind 6, mutants {
            high_from_present: "P_high from present positions" =>
                Observed::following(Rule { high: High::Present, ..Rule::PUBLISHED }),
            without_safe_ahead: "without E_S ahead" => Observed::following(Rule::PUBLISHED.without(SafeAhead)),
            without_covered_behind: "without E_C behind" =>
                Observed::following(Rule::PUBLISHED.without(CoveredBehind)),
        };
    ring: small::ring_of_neighbours, PUBLISHED, small::pairs_in_rings,
        covers ["farther in", "farther out", "in the same ring"], unwind 6, mutants {
            safe_too_wide: "E_S with the radius of E_C" => Observed::with_safe(Circle::COVERED),
            without_safe_ahead: "without E_S ahead" => Observed::without(SafeAhead),
        };
    unfolding: walk::unfolding, REPAIRED, walk::walks,
        covers ["both go on", "both stay", "the robot ahead goes on"], unwind 6, mutants {
            safe_too_narrow: "E_S narrowed to E_N" => Observed::with_safe(NARROWER),
            covered_too_narrow: "E_C with the radius of E_S" => Observed::with_covered(Circle::SAFE),
        };
}

/// The bound at which the published rule first fails with four robots.
const FOUR_ROBOTS: (usize, u32) = (4, 4);

/// The bound of the planner's clauses: four robots, too, but one wall fewer.
pub(super) const FOUR_FEWER_WALLS: (usize, u32) = (4, 3);

/// The bound of the clause about chains of three.
const THREE_ROBOTS: (usize, u32) = (3, 5);

/// Rules under which runs do not end.
const ENDLESS: [Named<Observed>; 2] = [
    Named::new("epochs need no gain", Observed::without(EpochMustGain)),
    Named::new("refusals leave no obstacle", Observed::without(RefusedIsVirtual)),
];

const ENDS: [&str; 2] = ["everything explored", "exhausted"];

const SPIRALS: Exhaustive<Observed> =
    Exhaustive { body: whole::spiral, range: whole::spirals, covers: &["an open area"] };

const SOLVED: Exhaustive<Observed> =
    Exhaustive { body: optimum::least_in_the_open, range: optimum::solved, covers: &["an open area"] };

const SAME_PLAN: Check<Observed> = Check::new(
    REPAIRED,
    &Exhaustive {
        body: whole::same_plan_in_all_layouts,
        range: whole::layouts_with_few_walls,
        covers: &ENDS,
    },
    Verdict::Holds,
    &[
        Named::new("P_high from present positions", Observed::high_from_present()),
        Named::new("without distinctness", Observed::without(Distinct)),
        Named::new("refusals leave no obstacle", Observed::without(RefusedIsVirtual)),
        Named::new("without unfolding", Observed::without(Unfold)),
        Named::new("nobody ahead is sure to arrive", Observed::deceiving(Deception::DoubtsAll)),
    ],
);

const SAME_PLAN_AT_RANDOM: Sampled<Observed> = Sampled {
    body: whole::same_plan_in_random_layouts,
    runs: 100,
    range: whole::random_layouts,
    covers: &ENDS,
};

/// A team that claims a budget and has none.
const LAVISH: Named<Observed> = Named::new(
    "no budget",
    Observed { rule: Rule { budget: Budget::Unlimited, ..Rule::REPAIRED }, ..Observed::SPARING },
);

const CHEAP: Check<Observed> = Check::new(
    REPAIRED,
    &Sampled { body: whole::cheap, runs: 44, range: whole::cheap_runs, covers: &["a longer run"] },
    Verdict::Unrefuted,
    &[Named::new("the plain recursion", Observed::deceiving(Deception::PlainRecursion))],
);

const DEAR: Check<Observed> = Check::new(
    PUBLISHED,
    &Sampled {
        body: whole::cheap_among_few_walls,
        runs: 100,
        range: whole::runs_among_few_walls,
        covers: &["a longer run"],
    },
    Verdict::Refuted,
    &[],
);

/// The clauses.
pub static CLAUSES: [Clause; 15] = [
    Clause {
        id: "CHAIN-1",
        sentence: "After every team move each robot MUST be in E_C of its neighbours in the chain.",
        checks: &[
            &Check::new(
                PUBLISHED,
                &EveryLayout(Invariant::Without(Breach::Contact), FOUR_ROBOTS),
                Verdict::Refuted,
                &[],
            ),
            &contact::CHECK,
            &Check::new(
                REPAIRED,
                &EveryLayout(Invariant::Without(Breach::Contact), FOUR_ROBOTS),
                Verdict::Holds,
                &[
                    Named::new("as published", Observed::PUBLISHED),
                    Named::new("without unsure neighbour", Observed::without(UnsureAhead)),
                ],
            ),
            &Check::new(
                UNHELD,
                &EveryLayout(Invariant::Without(Breach::Contact), FOUR_FEWER_WALLS),
                Verdict::Holds,
                &[],
            ),
            &Check::new(
                REEL,
                &EveryLayout(Invariant::Without(Breach::Contact), FOUR_FEWER_WALLS),
                Verdict::Holds,
                &[],
            ),
        ],
    },
    Clause {
        id: "CHAIN-2",
        sentence: "There MUST never be three robots or more in one cell other than the base.",
        checks: &[
            &Check::new(
                PUBLISHED,
                &EveryLayout(Invariant::Without(Breach::Crowding), FOUR_ROBOTS),
                Verdict::Refuted,
                &[],
            ),
            &crowding::CHECK,
            &Check::new(
                REPAIRED,
                &EveryLayout(Invariant::Without(Breach::Crowding), FOUR_ROBOTS),
                Verdict::Holds,
                &[Named::new("as published", Observed::PUBLISHED)],
            ),
            &Check::new(
                UNHELD,
                &EveryLayout(Invariant::Without(Breach::Crowding), FOUR_FEWER_WALLS),
                Verdict::Holds,
                &[],
            ),
            &Check::new(
                REEL,
                &EveryLayout(Invariant::Without(Breach::Crowding), FOUR_FEWER_WALLS),
                Verdict::Holds,
                &[],
            ),
        ],
    },
    Clause {
        id: "CHAIN-3",
        sentence: "During every team move, at whatever speeds the robots move, the centres of neighbours in the \
                   chain MUST stay within r_cov of each other.",
        checks: &[
            &coverage::CHECK,
            &Check::new(
                PUBLISHED,
                &EveryLayout(Invariant::Without(Breach::Coverage), FOUR_ROBOTS),
                Verdict::Holds,
                &[Named::new("without E_S ahead", Observed::following(Rule::PUBLISHED.without(SafeAhead)))],
            ),
            &Check { about: UNCOVERED, ..coverage::CHECK },
            &Check::new(
                REEL,
                &EveryLayout(Invariant::Without(Breach::Coverage), FOUR_FEWER_WALLS),
                Verdict::Holds,
                &[],
            ),
        ],
    },
    Clause {
        id: "CHAIN-4",
        sentence: "Every step of a planned team move MUST be admitted by the conditions of the rule.",
        checks: &[
            &Check::new(PUBLISHED, &EveryLayout(Invariant::Admitted, FOUR_FEWER_WALLS), Verdict::Holds, &[]),
            &Check::new(
                REPAIRED,
                &EveryLayout(Invariant::Admitted, FOUR_FEWER_WALLS),
                Verdict::Holds,
                &[
                    Named::new("without E_S ahead", Observed::without(SafeAhead)),
                    Named::new("without E_C behind", Observed::without(CoveredBehind)),
                    Named::new("without unsure neighbour", Observed::without(UnsureAhead)),
                    Named::new("without full cell for followers", Observed::without(FullForFollower)),
                    Named::new("without full cell for the leader", Observed::without(FullForLeader)),
                ],
            ),
            &Check::new(REEL, &EveryLayout(Invariant::Admitted, FOUR_FEWER_WALLS), Verdict::Holds, &[]),
        ],
    },
    Clause {
        id: "CHAIN-5",
        sentence: "In a planned team move every robot MUST have a cell of its own, the base excepted.",
        checks: &[
            &Check::new(PUBLISHED, &EveryLayout(Invariant::Distinct, FOUR_FEWER_WALLS), Verdict::Holds, &[]),
            &Check::new(
                REPAIRED,
                &EveryLayout(Invariant::Distinct, FOUR_FEWER_WALLS),
                Verdict::Holds,
                &[Named::new("without distinctness", Observed::without(Distinct))],
            ),
            &Check::new(REEL, &EveryLayout(Invariant::Distinct, FOUR_FEWER_WALLS), Verdict::Holds, &[]),
        ],
    },
    Clause {
        id: "CHAIN-6",
        sentence: "The base MUST never plan to move, and never move.",
        checks: &[&Check::new(
            REPAIRED,
            &EveryLayout(Invariant::BaseStays, FOUR_FEWER_WALLS),
            Verdict::Holds,
            &[Named::new("the base follows R_2", Observed::deceiving(Deception::BaseFollows))],
        )],
    },
    Clause {
        id: "CHAIN-7",
        sentence: "Every run MUST end.",
        checks: &[
            &Check::new(
                REPAIRED,
                &EveryLayout(Invariant::Progress, FOUR_FEWER_WALLS),
                Verdict::Holds,
                &ENDLESS,
            ),
            &Check::new(PUBLISHED, &EveryLayout(Invariant::Ends, FOUR_ROBOTS), Verdict::Holds, &[]),
            &Check::new(REPAIRED, &EveryLayout(Invariant::Ends, FOUR_ROBOTS), Verdict::Holds, &ENDLESS),
            &Check::new(REEL, &EveryLayout(Invariant::BaseStays, FOUR_FEWER_WALLS), Verdict::Holds, &[]),
        ],
    },
    Clause {
        id: "CHAIN-8",
        sentence: "One byte for each robot and team move MUST be enough to know the state of the whole team.",
        checks: &[
            &message::CHECK,
            &Check::new(
                REPAIRED,
                &EveryLayout(Invariant::Heard, FOUR_FEWER_WALLS),
                Verdict::Holds,
                &[Named::new("message bits swapped", Observed::deceiving(Deception::SwappedBits))],
            ),
            &Check::new(REEL, &EveryLayout(Invariant::Heard, FOUR_FEWER_WALLS), Verdict::Holds, &[]),
        ],
    },
    Clause {
        id: "CHAIN-9",
        sentence: "Without obstacles a chain of N robots MUST have explored all (2N−1)² cells after exactly \
                   9(N−1)−1 team moves.",
        checks: &[
            &Check::new(PUBLISHED, &SPIRALS, Verdict::Holds, &[]),
            &Check::new(
                REPAIRED,
                &SPIRALS,
                Verdict::Holds,
                &[Named::new("P_high from present positions", Observed::high_from_present())],
            ),
            &Check::new(REEL, &SPIRALS, Verdict::Holds, &[]),
        ],
    },
    Clause {
        id: "CHAIN-10",
        sentence: "A chain of N robots MUST need at least 9(N−1)−1 team moves to explore (2N−1)² cells.",
        checks: &[
            &ring::CHECK,
            &Check::new(
                PUBLISHED,
                &Exhaustive { body: small::ring_cells, range: small::rings, covers: &["a ring"] },
                Verdict::Holds,
                &[],
            ),
            &Check::new(PUBLISHED, &SOLVED, Verdict::Holds, &[]),
            &Check::new(
                REPAIRED,
                &SOLVED,
                Verdict::Holds,
                &[Named::new("without E_S ahead", Observed::without(SafeAhead))],
            ),
        ],
    },
    Clause {
        id: "CHAIN-11",
        sentence: "A plan that keeps within its budget MUST be the one that the plain recursion of the paper returns.",
        checks: &[
            &Check { about: PUBLISHED, ..SAME_PLAN },
            &SAME_PLAN,
            &Check { method: &SAME_PLAN_AT_RANDOM, expected: Verdict::Unrefuted, ..SAME_PLAN },
        ],
    },
    Clause {
        id: "CHAIN-12",
        sentence: "A plan MUST look at no more candidates of followers than its budget of 100 for each robot.",
        checks: &[
            &DEAR,
            &Check::new(SPARING, &EveryLayout(Invariant::Cheap, FOUR_FEWER_WALLS), Verdict::Holds, &[LAVISH]),
            &CHEAP,
        ],
    },
    Clause {
        id: "CHAIN-13",
        sentence: "When a run ends, every cell within reach of the chain MUST be explored.",
        checks: &[
            &Check::new(
                PUBLISHED,
                &EveryLayout(Invariant::Without(Breach::Completeness), FOUR_ROBOTS),
                Verdict::Refuted,
                &[],
            ),
            &unfolding::CHECK,
            &Check::new(
                REPAIRED,
                &EveryLayout(Invariant::Without(Breach::Completeness), FOUR_ROBOTS),
                Verdict::Holds,
                &[Named::new("without unfolding", Observed::without(Unfold))],
            ),
            &Check::new(
                UNHELD,
                &EveryLayout(Invariant::Without(Breach::Completeness), FOUR_FEWER_WALLS),
                Verdict::Holds,
                &[],
            ),
            &Check::new(
                REEL,
                &EveryLayout(Invariant::Without(Breach::Completeness), FOUR_FEWER_WALLS),
                Verdict::Holds,
                &[],
            ),
        ],
    },
    Clause {
        id: "CHAIN-14",
        sentence: "When a run ends, every chain-reachable cell MUST be explored.",
        checks: &[
            &Check::new(PUBLISHED, &EveryLayout(Invariant::Exhausts, (3, 2)), Verdict::Refuted, &[]),
            &Check::new(
                REPAIRED,
                &EveryLayout(Invariant::Exhausts, (3, 2)),
                Verdict::Holds,
                &[Named::new("without unfolding", Observed::without(Unfold))],
            ),
            &Check::new(REPAIRED, &EveryLayout(Invariant::Exhausts, (3, 3)), Verdict::Refuted, &[]),
        ],
    },
    Clause {
        id: "CHAIN-15",
        sentence: "As published a chain of three robots MUST keep to CHAIN-1 and CHAIN-2 in every layout.",
        checks: &[
            &contact_of_three::CHECK,
            &Check::new(
                PUBLISHED,
                &EveryLayout(Invariant::Without(Breach::Contact), THREE_ROBOTS),
                Verdict::Holds,
                &[Named::new("without E_S ahead", Observed::following(Rule::PUBLISHED.without(SafeAhead)))],
            ),
            &Check::new(
                PUBLISHED,
                &EveryLayout(Invariant::Without(Breach::Crowding), THREE_ROBOTS),
                Verdict::Holds,
                &[],
            ),
        ],
    },
];

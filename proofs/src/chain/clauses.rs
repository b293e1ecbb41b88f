//! The clauses of the chain, in the order of `SPEC.md`.

use tautline_kernel::chain::Condition::{
    CoveredBehind, Distinct, EpochMustGain, FullForFollower, FullForLeader, RefusedIsVirtual, SafeAhead,
    Unfold, UnsureAhead,
};
use tautline_kernel::chain::{Budget, Habit, High, Rule};
use tautline_kernel::ground::Circle;

use super::breach::Breach;
use super::every_area::EveryArea;
use super::invariant::Invariant;
use super::local::{self, Contact, Coverage, Crowd, OfThree};
use super::observed::{Deception, Subject};
use super::readings::{LAST, PAPER, READINGS};
use super::search::EveryLayout;
use super::{crowd, optimum, pair, small, three, walk, whole};
use crate::clause::{Check, Clause, NamedRule, holding};
use crate::decide::{EveryAnswer, RandomAnswers, Verdict};
use crate::engine::smallest::Most;
use crate::ground::clauses::{NARROWER, WIDER};
use crate::local::EveryNumber;
use crate::step_checks;

pub(super) const PUBLISHED: NamedRule<Subject> = NamedRule::new("published", Subject::PUBLISHED);
pub(super) const REPAIRED: NamedRule<Subject> = NamedRule::new("repaired", Subject::REPAIRED);
const UNCOVERED: NamedRule<Subject> = NamedRule::new("uncovered", Subject::UNCOVERED);
pub(super) const REEL: NamedRule<Subject> = NamedRule::new("reel", Subject::REEL);
pub(super) const UNHELD: NamedRule<Subject> = NamedRule::new("unheld", Subject::UNHELD);
const SPARING: NamedRule<Subject> = NamedRule::new("sparing", Subject::SPARING);

step_checks! { Subject;
    contact: pair::contact, REPAIRED, pair::neighbours,
        covers ["both are blocked", "both arrive", "the robot ahead is blocked", "the robot behind is blocked"],
        unwind 6, mutants {
            published: "as published" => Subject::PUBLISHED,
            without_unsure_ahead: "without unsure neighbour" => Subject::without(UnsureAhead),
            without_safe_ahead: "without E_S ahead" => Subject::without(SafeAhead),
            without_covered_behind: "without E_C behind" => Subject::without(CoveredBehind),
            covered_too_wide: "E_C widened" => Subject::with_covered(WIDER),
        };
    crowding: crowd::crowding, REPAIRED, crowd::crowds,
        covers ["none arrives", "one arrives", "two arrive", "two were there"], unwind 6, mutants {
            published: "as published" => Subject::PUBLISHED,
            without_full_for_follower: "without full cell for followers" => Subject::without(FullForFollower),
            without_full_for_leader: "without full cell for the leader" => Subject::without(FullForLeader),
            without_distinct: "without distinctness" => Subject::without(Distinct),
        };
    coverage: pair::coverage, PUBLISHED, pair::neighbours,
        covers ["both are blocked", "both arrive", "the robot ahead is blocked", "the robot behind is blocked"],
        unwind 6, mutants {
            without_safe_ahead: "without E_S ahead" => Subject::following(Rule::PUBLISHED.without(SafeAhead)),
            safe_too_wide: "E_S with the radius of E_C" => Subject::with_safe(Circle::COVERED),
        };
    message: small::message, REPAIRED, small::messages,
        covers ["a byte", "a message", "no message"], unwind 6, mutants {
            swapped_bits: "message bits swapped" => Subject::deceiving(Deception::SwappedBits),
        };
    contact_of_three: three::contact, PUBLISHED, three::places,
        covers ["R_2 may do anything else", "R_2 stays"], unwind 6, mutants {
            high_from_present: "P_high from present positions" =>
                Subject::following(Rule { high: High::Present, ..Rule::PUBLISHED }),
            without_safe_ahead: "without E_S ahead" => Subject::following(Rule::PUBLISHED.without(SafeAhead)),
            without_covered_behind: "without E_C behind" =>
                Subject::following(Rule::PUBLISHED.without(CoveredBehind)),
        };
    ring: small::ring_of_neighbours, PUBLISHED, small::pairs_in_rings,
        covers ["farther in", "farther out", "in the same ring"], unwind 6, mutants {
            safe_too_wide: "E_S with the radius of E_C" => Subject::with_safe(Circle::COVERED),
            without_safe_ahead: "without E_S ahead" => Subject::without(SafeAhead),
        };
    unfolding: walk::unfolding, REPAIRED, walk::walks,
        covers ["both go on", "both stay", "the robot ahead goes on"], unwind 6, mutants {
            safe_too_narrow: "E_S narrowed to E_N" => Subject::with_safe(NARROWER),
            covered_too_narrow: "E_C with the radius of E_S" => Subject::with_covered(Circle::SAFE),
        };
}

/// The bound within which the smallest counterexamples are looked for.
pub(super) const AREAS: Most = Most { cells: 10, barriers: 13, robots: 2..=5 };

/// The part of it in which counterexamples to other readings are sought: the plain recursion plays these.
const READ: Most = Most { cells: 10, barriers: 2, robots: 3..=4 };

/// As [`READ`], where two walls are too few.
const READ_AMONG_FOUR_WALLS: Most = Most { cells: 10, barriers: 4, robots: 4..=4 };

/// The bound of four robots in the paper's area.
const FOUR_ROBOTS: (usize, u32) = (4, 4);

/// The bound of the planner's clauses: four robots, too, but one wall fewer.
pub(super) const FOUR_FEWER_WALLS: (usize, u32) = (4, 3);

/// Five robots, which may meet as many walls as are soon looked at.
pub(super) const FIVE_TWO_WALLS: (usize, u32) = (5, 2);

/// The bound of the clause about chains of three.
const THREE_ROBOTS: (usize, u32) = (3, 5);

/// Rules under which runs do not end.
const ENDLESS: [NamedRule<Subject>; 2] = [
    NamedRule::new("epochs need no gain", Subject::without(EpochMustGain)),
    NamedRule::new("refusals leave no obstacle", Subject::without(RefusedIsVirtual)),
];

/// Reels that do not end, or gain nothing where they said so.
pub(super) const UNREHEARSED: NamedRule<Subject> =
    NamedRule::new("tasks are not rehearsed", Subject::without_habits(&[Habit::Rehearses]));
pub(super) const FICKLE: NamedRule<Subject> =
    NamedRule::new("stages go back", Subject::without_habits(&[Habit::KeepsTask]));

/// A reel that claims to hold contact whoever stays.
pub(super) const NOT_HELD: NamedRule<Subject> =
    NamedRule::new("without hold", Subject::reeling(Subject::UNHELD.rule));

const ENDS: [&str; 2] = ["everything explored", "exhausted"];

const SPIRALS: EveryAnswer<Subject> =
    EveryAnswer { body: whole::spiral, range: whole::spirals, covers: &["an open area"] };

const SOLVED: EveryAnswer<Subject> =
    EveryAnswer { body: optimum::least_in_the_open, range: optimum::solved, covers: &["an open area"] };

const SAME_PLAN: Check<Subject> = Check::holds(
    REPAIRED,
    &EveryAnswer {
        body: whole::same_plan_in_all_layouts,
        range: whole::layouts_with_few_walls,
        covers: &ENDS,
    },
    &[
        NamedRule::new("P_high from present positions", Subject::high_from_present()),
        NamedRule::new("without distinctness", Subject::without(Distinct)),
        NamedRule::new("refusals leave no obstacle", Subject::without(RefusedIsVirtual)),
        NamedRule::new("without unfolding", Subject::without(Unfold)),
        NamedRule::new("nobody ahead is sure to arrive", Subject::deceiving(Deception::DoubtsAll)),
    ],
);

const SAME_PLAN_AT_RANDOM: RandomAnswers<Subject> = RandomAnswers {
    body: whole::same_plan_in_random_layouts,
    runs: 100,
    range: whole::random_layouts,
    covers: &ENDS,
};

/// A team that claims a budget and has none.
const LAVISH: NamedRule<Subject> = NamedRule::new(
    "no budget",
    Subject { rule: Rule { budget: Budget::Unlimited, ..Rule::REPAIRED }, ..Subject::SPARING },
);

const CHEAP: Check<Subject> = Check::new(
    REPAIRED,
    &RandomAnswers { body: whole::cheap, runs: 44, range: whole::cheap_runs, covers: &["a longer run"] },
    Verdict::Unrefuted,
    &[NamedRule::new("the plain recursion", Subject::deceiving(Deception::PlainRecursion))],
);

const DEAR: Check<Subject> = Check::refuted(
    PUBLISHED,
    &RandomAnswers {
        body: whole::cheap_among_few_walls,
        runs: 100,
        range: whole::runs_among_few_walls,
        covers: &["a longer run"],
    },
);

/// The clauses.
pub static CLAUSES: [Clause; 15] = [
    Clause {
        id: "CHAIN-1",
        sentence: "After every team move each robot MUST be in E_C of its neighbours in the chain.",
        checks: &[
            &Check::refuted(
                PUBLISHED,
                &EveryArea(Invariant::Without(Breach::Contact), AREAS, READ_AMONG_FOUR_WALLS),
            )
            .under(&holding([LAST], []))
            .of(&PAPER),
            &contact::CHECK,
            &Check::holds(
                REPAIRED,
                &EveryLayout(Invariant::Without(Breach::Contact), FOUR_ROBOTS),
                &[
                    NamedRule::new("as published", Subject::PUBLISHED),
                    NamedRule::new("without unsure neighbour", Subject::without(UnsureAhead)),
                ],
            ),
            &Check::holds(UNHELD, &EveryLayout(Invariant::Without(Breach::Contact), FOUR_FEWER_WALLS), &[]),
            &Check::holds(REEL, &EveryLayout(Invariant::Without(Breach::Contact), FOUR_FEWER_WALLS), &[]),
            &Check::holds(
                NamedRule::new("repaired", Contact::<false>(Rule::REPAIRED)),
                &EveryNumber::DEFAULT,
                &[
                    NamedRule::new("as published", Contact(Rule::PUBLISHED)),
                    NamedRule::new("without E_S ahead", Contact(Rule::REPAIRED.without(SafeAhead))),
                    NamedRule::new("without E_C behind", Contact(Rule::REPAIRED.without(CoveredBehind))),
                ],
            ),
            &Check::holds(NamedRule::new("reel", Contact::<false>(Rule::REEL)), &EveryNumber::DEFAULT, &[]),
        ],
    },
    Clause {
        id: "CHAIN-2",
        sentence: "There MUST never be three robots or more in one cell other than the base.",
        checks: &[
            &Check::refuted(PUBLISHED, &EveryArea(Invariant::Without(Breach::Crowding), AREAS, READ))
                .under(&holding(READINGS, []))
                .of(&PAPER),
            &crowding::CHECK,
            &Check::holds(
                REPAIRED,
                &EveryLayout(Invariant::Without(Breach::Crowding), FOUR_ROBOTS),
                &[NamedRule::new("as published", Subject::PUBLISHED)],
            ),
            &Check::holds(
                UNHELD,
                &EveryLayout(Invariant::Without(Breach::Crowding), FOUR_FEWER_WALLS),
                &[NamedRule::new(
                    "without distinctness",
                    Subject { rule: UNHELD.rule.rule.without(Distinct), ..UNHELD.rule },
                )],
            ),
            &Check::holds(
                REEL,
                &EveryLayout(Invariant::Without(Breach::Crowding), FOUR_ROBOTS),
                &[
                    NamedRule::new("without distinctness", Subject::reeling(Rule::REEL.without(Distinct))),
                    NamedRule::new(
                        "without full cells",
                        Subject::reeling(Rule::REEL.without(FullForFollower).without(FullForLeader)),
                    ),
                ],
            ),
            &Check::holds(
                NamedRule::new("repaired", Crowd::of(Rule::REPAIRED)),
                &EveryNumber::DEFAULT,
                &[
                    NamedRule::new("as published", Crowd::of(Rule::PUBLISHED)),
                    NamedRule::new(
                        "without full cell for followers",
                        Crowd::of(Rule::REPAIRED.without(FullForFollower)),
                    ),
                    NamedRule::new(
                        "without full cell for the leader",
                        Crowd::of(Rule::REPAIRED.without(FullForLeader)),
                    ),
                    NamedRule::new("without distinctness", Crowd::of(Rule::REPAIRED.without(Distinct))),
                ],
            ),
            &Check::holds(NamedRule::new("reel", Crowd::of(Rule::REEL)), &EveryNumber::DEFAULT, &[]),
        ],
    },
    Clause {
        id: "CHAIN-3",
        sentence: "During every team move, at whatever speeds the robots move, the centres of neighbours in the \
                   chain MUST stay within r_cov of each other.",
        checks: &[
            &coverage::CHECK,
            &Check::holds(
                PUBLISHED,
                &EveryLayout(Invariant::Without(Breach::Coverage), FOUR_ROBOTS),
                &[NamedRule::new(
                    "without E_S ahead",
                    Subject::following(Rule::PUBLISHED.without(SafeAhead)),
                )],
            ),
            &Check { about: UNCOVERED, ..coverage::CHECK },
            &Check::holds(REEL, &EveryLayout(Invariant::Without(Breach::Coverage), FOUR_FEWER_WALLS), &[]),
            &Check::holds(
                NamedRule::new("published", Coverage(Rule::PUBLISHED)),
                &EveryNumber::DEFAULT,
                &[NamedRule::new("without E_S ahead", Coverage(Rule::PUBLISHED.without(SafeAhead)))],
            ),
            &Check::holds(
                NamedRule::new("uncovered", Coverage(Rule::PUBLISHED.without(CoveredBehind))),
                &EveryNumber::DEFAULT,
                &[],
            ),
            &Check::holds(NamedRule::new("reel", Coverage(Rule::REEL)), &EveryNumber::DEFAULT, &[]),
        ],
    },
    Clause {
        id: "CHAIN-4",
        sentence: "Every step of a planned team move MUST be admitted by the conditions of the rule.",
        checks: &[
            &Check::holds(PUBLISHED, &EveryLayout(Invariant::Admitted, FOUR_FEWER_WALLS), &[]),
            &Check::holds(
                REPAIRED,
                &EveryLayout(Invariant::Admitted, FOUR_FEWER_WALLS),
                &[
                    NamedRule::new("without E_S ahead", Subject::without(SafeAhead)),
                    NamedRule::new("without E_C behind", Subject::without(CoveredBehind)),
                    NamedRule::new("without unsure neighbour", Subject::without(UnsureAhead)),
                    NamedRule::new("without full cell for followers", Subject::without(FullForFollower)),
                    NamedRule::new("without full cell for the leader", Subject::without(FullForLeader)),
                ],
            ),
            &Check::holds(REEL, &EveryLayout(Invariant::Admitted, FOUR_FEWER_WALLS), &[]),
            &Check::holds(REEL, &EveryLayout(Invariant::Admitted, FIVE_TWO_WALLS), &[NOT_HELD]),
        ],
    },
    Clause {
        id: "CHAIN-5",
        sentence: "In a planned team move every robot MUST have a cell of its own, the base excepted.",
        checks: &[
            &Check::holds(PUBLISHED, &EveryLayout(Invariant::Distinct, FOUR_FEWER_WALLS), &[]),
            &Check::holds(
                REPAIRED,
                &EveryLayout(Invariant::Distinct, FOUR_FEWER_WALLS),
                &[NamedRule::new("without distinctness", Subject::without(Distinct))],
            ),
            &Check::holds(REEL, &EveryLayout(Invariant::Distinct, FOUR_FEWER_WALLS), &[]),
        ],
    },
    Clause {
        id: "CHAIN-6",
        sentence: "The base MUST never plan to move, and never move.",
        checks: &[
            &Check::holds(
                REPAIRED,
                &EveryLayout(Invariant::BaseStays, FOUR_FEWER_WALLS),
                &[NamedRule::new("the base follows R_2", Subject::deceiving(Deception::BaseFollows))],
            ),
            &Check::holds(
                REEL,
                &EveryLayout(Invariant::BaseStays, FOUR_FEWER_WALLS),
                &[NamedRule::new(
                    "the base follows R_2",
                    Subject { deception: Deception::BaseFollows, ..REEL.rule },
                )],
            ),
        ],
    },
    Clause {
        id: "CHAIN-7",
        sentence: "Every run MUST end.",
        checks: &[
            &Check::holds(REPAIRED, &EveryLayout(Invariant::Progress, FOUR_FEWER_WALLS), &ENDLESS),
            &Check::holds(PUBLISHED, &EveryLayout(Invariant::Ends, FOUR_ROBOTS), &[]),
            &Check::holds(REPAIRED, &EveryLayout(Invariant::Ends, FOUR_ROBOTS), &ENDLESS),
            &Check::holds(REEL, &EveryLayout(Invariant::Ends, FOUR_FEWER_WALLS), &[UNREHEARSED, FICKLE]),
        ],
    },
    Clause {
        id: "CHAIN-8",
        sentence: "One byte for each robot and team move MUST be enough to know the state of the whole team.",
        checks: &[
            &message::CHECK,
            &Check::holds(
                REPAIRED,
                &EveryLayout(Invariant::Heard, FOUR_FEWER_WALLS),
                &[NamedRule::new("message bits swapped", Subject::deceiving(Deception::SwappedBits))],
            ),
            &Check::holds(REEL, &EveryLayout(Invariant::Heard, FOUR_FEWER_WALLS), &[]),
        ],
    },
    Clause {
        id: "CHAIN-9",
        sentence: "Without obstacles a chain of N robots MUST have explored all (2N−1)² cells after exactly \
                   9(N−1)−1 team moves.",
        checks: &[
            &Check::holds(PUBLISHED, &SPIRALS, &[]).under(&holding(READINGS, [0])).of(&PAPER),
            &Check::holds(
                REPAIRED,
                &SPIRALS,
                &[NamedRule::new("P_high from present positions", Subject::high_from_present())],
            ),
            &Check::holds(REEL, &SPIRALS, &[]),
        ],
    },
    Clause {
        id: "CHAIN-10",
        sentence: "A chain of N robots MUST need at least 9(N−1)−1 team moves to explore (2N−1)² cells.",
        checks: &[
            &ring::CHECK,
            &Check::holds(
                PUBLISHED,
                &EveryAnswer { body: small::ring_cells, range: small::rings, covers: &["a ring"] },
                &[],
            ),
            &Check::holds(PUBLISHED, &SOLVED, &[]),
            &Check::holds(
                REPAIRED,
                &SOLVED,
                &[NamedRule::new("without E_S ahead", Subject::without(SafeAhead))],
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
            &Check::holds(SPARING, &EveryLayout(Invariant::Cheap, FOUR_FEWER_WALLS), &[LAVISH]),
            &CHEAP,
        ],
    },
    Clause {
        id: "CHAIN-13",
        sentence: "When a run ends, every cell within reach of the chain MUST be explored.",
        checks: &[
            &Check::refuted(PUBLISHED, &EveryArea(Invariant::Without(Breach::Completeness), AREAS, READ))
                .under(&holding(READINGS, []))
                .of(&PAPER),
            &unfolding::CHECK,
            &Check::holds(
                REPAIRED,
                &EveryLayout(Invariant::Without(Breach::Completeness), FOUR_ROBOTS),
                &[NamedRule::new("without unfolding", Subject::without(Unfold))],
            ),
            &Check::holds(
                UNHELD,
                &EveryLayout(Invariant::Without(Breach::Completeness), FOUR_FEWER_WALLS),
                &[],
            ),
            &Check::holds(
                REEL,
                &EveryLayout(Invariant::Without(Breach::Completeness), FOUR_FEWER_WALLS),
                &[],
            ),
        ],
    },
    Clause {
        id: "CHAIN-14",
        sentence: "When a run ends, every chain-reachable cell MUST be explored.",
        checks: &[
            &Check::refuted(PUBLISHED, &EveryArea(Invariant::Exhausts, AREAS, READ))
                .under(&holding(READINGS, []))
                .of(&PAPER),
            &Check::holds(
                REPAIRED,
                &EveryLayout(Invariant::Exhausts, (3, 2)),
                &[NamedRule::new("without unfolding", Subject::without(Unfold))],
            ),
            &Check::refuted(REPAIRED, &EveryArea(Invariant::Exhausts, AREAS, READ))
                .because("no repair yet: walls part the ways of neighbours"),
        ],
    },
    Clause {
        id: "CHAIN-15",
        sentence: "As published a chain of three robots MUST keep to CHAIN-1 and CHAIN-2 in every layout.",
        checks: &[
            &contact_of_three::CHECK,
            &Check::holds(
                PUBLISHED,
                &EveryLayout(Invariant::Without(Breach::Contact), THREE_ROBOTS),
                &[NamedRule::new(
                    "without E_S ahead",
                    Subject::following(Rule::PUBLISHED.without(SafeAhead)),
                )],
            ),
            &Check::holds(PUBLISHED, &EveryLayout(Invariant::Without(Breach::Crowding), THREE_ROBOTS), &[]),
            &Check::holds(
                NamedRule::new("published", OfThree(Rule::PUBLISHED)),
                &local::THREE,
                &[
                    NamedRule::new("without E_S ahead", OfThree(Rule::PUBLISHED.without(SafeAhead))),
                    NamedRule::new("without E_C behind", OfThree(Rule::PUBLISHED.without(CoveredBehind))),
                ],
            ),
        ],
    },
];

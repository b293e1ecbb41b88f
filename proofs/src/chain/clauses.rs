//! The clauses of the chain, in the order of `SPEC.md`.

use tautline_kernel::chain::Condition::{
    CoveredBehind, Distinct, EpochMustGain, FullForFollower, FullForLeader, Hold, NoExchange, PartsAtOnce,
    RefusedIsVirtual, SafeAhead, Unfold, UnsureAhead,
};
use tautline_kernel::chain::{Budget, Condition, Habit, Rule};
use tautline_kernel::ground::Circle;

use super::every_area::EveryArea;
use super::invariant::Invariant;
use super::local::{self, Contact, Coverage, Crowd, OfThree};
use super::readings::PAPER;
use super::search::EveryLayout;
use super::subject::{
    Deception, LAST, READINGS, Subject, base_follows, high_from_present, safe_too_wide, swapped_bits,
};
use super::{crowd, optimum, pair, small, three, walk, whole_runs};
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
pub(super) const APART: NamedRule<Subject> = NamedRule::new("apart", Subject::APART);
pub(super) const UNHELD: NamedRule<Subject> = NamedRule::new("unheld", Subject::UNHELD);
const SPARING: NamedRule<Subject> = NamedRule::new("sparing", Subject::SPARING);

/// The published rule as a mutant of another one.
const AS_PUBLISHED: NamedRule<Subject> = NamedRule::new("as published", Subject::PUBLISHED);

/// `subject` without one condition, under its name.
pub(super) const fn lacking(subject: Subject, condition: Condition) -> NamedRule<Subject> {
    let name = match condition {
        SafeAhead => "without E_S ahead",
        CoveredBehind => "without E_C behind",
        Distinct => "without distinctness",
        RefusedIsVirtual => "refusals leave no obstacle",
        EpochMustGain => "epochs need no gain",
        UnsureAhead => "without unsure neighbour",
        FullForFollower => "without full cell for followers",
        FullForLeader => "without full cell for the leader",
        Unfold => "without unfolding",
        Hold => "without hold",
        NoExchange => "without exchange forbidden",
        PartsAtOnce => "without parting at once",
    };
    NamedRule::new(name, subject.without(condition))
}

/// The contact of any number of robots that follow this rule; with faults, whichever of them go.
pub(super) const fn in_contact<const FAULTS: bool>(named: NamedRule<Subject>) -> NamedRule<Contact<FAULTS>> {
    NamedRule::new(named.name, Contact(named.rule.rule))
}

/// Any number of robots that follow this rule, at most two in a cell.
const fn uncrowded(named: NamedRule<Subject>) -> NamedRule<Crowd<2>> {
    NamedRule::new(named.name, Crowd::of(named.rule.rule))
}

/// The distance of any number of robots that follow this rule.
const fn covered(named: NamedRule<Subject>) -> NamedRule<Coverage> {
    NamedRule::new(named.name, Coverage(named.rule.rule))
}

/// Three robots that follow this rule.
const fn of_three(named: NamedRule<Subject>) -> NamedRule<OfThree> {
    NamedRule::new(named.name, OfThree(named.rule.rule))
}

step_checks! { Subject;
    contact: pair::contact, REPAIRED, pair::neighbours,
        covers ["both are blocked", "both arrive", "the robot ahead is blocked", "the robot behind is blocked"],
        unwind 6, mutants {
            published: "as published" => Subject::PUBLISHED,
            without_unsure_ahead: "without unsure neighbour" => Subject::REPAIRED.without(UnsureAhead),
            without_safe_ahead: "without E_S ahead" => Subject::REPAIRED.without(SafeAhead),
            without_covered_behind: "without E_C behind" => Subject::REPAIRED.without(CoveredBehind),
            covered_too_wide: "E_C widened" => Subject::REPAIRED.with_covered(WIDER),
        };
    crowding: crowd::crowding, REPAIRED, crowd::crowds,
        covers ["none arrives", "one arrives", "two arrive", "two were there"], unwind 6, mutants {
            published: "as published" => Subject::PUBLISHED,
            without_full_for_follower: "without full cell for followers" => Subject::REPAIRED.without(FullForFollower),
            without_full_for_leader: "without full cell for the leader" => Subject::REPAIRED.without(FullForLeader),
            without_distinct: "without distinctness" => Subject::REPAIRED.without(Distinct),
        };
    coverage: pair::coverage, PUBLISHED, pair::neighbours,
        covers ["both are blocked", "both arrive", "the robot ahead is blocked", "the robot behind is blocked"],
        unwind 6, mutants {
            without_safe_ahead: "without E_S ahead" => Subject::PUBLISHED.without(SafeAhead),
            safe_too_wide: "E_S with the radius of E_C" => Subject::PUBLISHED.with_safe(Circle::COVERED),
        };
    message: small::message, REPAIRED, small::messages,
        covers ["a byte", "a message", "no message"], unwind 6, mutants {
            swapped_bits: "message bits swapped" => Subject::REPAIRED.deceiving(Deception::SwappedBits),
        };
    contact_of_three: three::contact, PUBLISHED, three::places,
        covers ["R_2 may do anything else", "R_2 stays"], unwind 6, mutants {
            high_from_present: "P_high from present positions" =>
                Subject::PUBLISHED.high_from_present(),
            without_safe_ahead: "without E_S ahead" => Subject::PUBLISHED.without(SafeAhead),
            without_covered_behind: "without E_C behind" =>
                Subject::PUBLISHED.without(CoveredBehind),
        };
    ring: small::ring_of_neighbours, PUBLISHED, small::pairs_in_rings,
        covers ["farther in", "farther out", "in the same ring"], unwind 6, mutants {
            safe_too_wide: "E_S with the radius of E_C" => Subject::PUBLISHED.with_safe(Circle::COVERED),
            without_safe_ahead: "without E_S ahead" => Subject::PUBLISHED.without(SafeAhead),
        };
    unfolding: walk::unfolding, REPAIRED, walk::walks,
        covers ["both go on", "both stay", "the robot ahead goes on"], unwind 6, mutants {
            safe_too_narrow: "E_S narrowed to E_N" => Subject::REPAIRED.with_safe(NARROWER),
            covered_too_narrow: "E_C with the radius of E_S" => Subject::REPAIRED.with_covered(Circle::SAFE),
        };
}

/// The bound within which the smallest counterexamples are looked for.
pub(super) const AREAS: Most = Most { cells: 10, barriers: 13, robots: 2..=5 };

/// The part of it in which counterexamples to other readings are sought: the plain recursion plays these.
const READ: Most = Most { cells: 10, barriers: 2, robots: 3..=4 };

/// As [`READ`], where two walls are too few.
const READ_AMONG_FOUR_WALLS: Most = Most { cells: 10, barriers: 4, robots: 4..=4 };

/// The check of four robots in the paper's area.
const fn four_robots(invariant: Invariant) -> EveryLayout {
    EveryLayout(invariant, (4, 4))
}

/// The check of the planner's clauses: of four robots, too, but with one wall fewer.
pub(super) const fn fewer_walls(invariant: Invariant) -> EveryLayout {
    EveryLayout(invariant, (4, 3))
}

/// Five robots, which may meet as many walls as are soon looked at.
pub(super) const FIVE_TWO_WALLS: (usize, u32) = (5, 2);

/// The bound of the clause about chains of three.
const THREE_ROBOTS: (usize, u32) = (3, 5);

/// Rules under which runs do not end.
const ENDLESS: [NamedRule<Subject>; 2] =
    [lacking(Subject::REPAIRED, EpochMustGain), lacking(Subject::REPAIRED, RefusedIsVirtual)];

/// Reels that do not end, or gain nothing where they said so.
pub(super) const UNREHEARSED: NamedRule<Subject> =
    NamedRule::new("tasks are not rehearsed", Subject::REEL.without_habits(&[Habit::Rehearses]));
pub(super) const FICKLE: NamedRule<Subject> =
    NamedRule::new("stages go back", Subject::REEL.without_habits(&[Habit::KeepsTask]));

/// The mutant of a reel, as one that need not hold.
pub(super) const fn unheld(reel: NamedRule<Subject>) -> NamedRule<Subject> {
    NamedRule::new(reel.name, Subject { intended: Subject::UNHELD.rule, ..reel.rule.without(Hold) })
}

/// Followers kept nearer than the planners reckon with.
pub(super) const fn narrowed(subject: Subject) -> NamedRule<Subject> {
    NamedRule::new("E_S narrowed to E_N", subject.with_safe(NARROWER))
}

/// The mutant of a reel, as one whose robots keep apart.
pub(super) const fn apart(reel: NamedRule<Subject>) -> NamedRule<Subject> {
    let rule = reel.rule.rule.with(NoExchange).with(PartsAtOnce);
    NamedRule::new(reel.name, Subject { intended: Subject::APART.rule, ..reel.rule.following(rule) })
}

/// A reel that claims to hold contact whoever stays.
pub(super) const NOT_HELD: NamedRule<Subject> = lacking(Subject::REEL, Hold);

const ENDS: [&str; 2] = ["everything explored", "exhausted"];

const SPIRALS: EveryAnswer<Subject> =
    EveryAnswer::new(whole_runs::spiral, whole_runs::spirals, &["an open area"]);

const SOLVED: EveryAnswer<Subject> =
    EveryAnswer::new(optimum::least_in_the_open, optimum::solved, &["an open area"]);

const SAME_PLAN: Check<Subject> = Check::holds(
    REPAIRED,
    &EveryAnswer::new(whole_runs::same_plan_in_all_layouts, whole_runs::layouts_with_few_walls, &ENDS),
    &[
        high_from_present(Subject::REPAIRED),
        lacking(Subject::REPAIRED, Distinct),
        lacking(Subject::REPAIRED, RefusedIsVirtual),
        lacking(Subject::REPAIRED, Unfold),
        NamedRule::new("nobody ahead is sure to arrive", Subject::REPAIRED.deceiving(Deception::DoubtsAll)),
    ],
);

const SAME_PLAN_AT_RANDOM: RandomAnswers<Subject> =
    RandomAnswers::new(whole_runs::same_plan_in_random_layouts, 100, whole_runs::random_layouts, &ENDS);

/// A team that claims a budget and has none.
const LAVISH: NamedRule<Subject> = NamedRule::new(
    "no budget",
    Subject::SPARING.following(Rule { budget: Budget::Unlimited, ..Rule::REPAIRED }),
);

const CHEAP: Check<Subject> = Check::unrefuted(
    REPAIRED,
    &RandomAnswers::new(whole_runs::cheap, 44, whole_runs::cheap_runs, &["a longer run"]),
    &[NamedRule::new("the plain recursion", Subject::REPAIRED.deceiving(Deception::PlainRecursion))],
);

const DEAR: Check<Subject> = Check::refuted(
    PUBLISHED,
    &RandomAnswers::new(
        whole_runs::cheap_among_few_walls,
        100,
        whole_runs::runs_among_few_walls,
        &["a longer run"],
    ),
);

/// The clauses.
pub const CLAUSES: [Clause; 15] = [
    Clause {
        id: "CHAIN-1",
        sentence: "After every team move each robot MUST be in E_C of its neighbours in the chain.",
        checks: &[
            &Check::refuted(PUBLISHED, &EveryArea(Invariant::CONTACT, AREAS, READ_AMONG_FOUR_WALLS))
                .under(&holding([LAST], []))
                .of(&PAPER),
            &contact::CHECK,
            &Check::holds(
                REPAIRED,
                &four_robots(Invariant::CONTACT),
                &[AS_PUBLISHED, lacking(Subject::REPAIRED, UnsureAhead)],
            ),
            &Check::holds(UNHELD, &fewer_walls(Invariant::CONTACT), &[lacking(Subject::UNHELD, UnsureAhead)]),
            &Check::holds(REEL, &fewer_walls(Invariant::CONTACT), &[lacking(Subject::REEL, SafeAhead)]),
            &Check::holds(APART, &fewer_walls(Invariant::CONTACT), &[lacking(Subject::APART, SafeAhead)]),
            &Check::holds(
                in_contact::<false>(REPAIRED),
                &EveryNumber::DEFAULT,
                &[
                    in_contact(AS_PUBLISHED),
                    in_contact(lacking(Subject::REPAIRED, SafeAhead)),
                    in_contact(lacking(Subject::REPAIRED, CoveredBehind)),
                ],
            ),
            &Check::holds(
                in_contact::<false>(REEL),
                &EveryNumber::DEFAULT,
                &[in_contact(lacking(Subject::REEL, CoveredBehind))],
            ),
        ],
    },
    Clause {
        id: "CHAIN-2",
        sentence: "There MUST never be three robots or more in one cell other than the base.",
        checks: &[
            &Check::refuted(PUBLISHED, &EveryArea(Invariant::CROWDING, AREAS, READ))
                .under(&holding(READINGS, []))
                .of(&PAPER),
            &crowding::CHECK,
            &Check::holds(
                REPAIRED,
                &four_robots(Invariant::CROWDING),
                &[AS_PUBLISHED, lacking(Subject::REPAIRED, FullForLeader)],
            ),
            &Check::holds(UNHELD, &fewer_walls(Invariant::CROWDING), &[lacking(Subject::UNHELD, Distinct)]),
            &Check::holds(
                REEL,
                &four_robots(Invariant::CROWDING),
                &[lacking(Subject::REEL, Distinct), lacking(Subject::REEL, FullForLeader)],
            ),
            &Check::holds(APART, &fewer_walls(Invariant::CROWDING), &[lacking(Subject::APART, Distinct)]),
            &Check::holds(
                uncrowded(REPAIRED),
                &EveryNumber::DEFAULT,
                &[
                    uncrowded(AS_PUBLISHED),
                    uncrowded(lacking(Subject::REPAIRED, FullForFollower)),
                    uncrowded(lacking(Subject::REPAIRED, FullForLeader)),
                    uncrowded(lacking(Subject::REPAIRED, Distinct)),
                ],
            ),
            &Check::holds(
                uncrowded(REEL),
                &EveryNumber::DEFAULT,
                &[uncrowded(lacking(Subject::REEL, Distinct))],
            ),
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
                &four_robots(Invariant::COVERAGE),
                &[lacking(Subject::PUBLISHED, SafeAhead)],
            ),
            &Check {
                about: UNCOVERED,
                mutants: &[lacking(Subject::UNCOVERED, SafeAhead), safe_too_wide(Subject::UNCOVERED)],
                ..coverage::CHECK
            },
            &Check::holds(REEL, &fewer_walls(Invariant::COVERAGE), &[lacking(Subject::REEL, SafeAhead)]),
            &Check::holds(
                covered(PUBLISHED),
                &EveryNumber::DEFAULT,
                &[covered(lacking(Subject::PUBLISHED, SafeAhead))],
            ),
            &Check::holds(
                covered(UNCOVERED),
                &EveryNumber::DEFAULT,
                &[covered(lacking(Subject::UNCOVERED, SafeAhead))],
            ),
            &Check::holds(
                covered(REEL),
                &EveryNumber::DEFAULT,
                &[covered(lacking(Subject::REEL, SafeAhead))],
            ),
        ],
    },
    Clause {
        id: "CHAIN-4",
        sentence: "Every step of a planned team move MUST be admitted by the conditions of the rule.",
        checks: &[
            &Check::holds(
                PUBLISHED,
                &fewer_walls(Invariant::Admitted),
                &[lacking(Subject::PUBLISHED, SafeAhead), lacking(Subject::PUBLISHED, CoveredBehind)],
            ),
            &Check::holds(
                REPAIRED,
                &fewer_walls(Invariant::Admitted),
                &[
                    lacking(Subject::REPAIRED, SafeAhead),
                    lacking(Subject::REPAIRED, CoveredBehind),
                    lacking(Subject::REPAIRED, UnsureAhead),
                    lacking(Subject::REPAIRED, FullForFollower),
                    lacking(Subject::REPAIRED, FullForLeader),
                ],
            ),
            &Check::holds(
                REEL,
                &fewer_walls(Invariant::Admitted),
                &[lacking(Subject::REEL, SafeAhead), lacking(Subject::REEL, CoveredBehind)],
            ),
            &Check::holds(REEL, &EveryLayout(Invariant::Admitted, FIVE_TWO_WALLS), &[NOT_HELD]),
            &Check::holds(
                APART,
                &fewer_walls(Invariant::Admitted),
                &[lacking(Subject::APART, SafeAhead), lacking(Subject::APART, NoExchange)],
            ),
        ],
    },
    Clause {
        id: "CHAIN-5",
        sentence: "In a planned team move every robot MUST have a cell of its own, the base excepted.",
        checks: &[
            &Check::holds(
                PUBLISHED,
                &fewer_walls(Invariant::Distinct),
                &[lacking(Subject::PUBLISHED, Distinct)],
            ),
            &Check::holds(
                REPAIRED,
                &fewer_walls(Invariant::Distinct),
                &[lacking(Subject::REPAIRED, Distinct)],
            ),
            &Check::holds(REEL, &fewer_walls(Invariant::Distinct), &[lacking(Subject::REEL, Distinct)]),
        ],
    },
    Clause {
        id: "CHAIN-6",
        sentence: "The base MUST never plan to move, and never move.",
        checks: &[
            &Check::holds(REPAIRED, &fewer_walls(Invariant::BaseStays), &[base_follows(Subject::REPAIRED)]),
            &Check::holds(REEL, &fewer_walls(Invariant::BaseStays), &[base_follows(Subject::REEL)]),
        ],
    },
    Clause {
        id: "CHAIN-7",
        sentence: "Every run MUST end.",
        checks: &[
            &Check::holds(REPAIRED, &fewer_walls(Invariant::Progress), &ENDLESS),
            &Check::holds(
                PUBLISHED,
                &four_robots(Invariant::Ends),
                &[lacking(Subject::PUBLISHED, RefusedIsVirtual)],
            )
            .under(&holding([("goes on", Subject::PUBLISHED.without(EpochMustGain))], [])),
            &Check::holds(REPAIRED, &four_robots(Invariant::Ends), &ENDLESS),
            &Check::holds(REEL, &fewer_walls(Invariant::Ends), &[UNREHEARSED, FICKLE]),
        ],
    },
    Clause {
        id: "CHAIN-8",
        sentence: "One byte for each robot and team move MUST be enough to know the state of the whole team.",
        checks: &[
            &message::CHECK,
            &Check::holds(REPAIRED, &fewer_walls(Invariant::Heard), &[swapped_bits(Subject::REPAIRED)]),
            &Check::holds(REEL, &fewer_walls(Invariant::Heard), &[swapped_bits(Subject::REEL)]),
        ],
    },
    Clause {
        id: "CHAIN-9",
        sentence: "Without obstacles a chain of N robots MUST have explored all (2N−1)² cells after exactly \
                   9(N−1)−1 team moves.",
        checks: &[
            &Check::holds(PUBLISHED, &SPIRALS, &[high_from_present(Subject::PUBLISHED)])
                .under(&holding(READINGS, [0]))
                .of(&PAPER),
            &Check::holds(REPAIRED, &SPIRALS, &[high_from_present(Subject::REPAIRED)]),
            &Check::holds(REEL, &SPIRALS, &[high_from_present(Subject::REEL)]),
        ],
    },
    Clause {
        id: "CHAIN-10",
        sentence: "A chain of N robots MUST need at least 9(N−1)−1 team moves to explore (2N−1)² cells.",
        checks: &[
            &ring::CHECK,
            &Check::holds(PUBLISHED, &SOLVED, &[lacking(Subject::PUBLISHED, SafeAhead)]),
            &Check::holds(REPAIRED, &SOLVED, &[lacking(Subject::REPAIRED, SafeAhead)]),
        ],
    },
    Clause {
        id: "CHAIN-11",
        sentence: "A plan that keeps within its budget MUST be the one that the plain recursion of the paper returns.",
        checks: &[
            &Check {
                about: PUBLISHED,
                mutants: &[
                    high_from_present(Subject::PUBLISHED),
                    lacking(Subject::PUBLISHED, Distinct),
                    lacking(Subject::PUBLISHED, RefusedIsVirtual),
                ],
                ..SAME_PLAN
            },
            &SAME_PLAN,
            &Check { method: &SAME_PLAN_AT_RANDOM, expected: Verdict::Unrefuted, ..SAME_PLAN },
        ],
    },
    Clause {
        id: "CHAIN-12",
        sentence: "A plan MUST look at no more candidates of followers than its budget of 100 for each robot.",
        checks: &[&DEAR, &Check::holds(SPARING, &fewer_walls(Invariant::Cheap), &[LAVISH]), &CHEAP],
    },
    Clause {
        id: "CHAIN-13",
        sentence: "When a run ends, every cell within reach of the chain MUST be explored.",
        checks: &[
            &Check::refuted(PUBLISHED, &EveryArea(Invariant::COMPLETENESS, AREAS, READ))
                .under(&holding(READINGS, []))
                .of(&PAPER),
            &unfolding::CHECK,
            &Check::holds(
                REPAIRED,
                &four_robots(Invariant::COMPLETENESS),
                &[lacking(Subject::REPAIRED, Unfold)],
            ),
            &Check::holds(
                UNHELD,
                &fewer_walls(Invariant::COMPLETENESS),
                &[lacking(Subject::UNHELD, Distinct)],
            ),
            &Check::holds(REEL, &fewer_walls(Invariant::COMPLETENESS), &[lacking(Subject::REEL, Distinct)]),
            &Check::holds(APART, &fewer_walls(Invariant::COMPLETENESS), &[narrowed(Subject::APART)]),
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
                &[lacking(Subject::REPAIRED, Unfold)],
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
                &EveryLayout(Invariant::CONTACT, THREE_ROBOTS),
                &[lacking(Subject::PUBLISHED, SafeAhead)],
            ),
            &Check::holds(
                of_three(PUBLISHED),
                &local::THREE,
                &[
                    of_three(lacking(Subject::PUBLISHED, SafeAhead)),
                    of_three(lacking(Subject::PUBLISHED, CoveredBehind)),
                ],
            ),
        ],
    },
];

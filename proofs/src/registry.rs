//! The list of all clauses, in the order of `SPEC.md`.

use tautline_kernel::bricks::Condition::{Alone, Corners, Laps, LeastCrossed, SecondPass, SeenOnly};
use tautline_kernel::bricks::{self, Precedence};
use tautline_kernel::chain::Condition::{
    CoveredBehind, Distinct, EpochMustGain, FullForFollower, FullForLeader, RefusedIsVirtual, SafeAhead,
    Unfold, UnsureAhead,
};
use tautline_kernel::chain::{Budget, High, Rule};
use tautline_kernel::ground::Circle;
use tautline_kernel::mrc;
use tautline_kernel::mrc::Condition::{
    AnswersAgain, ChoiceStands, Consent, Epochs, LeastIdentity, NearestCall, NearestRobot, Renewal,
    Repetition, StillAsks, Window,
};
use tautline_kernel::notice::Condition::{FirstHeard, FrozenOnceForwarded, LeastHops, RememberEvent};

use crate::bricks::Floors;
use crate::clause::{Body, Check, Clause, Method, Misread, Mutant, Range, Sabotage, Subject, Verdict};
use crate::invariant::Invariant;
use crate::notice::Networks;
use crate::rescue::{self as rescues, Demand, Faults, Leases, Lossy, Setting};
use crate::run::Breach;
use crate::{crowd, frontier, homing, marking, notice, optimum, pair, small, three, walk, whole};

/// A mutant.
const fn mutant(name: &'static str, subject: Subject) -> Mutant {
    Mutant { name, subject }
}

/// A check that nobody breaks.
const fn search(
    subject: Subject,
    invariant: Invariant,
    (robots, max_walls): (usize, u32),
    expected: Verdict,
    mutants: &'static [Mutant],
) -> Check {
    Check { subject, method: Method::Search { robots, max_walls, invariant }, expected, mutants }
}

/// Registers checks that go through every answer to the choices of a body, and makes of each a test, a property
/// and, where `unwind` is given, Kani harnesses: one that must succeed, and one for each mutant that must fail.
macro_rules! exhaustive {
    ($($name:ident: $body:path, $subject:expr, $range:path, covers $covers:expr, unwind $unwind:literal,
       mutants { $($mutant:ident: $what:literal => $wrong:expr),* $(,)? };)*) => {$(
        mod $name {
            use super::*;

            pub(super) const CHECK: Check = Check {
                subject: $subject,
                method: Method::Exhaustive { body: $body, range: $range, covers: &$covers },
                expected: Verdict::Holds,
                mutants: &[$(mutant($what, $wrong)),*],
            };

            #[cfg(test)]
            mod test {
                use super::*;

                #[test]
                fn holds_exhaustively_and_rejects_its_mutants() {
                    crate::registry::tests::decides(&CHECK);
                }

                #[test]
                fn holds_for_any_tape_and_rejects_its_mutants() {
                    crate::registry::tests::holds_for_any_tape($body, &CHECK);
                }
            }

            #[cfg(kani)]
            mod harness {
                use super::*;

                #[kani::proof]
                #[kani::unwind($unwind)]
                fn holds() {
                    crate::symbolic::prove($body, &$subject);
                }

                $(#[kani::proof]
                #[kani::unwind($unwind)]
                #[kani::should_panic]
                fn $mutant() {
                    crate::symbolic::prove($body, &$wrong);
                })*
            }
        }
    )*};
}

exhaustive! {
    environments: small::environments, Subject::PUBLISHED, small::offsets,
        covers ["in E_C alone", "in E_N", "in E_S alone", "in none"], unwind 6, mutants {
            safe_too_wide: "E_S with the radius of E_C" => Subject::with_safe(Circle::COVERED),
            covered_too_narrow: "E_C with the radius of E_S" => Subject::with_covered(Circle::SAFE),
            covered_too_wide: "E_C widened" => Subject::with_covered(WIDER),
        };
    contact: pair::contact, Subject::REPAIRED, pair::neighbours,
        covers ["both are blocked", "both arrive", "the robot ahead is blocked", "the robot behind is blocked"],
        unwind 6, mutants {
            published: "as published" => Subject::PUBLISHED,
            without_unsure_ahead: "without unsure neighbour" => Subject::without(UnsureAhead),
            without_safe_ahead: "without E_S ahead" => Subject::without(SafeAhead),
            without_covered_behind: "without E_C behind" => Subject::without(CoveredBehind),
            covered_too_wide: "E_C widened" => Subject::with_covered(WIDER),
        };
    crowding: crowd::crowding, Subject::REPAIRED, crowd::crowds,
        covers ["none arrives", "one arrives", "two arrive", "two were there"], unwind 6, mutants {
            published: "as published" => Subject::PUBLISHED,
            without_full_for_follower: "without full cell for followers" => Subject::without(FullForFollower),
            without_full_for_leader: "without full cell for the leader" => Subject::without(FullForLeader),
            without_distinct: "without distinctness" => Subject::without(Distinct),
        };
    coverage: pair::coverage, Subject::PUBLISHED, pair::neighbours,
        covers ["both are blocked", "both arrive", "the robot ahead is blocked", "the robot behind is blocked"],
        unwind 6, mutants {
            without_safe_ahead: "without E_S ahead" => Subject::following(Rule::PUBLISHED.without(SafeAhead)),
            safe_too_wide: "E_S with the radius of E_C" => Subject::with_safe(Circle::COVERED),
        };
    message: small::message, Subject::REPAIRED, small::messages,
        covers ["a byte", "a message", "no message"], unwind 6, mutants {
            swapped_bits: "message bits swapped" => Subject::sabotaged(Sabotage::SwappedBits),
        };
    contact_of_three: three::contact, Subject::PUBLISHED, three::places,
        covers ["R_2 may do anything else", "R_2 stays"], unwind 6, mutants {
            high_from_present: "P_high from present positions" =>
                Subject::following(Rule { high: High::Present, ..Rule::PUBLISHED }),
            without_safe_ahead: "without E_S ahead" => Subject::following(Rule::PUBLISHED.without(SafeAhead)),
            without_covered_behind: "without E_C behind" =>
                Subject::following(Rule::PUBLISHED.without(CoveredBehind)),
        };
    ring: small::ring_of_neighbours, Subject::PUBLISHED, small::pairs_in_rings,
        covers ["farther in", "farther out", "in the same ring"], unwind 6, mutants {
            safe_too_wide: "E_S with the radius of E_C" => Subject::with_safe(Circle::COVERED),
            without_safe_ahead: "without E_S ahead" => Subject::without(SafeAhead),
        };
    unfolding: walk::unfolding, Subject::REPAIRED, walk::walks,
        covers ["both go on", "both stay", "the robot ahead goes on"], unwind 6, mutants {
            safe_too_narrow: "E_S narrowed to E_N" => Subject::with_safe(NARROWER),
            covered_too_narrow: "E_C with the radius of E_S" => Subject::with_covered(Circle::SAFE),
        };
    neighbourhood: marking::neighbourhood, Subject::PUBLISHED, marking::neighbourhoods,
        covers ["explored", "visited"], unwind 17, mutants {
            without_corners: "without corners" => NO_CORNERS,
        };
    walled: marking::walled, Subject::REPAIRED, marking::walled_neighbourhoods,
        covers ["explored", "visited"], unwind 17, mutants {
            without_corners: "without corners" => NO_CORNERS,
        };
    localised: marking::localised, Subject::PUBLISHED, marking::errors,
        covers ["a sensor"], unwind 9, mutants {
            badly: "errors of more than half a cell" => Subject::sabotaged(Sabotage::LocalisesBadly),
        };
    half_seen: marking::half_seen, Subject::ROBUST, marking::readings,
        covers ["explored", "visited"], unwind 17, mutants {
            without_seen_only: "ways through what reads as unexplored" => Subject::marking_twice_without(SeenOnly),
        };
    second_event: notice::second_event, Subject::REPAIRED, notice::later_events,
        covers ["silent about the first", "through with the first", "unaware of the first", "waiting with the first"],
        unwind 12, mutants {
            published: "as published" => Subject::PUBLISHED,
        };
}

/// Agents that do not look at corners.
const NO_CORNERS: Subject = Subject::marking(bricks::Rule::REPAIRED.without(Corners));

/// Agents that mark cells in which others are.
const NOT_ALONE: Subject = Subject::marking(bricks::Rule::REPAIRED.without(Alone));

/// Agents that walk no laps.
const NO_LAPS: Subject = Subject::marking(bricks::Rule::REPAIRED.without(Laps));

/// Agents that are robust against missed sensors but for one thing.
const TRUSTING: Mutant =
    mutant("ways through what reads as unexplored", Subject::marking_twice_without(SeenOnly));
const ONCE_OVER: Mutant = mutant("nothing gone over twice", Subject::marking_twice_without(SecondPass));
const EARLY_LAPS: Mutant = mutant("laps in the first pass", Subject::marking_twice_without(LeastCrossed));

/// Agents whose laps are told apart in another way.
const fn laps(precedence: Precedence) -> Subject {
    Subject::marking(bricks::Rule { precedence, ..bricks::Rule::REPAIRED })
}

/// A check of every state of agents on small floors.
const fn floors(subject: Subject, floors: Floors, expected: Verdict, mutants: &'static [Mutant]) -> Check {
    Check { subject, method: Method::Floors(floors), expected, mutants }
}

/// A check of every state of every network of up to five nodes.
const fn states(networks: Networks, expected: Verdict, mutants: &'static [Mutant]) -> Check {
    Check { subject: Subject::PUBLISHED, method: Method::Spread(networks), expected, mutants }
}

/// The same of random runs in larger networks.
const fn spreads(
    body: Body,
    range: Range,
    covers: &'static [&'static str],
    mutants: &'static [Mutant],
) -> Check {
    Check {
        subject: Subject::PUBLISHED,
        method: Method::Sampled { body, runs: 500, range, covers },
        expected: Verdict::Unrefuted,
        mutants,
    }
}

const LATER: Mutant =
    mutant("a later NOTICE with HC ≤ own changes the parent", Subject::hearing_without(FrozenOnceForwarded));

const UNFROZEN: [Mutant; 1] = [LATER];

const ANOTHER_PARENT: [Mutant; 3] = [
    LATER,
    mutant("the parent is the last heard", Subject::hearing_without(LeastHops)),
    mutant("of equal HC the last heard", Subject::hearing_without(FirstHeard)),
];

const FORGETFUL: [Mutant; 1] =
    [mutant("who has forwarded an event forgets it", Subject::hearing_without(RememberEvent))];

const FINITE: [Mutant; 1] = [mutant("k = ∞ is taken for 1", Subject::sabotaged(Sabotage::FiniteForEndless))];

/// The next larger circle: E_C with eight cells more.
const WIDER: Circle = Circle::new(34);

/// The next smaller circle than that of E_S: the cell and its four side neighbours.
const NARROWER: Circle = Circle::new(10);

/// The bound at which the published rule first fails with four robots.
const FOUR_ROBOTS: (usize, u32) = (4, 4);

/// The bound of the planner's clauses: four robots, too, but one wall fewer.
const FOUR_FEWER_WALLS: (usize, u32) = (4, 3);

/// The bound of the clause about chains of three.
const THREE_ROBOTS: (usize, u32) = (3, 5);

/// Every clause, in the order of `SPEC.md`.
pub static CLAUSES: [Clause; 45] = [
    Clause {
        id: "LATTICE-1",
        sentence: "The environments derived from the radii MUST be the sets that the paper draws: E_N the cell and \
                   its four side neighbours, E_S the block of nine cells, E_C that block and the four cells two \
                   steps straight ahead.",
        checks: &[environments::CHECK],
    },
    Clause {
        id: "LATTICE-2",
        sentence: "The distance of a robot to the frontier MUST be the fewest steps to an unexplored cell, for a follower \
                   over edges that are not known to be walls, for the leader over those of them without a virtual \
                   obstacle.",
        checks: &[
            flooded(
                (frontier::in_six_cells, frontier::small_maps),
                &["a frontier", "no frontier"],
                &[mutant("virtual obstacles bind followers", Subject::sabotaged(Sabotage::BindsFollowers))],
            ),
            flooded(
                (frontier::along_every_line, frontier::lines),
                &["a column", "a row"],
                &[mutant("a line is not flooded", Subject::sabotaged(Sabotage::SkipsALine))],
            ),
        ],
    },
    Clause {
        id: "CHAIN-1",
        sentence: "After every team move each robot MUST be in E_C of its neighbours in the chain.",
        checks: &[
            search(
                Subject::PUBLISHED,
                Invariant::Without(Breach::Contact),
                FOUR_ROBOTS,
                Verdict::Refuted,
                &[],
            ),
            contact::CHECK,
            search(
                Subject::REPAIRED,
                Invariant::Without(Breach::Contact),
                FOUR_ROBOTS,
                Verdict::Holds,
                &[
                    mutant("as published", Subject::PUBLISHED),
                    mutant("without unsure neighbour", Subject::without(UnsureAhead)),
                ],
            ),
        ],
    },
    Clause {
        id: "CHAIN-2",
        sentence: "There MUST never be three robots or more in one cell other than the base.",
        checks: &[
            search(
                Subject::PUBLISHED,
                Invariant::Without(Breach::Crowding),
                FOUR_ROBOTS,
                Verdict::Refuted,
                &[],
            ),
            crowding::CHECK,
            search(
                Subject::REPAIRED,
                Invariant::Without(Breach::Crowding),
                FOUR_ROBOTS,
                Verdict::Holds,
                &[mutant("as published", Subject::PUBLISHED)],
            ),
        ],
    },
    Clause {
        id: "CHAIN-3",
        sentence: "During every team move, at whatever speeds the robots move, the centres of neighbours in the \
                   chain MUST stay within r_cov of each other.",
        checks: &[
            coverage::CHECK,
            search(
                Subject::PUBLISHED,
                Invariant::Without(Breach::Coverage),
                FOUR_ROBOTS,
                Verdict::Holds,
                &[mutant("without E_S ahead", Subject::following(Rule::PUBLISHED.without(SafeAhead)))],
            ),
            Check { subject: Subject::UNCOVERED, ..coverage::CHECK },
        ],
    },
    Clause {
        id: "CHAIN-4",
        sentence: "Every step of a planned team move MUST be admitted by the conditions of the rule.",
        checks: &[
            search(Subject::PUBLISHED, Invariant::Admitted, FOUR_FEWER_WALLS, Verdict::Holds, &[]),
            search(
                Subject::REPAIRED,
                Invariant::Admitted,
                FOUR_FEWER_WALLS,
                Verdict::Holds,
                &[
                    mutant("without E_S ahead", Subject::without(SafeAhead)),
                    mutant("without E_C behind", Subject::without(CoveredBehind)),
                    mutant("without unsure neighbour", Subject::without(UnsureAhead)),
                    mutant("without full cell for followers", Subject::without(FullForFollower)),
                    mutant("without full cell for the leader", Subject::without(FullForLeader)),
                ],
            ),
        ],
    },
    Clause {
        id: "CHAIN-5",
        sentence: "In a planned team move every robot MUST have a cell of its own, the base excepted.",
        checks: &[
            search(Subject::PUBLISHED, Invariant::Distinct, FOUR_FEWER_WALLS, Verdict::Holds, &[]),
            search(
                Subject::REPAIRED,
                Invariant::Distinct,
                FOUR_FEWER_WALLS,
                Verdict::Holds,
                &[mutant("without distinctness", Subject::without(Distinct))],
            ),
        ],
    },
    Clause {
        id: "CHAIN-6",
        sentence: "The base MUST never plan to move, and never move.",
        checks: &[search(
            Subject::REPAIRED,
            Invariant::BaseStays,
            FOUR_FEWER_WALLS,
            Verdict::Holds,
            &[mutant("the base follows R_2", Subject::sabotaged(Sabotage::BaseFollows))],
        )],
    },
    Clause {
        id: "CHAIN-7",
        sentence: "Every run MUST end.",
        checks: &[
            search(Subject::REPAIRED, Invariant::Progress, FOUR_FEWER_WALLS, Verdict::Holds, &ENDLESS),
            search(Subject::PUBLISHED, Invariant::Ends, FOUR_ROBOTS, Verdict::Holds, &[]),
            search(Subject::REPAIRED, Invariant::Ends, FOUR_ROBOTS, Verdict::Holds, &ENDLESS),
        ],
    },
    Clause {
        id: "CHAIN-8",
        sentence: "One byte for each robot and team move MUST be enough to know the state of the whole team.",
        checks: &[
            message::CHECK,
            search(
                Subject::REPAIRED,
                Invariant::Heard,
                FOUR_FEWER_WALLS,
                Verdict::Holds,
                &[mutant("message bits swapped", Subject::sabotaged(Sabotage::SwappedBits))],
            ),
        ],
    },
    Clause {
        id: "CHAIN-9",
        sentence: "Without obstacles a chain of N robots MUST have explored all (2N−1)² cells after exactly \
                   9(N−1)−1 team moves.",
        checks: &[
            runs(Subject::PUBLISHED, &[]),
            runs(Subject::REPAIRED, &[mutant("P_high from present positions", Subject::high_from_present())]),
        ],
    },
    Clause {
        id: "CHAIN-10",
        sentence: "A chain of N robots MUST need at least 9(N−1)−1 team moves to explore (2N−1)² cells.",
        checks: &[
            ring::CHECK,
            Check {
                subject: Subject::PUBLISHED,
                method: Method::Exhaustive {
                    body: small::ring_cells,
                    range: small::rings,
                    covers: &["a ring"],
                },
                expected: Verdict::Holds,
                mutants: &[],
            },
            solved(Subject::PUBLISHED, &[]),
            solved(Subject::REPAIRED, &[mutant("without E_S ahead", Subject::without(SafeAhead))]),
        ],
    },
    Clause {
        id: "CHAIN-11",
        sentence: "A plan that keeps within its budget MUST be the one that the plain recursion of the paper returns.",
        checks: &[
            Check { subject: Subject::PUBLISHED, ..SAME_PLAN },
            SAME_PLAN,
            Check {
                method: Method::Sampled {
                    body: whole::same_plan_in_random_layouts,
                    runs: 100,
                    range: whole::random_layouts,
                    covers: &ENDS,
                },
                expected: Verdict::Unrefuted,
                ..SAME_PLAN
            },
        ],
    },
    Clause {
        id: "CHAIN-12",
        sentence: "A plan MUST look at no more candidates of followers than its budget of 100 for each robot.",
        checks: &[
            DEAR,
            search(Subject::SPARING, Invariant::Cheap, FOUR_FEWER_WALLS, Verdict::Holds, &[LAVISH]),
            CHEAP,
        ],
    },
    Clause {
        id: "CHAIN-13",
        sentence: "When a run ends, every cell within reach of the chain MUST be explored.",
        checks: &[
            search(
                Subject::PUBLISHED,
                Invariant::Without(Breach::Completeness),
                FOUR_ROBOTS,
                Verdict::Refuted,
                &[],
            ),
            unfolding::CHECK,
            search(
                Subject::REPAIRED,
                Invariant::Without(Breach::Completeness),
                FOUR_ROBOTS,
                Verdict::Holds,
                &[mutant("without unfolding", Subject::without(Unfold))],
            ),
        ],
    },
    Clause {
        id: "CHAIN-14",
        sentence: "When a run ends, every chain-reachable cell MUST be explored.",
        checks: &[
            search(Subject::PUBLISHED, Invariant::Exhausts, (3, 2), Verdict::Refuted, &[]),
            search(
                Subject::REPAIRED,
                Invariant::Exhausts,
                (3, 2),
                Verdict::Holds,
                &[mutant("without unfolding", Subject::without(Unfold))],
            ),
            search(Subject::REPAIRED, Invariant::Exhausts, (3, 3), Verdict::Refuted, &[]),
        ],
    },
    Clause {
        id: "CHAIN-15",
        sentence: "As published a chain of three robots MUST keep to CHAIN-1 and CHAIN-2 in every layout.",
        checks: &[
            contact_of_three::CHECK,
            search(
                Subject::PUBLISHED,
                Invariant::Without(Breach::Contact),
                THREE_ROBOTS,
                Verdict::Holds,
                &[mutant("without E_S ahead", Subject::following(Rule::PUBLISHED.without(SafeAhead)))],
            ),
            search(
                Subject::PUBLISHED,
                Invariant::Without(Breach::Crowding),
                THREE_ROBOTS,
                Verdict::Holds,
                &[],
            ),
        ],
    },
    Clause {
        id: "ANTS-1",
        sentence: "Ants MUST explore every cell that is connected with their start, whatever sensors are missed a \
                   finite number of times.",
        checks: &[
            Check {
                subject: Subject::PUBLISHED,
                method: Method::Ants,
                expected: Verdict::Holds,
                mutants: &[],
            },
            Check {
                subject: Subject::REPAIRED,
                method: Method::Ants,
                expected: Verdict::Holds,
                mutants: &[mutant("sensors count nothing", Subject::sabotaged(Sabotage::CountsNothing))],
            },
        ],
    },
    Clause {
        id: "BRICKS-1",
        sentence: "Marking a cell MUST leave its accessible side neighbours connected with each other through the \
                   eight cells around it.",
        checks: &[neighbourhood::CHECK, walled::CHECK, half_seen::CHECK],
    },
    Clause {
        id: "BRICKS-2",
        sentence: "The accessible cells MUST stay connected.",
        checks: &[
            floors(
                Subject::PUBLISHED,
                Floors::CONNECTED_ALONE,
                Verdict::Holds,
                &[mutant("without corners", NO_CORNERS)],
            ),
            floors(
                Subject::REPAIRED,
                Floors::CONNECTED,
                Verdict::Holds,
                &[
                    mutant("without corners", NO_CORNERS),
                    mutant("no lap gives way to another", laps(Precedence::Nobody)),
                ],
            ),
            floors(Subject::ROBUST, Floors::CONNECTED_HALF_BLIND, Verdict::Holds, &[TRUSTING, ONCE_OVER]),
        ],
    },
    Clause {
        id: "BRICKS-3",
        sentence: "It MUST be enough for BRICKS-2 that two agents take turns whose scans overlap.",
        checks: &[floors(
            Subject::REPAIRED,
            Floors::CONNECTED_IN_TURNS,
            Verdict::Holds,
            &[mutant("agents beside each other act at once", Subject::sabotaged(Sabotage::ActsAtOnce))],
        )],
    },
    Clause {
        id: "BRICKS-4",
        sentence: "An agent MUST be done only when every cell is explored and no other cell is left to go through.",
        checks: &[
            floors(Subject::PUBLISHED, Floors::KNOWING, Verdict::Refuted, &[]),
            floors(
                Subject::REPAIRED,
                Floors::KNOWING,
                Verdict::Holds,
                &[mutant("marks cells in which others are", NOT_ALONE)],
            ),
            floors(Subject::PUBLISHED, Floors::KNOWING_HALF_BLIND, Verdict::Refuted, &[]),
            floors(
                Subject::ROBUST,
                Floors::KNOWING_HALF_BLIND,
                Verdict::Holds,
                &[TRUSTING, ONCE_OVER, EARLY_LAPS],
            ),
        ],
    },
    Clause {
        id: "BRICKS-5",
        sentence: "Every cell MUST be explored, whatever sensors are missed a finite number of times.",
        checks: &[
            floors(Subject::PUBLISHED, Floors::EXPLORES_HALF_BLIND, Verdict::Refuted, &[]),
            floors(Subject::ROBUST, Floors::EXPLORES_HALF_BLIND, Verdict::Holds, &[TRUSTING, ONCE_OVER]),
        ],
    },
    Clause {
        id: "BRICKS-6",
        sentence: "Every run in which every agent acts again and again MUST end with every cell visited, whatever \
                   sensors are missed a finite number of times.",
        checks: &[
            floors(Subject::PUBLISHED, Floors::ENDS_ALONE, Verdict::Refuted, &[]),
            floors(
                Subject::REPAIRED,
                Floors::ENDS,
                Verdict::Holds,
                &[
                    mutant("both laps give way", laps(Precedence::Everybody)),
                    mutant("marks cells in which others are", NOT_ALONE),
                    mutant("walks no laps", NO_LAPS),
                ],
            ),
            floors(
                Subject::ROBUST,
                Floors::ENDS_TWICE,
                Verdict::Holds,
                &[mutant("walks no laps", Subject::marking_twice_without(Laps))],
            ),
            floors(Subject::PUBLISHED, Floors::ENDS_HALF_BLIND, Verdict::Refuted, &[]),
            floors(
                Subject::ROBUST,
                Floors::ENDS_HALF_BLIND,
                Verdict::Holds,
                &[TRUSTING, ONCE_OVER, EARLY_LAPS],
            ),
        ],
    },
    Clause {
        id: "BRICKS-7",
        sentence: "A sensor that is localised with an error of less than half a cell MUST be taken for the one of its \
                   cell.",
        checks: &[localised::CHECK],
    },
    Clause {
        id: "NOTICE-1",
        sentence: "At every moment the parent pointers MUST form a tree rooted at the source, each node one hop \
                   farther from it than its parent.",
        checks: &[
            states(notice::TREE, Verdict::Holds, &UNFROZEN),
            spreads(notice::tree_at_random, notice::random_networks, &notice::SPREADS, &UNFROZEN),
        ],
    },
    Clause {
        id: "NOTICE-2",
        sentence: "A node MUST forward an event at most once.",
        checks: &[
            states(notice::ONCE, Verdict::Holds, &FORGETFUL),
            spreads(notice::once_at_random, notice::random_networks, &notice::SPREADS, &FORGETFUL),
        ],
    },
    Clause {
        id: "NOTICE-3",
        sentence: "With k = ∞ every node that links connect to the source MUST receive the event and forward it, as \
                   under flooding.",
        checks: &[
            states(notice::FLOOD, Verdict::Holds, &FINITE),
            spreads(notice::flood_at_random, notice::random_floods, &["most nodes forward"], &FINITE),
        ],
    },
    Clause {
        id: "NOTICE-4",
        sentence: "A node MUST take the first NOTICE of a newer event of a source as a first one, whatever it has \
                   made of the events before.",
        checks: &[
            Check {
                subject: Subject::PUBLISHED,
                expected: Verdict::Refuted,
                mutants: &[],
                ..second_event::CHECK
            },
            second_event::CHECK,
        ],
    },
    Clause {
        id: "NOTICE-5",
        sentence: "Every node that links connect to the source MUST receive the event.",
        checks: &[
            states(notice::REACH_WITH_ONE, Verdict::Refuted, &[]),
            states(notice::REACH_WITH_TWO, Verdict::Refuted, &[]),
            states(notice::REACH_WITH_ALL, Verdict::Holds, &FINITE),
        ],
    },
    Clause {
        id: "NOTICE-6",
        sentence: "Of the senders that a node has heard before it forwards or falls silent, its parent MUST be one with \
                   the least hop count, and of several the first heard.",
        checks: &[
            states(notice::NEAREST_PARENT, Verdict::Holds, &ANOTHER_PARENT),
            spreads(
                notice::nearest_parent_at_random,
                notice::random_networks,
                &notice::SPREADS,
                &ANOTHER_PARENT,
            ),
        ],
    },
    Clause {
        id: "MRC-1",
        sentence: "Two robots MUST never be on their way for the same call of a WFR.",
        checks: &[
            rescued(Subject::PUBLISHED, Demand::OneRobotForACall, TWO_AND_ONE, Verdict::Refuted, &[]),
            rescued(
                Subject::REPAIRED,
                Demand::OneRobotForACall,
                TWO,
                Verdict::Holds,
                &[mutant("redecide on a late MOVE", REDECIDE)],
            ),
            rescued(Subject::REPAIRED, Demand::OneRobotForACall, TWO_LONGER, Verdict::Holds, &[]),
            rescued(Subject::REPAIRED, Demand::OneRobotForACall, THREE_AND_TWO, Verdict::Holds, &[]),
        ],
    },
    Clause {
        id: "MRC-2",
        sentence: "Two WFRs MUST never count on the same robot.",
        checks: &[
            rescued(Subject::PUBLISHED, Demand::OneCallForARobot, ONE_AND_TWO, Verdict::Refuted, &[]),
            rescued(
                Subject::REPAIRED,
                Demand::OneCallForARobot,
                TWO,
                Verdict::Holds,
                &[mutant("no consent", NO_CONSENT)],
            ),
            rescued(Subject::REPAIRED, Demand::OneCallForARobot, TWO_LONGER, Verdict::Holds, &[]),
            rescued(Subject::REPAIRED, Demand::OneCallForARobot, THREE_AND_TWO, Verdict::Holds, &[]),
        ],
    },
    Clause {
        id: "MRC-3",
        sentence: "A WFR MUST choose the best of the MOVEs that it has received when its window closes.",
        checks: &[
            rescued(Subject::PUBLISHED, Demand::BestOfTheWindow, TWO_AND_ONE, Verdict::Refuted, &[]),
            rescued(
                Subject::REPAIRED,
                Demand::BestOfTheWindow,
                TWO,
                Verdict::Holds,
                &[
                    mutant("no collection window", Subject::rescuing(mrc::Rule::REPAIRED.without(Window))),
                    mutant("redecide on a late MOVE", REDECIDE),
                    mutant(
                        "the least MID, however far",
                        Subject::rescuing(mrc::Rule::REPAIRED.without(NearestRobot)),
                    ),
                    mutant("of equal MHC the first heard", FIRST_OF_EQUALS),
                    mutant(
                        "the first MOVE heard",
                        Subject::rescuing(mrc::Rule::REPAIRED.without(NearestRobot).without(LeastIdentity)),
                    ),
                    mutant("no epoch", NO_EPOCH),
                ],
            ),
            rescued(Subject::REPAIRED, Demand::BestOfTheWindow, TWO_LONGER, Verdict::Holds, &[]),
            rescued(Subject::REPAIRED, Demand::BestOfTheWindow, THREE_AND_TWO, Verdict::Holds, &[]),
        ],
    },
    Clause {
        id: "MRC-4",
        sentence: "A WFR MUST count on a robot only if the robot has taken the lease of its call.",
        checks: &[
            rescued(Subject::PUBLISHED, Demand::CountsOnConsent, TWO_AND_ONE, Verdict::Refuted, &[]),
            rescued(
                Subject::REPAIRED,
                Demand::CountsOnConsent,
                TWO,
                Verdict::Holds,
                &[mutant("no consent", NO_CONSENT)],
            ),
            rescued(Subject::REPAIRED, Demand::CountsOnConsent, TWO_LONGER, Verdict::Holds, &[]),
            rescued(Subject::REPAIRED, Demand::CountsOnConsent, THREE_AND_TWO, Verdict::Holds, &[]),
        ],
    },
    Clause {
        id: "MRC-5",
        sentence: "A WFR that waits MUST be rescued in the end, as long as a robot lives that its calls reach.",
        checks: &[
            rescued(Subject::PUBLISHED, Demand::IsServed, TWO_AND_ONE, Verdict::Refuted, &[]),
            rescued(
                Subject::REPAIRED,
                Demand::IsServed,
                TWO_AND_ONE,
                Verdict::Holds,
                &[
                    mutant("no renewal", Subject::rescuing(mrc::Rule::REPAIRED.without(Renewal))),
                    mutant("no epoch", NO_EPOCH),
                ],
            ),
            rescued(
                Subject::REPAIRED,
                Demand::IsServed,
                ONE_AND_TWO,
                Verdict::Holds,
                &[mutant(
                    "late MOVEs unanswered",
                    Subject::rescuing(mrc::Rule::REPAIRED.without(AnswersAgain).without(Repetition)),
                )],
            ),
            rescued(Subject::REPAIRED, Demand::IsServed, TWO, Verdict::Holds, &[]),
            rescued(Subject::REPAIRED, Demand::IsServed, TWO_LONGER, Verdict::Holds, &[]),
            rescued(Subject::REPAIRED, Demand::IsServed, THREE_AND_TWO, Verdict::Holds, &[]),
        ],
    },
    Clause {
        id: "MRC-6",
        sentence: "A robot that hears a call under a new epoch MUST have its SBit clear.",
        checks: &[
            rescued(Subject::PUBLISHED, Demand::AsksAnew, TWO_AND_ONE, Verdict::Refuted, &[]),
            rescued(
                Subject::REPAIRED,
                Demand::AsksAnew,
                TWO,
                Verdict::Holds,
                &[mutant("no epoch", NO_EPOCH)],
            ),
            rescued(Subject::REPAIRED, Demand::AsksAnew, TWO_LONGER, Verdict::Holds, &[]),
            rescued(Subject::REPAIRED, Demand::AsksAnew, THREE_AND_TWO, Verdict::Holds, &[]),
        ],
    },
    Clause {
        id: "MRC-7",
        sentence: "A free robot MUST ask for the nearest of the calls that it has heard and whose SBit is clear, until it is \
                   set.",
        checks: &[
            rescued(
                Subject::PUBLISHED,
                Demand::AsksNearest,
                ONE_AND_THREE,
                Verdict::Holds,
                &[
                    mutant(
                        "the least SN, however far",
                        Subject::rescuing(mrc::Rule::PUBLISHED.without(NearestCall)),
                    ),
                    mutant(
                        "of equal HC the first heard",
                        Subject::rescuing(mrc::Rule::PUBLISHED.without(LeastIdentity)),
                    ),
                ],
            ),
            rescued(
                Subject::REPAIRED,
                Demand::AsksNearest,
                TWO,
                Verdict::Holds,
                &[
                    mutant(
                        "the least SN, however far",
                        Subject::rescuing(mrc::Rule::REPAIRED.without(NearestCall)),
                    ),
                    mutant("of equal HC the first heard", FIRST_OF_EQUALS),
                    mutant(
                        "the first call heard",
                        Subject::rescuing(mrc::Rule::REPAIRED.without(NearestCall).without(LeastIdentity)),
                    ),
                ],
            ),
            rescued(Subject::REPAIRED, Demand::AsksNearest, ONE_AND_THREE, Verdict::Holds, &[]),
            rescued(Subject::REPAIRED, Demand::AsksNearest, THREE_AND_TWO, Verdict::Holds, &[]),
        ],
    },
    Clause {
        id: "MRC-8",
        sentence: "A robot MUST take the lease of a call only when it is told, while it asks for that call, that it is \
                   chosen.",
        checks: &[
            rescued(Subject::PUBLISHED, Demand::TakesWhatItAsksFor, TWO_AND_ONE, Verdict::Refuted, &[]),
            rescued(
                Subject::REPAIRED,
                Demand::TakesWhatItAsksFor,
                TWO,
                Verdict::Holds,
                &[
                    mutant(
                        "it no longer asks, and accepts",
                        Subject::rescuing(mrc::Rule::REPAIRED.without(StillAsks)),
                    ),
                    mutant("no consent", NO_CONSENT),
                ],
            ),
            rescued(Subject::REPAIRED, Demand::TakesWhatItAsksFor, TWO_LONGER, Verdict::Holds, &[]),
            rescued(Subject::REPAIRED, Demand::TakesWhatItAsksFor, THREE_AND_TWO, Verdict::Holds, &[]),
        ],
    },
    Clause {
        id: "MRC-9",
        sentence: "A WFR MUST tell its choice to every robot whose MOVE of its call it has received, and to no other.",
        checks: &[
            rescued(Subject::PUBLISHED, Demand::TellsWhoAsked, TWO_AND_ONE, Verdict::Refuted, &[]),
            rescued(
                Subject::REPAIRED,
                Demand::TellsWhoAsked,
                TWO,
                Verdict::Holds,
                &[mutant(
                    "late MOVEs unanswered",
                    Subject::rescuing(mrc::Rule::REPAIRED.without(AnswersAgain)),
                )],
            ),
            rescued(Subject::REPAIRED, Demand::TellsWhoAsked, TWO_LONGER, Verdict::Holds, &[]),
            rescued(Subject::REPAIRED, Demand::TellsWhoAsked, THREE_AND_TWO, Verdict::Holds, &[]),
        ],
    },
    Clause {
        id: "MRC-10",
        sentence: "Of each WFR a robot MUST record the newest call that it has heard, one hop more than the fewest under \
                   it and the first node that told it so, and bid by that record.",
        checks: &[
            Check { subject: Subject::PUBLISHED, expected: Verdict::Refuted, mutants: &[], ..RECORDS },
            RECORDS,
        ],
    },
    Clause {
        id: "MRC-11",
        sentence: "A path node MUST send a robot's message on to its own parent, and a RESB of the robot's newest call to \
                   whom the robot's latest message of it came from.",
        checks: &[WAYS_BACK],
    },
    Clause {
        id: "MRC-12",
        sentence: "A robot MUST set the SBit of a call when it is told whom the WFR has chosen or has asked in vain, and \
                   keep it until it hears a newer call.",
        checks: &[SERVED],
    },
    Clause {
        id: "TAN-1",
        sentence: "A robot MUST follow only the signal of the node that it has asked, one hop nearer than itself in the \
                   tree of its WFR.",
        checks: &[FOLLOWS],
    },
    Clause {
        id: "TAN-2",
        sentence: "A robot that has come to a node MUST have arrived if the node is its WFR, and ask the node's parent \
                   next if it is not.",
        checks: &[GOES_ON],
    },
];

/// A step of a rescue, whatever one machine hears.
const fn heard(
    body: Body,
    range: Range,
    covers: &'static [&'static str],
    mutants: &'static [Mutant],
) -> Check {
    let method = Method::Exhaustive { body, range, covers };
    Check { subject: Subject::REPAIRED, method, expected: Verdict::Holds, mutants }
}

const fn misreads(misread: Misread) -> Subject {
    Subject::sabotaged(Sabotage::Misreads(misread))
}

const RECORDS: Check = heard(
    rescues::records,
    rescues::notices,
    &["one call", "several calls"],
    &[mutant("no epoch", NO_EPOCH)],
);

const SERVED: Check = heard(
    rescues::served,
    rescues::answers,
    &["asked in vain", "no SBit", "told of a choice"],
    &[mutant("no epoch", NO_EPOCH)],
);

const WAYS_BACK: Check = heard(
    rescues::ways_back,
    rescues::messages,
    &["a way back", "no way back"],
    &[
        mutant("all robots are one", misreads(Misread::OneRobot)),
        mutant("all calls are one", misreads(Misread::OneCall)),
    ],
);

const FOLLOWS: Check = heard(
    homing::follows,
    homing::signals,
    &["a signal followed", "a signal ignored"],
    &[
        mutant("any nearer node", misreads(Misread::AnyNearer)),
        mutant("any node", misreads(Misread::AnyNode)),
        mutant("any tree", misreads(Misread::AnyTree)),
    ],
);

const GOES_ON: Check = heard(
    homing::goes_on,
    homing::signals,
    &["at a node", "at the WFR", "no signal followed", "the signal lost"],
    &[mutant("a node is its own parent", misreads(Misread::NoParent))],
);

const REDECIDE: Subject = Subject::rescuing(mrc::Rule::REPAIRED.without(ChoiceStands));
const FIRST_OF_EQUALS: Subject = Subject::rescuing(mrc::Rule::REPAIRED.without(LeastIdentity));
const NO_EPOCH: Subject = Subject::rescuing(mrc::Rule::REPAIRED.without(Epochs));
const NO_CONSENT: Subject = Subject::rescuing(mrc::Rule::REPAIRED.without(Consent));

/// The settings of a rescue.
const TWO: Setting = Setting {
    rule: mrc::Rule::REPAIRED,
    robots: 2,
    wfrs: 2,
    events: 2,
    max_hops: 2,
    faults: Faults::any(1),
    lossy: Lossy::All,
    leases: Leases::UntilCalled,
};
const TWO_LONGER: Setting = Setting { events: 3, max_hops: 1, ..TWO };
const THREE_AND_TWO: Setting = Setting { robots: 3, max_hops: 1, ..TWO };
const TWO_AND_ONE: Setting = Setting { wfrs: 1, ..TWO };
const ONE_AND_TWO: Setting = Setting { robots: 1, events: 3, ..TWO };
const ONE_AND_THREE: Setting = Setting { robots: 1, wfrs: 3, events: 3, ..TWO };

const fn rescued(
    subject: Subject,
    demand: Demand,
    setting: Setting,
    expected: Verdict,
    mutants: &'static [Mutant],
) -> Check {
    Check { subject, method: Method::States { setting, demand }, expected, mutants }
}

const fn runs(subject: Subject, mutants: &'static [Mutant]) -> Check {
    let range = whole::spirals;
    let method = Method::Exhaustive { body: whole::spiral, range, covers: &["an open area"] };
    Check { subject, method, expected: Verdict::Holds, mutants }
}

const fn flooded(
    (body, range): (Body, Range),
    covers: &'static [&'static str],
    mutants: &'static [Mutant],
) -> Check {
    let method = Method::Exhaustive { body, range, covers };
    Check { subject: Subject::PUBLISHED, method, expected: Verdict::Holds, mutants }
}

const fn solved(subject: Subject, mutants: &'static [Mutant]) -> Check {
    let (body, range): (Body, Range) = (optimum::least_in_the_open, optimum::solved);
    let method = Method::Exhaustive { body, range, covers: &["an open area"] };
    Check { subject, method, expected: Verdict::Holds, mutants }
}

/// Rules under which runs do not end.
const ENDLESS: [Mutant; 2] = [
    mutant("epochs need no gain", Subject::without(EpochMustGain)),
    mutant("refusals leave no obstacle", Subject::without(RefusedIsVirtual)),
];

const ENDS: [&str; 2] = ["everything explored", "exhausted"];

const SAME_PLAN: Check = Check {
    subject: Subject::REPAIRED,
    method: Method::Exhaustive {
        body: whole::same_plan_in_all_layouts,
        range: whole::layouts_with_few_walls,
        covers: &ENDS,
    },
    expected: Verdict::Holds,
    mutants: &[
        mutant("P_high from present positions", Subject::high_from_present()),
        mutant("without distinctness", Subject::without(Distinct)),
        mutant("refusals leave no obstacle", Subject::without(RefusedIsVirtual)),
        mutant("without unfolding", Subject::without(Unfold)),
        mutant("nobody ahead is sure to arrive", Subject::sabotaged(Sabotage::DoubtsAll)),
    ],
};

/// A team that claims a budget and has none.
const LAVISH: Mutant = mutant(
    "no budget",
    Subject { rule: Rule { budget: Budget::Unlimited, ..Rule::REPAIRED }, ..Subject::SPARING },
);

const CHEAP: Check = Check {
    subject: Subject::REPAIRED,
    method: Method::Sampled {
        body: whole::cheap,
        runs: 44,
        range: whole::cheap_runs,
        covers: &["a longer run"],
    },
    expected: Verdict::Unrefuted,
    mutants: &[mutant("the plain recursion", Subject::sabotaged(Sabotage::PlainRecursion))],
};

const DEAR: Check = Check {
    subject: Subject::PUBLISHED,
    method: Method::Sampled {
        body: whole::cheap_among_few_walls,
        runs: 100,
        range: whole::runs_among_few_walls,
        covers: &["a longer run"],
    },
    expected: Verdict::Refuted,
    mutants: &[],
};

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use proptest::test_runner::{Config, RngAlgorithm, TestRng, TestRunner};

    use super::*;
    use crate::decide::Prover;
    use crate::engine::{Stop, Tape};
    use crate::search::unwatched;

    /// The check comes out as registered, and every mutant is rejected.
    pub(super) fn decides(check: &Check) {
        let decision = Prover::default().decide(check, &mut unwatched).expect("registered checks fit");
        assert!(decision.is_as_registered(check), "{}: {decision:?}", check.method.bound());
    }

    /// No tape breaks the check, and proptest breaks every mutant.
    pub(super) fn holds_for_any_tape(body: Body, check: &Check) {
        let broken = |subject: &Subject| {
            let config = Config { cases: 20_000, failure_persistence: None, ..Config::default() };
            let rng = TestRng::deterministic_rng(RngAlgorithm::ChaCha);
            TestRunner::new_with_rng(config, rng)
                .run(&prop::collection::vec(0_u32..3600, 16), |tape| match body(subject, &mut Tape(&tape)) {
                    Err(Stop::Violated(demand)) => Err(TestCaseError::fail(demand)),
                    Err(Stop::Assumed | Stop::GivenUp) | Ok(_) => Ok(()),
                })
                .is_err()
        };
        assert!(!broken(&check.subject), "{}", check.method.bound());
        for mutant in check.mutants {
            assert!(broken(&mutant.subject), "{} survives", mutant.name);
        }
    }

    #[test]
    fn whatever_one_machine_hears_the_clauses_hold_and_their_mutants_are_rejected() {
        for check in [&RECORDS, &SERVED, &WAYS_BACK, &FOLLOWS, &GOES_ON] {
            decides(check);
        }
    }

    #[test]
    fn every_id_is_there_once_and_every_clause_has_a_mutant() {
        for (place, clause) in CLAUSES.iter().enumerate() {
            assert!(CLAUSES[..place].iter().all(|other| other.id != clause.id), "{} twice", clause.id);
            assert!(
                clause.checks.iter().any(|check| !check.mutants.is_empty()),
                "{} has no mutant",
                clause.id
            );
            assert!(clause.sentence.contains("MUST"), "{}", clause.id);
        }
    }

    #[test]
    fn every_check_is_about_a_rule_with_a_name() {
        for clause in &CLAUSES {
            for check in clause.checks {
                assert!(check.subject.name().is_some(), "{}: {:?}", clause.id, check.subject);
            }
        }
        let labels = |id: &str| -> Vec<&str> {
            let clause = CLAUSES.iter().find(|clause| clause.id == id).expect("a clause");
            clause.checks.iter().filter_map(|check| check.subject.name()).collect()
        };
        assert_eq!(labels("BRICKS-4"), ["published", "repaired", "published", "robust"]);
        assert_eq!(labels("BRICKS-6"), ["published", "repaired", "robust", "published", "robust"]);
    }

    #[test]
    fn what_is_sampled_is_never_said_to_hold() {
        for clause in &CLAUSES {
            for check in clause.checks {
                let is_sampled = check.method.engine() == "sampled";
                let expected = if is_sampled { Verdict::Unrefuted } else { Verdict::Holds };
                assert_eq!(check.method.shows(), expected, "{}", clause.id);
                let registered = [expected, Verdict::Refuted, Verdict::Open];
                assert!(registered.contains(&check.expected), "{}: {:?}", clause.id, check.expected);
            }
        }
    }

    #[test]
    fn a_bound_names_every_series_that_runs() {
        let bound = Method::Floors(Floors::ENDS).bound();
        assert_eq!(
            bound,
            "1 agent to 4×4; 1 to 3×3 with walls; 2 to 3×2 with walls; 3 to 3×2; 2 to 3×3; 1 to 4×3, patience 2; \
             2 to 4×2, patience 2, at most 2 acts in a row; reach 4"
        );
    }
}

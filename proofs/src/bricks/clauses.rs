//! The clauses of Brick&Mortar, in the order of `SPEC.md`.

use tautline_kernel::bricks::Condition::{Alone, Corners, Laps, LeastCrossed, SecondPass, SeenOnly};
use tautline_kernel::bricks::{Precedence, Rule};

use super::floors::Floors;
use super::tree::checks as tree;
use super::{Deception, Observed, marking};
use crate::clause::{Check, Clause, NamedRule};
use crate::decide::Verdict;
use crate::step_checks;

const PUBLISHED: NamedRule<Observed> = NamedRule::new("published", Observed::marking(Rule::PUBLISHED));
const REPAIRED: NamedRule<Observed> = NamedRule::new("repaired", Observed::marking(Rule::REPAIRED));
const ROBUST: NamedRule<Observed> = NamedRule::new("robust", Observed::marking(Rule::ROBUST));

/// Agents that do not look at corners.
const NO_CORNERS: Observed = Observed::marking(Rule::REPAIRED.without(Corners));

/// Agents that mark cells in which others are.
const NOT_ALONE: Observed = Observed::marking(Rule::REPAIRED.without(Alone));

/// Agents that walk no laps.
const NO_LAPS: Observed = Observed::marking(Rule::REPAIRED.without(Laps));

/// Agents that are robust against missed sensors but for one thing.
const TRUSTING: NamedRule<Observed> =
    NamedRule::new("ways through what reads as unexplored", Observed::marking_twice_without(SeenOnly));
const ONCE_OVER: NamedRule<Observed> =
    NamedRule::new("nothing gone over twice", Observed::marking_twice_without(SecondPass));
const EARLY_LAPS: NamedRule<Observed> =
    NamedRule::new("laps in the first pass", Observed::marking_twice_without(LeastCrossed));

/// Agents whose laps are told apart in another way.
const fn laps(precedence: Precedence) -> Observed {
    Observed::marking(Rule { precedence, ..Rule::REPAIRED })
}

step_checks! { Observed;
    neighbourhood: marking::neighbourhood, PUBLISHED, marking::neighbourhoods,
        covers ["explored", "visited"], unwind 17, mutants {
            without_corners: "without corners" => NO_CORNERS,
        };
    walled: marking::walled, REPAIRED, marking::walled_neighbourhoods,
        covers ["explored", "visited"], unwind 17, mutants {
            without_corners: "without corners" => NO_CORNERS,
        };
    localised: marking::localised, PUBLISHED, marking::errors,
        covers ["a sensor"], unwind 9, mutants {
            badly: "errors of more than half a cell" => Observed::deceiving(Deception::LocalisesBadly),
        };
    ways_on: marking::most_walled, REPAIRED, marking::ways_on,
        covers ["a way on", "nothing unexplored"], unwind 17, mutants {
            no_corners: "corners are not seen" => Observed::deceiving(Deception::MissesCorners),
        };
    half_seen: marking::half_seen, ROBUST, marking::readings,
        covers ["explored", "visited"], unwind 17, mutants {
            without_seen_only: "ways through what reads as unexplored" => Observed::marking_twice_without(SeenOnly),
        };
}

/// The clauses.
pub static CLAUSES: [Clause; 15] = [
    Clause {
        id: "BRICKS-1",
        sentence: "Marking a cell MUST leave its accessible side neighbours connected with each other through the \
                   eight cells around it.",
        checks: &[&neighbourhood::CHECK, &walled::CHECK, &half_seen::CHECK],
    },
    Clause {
        id: "BRICKS-2",
        sentence: "The accessible cells MUST stay connected.",
        checks: &[
            &Check::new(
                PUBLISHED,
                &Floors::CONNECTED_ALONE,
                Verdict::Holds,
                &[NamedRule::new("without corners", NO_CORNERS)],
            ),
            &Check::new(
                REPAIRED,
                &Floors::CONNECTED,
                Verdict::Holds,
                &[
                    NamedRule::new("without corners", NO_CORNERS),
                    NamedRule::new("no lap gives way to another", laps(Precedence::Nobody)),
                ],
            ),
            &Check::new(ROBUST, &Floors::CONNECTED_HALF_BLIND, Verdict::Holds, &[TRUSTING, ONCE_OVER]),
            &tree::TREE_CONNECTED,
            &tree::HELPERS_CONNECTED,
            &tree::ROBUST_CONNECTED,
        ],
    },
    Clause {
        id: "BRICKS-3",
        sentence: "It MUST be enough for BRICKS-2 that two agents take turns whose scans overlap.",
        checks: &[
            &Check::new(
                REPAIRED,
                &Floors::CONNECTED_IN_TURNS,
                Verdict::Holds,
                &[NamedRule::new(
                    "agents beside each other act at once",
                    Observed::deceiving(Deception::ActsAtOnce),
                )],
            ),
            &tree::IN_TURNS,
            &tree::BOTH_AT_ONCE,
        ],
    },
    Clause {
        id: "BRICKS-4",
        sentence: "An agent MUST be done only when every cell is explored and no other cell is left to go through.",
        checks: &[
            &Check::new(PUBLISHED, &Floors::KNOWING, Verdict::Refuted, &[]),
            &Check::new(
                REPAIRED,
                &Floors::KNOWING,
                Verdict::Holds,
                &[NamedRule::new("marks cells in which others are", NOT_ALONE)],
            ),
            &Check::new(PUBLISHED, &Floors::KNOWING_HALF_BLIND, Verdict::Refuted, &[]),
            &Check::new(
                ROBUST,
                &Floors::KNOWING_HALF_BLIND,
                Verdict::Holds,
                &[TRUSTING, ONCE_OVER, EARLY_LAPS],
            ),
            &tree::TREE_KNOWING,
            &tree::HELPERS_KNOWING,
            &tree::MDFS_KNOWING,
            &tree::TREE_HALF_BLIND,
            &tree::ROBUST_KNOWING,
            &tree::DOUBTING_KNOWING,
            &tree::SHIPPED_KNOWING,
        ],
    },
    Clause {
        id: "BRICKS-5",
        sentence: "Every cell MUST be explored, whatever sensors are missed a finite number of times.",
        checks: &[
            &Check::new(PUBLISHED, &Floors::EXPLORES_HALF_BLIND, Verdict::Refuted, &[]),
            &Check::new(ROBUST, &Floors::EXPLORES_HALF_BLIND, Verdict::Holds, &[TRUSTING, ONCE_OVER]),
            &tree::ROBUST_EXPLORES,
        ],
    },
    Clause {
        id: "BRICKS-6",
        sentence: "Every run in which every agent acts again and again MUST end with every cell visited, whatever \
                   sensors are missed a finite number of times.",
        checks: &[
            &Check::new(PUBLISHED, &Floors::ENDS_ALONE, Verdict::Refuted, &[]),
            &Check::new(
                REPAIRED,
                &Floors::ENDS,
                Verdict::Holds,
                &[
                    NamedRule::new("both laps give way", laps(Precedence::Everybody)),
                    NamedRule::new("marks cells in which others are", NOT_ALONE),
                    NamedRule::new("walks no laps", NO_LAPS),
                ],
            ),
            &Check::new(
                ROBUST,
                &Floors::ENDS_TWICE,
                Verdict::Holds,
                &[NamedRule::new("walks no laps", Observed::marking_twice_without(Laps))],
            ),
            &Check::new(PUBLISHED, &Floors::ENDS_HALF_BLIND, Verdict::Refuted, &[]),
            &Check::new(ROBUST, &Floors::ENDS_HALF_BLIND, Verdict::Holds, &[TRUSTING, ONCE_OVER, EARLY_LAPS]),
            &tree::TREE_ENDS,
            &tree::HELPERS_ENDS,
            &tree::ROBUST_ENDS,
            &tree::ROBUST_ENDS_ROUND,
            &tree::DOUBTING_ENDS,
            &tree::DOUBTING_ROUND,
            &tree::SHIPPED_ENDS,
            &tree::SHIPPED_ROUND,
        ],
    },
    Clause {
        id: "BRICKS-7",
        sentence: "A sensor that is localised with an error of less than half a cell MUST be taken for the one of its \
                   cell.",
        checks: &[&localised::CHECK],
    },
    Clause {
        id: "BRICKS-8",
        sentence: "The cells of a tree MUST stay connected through cells of trees whose labels are not lower.",
        checks: &[&tree::TREES_WHOLE],
    },
    Clause {
        id: "BRICKS-9",
        sentence: "Labels MUST never fall from a cell of a tree to its parent.",
        checks: &[&tree::LABELS_RISE],
    },
    Clause {
        id: "BRICKS-10",
        sentence: "As long as there has been one tree at most, an agent MUST make at most four moves a cell.",
        checks: &[&tree::TREE_BOUNDED, &tree::HELPERS_BOUNDED],
    },
    Clause {
        id: "BRICKS-11",
        sentence: "Agents that fail MUST not keep the others from an end with every cell visited.",
        checks: &[&Check::new(REPAIRED, &Floors::SURVIVES, Verdict::Refuted, &[]), &tree::SURVIVES],
    },
    Clause {
        id: "BRICKS-12",
        sentence: "An agent alone MUST make at most two moves a cell.",
        checks: &[&tree::HELPERS_TWICE, &tree::TREE_TWICE],
    },
    Clause {
        id: "BRICKS-13",
        sentence: "An agent that goes to a child MUST go to one that was entered least.",
        checks: &[&tree::LEAST_ENTERED, &tree::HELPERS_LEAST_ENTERED],
    },
    Clause {
        id: "BRICKS-14",
        sentence: "Two trees MUST have different labels; the one before which its agent had founded fewer has the greater.",
        checks: &[&tree::labels_of_trees::CHECK],
    },
    Clause {
        id: "BRICKS-15",
        sentence: "An agent that explores MUST go to the unexplored neighbour with the most inaccessible sides, as far as it \
                   sees them, the first in the order of the compass.",
        checks: &[&ways_on::CHECK],
    },
];

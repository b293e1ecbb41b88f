//! The clauses of Brick&Mortar, in the order of `SPEC.md`.

use tautline_kernel::bricks::Condition::{Alone, Corners, Laps, LeastCrossed, SecondPass, SeenOnly};
use tautline_kernel::bricks::tree::Condition::{
    Bricks, Childless, Exit, LowerOnly, Remembers, Restores, Underfoot,
};
use tautline_kernel::bricks::tree::Rule as TreeRule;
use tautline_kernel::bricks::{Precedence, Rule};
use tautline_kernel::floor::{Ring, Scan, SensorFate};

use super::floors::{
    ALONE, AS_SHIPPED, AT_ONCE, BEHIND_A_WALL, COUNTED, FAILING, HALF_BLIND, HALF_BLIND_PAIR, HELPING,
    IN_ONE_CELL, IN_TURNS, ONE_COUNTED, PAIR, ROUND, ROUND_BLOCKED, ROUND_WALLS, SEVEN_MISSED, THREE,
    THRICE_MISSED, TOGETHER, TREES, TREES_FAILING, TREES_HALF_BLIND, TWICE, pair_of,
};
use super::marking::{self, Eyes, LESS_THAN_HALF, MORE_THAN_HALF};
use super::tree::mdfs::Mdfs;
use super::tree::{Own, To, TravelRule, children, labels};
use crate::ambiguity::Charity::{Charitable, Literal};
use crate::ambiguity::{Ambiguity, Interpretation, Paper};
use crate::clause::{Check, Clause, NamedRule, Reading, holding};
use crate::decide::EveryAnswer;
use crate::floor::series::{Deception, Floors, HOW_OFTEN, MISSED, Subject};
use crate::floor::team::Demand::{Connected, Ends, Explores, Knowing};
use crate::floor::team::FloorProperty::Dark;
use crate::floor::team::{Demand, Demands};
use crate::step_checks;

/// Agents that follow `scheme`, under this name.
const fn named<S: Copy>(name: &'static str, scheme: S) -> NamedRule<Subject<S>> {
    NamedRule::new(name, Subject::of(scheme))
}

/// Agents of `scheme` of which some beside each other act at once, under this name.
const fn at_once<S: Copy>(name: &'static str, scheme: S) -> NamedRule<Subject<S>> {
    NamedRule::new(name, Subject::of(scheme).deceived(Deception::ActsAtOnce))
}

const PUBLISHED: NamedRule<Subject<Rule>> = named("published", Rule::PUBLISHED);
const REPAIRED: NamedRule<Subject<Rule>> = named("repaired", Rule::REPAIRED);
const ROBUST: NamedRule<Subject<Rule>> = named("robust", Rule::ROBUST);

/// The readings of the published rule but for the main one: whether a cell is marked in which another agent is, and
/// where some sensors are missed, which ones, and what becomes of them.
const READINGS: [(&str, Subject<Rule>); 11] = [
    ("alone", Subject::of(Rule::PUBLISHED.with(Alone))),
    ("beside", replacing(Rule::PUBLISHED, SensorFate::Beside)),
    ("alone + beside", replacing(Rule::PUBLISHED.with(Alone), SensorFate::Beside)),
    ("counted", replacing(Rule::PUBLISHED, SensorFate::Counted)),
    ("alone + counted", replacing(Rule::PUBLISHED.with(Alone), SensorFate::Counted)),
    ("in the dark", Subject::of(Rule::PUBLISHED).on(&[Dark])),
    ("alone + in the dark", Subject::of(Rule::PUBLISHED.with(Alone)).on(&[Dark])),
    ("beside + in the dark", replacing(Rule::PUBLISHED, SensorFate::Beside).on(&[Dark])),
    ("alone + beside + in the dark", replacing(Rule::PUBLISHED.with(Alone), SensorFate::Beside).on(&[Dark])),
    ("counted + in the dark", replacing(Rule::PUBLISHED, SensorFate::Counted).on(&[Dark])),
    (
        "alone + counted + in the dark",
        replacing(Rule::PUBLISHED.with(Alone), SensorFate::Counted).on(&[Dark]),
    ),
];

static PAPER: Paper = Paper {
    ambiguities: &[
        Ambiguity {
            words: "nothing is said of two agents in one cell",
            interpretations: &[
                Interpretation::new("together", "a cell in which another agent is may be marked", Literal),
                Interpretation::new("alone", "a cell in which another agent is is not marked", Charitable),
            ],
        },
        MISSED,
        HOW_OFTEN,
    ],
    excluded: &[],
    repairs: &["repaired", "robust"],
};

const fn replacing(rule: Rule, replaced: SensorFate) -> Subject<Rule> {
    Subject::of(Rule { replaced, ..rule })
}

const REFUTED: &[Reading<Subject<Rule>>] = &holding(READINGS, []);
/// That which differs where no sensor is missed.
const SEEING: &[Reading<Subject<Rule>>] = REFUTED.split_at(1).0;
/// An agent that marks no cell in which another one is shuts nobody in.
const KNOWS_ALONE: &[Reading<Subject<Rule>>] = &holding([READINGS[0]], [0]);

/// Alone, an agent beside a cell in the dark never takes itself for done.
const BEFORE_THE_END: &[Reading<Subject<Rule>>] = &holding(READINGS, [6, 8, 10]);

const NOT_ALONE: NamedRule<Subject<Rule>> =
    named("marks cells in which others are", Rule::REPAIRED.without(Alone));

/// Agents that are robust against missed sensors but for one thing.
const TRUSTING: NamedRule<Subject<Rule>> =
    named("ways through what reads as unexplored", Rule::ROBUST.without(SeenOnly));
const ONCE_OVER: NamedRule<Subject<Rule>> =
    named("nothing gone over twice", Rule::ROBUST.without(SecondPass));
const EARLY_LAPS: NamedRule<Subject<Rule>> =
    named("laps in the first pass", Rule::ROBUST.without(LeastCrossed));

/// The repaired rule with laps that are told apart in another way.
const fn laps(precedence: Precedence) -> Rule {
    Rule { precedence, ..Rule::REPAIRED }
}

const TREE: NamedRule<Subject<TreeRule>> = named("tree", TreeRule::TREE);
const HELPERS: NamedRule<Subject<TreeRule>> = named("helpers", TreeRule::HELPERS);
const CAREFUL: NamedRule<Subject<TreeRule>> = named("careful", TreeRule::ROBUST);
const MDFS: NamedRule<Subject<Mdfs>> = named("mdfs", Mdfs);

/// Agents that doubt as they run: they believe three scans in a row.
const DOUBTING: NamedRule<Subject<TreeRule>> = named("doubting", TreeRule::DOUBTING);

/// Agents that believe one scan: three are more to search than larger floors can show.
const DOUBTING_ONCE: NamedRule<Subject<TreeRule>> = named("doubting-1", DOUBTING_RULE);
const DOUBTING_RULE: TreeRule = TreeRule::DOUBTING.reading(1);

/// Agents whose trees all have the same label.
const WRAPPING: NamedRule<Subject<TreeRule>> =
    named("labels that come again", TreeRule { label_bits: 0, ..TreeRule::TREE });

/// A mutant of helpers that differs from them in two things: none is known that differs in one and breaks BRICKS-6
/// within this bound.
const BRICKS_MARKED: NamedRule<Subject<TreeRule>> =
    named("brick-tree, cells marked that have children", TreeRule::TREE.without(Childless));

/// A rule that marks cells without [`Exit`].
const fn no_exits(rule: TreeRule) -> NamedRule<Subject<TreeRule>> {
    named("cells marked without the side left through", rule.without(Exit))
}

/// A rule that marks cells without [`Childless`].
const fn parents_marked(rule: TreeRule) -> NamedRule<Subject<TreeRule>> {
    named("cells marked that have children", rule.without(Childless))
}

/// Helpers that go where `to` says.
const fn going(name: &'static str, to: To) -> NamedRule<Subject<TravelRule>> {
    named(name, TravelRule { rule: TreeRule::HELPERS, to })
}

/// Agents of brick-tree that go where `to` says.
const fn choosing(name: &'static str, to: To) -> NamedRule<TravelRule> {
    NamedRule::new(name, TravelRule { rule: TreeRule::TREE, to })
}

/// The words for a rule against missed sensors with [`Bricks`].
const BRICKS_SEEN: &str = "cells marked that do not block, as far as is seen";

/// Careful agents that mark bricks: one that misses the only neighbour left is done.
const HASTY: NamedRule<Subject<TreeRule>> = named(BRICKS_SEEN, TreeRule::ROBUST.with(Bricks));

/// The words for a rule without [`LowerOnly`].
const TWICE_ADOPTED: &str = "cells of the same tree adopted once more";

/// The demands on agents that search in trees alone.
const fn own(own: Own) -> Demand<Own> {
    Demand::Own(own)
}

/// A check that holds.
const fn holds<S: Demands>(
    about: NamedRule<Subject<S>>,
    floors: &'static Floors<S::Own>,
    mutants: &'static [NamedRule<Subject<S>>],
) -> Check<Subject<S>> {
    Check::holds(about, floors, mutants)
}

/// A check that is refuted.
const fn refuted<S: Demands>(
    about: NamedRule<Subject<S>>,
    floors: &'static Floors<S::Own>,
) -> Check<Subject<S>> {
    Check::refuted(about, floors)
}

step_checks! { Rule;
    neighbourhood: marking::neighbourhood, NamedRule::new("published", Rule::PUBLISHED), marking::neighbourhoods,
        covers ["explored", "visited"], unwind 17, mutants {
            without_corners: "without corners" => Rule::PUBLISHED.without(Corners),
        };
    walled: marking::walled, NamedRule::new("repaired", Rule::REPAIRED), marking::walled_neighbourhoods,
        covers ["explored", "visited"], unwind 17, mutants {
            without_corners: "without corners" => Rule::REPAIRED.without(Corners),
        };
    half_seen: marking::half_seen, NamedRule::new("robust", Rule::ROBUST), marking::readings,
        covers ["explored", "visited"], unwind 17, mutants {
            without_seen_only: "ways through what reads as unexplored" => Rule::ROBUST.without(SeenOnly),
        };
}

step_checks! { i32;
    localised: marking::localised, NamedRule::new("published", LESS_THAN_HALF), marking::errors,
        covers ["a sensor"], unwind 9, mutants {
            badly: "errors of more than half a cell" => MORE_THAN_HALF,
        };
}

step_checks! { Eyes;
    ways_on: marking::most_walled, NamedRule::new("repaired", (|scan| scan) as Eyes), marking::ways_on,
        covers ["a way on", "nothing unexplored"], unwind 17, mutants {
            no_corners: "corners are not seen" => (|scan| Scan { rims: Ring::default(), ..scan }) as Eyes,
        };
}

/// The clauses.
pub const CLAUSES: [Clause; 15] = [
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
            &holds(
                PUBLISHED,
                &Floors::new(&ALONE, Connected),
                &[named("without corners", Rule::PUBLISHED.without(Corners))],
            ),
            &holds(
                REPAIRED,
                &Floors::shared(&TOGETHER, Connected),
                &[
                    named("without corners", Rule::REPAIRED.without(Corners)),
                    named("no lap gives way to another", laps(Precedence::Nobody)),
                ],
            ),
            &holds(
                ROBUST,
                &Floors::shared(&TWICE, Connected),
                &[named(
                    "no lap gives way to another",
                    Rule { precedence: Precedence::Nobody, ..Rule::ROBUST },
                )],
            ),
            &refuted(PUBLISHED, &Floors::shared(&HALF_BLIND, Connected)).under(REFUTED).of(&PAPER),
            &holds(ROBUST, &Floors::shared(&HALF_BLIND, Connected), &[TRUSTING, ONCE_OVER]),
            &holds(TREE, &Floors::shared(&TREES, Connected), &[parents_marked(TreeRule::TREE), WRAPPING]),
            &holds(HELPERS, &Floors::shared(&HELPING, Connected), &[parents_marked(TreeRule::HELPERS)]),
            &holds(CAREFUL, &Floors::shared(&TREES_HALF_BLIND, Connected), &[HASTY]),
        ],
    },
    Clause {
        id: "BRICKS-3",
        sentence: "It MUST be enough for BRICKS-2 that two agents take turns whose scans overlap.",
        checks: &[
            &holds(
                REPAIRED,
                &Floors::new(&IN_TURNS, Connected),
                &[at_once("agents beside each other act at once", Rule::REPAIRED)],
            ),
            &holds(
                TREE,
                &Floors::new(&IN_TURNS, Connected),
                &[at_once("agents beside each other act at once", TreeRule::TREE)],
            ),
            &refuted(at_once("at-once", TreeRule::TREE), &Floors::new(&AT_ONCE, Connected))
                .because("why agents near each other take turns"),
        ],
    },
    Clause {
        id: "BRICKS-4",
        sentence: "An agent MUST be done only when every cell is explored and no other cell is left to go through.",
        checks: &[
            &refuted(PUBLISHED, &Floors::broken_on(PAIR, &TOGETHER, Knowing)).under(KNOWS_ALONE).of(&PAPER),
            &holds(REPAIRED, &Floors::shared(&TOGETHER, Knowing), &[NOT_ALONE]),
            &refuted(PUBLISHED, &Floors::shared(&HALF_BLIND, Knowing)).under(BEFORE_THE_END).of(&PAPER),
            &holds(ROBUST, &Floors::shared(&HALF_BLIND, Knowing), &[TRUSTING, ONCE_OVER, EARLY_LAPS]),
            &holds(TREE, &Floors::shared(&TREES, Knowing), &[no_exits(TreeRule::TREE)]),
            &holds(HELPERS, &Floors::shared(&HELPING, Knowing), &[no_exits(TreeRule::HELPERS)]),
            &refuted(MDFS, &Floors::broken_on(PAIR, &TREES, Knowing)).because("a rival"),
            &refuted(TREE, &Floors::broken_on(HALF_BLIND_PAIR, &TREES_HALF_BLIND, Knowing))
                .because("with missed sensors; the rule careful is for those"),
            &holds(CAREFUL, &Floors::shared(&TREES_HALF_BLIND, Knowing), &[HASTY]),
            &holds(
                DOUBTING_ONCE,
                &Floors::shared(&ROUND, Knowing),
                &[named(BRICKS_SEEN, DOUBTING_RULE.with(Bricks))],
            ),
            &holds(
                DOUBTING,
                &Floors::shared(&AS_SHIPPED, Knowing),
                &[
                    named(BRICKS_SEEN, TreeRule::DOUBTING.with(Bricks)),
                    named("one scan is believed", TreeRule::DOUBTING.reading(1)),
                ],
            ),
        ],
    },
    Clause {
        id: "BRICKS-5",
        sentence: "Every cell MUST be explored, whatever sensors are missed, as its reading has it.",
        checks: &[
            &refuted(PUBLISHED, &Floors::broken_on(ROUND_WALLS, &ROUND_BLOCKED, Explores))
                .under(SEEING)
                .of(&PAPER),
            &refuted(PUBLISHED, &Floors::new(&HALF_BLIND, Explores)).under(REFUTED).of(&PAPER),
            &holds(ROBUST, &Floors::new(&HALF_BLIND, Explores), &[TRUSTING, ONCE_OVER]),
            &holds(CAREFUL, &Floors::shared(&TREES_HALF_BLIND, Explores), &[HASTY]),
        ],
    },
    Clause {
        id: "BRICKS-6",
        sentence: "Every run in which every agent acts again and again MUST end with every cell visited, whatever \
                   sensors are missed, as its reading has it.",
        checks: &[
            &refuted(PUBLISHED, &Floors::broken_on(BEHIND_A_WALL, &ALONE, Ends)).under(SEEING).of(&PAPER),
            &holds(
                REPAIRED,
                &Floors::shared(&TOGETHER, Ends),
                &[
                    named("both laps give way", laps(Precedence::Everybody)),
                    NOT_ALONE,
                    named("walks no laps", Rule::REPAIRED.without(Laps)),
                ],
            ),
            &holds(
                ROBUST,
                &Floors::shared(&TWICE, Ends),
                &[named("walks no laps", Rule::ROBUST.without(Laps))],
            ),
            &refuted(PUBLISHED, &Floors::shared(&HALF_BLIND, Ends)).under(REFUTED).of(&PAPER),
            &holds(ROBUST, &Floors::shared(&HALF_BLIND, Ends), &[TRUSTING, ONCE_OVER, EARLY_LAPS]),
            &holds(TREE, &Floors::shared(&TREES, Ends), &[parents_marked(TreeRule::TREE)]),
            &holds(HELPERS, &Floors::shared(&HELPING, Ends), &[BRICKS_MARKED]),
            &holds(CAREFUL, &Floors::shared(&TREES_HALF_BLIND, Ends), &[HASTY]),
            &holds(
                CAREFUL,
                &Floors::shared(&ROUND, Ends),
                &[named("sensors placed unasked", TreeRule::ROBUST.without(Underfoot))],
            ),
            &holds(
                DOUBTING_ONCE,
                &Floors::shared(&ROUND, Ends),
                &[
                    named("sensors not restored", DOUBTING_RULE.without(Restores)),
                    named("known sensors replaced", DOUBTING_RULE.without(Remembers)),
                ],
            ),
            &refuted(DOUBTING_ONCE, &Floors::broken_on(pair_of(THRICE_MISSED[0]), &THRICE_MISSED, Ends))
                .because("more scans miss a sensor than the rule allows for"),
            &holds(
                DOUBTING,
                &Floors::shared(&AS_SHIPPED, Ends),
                &[named("two scans are believed", TreeRule::DOUBTING.reading(2))],
            ),
            &refuted(DOUBTING, &Floors::broken_on(pair_of(SEVEN_MISSED[0]), &SEVEN_MISSED, Ends))
                .because("more scans miss a sensor than the rule allows for"),
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
        checks: &[&holds(TREE, &Floors::shared(&TREES, own(Own::Whole)), &[WRAPPING])],
    },
    Clause {
        id: "BRICKS-9",
        sentence: "Labels MUST never fall from a cell of a tree to its parent.",
        checks: &[&holds(TREE, &Floors::shared(&TREES, own(Own::Rising)), &[parents_marked(TreeRule::TREE)])],
    },
    Clause {
        id: "BRICKS-10",
        sentence: "As long as there has been one tree at most, an agent MUST make at most two moves a cell.",
        checks: &[&holds(
            going("helpers", To::Ruled),
            &Floors::new(&COUNTED, own(Own::Bounded)),
            &[
                going("open cells beside a visited one before its parent", To::OpenBeside),
                named(
                    TWICE_ADOPTED,
                    TravelRule { rule: TreeRule::HELPERS.without(LowerOnly), to: To::Ruled },
                ),
            ],
        )],
    },
    Clause {
        id: "BRICKS-11",
        sentence: "Agents that fail MUST not keep the others from an end with every cell visited.",
        checks: &[
            &refuted(REPAIRED, &Floors::broken_on(IN_ONE_CELL, &FAILING, Ends))
                .because("laps need every agent; trees do not"),
            &holds(TREE, &Floors::new(&TREES_FAILING, Ends), &[no_exits(TreeRule::TREE)]),
        ],
    },
    Clause {
        id: "BRICKS-12",
        sentence: "An agent alone MUST make at most two moves a cell.",
        checks: &[
            &holds(
                HELPERS,
                &Floors::new(&ONE_COUNTED, own(Own::Twice)),
                &[named(TWICE_ADOPTED, TreeRule::HELPERS.without(LowerOnly))],
            ),
            &refuted(TREE, &Floors::broken_on(BEHIND_A_WALL, &ONE_COUNTED, own(Own::Twice)))
                .because("the rule helpers makes no more than two"),
        ],
    },
    Clause {
        id: "BRICKS-13",
        sentence: "An agent that goes to a child MUST go to one that was entered least.",
        checks: &[
            &Check::holds(
                choosing("tree", To::Ruled),
                &EveryAnswer::new(children::next, children::views, &children::COVERS),
                &[
                    choosing("the first child", To::FirstChild),
                    choosing("the child entered most", To::MostEntered),
                ],
            ),
            &holds(
                going("helpers", To::Ruled),
                &Floors::new(&THREE, own(Own::LeastEntered)),
                &[going("the first child", To::FirstChild), going("the child entered most", To::MostEntered)],
            ),
        ],
    },
    Clause {
        id: "BRICKS-14",
        sentence: "Two trees MUST have different labels; the one before which its \
                   agent had founded fewer has the greater.",
        checks: &[&labels::labels_of_trees::CHECK],
    },
    Clause {
        id: "BRICKS-15",
        sentence: "An agent that explores MUST go to the unexplored neighbour with the most inaccessible sides, as far \
                   as it sees them, the first in the order of the compass.",
        checks: &[&ways_on::CHECK],
    },
];

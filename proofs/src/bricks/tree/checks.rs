//! The checks of agents that search in trees, by clause.

use tautline_kernel::bricks::tree::Condition::{
    Bricks, Childless, Exit, LowerOnly, Remembers, Restores, Underfoot,
};
use tautline_kernel::bricks::tree::Rule;

use super::floors::Floors;
use super::{Deception, Observed, Way, labels};
use crate::clause::{Check, NamedRule};
use crate::decide::Verdict;
use crate::step_checks;

const TREE: NamedRule<Observed> = NamedRule::new("tree", Observed::following(Rule::TREE));
const HELPERS: NamedRule<Observed> = NamedRule::new("helpers", Observed::following(Rule::HELPERS));
const ROBUST: NamedRule<Observed> = NamedRule::new("careful", Observed::following(Rule::ROBUST));
const MDFS: NamedRule<Observed> =
    NamedRule::new("mdfs", Observed { way: Way::Mdfs, deception: Deception::None });
const AT_ONCE: Observed = Observed { deception: Deception::ActsAtOnce, ..TREE.rule };

/// Agents that doubt as they run: they believe three scans in a row.
const SHIPPED: NamedRule<Observed> = NamedRule::new("doubting", Observed::following(Rule::DOUBTING));
const TWO_BELIEVED: NamedRule<Observed> =
    NamedRule::new("two scans are believed", Observed::following(Rule::DOUBTING.reading(2)));

/// Agents that believe one scan: three are more to search than larger floors can show.
const DOUBTING: NamedRule<Observed> = NamedRule::new("doubting-1", Observed::following(DOUBTING_RULE));

/// Agents whose trees all have the same label.
const WRAPPING: NamedRule<Observed> =
    NamedRule::new("labels that come again", Observed::following(Rule { label_bits: 0, ..Rule::TREE }));
const NO_EXITS: NamedRule<Observed> = NamedRule::new(
    "cells marked without the side left through",
    Observed::following(Rule::TREE.without(Exit)),
);
const PARENTS_MARKED: NamedRule<Observed> =
    NamedRule::new("cells marked that have children", Observed::following(Rule::TREE.without(Childless)));
const WITH_BRICKS: NamedRule<Observed> = NamedRule::new(
    "cells marked that do not block, as far as is seen",
    Observed::following(Rule { conditions: Rule::ROBUST.conditions.with(Bricks), ..Rule::ROBUST }),
);
const DEEPER: NamedRule<Observed> = NamedRule::new(
    "cells of the same tree adopted once more",
    Observed::following(Rule::TREE.without(LowerOnly)),
);
const TWICE_ADOPTED: NamedRule<Observed> = NamedRule::new(
    "cells of the same tree adopted once more",
    Observed::following(Rule::HELPERS.without(LowerOnly)),
);
const UNASKED: NamedRule<Observed> =
    NamedRule::new("sensors placed unasked", Observed::following(Rule::ROBUST.without(Underfoot)));
const NOT_RESTORED: NamedRule<Observed> =
    NamedRule::new("sensors not restored", Observed::following(DOUBTING_RULE.without(Restores)));
const FORGETFUL: NamedRule<Observed> =
    NamedRule::new("known sensors replaced", Observed::following(DOUBTING_RULE.without(Remembers)));
const DOUBTING_RULE: Rule = Rule::DOUBTING.reading(1);
const TRUSTING: NamedRule<Observed> = NamedRule::new("what is seen is believed", TREE.rule);

/// A check that holds.
const fn holds(
    about: NamedRule<Observed>,
    floors: &'static Floors,
    mutants: &'static [NamedRule<Observed>],
) -> Check<Observed> {
    Check::new(about, floors, Verdict::Holds, mutants)
}

/// A check that is refuted.
const fn refuted(about: NamedRule<Observed>, floors: &'static Floors) -> Check<Observed> {
    Check::new(about, floors, Verdict::Refuted, &[])
}

/// BRICKS-2
pub(in crate::bricks) static TREE_CONNECTED: Check<Observed> =
    holds(TREE, &Floors::CONNECTED, &[PARENTS_MARKED, WRAPPING]);
/// BRICKS-2
pub(in crate::bricks) static HELPERS_CONNECTED: Check<Observed> =
    holds(HELPERS, &Floors::HELPERS_CONNECTED, &[]);
/// BRICKS-2, sensors missed.
pub(in crate::bricks) static ROBUST_CONNECTED: Check<Observed> =
    holds(ROBUST, &Floors::CONNECTED_HALF_BLIND, &[WITH_BRICKS]);
/// BRICKS-3
pub(in crate::bricks) static IN_TURNS: Check<Observed> = holds(
    TREE,
    &Floors::CONNECTED_IN_TURNS,
    &[NamedRule::new("agents beside each other act at once", AT_ONCE)],
);
/// BRICKS-3, the shortest break.
pub(in crate::bricks) static BOTH_AT_ONCE: Check<Observed> =
    refuted(NamedRule::new("at-once", AT_ONCE), &Floors::CONNECTED_AT_ONCE);
/// BRICKS-4
pub(in crate::bricks) static TREE_KNOWING: Check<Observed> = holds(TREE, &Floors::KNOWING, &[NO_EXITS]);
/// BRICKS-4
pub(in crate::bricks) static HELPERS_KNOWING: Check<Observed> = holds(HELPERS, &Floors::HELPERS_KNOWING, &[]);
/// BRICKS-4
pub(in crate::bricks) static MDFS_KNOWING: Check<Observed> = refuted(MDFS, &Floors::KNOWING);
/// BRICKS-4, sensors missed.
pub(in crate::bricks) static TREE_HALF_BLIND: Check<Observed> = refuted(TREE, &Floors::KNOWING_HALF_BLIND);
/// BRICKS-4, sensors missed.
pub(in crate::bricks) static ROBUST_KNOWING: Check<Observed> =
    holds(ROBUST, &Floors::KNOWING_HALF_BLIND, &[TRUSTING]);
/// BRICKS-5, sensors missed.
pub(in crate::bricks) static ROBUST_EXPLORES: Check<Observed> =
    holds(ROBUST, &Floors::EXPLORES_HALF_BLIND, &[TRUSTING]);
/// BRICKS-6
pub(in crate::bricks) static TREE_ENDS: Check<Observed> = holds(TREE, &Floors::ENDS, &[PARENTS_MARKED]);
/// BRICKS-6
pub(in crate::bricks) static HELPERS_ENDS: Check<Observed> = holds(HELPERS, &Floors::HELPERS_END, &[]);
/// BRICKS-6, sensors missed.
pub(in crate::bricks) static ROBUST_ENDS: Check<Observed> =
    holds(ROBUST, &Floors::ENDS_HALF_BLIND, &[TRUSTING]);
/// BRICKS-8
pub(in crate::bricks) static TREES_WHOLE: Check<Observed> = holds(TREE, &Floors::WHOLE, &[WRAPPING]);
/// BRICKS-9
pub(in crate::bricks) static LABELS_RISE: Check<Observed> = holds(TREE, &Floors::RISING, &[PARENTS_MARKED]);
/// BRICKS-10
pub(in crate::bricks) static TREE_BOUNDED: Check<Observed> = holds(TREE, &Floors::BOUNDED, &[DEEPER]);
/// BRICKS-10
pub(in crate::bricks) static HELPERS_BOUNDED: Check<Observed> = holds(HELPERS, &Floors::BOUNDED, &[]);
/// BRICKS-11
pub(in crate::bricks) static SURVIVES: Check<Observed> = holds(TREE, &Floors::SURVIVES, &[NO_EXITS]);
/// BRICKS-4, sensors missed and placed unasked.
pub(in crate::bricks) static DOUBTING_KNOWING: Check<Observed> = holds(DOUBTING, &Floors::KNOWING_ROUND, &[]);
/// BRICKS-6, sensors missed, crossings counted to a few.
pub(in crate::bricks) static ROBUST_ENDS_ROUND: Check<Observed> =
    holds(ROBUST, &Floors::ENDS_ROUND, &[UNASKED]);
/// BRICKS-6, sensors missed and placed unasked.
pub(in crate::bricks) static DOUBTING_ENDS: Check<Observed> =
    holds(DOUBTING, &Floors::ENDS_ROUND, &[NOT_RESTORED, FORGETFUL]);
/// BRICKS-4, as shipped.
pub(in crate::bricks) static SHIPPED_KNOWING: Check<Observed> =
    holds(SHIPPED, &Floors::KNOWING_AS_SHIPPED, &[]);
/// BRICKS-6, as shipped.
pub(in crate::bricks) static SHIPPED_ENDS: Check<Observed> =
    holds(SHIPPED, &Floors::ENDS_AS_SHIPPED, &[TWO_BELIEVED]);
/// BRICKS-6, as shipped, one more missed.
pub(in crate::bricks) static SHIPPED_ROUND: Check<Observed> = refuted(SHIPPED, &Floors::ENDS_SEVEN_MISSED);
/// BRICKS-6, one more missed.
pub(in crate::bricks) static DOUBTING_ROUND: Check<Observed> = refuted(DOUBTING, &Floors::ENDS_THRICE_MISSED);
/// BRICKS-12
pub(in crate::bricks) static HELPERS_TWICE: Check<Observed> =
    holds(HELPERS, &Floors::TWICE, &[TWICE_ADOPTED]);
/// BRICKS-12
pub(in crate::bricks) static TREE_TWICE: Check<Observed> = refuted(TREE, &Floors::TWICE);
/// BRICKS-13
pub(in crate::bricks) static LEAST_ENTERED: Check<Observed> = holds(TREE, &Floors::LEAST_ENTERED, &[]);
/// BRICKS-13
pub(in crate::bricks) static HELPERS_LEAST_ENTERED: Check<Observed> = holds(
    HELPERS,
    &Floors::HELPERS_LEAST_ENTERED,
    &[NamedRule::new("the first child", Observed { deception: Deception::FirstChild, ..HELPERS.rule })],
);

step_checks! { Observed;
    labels_of_trees: labels::labels, TREE, labels::pairs,
        covers ["two trees of one agent", "trees of two agents"], unwind 10, mutants {
            wrapping: "labels that come again" => WRAPPING.rule,
            by_agent: "labels of 8 bits" => Observed::following(Rule { label_bits: 8, ..Rule::TREE }),
        };
}

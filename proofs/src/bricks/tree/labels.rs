//! The labels of two trees (BRICKS-14).

use tautline_kernel::bricks::tree::{Label, Rule};
use tautline_kernel::choice::{Oracle, one_of};

use crate::clause::NamedRule;
use crate::engine::{Outcome, assume, require};
use crate::plural::counted;
use crate::step_checks;

step_checks! { Rule;
    labels_of_trees: labels, NamedRule::new("tree", Rule::TREE), pairs,
        covers ["two trees of one agent", "trees of two agents"], unwind 10, mutants {
            wrapping: "labels that come again" => Rule { label_bits: 0, ..Rule::TREE },
            by_agent: "labels of 8 bits" => Rule { label_bits: 8, ..Rule::TREE },
        };
}

/// How many trees an agent has founded before: the first ones, those around a byte more, and the last ones.
const FOUNDED: [u32; 9] =
    [0, 1, 2, (1 << 8) - 1, 1 << 8, (1 << 16) - 1, 1 << 16, Label::TREES - 2, Label::TREES - 1];

/// The ids of agents: the first, those around half of them, and the last.
const IDS: [u8; 6] = [0, 1, 127, 128, 254, u8::MAX];

/// The bound of [`labels`].
fn pairs() -> String {
    let (founded, agents) = (FOUNDED.len() as u64, IDS.len() as u64);
    format!("any two of {} of {}", counted(founded, "tree"), counted(agents, "agent"))
}

/// BRICKS-14: no two trees have the same label, and of two the one before which its agent had founded fewer has the
/// greater.
///
/// # Errors
/// [`crate::engine::Stop`] if the choices are no two trees, or break the clause.
fn labels(rule: &Rule, oracle: &mut dyn Oracle) -> Outcome {
    let mut tree = || (one_of(oracle, &FOUNDED), one_of(oracle, &IDS));
    let [one, other] = [tree(), tree()];
    assume(one != other)?;
    let label = |(founded, id)| Label::new(founded, id).map(|label| label.lowest(rule.label_bits));
    require(label(one) != label(other), "no two trees have the same label")?;
    let is_greater = one.0 >= other.0 || label(one) > label(other);
    require(is_greater, "of two trees the one that was founded after fewer has the greater label")?;
    Ok(if one.1 == other.1 { "two trees of one agent" } else { "trees of two agents" })
}

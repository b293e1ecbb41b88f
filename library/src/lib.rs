//! Published rules of other people, each in one file: its source, its conditions, what is demanded of it, and rules
//! with one thing wrong that its checks must reject. The engines are Tautline's, and no room of Tautline knows the
//! rules.

#[macro_use]
mod entry;

mod aggregation;
pub mod alpha;
mod ba_star;
mod burgard;
pub mod dijkstra;
pub mod gathering;
mod inheritance;
mod lacam;
mod page;
mod perpetual;
mod pibt;
mod planned;
mod prelude;
mod prioritised;
pub mod ricart;
mod rmf_lane;
mod rmf_swap;
mod spanning_tree;
mod yamauchi;

use tautline_proofs::clause::Clause;

pub use entry::{Entry, Promise};
pub use page::page;

/// All rules.
pub static RULES: &[&Entry] = &[
    &pibt::ENTRY,
    &lacam::ENTRY,
    &prioritised::ENTRY,
    &rmf_lane::ENTRY,
    &rmf_swap::ENTRY,
    &yamauchi::ENTRY,
    &burgard::ENTRY,
    &spanning_tree::ENTRY,
    &ba_star::ENTRY,
    &gathering::ENTRY,
    &perpetual::ENTRY,
    &aggregation::ENTRY,
    &alpha::ENTRY,
    &dijkstra::ENTRY,
    &ricart::ENTRY,
];

/// The promises of all rules, those within larger bounds last.
pub fn clauses() -> impl Iterator<Item = &'static Clause> {
    let smaller = RULES.iter().flat_map(|rule| rule.clauses());
    smaller.chain(RULES.iter().flat_map(|rule| rule.larger()))
}

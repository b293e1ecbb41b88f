//! Published rules of other people, each in one file: its source, its conditions, what is demanded of it, and rules
//! with one thing wrong that its checks must reject. The engines are Tautline's, and no room of Tautline knows the
//! rules.

mod aggregation;
mod alpha;
mod ba_star;
mod burgard;
pub mod dijkstra;
mod frontiers;
pub mod gathering;
mod inheritance;
mod lacam;
mod page;
mod perpetual;
mod pibt;
mod planned;
mod prioritised;
pub mod ricart;
mod rmf_lane;
mod rmf_swap;
mod spanning_tree;
mod yamauchi;

use std::iter;

use tautline_proofs::clause::{AnyCheck, Clause};
use tautline_proofs::team::Graph;

pub use page::page;

/// All that the file of a rule is made with.
mod prelude {
    pub(crate) use std::{fmt, iter};

    pub(crate) use tautline_proofs::clause::{Check, NamedRule};
    pub(crate) use tautline_proofs::compact;
    pub(crate) use tautline_proofs::decide::MethodError;
    pub(crate) use tautline_proofs::decide::Verdict::{Holds, Refuted};
    pub(crate) use tautline_proofs::engine::states::Bits;
    pub(crate) use tautline_proofs::protocol::{Demand, Keeps, Move, Protocol, combinations, set};
    pub(crate) use tautline_proofs::team::{Graph, Graphs, Kind, Moves, Teams};

    pub(crate) use crate::{APART, Entry, WAYS, arrows, conflicts, hang_together, promise, robots, turned};
}

/// A published rule.
#[derive(Debug)]
pub struct Entry {
    /// The name on a command line.
    pub name: &'static str,
    /// The name in a table.
    pub title: &'static str,
    /// The source, as Markdown.
    pub source: &'static str,
    /// The promises, with what must come out.
    pub promises: &'static [Promise],
}

/// A promise with its checks, and with those within bounds that take longer, which may be none.
#[derive(Debug)]
pub struct Promise {
    clause: Clause,
    larger: Clause,
}

impl Entry {
    /// The promises.
    pub fn clauses(&self) -> impl Iterator<Item = &'static Clause> {
        self.promises.iter().map(|promise| &promise.clause)
    }

    /// The promises that have larger bounds, within these.
    pub fn larger(&self) -> impl Iterator<Item = &'static Clause> {
        self.promises.iter().map(|promise| &promise.larger).filter(|clause| !clause.checks.is_empty())
    }
}

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

/// A promise with its checks.
const fn promise(
    id: &'static str,
    sentence: &'static str,
    checks: &'static [&'static dyn AnyCheck],
) -> Promise {
    Promise { clause: Clause { id, sentence, checks }, larger: Clause { id, sentence, checks: &[] } }
}

impl Promise {
    /// The promise with these checks within larger bounds.
    const fn larger(mut self, checks: &'static [&'static dyn AnyCheck]) -> Self {
        self.larger.checks = checks;
        self
    }
}

/// The demand that no two robots are in conflict.
const APART: &str = "no two robots are in one cell, or change places";

/// Whether two robots come into one cell, or change places.
fn conflicts(before: &[u8], after: &[u8]) -> bool {
    let robots = 0..before.len();
    robots.clone().any(|one| {
        let is_swap = |other: usize| before[one] == after[other] && after[one] == before[other];
        (0..one).any(|other| after[one] == after[other] || is_swap(other))
    })
}

/// Whether the first of all is joined with each of them, from one to the next.
fn hang_together<T: PartialEq>(all: &[T], is_joined: impl Fn(&T, &T) -> bool) -> bool {
    let mut found: Vec<&T> = all.iter().take(1).collect();
    let next = |found: &[&T]| {
        let mut left = all.iter().filter(|other| !found.contains(other));
        left.find(|other| found.iter().any(|one| is_joined(one, other)))
    };
    while let Some(other) = next(&found) {
        found.push(other);
    }
    found.len() == all.len()
}

/// The steps in columns and rows of a robot that heads so, in quarter turns.
const WAYS: [(i8, i8); 4] = [(1, 0), (0, 1), (-1, 0), (0, -1)];

/// A state whose floor is turned by one, two and three quarters.
fn turned<S>(state: &S, quarter: impl Fn(&S) -> S) -> Vec<S> {
    iter::successors(Some(quarter(state)), |before| Some(quarter(before))).take(3).collect()
}

/// A floor of so many cells a side, with an arrow where a robot heads so.
fn arrows(side: i8, heading: impl Fn(i8, i8) -> Option<u8>) -> String {
    let sign = |heading: u8| ['>', 'v', '<', '^'][usize::from(heading)];
    let line = |row| (0..side).map(|column| heading(column, row).map_or('.', sign)).collect::<String>();
    (0..side).map(line).collect::<Vec<_>>().join("\n")
}

/// Robots by number, each cell with the letter of the robot whose goal it is.
fn robots(graph: &Graph, now: &[u8], goals: &[u8]) -> String {
    graph.draw(|cell| {
        let who = |cells: &[u8], first: u8| {
            let place = cells.iter().position(|&other| other == cell);
            place.map_or('.', |place| char::from(first + place as u8))
        };
        [who(now, b'0'), who(goals, b'a')].iter().collect()
    })
}

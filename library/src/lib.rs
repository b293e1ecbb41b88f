//! Published rules of other people, each in one file: its source, its conditions, what is demanded of it, and rules
//! with one thing wrong that its checks must reject. The engines are Tautline's, and no room of Tautline knows the
//! rules.

/// A published rule: its type, its name on a command line and in a table, the word before the numbers of its promises,
/// and its source; the rule and its variants, each with a name in tables; and the promises. A promise has the number of
/// its demand, from 1 on, its sentence, and its checks: the verdict, the rule, the bound, and the rules that the check
/// must reject. Checks within larger bounds stand apart.
macro_rules! entry {
    (
        $rule:ty: $name:literal, $title:literal, $scheme:literal, $source:literal;
        $($variant:ident = $words:literal, $value:expr;)+
        $($number:literal: $sentence:literal { $($checks:tt)* } $(larger { $($larger:tt)* })?)+
    ) => {
        $(const $variant: NamedRule<$rule> = NamedRule::new($words, $value);)+

        /// The rule.
        pub(crate) static ENTRY: $crate::Entry = $crate::Entry {
            name: $name,
            title: $title,
            source: $source,
            promises: &[$($crate::Promise {
                clause: entry!(@clause $rule, concat!($scheme, "-", $number), $number, $sentence; $($checks)*),
                larger: entry!(@clause $rule, concat!($scheme, "-", $number), $number, $sentence; $($($larger)*)?),
            }),+],
        };
    };
    (
        @clause $rule:ty, $id:expr, $number:literal, $sentence:literal;
        $($verdict:ident $about:ident within $bound:expr $(, not $($mutant:ident),+)?;)*
    ) => {
        Clause {
            id: $id,
            sentence: $sentence,
            checks: &[$(&Check::new(
                $about,
                &Keeps::<$rule>($bound, $number - 1),
                Verdict::$verdict,
                &[$($($mutant),+)?],
            )),*],
        }
    };
}

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
mod prioritised;
pub mod ricart;
mod rmf_lane;
mod rmf_swap;
mod spanning_tree;
mod yamauchi;

use std::iter;

use tautline_proofs::clause::Clause;

pub use page::page;

/// All that the file of a rule is made with.
mod prelude {
    pub(crate) use std::fmt;

    pub(crate) use tautline_kernel::ground::Side;
    pub(crate) use tautline_proofs::clause::{Check, Clause, NamedRule};
    pub(crate) use tautline_proofs::decide::{MethodError, Verdict};
    pub(crate) use tautline_proofs::engine::states::Bits;
    pub(crate) use tautline_proofs::protocol::{
        Bound, Keeps, Letter, Mail, Move, Protocol, Ring, Start, Walker, combinations, names, set, with,
    };
    pub(crate) use tautline_proofs::team::{
        Crew, Deployment, Graph, Graphs, Kind, KnownGraph, Moves, Task, Teams, conflicts,
    };
    pub(crate) use tautline_proofs::{bound, compact, demands};

    pub(crate) use crate::{APART, WAYS, arrows, hang_together, turned};
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

/// The demand that no two robots are in conflict.
const APART: &str = "no two robots are in one cell, or change places";

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

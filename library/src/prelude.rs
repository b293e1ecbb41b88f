//! All that the file of a rule is made with.

pub(crate) use std::fmt;

pub(crate) use tautline_kernel::ground::Side;
pub(crate) use tautline_proofs::clause::{Check, Clause, NamedRule};
pub(crate) use tautline_proofs::decide::{MethodError, Verdict};
pub(crate) use tautline_proofs::engine::states::Bits;
pub(crate) use tautline_proofs::protocol::{
    Bound, Keeps, Letter, Mail, Move, Protocol, Ring, Start, Walker, combinations, names, set, turned, with,
};
pub(crate) use tautline_proofs::team::{
    Crew, Deployment, Graph, Graphs, Kind, KnownGraph, Moves, Task, Teams, conflicts,
};
pub(crate) use tautline_proofs::{bound, compact, demands};

/// The demand that no two robots are in conflict.
pub(crate) const APART: &str = "no two robots are in one cell, or change places";

/// Whether the first of all is joined with each of them, from one to the next.
pub(crate) fn hang_together<T: PartialEq>(all: &[T], is_joined: impl Fn(&T, &T) -> bool) -> bool {
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
pub(crate) const WAYS: [(i8, i8); 4] = [(1, 0), (0, 1), (-1, 0), (0, -1)];

/// A floor of so many cells a side, with an arrow where a robot heads so.
pub(crate) fn arrows(side: i8, heading: impl Fn(i8, i8) -> Option<u8>) -> String {
    let sign = |heading: u8| ['>', 'v', '<', '^'][usize::from(heading)];
    let line = |row| (0..side).map(|column| heading(column, row).map_or('.', sign)).collect::<String>();
    (0..side).map(line).collect::<Vec<_>>().join("\n")
}

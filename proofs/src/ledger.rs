//! The ledger: the clauses of all rooms, in the order of `SPEC.md`, and what came of clauses, whosever they are.

mod certificates;
mod composition;
mod jobs;
mod readings;

use std::fmt::{self, Write};
use std::iter;

use crate::clause::{AnyCheck, Clause, Decision, Variant};
use crate::decide::Verdict;

pub use certificates::{Examination, Misfit, certificate, examine};
pub use composition::{Theorem, theorems};
pub use jobs::{Hear, Limits, MEMORY_BYTES, News, PATIENCE_S, decide, decide_all, hunt};

/// Clauses of our own that stand together, and a name for what they are about.
#[derive(Debug)]
pub struct Room {
    /// The name.
    pub title: &'static str,
    /// The clauses.
    pub clauses: &'static [Clause],
}

/// The rooms.
// No static: that would be compiled with all engines into the tests of this crate. Nor inlined: that would compile them
// into other crates.
#[cfg(feature = "rooms")]
#[inline(never)]
pub fn rooms() -> &'static [Room] {
    &[
        Room { title: "cells and walls", clauses: &crate::ground::clauses::CLAUSES },
        Room { title: "a recursive chain", clauses: &crate::chain::clauses::CLAUSES },
        Room { title: "a recursive chain", clauses: &crate::chain::own_clauses::CLAUSES },
        Room { title: "a recursive chain", clauses: &crate::chain::paper_clauses::CLAUSES },
        Room { title: "Ants", clauses: &crate::ants::clauses::CLAUSES },
        Room { title: "Brick&Mortar", clauses: &crate::bricks::clauses::CLAUSES },
        Room { title: "broadcast by k-FNF", clauses: &crate::notice::clauses::CLAUSES },
        Room { title: "who comes to whom: MRC", clauses: &crate::mrc::clauses::CLAUSES },
        Room { title: "ways by TAN", clauses: &crate::tan::clauses::CLAUSES },
        Room { title: "two that keep in touch", clauses: &crate::kit::clauses::CLAUSES },
        Room { title: "positions from signals", clauses: &crate::position::clauses::CLAUSES },
        Room { title: "frontier cells", clauses: &crate::frontier::clauses::CLAUSES },
        Room { title: "a pack that sees", clauses: &crate::pack::clauses::CLAUSES },
    ]
}

/// Every clause of our own.
#[cfg(feature = "rooms")]
pub fn clauses() -> impl Iterator<Item = &'static Clause> {
    rooms().iter().flat_map(|room| room.clauses)
}

/// The name for what the clauses of `scheme` are about; its own where it is none of ours.
#[cfg(feature = "rooms")]
pub fn title(scheme: &'static str) -> &'static str {
    let is_its = |room: &&Room| room.clauses.iter().any(|clause| clause.scheme() == scheme);
    rooms().iter().find(is_its).map_or(scheme, |room| room.title)
}

/// Two clauses of one id.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct DuplicateClause(pub &'static str);

impl fmt::Display for DuplicateClause {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "there are two clauses {}: give each an id of its own", self.0)
    }
}

impl std::error::Error for DuplicateClause {}

/// The clauses of `rooms`, of which no two have one id.
///
/// # Errors
/// [`DuplicateClause`] if two have.
pub fn register(rooms: &[&'static [Clause]]) -> Result<Vec<&'static Clause>, DuplicateClause> {
    let clauses: Vec<&Clause> = rooms.iter().copied().flatten().collect();
    for (place, clause) in clauses.iter().enumerate() {
        if clauses[..place].iter().any(|before| before.id == clause.id) {
            return Err(DuplicateClause(clause.id));
        }
    }
    Ok(clauses)
}

/// Why nothing came of a check, or of one of its variants.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub enum Indecision {
    /// One of its steps did not end.
    Unended {
        /// The variant whose step it was; none if it was a step of the rule.
        variant: Option<Variant>,
        /// How long the step was waited for.
        seconds: u32,
    },
    /// A step of another check did not end, and no thread was left to go on.
    Behind,
    /// The work was ended before.
    Ended,
}

impl fmt::Display for Indecision {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Unended { variant: None, seconds } => {
                write!(f, "a step of the rule did not end within {seconds} s")
            }
            Self::Unended { variant: Some(variant), seconds } => {
                let what = match variant {
                    Variant::Mutant(_) => "mutant",
                    Variant::Reading { .. } => "reading",
                };
                write!(f, "a step of the {what} {:?} did not end within {seconds} s", variant.name())
            }
            Self::Behind => f.write_str("not decided, since a step of another check did not end"),
            Self::Ended => f.write_str("not decided, since the work was ended before"),
        }
    }
}

/// A check that was decided.
#[derive(Debug)]
pub struct Row {
    /// The clause.
    pub clause: &'static Clause,
    /// The number of the check among those of the clause.
    pub number: usize,
    /// The check.
    pub check: &'static dyn AnyCheck,
    /// The decision.
    pub decision: Decision,
    /// Why nothing came of the check, or of one of its mutants; then it is open, or the mutant is not rejected.
    pub undecided: Option<Indecision>,
    /// The time that threads spent on it, with its mutants, added up.
    pub seconds: f64,
}

impl Row {
    /// Whether it came out as it is registered. What was not decided is not, even if it is registered as open.
    pub fn is_as_registered(&self) -> bool {
        self.undecided.is_none() && self.decision.is_as_registered(self.check)
    }

    /// The verdict that it is registered with, if it did not come out so.
    fn registered(&self) -> Option<String> {
        let expected = self.check.expected().word();
        let killed = if self.decision.survived.is_empty() { "" } else { ", and every mutant killed" };
        (!self.is_as_registered()).then(|| format!("not as registered: {expected}{killed}"))
    }

    /// The bound, and how many of its cases were given up.
    fn bound(&self) -> String {
        let bound = self.check.bound();
        match self.decision.given_up {
            0 => bound,
            given_up => format!("{bound}; {given_up} given up"),
        }
    }

    /// The theorem that machine-checks the clause beyond the bound, if the clause holds within it.
    pub fn composition(&self) -> Option<String> {
        let words = || {
            composition::words(self.clause.id, self.check.rule(), self.check.engine(), &self.check.bound())
        };
        (self.decision.verdict == Verdict::Holds).then(words).flatten()
    }

    /// Everything that is known beside the verdict within the bound: what else was found, what is machine-checked, what
    /// comes out under other readings, and what the paper is credited with, whose sentence is among `rows`.
    pub fn beyond(&self, rows: &[Self]) -> Vec<String> {
        let all = [self.decision.note.clone(), self.composition(), self.readings(), self.credit(rows)];
        all.into_iter().flatten().collect()
    }
}

/// The checks of `clauses`, in order: the clause, and the number of the check.
pub fn checks(clauses: &[&'static Clause]) -> Vec<(&'static Clause, usize)> {
    clauses.iter().flat_map(|&clause| (0..clause.checks.len()).map(move |number| (clause, number))).collect()
}

const HEAD: [&str; 6] = ["clause", "rule", "engine", "cases", "verdict", "mutants killed"];

/// The column of the cases, which are numbers.
const CASES: usize = 3;

/// The ledger: a line for each check, and below it its bound, whether it came out otherwise than it is registered, and
/// what is machine-checked beyond. What takes time is not in it, so that it is the same everywhere.
pub fn table(rows: &[Row]) -> String {
    let cells = |row: &Row| {
        let Decision { killed, survived, .. } = &row.decision;
        let mutants = match killed.len() + survived.len() {
            0 => "-".to_owned(),
            of => format!("{}/{of}", killed.len()),
        };
        [
            row.clause.id.to_owned(),
            row.check.rule().to_owned(),
            row.check.engine().to_owned(),
            row.decision.cases.to_string(),
            row.decision.verdict.word().to_owned(),
            mutants,
        ]
    };
    let lines: Vec<[String; 6]> =
        [HEAD.map(str::to_owned)].into_iter().chain(rows.iter().map(cells)).collect();
    let widths: [usize; 6] = std::array::from_fn(|column| {
        lines.iter().map(|line| line[column].chars().count()).max().unwrap_or(0)
    });
    let below = [("bound".to_owned(), Vec::new())].into_iter().chain(rows.iter().map(|row| {
        let why = row.undecided.map(|undecided| undecided.to_string());
        (row.bound(), [row.registered(), why].into_iter().flatten().chain(row.beyond(rows)).collect())
    }));
    let mut text = String::new();
    for (line, (bound, beyond)) in lines.iter().zip(below) {
        let padded: Vec<String> = (0..)
            .zip(line.iter().zip(widths))
            .map(|(column, (cell, width))| match column {
                CASES => format!("{cell:>width$}"),
                _ => format!("{cell:width$}"),
            })
            .collect();
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{}", padded.join("  ").trim_end());
        for words in iter::once(bound).chain(beyond) {
            text.push_str(&indented(widths[0] + 2, &words));
        }
    }
    text
}

/// Columns of text that a line with a bound may take.
const WIDTH: usize = 80;

/// `text` in lines that begin after `indent` columns and are broken behind commas and semicolons.
pub fn indented(indent: usize, text: &str) -> String {
    let width = WIDTH.saturating_sub(indent);
    let mut before = ' ';
    let parts = text.split_inclusive(|letter: char| {
        let is_break = letter == ' ' && matches!(before, ',' | ';');
        before = letter;
        is_break
    });
    let joined = |mut lines: Vec<String>, part: &str| {
        match lines.last_mut() {
            Some(line) if line.chars().count() + 1 + part.chars().count() <= width => {
                line.push(' ');
                line.push_str(part);
            }
            Some(_) | None => lines.push(part.to_owned()),
        }
        lines
    };
    let margin = " ".repeat(indent);
    let lines = parts.map(str::trim_end).fold(Vec::new(), joined).into_iter();
    lines.map(|line| [margin.as_str(), &line, "\n"].concat()).collect()
}

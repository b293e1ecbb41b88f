//! All verdicts on one screen: how many by scheme, what is refuted and why, and where to look.

use std::cmp::Reverse;
use std::collections::BTreeMap;
use std::fmt::Write;

use tautline_proofs::ambiguity::PUBLISHED;
use tautline_proofs::decide::Verdict;
use tautline_proofs::ledger::{Row, indented, title};

use super::row::of_variants;

/// A heading, and whether a row is counted below it.
type Count = (&'static str, fn(&Row) -> bool);

/// The counts.
const COUNTS: [Count; 5] = [
    ("holds", |row| row.decision.verdict == Verdict::Holds),
    ("sampled", |row| row.decision.verdict == Verdict::Unrefuted),
    ("refuted", |row| is_refuted(row) && row.check.rule() == PUBLISHED),
    ("on purpose", |row| is_refuted(row) && row.check.rule() != PUBLISHED),
    ("open", |row| row.decision.verdict == Verdict::Open),
];

/// Columns for the name of a scheme, and for what it is.
const NAME: usize = 10;
const TITLE: usize = 25;

fn is_refuted(row: &Row) -> bool {
    row.decision.verdict == Verdict::Refuted
}

/// The screen. What takes time is not on it, so that it is the same everywhere.
pub(super) fn screen(rows: &[Row]) -> String {
    let mut text = line("scheme", "", &COUNTS.map(|(heading, _)| heading.to_owned()));
    for scheme in rows.chunk_by(|one, next| one.clause.scheme() == next.clause.scheme()) {
        let name = scheme[0].clause.scheme();
        text += &line(name, title(name), &counts(scheme));
    }
    text += &line("in all", "", &counts(rows));
    text + "\nholds: within the bound that the ledger prints; sampled: drawn at \
            random, not\nrefuted; refuted: as published.\n"
        + "\nRefuted as published:\n"
        + &indented(2, &ids(rows))
        + "\nRefuted on purpose:\n"
        + &reasons(rows)
        + "\nOne clause and its counterexample:  tautline prove CHAIN-1\n\
           Every check and counterexample:     tautline prove --verbose\n\
           A page with all of it:              tautline prove --html report.html\n"
}

/// A line of the table.
fn line(name: &str, title: &str, counts: &[String; COUNTS.len()]) -> String {
    let mut line = format!("{name:NAME$}{title:TITLE$}");
    for (count, (heading, _)) in counts.iter().zip(COUNTS) {
        // Writing to a string cannot fail.
        let _ = write!(line, "  {count:>0$}", heading.len());
    }
    line + "\n"
}

fn counts(rows: &[Row]) -> [String; COUNTS.len()] {
    COUNTS.map(|(_, is_counted)| match rows.iter().filter(|row| is_counted(row)).count() {
        0 => "-".to_owned(),
        count => count.to_string(),
    })
}

/// The clauses that are refuted as published, those of a scheme behind its name.
fn ids(rows: &[Row]) -> String {
    let mut ids: Vec<&str> = rows.iter().filter(|row| COUNTS[2].1(row)).map(|row| row.clause.id).collect();
    ids.dedup();
    let of_scheme = |ids: &[&str]| {
        let (first, rest) = ids.split_at(1);
        let numbers = rest.iter().filter_map(|id| id.split_once('-')).map(|(_, number)| number);
        first.iter().copied().chain(numbers).collect::<Vec<_>>().join(" ")
    };
    let scheme = |id: &str| id.split_once('-').map(|(scheme, _)| scheme.to_owned());
    let schemes: Vec<String> = ids.chunk_by(|one, next| scheme(one) == scheme(next)).map(of_scheme).collect();
    schemes.join(", ")
}

/// Rows that are refuted on purpose, by their reasons.
fn reasons(rows: &[Row]) -> String {
    let mut found: Vec<(&str, Vec<String>)> = Vec::new();
    for row in rows.iter().filter(|row| COUNTS[3].1(row)) {
        let name = format!("{} {}", row.clause.id, row.check.rule());
        let reason = row.check.reason().unwrap_or("not registered");
        match found.iter_mut().find(|(known, _)| *known == reason) {
            Some((_, names)) => names.push(name),
            None => found.push((reason, vec![name])),
        }
    }
    found.iter().map(|(reason, names)| indented(2, &format!("{}: {reason}", names.join(", ")))).collect()
}

/// The checks that took longest, added up over threads.
pub(super) fn slowest(rows: &[Row]) -> String {
    let mut by_check: BTreeMap<(&str, &str), f64> = BTreeMap::new();
    for row in rows {
        *by_check.entry((row.clause.id, row.check.rule())).or_default() += row.seconds;
    }
    let mut slowest: Vec<_> = by_check.into_iter().collect();
    slowest.sort_by_key(|&(_, seconds)| Reverse((seconds * 1000.0) as u64));
    let mut text =
        String::from("Slowest, over all threads, a search that checks share counted for the first of them:");
    for ((id, rule), seconds) in slowest.into_iter().take(SLOWEST) {
        // Writing to a string cannot fail.
        let _ = write!(text, " {id} {rule} {seconds:.0} s,");
    }
    text.trim_end_matches(',').to_owned()
}

/// Checks that are named as the slowest.
const SLOWEST: usize = 3;

/// The line that ends the screen, and before it each verdict that is not the registered one.
pub(super) fn last_line(rows: &[Row]) -> String {
    let mut text = String::from("\n");
    for row in rows.iter().filter(|row| !row.is_as_registered()) {
        let (verdict, expected) = (row.decision.verdict.word(), row.check.expected().word());
        let _ =
            writeln!(text, "{} as {}: {verdict}, registered as {expected}", row.clause.id, row.check.rule());
        if let Some(undecided) = row.undecided {
            let _ = writeln!(text, "{}: {undecided}", row.clause.id);
        }
        for words in of_variants(row) {
            let _ = writeln!(text, "{}: {words}", row.clause.id);
        }
    }
    let differ = rows.iter().filter(|row| !row.is_as_registered()).count();
    let _ = match differ {
        // A signal came before any check was decided.
        0 if rows.is_empty() => Ok(()),
        0 if rows.len() == 1 => writeln!(text, "The verdict is the registered one."),
        0 => writeln!(text, "All {} verdicts are the registered ones.", rows.len()),
        _ => writeln!(text, "{differ} of {} verdicts are not the registered ones.", rows.len()),
    };
    text
}

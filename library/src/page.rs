//! The rules and their verdicts as a page.

use std::fmt::Write;

use tautline_proofs::decide::{Depiction, Verdict};
use tautline_proofs::ledger::Row;

use crate::Entry;

const HEAD: &str = "\
# Other people's rules

Published rules, each decided within its bound. The package `library` has one file for each rule: its source, its conditions, the
demands, and rules with one thing wrong that the check must reject. This page is generated; a test compares it with what comes
out. `tautline library` lists the rules, `tautline library pibt` decides one of them, `tautline library all` all of them, and `--larger`
takes larger bounds. With `--out DIR` counterexamples are stored, and `tautline replay` plays them.

The models are ours: a file says how it reads its source, and a verdict is about that reading. PIBT and LaCAM break ties by the numbers
of cells; the ring has the legitimate phase of its algorithm alone; Alpha's robots move on a grid.

A counterexample is the shortest one within the bound: breadth-first, the smallest layouts first. *N* states are all that were looked
at.

| rule | source | promise | about | verdict | bound | states | mutants killed | smallest counterexample |
|---|---|---|---|---|---|---|---|---|
";

/// The rows of a rule: a line for each check, each with the number of its drawing among those of the rule.
fn table(entry: &Entry, rows: &[Row]) -> String {
    let (mut text, mut drawings) = (String::new(), 0);
    for row in rows {
        let decision = &row.decision;
        let mutants = match decision.killed.len() + decision.survived.len() {
            0 => "-".to_owned(),
            of => format!("{} of {of}: {}", decision.killed.len(), decision.killed.join(", ")),
        };
        let drawn = if decision.verdict == Verdict::Refuted {
            drawings += 1;
            format!("[{}](#{})", heading(entry, drawings), heading(entry, drawings))
        } else {
            "-".to_owned()
        };
        let (id, sentence) = (row.clause.id, row.clause.sentence);
        // Writing to a string cannot fail.
        let _ = writeln!(
            text,
            "| {} | {} | {id}: {sentence} | {} | {} | {} | {} | {mutants} | {drawn} |",
            entry.title,
            entry.source,
            row.check.rule(),
            decision.verdict.word(),
            row.check.bound(),
            decision.cases,
        );
    }
    text
}

/// The heading of a drawing.
fn heading(entry: &Entry, number: u32) -> String {
    format!("{}-{number}", entry.name)
}

/// The counterexamples of a rule, drawn.
fn drawings(entry: &Entry, rows: &[Row]) -> String {
    let refuted = rows.iter().filter_map(|row| Some((row, row.decision.counterexample.as_ref()?)));
    let mut text = String::new();
    for (number, (row, evidence)) in (1..).zip(refuted) {
        let story = match &evidence.seen {
            Depiction::Story(story) => story.as_str(),
            _ => "",
        };
        // Writing to a string cannot fail.
        let _ = write!(
            text,
            "\n### {}\n\n{}, {}, {}: refuted is that {}.\n\n```text\n{}```\n",
            heading(entry, number),
            entry.title,
            row.clause.id,
            row.check.rule(),
            evidence.demand,
            story,
        );
    }
    text
}

/// The page of all rules, each with its rows.
pub fn page(all: &[(&Entry, Vec<Row>)]) -> String {
    let tables = all.iter().map(|(entry, rows)| table(entry, rows));
    let drawn = all.iter().map(|(entry, rows)| drawings(entry, rows));
    let tail = "\n## Counterexamples, drawn\n\nRobots are numbers; the letter behind is the robot whose goal the cell is (`a` for 0). \
                Blocked cells are `#`.\n";
    [HEAD.to_owned()].into_iter().chain(tables).chain([tail.to_owned()]).chain(drawn).collect()
}

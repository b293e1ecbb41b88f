//! The rules and their verdicts as a page.

use std::fmt::Write;

use tautline_proofs::decide::{Depiction, Verdict};
use tautline_proofs::ledger::Row;

use crate::Entry;

const HEAD: &str = "\
# Other people's rules

Published rules, each decided within its bound. The package `library` has one file for each rule: its source, its
conditions, the demands, and rules with one thing wrong that the check must reject. This page is generated; a test
compares it with what comes out. `tautline library` lists the rules, `tautline library pibt` decides one of them,
`tautline library all` all of them, and `--larger` takes larger bounds. With `--out DIR` counterexamples are stored, and
`tautline replay` plays them.

Where there are more states than memory, `--memory 8GiB --spill DIR` keeps them on disk
([commands.md](commands.md#larger-than-memory)). Where there are more than either holds,
`tautline library pibt --larger --runs 100000 --out found` hunts: it makes random runs, each by the seed and its number,
and stores the first that breaks a promise. A run that goes round for ever is found, too, if it is weakly fair.
`tautline minimise FILE` makes it a shortest one from its start. What no run breaks is *not refuted*, and may be broken
all the same. With `--plan` and `--shards` the checks are dealt out among machines:
see [shards.md](shards.md).

*Outside its premises* is a rule as published where its source claims nothing of it: PIBT on floors with a dead end, as
its Theorem 1 needs cycles; revised prioritised planning where starts and goals are not well-formed; the K-state ring
with two states fewer than machines; Ricart–Agrawala with a lost message; gathering from a start that is no star.

The models are ours: a file says how it reads its source, and a verdict is about that reading. PIBT and LaCAM break ties
by the numbers of cells; the ring has the legitimate phase of its algorithm alone; Alpha's robots, and those of
aggregation, move on cells, not on a plane. Not every demand is one that the source makes: some say what a reader may
expect and the rule does not promise, such as that no two robots set out for one frontier; their sentences say so.

A counterexample is a shortest one within the bound, one that goes round by its moves until it begins again; of those
that are as short, one in the smallest layout. Robots are numbers; the letter behind is the robot whose goal the cell
is (`a` for 0). Blocked cells are `#`. *States* are all that were looked at. [stateright](https://www.stateright.rs)
counts the same ones of Dijkstra's ring, Ricart–Agrawala and gathering by the same moves, and SPIN those of
Ricart–Agrawala by a model of its own, 3,300 and, with a message that may be lost, 10,522:
[library/tests/counts.rs](../library/tests/counts.rs).

An independent program counts 1,027,192 states of PIBT with three agents on all biconnected layouts to 3×3 cells, and
697,628 with four agents on those of 5 and 6 cells. We do not know how it reads the paper where the paper leaves it
open. Its counts are none of those of the readings that we tried. In this table a shape counts in each place where it
can stand; below each shape counts once:

| robots at their goals | priorities change | three agents | four agents |
|---|---|---|---|
| come last, by number (ours) | when a step has been made | 991,988 | 635,680 |
| come last, as they came | when a step has been made | 1,020,702 | 688,860 |
| come last, the highest number first | when a step has been made | 1,005,092 | 644,780 |
| come last, by number | by where the step began | 1,001,355 | 691,408 |
| come last, as they came | by where the step began | 1,009,193 | 729,208 |

Without the preference for cells that are free, ours has 981,509 and 625,198. In the second row the order of equally
good cells changes little: four agents have 688,824 to 689,026 states with any order of the four sides.

Lines of code of each rule with its demands, mutants, drawing, source and registration, beside those of a user who wrote
the rule with its own world from the documents alone, before there were these faces; and those of the rule without
mutants, source and registration:

| rule | before | now | the rule |
|---|---|---|---|
| PIBT | 243 | 63, and 40 that LaCAM shares | 41, and 40 |
| Yamauchi's frontiers | 169 | 50 | 31 |
| Ricart–Agrawala | 172 | 85 | 68 |
| a ring of robots | 133 | 57 | 43 |
| a corridor | 133 | 66 | 51 |
| boustrophedon | 142 | 61 | 44 |
| Dijkstra's ring | 97 | 63 | 44 |

In [Python](python.md#a-rule-over-states) Dijkstra's ring has 24 lines and Ricart–Agrawala 50, with demands, without
mutants and registration ([ring.py](../python/tests/ring.py), [mutex.py](../python/tests/mutex.py)).

Four of Alpha's robots, all together, have 292,924 states on 6×6 cells, 1,013,486 on 8×8, and 26,713,844 on 16×16, where
the promise is refuted, too, in 1.4 GB and 385 s on a part of one core
(`cargo test -p tautline-library --test all four_robots -- --ignored --nocapture`). States that are turns of each other,
or differ in the order of robots, count once; of the 4.3 billion starts in all places and headings, 731,392 are looked
at.

| rule | source | checks that hold | refuted |
|---|---|---|---|
";

/// A rule in the table of all: how many of its checks hold, and how many are refuted.
fn line(entry: &Entry, rows: &[Row]) -> String {
    let count = |verdict| rows.iter().filter(|row| row.decision.verdict == verdict).count();
    let (holds, refuted) = (count(Verdict::Holds), count(Verdict::Refuted));
    format!("| [{}](#{}) | {} | {holds} | {refuted} |\n", entry.title, entry.name, entry.source)
}

/// The checks of a rule, a line for each, those that are refuted with the number of their drawing.
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
            format!("[drawn](#{})", heading(entry, drawings))
        } else {
            "-".to_owned()
        };
        let (id, rule, verdict) = (row.clause.id, row.check.rule(), decision.verdict.word());
        // Writing to a string cannot fail.
        let _ = writeln!(
            text,
            "| {id} | {rule} | {verdict} | {} | {} | {mutants} | {drawn} |",
            row.check.bound(),
            decision.cases,
        );
    }
    text
}

/// A rule with its promises, its checks, and its counterexamples.
fn section(entry: &Entry, rows: &[Row]) -> String {
    let promises = entry.clauses().map(|clause| format!("- {}: {}\n", clause.id, clause.sentence));
    format!(
        "\n## {}\n\n{}: {}.\n\n{}\n| promise | about | verdict | bound | states | mutants killed | counterexample |\n\
         |---|---|---|---|---|---|---|\n{}{}",
        entry.name,
        entry.title,
        entry.source,
        promises.collect::<String>(),
        table(entry, rows),
        drawings(entry, rows),
    )
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
            "\n### {}\n\n{}, {}: not so: {}.\n\n```text\n{}```\n",
            heading(entry, number),
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
    let lines = all.iter().map(|(entry, rows)| line(entry, rows));
    let sections = all.iter().map(|(entry, rows)| section(entry, rows));
    [HEAD.to_owned()].into_iter().chain(lines).chain(sections).collect()
}

//! Random runs of the rules, for bounds with more states than a search can keep.

use std::path::Path;

use schemars::JsonSchema;
use serde::Serialize;
use tautline_io::atomic_file::Replaceable;
use tautline_io::diagnostic::Halt;
use tautline_proofs::clause::Clause;
use tautline_proofs::decide::{RandomRuns, Verdict};
use tautline_proofs::ledger::{self, Indecision, Limits, Row, indented};
use tautline_proofs::plural::counted;

use crate::evidence::{EvidenceJson, registered, shown};
use crate::exit::Exit;
use crate::findings::{self, Case, Format, Outcome};
use crate::folder::{clear, make_folder};
use crate::interrupt;
use crate::output::{Output, replay_line};
use crate::progress::{self, Shown};
use crate::prove::{stored, story};

/// Moves of a run that is drawn as it is found.
const DRAWN: usize = 24;

/// The JSON of a hunt.
#[derive(JsonSchema, Serialize)]
pub(crate) struct HuntedJson {
    runs: u64,
    seed: u64,
    max_moves: u32,
    checks: Vec<CheckJson>,
    /// Whether runs were made for every check: a signal ended nothing.
    complete: bool,
}

/// A check, and its first run that breaks the promise.
#[derive(JsonSchema, Serialize)]
struct CheckJson {
    clause: &'static str,
    rule: &'static str,
    bound: String,
    verdict: &'static str,
    /// Runs that were made, the one that breaks the promise being the last.
    runs: u64,
    counterexample: Option<EvidenceJson>,
    /// Where it is stored, if it is.
    file: Option<String>,
}

/// Makes random runs for each check of `clauses`, and tells of those that break a promise, which are stored in a folder
/// if there is one.
///
/// # Errors
/// [`Halt`] if a check cannot begin, or nothing can be printed.
pub(super) fn hunt(
    clauses: &[&'static Clause],
    (runs, limits): (&RandomRuns, &Limits),
    (folder, replaceable): (Option<&Path>, &Replaceable),
    format: Format,
    out: &mut Output,
) -> Result<Exit, Halt> {
    let new = folder.map(make_folder).transpose()?.unwrap_or_default();
    let checks = ledger::checks(clauses);
    let bar = progress::bar("hunting", 1);
    let hear = progress::hears(&bar, Shown::Checks, limits.patience_s);
    interrupt::defer_for_pool();
    tracing::debug!("hunting: {}", counted(checks.len(), "check"));
    let mut rows = registered(ledger::hunt(&checks, runs, limits, &hear));
    rows.retain(|row| row.undecided != Some(Indecision::Ended));
    bar.finish_and_clear();
    let file = |row: &Row| folder.map_or(Ok(None), |folder| stored(row, folder, replaceable, &mut *out));
    let files = rows.iter().map(file).collect::<Result<Vec<_>, _>>()?;
    let left = (rows.len() < checks.len()).then(|| {
        clear(&new);
        let (left, of) = (checks.len() - rows.len(), counted(checks.len(), "check"));
        format!("A signal ended the work: {left} of {of} are left, and nothing is claimed of them.\n")
    });
    let told = || rows.iter().zip(&files);
    match format {
        Format::Json => {
            let &RandomRuns { runs, seed, most_moves: max_moves } = runs;
            let checks = told().map(json).collect::<Result<_, _>>()?;
            out.json(&HuntedJson { runs, seed, max_moves, checks, complete: left.is_none() })?;
        }
        Format::Text => {
            let text = told().map(|(row, file)| words(row, runs, file.as_deref()));
            let text = text.chain(left.clone().map(Ok)).collect::<Result<Vec<_>, Halt>>()?;
            out.text(text.join("\n"))?;
        }
        Format::Github => {
            let last = last(&rows) + "\n" + left.as_deref().unwrap_or_default();
            out.text(findings::github(&cases(&rows, runs, left.as_ref())?, &last))?;
        }
        Format::Junit => out.text(findings::junit("library", &cases(&rows, runs, left.as_ref())?))?,
    }
    let is = |verdict| rows.iter().any(|row| row.decision.verdict == verdict);
    Ok(match (is(Verdict::Open) || left.is_some(), is(Verdict::Refuted)) {
        (true, _) => Exit::Unfinished,
        (false, true) => Exit::Violation,
        (false, false) => Exit::Expected,
    })
}

fn json((row, file): (&Row, &Option<String>)) -> Result<CheckJson, Halt> {
    let Row { clause, check, ref decision, .. } = *row;
    Ok(CheckJson {
        clause: clause.id,
        rule: check.rule(),
        bound: check.bound(),
        verdict: decision.verdict.word(),
        runs: decision.cases,
        counterexample: decision.counterexample.as_ref().map(|found| shown(check, found)).transpose()?,
        file: file.clone(),
    })
}

/// The outcome in a line.
fn outcome(row: &Row, runs: &RandomRuns) -> String {
    let (cases, most) = (row.decision.cases, counted(runs.most_moves as usize, "move"));
    match row.decision.verdict {
        Verdict::Refuted => format!("refuted by run {cases} of {}", runs.runs),
        Verdict::Open => {
            row.undecided.map_or("open, since there is no start".to_owned(), |why| format!("open: {why}"))
        }
        Verdict::Holds | Verdict::Unrefuted => format!("not refuted by {cases} runs of at most {most}"),
    }
}

/// The result of a check, and the run that breaks it: drawn if it is short.
fn words(row: &Row, runs: &RandomRuns, file: Option<&str>) -> Result<String, Halt> {
    let Row { clause, check, ref decision, .. } = *row;
    let head =
        format!("{} as {}: {}\n{}", clause.id, check.rule(), outcome(row, runs), indented(2, &check.bound()));
    let Some(found) = &decision.counterexample else { return Ok(head) };
    // The first choice is the start.
    let moves = found.choices.all().count().saturating_sub(1);
    let told = if moves <= DRAWN {
        story(row, file)?
    } else {
        let file = file.map(replay_line).unwrap_or_default();
        format!("\nNot so: {}, after {}.\n{file}", found.demand, counted(moves, "move"))
    };
    let shorter = file.map(|file| format!("shorten it with: tautline minimise {file}\n")).unwrap_or_default();
    Ok(head + &told + &shorter)
}

fn cases(rows: &[Row], runs: &RandomRuns, left: Option<&String>) -> Result<Vec<Case>, Halt> {
    let case = |row: &Row| {
        Ok(Case {
            class: row.clause.scheme().to_owned(),
            name: format!("{} as {}: {}", row.clause.id, row.check.rule(), row.check.bound()),
            outcome: match row.decision.verdict {
                Verdict::Refuted => Outcome::Broken(outcome(row, runs), words(row, runs, None)?),
                Verdict::Open => Outcome::Unfinished(outcome(row, runs)),
                Verdict::Holds | Verdict::Unrefuted => Outcome::Expected,
            },
            seconds: Some(row.seconds),
        })
    };
    let left = left.map(|why| Ok(Case::left(why.clone())));
    rows.iter().map(case).chain(left).collect()
}

fn last(rows: &[Row]) -> String {
    let refuted = rows.iter().filter(|row| row.decision.verdict == Verdict::Refuted).count();
    format!("{refuted} of {} are refuted by random runs", counted(rows.len(), "check"))
}

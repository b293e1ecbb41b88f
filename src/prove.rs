//! `tautline prove`: the clauses of SPEC.md, decided.

use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};
use std::time::Instant;

use clap::Args;
use serde::Serialize;
use tautline_proofs::clause::Clause;
use tautline_proofs::decide::{Memory, Seen};
use tautline_proofs::engine::tree::Progress;
use tautline_proofs::ledger::{self, Row, table};

use super::evidence::{self, Shown, shown};
use super::hunt::keep;
use super::output::Output;
use super::{Exit, ForceArgs, Format, FormatArgs, progress};
use tautline_sim::aside::Replaceable;
use tautline_sim::counterexample::{hunt, refutation};
use tautline_sim::fault::{Fault, Halt};

const EXAMPLES: &str = "\
Examples:
  tautline prove
  tautline prove CHAIN-1 CHAIN-2
  tautline prove BRICKS-4 --out refutations
  tautline prove --format json";

/// Decide the clauses of SPEC.md within their bounds, and print the ledger.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct Prove {
    /// The clauses to decide, by their ids. Without one, all are.
    #[arg(value_name = "CLAUSE")]
    clauses: Vec<String>,
    /// Store each counterexample as a file in DIR, which `tautline replay` plays. DIR is made if it is not there.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    #[command(flatten)]
    force: ForceArgs,
    #[command(flatten)]
    format: FormatArgs,
}

/// What becomes of a row besides.
struct Told {
    seconds: f64,
    /// Where its counterexample is stored.
    file: Option<String>,
}

#[derive(Serialize)]
struct Ledger {
    clauses: Vec<Line>,
    as_registered: bool,
}

#[derive(Serialize)]
struct Line {
    id: &'static str,
    rule: &'static str,
    engine: &'static str,
    bound: String,
    cases: u64,
    /// Cases that were given up undecided, which are not among them.
    given_up: u64,
    verdict: &'static str,
    registered: &'static str,
    counterexample: Option<Shown>,
    /// Where it is stored, if it is.
    file: Option<String>,
    mutants: Mutants,
    seconds: f64,
}

#[derive(Serialize)]
struct Mutants {
    killed: usize,
    of: usize,
    survived: Vec<&'static str>,
}

impl Prove {
    pub(super) fn run(&self, out: &mut Output) -> Result<Exit, Halt> {
        let clauses = self.chosen()?;
        let replaceable = self.force.replaceable([]);
        if self.force.force && self.out.is_none() {
            let what = "--force without a file to store";
            return Err(Fault::usage(what, "give --out, or leave out --force").into());
        }
        if let Some(folder) = &self.out {
            fs::create_dir_all(folder).map_err(|error| {
                let what = format!("the folder cannot be made: {error}");
                Fault::in_file(folder, what, "name a folder, or a place where one can be made")
            })?;
        }
        let checks = ledger::checks(&clauses);
        let mut memory = Memory::default();
        let (mut rows, mut told) = (Vec::new(), Vec::new());
        for (place, &(clause, number)) in (1..).zip(&checks) {
            let bar = progress::bar(format!("{place}/{} {}", checks.len(), clause.id), 1);
            let start = Instant::now();
            let watch = &mut |progress: &Progress<'_>| progress::show(&bar, progress);
            let row = ledger::decide(clause, number, &mut memory, watch).map_err(|refused| {
                Fault::usage(refused, "this is a bug in the registry: please report it")
            })?;
            bar.finish_and_clear();
            let seconds = start.elapsed().as_secs_f64();
            let (rule, engine) = (row.check.rule(), row.check.engine());
            tracing::info!("{} {rule} {engine}: {seconds:.1} s", clause.id);
            let file = match &self.out {
                Some(folder) => stored(&row, folder, &replaceable, out)?,
                None => None,
            };
            rows.push(row);
            told.push(Told { seconds, file });
        }
        let as_registered = rows.iter().all(Row::is_as_registered);
        match self.format.format {
            Format::Json => {
                let clauses = rows.iter().zip(&told).map(line).collect::<Result<_, Halt>>()?;
                out.json(&Ledger { clauses, as_registered })?;
            }
            Format::Text => {
                out.text(table(&rows))?;
                for (row, told) in rows.iter().zip(&told) {
                    out.text(story(row, told)?)?;
                }
                out.text(last_line(&rows))?;
            }
        }
        Ok(if as_registered { Exit::Expected } else { Exit::Violation })
    }

    fn chosen(&self) -> Result<Vec<&'static Clause>, Fault> {
        if self.clauses.is_empty() {
            return Ok(ledger::clauses().collect());
        }
        let find = |id: &String| {
            ledger::clauses().find(|clause| clause.id.eq_ignore_ascii_case(id)).ok_or_else(|| {
                let known: Vec<&str> = ledger::clauses().map(|clause| clause.id).collect();
                let remedy = format!("the clauses are {}", known.join(", "));
                Fault::usage(format_args!("there is no clause {id:?}"), remedy)
            })
        };
        self.clauses.iter().map(find).collect()
    }
}

fn line((row, told): (&Row, &Told)) -> Result<Line, Halt> {
    let Row { clause, check, ref decision, .. } = *row;
    let evidence = decision.counterexample.as_ref();
    Ok(Line {
        id: clause.id,
        rule: check.rule(),
        engine: check.engine(),
        bound: check.bound(),
        cases: decision.cases,
        given_up: decision.given_up,
        verdict: decision.verdict.word(),
        registered: check.expected().word(),
        counterexample: evidence.map(|evidence| shown(check, evidence)).transpose()?,
        file: told.file.clone(),
        mutants: Mutants {
            killed: decision.killed.len(),
            of: decision.killed.len() + decision.survived.len(),
            survived: decision.survived.clone(),
        },
        seconds: told.seconds,
    })
}

/// Stores what refutes the clause of a row in `folder`: the place of the file.
fn stored(
    row: &Row,
    folder: &Path,
    replaceable: &Replaceable,
    out: &mut Output,
) -> Result<Option<String>, Halt> {
    let Row { clause, number, check, ref decision } = *row;
    let Some(evidence) = &decision.counterexample else { return Ok(None) };
    let path = refutation::path(folder, clause, number);
    let run = match &evidence.seen {
        Seen::Robots(run) => evidence::setup(check, run)?.zip(evidence::breach(run)),
        Seen::Choices | Seen::Story(_) | Seen::Agents(_) | Seen::Messages { .. } => None,
    };
    let file = match run {
        Some((setup, breach)) => hunt::store_at(&path, &setup, breach, replaceable)?.0,
        None => refutation::store(&path, clause, check, evidence, replaceable)?,
    };
    Ok(keep(file, out))
}

/// What one sees in a counterexample, and where it is stored.
fn story(row: &Row, told: &Told) -> Result<String, Halt> {
    let Some(evidence) = &row.decision.counterexample else { return Ok(String::new()) };
    let story = evidence::story(row.clause, row.check, evidence)?;
    let file = told.file.as_ref().map(|file| format!("\nreplay it with: tautline replay {file}\n"));
    Ok(format!("\n{story}{}", file.unwrap_or_default()))
}

fn last_line(rows: &[Row]) -> String {
    let mut text = String::from("\n");
    for row in rows.iter().filter(|row| !row.is_as_registered()) {
        let (verdict, expected) = (row.decision.verdict.word(), row.check.expected().word());
        let _ =
            writeln!(text, "{} as {}: {verdict}, registered as {expected}", row.clause.id, row.check.rule());
        for mutant in &row.decision.survived {
            let _ = writeln!(text, "{}: the mutant {mutant:?} survives", row.clause.id);
        }
    }
    let differ = rows.iter().filter(|row| !row.is_as_registered()).count();
    let _ = match differ {
        0 => writeln!(text, "All {} verdicts are the registered ones.", rows.len()),
        _ => writeln!(text, "{differ} of {} verdicts are not the registered ones.", rows.len()),
    };
    text
}

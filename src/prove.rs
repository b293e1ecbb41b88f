//! `tautline prove`: the clauses of SPEC.md, decided.

use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};
use std::time::Instant;

use clap::Args;
use serde::Serialize;
use tautline_proofs::clause::{Check, Clause};
use tautline_proofs::decide::{Decision, Evidence, Prover};
use tautline_proofs::registry::CLAUSES;

use super::evidence::{self, Shown, indented, shown};
use super::hunt::keep;
use super::output::Output;
use super::{Exit, ForceArgs, Format, FormatArgs, progress};
use tautline_sim::aside::Replaceable;
use tautline_sim::counterexample::hunt;
use tautline_sim::counterexample::refutation::{self, rule};
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

/// A check that was decided.
struct Row {
    clause: &'static Clause,
    check: &'static Check,
    decision: Decision,
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
        let checks: Vec<(&Clause, &Check)> = clauses
            .iter()
            .flat_map(|clause| clause.checks.iter().map(move |check| (*clause, check)))
            .collect();
        let mut prover = Prover::default();
        let mut rows = Vec::new();
        for (place, (clause, check)) in (1..).zip(&checks) {
            let bar = progress::bar(format!("{place}/{} {}", checks.len(), clause.id), 1);
            let start = Instant::now();
            let decision =
                prover.decide(check, &mut |progress| progress::show(&bar, progress)).map_err(|refused| {
                    Fault::usage(refused, "this is a bug in the registry: please report it")
                })?;
            bar.finish_and_clear();
            let seconds = start.elapsed().as_secs_f64();
            tracing::info!("{} {} {}: {seconds:.1} s", clause.id, rule(check), check.method.engine());
            let mut row = Row { clause, check, decision, seconds, file: None };
            if let Some(folder) = &self.out {
                row.store(folder, &replaceable, out)?;
            }
            rows.push(row);
        }
        let as_registered = rows.iter().all(|row| row.decision.is_as_registered(row.check));
        match self.format.format {
            Format::Json => {
                let clauses = rows.iter().map(Row::line).collect::<Result<_, Halt>>()?;
                out.json(&Ledger { clauses, as_registered })?;
            }
            Format::Text => {
                out.text(table(&rows))?;
                for row in &rows {
                    out.text(row.story()?)?;
                }
                out.text(last_line(&rows))?;
            }
        }
        Ok(if as_registered { Exit::Expected } else { Exit::Violation })
    }

    fn chosen(&self) -> Result<Vec<&'static Clause>, Fault> {
        if self.clauses.is_empty() {
            return Ok(CLAUSES.iter().collect());
        }
        let find = |id: &String| {
            CLAUSES.iter().find(|clause| clause.id.eq_ignore_ascii_case(id)).ok_or_else(|| {
                let known: Vec<&str> = CLAUSES.iter().map(|clause| clause.id).collect();
                let remedy = format!("the clauses are {}", known.join(", "));
                Fault::usage(format_args!("there is no clause {id:?}"), remedy)
            })
        };
        self.clauses.iter().map(find).collect()
    }
}

impl Row {
    /// The bound, and how many of its cases were given up.
    fn bound(&self) -> String {
        let bound = self.check.method.bound();
        match self.decision.given_up {
            0 => bound,
            given_up => format!("{bound}; {given_up} given up"),
        }
    }

    fn mutants(&self) -> Mutants {
        let Decision { killed, survived, .. } = &self.decision;
        Mutants { killed: killed.len(), of: killed.len() + survived.len(), survived: survived.clone() }
    }

    fn line(&self) -> Result<Line, Halt> {
        let evidence = self.decision.counterexample.as_ref();
        Ok(Line {
            id: self.clause.id,
            rule: rule(self.check),
            engine: self.check.method.engine(),
            bound: self.check.method.bound(),
            cases: self.decision.cases,
            given_up: self.decision.given_up,
            verdict: self.decision.verdict.word(),
            registered: self.check.expected.word(),
            counterexample: evidence.map(|evidence| shown(self.check, evidence)).transpose()?,
            file: self.file.clone(),
            mutants: self.mutants(),
            seconds: self.seconds,
        })
    }

    /// Stores what refutes the clause in `folder`.
    fn store(&mut self, folder: &Path, replaceable: &Replaceable, out: &mut Output) -> Result<(), Halt> {
        let (clause, check) = (self.clause, self.check);
        let Some(evidence) = &self.decision.counterexample else { return Ok(()) };
        let path = refutation::path(folder, clause, check);
        let run = match evidence {
            Evidence::Run(run) => evidence::setup(check, run)?.zip(hunt::breach(run.invariant)),
            Evidence::Choices(..) | Evidence::Course(..) | Evidence::Rescue(_) => None,
        };
        let file = match run {
            Some((setup, breach)) => hunt::store_at(&path, &setup, breach, replaceable)?.0,
            None => refutation::store(&path, clause, check, evidence, replaceable)?,
        };
        self.file = keep(file, out);
        Ok(())
    }

    /// What one sees in a counterexample, and where it is stored.
    fn story(&self) -> Result<String, Halt> {
        let Some(evidence) = &self.decision.counterexample else { return Ok(String::new()) };
        let story = evidence::story(self.clause, self.check, evidence)?;
        let file = self.file.as_ref().map(|file| format!("\nreplay it with: tautline replay {file}\n"));
        Ok(format!("\n{story}{}", file.unwrap_or_default()))
    }
}

const HEAD: [&str; 6] = ["clause", "rule", "engine", "cases", "verdict", "mutants killed"];

/// The column of the cases, which are numbers.
const CASES: usize = 3;

/// The ledger: a line for each check, and its bound below. What takes time is not in it, so that it is the same
/// everywhere.
fn table(rows: &[Row]) -> String {
    let cells = |row: &Row| {
        let Mutants { killed, of, .. } = row.mutants();
        let mutants = if of == 0 { "-".to_owned() } else { format!("{killed}/{of}") };
        [
            row.clause.id.to_owned(),
            rule(row.check).to_owned(),
            row.check.method.engine().to_owned(),
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
    let bounds = ["bound".to_owned()].into_iter().chain(rows.iter().map(Row::bound));
    let mut text = String::new();
    for (line, bound) in lines.iter().zip(bounds) {
        let padded: Vec<String> = (0..)
            .zip(line.iter().zip(widths))
            .map(|(column, (cell, width))| match column {
                CASES => format!("{cell:>width$}"),
                _ => format!("{cell:width$}"),
            })
            .collect();
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{}", padded.join("  ").trim_end());
        text.push_str(&indented(widths[0] + 2, &bound));
    }
    text
}

fn last_line(rows: &[Row]) -> String {
    let mut text = String::from("\n");
    for row in rows.iter().filter(|row| !row.decision.is_as_registered(row.check)) {
        let (verdict, expected) = (row.decision.verdict.word(), row.check.expected.word());
        let _ =
            writeln!(text, "{} as {}: {verdict}, registered as {expected}", row.clause.id, rule(row.check));
        for mutant in &row.decision.survived {
            let _ = writeln!(text, "{}: the mutant {mutant:?} survives", row.clause.id);
        }
    }
    let differ = rows.iter().filter(|row| !row.decision.is_as_registered(row.check)).count();
    let _ = match differ {
        0 => writeln!(text, "All {} verdicts are the registered ones.", rows.len()),
        _ => writeln!(text, "{differ} of {} verdicts are not the registered ones.", rows.len()),
    };
    text
}

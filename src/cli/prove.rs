//! `tautline prove`: the clauses of SPEC.md, decided.

use std::fmt::Write;
use std::time::Instant;

use clap::Args;
use serde::Serialize;
use tautline_kernel::lattice::Edge;
use tautline_proofs::clause::{Check, Clause, Method, Subject};
use tautline_proofs::course::Course;
use tautline_proofs::decide::{Decision, Evidence, Prover};
use tautline_proofs::registry::CLAUSES;
use tautline_proofs::rescue::chart::chart;
use tautline_proofs::search::{Bounds, Counterexample};

use super::output::Output;
use super::{Exit, Format, FormatArgs, progress, usage};
use crate::explore::agents::Way;
use crate::explore::{Crew, RuleName, Setup};
use crate::fault::{Fault, Halt};
use crate::{hunt, view};

const EXAMPLES: &str = "\
Examples:
  tautline prove
  tautline prove CHAIN-1 CHAIN-2
  tautline prove --format json";

/// Decide the clauses of SPEC.md within their bounds, and print the ledger.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct Prove {
    /// The clauses to decide, by their ids. Without one, all are.
    #[arg(value_name = "CLAUSE")]
    clauses: Vec<String>,
    #[command(flatten)]
    format: FormatArgs,
}

/// A check that was decided.
struct Row {
    clause: &'static Clause,
    check: &'static Check,
    decision: Decision,
    seconds: f64,
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
    verdict: &'static str,
    registered: &'static str,
    counterexample: Option<Shown>,
    mutants: Mutants,
    seconds: f64,
}

#[derive(Serialize)]
#[serde(untagged)]
enum Shown {
    Choices { demand: &'static str, choices: Vec<u32> },
    Run { demand: &'static str, walls: usize, steps: usize, layout: String },
    Course { demand: &'static str, turns: usize, drawing: String },
    Chart { demand: &'static str, events: usize, chart: String },
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
            tracing::info!(
                "{} {} {}: {seconds:.1} s",
                clause.id,
                rule(&check.subject),
                check.method.engine()
            );
            rows.push(Row { clause, check, decision, seconds });
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

/// The name of the rule that a check is about.
fn rule(subject: &Subject) -> &'static str {
    subject.name().unwrap_or("other")
}

impl Row {
    fn mutants(&self) -> Mutants {
        let Decision { killed, survived, .. } = &self.decision;
        Mutants { killed: killed.len(), of: killed.len() + survived.len(), survived: survived.clone() }
    }

    fn line(&self) -> Result<Line, Halt> {
        let counterexample = match &self.decision.counterexample {
            None => None,
            Some(Evidence::Choices(choices, demand)) => {
                Some(Shown::Choices { demand, choices: choices.clone() })
            }
            Some(Evidence::Run(run)) => {
                let layout = self.setup(run)?.map_or_else(String::new, |setup| setup.layout.to_string());
                Some(Shown::Run {
                    demand: run.demand,
                    walls: run.walls.len(),
                    steps: run.frames.len(),
                    layout,
                })
            }
            Some(Evidence::Course(course, demand)) => {
                Some(Shown::Course { demand, turns: course.turns.len(), drawing: self.drawn(course)? })
            }
            Some(Evidence::Rescue(run)) => {
                let (setting, broken) = &**run;
                Some(Shown::Chart {
                    demand: broken.demand.broken(),
                    events: broken.actions.len(),
                    chart: chart(setting, broken),
                })
            }
        };
        Ok(Line {
            id: self.clause.id,
            rule: rule(&self.check.subject),
            engine: self.check.method.engine(),
            bound: self.check.method.bound(),
            cases: self.decision.cases,
            verdict: self.decision.verdict.word(),
            registered: self.check.expected.word(),
            counterexample,
            mutants: self.mutants(),
            seconds: self.seconds,
        })
    }

    /// The run of a counterexample that a search has found.
    fn setup(&self, run: &Counterexample) -> Result<Option<Setup>, Halt> {
        let subject = &self.check.subject;
        let (Method::Search { robots, max_walls, .. }, Some(rule)) =
            (self.check.method, RuleName::of(subject))
        else {
            return Ok(None);
        };
        let bounds = Bounds::new(*subject, robots, max_walls);
        Ok(Some(hunt::setup(rule, &bounds, run).map_err(|problem| usage(&problem))?))
    }

    /// The run of a counterexample of agents.
    fn drawn(&self, course: &Course) -> Result<String, Halt> {
        let crew = Crew::Agents(Way::Bricks(self.check.subject.bricks));
        Ok(view::story::of_course(crew, course).map_err(|problem| usage(&problem))?)
    }

    /// What one sees in a counterexample.
    fn story(&self) -> Result<String, Halt> {
        let id = self.clause.id;
        Ok(match &self.decision.counterexample {
            None => String::new(),
            Some(Evidence::Choices(choices, demand)) => {
                let rule = rule(&self.check.subject);
                match self.check.method {
                    Method::Spread(networks) => {
                        let story = networks.story(&self.check.subject, choices);
                        format!("\n{id} as {rule}: not so: {demand}.\n{story}")
                    }
                    Method::Exhaustive { .. }
                    | Method::Ants
                    | Method::Floors(_)
                    | Method::Sampled { .. }
                    | Method::Search { .. }
                    | Method::States { .. } => format!(
                        "\n{id} as {rule}: not so: {demand}. The choices that lead there: {}\n",
                        listed(choices)
                    ),
                }
            }
            Some(Evidence::Run(run)) => {
                let walls = run.walls.len();
                let head = format!(
                    "\n{id} as {}: the smallest counterexample has {walls} walls ({}) and {} team moves.\n\n",
                    rule(&self.check.subject),
                    named(&run.walls),
                    run.frames.len()
                );
                match self.setup(run)? {
                    Some(setup) => head + &view::story::last_move(&setup)?,
                    None => head,
                }
            }
            Some(Evidence::Course(course, demand)) => {
                let rule = rule(&self.check.subject);
                format!("\n{id} as {rule}: not so: {demand}.\n\n{}", self.drawn(course)?)
            }
            Some(Evidence::Rescue(run)) => {
                let (setting, broken) = &**run;
                format!(
                    "\n{id} as {}: the shortest run that breaks it has {} events.\n\n{}",
                    rule(&self.check.subject),
                    broken.actions.len(),
                    chart(setting, broken)
                )
            }
        })
    }
}

fn named(walls: &[Edge]) -> String {
    let between = |wall: &Edge| format!("{}|{}", wall.cell(), wall.cell().beyond(wall.side()));
    walls.iter().map(between).collect::<Vec<_>>().join(" ")
}

/// Choices that are listed.
const LISTED: usize = 24;

fn listed(choices: &[u32]) -> String {
    let first: Vec<String> = choices.iter().take(LISTED).map(u32::to_string).collect();
    let rest = if choices.len() > LISTED { format!(" … {} in all", choices.len()) } else { String::new() };
    first.join(" ") + &rest
}

const HEAD: [&str; 6] = ["clause", "rule", "engine", "cases", "verdict", "mutants killed"];

/// The column of the cases, which are numbers.
const CASES: usize = 3;

/// Columns of text that a line of the ledger may take.
const WIDTH: usize = 80;

/// The ledger: a line for each check, and its bound below. What takes time is not in it, so that it is the same
/// everywhere.
fn table(rows: &[Row]) -> String {
    let cells = |row: &Row| {
        let Mutants { killed, of, .. } = row.mutants();
        let mutants = if of == 0 { "-".to_owned() } else { format!("{killed}/{of}") };
        [
            row.clause.id.to_owned(),
            rule(&row.check.subject).to_owned(),
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
    let bounds = ["bound".to_owned()].into_iter().chain(rows.iter().map(|row| row.check.method.bound()));
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
        let indent = widths[0] + 2;
        for part in wrapped(&bound, WIDTH - indent) {
            let _ = writeln!(text, "{:indent$}{part}", "");
        }
    }
    text
}

/// `text` in lines of at most `width` characters, broken behind commas and semicolons.
fn wrapped(text: &str, width: usize) -> Vec<String> {
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
    parts.map(str::trim_end).fold(Vec::new(), joined)
}

fn last_line(rows: &[Row]) -> String {
    let mut text = String::from("\n");
    for row in rows.iter().filter(|row| !row.decision.is_as_registered(row.check)) {
        let (verdict, expected) = (row.decision.verdict.word(), row.check.expected.word());
        let _ = writeln!(
            text,
            "{} as {}: {verdict}, registered as {expected}",
            row.clause.id,
            rule(&row.check.subject)
        );
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

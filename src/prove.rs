//! `tautline prove`: the clauses of SPEC.md, decided.

mod decided;
mod html;
mod screen;

use std::io::{self, Write as _};
use std::num::NonZeroU32;
use std::path::{Path, PathBuf};
use std::str::FromStr;
use std::sync::Arc;
use std::time::Instant;

use clap::Args;
use schemars::JsonSchema;
use serde::Serialize;
use tautline_io::atomic_file::{AtomicFile, Replaceable};
use tautline_io::diagnostic::{Diagnostic, Halt};
use tautline_proofs::clause::{Clause, Variant};
use tautline_proofs::decide::{Answer, Depiction, Verdict};
use tautline_proofs::engine::states::{self, MemoryLimit};
use tautline_proofs::ledger::{self, Indecision, Limits, PATIENCE_S, Row, table};
use tautline_proofs::plural::counted;

pub(super) use self::decided::DecidedRows;
use super::evidence::{self, EvidenceJson, shown};
use super::findings::{self, Format, FormatArgs};
use super::hunt::{clear, keep, make_folder};
use super::output::{Output, replay_line};
use super::progress::Shown;
use super::{Exit, ForceArgs, interrupt, positive, progress, refuse_needless, registered, spill};
use tautline_sim::counterexample::refutation;
use tautline_sim::trace;

const EXAMPLES: &str = "\
Examples:
  tautline prove
  tautline prove CHAIN-1 CHAIN-2
  tautline prove BRICKS-4 --out refutations
  tautline prove KIT-2 --certificate certificates
  tautline prove --memory 1GiB
  tautline prove MRC-1 --memory 1GiB --spill /var/tmp/states
  tautline prove --verbose
  tautline prove --html report.html
  tautline prove --format json
  tautline prove --format junit > prove.xml";

/// A size in bytes, written with its unit.
#[derive(Clone, Copy, Debug)]
struct Bytes(u64);

impl FromStr for Bytes {
    type Err = &'static str;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        const UNITS: [(&str, u32); 3] = [("KiB", 10), ("MiB", 20), ("GiB", 30)];
        let size = UNITS.iter().find_map(|&(unit, bits)| {
            let number: u64 = text.strip_suffix(unit)?.parse().ok()?;
            number.checked_mul(1 << bits).filter(|&bytes| bytes > 0)
        });
        size.map(Self).ok_or("write a whole number above 0 and its unit, KiB, MiB or GiB: for example 1GiB")
    }
}

/// Seconds that one step may take, unless the user says otherwise.
const PATIENCE: NonZeroU32 = NonZeroU32::new(PATIENCE_S).expect("it is above 0");

/// Decide the clauses of SPEC.md within their bounds, and print the verdicts.
///
/// A clause is a promise of a published rule, such as CHAIN-1: no robot leaves the radio coverage of its neighbours.
/// Without a clause one screen tells how many verdicts there are of each kind. With one, or with `--verbose`, each
/// check has its line in a ledger, and each counterexample is drawn.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct Prove {
    /// The clauses to decide, by their ids. Without one, all are.
    #[arg(value_name = "CLAUSE")]
    clauses: Vec<String>,
    #[command(flatten)]
    how: DecisionArgs,
}

/// How clauses are decided, and where it goes.
#[derive(Debug, Args)]
pub(super) struct DecisionArgs {
    /// Store each counterexample as a file in DIR, which `tautline replay` plays. DIR is made if it is not there.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Store a page with all of it: sentences, verdicts, what they rest on, and counterexamples that play.
    #[arg(long, value_name = "FILE")]
    html: Option<PathBuf>,
    /// Store a certificate for each check that holds as a file in DIR: of a search over all states or
    /// all layouts one that `tautline check` checks, of a proof for every number of robots one that
    /// Rocq checks. DIR is made if it is not there.
    #[arg(long, value_name = "DIR")]
    certificate: Option<PathBuf>,
    /// The memory that searches over states may take together, as 1GiB or 500MiB. A check for which it does not suffice
    /// is left open. Without it they take what they need.
    #[arg(long, value_name = "SIZE")]
    memory: Option<Bytes>,
    /// A folder, empty or of the same command that was killed, in which a search over states goes on for which --memory
    /// does not suffice. Of a rule over states it is taken up there.
    #[arg(long, value_name = "DIR", requires = "memory")]
    spill: Option<PathBuf>,
    /// Seconds that one step may take: a team move, a case, a step between states. Where one does not end by then and
    /// no other check goes on, its check is left open.
    #[arg(long, value_name = "SECONDS", value_parser = positive::<NonZeroU32>, default_value_t = PATIENCE)]
    patience: NonZeroU32,
    #[command(flatten)]
    force: ForceArgs,
    #[command(flatten)]
    format: FormatArgs,
}

#[derive(JsonSchema, Serialize)]
#[expect(clippy::struct_excessive_bools, reason = "each is a field of the JSON")]
pub(super) struct Ledger {
    clauses: Vec<Line>,
    /// Whether every verdict is the registered one, and none is missing.
    as_registered: bool,
    /// Whether every check was decided: none is missing because a signal ended the work.
    complete: bool,
    /// Checks that are missing.
    left: usize,
    /// Whether a search was cut off for want of memory.
    out_of_memory: bool,
    /// Whether a step of a check did not end.
    unended: bool,
}

#[derive(JsonSchema, Serialize)]
struct Line {
    id: &'static str,
    sentence: &'static str,
    rule: &'static str,
    engine: &'static str,
    bound: String,
    cases: u64,
    /// Cases that were given up undecided, which are not among them.
    given_up: u64,
    verdict: &'static str,
    registered: &'static str,
    /// The part that is machine-checked beyond the bound.
    #[serde(skip_serializing_if = "Option::is_none")]
    composition: Option<String>,
    /// Why it is registered as refuted, if not as the sentence of a paper.
    #[serde(skip_serializing_if = "Option::is_none")]
    reason: Option<&'static str>,
    counterexample: Option<EvidenceJson>,
    /// Where it is stored, if it is.
    file: Option<String>,
    mutants: Mutants,
    /// The other readings of the rule, and the verdict under each.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    readings: Vec<ReadingLine>,
    /// Why the check, or a mutant, was not decided, if a step did not end.
    #[serde(skip_serializing_if = "Option::is_none")]
    undecided: Option<String>,
    /// The time that threads spent on it and its mutants. What several checks share is counted for the first of them.
    seconds: f64,
}

#[derive(JsonSchema, Serialize)]
struct ReadingLine {
    name: &'static str,
    verdict: &'static str,
    registered: &'static str,
}

#[derive(JsonSchema, Serialize)]
struct Mutants {
    killed: usize,
    of: usize,
    survived: Vec<&'static str>,
}

impl Prove {
    pub(super) fn run(&self, is_verbose: bool, out: &mut Output) -> Result<Exit, Halt> {
        let detail = match (self.clauses.is_empty(), is_verbose) {
            (true, false) => Detail::Screen,
            (true, true) => Detail::All,
            (false, _) => Detail::Rows,
        };
        self.how.decide(&self.chosen()?, detail, out)
    }

    fn chosen(&self) -> Result<Vec<&'static Clause>, Diagnostic> {
        if self.clauses.is_empty() {
            return Ok(ledger::clauses().collect());
        }
        let find = |id: &String| {
            ledger::clauses().find(|clause| clause.id.eq_ignore_ascii_case(id)).ok_or_else(|| {
                let known: Vec<&str> = ledger::clauses().map(|clause| clause.id).collect();
                let remedy = format!("the clauses are {}", known.join(", "));
                Diagnostic::usage(format_args!("there is no clause {id:?}"), remedy)
            })
        };
        self.clauses.iter().map(find).collect()
    }
}

/// How much is printed for people.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Detail {
    /// How many verdicts there are of each kind.
    Screen,
    /// Each check, and each counterexample.
    Rows,
    /// All of that.
    All,
}

impl DecisionArgs {
    /// Where nothing is decided, there is nothing to store, and only text to print.
    ///
    /// # Errors
    /// A [`Diagnostic`] if more is asked for.
    pub(super) fn nothing_is_decided(&self) -> Result<(), Diagnostic> {
        let given = [
            ("--out", self.out.is_some()),
            ("--certificate", self.certificate.is_some()),
            ("--html", self.html.is_some()),
            ("--spill", self.spill.is_some()),
            ("--memory", self.memory.is_some()),
            ("--patience", self.patience != PATIENCE),
            ("--force", self.force.force),
        ];
        refuse_needless(given, "nothing is decided")?;
        match self.format.format {
            Format::Text => Ok(()),
            Format::Json | Format::Github | Format::Junit => {
                let remedy = "name what is to be decided, or leave out --format";
                Err(Diagnostic::usage("nothing is decided that could have this format", remedy))
            }
        }
    }

    /// Of what was decided elsewhere.
    pub(super) const fn elsewhere(out: Option<PathBuf>, force: ForceArgs, format: FormatArgs) -> Self {
        let (html, certificate, memory, spill) = (None, None, None, None);
        Self { out, html, certificate, memory, spill, patience: PATIENCE, force, format }
    }

    /// The folder for counterexamples, the files that may be replaced, and the format.
    pub(super) fn files(&self) -> (Option<&Path>, Replaceable, Format) {
        (self.out.as_deref(), self.force.replaceable([]), self.format.format)
    }

    /// Seconds that one step may take.
    pub(super) const fn patience_s(&self) -> u32 {
        self.patience.get()
    }

    /// Whether files of others may be replaced.
    pub(super) const fn force(&self) -> &ForceArgs {
        &self.force
    }

    /// Decides `clauses`, and tells of it.
    pub(super) fn decide(
        &self,
        clauses: &[&'static Clause],
        detail: Detail,
        out: &mut Output,
    ) -> Result<Exit, Halt> {
        let replaceable = self.force.replaceable([]);
        let stores = [self.out.is_some(), self.certificate.is_some(), self.html.is_some()];
        if self.force.force && !stores.contains(&true) {
            let what = "--force without a file to store";
            return Err(
                Diagnostic::usage(what, "give --out, --certificate or --html, or leave out --force").into()
            );
        }
        let page = self.html.as_deref().map(|path| AtomicFile::new(path, &replaceable)).transpose()?;
        let checks = ledger::checks(clauses);
        let threads = rayon::current_num_threads() as u64;
        let memory =
            self.memory.map_or(MemoryLimit::unbounded(), |Bytes(bytes)| MemoryLimit::of(bytes, threads));
        // The folder is locked until all is decided.
        let (memory, _held) = match &self.spill {
            Some(folder) => {
                let (folder, held) = spill::open(folder)?;
                (memory.spilling(folder), held)
            }
            None => (memory, None),
        };
        let mut new = Vec::new();
        for folder in self.out.iter().chain(&self.certificate) {
            new.extend(make_folder(folder)?);
        }
        let limits = Limits { memory: Arc::new(memory), patience_s: self.patience_s() };
        let memory = &*limits.memory;
        let bar = progress::bar("proving", 1);
        let start = Instant::now();
        let shown = if checks.len() == 1 { Shown::Search } else { Shown::Checks };
        let hear = progress::hears(&bar, shown, limits.patience_s);
        interrupt::defer_for_pool();
        tracing::debug!("proving: {}", counted(checks.len(), "check"));
        let mut rows = registered(ledger::decide(&checks, &limits, &hear));
        rows.retain(|row| row.undecided != Some(Indecision::Ended));
        bar.finish_and_clear();
        tracing::info!("{} checks in {:.1} s", rows.len(), start.elapsed().as_secs_f64());
        let made = DecidedRows { rows: &rows, memory, left: checks.len() - rows.len() };
        let told = self.tell(&made, (detail, page), &replaceable, out);
        if told != Ok(Exit::Expected) {
            clear(&new);
        }
        told
    }

    /// Tells of what was decided, and stores what is to be stored.
    pub(super) fn tell(
        &self,
        made: &DecidedRows<'_>,
        (detail, page): (Detail, Option<AtomicFile>),
        replaceable: &Replaceable,
        out: &mut Output,
    ) -> Result<Exit, Halt> {
        let &DecidedRows { rows, memory, left } = made;
        let mut files = Vec::new();
        for row in rows {
            let (rule, engine) = (row.check.rule(), row.check.engine());
            tracing::info!("{} {rule} {engine}: {:.1} s", row.clause.id, row.seconds);
            files.push(match &self.out {
                Some(folder) => stored(row, folder, replaceable, out)?,
                None => None,
            });
            let is_certified = row.decision.verdict == Verdict::Holds && !interrupt::is_requested();
            if let Some(folder) = self.certificate.as_ref().filter(|_| is_certified) {
                certify((row, memory), folder, replaceable, out);
            }
        }
        if let Some(fault) = memory.fault() {
            out.leave_out(&spill::diagnostic(&fault));
        }
        let mut unfinished = made.unfinished();
        if self.certificate.is_some() && interrupt::is_requested() {
            unfinished += "A signal ended the work: not every check that holds has its certificate.\n";
        }
        let as_registered = left == 0 && rows.iter().all(Row::is_as_registered);
        let ledger = || -> Result<Ledger, Halt> {
            let clauses = rows.iter().zip(&files).map(line).collect::<Result<_, Halt>>()?;
            let (out_of_memory, unended) = (memory.was_too_small(), rows.iter().any(decided::is_undecided));
            Ok(Ledger { clauses, as_registered, complete: left == 0, left, out_of_memory, unended })
        };
        out.store(page, |page| page.draw(html::report(rows, &ledger()?)))?;
        match (self.format.format, detail) {
            (Format::Json, _) => out.json(&ledger()?)?,
            (Format::Text, detail) => {
                if detail != Detail::Screen {
                    out.text(table(rows))?;
                    for (row, file) in rows.iter().zip(&files) {
                        out.text(story(row, file.as_deref())?)?;
                    }
                }
                if detail == Detail::All {
                    out.text("\n")?;
                }
                if detail != Detail::Rows {
                    out.text(screen::screen(rows))?;
                    // Nobody may be there any more to read it.
                    let _ = writeln!(io::stderr(), "{}", screen::slowest(rows));
                }
                out.text(screen::last_line(rows))?;
                out.text(&unfinished)?;
            }
            (Format::Github, _) => {
                let last = screen::last_line(rows) + &unfinished;
                out.text(findings::github(&made.findings()?, &last))?;
            }
            (Format::Junit, _) => {
                let is_ours = |row: &Row| ledger::clauses().any(|clause| clause.id == row.clause.id);
                let command = if rows.iter().all(is_ours) { "prove" } else { "library" };
                out.text(findings::junit(command, &made.findings()?))?;
            }
        }
        Ok(match (unfinished.is_empty(), as_registered) {
            (false, _) => Exit::Unfinished,
            (true, true) => Exit::Expected,
            (true, false) => Exit::Violation,
        })
    }
}

fn line((row, file): (&Row, &Option<String>)) -> Result<Line, Halt> {
    let Row { clause, check, ref decision, undecided, seconds, .. } = *row;
    let evidence = decision.counterexample.as_ref();
    Ok(Line {
        id: clause.id,
        sentence: clause.sentence,
        rule: check.rule(),
        engine: check.engine(),
        bound: check.bound(),
        cases: decision.cases,
        given_up: decision.given_up,
        verdict: decision.verdict.word(),
        registered: check.expected().word(),
        composition: row.composition(),
        reason: check.reason(),
        counterexample: evidence.map(|evidence| shown(check, evidence)).transpose()?,
        file: file.clone(),
        mutants: Mutants {
            killed: decision.killed.len(),
            of: decision.killed.len() + decision.survived.len(),
            survived: decision.survived.clone(),
        },
        readings: readings(row),
        undecided: undecided.map(|undecided| undecided.to_string()),
        seconds,
    })
}

/// Stores what refutes the clause of a row in `folder`: the place of the file.
pub(super) fn stored(
    row: &Row,
    folder: &Path,
    replaceable: &Replaceable,
    out: &mut Output,
) -> Result<Option<String>, Halt> {
    let Row { clause, number, check, ref decision, .. } = *row;
    let Some(evidence) = &decision.counterexample else { return Ok(None) };
    let path = refutation::path(folder, clause, number);
    let run = match &evidence.seen {
        Depiction::Robots(run) => evidence::setup(check, run)?.zip(evidence::breach(run)),
        Depiction::Choices | Depiction::Story(_) | Depiction::Agents(_) | Depiction::Messages { .. } => None,
    };
    let file = match run {
        Some((setup, breach)) => trace::store(&path, &setup, breach, replaceable)?.0,
        None => refutation::store(&path, clause, check, evidence, replaceable)?,
    };
    Ok(keep(file, out))
}

/// Stores the proof of a row in `folder`, or the certificate of what its search has exhausted.
fn certify((row, memory): (&Row, &MemoryLimit), folder: &Path, replaceable: &Replaceable, out: &mut Output) {
    let Row { clause, number, check, .. } = *row;
    let limits = states::Limits { memory: memory.memory(), ..states::Limits::NONE };
    let (path, content) = if let Some(terms) = check.certificate() {
        let name = format!("{}_{}", clause.id, check.rule()).replace('-', "_") + ".v";
        (folder.join(name), terms.map(String::into_bytes))
    } else {
        let path = refutation::path(folder, clause, number).with_extension("cert");
        (path, ledger::certificate(clause, number, limits))
    };
    match content {
        Err(why) => tracing::warn!("{} as {} gets no certificate: {why}", clause.id, check.rule()),
        Ok(content) => {
            let mut file = AtomicFile::late(&path, replaceable);
            file.append(content);
            keep(file, out);
        }
    }
}

/// The story of a counterexample, and where it is stored.
pub(super) fn story(row: &Row, file: Option<&str>) -> Result<String, Halt> {
    let Some(evidence) = &row.decision.counterexample else { return Ok(String::new()) };
    let story = evidence::story(row.clause, row.check, evidence)?;
    let file = file.map(|file| format!("\n{}", replay_line(file)));
    Ok(format!("\n{story}{}", file.unwrap_or_default()))
}

/// The variants that did not come out as they are registered.
fn of_variants(row: &Row) -> Vec<String> {
    let mutants = row.decision.survived.iter().map(|mutant| format!("the mutant {mutant:?} survives"));
    let others = readings(row).into_iter().filter(|reading| reading.verdict != reading.registered);
    let others = others.map(|ReadingLine { name, verdict, registered }| {
        format!("under the reading {name:?} {verdict}, registered as {registered}")
    });
    mutants.chain(others).collect()
}

/// The other readings of the rule of a row.
fn readings(row: &Row) -> Vec<ReadingLine> {
    let registered = row.check.variants().into_iter().filter_map(Variant::reading);
    let line = |((name, registered), answer): ((&'static str, Verdict), &Answer)| ReadingLine {
        name,
        verdict: answer.verdict.word(),
        registered: registered.word(),
    };
    registered.zip(&row.decision.readings).map(line).collect()
}

//! `tautline prove`: the clauses of SPEC.md, decided.

mod decided;
mod html;
mod row;
mod screen;

use std::io::{self, Write as _};
use std::num::NonZeroU32;
use std::path::{Path, PathBuf};
use std::str::FromStr;
use std::sync::Arc;
use std::time::Instant;

use clap::Args;
use tautline_io::atomic_file::{AtomicFile, Replaceable};
use tautline_io::diagnostic::{Diagnostic, Halt};
use tautline_proofs::clause::Clause;
use tautline_proofs::decide::Verdict;
use tautline_proofs::engine::states::MemoryLimit;
use tautline_proofs::ledger::{self, Indecision, Limits, PATIENCE_S, Row, table};
use tautline_proofs::plural::counted;

pub(super) use self::decided::DecidedRows;
pub(super) use self::row::{Ledger, stored, story};
use self::row::{certify, line};
use super::evidence::registered;
use super::exit::Exit;
use super::findings::{self, Format, FormatArgs};
use super::folder::{clear, make_folder};
use super::options::{ForceArgs, refuse_needless};
use super::output::Output;
use super::progress::{self, Shown};
use super::value_parser::positive;
use super::{interrupt, spill};

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
                Diagnostic::usage(format_args!("there is no clause {id:?}"), known_clauses(id))
            })
        };
        self.clauses.iter().map(find).collect()
    }
}

/// The clauses that one may have meant by an id that none has: those of its scheme, or else how ids are made.
fn known_clauses(id: &str) -> String {
    let asked = id.split('-').next().unwrap_or(id);
    let near = ledger::clauses().filter(|clause| clause.scheme().eq_ignore_ascii_case(asked));
    let near: Vec<&str> = near.map(|clause| clause.id).collect();
    if !near.is_empty() {
        return format!("the clauses of {} are {}", asked.to_ascii_uppercase(), near.join(", "));
    }
    let mut schemes: Vec<&str> = ledger::clauses().map(Clause::scheme).collect();
    schemes.dedup();
    format!("name one of {}, and its number, as CHAIN-1", schemes.join(", "))
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
            // Of nothing there is no table.
            (Format::Text, _) if rows.is_empty() && left > 0 => out.text(&unfinished)?,
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

//! `tautline minimise`: from a run that breaks a clause to one in which nothing can go.

use std::fmt::Write;
use std::path::PathBuf;

use clap::Args;
use schemars::JsonSchema;
use serde::Serialize;
use tautline_io::atomic_file::is_same;
use tautline_io::diagnostic::{Diagnostic, Halt};
use tautline_io::json_lines;
use tautline_proofs::decide::MethodError;
use tautline_proofs::engine::Choices;
use tautline_proofs::engine::states::{Limits, MemoryLimit};
use tautline_proofs::ledger::indented;
use tautline_proofs::plural::counted;

use super::catalogue::CATALOGUE;
use super::exit::Exit;
use super::explore::DrawnMoves;
use super::folder::{again, in_folder, keep};
use super::options::{ForceArgs, Format, FormatArgs};
use super::output::{Output, replay_line};
use super::replay::draw;
use super::{evidence, progress};
use tautline_sim::counterexample::minimise::{Extent, Failure, Minimal, minimise};
use tautline_sim::counterexample::refutation::{self, Refutation};
use tautline_sim::explore::{ClauseId, Report, RuleId, Scheme};
use tautline_sim::trace::{Trace, path_in, store};

const EXAMPLES: &str = "\
Examples:
  tautline minimise run.jsonl
  tautline minimise chain-1-published-n4.jsonl --out minimal
  tautline minimise run.jsonl --clause CHAIN-2 --format json";

/// Shrink a run that breaks a clause until nothing of it can go, and store what is left.
///
/// Of the minimal run no robot, column, row, blocked cell, wall or missed sensor can go: taken alone, without any one
/// of them the clause is not broken. It ends with the team move that breaks it. Where a search has chosen what happens
/// in which order, every smaller team and layout is searched. Of a run over states, as `library` stores it, a shortest
/// one from the same start is left, or it is said that this is not known.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct Minimise {
    /// A file that `explore --trace`, `hunt`, `prove --out` or `library --out` wrote.
    file: PathBuf,
    /// The clause that is to stay broken. Without it, the one that the file is a counterexample to, or else the first
    /// that the run breaks.
    #[arg(long, value_name = "CLAUSE")]
    clause: Option<String>,
    /// The folder for the minimal run.
    #[arg(long, value_name = "DIR", default_value = ".")]
    out: PathBuf,
    #[command(flatten)]
    force: ForceArgs,
    #[command(flatten)]
    format: FormatArgs,
}

#[derive(JsonSchema, Serialize)]
pub(super) struct MinimiseJson {
    scheme: Scheme,
    rule: RuleId,
    clause: ClauseId,
    before: Extent,
    after: Extent,
    /// Runs that were made to find it, or hunts, where a search has chosen what happens.
    runs: u32,
    #[serde(skip)]
    is_searched: bool,
    /// Whether sensors are missed by chance.
    #[serde(skip)]
    is_drawn: bool,
    /// Where it is stored, unless it was left out.
    file: Option<String>,
}

/// A run over states that was made shorter.
#[derive(JsonSchema, Serialize)]
pub(super) struct ShortenedJson {
    clause: &'static str,
    rule: &'static str,
    bound: String,
    before: RunLength,
    after: RunLength,
    /// Whether no run from the same start gets there sooner. Else that is not known: more states were led to than may
    /// be looked at, or the promise is broken by runs that go on for ever, too.
    shortest: bool,
    /// Where it is stored, unless it was left out.
    file: Option<String>,
}

/// The moves of a run over states.
#[derive(Clone, Copy, JsonSchema, Serialize)]
struct RunLength {
    moves: usize,
    /// Those that come again for ever.
    again: usize,
}

impl RunLength {
    /// The first choice is the start.
    fn of(Choices { once, again }: &Choices) -> Self {
        Self { moves: once.len().saturating_sub(1), again: again.len() }
    }
}

impl ShortenedJson {
    /// The words for people.
    fn told(&self, name: &str) -> String {
        let Self { clause, rule, bound, before, after, shortest, .. } = self;
        let why = if *shortest {
            "No run from the same start gets there sooner."
        } else {
            "Whether another run from the same start gets there sooner was not decided."
        };
        format!(
            "{clause} as {rule}: {name}\n{}\n               before   after\n\
             moves        {:>8}{:>8}\n\
             for ever     {:>8}{:>8}\n\n\
             {why}\n\n",
            indented(2, bound),
            before.moves,
            after.moves,
            before.again,
            after.again
        )
    }
}

/// Steps that are made to make a run over states shorter.
const MOST_STEPS: u64 = 20_000_000;

/// Memory that they may take.
const MOST_BYTES: u64 = 1 << 31;

impl Minimise {
    pub(super) fn run(&self, out: &mut Output) -> Result<Exit, Halt> {
        in_folder(&self.out, || self.minimise(out))
    }

    fn minimise(&self, out: &mut Output) -> Result<Exit, Halt> {
        let (setup, clause) = if json_lines::format(&self.file).as_deref() == Some(refutation::FORMAT) {
            let found = evidence::read(&self.file)?;
            match evidence::run(found.clause, found.check, &found.evidence)? {
                Some(setup) => {
                    let own = || CATALOGUE.clause(found.clause.id);
                    (setup, Some(self.clause()?.map_or_else(own, Ok)?))
                }
                None => return self.shorten(&found, out),
            }
        } else {
            let named = self.clause()?;
            let trace = Trace::open(&self.file, CATALOGUE)?;
            let run = (trace.setup.clone(), named.or(trace.clause));
            trace.replay(&mut |_| Ok(()))?;
            run
        };
        let bar = progress::spinner("minimising");
        let mut shown = None;
        let minimal = minimise(&setup, clause, &mut |progress| {
            if shown.replace(progress.runs) != Some(progress.runs) {
                let Extent { robots, columns, rows, walls, blocked, .. } = progress.smallest;
                bar.set_message(format!(
                    "run {}; robots {robots}, cells {columns}x{rows}, walls {walls}, blocked cells {blocked}",
                    progress.runs
                ));
            }
            Ok(())
        });
        bar.finish_and_clear();
        let minimal = minimal.map_err(|failure| match failure {
            Failure::Refused(refused) => Diagnostic::in_file(&self.file, &refused, refused.remedy()).into(),
            Failure::Halted(halt) => halt,
        })?;
        tracing::info!("minimised in {}", counted(minimal.runs, "run"));
        let (minimised, report) = self.store(&minimal, out)?;
        match self.format.format {
            Format::Json => out.json(&minimised)?,
            Format::Text => {
                out.text(tell(&self.file.display().to_string(), &minimised))?;
                draw(&minimal.setup, &report, &DrawnMoves::Last(1..=report.steps), out)?;
                if let Some(file) = &minimised.file {
                    out.text(format_args!("\n{}", again(file, &minimal.setup)))?;
                }
            }
        }
        Ok(Exit::Expected)
    }

    /// The clause that is to stay broken, if one is named: one that a run of a team can break.
    fn clause(&self) -> Result<Option<ClauseId>, Diagnostic> {
        self.clause.as_ref().map(|id| CATALOGUE.clause(&id.to_ascii_uppercase())).transpose()
    }

    /// Where a minimal run stands that is not to take the place of the file that it is made from.
    fn beside(&self) -> PathBuf {
        let stem = self.file.file_stem().unwrap_or_default().to_string_lossy();
        self.out.join(format!("{stem}-minimal.jsonl"))
    }

    /// Looks for a shorter run over states from where this one starts.
    fn shorten(&self, found: &Refutation<'_>, out: &mut Output) -> Result<Exit, Halt> {
        let &Refutation { clause, check, ref evidence } = found;
        if let Some(other) = self.clause.as_ref().filter(|asked| !asked.eq_ignore_ascii_case(clause.id)) {
            let what = format!("this is a counterexample to {}, not to {other}", clause.id);
            return Err(Diagnostic::in_file(&self.file, what, "leave --clause out").into());
        }
        let memory = MemoryLimit::of(MOST_BYTES, 1);
        let limits = Limits { memory: memory.memory(), ..Limits::steps(MOST_STEPS) };
        let bar = progress::spinner("minimising");
        let shorter = check.shorten(&evidence.choices, limits);
        bar.finish_and_clear();
        let refused =
            |why: MethodError| Diagnostic::in_file(&self.file, why, "draw it with `tautline replay`");
        let Some((choices, shortest)) = shorter.map_err(refused)? else {
            return Err(evidence::no_run(&self.file).into());
        };
        let played = check.replay(&choices).map_err(|unfit| refused(MethodError::new(unfit)))?;
        let replaceable = self.force.replaceable([self.file.clone()]);
        let stored = refutation::store(&self.beside(), clause, check, &played.evidence, &replaceable)?;
        let minimised = ShortenedJson {
            clause: clause.id,
            rule: check.rule(),
            bound: check.bound(),
            before: RunLength::of(&evidence.choices),
            after: RunLength::of(&choices),
            shortest,
            file: keep(stored, out),
        };
        match self.format.format {
            Format::Json => out.json(&minimised)?,
            Format::Text => {
                let story = evidence::story(clause, check, &played.evidence)?;
                out.text(minimised.told(&self.file.display().to_string()) + &story)?;
                if let Some(file) = &minimised.file {
                    out.text(format_args!("\n{}", replay_line(file)))?;
                }
            }
        }
        Ok(Exit::Expected)
    }

    fn store(&self, minimal: &Minimal, out: &mut Output) -> Result<(MinimiseJson, Report), Halt> {
        let Minimal { setup, clause, before, after, runs } = minimal;
        let replaceable = self.force.replaceable([self.file.clone()]);
        let usual = path_in(&self.out, setup, *clause);
        let path = if is_same(&usual, &self.file) { self.beside() } else { usual };
        let (file, report) = store(&path, setup, *clause, &replaceable)?;
        let minimised = MinimiseJson {
            scheme: setup.scheme,
            rule: setup.rule,
            clause: *clause,
            before: *before,
            after: *after,
            runs: *runs,
            is_searched: !setup.choices.is_empty(),
            is_drawn: !setup.miss.is_never(),
            file: keep(file, out),
        };
        Ok((minimised, report))
    }
}

fn tell(name: &str, minimised: &MinimiseJson) -> String {
    let MinimiseJson { scheme, rule, clause, before, after, runs, .. } = minimised;
    let mut text = format!("{} ({rule}), {clause}: {name}\n\n               before   after\n", scheme.name);
    let rows = [
        ("robots", before.robots.to_string(), after.robots.to_string()),
        ("columns", before.columns.to_string(), after.columns.to_string()),
        ("rows", before.rows.to_string(), after.rows.to_string()),
        ("blocked cells", before.blocked.to_string(), after.blocked.to_string()),
        ("walls", before.walls.to_string(), after.walls.to_string()),
        ("missed", before.missed.to_string(), after.missed.to_string()),
        ("team moves", before.steps.to_string(), after.steps.to_string()),
    ];
    let rows = rows.into_iter().filter(|(what, ..)| *what != "missed" || before.missed + after.missed > 0);
    for (what, before, after) in rows {
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{what:13}{before:>8}{after:>8}");
    }
    let parts = "No robot, column, row, blocked cell or wall";
    let _ = if minimised.is_searched {
        writeln!(
            text,
            "\n{parts} can go: no smaller team and layout breaks {clause}, whatever happens in which order ({}).",
            counted(*runs, "hunt")
        )
    } else {
        let sensor = if before.missed + after.missed > 0 { ", and no missed sensor" } else { "" };
        writeln!(
            text,
            "\n{parts}{sensor} can go: without any one of them {clause} is not broken ({} tried).",
            counted(*runs, "run")
        )
    };
    if minimised.is_drawn {
        text +=
            "Sensors that are missed by chance are not parts: each run draws them anew by the same seed.\n";
    }
    if after.steps > before.steps {
        text +=
            "It takes more team moves than before: a run with fewer parts is smaller, however long it is.\n";
    }
    text
}

//! `tautline hunt`: all layouts within a bound, until something breaks.

use std::fmt::Write;
use std::path::{Path, PathBuf};

use clap::Args;
use serde::Serialize;
use tautline_proofs::clause::Verdict;
use tautline_proofs::search::{Bounds, Found, search};

use super::output::Output;
use super::{Exit, Format, FormatArgs, SizeArg, number, progress};
use crate::explore::{RuleName, SchemeName, Setup};
use crate::fault::{Fault, Halt};
use crate::{hunt, view};

const EXAMPLES: &str = "\
Examples:
  tautline hunt --rule published --robots 4 --max-walls 4 --out counterexamples
  tautline hunt --rule repaired --robots 4 --max-walls 4 --format json
  tautline hunt --robots 5 --max-walls 8 --budget 100000000";

/// Search all layouts with few walls for runs that break a clause, and store the smallest.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct Hunt {
    /// How the team explores.
    #[arg(long, value_enum, default_value = "chain")]
    scheme: SchemeName,
    /// The scheme as published, or repaired.
    #[arg(long, value_enum, default_value = "repaired")]
    rule: RuleName,
    /// Robots, the base counted.
    #[arg(long, value_name = "N", default_value = "4", value_parser = number::<u64>)]
    robots: u64,
    /// Most walls that are met in one run; the border is not counted.
    #[arg(long, value_name = "K", default_value = "4", value_parser = number::<u32>)]
    max_walls: u32,
    /// Columns and rows of the layouts, the base in the middle; without it the (2N−1)x(2N−1) cells in reach.
    #[arg(long, value_name = "WxH")]
    size: Option<SizeArg>,
    /// End after so many team moves.
    #[arg(long, value_name = "MOVES", value_parser = number::<u64>)]
    budget: Option<u64>,
    /// The folder for the counterexamples.
    #[arg(long, value_name = "DIR", default_value = ".")]
    out: PathBuf,
    #[command(flatten)]
    format: FormatArgs,
}

#[derive(Serialize)]
struct Hunted {
    scheme: SchemeName,
    rule: RuleName,
    robots: u64,
    runs: u64,
    moves: u64,
    max_walls: u32,
    /// Whether every layout within the bound was covered.
    complete: bool,
    verdict: &'static str,
    counterexamples: Vec<Stored>,
}

#[derive(Serialize)]
struct Stored {
    clause: &'static str,
    walls: usize,
    steps: u32,
    file: String,
    #[serde(skip)]
    setup: Setup,
}

impl Hunt {
    pub(super) fn run(&self, out: &mut Output) -> Result<Exit, Halt> {
        match self.scheme {
            SchemeName::Chain => {}
        }
        check_folder(&self.out)?;
        let mut bounds =
            hunt::bounds(self.rule, self.robots, self.max_walls, self.size.map(|SizeArg(size)| size))?;
        bounds.budget_moves = self.budget;
        let bar = progress::bar("hunting", 1);
        let found = search(&bounds, &|progress| progress::show(&bar, progress))
            .map_err(|refused| Fault::usage(refused, "give fewer --robots or a larger --size"))?;
        bar.finish_and_clear();
        let hunted = self.store(&bounds, &found)?;
        match self.format.format {
            Format::Json => out.json(&hunted)?,
            Format::Text => out.text(tell(&hunted)?)?,
        }
        Ok(if !found.counterexamples.is_empty() {
            Exit::Violation
        } else if found.complete {
            Exit::Expected
        } else {
            Exit::Unfinished
        })
    }

    fn store(&self, bounds: &Bounds, found: &Found) -> Result<Hunted, Halt> {
        let counterexamples = found.counterexamples.iter().filter_map(|counterexample| {
            hunt::breach(counterexample.invariant).map(|breach| {
                let setup = hunt::setup(self.rule, bounds, counterexample)
                    .map_err(|problem| super::usage(&problem))?;
                let (path, report) = hunt::store(&self.out, &setup, breach)?;
                let walls = counterexample.walls.len();
                Ok(Stored { clause: breach.clause(), walls, steps: report.steps, file: shown(&path), setup })
            })
        });
        let counterexamples = counterexamples.collect::<Result<Vec<Stored>, Halt>>()?;
        let verdict = match (counterexamples.is_empty(), found.complete) {
            (false, _) => Verdict::Refuted,
            (true, true) => Verdict::Holds,
            (true, false) => Verdict::Open,
        };
        Ok(Hunted {
            scheme: self.scheme,
            rule: self.rule,
            robots: self.robots,
            runs: found.runs,
            moves: found.moves,
            max_walls: self.max_walls,
            complete: found.complete,
            verdict: verdict.word(),
            counterexamples,
        })
    }
}

/// Checks that --out names a folder.
pub(super) fn check_folder(out: &Path) -> Result<(), Fault> {
    if out.is_dir() {
        return Ok(());
    }
    let what = if out.exists() { "this is no folder" } else { "there is no such folder" };
    Err(Fault::in_file(out, what, "give --out a folder that is there"))
}

/// The path as one would type it.
pub(super) fn shown(path: &Path) -> String {
    path.strip_prefix(".").unwrap_or(path).display().to_string()
}

fn tell(hunted: &Hunted) -> Result<String, Halt> {
    let Hunted { scheme, rule, robots, runs, moves, max_walls, complete, counterexamples, verdict: _ } =
        hunted;
    let mut text = format!(
        "{} ({rule}), {robots} robots, at most {max_walls} walls: {runs} runs, {moves} team moves\n",
        scheme.word()
    );
    text.push_str(match (counterexamples.is_empty(), complete) {
        (true, true) => "No clause is broken in any layout within this bound.\n",
        (true, false) => "The hunt was ended before its bound: nothing is claimed.\n",
        (false, true) => "The smallest counterexample to each clause that is broken:\n",
        (false, false) => "The hunt was ended before its bound; counterexamples so far:\n",
    });
    for stored in counterexamples {
        let story = view::story::last_move(&stored.setup)?;
        // Writing to a string cannot fail.
        let _ = writeln!(
            text,
            "\n{}, {} walls, {} team moves\n\n{story}\nreplay it with: tautline replay {}",
            stored.clause, stored.walls, stored.steps, stored.file
        );
    }
    Ok(text)
}

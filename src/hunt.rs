//! `tautline hunt`: all layouts within a bound, until something breaks.

mod trap;

use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use clap::Args;
use serde::Serialize;
use tautline_proofs::chain::Observed;
use tautline_proofs::chain::search::{Bounds, Found};
use tautline_proofs::decide::Verdict;
use tautline_proofs::engine::tree::Progress;
use tautline_proofs::words::counted;

use super::output::Output;
use super::{Exit, ForceArgs, Format, FormatArgs, SizeArg, interrupt, number, progress, whole};
use crate::{chosen, report};
use tautline_sim::aside::Aside;
use tautline_sim::counterexample::hunt;
use tautline_sim::counterexample::hunt::Saved;
use tautline_sim::draw;
use tautline_sim::explore::{Misfit, Profile, Quarry, RuleId, Setup};
use tautline_sim::fault::{Fault, Halt};

/// How often a hunt is kept in its file.
const KEEP_EVERY: Duration = Duration::from_secs(5);

/// Robots of a chain when nobody says how many.
const DEFAULT_ROBOTS: u64 = 4;

/// Walls when nobody says how many.
const DEFAULT_WALLS: u32 = 4;

const EXAMPLES: &str = "\
Examples:
  tautline hunt --rule published --robots 4 --max-walls 4 --out counterexamples
  tautline hunt --rule repaired --robots 4 --max-walls 4 --format json
  tautline hunt --robots 5 --max-walls 8 --budget 100000000 --resume hunt.json
  tautline hunt --scheme bricks --max-misses 2
  tautline hunt --scheme bricks-ants --max-misses 2 --size 3x3";

/// Search all layouts with few walls for runs that break a clause, and store the smallest.
///
/// Of agents on a sensor floor, search all layouts with few cells for the fewest missed sensors that trap them: one of
/// them is done, or all go round for ever, before every cell is explored.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct Hunt {
    /// How the team explores.
    #[arg(long, value_parser = chosen::scheme(), default_value = "chain")]
    scheme: &'static Profile,
    /// The scheme as published, or repaired.
    #[arg(long, value_parser = chosen::rule(), default_value = "repaired")]
    rule: RuleId,
    /// Robots: 4 in a chain, the base counted, or 1 agent, unless this says otherwise. Agents act in turn here; `prove`
    /// looks at every order.
    #[arg(long, value_name = "N", value_parser = whole::<u64>)]
    robots: Option<u64>,
    /// Most walls that a chain meets in one run, 4 unless this says otherwise; the border is not counted.
    #[arg(long, value_name = "K", value_parser = whole::<u32>)]
    max_walls: Option<u32>,
    /// Most sensors that agents miss in one run, 1 unless this says otherwise.
    #[arg(long, value_name = "K", value_parser = number::<u8>)]
    max_misses: Option<u8>,
    /// Columns and rows of a chain's layouts, the base in the middle; without it the (2N−1)x(2N−1) cells in reach. Of
    /// agents' layouts the most columns and rows, 4x4 without it; at most 16 cells.
    #[arg(long, value_name = "WxH")]
    size: Option<SizeArg>,
    /// End after so many team moves.
    #[arg(long, value_name = "MOVES", value_parser = number::<u64>)]
    budget: Option<u64>,
    /// Keep the hunt in FILE while it goes on; if FILE is there, go on from it, also with more walls.
    #[arg(long, value_name = "FILE")]
    resume: Option<PathBuf>,
    /// The folder for the counterexamples.
    #[arg(long, value_name = "DIR", default_value = ".")]
    out: PathBuf,
    #[command(flatten)]
    force: ForceArgs,
    #[command(flatten)]
    format: FormatArgs,
}

#[derive(Serialize)]
struct Hunted {
    scheme: &'static Profile,
    rule: RuleId,
    robots: u64,
    runs: u64,
    moves: u64,
    /// Team moves of the longest run.
    longest: u32,
    max_walls: u32,
    /// Whether every layout within the bound was covered.
    complete: bool,
    /// The most walls up to which every layout was covered.
    walls_done: Option<u32>,
    verdict: &'static str,
    /// Where the hunt is kept, if that was asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    kept: Option<String>,
    counterexamples: Vec<Stored>,
}

#[derive(Serialize)]
struct Stored {
    clause: &'static str,
    /// Runs that break it.
    runs: u64,
    walls: usize,
    steps: usize,
    /// Where the smallest is stored; a run without end is not, nor one that was left out.
    file: Option<String>,
    #[serde(skip)]
    is_endless: bool,
    #[serde(skip)]
    setup: Setup,
}

impl Hunt {
    pub(super) fn run(&self, out: &mut Output) -> Result<Exit, Halt> {
        let rule = self
            .scheme
            .rule(self.rule)
            .ok_or(Misfit::Rule { scheme: self.scheme, rule: self.rule })
            .map_err(Fault::from)?;
        match rule.hunt {
            Some(Quarry::Walls(subject)) => self.run_walls(subject, out),
            Some(Quarry::Traps(way)) => trap::run(self, way, out),
            None => {
                let what = format!("nothing is hunted of {}", self.scheme.name);
                Err(Fault::usage(what, "hunt another scheme").into())
            }
        }
    }

    fn run_walls(&self, subject: Observed, out: &mut Output) -> Result<Exit, Halt> {
        if self.max_misses.is_some() {
            let what = "the robots of a chain have no floor sensors to miss";
            return Err(
                Fault::usage(what, "give --max-walls, or --scheme ants, bricks or bricks-ants").into()
            );
        }
        check_folder(&self.out)?;
        let (robots, walls) =
            (self.robots.unwrap_or(DEFAULT_ROBOTS), self.max_walls.unwrap_or(DEFAULT_WALLS));
        let mut bounds = hunt::bounds(subject, robots, walls, self.size.map(|SizeArg(size)| size))?;
        bounds.budget_moves = self.budget;
        let found = self.search(&bounds, out)?;
        let hunted = self.store(&bounds, &found, out)?;
        match self.format.format {
            Format::Json => out.json(&hunted)?,
            Format::Text => out.text(tell(&hunted)?)?,
        }
        Ok(match (found.complete, found.counterexamples.is_empty()) {
            (false, _) => Exit::Unfinished,
            (true, false) => Exit::Violation,
            (true, true) => Exit::Expected,
        })
    }

    fn search(&self, bounds: &Bounds, out: &mut Output) -> Result<Found, Fault> {
        let mut saved = self.resume.as_deref().map(|path| Saved::new(path, self.scheme, self.rule, bounds));
        let mut search = match &mut saved {
            Some(saved) => saved.search(bounds)?,
            None => hunt::start(bounds)?,
        };
        // What cannot be kept is refused before it has cost anything.
        if let Some(saved) = &mut saved {
            saved.write(&search)?;
        }
        interrupt::defer();
        let bar = progress::bar("hunting", 1);
        let start = Instant::now();
        let mut written = start;
        while progress::show(&bar, &search.progress()).is_continue() && search.wave() {
            if let Some(saved) = saved.as_mut().filter(|_| written.elapsed() > KEEP_EVERY) {
                // There may be room again later on; the last good one stands there until then.
                if let Err(fault) = saved.write(&search) {
                    tracing::warn!("{}", report::with_flags(&fault.to_string()));
                }
                written = Instant::now();
            }
        }
        bar.finish_and_clear();
        let Progress { runs, moves, .. } = search.progress();
        let (runs, moves) = (counted(runs, "run"), counted(moves, "team move"));
        tracing::info!("hunted through {runs} and {moves} in {:.3} s", start.elapsed().as_secs_f64());
        if let Some(Err(fault)) = saved.as_mut().map(|saved| saved.write(&search)) {
            out.leave_out(&fault);
        }
        Ok(search.found())
    }

    fn store(&self, bounds: &Bounds, found: &Found, out: &mut Output) -> Result<Hunted, Halt> {
        let replaceable = self.force.replaceable(self.resume.clone());
        let counterexamples = found.counterexamples.iter().map(|counterexample| {
            let run = bounds.run(counterexample);
            let setup = hunt::setup(self.scheme, self.rule, &run).map_err(Fault::from)?;
            let clause = counterexample.broken.breach().map(tautline_sim::explore::ClauseId::from);
            let file = match clause {
                Some(clause) => keep(hunt::store(&self.out, &setup, clause, &replaceable)?.0, out),
                None => None,
            };
            Ok(Stored {
                clause: counterexample.broken.clause(),
                runs: counterexample.runs,
                walls: run.walls.len(),
                steps: counterexample.frames.len(),
                file,
                is_endless: clause.is_none(),
                setup,
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
            robots: bounds.robots as u64,
            runs: found.runs,
            moves: found.moves,
            longest: found.longest,
            max_walls: bounds.max_walls,
            complete: found.complete,
            walls_done: (found.levels.len() as u32).checked_sub(1),
            verdict: verdict.word(),
            kept: self.resume.as_deref().map(shown),
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

/// Puts the file of a counterexample in its place; where it stands then.
pub(super) fn keep(file: Aside, out: &mut Output) -> Option<String> {
    let path = file.path().to_owned();
    out.keep(file).then(|| shown(&path))
}

/// The path as one would type it.
pub(super) fn shown(path: &Path) -> String {
    path.strip_prefix(".").unwrap_or(path).display().to_string()
}

fn tell(hunted: &Hunted) -> Result<String, Halt> {
    let Hunted {
        scheme,
        rule,
        robots,
        runs,
        moves,
        longest,
        max_walls,
        walls_done,
        kept,
        counterexamples,
        ..
    } = hunted;
    let mut text = format!(
        "{} ({rule}), {}, at most {}: {}, {}, {longest} the longest\n",
        scheme.name,
        counted(*robots, "robot"),
        counted(*max_walls, "wall"),
        counted(*runs, "run"),
        counted(*moves, "team move")
    );
    let bound = match walls_done {
        Some(walls) if *walls == *max_walls => "in any layout within this bound".to_owned(),
        Some(walls) => {
            let walls = counted(*walls, "wall");
            format!("in any layout with at most {walls}; the hunt was ended before its bound")
        }
        None => "so far; the hunt was ended before it had covered any layout".to_owned(),
    };
    // Writing to a string cannot fail.
    let _ = match counterexamples[..] {
        [] => writeln!(text, "No clause is broken {bound}."),
        _ => writeln!(text, "The smallest counterexample to each clause that is broken {bound}:"),
    };
    for Stored { clause, runs, walls, steps, file, is_endless, setup } in counterexamples {
        let (walls, steps) = (counted(*walls, "wall"), counted(*steps, "team move"));
        let _ = writeln!(text, "\n{clause}, {walls}, {steps}; broken in {}", counted(*runs, "run"));
        let _ = match is_endless {
            false => writeln!(text, "\n{}", draw::story::last_move(setup)?),
            true => writeln!(text, "\nA run without end in this layout:\n\n{}", setup.layout),
        };
        if let Some(file) = file {
            let _ = writeln!(text, "replay it with: tautline replay {file}");
        }
    }
    if let Some(kept) = kept {
        let _ = writeln!(text, "The hunt is kept in {kept}.");
    }
    Ok(text)
}

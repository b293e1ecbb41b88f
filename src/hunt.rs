//! `tautline hunt`: all layouts within a bound, until something breaks.

use std::fmt::Write;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::time::Instant;

use clap::Args;
use indicatif::ProgressBar;
use schemars::JsonSchema;
use serde::Serialize;
use tautline_io::atomic_file::Replaceable;
use tautline_io::diagnostic::{Diagnostic, Halt};
use tautline_io::shards::Plan;
use tautline_io::value_parser::{number, real, whole};
use tautline_proofs::decide::Verdict;

use super::catalogue::CATALOGUE;
use super::exit::Exit;
use super::findings::{self, Case, Format, FormatArgs, Outcome};
use super::folder::{again, clear, keep, make_folder, shown};
use super::options::ForceArgs;
use super::output::{Output, replay_line};
use super::shards::{self, Scope};
use super::value_parser::{self, SizeArg};
use super::{interrupt, progress};
use tautline_sim::draw::story;
use tautline_sim::explore::hunt::{
    CoveredBound, Exhibit, Facts, Far, Finding, HuntBounds, HuntReport, HuntRequest, Hunter, RunSize,
};
use tautline_sim::explore::{RuleId, Scheme, Senses};
use tautline_sim::shards::{deal_hunt, hunt_part, hunted};
use tautline_sim::trace::{path_in, store};

const EXAMPLES: &str = "\
Examples:
  tautline hunt --rule published --robots 4 --max-walls 4 --out counterexamples
  tautline hunt --rule repaired --robots 4 --max-walls 4 --format json
  tautline hunt --robots 5 --max-walls 8 --budget 100000000 --resume hunt.json
  tautline hunt --rule published --robots 4 --max-cells 12 --max-walls 3
  tautline hunt --robots 5 --max-walls 4 --plan plan.json --shards 64
  tautline hunt --plan plan.json --shard 1
  tautline hunt --scheme bricks --max-misses 2
  tautline hunt --scheme bricks-ants --max-misses 2 --size 3x3
  tautline hunt --scheme frontier --rule published --robots 2 --size 3x1
  tautline hunt --scheme frontier --robots 2 --size 3x3 --max-losses 1
  tautline hunt --scheme kit --rule published --size 5x1
  tautline hunt --scheme kit --robots 2 --size 3x2 --max-walls 4
  tautline hunt --scheme kit --robots 2 --size 5x1 --range 4";

/// Search all layouts of an area with few walls for runs that break a clause, and store the smallest of each.
///
/// Of agents on a sensor floor, search all layouts with few cells for the fewest missed sensors that trap them: one of
/// them is done, or all go round for ever, before every cell is explored.
///
/// Of `kit`, search all walls, starts and orders on small lattices for runs in which robots lose contact, come too
/// near, wait for each other for ever, or leave a path out. Of `frontier`, search all obstacles, starts and orders in
/// small areas for runs in which robots come into one cell, leave cells unexplored, or go on for ever.
///
/// A run without end is stored up to where it comes back to where it was; of a chain it is told, and not stored.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct Hunt {
    /// How the team explores.
    #[arg(long, value_parser = value_parser::hunted_scheme(), default_value = "chain")]
    scheme: Scheme,
    /// One of the scheme's rules, which `tautline schemes` lists. Without it the repaired one, if there is one.
    #[arg(long, value_parser = value_parser::rule(), hide_possible_values = true)]
    rule: Option<RuleId>,
    /// Robots: 4 in a chain, the base counted, or 1 agent, unless this says otherwise. Agents act in turn here; `prove`
    /// looks at every order.
    #[arg(long, value_name = "N", value_parser = whole::<u64>)]
    robots: Option<u64>,
    /// Most walls that a chain meets in one run, 4 unless this says otherwise; the border is not counted.
    #[arg(long, value_name = "K", value_parser = whole::<u32>)]
    max_walls: Option<u32>,
    /// Search all areas of at most K cells, whatever their columns and rows, with a chain's base in each of their
    /// cells: fewest cells first, then fewest walls, then fewest team moves, each clause by itself.
    #[arg(long, value_name = "K", value_parser = whole::<u32>, conflicts_with = "size")]
    max_cells: Option<u32>,
    /// Most sensors that agents miss in one run, 1 unless this says otherwise.
    #[arg(long, value_name = "K", value_parser = number::<u8>)]
    max_misses: Option<u8>,
    /// Most messages that are lost in one run of robots that explore cells, 0 unless this says otherwise.
    #[arg(long, value_name = "K", value_parser = number::<u8>)]
    max_losses: Option<u8>,
    /// How far fixes of robots that explore cells are off, in cells: 0 unless this says otherwise; a number of
    /// sixteenths for each fix of one robot; or 1 for one fix of a run.
    #[arg(long, value_name = "CELLS", value_parser = real)]
    error: Option<f64>,
    /// How many cells far robots that keep in touch hear each other, 2 to 5. Without it 10 m, and a cell is 3 m wide.
    #[arg(long, value_name = "CELLS", value_parser = whole::<u16>)]
    range: Option<u16>,
    /// Columns and rows of a chain's layouts, the base in the middle; without it the (2N−1)x(2N−1) cells in reach. Of
    /// agents' layouts the most columns and rows, 4x4 without it; at most 16 cells.
    #[arg(long, value_name = "WxH", allow_hyphen_values = true)]
    size: Option<SizeArg>,
    /// End after so many team moves of this call; what is kept goes on with the next one.
    #[arg(long, value_name = "MOVES", value_parser = number::<u64>)]
    budget: Option<u64>,
    /// Keep the hunt in FILE while it goes on; if FILE is there, go on from it, also with more walls.
    #[arg(long, value_name = "FILE")]
    resume: Option<PathBuf>,
    /// The plan: with --shards it is stored in FILE, with --shard it is read from there.
    #[arg(long, value_name = "FILE")]
    plan: Option<PathBuf>,
    /// Do nothing yet, but deal the work out among N shards, each to be run on any machine.
    #[arg(long, value_name = "N", value_parser = whole::<u32>, requires = "plan")]
    #[arg(conflicts_with_all = ["shard", "resume", "budget", "out"])]
    shards: Option<u32>,
    /// Run shard K of the plan, from 1 on, and keep how far it is beside the plan; if it was begun, go on.
    #[arg(long, value_name = "K", value_parser = whole::<u32>, requires = "plan")]
    #[arg(conflicts_with_all = ["scheme", "rule", "robots", "max_walls", "max_cells"])]
    #[arg(conflicts_with_all = ["max_misses", "max_losses", "error", "range", "size"])]
    #[arg(conflicts_with_all = ["resume", "out", "force"])]
    shard: Option<u32>,
    /// The folder for the counterexamples.
    #[arg(long, value_name = "DIR", default_value = ".")]
    out: PathBuf,
    #[command(flatten)]
    force: ForceArgs,
    #[command(flatten)]
    format: FormatArgs,
}

/// The outcome of a hunt, and where its counterexamples stand.
struct Answer<'a> {
    asked: &'a HuntRequest<'a>,
    hunted: &'a HuntReport,
    verdict: Verdict,
    /// The file of each; none for a run that no file tells, nor for one that was left out.
    files: Vec<Option<String>>,
}

/// The JSON of a hunt.
#[derive(JsonSchema, Serialize)]
pub(super) struct HuntJson<'a> {
    scheme: Scheme,
    rule: RuleId,
    robots: u64,
    /// The clauses that were looked for: one that is not among them may be broken all the same.
    looked_for: &'a [&'static str],
    #[serde(flatten)]
    facts: &'a Facts,
    complete: bool,
    #[serde(flatten)]
    done: CoveredBound,
    verdict: &'static str,
    /// Where the hunt is kept.
    #[serde(skip_serializing_if = "Option::is_none")]
    kept: Option<String>,
    /// The clauses whose run with the fewest walls was still looked for when the hunt was ended. Of a run that goes
    /// round none may be found then.
    #[serde(skip_serializing_if = "<[_]>::is_empty")]
    not_minimised: &'a [&'static str],
    counterexamples: Vec<CounterexampleJson<'a>>,
}

/// A counterexample, and where it stands.
#[derive(JsonSchema, Serialize)]
struct CounterexampleJson<'a> {
    clause: &'static str,
    #[serde(flatten)]
    size: RunSize,
    file: &'a Option<String>,
}

/// Whoever watches a hunt at a terminal.
struct Watcher<'a> {
    bar: ProgressBar,
    spinner: ProgressBar,
    out: &'a mut Output,
}

impl Hunter for Watcher<'_> {
    fn hears(&mut self, far: Far<'_>) -> ControlFlow<()> {
        match far {
            Far::Tree(progress) => progress::show(&self.bar, progress),
            Far::Words(words) => {
                self.spinner.set_message(words);
                if interrupt::is_requested() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
            }
        }
    }

    fn is_left_out(&mut self, fault: &Diagnostic) {
        self.out.leave_out(fault);
    }
}

impl Hunt {
    pub(super) fn run(&self, out: &mut Output) -> Result<Exit, Halt> {
        match Scope::of(self.plan.as_deref(), self.shards, self.shard)? {
            Scope::All => self.hunt(out),
            Scope::Plan(path, shards) => self.plan(path, shards, out),
            Scope::Shard(path, shard) => {
                let (plan, format) = (Plan::read(path)?, self.format.format.plain()?);
                shards::run(&plan, shard, format, out, |far| {
                    let asked = HuntRequest { budget: self.budget, ..hunted(&plan, CATALOGUE)? };
                    Ok(hunt_part(&plan, &asked, shard, far)?)
                })
            }
        }
    }

    /// Deals the hunt out among shards.
    fn plan(&self, path: &Path, shards: u32, out: &mut Output) -> Result<Exit, Halt> {
        let asked = self.asked();
        Plan::check(shards)?;
        let (of, dealt) = deal_hunt(&asked, shards)?;
        let facts = PlanFacts { moves: dealt.moves, of: dealt.of, left: &dealt.left };
        let words = dealt.to_string();
        shards::plan(
            (path, shards),
            (of, &dealt.deal),
            (&facts, &words),
            (&self.force, self.format.format.plain()?),
            out,
        )
    }

    fn hunt(&self, out: &mut Output) -> Result<Exit, Halt> {
        let hunt = self.scheme.hunt(self.rule())?;
        let asked = self.asked();
        asked.check(hunt)?;
        interrupt::defer();
        let start = Instant::now();
        let (bar, spinner) = (progress::bar("hunting", 1), progress::spinner("hunting"));
        let mut watcher = Watcher { bar, spinner, out: &mut *out };
        let new = make_folder(&self.out)?;
        let hunted = hunt.hunt(&asked, &mut watcher).inspect_err(|_| clear(&new))?;
        watcher.bar.finish_and_clear();
        watcher.spinner.finish_and_clear();
        tracing::info!("hunted through {} in {:.3} s", hunted.through, start.elapsed().as_secs_f64());
        let replaceable = self.force.replaceable(self.resume.clone());
        let is_kept = !out.has_left_out();
        let asked = HuntRequest { resume: asked.resume.filter(|_| is_kept), ..asked };
        let told = tell((&asked, &hunted), (&self.out, &replaceable), self.format.format, out);
        if told == Ok(Exit::Unfinished) {
            clear(&new);
        }
        told
    }

    fn rule(&self) -> RuleId {
        self.rule.unwrap_or_else(|| self.scheme.default_rule())
    }

    fn asked(&self) -> HuntRequest<'_> {
        HuntRequest {
            scheme: self.scheme,
            rule: self.rule(),
            bounds: HuntBounds {
                robots: self.robots,
                size: self.size.map(|SizeArg(size)| size),
                max_walls: self.max_walls,
                max_cells: self.max_cells,
                max_misses: self.max_misses,
                max_losses: self.max_losses,
                error_cells: self.error,
                range_cells: self.range,
                equal_speeds: false,
            },
            budget: self.budget,
            resume: self.resume.as_deref(),
        }
    }
}

/// Stores the counterexamples of a hunt in `folder`, and tells what came of it.
///
/// # Errors
/// [`Halt`] if a counterexample is no run, or nothing can be printed.
pub(super) fn tell(
    (asked, hunted): (&HuntRequest<'_>, &HuntReport),
    (folder, replaceable): (&Path, &Replaceable),
    format: Format,
    out: &mut Output,
) -> Result<Exit, Halt> {
    let store = |finding: &Finding| stored(finding, folder, replaceable, out);
    let files = hunted.found.iter().map(store).collect::<Result<_, _>>()?;
    let (verdict, exit) = match (hunted.found.is_empty(), hunted.is_complete) {
        (false, true) => (Verdict::Refuted, Exit::Violation),
        (false, false) => (Verdict::Refuted, Exit::Unfinished),
        (true, true) => (Verdict::Holds, Exit::Expected),
        (true, false) => (Verdict::Open, Exit::Unfinished),
    };
    let told = Answer { asked, hunted, verdict, files };
    match format {
        Format::Json => out.json(&told.printed())?,
        Format::Text => out.text(told.text()?)?,
        Format::Github => out.text(findings::github(&told.findings()?, &told.headline()))?,
        Format::Junit => out.text(findings::junit("hunt", &told.findings()?))?,
    }
    Ok(exit)
}

/// Stores a counterexample in `folder`, if it is one that a file tells; where it stands then.
fn stored(
    finding: &Finding,
    folder: &Path,
    replaceable: &Replaceable,
    out: &mut Output,
) -> Result<Option<String>, Halt> {
    let (Exhibit::Run(clause) | Exhibit::Story(clause, _)) = finding.shown else { return Ok(None) };
    let path = path_in(folder, &finding.setup, clause);
    let (file, _) = store(&path, &finding.setup, clause, replaceable)?;
    Ok(keep(file, out))
}

/// The facts of a plan, for programs.
#[derive(JsonSchema, Serialize)]
pub(super) struct PlanFacts<'a> {
    moves: u64,
    of: &'static str,
    left: &'a [u64],
}

impl Answer<'_> {
    /// The outcome for a program.
    fn printed(&self) -> HuntJson<'_> {
        let Self { asked, hunted, verdict, files } = self;
        let stored = |(finding, file)| {
            let &Finding { clause, facts: size, .. } = finding;
            CounterexampleJson { clause, size, file }
        };
        HuntJson {
            scheme: asked.scheme,
            rule: asked.rule,
            robots: hunted.robots,
            looked_for: &hunted.looked_for,
            facts: &hunted.facts,
            complete: hunted.is_complete,
            done: hunted.done,
            verdict: verdict.word(),
            kept: asked.resume.map(shown),
            not_minimised: &hunted.not_minimised,
            counterexamples: hunted.found.iter().zip(files).map(stored).collect(),
        }
    }

    /// The headline: what was searched, and what follows from it.
    fn headline(&self) -> String {
        let HuntRequest { scheme, rule, .. } = self.asked;
        let HuntReport { title, outcome, .. } = self.hunted;
        format!("{} ({rule}), {title}\n{outcome}\n", scheme.name)
    }

    /// The clauses that are broken, as a CI shows them; if none is, that.
    fn findings(&self) -> Result<Vec<Case>, Halt> {
        let HuntRequest { scheme, rule, .. } = self.asked;
        let class = scheme.name.to_owned();
        let broken = self.hunted.found.iter().zip(&self.files).map(|(finding, file)| {
            let mut story = picture(finding)?;
            if let Some(file) = file {
                story += &replay_line(file);
            }
            let name = format!("{} by {} ({rule})", finding.clause, scheme.name);
            let outcome = Outcome::Broken(finding.title.clone(), story);
            Ok(Case { class: class.clone(), name, outcome, seconds: None })
        });
        let mut findings = broken.collect::<Result<Vec<_>, Halt>>()?;
        if !self.hunted.is_complete || findings.is_empty() {
            let outcome = if self.hunted.is_complete {
                Outcome::Expected
            } else {
                Outcome::Unfinished("the hunt was ended before its bound".to_owned())
            };
            let name = format!("every clause by {} ({rule})", scheme.name);
            findings.push(Case { class, name, outcome, seconds: None });
        }
        Ok(findings)
    }

    /// The outcome for a person.
    fn text(&self) -> Result<String, Halt> {
        let mut text = self.headline();
        for (finding, file) in self.hunted.found.iter().zip(&self.files) {
            // Writing to a string cannot fail.
            let _ = writeln!(text, "\n{}, {}\n\n{}", finding.clause, finding.title, picture(finding)?);
            match (file, &finding.shown) {
                (Some(file), _) => text += &again(file, &finding.setup),
                (None, Exhibit::Told(_)) => {
                    text += "no file is stored: a stored run has no word for what breaks the clause here\n";
                }
                (None, Exhibit::Run(_) | Exhibit::Story(..) | Exhibit::Endless) => {}
            }
        }
        if let Some(path) = self.asked.resume {
            let _ = writeln!(text, "The hunt is kept in {}.", shown(path));
        }
        Ok(text)
    }
}

/// A counterexample as a person sees it.
fn picture(finding: &Finding) -> Result<String, Halt> {
    let setup = &finding.setup;
    match (&finding.shown, setup.scheme.senses) {
        (Exhibit::Run(_), Senses::Bumps) => story::last_move(setup),
        (Exhibit::Run(_), Senses::Floor) => story::of_trap(setup),
        (Exhibit::Endless, _) => {
            let what = "A run without end, which no file tells, in this layout:";
            Ok(format!("{what}\n\n{}", setup.layout))
        }
        (Exhibit::Story(_, story), Senses::Bumps) => Ok(format!("{story}\n{}", story::last_move(setup)?)),
        (Exhibit::Story(_, story) | Exhibit::Told(story), _) => Ok(story.clone()),
    }
}

//! Work dealt out to many machines: a plan, one of its shards, and `tautline merge`, which makes one of them all.

use std::path::{Path, PathBuf};

use clap::Args;
#[cfg(feature = "papers")]
use clap::value_parser;
use schemars::JsonSchema;
use serde::Serialize;
use serde_json::value::RawValue;
use tautline_io::checkpoint::{Checkpoint, Facts, Part};
use tautline_io::diagnostic::{Diagnostic, Halt};
use tautline_io::shards::{Gap, Plan, Work};
#[cfg(feature = "papers")]
use tautline_papers::shards::{merge_table, restored};
use tautline_proofs::engine::states::MemoryLimit;
use tautline_sim::shards::{hunted, merge_hunt};

use super::findings::FormatArgs;
use super::hunt::{self, make_folder, shown};
use super::library;
use super::output::Output;
use super::prove::{DecidedRows, DecisionArgs, Detail};
#[cfg(feature = "papers")]
use super::reproduce::{Files, tell};
use super::{CATALOGUE, Exit, ForceArgs, Format, complain, interrupt, progress, refuse_needless, whole};

/// The most gaps that are named.
const MOST_NAMED: usize = 20;

/// One shard of a plan.
#[derive(Debug, Args)]
pub(super) struct ShardArgs {
    /// The plan: with --shards it is stored in FILE, with --shard it is read from there.
    #[arg(long, value_name = "FILE")]
    pub(super) plan: Option<PathBuf>,
    /// Do nothing yet, but deal the work out among N shards, each to be run on any machine.
    #[arg(long, value_name = "N", value_parser = whole::<u32>, requires = "plan")]
    #[arg(conflicts_with_all = ["shard", "resume", "budget", "out"])]
    pub(super) shards: Option<u32>,
    /// Run shard K of the plan, from 1 on, and keep how far it is beside the plan; if it was begun, go on.
    #[arg(long, value_name = "K", value_parser = whole::<u32>, requires = "plan")]
    #[arg(conflicts_with_all = ["scheme", "rule", "robots", "max_walls", "max_cells"])]
    #[arg(conflicts_with_all = ["max_misses", "max_losses", "error", "range", "size"])]
    #[arg(conflicts_with_all = ["resume", "out", "force"])]
    pub(super) shard: Option<u32>,
}

/// The work that is asked for with a plan.
pub(super) enum Scope<'a> {
    /// The work itself.
    All,
    /// A plan of so many shards.
    Plan(&'a Path, u32),
    /// One shard.
    Shard(&'a Path, u32),
}

impl ShardArgs {
    /// The work that is asked for.
    ///
    /// # Errors
    /// A [`Diagnostic`] if a plan alone is given.
    pub(super) fn wanted(&self) -> Result<Scope<'_>, Diagnostic> {
        Scope::of(self.plan.as_deref(), self.shards, self.shard)
    }
}

impl<'a> Scope<'a> {
    /// The work that these options ask for.
    ///
    /// # Errors
    /// A [`Diagnostic`] if a plan alone is given.
    pub(super) fn of(
        plan: Option<&'a Path>,
        shards: Option<u32>,
        shard: Option<u32>,
    ) -> Result<Self, Diagnostic> {
        match (plan, shards, shard) {
            (None, ..) => Ok(Self::All),
            (Some(plan), Some(shards), _) => Ok(Self::Plan(plan, shards)),
            (Some(plan), None, Some(shard)) => Ok(Self::Shard(plan, shard)),
            (Some(_), None, None) => {
                let remedy =
                    "give --shards to make the plan, --shard to run a shard of it, or tautline merge it";
                Err(Diagnostic::usage("--plan alone asks for nothing", remedy))
            }
        }
    }
}

/// The facts of a new plan.
#[derive(JsonSchema, Serialize)]
pub(super) struct PlanJson<'a, F> {
    plan: String,
    shards: u32,
    #[serde(flatten)]
    facts: &'a F,
}

/// Stores a plan, and tells of it.
///
/// # Errors
/// [`Halt`] if it cannot be stored.
pub(super) fn plan(
    (path, shards): (&Path, u32),
    (of, deal): (Work, &RawValue),
    (facts, words): (&impl Serialize, &str),
    (force, format): (&ForceArgs, Format),
    out: &mut Output,
) -> Result<Exit, Halt> {
    Plan::store(path, of, shards, deal, &force.replaceable([]))?.keep()?;
    match format {
        Format::Json => out.json(&PlanJson { plan: shown(path), shards, facts })?,
        Format::Text => out.text(format_args!("{words}\nThe plan is kept in {}.\n", shown(path)))?,
    }
    Ok(Exit::Expected)
}

/// How far a shard is, and where it is kept.
#[derive(JsonSchema, Serialize)]
pub(super) struct ShardJson {
    plan: String,
    shard: u32,
    shards: u32,
    #[serde(flatten)]
    facts: Facts,
    complete: bool,
    kept: String,
}

/// Runs a shard to its end, or until it is to stop.
///
/// # Errors
/// [`Halt`] if it cannot be done, or not be kept.
pub(super) fn run<'p>(
    plan: &Plan,
    shard: u32,
    format: Format,
    out: &mut Output,
    part: impl FnOnce(Option<&RawValue>) -> Result<Box<dyn Part + 'p>, Halt>,
) -> Result<Exit, Halt> {
    let path = plan.shard_path(shard);
    let mut kept = Checkpoint::new(Some(&path), plan.task(shard));
    let far: Option<Box<RawValue>> = kept.read()?;
    let mut part = part(far.as_deref()).map_err(|halt| match halt {
        Halt::Diagnostic(fault) => kept.found(fault).into(),
        Halt::Interrupted => halt,
    })?;
    interrupt::defer();
    // What cannot be kept is refused before it has cost anything.
    kept.keep(&*part)?;
    let spinner = progress::spinner(format!("shard {shard} of {}", plan.shards));
    while !interrupt::is_requested() && part.step()? {
        spinner.set_message(part.words());
        kept.keep_now_and_then(&*part);
    }
    spinner.finish_and_clear();
    kept.keep(&*part)?;
    let kept = shown(&path);
    match format {
        Format::Json => out.json(&ShardJson {
            plan: shown(plan.path()),
            shard,
            shards: plan.shards,
            facts: part.facts(),
            complete: part.is_done(),
            kept,
        })?,
        Format::Text => {
            let end = if part.is_done() { "done" } else { "ended before its bound: run it again to go on" };
            let (words, of) = (part.words(), plan.shards);
            out.text(format_args!("Shard {shard} of {of}: {words}; {end}.\nIt is kept in {kept}.\n"))?;
        }
    }
    Ok(if part.is_done() { Exit::Expected } else { Exit::Unfinished })
}

const EXAMPLES: &str = "\
Examples:
  tautline hunt --robots 5 --max-walls 4 --plan plan.json --shards 64
  tautline hunt --plan plan.json --shard 1
  tautline merge plan.json
  tautline merge plan.json node-1/plan-1.json node-2/plan-2.json --out counterexamples";

/// Make one of all shards of a plan: what one process would have printed and stored.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct Merge {
    /// The plan.
    plan: PathBuf,
    /// The files of its shards. Without one, those beside the plan.
    files: Vec<PathBuf>,
    /// The folder for the counterexamples. Without it those of a hunt are
    /// stored here, and those of the library are not.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Store a picture of a table: its name, as `reproduce ID --help` tells it, and a file.
    #[cfg_attr(not(feature = "papers"), arg(skip))]
    #[cfg_attr(feature = "papers", arg(long = "picture", value_names = ["NAME", "FILE"], num_args = 2))]
    #[cfg_attr(feature = "papers", arg(value_parser = value_parser!(PathBuf)))]
    pictures: Vec<PathBuf>,
    /// Store the values of a table as comma-separated values.
    #[cfg_attr(not(feature = "papers"), arg(skip))]
    #[cfg_attr(feature = "papers", arg(long, value_name = "FILE"))]
    csv: Option<PathBuf>,
    #[command(flatten)]
    force: ForceArgs,
    #[command(flatten)]
    format: FormatArgs,
}

/// Tells what keeps a merge from being whole.
fn refuse(plan: &Plan, gaps: &[Gap]) {
    let words = |gap: &Gap| match gap {
        Gap::Missing(shard) => format!("shard {shard} is missing"),
        Gap::Unfinished(shard) => format!("shard {shard} is not at its end"),
    };
    let mut named: Vec<String> = gaps.iter().take(MOST_NAMED).map(words).collect();
    if gaps.len() > MOST_NAMED {
        named.push(format!("and {} more", gaps.len() - MOST_NAMED));
    }
    let what = format!("{} of {} shards are not there: {}", gaps.len(), plan.shards, named.join(", "));
    complain(&Diagnostic::in_file(plan.path(), what, "run them, and merge again"));
}

impl Merge {
    pub(super) fn run(&self, out: &mut Output) -> Result<Exit, Halt> {
        let plan = Plan::read(&self.plan)?;
        let beside = || {
            let paths = (1..=plan.shards).map(|shard| plan.shard_path(shard));
            paths.filter(|path| path.exists()).collect()
        };
        let files: Vec<PathBuf> = if self.files.is_empty() { beside() } else { self.files.clone() };
        let of = match plan.of {
            Work::Hunt { .. } => Some("a hunt"),
            Work::Library { .. } => Some("the library"),
            Work::Table { .. } => None,
        };
        if let Some(of) = of {
            let tables = [("--picture", !self.pictures.is_empty()), ("--csv", self.csv.is_some())];
            let path = self.plan.display();
            let why = format_args!("{path} is a plan of {of}, and only a table has pictures and values");
            refuse_needless(tables, why)?;
        }
        let shards = match plan.results(&files)? {
            Ok(shards) => shards,
            Err(gaps) => {
                refuse(&plan, &gaps);
                return Ok(Exit::Gaps);
            }
        };
        let inputs = files.into_iter().chain([self.plan.clone()]);
        refuse_needless([("--out", of.is_none() && self.out.is_some())], "a table has no counterexamples")?;
        match plan.of {
            Work::Library { .. } => {
                let how = DecisionArgs::elsewhere(self.out.clone(), self.force, self.format);
                let rows = library::rows(&plan, &shards)?;
                self.out.as_deref().map(make_folder).transpose()?;
                let replaceable = self.force.replaceable(inputs);
                let made = DecidedRows { rows: &rows, memory: &MemoryLimit::unbounded(), left: 0 };
                how.tell(&made, (Detail::Rows, None), &replaceable, out)
            }
            Work::Hunt { .. } => {
                let here = Path::new(".");
                let folder = self.out.as_deref().unwrap_or(here);
                let asked = hunted(&plan, CATALOGUE)?;
                let found = merge_hunt(&plan, &asked, &shards)?;
                make_folder(folder)?;
                let replaceable = self.force.replaceable(inputs);
                hunt::tell((&asked, &found), (folder, &replaceable), self.format.format, out)
            }
            #[cfg(not(feature = "papers"))]
            Work::Table { .. } => {
                let remedy = "build it with the feature `papers`";
                Err(Diagnostic::usage("this program was built without tables", remedy).into())
            }
            #[cfg(feature = "papers")]
            Work::Table { .. } => {
                let asked = restored(&plan)?;
                let made = asked.merge(&merge_table(&plan, &*asked, &shards)?)?;
                let picture =
                    |pair: &[PathBuf]| (pair[0].to_string_lossy().into_owned(), Some(pair[1].clone()));
                let pictures = self.pictures.chunks(2).map(picture).collect();
                let files = Files::of(pictures, self.csv.clone(), (&self.force, inputs))?;
                tell(&*made, files, self.format.format.plain()?, out)
            }
        }
    }
}

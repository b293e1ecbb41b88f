//! Work dealt out to many machines: a plan, and one of its shards.

use std::path::Path;

use schemars::JsonSchema;
use serde::Serialize;
use serde_json::value::RawValue;
use tautline_io::checkpoint::{Checkpoint, Facts, Part};
use tautline_io::diagnostic::{Diagnostic, Halt};
use tautline_io::shards::{Plan, Work};

use super::exit::Exit;
use super::folder::shown;
use super::options::{ForceArgs, Format};
use super::output::Output;
use super::{interrupt, progress};

/// The work that is asked for with a plan.
pub(super) enum Scope<'a> {
    /// The work itself.
    All,
    /// A plan of so many shards.
    Plan(&'a Path, u32),
    /// One shard.
    Shard(&'a Path, u32),
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

//! `tautline hunt` for agents on a sensor floor: the fewest missed sensors and the smallest layout that trap them.

use std::fmt::Write;
use std::ops::ControlFlow;

use serde::Serialize;
use tautline_proofs::decide::Verdict;
use tautline_proofs::floor::trap::{self, Bounds, End, Found, Trap, Way};
use tautline_proofs::words::counted;
use tautline_sim::explore::agents::PREMATURE;

use super::{Hunt, check_folder, keep};
use crate::output::Output;
use crate::{Exit, Format, SizeArg, interrupt, progress};
use tautline_sim::counterexample::hunt::store;
use tautline_sim::counterexample::hunt::trap::{DEFAULT_SIDE, bounds, setup};
use tautline_sim::draw;
use tautline_sim::explore::{Profile, RuleId, Setup};
use tautline_sim::fault::{Fault, Halt};
use tautline_sim::layout::Size;

/// Agents when nobody says how many.
const DEFAULT_AGENTS: u64 = 1;

/// Sensors that are missed at most when nobody says how many.
const DEFAULT_MISSES: u8 = 1;

#[derive(Serialize)]
struct Hunted {
    scheme: &'static Profile,
    rule: RuleId,
    robots: u32,
    /// Columns and rows of the largest layouts.
    size: String,
    /// Layouts, anew for each number of misses; states of agents and floors; team moves between them.
    layouts: u64,
    states: u64,
    steps: u64,
    max_misses: u8,
    /// Whether the search came to its end: the smallest trap, or all layouts within the bound.
    complete: bool,
    /// The most misses up to which every layout was covered.
    misses_done: Option<u8>,
    verdict: &'static str,
    counterexamples: Vec<Stored>,
}

#[derive(Serialize)]
struct Stored {
    clause: &'static str,
    misses: usize,
    columns: i16,
    rows: i16,
    steps: u32,
    /// Where it is stored; a run without end is not, nor one that was left out.
    file: Option<String>,
    #[serde(skip)]
    is_endless: bool,
    #[serde(skip)]
    setup: Setup,
}

/// Hunts for traps of agents that decide by `way`.
pub(super) fn run(hunt: &Hunt, way: Way, out: &mut Output) -> Result<Exit, Halt> {
    refuse(hunt)?;
    check_folder(&hunt.out)?;
    let size = match hunt.size {
        Some(SizeArg(size)) => size,
        None => Size::new(DEFAULT_SIDE, DEFAULT_SIDE).map_err(Fault::from)?,
    };
    let (agents, misses) = (hunt.robots.unwrap_or(DEFAULT_AGENTS), hunt.max_misses.unwrap_or(DEFAULT_MISSES));
    let bounds = Bounds { budget_steps: hunt.budget, ..bounds(way, agents, misses, size)? };
    interrupt::defer();
    let found = search(&bounds);
    let hunted = Hunted {
        scheme: hunt.scheme,
        rule: hunt.rule,
        robots: bounds.agents,
        size: size.to_string(),
        layouts: found.layouts,
        states: found.states,
        steps: found.steps,
        max_misses: bounds.max_misses,
        complete: found.is_complete,
        misses_done: found.levels.checked_sub(1),
        verdict: verdict(&found).word(),
        counterexamples: found.trap.iter().map(|trap| stored(hunt, trap, out)).collect::<Result<_, _>>()?,
    };
    match hunt.format.format {
        Format::Json => out.json(&hunted)?,
        Format::Text => out.text(tell(&hunted)?)?,
    }
    Ok(match (found.is_complete, &found.trap) {
        (false, _) => Exit::Unfinished,
        (true, Some(_)) => Exit::Violation,
        (true, None) => Exit::Expected,
    })
}

/// Refuses what is not asked of agents.
fn refuse(hunt: &Hunt) -> Result<(), Fault> {
    if hunt.max_walls.is_some() {
        let what = "agents know every wall: no number of walls bounds their search";
        return Err(Fault::usage(what, "give --max-misses for the sensors, and --size for the layouts"));
    }
    if hunt.resume.is_some() {
        let what = "a hunt for traps is not kept in a file";
        return Err(Fault::usage(what, "leave --resume out; a smaller --size or --budget makes it shorter"));
    }
    Ok(())
}

fn search(bounds: &Bounds) -> Found {
    let spinner = progress::spinner("hunting");
    let found = trap::hunt(bounds, &mut |found| {
        let Found { layouts, states, levels, .. } = found;
        spinner.set_message(format!(
            "misses {levels} of {}, layouts {layouts}, states {states}",
            bounds.max_misses
        ));
        if interrupt::is_requested() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    });
    spinner.finish_and_clear();
    found
}

const fn verdict(found: &Found) -> Verdict {
    match (&found.trap, found.is_complete) {
        (Some(_), _) => Verdict::Refuted,
        (None, true) => Verdict::Holds,
        (None, false) => Verdict::Open,
    }
}

fn stored(hunt: &Hunt, trap: &Trap, out: &mut Output) -> Result<Stored, Halt> {
    let setup = setup(hunt.scheme, hunt.rule, trap).map_err(Fault::from)?;
    let (clause, file) = match trap.end {
        End::Done => {
            let (file, _) = store(&hunt.out, &setup, PREMATURE, &hunt.force.replaceable([]))?;
            (PREMATURE.as_str(), keep(file, out))
        }
        End::Endless => (ENDLESS, None),
    };
    let (columns, rows) = (trap.width, trap.height);
    let (misses, steps, is_endless) = (trap.missed.len(), trap.moves, trap.end == End::Endless);
    Ok(Stored { clause, misses, columns, rows, steps, file, is_endless, setup })
}

/// The clause that a run without end breaks.
const ENDLESS: &str = "BRICKS-5";

fn tell(hunted: &Hunted) -> Result<String, Halt> {
    let Hunted { scheme, rule, robots, size, layouts, states, steps, max_misses, misses_done, .. } = hunted;
    let order = if *robots == 1 { "" } else { " that act in turn" };
    let mut text = format!(
        "{} ({rule}), {}{order}, at most {max_misses} missed, layouts up to {size}: {}, {}, {}\n",
        scheme.name,
        counted(*robots, "agent"),
        counted(*layouts, "layout"),
        counted(*states, "state"),
        counted(*steps, "team move"),
    );
    let bound = match misses_done {
        Some(misses) if misses == max_misses => "in any layout within this bound".to_owned(),
        Some(misses) => format!("with at most {misses} missed; the hunt was ended before its bound"),
        None => "so far; the hunt was ended before it had covered all layouts".to_owned(),
    };
    // Writing to a string cannot fail.
    let _ = match hunted.counterexamples[..] {
        [] => writeln!(text, "No agent is trapped {bound}."),
        _ => {
            writeln!(text, "The fewest missed sensors and the smallest layout with which agents are trapped:")
        }
    };
    for Stored { clause, misses, columns, rows, steps, file, is_endless, setup } in &hunted.counterexamples {
        let steps = counted(*steps, "team move");
        let _ = writeln!(text, "\n{clause}, {misses} missed, {columns}x{rows} cells, {steps}");
        let _ = match is_endless {
            false => writeln!(text, "\n{}", draw::story::of_trap(setup)?),
            true => writeln!(text, "\nA run without end in this layout:\n\n{}", setup.layout),
        };
        if let Some(file) = file {
            let _ = writeln!(text, "replay it with: tautline replay {file}");
        }
    }
    Ok(text)
}

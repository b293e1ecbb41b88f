//! A refutation as a person sees it, whoever has found it: `prove` as it decides, `replay` in a file.

use schemars::JsonSchema;
use serde::Serialize;
use tautline_kernel::ground::Edge;
use tautline_proofs::clause::{AnyCheck, Clause};
use tautline_proofs::decide::{Depiction, Evidence};
use tautline_proofs::floor_trace::Course;
use tautline_proofs::plural::counted;
use tautline_proofs::run::Run;

use super::CATALOGUE;
use tautline_sim::diagnostic::Halt;
use tautline_sim::draw;
use tautline_sim::explore::{ClauseId, RuleName, Setup, hunt};
use tautline_sim::named_values::NamedValues;

/// A refutation as JSON.
#[derive(JsonSchema, Serialize)]
#[serde(untagged)]
pub(super) enum EvidenceJson {
    Choices {
        demand: &'static str,
        choices: Vec<u32>,
        /// Those that come again, where it goes round for ever.
        #[serde(skip_serializing_if = "Vec::is_empty")]
        again: Vec<u32>,
    },
    Run {
        demand: &'static str,
        walls: usize,
        steps: usize,
        layout: String,
    },
    Course {
        demand: &'static str,
        turns: usize,
        drawing: String,
    },
    Chart {
        demand: &'static str,
        events: usize,
        chart: String,
    },
}

/// The run of robots that a search has found, if the program can make it again.
pub(super) fn setup(check: &dyn AnyCheck, run: &Run) -> Result<Option<Setup>, Halt> {
    let (Some(rule), Some(scheme)) = (RuleName::of(check.rule()), CATALOGUE.scheme(run.scheme)) else {
        return Ok(None);
    };
    Ok(Some(hunt::setup(scheme, rule, run)?))
}

/// The clause that anyone sees a run break.
pub(super) fn breach(run: &Run) -> Option<ClauseId> {
    run.breaks.map(ClauseId::new)
}

/// A run of agents.
fn drawn(course: &Course) -> Result<String, Halt> {
    Ok(draw::story::of_course(course)?)
}

/// The refutation of a clause, as data.
pub(super) fn shown(check: &dyn AnyCheck, evidence: &Evidence) -> Result<EvidenceJson, Halt> {
    let Evidence { choices, demand, seen } = evidence;
    let demand = *demand;
    Ok(match seen {
        Depiction::Choices | Depiction::Story(_) => {
            EvidenceJson::Choices { demand, choices: choices.once.clone(), again: choices.again.clone() }
        }
        Depiction::Robots(run) => {
            let layout = setup(check, run)?.map_or_else(String::new, |setup| setup.layout.to_string());
            EvidenceJson::Run { demand, walls: run.walls.len(), steps: run.frames.len(), layout }
        }
        Depiction::Agents(course) => {
            EvidenceJson::Course { demand, turns: course.turns.len(), drawing: drawn(course)? }
        }
        Depiction::Messages { events, chart } => {
            EvidenceJson::Chart { demand, events: *events, chart: chart.clone() }
        }
    })
}

/// The refutation of a clause, drawn.
pub(super) fn story(clause: &Clause, check: &dyn AnyCheck, evidence: &Evidence) -> Result<String, Halt> {
    let (id, rule, demand) = (clause.id, check.rule(), evidence.demand);
    Ok(match &evidence.seen {
        Depiction::Story(story) => format!("{id} as {rule}: not so: {demand}.\n{story}"),
        Depiction::Choices => {
            let choices = listed(&evidence.choices.once);
            format!("{id} as {rule}: not so: {demand}. The choices that lead there: {choices}\n")
        }
        Depiction::Robots(run) => {
            let head = format!(
                "{id} as {rule}: the smallest counterexample in {}×{} cells has {} ({}) and {}.\n\n",
                run.area.width(),
                run.area.height(),
                counted(run.walls.len(), "wall"),
                named(&run.walls),
                counted(run.frames.len(), "team move")
            );
            match setup(check, run)? {
                Some(setup) => head + &draw::story::of_found(&setup, ClauseId::new(id), run)?,
                None => head,
            }
        }
        Depiction::Agents(course) => format!("{id} as {rule}: not so: {demand}.\n\n{}", drawn(course)?),
        Depiction::Messages { events, chart } => {
            format!("{id} as {rule}: the shortest run that breaks it has {events} events.\n\n{chart}")
        }
    })
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

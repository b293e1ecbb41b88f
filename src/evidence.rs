//! What a person sees of a refutation, whoever has found it: `prove` as it decides, `replay` in a file.

use serde::Serialize;
use tautline_kernel::ground::Edge;
use tautline_proofs::clause::{Check, Clause, Method};
use tautline_proofs::course::Course;
use tautline_proofs::decide::Evidence;
use tautline_proofs::rescue::chart::chart;
use tautline_proofs::search::{Bounds, Counterexample};

use tautline_sim::counterexample::hunt;
use tautline_sim::counterexample::refutation::rule;
use tautline_sim::draw;
use tautline_sim::explore::chain::CHAIN;
use tautline_sim::explore::{RuleName, Setup};
use tautline_sim::fault::{Fault, Halt};

/// A refutation as JSON.
#[derive(Serialize)]
#[serde(untagged)]
pub(super) enum Shown {
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

/// The run of a chain that a search has found.
pub(super) fn setup(check: &Check, run: &Counterexample) -> Result<Option<Setup>, Halt> {
    let (Method::Search { robots, max_walls, .. }, Some(rule)) = (check.method, RuleName::of(&check.subject))
    else {
        return Ok(None);
    };
    let bounds = Bounds::new(check.subject, robots, max_walls);
    Ok(Some(hunt::setup(&CHAIN, rule, &bounds, run).map_err(Fault::from)?))
}

/// A run of agents.
fn drawn(course: &Course) -> Result<String, Halt> {
    Ok(draw::story::of_course(course).map_err(Fault::from)?)
}

/// What refutes a clause, as data.
pub(super) fn shown(check: &Check, evidence: &Evidence) -> Result<Shown, Halt> {
    let demand = evidence.demand();
    Ok(match evidence {
        Evidence::Choices(choices, _) => {
            Shown::Choices { demand, choices: choices.once.clone(), again: choices.again.clone() }
        }
        Evidence::Run(run) => {
            let layout = setup(check, run)?.map_or_else(String::new, |setup| setup.layout.to_string());
            Shown::Run { demand, walls: run.walls.len(), steps: run.frames.len(), layout }
        }
        Evidence::Course(course, ..) => {
            Shown::Course { demand, turns: course.turns.len(), drawing: drawn(course)? }
        }
        Evidence::Rescue(run) => {
            let (setting, broken) = &**run;
            Shown::Chart { demand, events: broken.actions.len(), chart: chart(setting, broken) }
        }
    })
}

/// What refutes a clause, drawn.
pub(super) fn story(clause: &Clause, check: &Check, evidence: &Evidence) -> Result<String, Halt> {
    let (id, rule, demand) = (clause.id, rule(check), evidence.demand());
    Ok(match evidence {
        Evidence::Choices(choices, _) => match check.method {
            Method::Spread(networks) => {
                let story = networks.story(&check.subject, &choices.once);
                format!("{id} as {rule}: not so: {demand}.\n{story}")
            }
            Method::Exhaustive { .. }
            | Method::Ants
            | Method::Floors(_)
            | Method::Sampled { .. }
            | Method::Search { .. }
            | Method::States { .. } => format!(
                "{id} as {rule}: not so: {demand}. The choices that lead there: {}\n",
                listed(&choices.once)
            ),
        },
        Evidence::Run(run) => {
            let walls = run.walls.len();
            let head = format!(
                "{id} as {rule}: the smallest counterexample has {walls} walls ({}) and {} team moves.\n\n",
                named(&run.walls),
                run.frames.len()
            );
            match setup(check, run)? {
                Some(setup) => head + &draw::story::last_move(&setup)?,
                None => head,
            }
        }
        Evidence::Course(course, ..) => {
            format!("{id} as {rule}: not so: {demand}.\n\n{}", drawn(course)?)
        }
        Evidence::Rescue(run) => {
            let (setting, broken) = &**run;
            format!(
                "{id} as {rule}: the shortest run that breaks it has {} events.\n\n{}",
                broken.actions.len(),
                chart(setting, broken)
            )
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

/// Columns of text that a line with a bound may take.
const WIDTH: usize = 80;

/// `text` in lines that begin after `indent` columns and are broken behind commas and semicolons.
pub(super) fn indented(indent: usize, text: &str) -> String {
    let width = WIDTH - indent;
    let mut before = ' ';
    let parts = text.split_inclusive(|letter: char| {
        let is_break = letter == ' ' && matches!(before, ',' | ';');
        before = letter;
        is_break
    });
    let joined = |mut lines: Vec<String>, part: &str| {
        match lines.last_mut() {
            Some(line) if line.chars().count() + 1 + part.chars().count() <= width => {
                line.push(' ');
                line.push_str(part);
            }
            Some(_) | None => lines.push(part.to_owned()),
        }
        lines
    };
    let margin = " ".repeat(indent);
    let lines = parts.map(str::trim_end).fold(Vec::new(), joined).into_iter();
    lines.map(|line| [margin.as_str(), &line, "\n"].concat()).collect()
}

//! A refutation as a person sees it, whoever has found it: `prove` as it decides, `replay` in a file.

use super::catalogue::CATALOGUE;
use std::path::Path;

use schemars::JsonSchema;
use serde::Serialize;
use tautline_io::diagnostic::{Diagnostic, Halt};
use tautline_io::named_values::NamedValues;
use tautline_kernel::ground::Edge;
use tautline_proofs::clause::{AnyCheck, Clause};
use tautline_proofs::decide::{Depiction, Evidence, MethodError};
use tautline_proofs::floor_trace::Course;
use tautline_proofs::plural::counted;
use tautline_proofs::run::{Run, ScriptedRun};

use tautline_io::text_blocks::Block;
use tautline_sim::counterexample::refutation::{self, Refutation};
use tautline_sim::draw::{self, page};
use tautline_sim::explore::{ClauseId, Play, RuleName, Setup, hunt};

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

/// The run of a refutation, if the program can make it again.
pub(super) fn run(clause: &Clause, check: &dyn AnyCheck, evidence: &Evidence) -> Result<Option<Setup>, Halt> {
    match &evidence.seen {
        Depiction::Robots(run) => setup(check, run),
        Depiction::Story(_) => scripted(clause, check, evidence),
        Depiction::Choices | Depiction::Agents(_) | Depiction::Messages { .. } => Ok(None),
    }
}

/// The run that a search has made by its choices, if a rule of the catalogue makes it again and breaks the clause.
fn scripted(clause: &Clause, check: &dyn AnyCheck, evidence: &Evidence) -> Result<Option<Setup>, Halt> {
    let Some(ScriptedRun { run, choices }) = check.scripted(&evidence.choices) else { return Ok(None) };
    let Some(scheme) = CATALOGUE.scheme(run.scheme) else { return Ok(None) };
    let Some(rule) = scheme.rules.iter().find(|rule| rule.name.as_str() == check.rule()) else {
        return Ok(None);
    };
    let setup = Setup { choices, ..hunt::setup(scheme, rule.name, &run)? };
    let report = setup.play(&mut |_| Ok(()))?;
    Ok(report.violations.iter().any(|broken| broken.clause.as_str() == clause.id).then_some(setup))
}

/// The run of robots that a search has found, if the program can make it again.
pub(super) fn setup(check: &dyn AnyCheck, run: &Run) -> Result<Option<Setup>, Halt> {
    let (Some(rule), Some(scheme)) = (RuleName::of(check.rule()), CATALOGUE.scheme(run.scheme)) else {
        return Ok(None);
    };
    Ok(Some(hunt::setup(scheme, rule, run)?))
}

/// The setup of the run in a refutation that `prove` or `library` has stored.
pub(super) fn stored(file: &Path) -> Result<Setup, Halt> {
    let Refutation { clause, check, evidence } = read(file)?;
    run(clause, check, &evidence)?.ok_or_else(|| no_run(file).into())
}

/// The refutation that `prove` or `library` has stored, played again.
pub(super) fn read(file: &Path) -> Result<Refutation<'static>, Diagnostic> {
    refutation::replay(file, &tautline_library::clauses().collect::<Vec<_>>())
}

/// The fault of a file with a refutation of another kind.
pub(super) fn no_run(file: &Path) -> Diagnostic {
    let what = "this refutation is no run of a team in a layout";
    Diagnostic::in_file(file, what, "draw it with `tautline replay`")
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

/// Writes the page of a refutation to `sink`: it plays the run that breaks the clause if the program can make it, and
/// else goes through its turns or its lines.
pub(super) fn page(
    clause: &Clause,
    check: &dyn AnyCheck,
    evidence: &Evidence,
    sink: &mut dyn page::Sink,
) -> Result<(), Halt> {
    if let Some(setup) = run(clause, check, evidence)? {
        let report = setup.play(&mut |_| Ok(()))?;
        if report.violations.iter().any(|broken| broken.clause.as_str() == clause.id) {
            return page::write(sink, &setup, &report, &(1..=report.steps));
        }
    }
    let title = format!("{} as {}", clause.id, check.rule());
    let sentence = format!("{}: {}", clause.id, clause.sentence);
    let (words, parts): (String, Vec<String>) = match &evidence.seen {
        Depiction::Agents(course) => {
            let (words, turns) = draw::story::turns(course)?;
            (words, turns.iter().map(Block::to_string).collect())
        }
        Depiction::Choices | Depiction::Story(_) | Depiction::Robots(_) | Depiction::Messages { .. } => {
            let story = story(clause, check, evidence)?;
            let (head, events) = story.split_once('\n').unwrap_or((&story, ""));
            let events = events.lines().filter(|line| !line.trim().is_empty());
            (head.to_owned(), events.map(str::to_owned).collect())
        }
    };
    sink.add(&page::in_words(&title, &sentence, &words, &parts));
    Ok(())
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

/// The answer about a check that is registered. One that cannot be decided, or panics, is a bug of ours.
pub(crate) fn registered<T>(answer: Result<T, MethodError>) -> T {
    answer.unwrap_or_else(|refused| panic!("a registered check is not decided: {refused}"))
}

//! A run in the Informal Trace Format of Apalache, for the viewers of model checkers: one state for the start, and one
//! after each team move. Whole numbers are written as that format has them, as `#bigint`. The variables are those of
//! every rule; what a rule of one's own says in words stands in the `#meta` of its states.

use std::mem::replace;

use serde_json::{Value, json};
use tautline_kernel::ground::Cell;

use tautline_io::atomic_file::{AtomicFile, ITF_HEAD};
use tautline_io::diagnostic::Halt;
use tautline_sim::explore::{ClauseId, Look, Play, TeamMove};
use tautline_sim::trace::{StoredMove, numbered_from};

/// The variables of a state, with their types.
const VARIABLES: [(&str, &str); 6] = [
    ("blocked", "Seq(Bool)"),
    ("broken", "Set(Str)"),
    ("cells", "Seq(<<Int, Int>>)"),
    ("kind", "Str"),
    ("step", "Int"),
    ("tried", "Str"),
];

fn int(number: impl std::fmt::Display) -> Value {
    json!({ "#bigint": number.to_string() })
}

fn cell(cell: &Cell) -> Value {
    json!({ "#tup": [int(cell.x), int(cell.y)] })
}

/// A state before it is written: what is broken by the end of a run is told of the last one.
struct State {
    step: u32,
    kind: &'static str,
    tried: String,
    blocked: Vec<bool>,
    cells: Vec<Cell>,
    broken: Vec<ClauseId>,
    title: String,
    is_again: bool,
}

impl State {
    /// The start, in which nothing was tried.
    fn start(cells: Vec<Cell>) -> Self {
        let (tried, blocked) = (".".repeat(cells.len()), vec![false; cells.len()]);
        let (broken, title) = (Vec::new(), String::new());
        Self { step: 0, kind: "start", tried, blocked, cells, broken, title, is_again: false }
    }

    /// After a team move.
    fn after(made: &TeamMove<'_>, look: Look) -> Self {
        let stored = StoredMove::new(made, look);
        Self {
            step: made.step,
            kind: stored.kind(),
            tried: stored.tried().to_owned(),
            blocked: made.frame.blocked.clone(),
            cells: made.frame.cells.clone(),
            broken: made.broken.to_vec(),
            title: stored.title().to_owned(),
            is_again: stored.is_again(),
        }
    }

    /// The facts beside the variables: the number of the state, and in words what a rule of one's own says of it.
    fn meta(&self, run: &dyn Play) -> Value {
        let mut meta = json!({ "index": self.step });
        if !self.title.is_empty() {
            meta["title"] = json!(self.title);
        }
        if self.is_again {
            meta["again"] = json!(true);
        }
        if numbered_from(run.setup().scheme.look).is_some() {
            for &clause in &self.broken {
                if let Some(demand) = run.sentence(clause) {
                    meta["demands"][clause.as_str()] = json!(demand);
                }
            }
        }
        meta
    }

    fn json(&self, run: &dyn Play) -> Value {
        let broken: Vec<&str> = self.broken.iter().map(|clause| clause.as_str()).collect();
        json!({
            "#meta": self.meta(run),
            "step": int(self.step),
            "kind": self.kind,
            "tried": self.tried,
            "blocked": self.blocked,
            "cells": self.cells.iter().map(cell).collect::<Vec<Value>>(),
            "broken": { "#set": broken },
        })
    }
}

/// Writes `run` to `file`, a state a line.
///
/// # Errors
/// [`Halt`] if the run cannot be made.
pub fn write(file: &mut AtomicFile, run: &dyn Play) -> Result<(), Halt> {
    let setup = run.setup();
    let types: serde_json::Map<String, Value> =
        VARIABLES.iter().map(|&(name, kind)| (name.to_owned(), json!(kind))).collect();
    let mut meta = json!({
        "format": "ITF",
        "format-description": "https://apalache-mc.org/docs/adr/015adr-trace.html",
        "varTypes": types,
        "scheme": setup.scheme.name,
        "rule": setup.rule.as_str(),
        "layout": setup.layout.to_string(),
    });
    if let Some(first) = numbered_from(setup.scheme.look) {
        meta["numbered_from"] = json!(first);
    }
    let names: Vec<&str> = VARIABLES.iter().map(|&(name, _)| name).collect();
    file.append(ITF_HEAD);
    file.append(meta.to_string().trim_start_matches('{'));
    file.append(format!(",\n\"vars\":{},\n\"states\":[\n", json!(names)));
    let (look, mut last) = (setup.scheme.look, State::start(setup.starts()));
    let report = run.play(&mut |made| {
        let before = replace(&mut last, State::after(made, look));
        file.append(format!("{},\n", before.json(run)));
        Ok(())
    })?;
    for violation in report.violations.iter().filter(|violation| violation.step == last.step) {
        if !last.broken.contains(&violation.clause) {
            last.broken.push(violation.clause);
        }
    }
    file.append(format!("{}\n]}}\n", last.json(run)));
    Ok(())
}

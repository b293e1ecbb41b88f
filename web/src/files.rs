//! Files that are dropped on a page or kept from it: layouts of ours and of MovingAI, stored runs, and the page's own.

use serde_json::{Value, json};
use tautline_grids::layout::{Layout, Misread, movingai, text};
use tautline_io::diagnostic::{Diagnostic, Halt, Place};
use tautline_sim::trace::{self, StoredRun};

use crate::own;
use crate::play::json as written;
use crate::settings::{Settings, ground};

/// The most bytes of a file that a page reads.
const MOST_BYTES: usize = 16 << 20;

/// The largest seed of a page, whose numbers are those of a script.
const MOST_SEED: u64 = (1 << 53) - 1;

/// The content of a file: a layout or a run.
pub(crate) fn read(name: &str, content: String) -> Result<Value, Diagnostic> {
    let wrong = |what: &str, remedy: &str| Err(Diagnostic::in_file(name, what, remedy));
    if content.len() > MOST_BYTES {
        return wrong("the file is too large for a page", "read it with `tautline` in a terminal");
    }
    if content.trim_start_matches('\u{feff}').starts_with('{') {
        return run(name, content);
    }
    let first = content.trim_start_matches('\u{feff}').lines().next().unwrap_or_default();
    let read: fn(&str) -> Result<Layout, Misread> = if first.starts_with("type ") {
        movingai::read
    } else if first.starts_with("tautline layout") {
        text::read
    } else {
        return wrong(
            "this is no file that a page reads",
            "drop a drawing that begins with `tautline layout 1`, a MovingAI .map, or a stored run (.jsonl)",
        );
    };
    let layout = read(&content).map_err(|misread| {
        let Misread { at, problem } = misread;
        spot(&Diagnostic::at(name, &content, at, problem.what(), problem.remedy()))
    })?;
    Ok(json!({
        "layout": { "ground": ground(&layout), "base": written(&layout.base()), "robots": layout.robots() }
    }))
}

fn run(name: &str, content: String) -> Result<Value, Diagnostic> {
    match trace::open_text(name, content, own::catalogue()).map_err(|fault| spot(&fault))? {
        StoredRun::Known(trace) => {
            let (setup, clause) = (trace.setup.clone(), trace.clause);
            let report = trace.replay(&mut |_| Ok(())).map_err(|halt| match halt {
                Halt::Diagnostic(fault) => spot(&fault),
                Halt::Interrupted => Diagnostic::usage("interrupted", "drop the file again"),
            })?;
            let settings = Settings::of(&setup, None);
            if settings.seed > MOST_SEED {
                let what =
                    format!("its seed is larger than {MOST_SEED}, the largest that a page holds exactly");
                let remedy = "draw it with `tautline replay` in a terminal";
                return Err(Diagnostic::in_file(name, what, remedy));
            }
            Ok(json!({ "run": {
                "settings": written(&settings),
                "steps": report.steps,
                "clause": clause.map(|clause| clause.to_string()),
            } }))
        }
        StoredRun::Foreign(_) => Err(Diagnostic::in_file(
            name,
            "this page does not know the scheme of the run",
            "draw it with `tautline replay` in a terminal",
        )),
    }
}

/// A fault that says its line and column, as a page shows no excerpt.
fn spot(fault: &Diagnostic) -> Diagnostic {
    match fault.place() {
        Place::Spot { file, line, column, .. } => {
            let what = format!("line {line}, column {column}: {}", fault.what());
            Diagnostic::in_file(file, what, fault.remedy())
        }
        Place::Request { .. } | Place::File(_) => fault.clone(),
    }
}

/// The run of these settings as a stored run.
pub(crate) fn store(settings: &Settings) -> Result<Value, Diagnostic> {
    if settings.world {
        let remedy = "keep the link instead: it holds the answers";
        return Err(Diagnostic::usage("what is played by hand in every order is no stored run", remedy));
    }
    if settings.switched().is_some() {
        let what = "a stored run follows a rule as it is, and here conditions are switched";
        let remedy = "keep the link instead: it holds the switches";
        return Err(Diagnostic::usage(what, remedy));
    }
    let setup = settings.setup()?;
    let text = trace::text(&setup, setup.limits.stop()).map_err(|halt| match halt {
        Halt::Diagnostic(fault) => fault,
        Halt::Interrupted => Diagnostic::usage("interrupted", "try again"),
    })?;
    Ok(json!({ "text": text }))
}

//! Failures as Python's exceptions: those of the module `pytautline._errors`, each with what is wrong and what would be
//! right.

use std::fmt::Display;

use pyo3::exceptions::PyKeyboardInterrupt;
use pyo3::prelude::*;
use tautline_io::diagnostic::{Diagnostic, Halt};
use tautline_sim::counterexample::minimise::Failure;

/// The exceptions of the package, by their names.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Kind {
    /// Something that was given is wrong.
    Input,
    /// A rule has returned what no rule may return.
    WrongType,
    /// A rule has not returned.
    NeverEnds,
    /// A rule does not answer the same to the same.
    NotPure,
    /// A rule has raised an exception.
    Raised,
}

impl Kind {
    const fn name(self) -> &'static str {
        match self {
            Self::Input => "InputError",
            Self::WrongType => "RuleWrongType",
            Self::NeverEnds => "RuleNeverEnds",
            Self::NotPure => "RuleNotPure",
            Self::Raised => "RuleRaised",
        }
    }
}

/// The exception of this kind.
pub(crate) fn error(py: Python<'_>, kind: Kind, what: impl Display, remedy: impl Display) -> PyErr {
    let class = py.import("pytautline._errors").and_then(|errors| errors.getattr(kind.name()));
    let made = class.and_then(|class| class.call1((what.to_string(), remedy.to_string())));
    made.map_or_else(|error| error, PyErr::from_value)
}

/// A value as a person sees it, not too long.
pub(crate) fn shown(value: &Bound<'_, PyAny>) -> String {
    let text =
        value.repr().map_or_else(|_| "something that cannot be shown".to_owned(), |text| text.to_string());
    match text.char_indices().nth(80) {
        Some((end, _)) => format!("{}...", &text[..end]),
        None => text,
    }
}

/// Fields and commands of the program that have other names here, in the words of faults.
const NAMES: [(&str, &str); 6] = [
    ("`range`", "message_range"),
    ("`tautline prove `out``", "StateRun.store"),
    ("that `trace` or `tautline hunt` wrote", "that Run.store or `tautline hunt` wrote"),
    ("that `trace` wrote", "that Run.store wrote"),
    ("with `tautline explore `trace`` or", "with Run.store or"),
    (
        "name a counterexample of `tautline hunt`, or a trace of a run that ended `tautline explore` with exit code 1",
        "take a run of hunt, or one that has violations",
    ),
];

/// Words about what is wrong, or would be right, as Python has them: fields are its keywords.
fn keywords(words: &str) -> String {
    let words = NAMES.iter().fold(words.to_owned(), |words, (name, own)| words.replace(name, own));
    let named = words.split('`').enumerate();
    named.map(|(place, part)| if place % 2 == 1 { part.replace('-', "_") } else { part.to_owned() }).collect()
}

/// The exception of a fault. Its remedy names fields, which are written as Python's keywords.
pub(crate) fn raised(py: Python<'_>, fault: &Diagnostic) -> PyErr {
    let place = fault.place().to_string();
    error(py, Kind::Input, format_args!("{place}{}", keywords(fault.what())), keywords(fault.remedy()))
}

/// The exception of what ended a piece of work.
pub(crate) fn halted(py: Python<'_>, halt: &Halt) -> PyErr {
    match halt {
        Halt::Diagnostic(fault) => raised(py, fault),
        Halt::Interrupted => PyKeyboardInterrupt::new_err(()),
    }
}

/// The exception of a run that cannot be made minimal.
pub(crate) fn failed(py: Python<'_>, failure: &Failure) -> PyErr {
    match failure {
        Failure::Refused(refused) => error(py, Kind::Input, refused, keywords(&refused.remedy())),
        Failure::Halted(halt) => halted(py, halt),
    }
}

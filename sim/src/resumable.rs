//! A part of some work, which can be left and taken up again.

use std::time::Duration;

use schemars::JsonSchema;
use serde::Serialize;
use serde_json::value::{RawValue, to_raw_value};

use crate::diagnostic::{Diagnostic, Halt};

/// How often work that can be taken up again is kept in its file.
pub const KEEP_EVERY: Duration = Duration::from_secs(5);

/// How much of a part is done, under the names that JSON has for it.
#[derive(Clone, Copy, PartialEq, Eq, Debug, JsonSchema, Serialize)]
#[serde(untagged)]
#[expect(missing_docs, reason = "the fields are named as in the text for people")]
pub enum Facts {
    /// Of a hunt of a chain.
    Chain { runs: u64, moves: u64 },
    /// Of a hunt on sensor floors.
    Floor { layouts: usize, moves: u64 },
    /// Of a table.
    Table { jobs: usize, jobs_done: usize },
}

/// A part of some work.
pub trait Resumable {
    /// Works a little further. Returns whether there is more to do, and to spend.
    ///
    /// # Errors
    /// [`Halt`] if it cannot be done.
    fn step(&mut self) -> Result<bool, Halt>;

    /// How far it is: enough to go on from here, on any machine.
    ///
    /// # Errors
    /// A [`Diagnostic`] if that cannot be written.
    fn far(&self) -> Result<Box<RawValue>, Diagnostic>;

    /// Whether nothing is left to do.
    fn is_done(&self) -> bool;

    /// How much is done, for programs.
    fn facts(&self) -> Facts;

    /// The same for people.
    fn words(&self) -> String;
}

/// `value` as JSON, as it stands in a file.
///
/// # Errors
/// A [`Diagnostic`] if it cannot be written.
pub fn written(value: &impl Serialize) -> Result<Box<RawValue>, Diagnostic> {
    to_raw_value(value).map_err(|error| Diagnostic::usage(error, "report it: this is a bug of tautline"))
}

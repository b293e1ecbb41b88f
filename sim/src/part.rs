//! A part of some work, which can be left and taken up again.

use std::time::Duration;

use serde::Serialize;
use serde_json::Value;
use serde_json::value::{RawValue, to_raw_value};

use crate::fault::{Fault, Halt};

/// How often work that can be taken up again is kept in its file.
pub const KEEP_EVERY: Duration = Duration::from_secs(5);

/// A part of some work.
pub trait Part {
    /// Works a little further. Returns whether there is more to do, and to spend.
    ///
    /// # Errors
    /// [`Halt`] if it cannot be done.
    fn step(&mut self) -> Result<bool, Halt>;

    /// How far it is: enough to go on from here, on any machine.
    ///
    /// # Errors
    /// A [`Fault`] if that cannot be written.
    fn far(&self) -> Result<Box<RawValue>, Fault>;

    /// Whether nothing is left to do.
    fn is_done(&self) -> bool;

    /// How much is done, for programs.
    fn facts(&self) -> Vec<(&'static str, Value)>;

    /// The same for people.
    fn words(&self) -> String;
}

/// `value` as JSON, as it stands in a file.
pub(crate) fn written(value: &impl Serialize) -> Result<Box<RawValue>, Fault> {
    to_raw_value(value).map_err(|error| Fault::usage(error, "report it: this is a bug of tautline"))
}

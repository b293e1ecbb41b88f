//! A hunt on its way, kept in a file.

use std::path::Path;

use serde::{Deserialize, Serialize};
use tautline_kernel::ground::Cell;
use tautline_proofs::chain::search::{Bounds, Search};

use super::hunt::{fault, start};
use crate::checkpoint::{self, Checkpoint, Header};
use crate::diagnostic::Diagnostic;
use crate::explore::hunt::Asked;

/// What to do about a file that is no hunt of ours.
pub(super) const AGAIN: &str = "name another file, or remove it and hunt from the start";

/// What is hunted.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct HuntReport {
    format: String,
    version: u32,
    scheme: String,
    rule: String,
    robots: usize,
    /// North-west and south-east corner of the area.
    area: [Cell; 2],
    base: Cell,
}

impl Header for HuntReport {
    const FORMAT: &'static str = "tautline hunt";
    const NOUN: &'static str = "a kept hunt";
    const OTHER: &'static str = "this is another hunt";
    const FIELDS: &'static [&'static str] = &["scheme", "rule", "robots", "area", "base"];
    const AGAIN: &'static str = AGAIN;
    const ELSEWHERE: &'static str = "ask for the same, or give another `resume` file";
}

/// A hunt that is kept in a file.
#[derive(Debug)]
pub struct Saved<'a>(Checkpoint<'a, HuntReport>);

impl<'a> Saved<'a> {
    /// The hunt that is `asked`, within `bounds`, to be kept at `path`.
    pub fn new(path: &'a Path, asked: &Asked<'_>, bounds: &Bounds) -> Self {
        let area = bounds.reach().unwrap_or(bounds.area);
        let header = HuntReport {
            format: HuntReport::FORMAT.to_owned(),
            version: checkpoint::VERSION,
            scheme: asked.scheme.name.to_owned(),
            rule: asked.rule.to_string(),
            robots: bounds.robots,
            area: [area.first(), area.last()],
            base: bounds.base,
        };
        Self(Checkpoint::new(path, header))
    }

    /// The search as it is in the file, or from the start if there is no file.
    ///
    /// # Errors
    /// A [`Diagnostic`] if the file is damaged, of another hunt or in use, or the bounds cannot be searched.
    pub fn search(&mut self, bounds: &Bounds) -> Result<Search, Diagnostic> {
        match self.0.read()? {
            None => start(bounds),
            Some(position) => {
                Search::at(bounds, &position).map_err(|refused| fault(refused).found_in(self.0.path()))
            }
        }
    }

    /// Keeps where `search` is.
    ///
    /// # Errors
    /// A [`Diagnostic`] if it cannot be written, or another process has put a file there.
    pub fn write(&mut self, search: &Search) -> Result<(), Diagnostic> {
        self.0.write(&search.position())
    }
}

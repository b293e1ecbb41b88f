//! A hunt on its way, kept in a file.

use std::path::Path;

use serde::{Deserialize, Serialize};
use tautline_kernel::ground::Cell;
use tautline_proofs::chain::search::{Bounds, Search};

use super::hunt::{fault, start};
use crate::explore::{Profile, RuleId};
use crate::fault::Fault;
use crate::kept::{self, Header, Kept};

/// What to do about a file that is no hunt of ours.
pub(super) const AGAIN: &str = "name another file, or remove it and hunt from the start";

/// What is hunted.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Hunted {
    format: String,
    version: u32,
    scheme: &'static Profile,
    rule: RuleId,
    robots: usize,
    /// North-west and south-east corner of the area.
    area: [Cell; 2],
    base: Cell,
}

impl Header for Hunted {
    const FORMAT: &'static str = "tautline hunt";
    const NOUN: &'static str = "a kept hunt";
    const OTHER: &'static str = "this is another hunt";
    const FIELDS: &'static [&'static str] = &["scheme", "rule", "robots", "area", "base"];
    const AGAIN: &'static str = AGAIN;
    const ELSEWHERE: &'static str = "ask for the same, or give another `resume` file";
}

/// A hunt that is kept in a file.
#[derive(Debug)]
pub struct Saved<'a>(Kept<'a, Hunted>);

impl<'a> Saved<'a> {
    /// The hunt within `bounds` by `scheme` and `rule`, to be kept at `path`.
    pub fn new(path: &'a Path, scheme: &'static Profile, rule: impl Into<RuleId>, bounds: &Bounds) -> Self {
        let area = bounds.reach().unwrap_or(bounds.area);
        let header = Hunted {
            format: Hunted::FORMAT.to_owned(),
            version: kept::VERSION,
            scheme,
            rule: rule.into(),
            robots: bounds.robots,
            area: [area.first(), area.last()],
            base: bounds.base,
        };
        Self(Kept::new(path, header))
    }

    /// The search as it is in the file, or from the start if there is no file.
    ///
    /// # Errors
    /// A [`Fault`] if the file is damaged, of another hunt or in use, or the bounds cannot be searched.
    pub fn search(&mut self, bounds: &Bounds) -> Result<Search, Fault> {
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
    /// A [`Fault`] if it cannot be written, or another process has put a file there.
    pub fn write(&mut self, search: &Search) -> Result<(), Fault> {
        self.0.write(&search.position())
    }
}

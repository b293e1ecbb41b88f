//! The lines of a stored run.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use tautline_io::diagnostic::Diagnostic;
use tautline_io::json_lines::Lines;
use tautline_kernel::ground::Cell;

use super::team_move::StoredMove;
use crate::explore::{Limits, Report, RuleId, Scheme, Setup, StopReason, Violation};
use crate::options::Options;
use tautline_grids::chance::Probability;
use tautline_grids::layout::Layout;

/// The first line. What the limits say is known only of the schemes of this program.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Header<L> {
    pub(super) format: String,
    pub(super) version: u32,
    pub(super) scheme: String,
    pub(super) rule: String,
    pub(super) robots: u16,
    pub(super) seed: u64,
    pub(super) base: Cell,
    /// Where each agent starts, if not all start at the base.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) starts: Option<Vec<Cell>>,
    /// How likely it is that a sensor is missed, if that happens at all.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) miss: Option<Probability>,
    /// Which sensors are missed besides.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(super) missed: Vec<u32>,
    /// The options that the run is told, if it is told any.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) options: Option<Options>,
    /// The choices that make the run, where a search has found it.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(super) choices: Vec<u32>,
    pub(super) limits: L,
    /// The clause that the last move breaks, in a counterexample.
    pub(super) clause: Option<String>,
    /// The demand of a rule of one's own that is broken, in words.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) demand: Option<String>,
    /// The number of the first robot, which is 0 of a rule of one's own; without it robots count from 1, and team moves
    /// have no titles.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) numbered_from: Option<usize>,
    /// The drawing, with the base.
    pub(super) layout: String,
}

impl<L> Header<L> {
    /// The run that it makes, without limits.
    pub(super) fn setup(self, scheme: Scheme, rule: RuleId, layout: Layout) -> Setup {
        let Self { robots, seed, base, starts, miss, missed, options, choices, .. } = self;
        let (miss, options) = (miss.unwrap_or_default(), options.unwrap_or_default());
        let limits = Limits::default();
        Setup { scheme, rule, robots, seed, layout, base, starts, miss, missed, options, choices, limits }
    }
}

/// A later line.
#[derive(PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(super) enum Line {
    Move(StoredMove),
    End(StoredEnd),
}

/// The last line.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct StoredEnd {
    pub(super) stopped: StopReason,
    pub(super) steps: u32,
    pub(super) explored: u32,
    pub(super) cells: u32,
    pub(super) violations: Vec<StoredViolation>,
}

/// A clause that was broken, and in which team move.
#[derive(Clone, PartialEq, Eq, Debug, JsonSchema, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StoredViolation {
    pub(super) clause: String,
    pub(super) step: u32,
}

impl From<&Violation> for StoredViolation {
    fn from(violation: &Violation) -> Self {
        Self { clause: violation.clause.to_string(), step: violation.step }
    }
}

impl From<&Report> for StoredEnd {
    fn from(report: &Report) -> Self {
        Self {
            stopped: report.stopped,
            steps: report.steps,
            explored: report.explored,
            cells: report.cells,
            violations: report.violations.iter().map(StoredViolation::from).collect(),
        }
    }
}

/// The layout of a header, with the base where the header has it.
pub(super) fn drawn(
    lines: &Lines,
    text: &str,
    layout: &str,
    base: Cell,
    again: &str,
) -> Result<Layout, Diagnostic> {
    let layout: Layout = layout.parse().map_err(|problem| lines.fault(text, "layout", problem, again))?;
    if layout.base() != Some(base) {
        let what = format!("the base {base} is not where the layout draws it");
        return Err(lines.fault(text, "base", what, again));
    }
    Ok(layout)
}

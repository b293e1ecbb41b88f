//! The outcome of a run, as JSON has it, for the program and for others.

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::Serialize;
use tautline_kernel::ground::Cell;

use super::StoredViolation;
use crate::explore::floor::Component;
use crate::explore::{Knowledge, Milestone, Play, Report, Setup, StopReason, Violation};
use crate::failures::Failures;
use crate::objects::ObjectReport;
use tautline_grids::chance::Probability;
use tautline_grids::layout::ColumnRow;

/// The JSON of a run.
#[derive(JsonSchema, Serialize)]
pub struct Summary<'a> {
    scheme: &'a str,
    rule: &'a str,
    robots: u16,
    seed: u64,
    layout: &'a str,
    #[schemars(with = "ColumnRow")]
    base: Cell,
    #[serde(flatten)]
    floor: Option<FloorSummary<'a>>,
    steps: u32,
    explored: u32,
    cells: u32,
    #[schemars(with = "BTreeMap<String, Option<u32>>")]
    milestones: BTreeMap<u32, Option<u32>>,
    stopped: StopReason,
    /// The failures, where something was to fail.
    #[serde(skip_serializing_if = "Option::is_none")]
    faults: Option<Failures>,
    /// The objects that the team has looked for, in sides of a cell.
    #[serde(skip_serializing_if = "<[_]>::is_empty")]
    objects: &'a [ObjectReport],
    violations: Vec<StoredViolation>,
}

/// The part of a summary about a sensor floor. Ants mark nothing and never know that they are done: of them nothing is
/// said about that.
#[derive(JsonSchema, Serialize)]
struct FloorSummary<'a> {
    miss: Probability,
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Option<Vec<ColumnRow>>")]
    starts: Option<&'a [Cell]>,
    #[serde(flatten)]
    marked: Option<MarkSummary>,
    /// How long the slowest agent scanned and went.
    seconds: f64,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    components: Vec<Part>,
}

/// How long the slowest agent took; exact, since no run takes 2⁵³ milliseconds.
#[expect(clippy::cast_precision_loss, reason = "285,000 years are fewer milliseconds than 2⁵³")]
fn seconds(report: &Report) -> f64 {
    report.milliseconds.unwrap_or(0) as f64 / 1000.0
}

/// The deeds and the knowledge of agents that mark cells.
#[derive(JsonSchema, Serialize)]
struct MarkSummary {
    visited: u32,
    terminated: bool,
}

/// A part of the layout that is not connected with the others.
#[derive(JsonSchema, Serialize)]
struct Part {
    robots: u16,
    cells: u32,
    explored: u32,
    #[serde(flatten)]
    marked: Option<MarkSummary>,
}

impl MarkSummary {
    fn of(knowledge: Knowledge, component: &Component) -> Option<Self> {
        let is_known = knowledge == Knowledge::Visited;
        is_known.then_some(Self { visited: component.visited, terminated: component.active == 0 })
    }
}

impl<'a> FloorSummary<'a> {
    fn of(knowledge: Knowledge, setup: &'a Setup, report: &Report) -> Self {
        let part = |component: &Component| {
            let Component { robots, cells, explored, .. } = *component;
            Part { robots, cells, explored, marked: MarkSummary::of(knowledge, component) }
        };
        let parts = if report.components.len() < 2 { &[] } else { report.components.as_slice() };
        Self {
            miss: setup.miss,
            starts: setup.starts.as_deref(),
            marked: MarkSummary::of(knowledge, &report.whole()),
            seconds: seconds(report),
            components: parts.iter().map(part).collect(),
        }
    }
}

impl<'a> Summary<'a> {
    /// That of a run which came out as `report`, in the layout that is called `layout`.
    pub fn new(run: &'a dyn Play, layout: &'a str, report: &'a Report) -> Self {
        let setup = run.setup();
        let milestones = Milestone::ALL.map(|milestone| (milestone.percent(), report.reached(milestone)));
        Self {
            scheme: setup.scheme.name,
            rule: setup.rule.as_str(),
            robots: setup.robots,
            seed: setup.seed,
            layout,
            base: setup.base,
            floor: setup.scheme.knowledge.map(|knowledge| FloorSummary::of(knowledge, setup, report)),
            steps: report.steps,
            explored: report.explored,
            cells: report.cells,
            milestones: milestones.into(),
            stopped: report.stopped,
            faults: report.failures,
            objects: &report.objects,
            violations: report.violations.iter().map(|violation: &Violation| violation.into()).collect(),
        }
    }
}

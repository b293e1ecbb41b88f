//! The lines of a stored run: how they are written, by whomever, and what they say.

use std::borrow::Cow;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use tautline_kernel::chain::Kind;
use tautline_kernel::ground::{Cell, Edge, Side, Step};
use tautline_proofs::run::Frame;

use super::lines::{Lines, line_of};
use crate::atomic_file::AtomicFile;
use crate::diagnostic::Diagnostic;
use crate::explore::{ClauseId, Limits, Report, RuleId, Scheme, Setup, Stopped, TeamMove, Violation};
use crate::layout::generate::Probability;
use crate::layout::{Layout, Problem};
use crate::options::Options;
use crate::schema::CellWritten;

/// The format of the header.
pub const FORMAT: &str = "tautline run";
pub(super) const VERSION: u32 = 1;

/// How to make such a file again.
pub(super) const AGAIN: &str = "store the run again with `tautline explore `trace`` or `tautline hunt`";

/// The first line. What the limits say is known only of the schemes of this program.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Header<L> {
    format: String,
    version: u32,
    pub(super) scheme: String,
    pub(super) rule: String,
    pub(super) robots: u16,
    seed: u64,
    pub(super) base: Cell,
    /// Where each agent starts, if not all start at the base.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) starts: Option<Vec<Cell>>,
    /// How likely it is that a sensor is missed, if that happens at all.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    miss: Option<Probability>,
    /// Which sensors are missed besides.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    missed: Vec<u32>,
    /// What else the run is told, if it is.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    options: Option<Options>,
    /// The choices that make the run, where a search has found it.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    choices: Vec<u32>,
    pub(super) limits: L,
    /// The clause that the last move breaks, in a counterexample.
    pub(super) clause: Option<String>,
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

/// One team move, in the order of the robots, as it is stored.
#[derive(Clone, PartialEq, Eq, Debug, JsonSchema, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StoredMove {
    /// Its number, counted from 1.
    pub(super) step: u32,
    #[schemars(with = "String")]
    kind: Kind,
    /// One letter a robot: E, S, W, N, or `.` for a robot that stays.
    tried: String,
    /// The numbers of the robots that met a wall; the base of a chain is 1.
    blocked: Vec<usize>,
    /// Where the robots are now.
    #[schemars(with = "Vec<CellWritten>")]
    cells: Vec<Cell>,
}

/// The last line.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct StoredEnd {
    pub(super) stopped: Stopped,
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

impl StoredMove {
    /// Team move number `step`.
    pub fn new(step: u32, frame: &Frame) -> Self {
        Self {
            step,
            kind: frame.kind,
            tried: frame.steps.iter().map(|&step| letter(step)).collect(),
            blocked: (1..)
                .zip(&frame.blocked)
                .filter(|&(_, &blocked)| blocked)
                .map(|(robot, _)| robot)
                .collect(),
            cells: frame.cells.clone(),
        }
    }

    /// Whether it seeks new cells or takes a move back, in a word.
    pub const fn kind(&self) -> &'static str {
        match self.kind {
            Kind::Advance => "advance",
            Kind::Backtrack => "backtrack",
        }
    }

    /// One letter a robot.
    pub fn tried(&self) -> &str {
        &self.tried
    }

    /// The team move that it tells of robots in the cells `before`.
    ///
    /// # Errors
    /// The field that contradicts the others or `layout`, and what is wrong with it.
    pub(super) fn frame(self, before: &[Cell], layout: &Layout) -> Result<Frame, (&'static str, String)> {
        let Self { step: _, kind, tried, blocked, cells } = self;
        let robots = before.len();
        let steps: Option<Vec<Step>> = tried.chars().map(step).collect();
        let Some(steps) = steps.filter(|steps| steps.len() == robots) else {
            let what = format!("write one letter of E, S, W, N or . for each of {robots} robots");
            return Err(("tried", what));
        };
        if !blocked.is_sorted_by(|one, other| one < other)
            || blocked.iter().any(|robot| !(1..=robots).contains(robot))
        {
            return Err(("blocked", format!("name robots from 1 to {robots}, in order, each once")));
        }
        if cells.len() != robots {
            return Err(("cells", format!("there are {} cells of {robots} robots", cells.len())));
        }
        let mut is_blocked = vec![false; robots];
        for robot in blocked {
            is_blocked[robot - 1] = true;
        }
        for (robot, (&from, &to)) in before.iter().zip(&cells).enumerate() {
            let name = robot + 1;
            let is_open = |side| layout.is_open(Edge::new(from, side));
            let wrong = match (steps[robot], is_blocked[robot]) {
                (Step::Stay, true) => Some(("blocked", format!("robot {name} has tried to go nowhere"))),
                (Step::Cross(side), true) if is_open(side) => {
                    Some(("blocked", format!("nothing is in the way of robot {name} at {from}")))
                }
                (Step::Stay, false) | (Step::Cross(_), true) => {
                    (to != from).then(|| ("cells", format!("robot {name} stays in {from}")))
                }
                (Step::Cross(side), false) if !is_open(side) => {
                    Some(("tried", format!("robot {name} at {from} cannot cross a wall")))
                }
                (Step::Cross(side), false) => {
                    let due = from.beyond(side);
                    (to != due).then(|| ("cells", format!("robot {name} goes from {from} to {due}")))
                }
            };
            if let Some(wrong) = wrong {
                return Err(wrong);
            }
        }
        let blocked = is_blocked;
        Ok(Frame { kind, steps, blocked, cells })
    }
}

/// The letter of what a robot tries.
const fn letter(step: Step) -> char {
    match step {
        Step::Cross(Side::East) => 'E',
        Step::Cross(Side::South) => 'S',
        Step::Cross(Side::West) => 'W',
        Step::Cross(Side::North) => 'N',
        Step::Stay => '.',
    }
}

/// What a robot tries by this letter.
fn step(name: char) -> Option<Step> {
    let sides = Side::ALL.map(Step::Cross);
    sides.into_iter().chain([Step::Stay]).find(|&step| letter(step) == name)
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

/// A trace in the making.
#[derive(Debug)]
pub struct Writer(AtomicFile);

impl Writer {
    /// The trace of the run of `setup` in `aside`, of any team. A counterexample names the clause that it breaks.
    ///
    /// # Errors
    /// [`Problem`] if the base is not a free cell.
    pub fn new(mut aside: AtomicFile, setup: &Setup, clause: Option<ClauseId>) -> Result<Self, Problem> {
        let mut layout = Cow::Borrowed(&setup.layout);
        if layout.base() != Some(setup.base) {
            layout.to_mut().place_base(setup.base)?;
        }
        aside.append(line_of(&Header {
            format: FORMAT.to_owned(),
            version: VERSION,
            scheme: setup.scheme.name.to_owned(),
            rule: setup.rule.to_string(),
            robots: setup.robots,
            seed: setup.seed,
            base: setup.base,
            starts: setup.starts.clone(),
            miss: Some(setup.miss).filter(|miss| !miss.is_never()),
            missed: setup.missed.clone(),
            options: Some(setup.options).filter(|options| *options != Options::default()),
            choices: setup.choices.clone(),
            limits: setup.limits,
            clause: clause.map(|clause| clause.to_string()),
            layout: layout.to_string(),
        }));
        Ok(Self(aside))
    }

    /// Adds a team move.
    pub fn add(&mut self, made: &TeamMove<'_>) {
        self.0.append(line_of(&Line::Move(StoredMove::new(made.step, made.frame))));
    }

    /// Adds the end. The file has yet to be put in its place.
    pub fn end(mut self, report: &Report) -> AtomicFile {
        self.0.append(line_of(&Line::End(report.into())));
        self.0
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
    let layout: Layout = layout.parse().map_err(|problem| lines.fault(text, "\"layout\"", problem, again))?;
    if layout.base() != Some(base) {
        let what = format!("the base {base} is not where the layout draws it");
        return Err(lines.fault(text, "\"base\"", what, again));
    }
    Ok(layout)
}

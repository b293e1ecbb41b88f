//! A run as a file, one JSON object a line: a header that says what makes the run, one line for each team move, and
//! an end. A counterexample is such a file, too, and names the clause that its last move breaks. The header alone
//! decides the run, so reading a file is running it again and comparing line by line: what was cut, edited or made by
//! another rule is found where it first differs, and no more than one line is held at a time.
//!
//! ```text
//! {"format":"tautline run","version":1,"scheme":"chain","rule":"repaired","robots":2,…,"layout":"tautline layout 1\n…"}
//! {"move":{"step":1,"kind":"advance","tried":".E","blocked":[],"cells":[[1,1],[2,1]]}}
//! {"end":{"stopped":"explored","steps":8,"explored":9,"cells":9,"violations":[]}}
//! ```

pub mod lines;

use std::path::Path;

use serde::{Deserialize, Serialize};
use tautline_kernel::chain::Kind;
use tautline_kernel::ground::{Cell, Side, Step};
use tautline_proofs::chain::breach::Breach;
use tautline_proofs::run::Frame;

use crate::aside::Aside;
use crate::explore::{Limits, Report, RuleName, SchemeName, Setup, Stopped, TeamMove, Violation, explore};
use crate::fault::{Fault, Halt};
use crate::layout::generate::Probability;
use crate::layout::{Layout, MAX_FILE_BYTES};
use lines::{Lines, line_of};

/// The format of the header.
pub const FORMAT: &str = "tautline run";
const VERSION: u32 = 1;

const AGAIN: &str = "store the run again with `tautline explore --trace` or `tautline hunt`";

/// The first line.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Header {
    format: String,
    version: u32,
    scheme: SchemeName,
    rule: RuleName,
    robots: u16,
    seed: u64,
    base: Cell,
    /// Where each agent starts, if not all start at the base.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    starts: Option<Vec<Cell>>,
    /// How likely it is that a sensor is missed, if that happens at all.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    miss: Option<Probability>,
    /// Which sensors are missed besides.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    missed: Vec<u32>,
    limits: Limits,
    /// The clause that the last move breaks, in a counterexample.
    clause: Option<String>,
    /// The drawing, with the base.
    layout: String,
}

/// A later line.
#[derive(PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
enum Line {
    Move(StoredMove),
    End(StoredEnd),
}

/// One team move, in the order of the robots, as it is stored.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StoredMove {
    /// Its number, counted from 1.
    step: u32,
    kind: Kind,
    /// One letter a robot: E, S, W, N, or `.` for a robot that stays.
    tried: String,
    /// The numbers of the robots that met a wall; the base of a chain is 1.
    blocked: Vec<usize>,
    /// Where the robots are now.
    cells: Vec<Cell>,
}

/// The last line.
#[derive(PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct StoredEnd {
    stopped: Stopped,
    steps: u32,
    explored: u32,
    cells: u32,
    violations: Vec<StoredViolation>,
}

/// A clause that was broken, and in which team move.
#[derive(PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StoredViolation {
    clause: String,
    step: u32,
}

impl StoredMove {
    /// Team move number `step`.
    pub fn new(step: u32, frame: &Frame) -> Self {
        let letter = |step: &Step| match step {
            Step::Cross(Side::East) => 'E',
            Step::Cross(Side::South) => 'S',
            Step::Cross(Side::West) => 'W',
            Step::Cross(Side::North) => 'N',
            Step::Stay => '.',
        };
        Self {
            step,
            kind: frame.kind,
            tried: frame.steps.iter().map(letter).collect(),
            blocked: (1..)
                .zip(&frame.blocked)
                .filter(|&(_, &blocked)| blocked)
                .map(|(robot, _)| robot)
                .collect(),
            cells: frame.cells.clone(),
        }
    }
}

impl From<&Violation> for StoredViolation {
    fn from(violation: &Violation) -> Self {
        Self { clause: violation.breach.clause().to_owned(), step: violation.step }
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
pub struct Writer(Aside);

impl Writer {
    /// The trace of `setup` in `aside`. A counterexample names the clause that it breaks.
    pub fn new(mut aside: Aside, setup: &Setup, clause: Option<Breach>) -> Self {
        aside.append(line_of(&Header {
            format: FORMAT.to_owned(),
            version: VERSION,
            scheme: setup.scheme,
            rule: setup.rule,
            robots: setup.robots,
            seed: setup.seed,
            base: setup.base,
            starts: setup.starts.clone(),
            miss: Some(setup.miss).filter(|miss| !miss.is_never()),
            missed: setup.missed.clone(),
            limits: setup.limits,
            clause: clause.map(|breach| breach.clause().to_owned()),
            layout: setup.layout.to_string(),
        }));
        Self(aside)
    }

    /// Adds a team move.
    pub fn add(&mut self, made: &TeamMove<'_>) {
        self.0.append(line_of(&Line::Move(StoredMove::new(made.step, made.frame))));
    }

    /// Adds the end. The file has yet to be put in its place.
    pub fn end(mut self, report: &Report) -> Aside {
        self.0.append(line_of(&Line::End(report.into())));
        self.0
    }
}

/// A stored run of which the header is read.
#[derive(Debug)]
pub struct Trace {
    /// What makes the run.
    pub setup: Setup,
    /// The clause that its last move breaks, if it is a counterexample.
    pub clause: Option<Breach>,
    lines: Lines,
}

impl Trace {
    /// Reads the header of the trace at `path`.
    ///
    /// # Errors
    /// A [`Fault`] that names the line and column.
    pub fn open(path: &Path) -> Result<Self, Fault> {
        let mut lines = Lines::open(path, AGAIN)?;
        let text = lines.header(FORMAT, VERSION, MAX_FILE_BYTES)?;
        let header: Header = lines.parse(&text, AGAIN)?;
        Self::check(lines, &text, header)
    }

    /// The setup of a header.
    fn check(lines: Lines, text: &str, header: Header) -> Result<Self, Fault> {
        let Header { scheme, rule, robots, seed, base, starts, missed, limits, clause, layout, .. } = header;
        let layout: Layout =
            layout.parse().map_err(|problem| lines.fault(text, "\"layout\"", problem, AGAIN))?;
        if layout.base() != Some(base) {
            let what = format!("the base {base} is not where the layout draws it");
            return Err(lines.fault(text, "\"base\"", what, AGAIN));
        }
        let clause = clause.map(|id| {
            id.parse::<Breach>().map_err(|none| lines.fault(text, "\"clause\"", &none, none.remedy()))
        });
        let clause = clause.transpose()?;
        let miss = header.miss.unwrap_or_default();
        let setup = Setup { scheme, rule, robots, seed, layout, base, starts, miss, missed, limits };
        setup.check().map_err(|misfit| {
            lines.fault(text, &format!("\"{}\"", misfit.field()), &misfit, misfit.remedy())
        })?;
        Ok(Self { setup, clause, lines })
    }

    /// Makes the run again and compares every line. `watch` sees the team moves that are as stored.
    ///
    /// # Errors
    /// [`Halt`] with a [`Fault`] at the first line that is not as the run makes it, or what `watch` returned.
    pub fn replay(
        mut self,
        watch: &mut dyn FnMut(&TeamMove<'_>) -> Result<(), Halt>,
    ) -> Result<Report, Halt> {
        let lines = &mut self.lines;
        let report = explore(&self.setup, &mut |made| {
            lines.expect(&Line::Move(StoredMove::new(made.step, made.frame)))?;
            watch(made)
        })?;
        lines.expect(&Line::End((&report).into()))?;
        if let Some(clause) = self.clause
            && !report.violations.iter().any(|violation| violation.breach == clause)
        {
            let what = format!("the header promises that {} is broken, but it is not", clause.clause());
            return Err(Fault::in_file(lines.path(), what, AGAIN).into());
        }
        lines.end()?;
        Ok(report)
    }
}

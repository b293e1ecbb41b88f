//! A run as a file, one JSON object a line: a header that says what makes the run, one line for each team move, and
//! an end. A counterexample is such a file, too, and names the clause that its last move breaks. The header alone
//! decides the run, so reading a file is running it again and comparing line by line: what was cut, edited or made by
//! another rule is found where it first differs, and no more than one line is held at a time.
//!
//! ```text
//! {"format":"tautline run","version":1,"scheme":"chain","rule":"repaired","robots":2,…,"layout":"tautline layout…"}
//! {"move":{"step":1,"kind":"advance","tried":".E","blocked":[],"cells":[[1,1],[2,1]]}}
//! {"end":{"stopped":"explored","steps":8,"explored":9,"cells":9,"violations":[]}}
//! ```

mod foreign;
mod summary;

use std::borrow::Cow;
use std::path::{Path, PathBuf};

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use tautline_io::atomic_file::{AtomicFile, Replaceable};
use tautline_io::diagnostic::{Diagnostic, Halt};
use tautline_io::json_lines::{Lines, MAX_FILE_BYTES, line_of};
use tautline_kernel::chain::Kind;
use tautline_kernel::ground::{Cell, Edge, Side, Step};
use tautline_proofs::run::Frame;

use crate::explore::{
    Catalogue, ClauseId, Limits, OnViolation, Play, Report, RuleId, Scheme, Setup, StopReason, TeamMove,
    Violation, Watcher, explore,
};
use crate::options::Options;
use tautline_grids::chance::Probability;
use tautline_grids::layout::{ColumnRow, Layout};

pub use foreign::ForeignRun;
pub(crate) use foreign::Player;
pub use summary::Summary;

/// The header of a run that this program can make again.
type KnownHeader = Header<Limits>;

/// A stored run of which the header is read.
#[derive(Debug)]
pub enum StoredRun {
    /// One that this program can make again.
    Known(Trace),
    /// One of a scheme that this program does not know, as it was written.
    Foreign(ForeignRun),
}

/// Reads the header of the run at `path`, and all of a run of a scheme that `catalogue` does not have.
///
/// # Errors
/// A [`Diagnostic`] that names the line and column.
pub fn open(path: &Path, catalogue: Catalogue) -> Result<StoredRun, Diagnostic> {
    read(Lines::open(path, AGAIN)?, catalogue)
}

/// Reads the header of the run in a `text` that is called so, as [`open`] does that of a file.
///
/// # Errors
/// A [`Diagnostic`] that names the line and column.
pub fn open_text(name: &str, text: String, catalogue: Catalogue) -> Result<StoredRun, Diagnostic> {
    read(Lines::of(name, text, AGAIN), catalogue)
}

fn read(mut lines: Lines, catalogue: Catalogue) -> Result<StoredRun, Diagnostic> {
    /// The part of a header that tells whether the scheme is known.
    #[derive(Deserialize)]
    struct SchemeName {
        scheme: String,
    }
    let text = lines.header(FORMAT, VERSION, MAX_FILE_BYTES)?;
    let is_foreign = |SchemeName { scheme }| catalogue.scheme(&scheme).is_none();
    if serde_json::from_str(&text).is_ok_and(is_foreign) {
        return ForeignRun::read(lines, &text).map(StoredRun::Foreign);
    }
    let header: KnownHeader = lines.parse(&text, AGAIN)?;
    Trace::check(lines, &text, catalogue, header).map(StoredRun::Known)
}

/// A stored run that this program can make again, of which the header is read.
#[derive(Debug)]
pub struct Trace {
    /// The setup that makes the run.
    pub setup: Setup,
    /// The clause that its last move breaks, if it is a counterexample.
    pub clause: Option<ClauseId>,
    lines: Lines,
}

impl Trace {
    /// Reads the header of the trace at `path`.
    ///
    /// # Errors
    /// A [`Diagnostic`] that names the line and column, also if `catalogue` does not have the scheme.
    pub fn open(path: &Path, catalogue: Catalogue) -> Result<Self, Diagnostic> {
        match open(path, catalogue)? {
            StoredRun::Known(trace) => Ok(trace),
            StoredRun::Foreign(run) => {
                let scheme = run.setup().scheme.name;
                let what =
                    format!("this program does not know the scheme {scheme}: it cannot make the run again");
                let names = catalogue.names(|_| true).join(", ");
                Err(Diagnostic::in_file(path, what, format_args!("name a run of {names}")))
            }
        }
    }

    /// The setup of a header.
    fn check(
        lines: Lines,
        text: &str,
        catalogue: Catalogue,
        header: KnownHeader,
    ) -> Result<Self, Diagnostic> {
        let Some(scheme) = catalogue.scheme(&header.scheme) else {
            return Err(lines.fault(text, "scheme", "this program does not know the scheme", AGAIN));
        };
        let rule = catalogue.rule(&header.rule).map_err(|what| lines.no_line(text, "rule", &what, AGAIN))?;
        if let OnViolation::StopAt(last) = header.limits.violation
            && let Err(fault) = catalogue.clause(last.as_str())
        {
            return Err(lines.no_line(text, "violation", fault.what(), AGAIN));
        }
        let layout = drawn(&lines, text, &header.layout, header.base, AGAIN)?;
        let clause = header.clause.as_ref().map(|id| {
            let wrong = |fault: Diagnostic| lines.fault(text, "clause", fault.what(), fault.remedy());
            catalogue.clause(id).map_err(wrong)
        });
        let clause = clause.transpose()?;
        let limits = header.limits;
        let setup = Setup { limits, ..header.setup(scheme, rule, layout) };
        setup.check().map_err(|fault| {
            let field = fault.field().unwrap_or_default();
            lines.fault(text, field, fault.what(), fault.remedy())
        })?;
        Ok(Self { setup, clause, lines })
    }

    /// Makes the run again and compares every line. `watch` sees the team moves that are as stored.
    ///
    /// # Errors
    /// [`Halt`] with a [`Diagnostic`] at the first line that is not as the run makes it, or what `watch` returned.
    pub fn replay(mut self, watch: &mut Watcher<'_>) -> Result<Report, Halt> {
        let lines = &mut self.lines;
        let report = self.setup.play(&mut |made| {
            lines.expect(&Line::Move(StoredMove::new(made.step, made.frame)))?;
            watch(made)
        })?;
        lines.expect(&Line::End((&report).into()))?;
        if let Some(clause) = self.clause
            && !report.violations.iter().any(|violation| violation.clause == clause)
        {
            let what = format!("the header promises that {clause} is broken, but it is not");
            return Err(Diagnostic::in_file(lines.path(), what, AGAIN).into());
        }
        lines.end()?;
        Ok(report)
    }
}

/// The name of the file of a run that breaks `clause`. The scheme is in it unless the clause tells it.
fn file_name(scheme: &str, rule: RuleId, robots: u16, clause: ClauseId) -> String {
    let clause = clause.as_str().to_lowercase();
    let is_told = clause.rsplit_once('-').is_some_and(|(family, _)| family == scheme);
    let scheme = if is_told { String::new() } else { format!("-{scheme}") };
    format!("{clause}{scheme}-{rule}-n{robots}.jsonl")
}

/// The place in `folder` for the run of `setup`, which breaks `clause`, under a name that says so.
pub fn path_in(folder: &Path, setup: &Setup, clause: ClauseId) -> PathBuf {
    folder.join(file_name(setup.scheme.name, setup.rule, setup.robots, clause))
}

/// Writes the run of `setup`, which breaks `clause`, to a file at `path`. The file has yet to be put in its place.
///
/// # Errors
/// [`Halt`] if the setup does not fit its scheme.
pub fn store(
    path: &Path,
    setup: &Setup,
    clause: ClauseId,
    replaceable: &Replaceable,
) -> Result<(AtomicFile, Report), Halt> {
    let file = AtomicFile::late(path, replaceable);
    let mut writer = Writer::new(file, setup, Some(clause))?;
    let report = explore(setup, &mut |made| {
        writer.add(made);
        Ok(())
    })?;
    Ok((writer.end(&report), report))
}

/// The format of the header.
pub const FORMAT: &str = "tautline run";
const VERSION: u32 = 1;

/// How to make such a file again.
const AGAIN: &str = "store the run again with `tautline explore `trace`` or `tautline hunt`";

/// The first line. What the limits say is known only of the schemes of this program.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Header<L> {
    format: String,
    version: u32,
    scheme: String,
    rule: String,
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
    /// The options that the run is told, if it is told any.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    options: Option<Options>,
    /// The choices that make the run, where a search has found it.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    choices: Vec<u32>,
    limits: L,
    /// The clause that the last move breaks, in a counterexample.
    clause: Option<String>,
    /// The drawing, with the base.
    layout: String,
}

impl<L> Header<L> {
    /// The run that it makes, without limits.
    fn setup(self, scheme: Scheme, rule: RuleId, layout: Layout) -> Setup {
        let Self { robots, seed, base, starts, miss, missed, options, choices, .. } = self;
        let (miss, options) = (miss.unwrap_or_default(), options.unwrap_or_default());
        let limits = Limits::default();
        Setup { scheme, rule, robots, seed, layout, base, starts, miss, missed, options, choices, limits }
    }
}

/// A later line.
#[derive(PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
enum Line {
    Move(StoredMove),
    End(StoredEnd),
}

/// One team move, in the order of the robots, as it is stored.
#[derive(Clone, PartialEq, Eq, Debug, JsonSchema, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StoredMove {
    /// Its number, counted from 1.
    step: u32,
    #[schemars(with = "String")]
    kind: Kind,
    /// One letter a robot: E, S, W, N, or `.` for a robot that stays.
    tried: String,
    /// The numbers of the robots that met a wall; the base of a chain is 1.
    blocked: Vec<usize>,
    /// Where the robots are now.
    #[schemars(with = "Vec<ColumnRow>")]
    cells: Vec<Cell>,
}

/// The last line.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct StoredEnd {
    stopped: StopReason,
    steps: u32,
    explored: u32,
    cells: u32,
    violations: Vec<StoredViolation>,
}

/// A clause that was broken, and in which team move.
#[derive(Clone, PartialEq, Eq, Debug, JsonSchema, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StoredViolation {
    clause: String,
    step: u32,
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
    fn frame(self, before: &[Cell], layout: &Layout) -> Result<Frame, (&'static str, String)> {
        let Self { step: _, kind, tried, blocked, cells } = self;
        let robots = before.len();
        let steps = steps(&tried, robots).map_err(|what| ("tried", what))?;
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

/// The letter of what a robot tries: E, S, W, N, or `.` for one that stays.
pub const fn letter(step: Step) -> char {
    match step {
        Step::Cross(Side::East) => 'E',
        Step::Cross(Side::South) => 'S',
        Step::Cross(Side::West) => 'W',
        Step::Cross(Side::North) => 'N',
        Step::Stay => '.',
    }
}

/// The step that has this letter.
pub fn step(of: char) -> Option<Step> {
    Step::ALL.into_iter().find(|&step| letter(step) == of)
}

/// The steps of so many robots, of which `tried` has a letter for each.
///
/// # Errors
/// The words for what is to be written instead.
pub fn steps(tried: &str, robots: usize) -> Result<Vec<Step>, String> {
    let steps: Option<Vec<Step>> = tried.chars().map(step).collect();
    steps
        .filter(|steps| steps.len() == robots)
        .ok_or_else(|| format!("write one letter of E, S, W, N or . for each of {robots} robots"))
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
    /// [`Diagnostic`] if the base is not a free cell.
    pub fn new(mut file: AtomicFile, setup: &Setup, clause: Option<ClauseId>) -> Result<Self, Diagnostic> {
        file.append(header(setup, clause)?);
        Ok(Self(file))
    }

    /// Adds a team move.
    pub fn add(&mut self, made: &TeamMove<'_>) {
        self.0.append(line(made));
    }

    /// Adds the end. The file has yet to be put in its place.
    pub fn end(mut self, report: &Report) -> AtomicFile {
        self.0.append(line_of(&Line::End(report.into())));
        self.0
    }
}

/// The header of the run of `setup`. A counterexample names the clause that it breaks.
fn header(setup: &Setup, clause: Option<ClauseId>) -> Result<String, Diagnostic> {
    let mut layout = Cow::Borrowed(&setup.layout);
    if layout.base() != Some(setup.base) {
        layout.to_mut().place_base(setup.base)?;
    }
    Ok(line_of(&Header {
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
        options: Some(setup.options.clone()).filter(|options| *options != Options::default()),
        choices: setup.choices.clone(),
        limits: setup.limits,
        clause: clause.map(|clause| clause.to_string()),
        layout: layout.to_string(),
    }))
}

/// The line of a team move.
fn line(made: &TeamMove<'_>) -> String {
    line_of(&Line::Move(StoredMove::new(made.step, made.frame)))
}

/// The run of `setup` as a stored run. A counterexample names the clause that it breaks.
///
/// # Errors
/// [`Halt`] if the setup does not fit its scheme.
pub fn text(setup: &Setup, clause: Option<ClauseId>) -> Result<String, Halt> {
    let mut text = header(setup, clause)?;
    let report = explore(setup, &mut |made| {
        text += &line(made);
        Ok(())
    })?;
    Ok(text + &line_of(&Line::End((&report).into())))
}

/// The layout of a header, with the base where the header has it.
fn drawn(lines: &Lines, text: &str, layout: &str, base: Cell, again: &str) -> Result<Layout, Diagnostic> {
    let layout: Layout = layout.parse().map_err(|problem| lines.fault(text, "layout", problem, again))?;
    if layout.base() != Some(base) {
        let what = format!("the base {base} is not where the layout draws it");
        return Err(lines.fault(text, "base", what, again));
    }
    Ok(layout)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::explore::RuleName;

    #[test]
    fn runs_of_two_schemes_have_two_names() {
        let name = |scheme, clause| file_name(scheme, RuleName::Repaired.into(), 2, ClauseId::new(clause));
        assert_eq!(name("chain", "CHAIN-13"), "chain-13-repaired-n2.jsonl");
        assert_eq!(name("bricks", "BRICKS-4"), "bricks-4-repaired-n2.jsonl");
        assert_eq!(name("bricks-ants", "BRICKS-4"), "bricks-4-bricks-ants-repaired-n2.jsonl");
    }
}

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

use std::fs::File;
use std::io::{BufRead, BufReader, Read};
use std::ops::Range;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};
use tautline_kernel::chain::Kind;
use tautline_kernel::lattice::{Cell, Side, Step};
use tautline_proofs::run::{Breach, Frame};

use crate::aside::Aside;
use crate::explore::{Limits, Report, RuleName, SchemeName, Setup, Stopped, TeamMove, Violation, explore};
use crate::fault::{Fault, Halt};
use crate::layout::generate::Probability;
use crate::layout::{Layout, MAX_FILE_BYTES};

const FORMAT: &str = "tautline run";
const VERSION: u32 = 1;

/// Longer lines than those of the longest chain are refused; the header with its drawing may be longer.
const MAX_LINE_BYTES: u64 = 1 << 16;

const AGAIN: &str = "store the run again with `tautline explore --trace` or `tautline hunt`";

/// What every version of the header begins with.
#[derive(Deserialize)]
struct Magic {
    format: String,
    version: u32,
}

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

fn line_of(value: &impl Serialize) -> String {
    // Strings, numbers and lists of them can always be written.
    serde_json::to_string(value).unwrap_or_default() + "\n"
}

/// A trace in the making.
#[derive(Debug)]
pub struct Writer(Aside);

impl Writer {
    /// The trace of `setup`, to stand at `path`. A counterexample names the clause that it breaks.
    ///
    /// # Errors
    /// A [`Fault`] if nothing can be written there.
    pub fn new(path: &Path, setup: &Setup, clause: Option<Breach>) -> Result<Self, Fault> {
        let mut aside = Aside::new(path)?;
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
        }))?;
        Ok(Self(aside))
    }

    /// Adds a team move.
    ///
    /// # Errors
    /// A [`Fault`] if it cannot be written.
    pub fn add(&mut self, made: &TeamMove<'_>) -> Result<(), Fault> {
        self.0.append(line_of(&Line::Move(StoredMove::new(made.step, made.frame))))
    }

    /// Adds the end, and puts the file in its place.
    ///
    /// # Errors
    /// A [`Fault`] if that is not possible.
    pub fn end(mut self, report: &Report) -> Result<(), Fault> {
        self.0.append(line_of(&Line::End(report.into())))?;
        self.0.keep()
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
        let mut lines = Lines::open(path)?;
        let text = lines.next(MAX_FILE_BYTES)?.ok_or_else(|| {
            Fault::in_file(path, "the file is empty", format_args!("a trace begins with its header; {AGAIN}"))
        })?;
        let magic: Magic =
            lines.parse(&text, "a trace begins with its header; name a file that --trace wrote")?;
        if magic.format != FORMAT {
            let what = format!("the format is {:?}", magic.format);
            return Err(lines.fault(&text, "\"format\"", what, format_args!("name a {FORMAT:?}")));
        }
        if magic.version != VERSION {
            let what = format!("this is version {}, this program reads version {VERSION}", magic.version);
            return Err(lines.fault(&text, "\"version\"", what, AGAIN));
        }
        let header: Header = lines.parse(&text, AGAIN)?;
        lines.check(&text, header)
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
            return Err(Fault::in_file(&lines.path, what, AGAIN).into());
        }
        match lines.next(MAX_LINE_BYTES)? {
            Some(text) if text.trim().is_empty() => Ok(report),
            Some(text) => Err(lines.whole(&text, "a line after the end", "leave it out").into()),
            None => Ok(report),
        }
    }
}

/// The lines of a file, one at a time.
#[derive(Debug)]
struct Lines {
    path: PathBuf,
    input: BufReader<File>,
    /// How many were read.
    count: usize,
}

impl Lines {
    fn open(path: &Path) -> Result<Self, Fault> {
        let unreadable =
            |what: String| Fault::in_file(path, what, "name a file that --trace or `tautline hunt` wrote");
        if path.is_dir() {
            return Err(unreadable("this is a folder".to_owned()));
        }
        let file = File::open(path).map_err(|error| match error.kind() {
            std::io::ErrorKind::NotFound => unreadable("there is no such file".to_owned()),
            _ => unreadable(format!("the file cannot be read: {error}")),
        })?;
        Ok(Self { path: path.to_owned(), input: BufReader::new(file), count: 0 })
    }

    /// The next line without its end, at most `most` bytes; `None` after the last.
    fn next(&mut self, most: u64) -> Result<Option<String>, Fault> {
        let mut bytes = Vec::new();
        let read = self.input.by_ref().take(most + 1).read_until(b'\n', &mut bytes);
        let read = read.map_err(|error| {
            Fault::in_file(&self.path, format_args!("the file cannot be read: {error}"), "make it readable")
        })?;
        if read == 0 {
            return Ok(None);
        }
        self.count += 1;
        let is_long = bytes.len() as u64 > most;
        let not_text = |bytes: &[u8]| {
            let line = String::from_utf8_lossy(bytes);
            let at = line.find(char::REPLACEMENT_CHARACTER).unwrap_or_default();
            Fault::in_line(&self.path, self.count, &line, at..at + 1, "this is not UTF-8 text", AGAIN)
        };
        let mut text = String::from_utf8(bytes).map_err(|error| not_text(error.as_bytes()))?;
        if is_long {
            return Err(self.whole(&text, format_args!("this line has more than {most} bytes"), AGAIN));
        }
        text.truncate(text.trim_end_matches(['\n', '\r']).len());
        Ok(Some(text))
    }

    /// Checks that the next line is `expected`.
    fn expect(&mut self, expected: &Line) -> Result<(), Fault> {
        let wanted = line_of(expected);
        let Some(text) = self.next(MAX_LINE_BYTES)? else {
            let what =
                format!("the trace ends after line {}; here the run has {}", self.count, wanted.trim_end());
            return Err(Fault::in_file(&self.path, what, AGAIN));
        };
        let found: Line = self.parse(&text, AGAIN)?;
        if found == *expected {
            return Ok(());
        }
        let same = text.bytes().zip(wanted.bytes()).take_while(|(one, other)| one == other).count();
        let what = format!("the rule does not make this run; here it has {}", wanted.trim_end());
        Err(self.at(&text, same..same + 1, what, AGAIN))
    }

    fn parse<'a, T: Deserialize<'a>>(&self, text: &'a str, remedy: &str) -> Result<T, Fault> {
        serde_json::from_str(text).map_err(|error| {
            let message = error.to_string();
            let message = message.split(" at line ").next().unwrap_or_default();
            let message = format!("this is no line of a stored run: {message}");
            let column = error.column().saturating_sub(1);
            self.at(text, column..column + 1, message, remedy)
        })
    }

    /// The setup of a header.
    fn check(self, text: &str, header: Header) -> Result<Trace, Fault> {
        let Header { scheme, rule, robots, seed, base, starts, missed, limits, clause, layout, .. } = header;
        let layout: Layout =
            layout.parse().map_err(|problem| self.fault(text, "\"layout\"", problem, AGAIN))?;
        if layout.base() != Some(base) {
            let what = format!("the base {base} is not where the layout draws it");
            return Err(self.fault(text, "\"base\"", what, AGAIN));
        }
        let clause = clause.map(|id| {
            id.parse::<Breach>().map_err(|none| self.fault(text, "\"clause\"", &none, none.remedy()))
        });
        let clause = clause.transpose()?;
        let miss = header.miss.unwrap_or_default();
        let setup = Setup { scheme, rule, robots, seed, layout, base, starts, miss, missed, limits };
        setup.check().map_err(|misfit| {
            self.fault(text, &format!("\"{}\"", misfit.field()), &misfit, misfit.remedy())
        })?;
        Ok(Trace { setup, clause, lines: self })
    }

    /// A fault where `key` stands in the line.
    fn fault(
        &self,
        text: &str,
        key: &str,
        what: impl std::fmt::Display,
        remedy: impl std::fmt::Display,
    ) -> Fault {
        let start = text.find(key).unwrap_or_default();
        self.at(text, start..start + key.len(), what, remedy)
    }

    fn whole(&self, text: &str, what: impl std::fmt::Display, remedy: impl std::fmt::Display) -> Fault {
        self.at(text, 0..text.len(), what, remedy)
    }

    fn at(
        &self,
        text: &str,
        range: Range<usize>,
        what: impl std::fmt::Display,
        remedy: impl std::fmt::Display,
    ) -> Fault {
        Fault::in_line(&self.path, self.count, text, range, what, remedy)
    }
}

//! A rescue as a file, one JSON object a line: a header with the setting and the seed, one line for each event, and an
//! end. The header alone decides the rescue, so reading a file is doing it again and comparing line by line.
//!
//! ```text
//! {"format":"tautline rescue","version":1,"seed":8,"setting":{"rule":"published","scheme":"k-fnf","k":1,…}}
//! {"at_ns":8982984,"asks":{"robot":1,"wfr":2,"epoch":1,"hops":4}}
//! {"end":{"served":[1,1,1],"violations":["MRC-1","MRC-4"]}}
//! ```

use std::path::Path;

use serde::{Deserialize, Serialize};
use tautline_io::atomic_file::AtomicFile;
use tautline_io::diagnostic::Diagnostic;
use tautline_io::json_lines::{Lines, line_of};

use super::{Fate, Report, Setting, rescue};

/// The format of the header.
pub const FORMAT: &str = "tautline rescue";
const VERSION: u32 = 1;

const AGAIN: &str = "store the rescue again with `tautline rescue `trace``";

/// Longer headers are refused: nobody places so many robots, WFRs and obstacles.
const MAX_HEADER_BYTES: u64 = 1 << 20;

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Header {
    format: String,
    version: u32,
    seed: u64,
    setting: Setting,
}

/// The last line.
#[derive(PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Last {
    end: End,
}

#[derive(PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct End {
    /// How often robots came, WFR by WFR and event by event.
    served: Vec<u32>,
    /// The clauses that were broken, in the order in which they were.
    violations: Vec<String>,
}

impl Last {
    /// The last line of a rescue.
    pub fn of(report: &Report) -> Self {
        let visits = |fate: &Fate| match *fate {
            Fate::Served { visits, .. } => visits,
            Fate::CutOff | Fate::Unheard | Fate::Abandoned | Fate::StillToCome => 0,
        };
        let clause = |violation: &super::Violation| violation.demand.clause().to_owned();
        let served = report.fates.iter().map(visits).collect();
        Self { end: End { served, violations: report.violations.iter().map(clause).collect() } }
    }
}

/// Writes a rescue.
pub fn write(file: &mut AtomicFile, setting: &Setting, seed: u64, report: &Report) {
    let header = Header { format: FORMAT.to_owned(), version: VERSION, seed, setting: setting.clone() };
    file.append(line_of(&header));
    for logged in &report.log {
        file.append(line_of(logged));
    }
    file.append(line_of(&Last::of(report)));
}

/// Does the rescue that is stored at `path` again, and compares every line.
///
/// # Errors
/// A [`Diagnostic`] with the first line that is not as the rescue makes it.
pub fn replay(path: &Path) -> Result<(Setting, u64, Report), Diagnostic> {
    let mut lines = Lines::open(path, AGAIN)?;
    let text = lines.header(FORMAT, VERSION, MAX_HEADER_BYTES)?;
    let Header { seed, setting, .. } = lines.parse(&text, AGAIN)?;
    let report = rescue(&setting, seed)
        .map_err(|problem| lines.fault_in(&text, problem.culprit(&setting), problem, problem.remedy()))?;
    for logged in &report.log {
        lines.expect(logged)?;
    }
    lines.expect(&Last::of(&report))?;
    lines.end()?;
    Ok((setting, seed, report))
}

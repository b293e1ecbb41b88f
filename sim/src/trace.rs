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

mod format;
pub mod lines;
mod recorded;
mod summary;

use std::path::{Path, PathBuf};

use serde::Deserialize;

use crate::atomic_file::{AtomicFile, Replaceable};
use crate::diagnostic::{Diagnostic, Halt};
use crate::explore::{Catalogue, ClauseId, Limits, OnViolation, Play, Report, Setup, Watcher, explore};
use crate::layout::MAX_FILE_BYTES;
use format::{AGAIN, Header, Line, VERSION, drawn};
use lines::Lines;

pub use format::{FORMAT, StoredMove, StoredViolation, Writer};
pub use recorded::Recorded;
pub use summary::Summary;

/// The header of a run that this program can make again.
type Known = Header<Limits>;

/// A stored run of which the header is read.
#[derive(Debug)]
pub enum Stored {
    /// One that this program can make again.
    Known(Trace),
    /// One of a scheme that this program does not know, as it was written.
    Foreign(Recorded),
}

/// Reads the header of the run at `path`, and all of a run of a scheme that `catalogue` does not have.
///
/// # Errors
/// A [`Diagnostic`] that names the line and column.
pub fn open(path: &Path, catalogue: Catalogue) -> Result<Stored, Diagnostic> {
    /// What tells whether the scheme is known.
    #[derive(Deserialize)]
    struct Named {
        scheme: String,
    }
    let mut lines = Lines::open(path, AGAIN)?;
    let text = lines.header(FORMAT, VERSION, MAX_FILE_BYTES)?;
    let is_foreign = |Named { scheme }| catalogue.scheme(&scheme).is_none();
    if serde_json::from_str(&text).is_ok_and(is_foreign) {
        return Recorded::read(lines, &text).map(Stored::Foreign);
    }
    let header: Known = lines.parse(&text, AGAIN)?;
    Trace::check(lines, &text, catalogue, header).map(Stored::Known)
}

/// A stored run that this program can make again, of which the header is read.
#[derive(Debug)]
pub struct Trace {
    /// What makes the run.
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
            Stored::Known(trace) => Ok(trace),
            Stored::Foreign(run) => {
                let scheme = run.setup().scheme.name;
                let what =
                    format!("this program does not know the scheme {scheme}: it cannot make the run again");
                let names = catalogue.names(|_| true).join(", ");
                Err(Diagnostic::in_file(path, what, format_args!("name a run of {names}")))
            }
        }
    }

    /// The setup of a header.
    fn check(lines: Lines, text: &str, catalogue: Catalogue, header: Known) -> Result<Self, Diagnostic> {
        let Some(scheme) = catalogue.scheme(&header.scheme) else {
            return Err(lines.fault(text, "\"scheme\"", "this program does not know the scheme", AGAIN));
        };
        let rule = catalogue.rule(&header.rule).map_err(|what| lines.no_line(text, "rule", &what, AGAIN))?;
        if let OnViolation::StopAt(last) = header.limits.violation
            && let Err(none) = catalogue.clause(last.as_str())
        {
            return Err(lines.no_line(text, "violation", &none, AGAIN));
        }
        let layout = drawn(&lines, text, &header.layout, header.base, AGAIN)?;
        let clause = header.clause.as_ref().map(|id| {
            catalogue.clause(id).map_err(|none| lines.fault(text, "\"clause\"", &none, none.remedy()))
        });
        let clause = clause.transpose()?;
        let limits = header.limits;
        let setup = Setup { limits, ..header.setup(scheme, rule, layout) };
        setup.check().map_err(|fault| {
            let field = fault.field().unwrap_or_default();
            lines.fault(text, &format!("\"{field}\""), fault.what(), fault.remedy())
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

/// The place in `folder` of a run of `setup` that breaks `clause`. The scheme is in its name unless the clause tells
/// it.
fn path(folder: &Path, setup: &Setup, clause: ClauseId) -> PathBuf {
    let clause = clause.as_str().to_lowercase();
    let Setup { scheme, rule, robots, .. } = setup;
    let is_told = clause.rsplit_once('-').is_some_and(|(family, _)| family == scheme.name);
    let scheme = if is_told { String::new() } else { format!("-{}", scheme.name) };
    folder.join(format!("{clause}{scheme}-{rule}-n{robots}.jsonl"))
}

/// Writes the run of `setup`, which breaks `clause`, to a file in `folder` under a name that says so. The file has yet
/// to be put in its place.
///
/// # Errors
/// [`Halt`] if the setup does not fit its scheme.
pub fn store(
    folder: &Path,
    setup: &Setup,
    clause: ClauseId,
    replaceable: &Replaceable,
) -> Result<(AtomicFile, Report), Halt> {
    store_at(&path(folder, setup, clause), setup, clause, replaceable)
}

/// The same with another name.
///
/// # Errors
/// [`Halt`] if the setup does not fit its scheme.
pub fn store_at(
    path: &Path,
    setup: &Setup,
    clause: ClauseId,
    replaceable: &Replaceable,
) -> Result<(AtomicFile, Report), Halt> {
    let aside = AtomicFile::late(path, replaceable);
    let mut writer = Writer::new(aside, setup, Some(clause)).map_err(Diagnostic::from)?;
    let report = explore(setup, &mut |made| {
        writer.add(made);
        Ok(())
    })?;
    Ok((writer.end(&report), report))
}

#[cfg(test)]
mod tests {
    use tautline_kernel::ground::Cell;

    use super::*;
    use crate::explore::RuleName;
    use crate::explore::bricks::{BRICKS, BRICKS_ANTS};
    use crate::explore::chain::CHAIN;
    use crate::layout::Layout;

    #[test]
    fn runs_of_two_schemes_have_two_names() {
        let name = |scheme, clause: &'static str| {
            let layout = Layout::open(3, 3).expect("a layout");
            let setup = Setup::new(scheme, RuleName::Repaired, 2, layout, Cell::new(1, 1));
            path(Path::new("a"), &setup, ClauseId::new(clause)).display().to_string()
        };
        assert_eq!(name(&CHAIN, "CHAIN-13"), "a/chain-13-repaired-n2.jsonl");
        assert_eq!(name(&BRICKS, "BRICKS-4"), "a/bricks-4-repaired-n2.jsonl");
        assert_eq!(name(&BRICKS_ANTS, "BRICKS-4"), "a/bricks-4-bricks-ants-repaired-n2.jsonl");
    }
}

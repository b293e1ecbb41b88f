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
mod line;
mod summary;
mod team_move;

use std::borrow::Cow;
use std::path::{Path, PathBuf};

use serde::Deserialize;
use tautline_io::atomic_file::{AtomicFile, Replaceable};
use tautline_io::diagnostic::{Diagnostic, Halt};
use tautline_io::json_lines::{Lines, MAX_FILE_BYTES, line_of};

use crate::explore::{
    Catalogue, ClauseId, Limits, Look, OnViolation, Play, Report, RuleId, Setup, TeamMove, Watcher, explore,
};
use crate::options::Options;

pub use foreign::ForeignRun;
pub(crate) use foreign::{Player, check_names};
pub use line::StoredViolation;
use line::{Header, Line, drawn};
pub use summary::Summary;
use team_move::one_line;
pub use team_move::{StoredMove, blocked_numbers, letter, numbered_from, step, steps};

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
    /// The number of the first robot, if robots do not count from 1.
    numbered_from: Option<usize>,
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
        let rule = RuleId::read(&header.rule);
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
        let (limits, numbered_from) = (header.limits, header.numbered_from);
        let setup = Setup { limits, ..header.setup(scheme, rule, layout) };
        setup.check().map_err(|fault| {
            let key = key_for(text, fault.field().unwrap_or_default());
            // The field's name on the command line is no word of the file.
            let in_file = |words: &str| match (key, fault.field()) {
                (Some(key), Some(field)) if key != field => words.replace(&format!("`{field}`"), key),
                _ => words.to_owned(),
            };
            lines.fault(text, key.unwrap_or_default(), in_file(fault.what()), in_file(fault.remedy()))
        })?;
        Ok(Self { setup, clause, numbered_from, lines })
    }

    /// Makes the run again and compares every line. `watch` sees the team moves that are as stored.
    ///
    /// # Errors
    /// [`Halt`] with a [`Diagnostic`] at the first line that is not as the run makes it, or what `watch` returned.
    pub fn replay(mut self, watch: &mut Watcher<'_>) -> Result<Report, Halt> {
        let lines = &mut self.lines;
        let report = self.setup.play(&mut |made| {
            lines.expect(&Line::Move(StoredMove::numbered(made, self.numbered_from)))?;
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

/// The key of a header that tells the field of this name, which may have a unit behind it: `noise_db` of `noise-db`.
fn key_for<'t>(text: &'t str, field: &str) -> Option<&'t str> {
    let begin = format!("\"{}", field.replace('-', "_"));
    let mut keys = text.match_indices(&begin).filter(|_| !field.is_empty()).filter_map(|(at, _)| {
        let key = text[at + 1..].split('"').next()?;
        Some(key).filter(|key| text[at + 1 + key.len()..].starts_with("\":"))
    });
    keys.find(|key| matches!(key.as_bytes().get(begin.len() - 1), None | Some(b'_')))
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

/// A trace in the making.
#[derive(Debug)]
pub struct Writer {
    file: AtomicFile,
    look: Look,
}

impl Writer {
    /// The trace of the run of `setup` in `aside`, of any team. A counterexample names the clause that it breaks.
    ///
    /// # Errors
    /// [`Diagnostic`] if the base is not a free cell.
    pub fn new(file: AtomicFile, setup: &Setup, clause: Option<ClauseId>) -> Result<Self, Diagnostic> {
        Self::of_demand(file, setup, clause, "")
    }

    /// As [`Self::new`], of a rule of one's own that breaks a demand with these words; none if they are empty.
    ///
    /// # Errors
    /// [`Diagnostic`] if the base is not a free cell.
    pub fn of_demand(
        mut file: AtomicFile,
        setup: &Setup,
        clause: Option<ClauseId>,
        demand: &str,
    ) -> Result<Self, Diagnostic> {
        file.append(header(setup, clause, demand)?);
        Ok(Self { file, look: setup.scheme.look })
    }

    /// Adds a team move.
    pub fn add(&mut self, made: &TeamMove<'_>) {
        self.file.append(line(made, self.look));
    }

    /// Adds the end. The file has yet to be put in its place.
    pub fn end(mut self, report: &Report) -> AtomicFile {
        self.file.append(line_of(&Line::End(report.into())));
        self.file
    }
}

/// The header of the run of `setup`. A counterexample names the clause that it breaks, and of a rule of one's own the
/// demand in words.
fn header(setup: &Setup, clause: Option<ClauseId>, demand: &str) -> Result<String, Diagnostic> {
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
        demand: Some(one_line(demand)).filter(|demand| !demand.is_empty()),
        numbered_from: numbered_from(setup.scheme.look),
        layout: layout.to_string(),
    }))
}

/// The line of a team move.
fn line(made: &TeamMove<'_>, look: Look) -> String {
    line_of(&Line::Move(StoredMove::new(made, look)))
}

/// The run of `setup` as a stored run. A counterexample names the clause that it breaks.
///
/// # Errors
/// [`Halt`] if the setup does not fit its scheme.
pub fn text(setup: &Setup, clause: Option<ClauseId>) -> Result<String, Halt> {
    let mut text = header(setup, clause, "")?;
    let report = explore(setup, &mut |made| {
        text += &line(made, setup.scheme.look);
        Ok(())
    })?;
    Ok(text + &line_of(&Line::End((&report).into())))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::explore::RuleName;

    #[test]
    fn the_key_of_a_field_may_have_a_unit() {
        let text = r#"{"scheme":"chain","sighted":1,"noise_db":-1,"sight_cells":5,"robots":2}"#;
        let keys = ["noise-db", "sight", "robots", "seed", ""].map(|field| key_for(text, field));
        assert_eq!(keys, [Some("noise_db"), Some("sight_cells"), Some("robots"), None, None]);
    }

    #[test]
    fn runs_of_two_schemes_have_two_names() {
        let name = |scheme, clause| file_name(scheme, RuleName::Repaired.into(), 2, ClauseId::new(clause));
        assert_eq!(name("chain", "CHAIN-13"), "chain-13-repaired-n2.jsonl");
        assert_eq!(name("bricks", "BRICKS-4"), "bricks-4-repaired-n2.jsonl");
        assert_eq!(name("bricks-ants", "BRICKS-4"), "bricks-4-bricks-ants-repaired-n2.jsonl");
    }
}

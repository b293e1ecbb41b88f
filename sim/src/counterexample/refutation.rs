//! A refutation as a file, one JSON object a line: a header that names the check whose bound it lies in, one line for
//! each choice that leads to what is broken, and an end with the checksum of the lines before. Reading a file is
//! playing it again: the rule is asked at every choice, so the file is believed no farther than the rule goes along
//! with it. A run that can go on for ever has its choices marked that come again.
//!
//! ```text
//! {"format":"tautline refutation","version":1,"clause":"NOTICE-5","rule":"published","engine":"states",…,"demand":"…"}
//! {"choice":{"taken":5,"of":74}}
//! {"again":{"taken":0,"of":2}}
//! {"end":{"choices":1,"again":1,"crc32":1234}}
//! ```
//!
//! Runs of a chain that break a clause about runs are stored as [traces](crate::trace) instead.

use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};
use tautline_proofs::clause::{AnyCheck, Clause};
use tautline_proofs::decide::{Evidence, RefutationPlay};
use tautline_proofs::engine::{Choices, ScriptError};
use tautline_proofs::ledger;

use tautline_io::atomic_file::{AtomicFile, Replaceable};
use tautline_io::diagnostic::Diagnostic;
use tautline_io::json_lines::{Lines, key_of, line_of};

/// The format of the header.
pub const FORMAT: &str = "tautline refutation";
const VERSION: u32 = 1;

const AGAIN: &str = "store it again with `tautline prove `out``";

/// Longer lines are refused: no bound takes so many words.
const MAX_LINE_BYTES: u64 = 1 << 14;

/// More choices are refused: no check makes so many.
const MAX_CHOICES: usize = 1 << 20;

/// The first line.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Header {
    format: String,
    version: u32,
    clause: String,
    rule: String,
    engine: String,
    bound: String,
    demand: String,
}

/// A later line.
#[derive(Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
enum Line {
    Choice(Choice),
    Again(Choice),
    End(End),
}

/// A choice: which, and from how many.
#[derive(Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Choice {
    taken: u32,
    of: u32,
}

/// The last line.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct End {
    choices: usize,
    again: usize,
    crc32: u32,
}

/// The place in `folder` of a refutation that the check of `clause` with this number has found: clause, rule and engine
/// are its name, and a number where another check of the clause before has the same.
pub fn path(folder: &Path, clause: &Clause, check: usize) -> PathBuf {
    let name = |check: &&dyn AnyCheck| (check.rule(), check.engine());
    let checks = || clause.checks.iter().map(name);
    let (rule, engine) = checks().nth(check).unwrap_or_default();
    let before = checks().take(check).filter(|&other| other == (rule, engine)).count();
    let number = if before == 0 { String::new() } else { format!("-{}", before + 1) };
    let rule = rule.replace(' ', "-");
    folder.join(format!("{}-{rule}-{engine}{number}.jsonl", clause.id.to_lowercase()))
}

/// Writes what refutes `clause` by `check` to a file at `path`. The file has yet to be put in its place.
///
/// # Errors
/// A [`Diagnostic`] if it does not lead where it is said to lead.
pub fn store(
    path: &Path,
    clause: &Clause,
    check: &dyn AnyCheck,
    evidence: &Evidence,
    replaceable: &Replaceable,
) -> Result<AtomicFile, Diagnostic> {
    let text = text(clause, check, evidence).map_err(|unfit| {
        let what = format!("what refutes {} cannot be played again: {unfit}", clause.id);
        Diagnostic::in_file(path, what, "this is a bug of tautline: please report it")
    })?;
    let mut file = AtomicFile::late(path, replaceable);
    file.append(text);
    Ok(file)
}

/// The run that refutes `clause` by `check`, as it stands in a file.
///
/// # Errors
/// [`ScriptError`] if it does not lead where it is said to lead.
pub fn text(clause: &Clause, check: &dyn AnyCheck, evidence: &Evidence) -> Result<String, ScriptError> {
    let choices = &evidence.choices;
    let RefutationPlay { of, .. } = check.replay(choices)?;
    let mut text = line_of(&Header {
        format: FORMAT.to_owned(),
        version: VERSION,
        clause: clause.id.to_owned(),
        rule: check.rule().to_owned(),
        engine: check.engine().to_owned(),
        bound: check.bound(),
        demand: evidence.demand.to_owned(),
    });
    text.extend(lines(choices, &of));
    let (choices, again) = (choices.once.len(), choices.again.len());
    let crc32 = crc32fast::hash(text.as_bytes());
    text += &line_of(&Line::End(End { choices, again, crc32 }));
    Ok(text)
}

/// The lines of choices, each made from so many.
fn lines(choices: &Choices, of: &[u32]) -> impl Iterator<Item = String> {
    let once = choices.once.iter().map(|&taken| (Line::Choice as fn(Choice) -> Line, taken));
    let again = choices.again.iter().map(|&taken| (Line::Again as fn(Choice) -> Line, taken));
    once.chain(again).zip(of).map(|((line, taken), &of)| line_of(&line(Choice { taken, of })))
}

/// A refutation that was read, and played again.
#[derive(Debug)]
pub struct Refutation<'a> {
    /// The clause that is refuted.
    pub clause: &'a Clause,
    /// The check within whose bound it lies.
    pub check: &'a dyn AnyCheck,
    /// The demand that is broken, and how.
    pub evidence: Evidence,
}

/// Reads the refutation at `path`, and plays it again: of a clause of the ledger, or of one of `others`.
///
/// # Errors
/// A [`Diagnostic`] that names the line and what is wrong.
pub fn replay(path: &Path, others: &[&'static Clause]) -> Result<Refutation<'static>, Diagnostic> {
    let clauses = ledger::clauses().chain(others.iter().copied());
    let meant = clauses.flat_map(|clause| clause.checks.iter().map(move |&check| (clause, check)));
    replay_by(path, &meant.collect::<Vec<_>>())
}

/// A check, and the clause that it decides.
pub type Meant<'a> = (&'a Clause, &'a dyn AnyCheck);

/// Reads the refutation at `path`, and plays it again by one of these checks.
///
/// # Errors
/// A [`Diagnostic`] that names the line and what is wrong.
pub fn replay_by<'a>(path: &Path, known: &[Meant<'a>]) -> Result<Refutation<'a>, Diagnostic> {
    let mut lines = Lines::open(path, AGAIN)?;
    let first = lines.header(FORMAT, VERSION, MAX_LINE_BYTES)?;
    let header: Header = lines.parse(&first, AGAIN)?;
    let checks = find(&lines, &first, &header, known)?;
    let mut seal = crc32fast::Hasher::new();
    seal.update(format!("{first}\n").as_bytes());
    let (mut choices, mut of) = (Choices::default(), Vec::new());
    let (end, text) = loop {
        let Some(text) = lines.next(MAX_LINE_BYTES)? else {
            let what = format_args!("the file ends after line {}", 1 + of.len());
            return Err(Diagnostic::in_file(path, what, AGAIN));
        };
        let (kept, choice) = match lines.parse(&text, AGAIN)? {
            Line::Choice(_) if !choices.again.is_empty() => {
                let what = "what comes only once stands before what comes again";
                return Err(lines.fault(&text, "choice", what, AGAIN));
            }
            Line::Choice(choice) => (&mut choices.once, choice),
            Line::Again(choice) => (&mut choices.again, choice),
            Line::End(end) => break (end, text),
        };
        seal.update(format!("{text}\n").as_bytes());
        kept.push(choice.taken);
        of.push(choice.of);
        if of.len() > MAX_CHOICES {
            return Err(lines.whole(&text, format_args!("more than {MAX_CHOICES} choices"), AGAIN));
        }
    };
    lines.end()?;
    let (clause, check, evidence) = play(path, &checks, &choices, &of)?;
    if evidence.demand != header.demand {
        let what = format!("the demand that is broken is another: {:?}", evidence.demand);
        return Err(Diagnostic::in_line(path, 1, &first, key_of(&first, "demand"), what, AGAIN));
    }
    if (end.choices, end.again) != (choices.once.len(), choices.again.len()) {
        let what = format!("there are {} choices and {} again", choices.once.len(), choices.again.len());
        return Err(Diagnostic::in_line(path, 2 + of.len(), &text, key_of(&text, "choices"), what, AGAIN));
    }
    if end.crc32 != seal.finalize() {
        let what = "the lines above are not those that were written: their checksum is another";
        return Err(Diagnostic::in_line(path, 2 + of.len(), &text, key_of(&text, "crc32"), what, AGAIN));
    }
    Ok(Refutation { clause, check, evidence })
}

/// The checks that a header may mean.
fn find<'a>(
    lines: &Lines,
    text: &str,
    header: &Header,
    known: &[Meant<'a>],
) -> Result<Vec<Meant<'a>>, Diagnostic> {
    let Header { clause: id, rule: name, engine, bound, .. } = header;
    let checks: Vec<Meant<'a>> = known.iter().copied().filter(|(clause, _)| clause.id == id).collect();
    if checks.is_empty() {
        let what = format_args!("no rule that is known here has the clause {id:?}");
        let remedy =
            "play it by its own rule: `refutation::replay_by` does in Rust, and `replay_protocol` in Python";
        return Err(lines.fault(text, "clause", what, remedy));
    }
    let fitting = |key: &str, what: &str, is: &dyn Fn(&dyn AnyCheck) -> bool, checks: Vec<Meant<'a>>| {
        let fitting: Vec<Meant<'a>> = checks.into_iter().filter(|&(_, check)| is(check)).collect();
        if fitting.is_empty() {
            let what = format!("no check of {id} {what}");
            return Err(lines.fault(text, key, what, AGAIN));
        }
        Ok(fitting)
    };
    let checks = fitting("rule", &format!("is about {name:?}"), &|check| check.rule() == name, checks)?;
    let by = |check: &dyn AnyCheck| check.engine() == engine;
    let checks = fitting("engine", &format!("about it is decided by {engine:?}"), &by, checks)?;
    fitting("bound", "by it has this bound", &|check| check.bound() == *bound, checks)
}

/// Plays `choices` by the first of `checks` that goes along with them.
fn play<'a>(
    path: &Path,
    checks: &[Meant<'a>],
    choices: &Choices,
    of: &[u32],
) -> Result<(&'a Clause, &'a dyn AnyCheck, Evidence), Diagnostic> {
    let at = |at: usize, what: &str| {
        let text = lines(choices, of).nth(at).unwrap_or_default();
        let text = text.trim_end();
        Diagnostic::in_line(path, 2 + at, text, 0..text.len(), what, AGAIN)
    };
    let refused = |unfit: ScriptError| match unfit.at() {
        Some(place) => at(place, &unfit.to_string()),
        None => Diagnostic::in_file(path, format_args!("this refutes nothing: {unfit}"), AGAIN),
    };
    let mut first = None;
    for &(clause, check) in checks {
        match check.replay(choices) {
            Ok(RefutationPlay { of: asked, evidence }) => {
                let mismatch = (0..).zip(asked.iter().zip(of)).find(|(_, (asked, of))| asked != of);
                return match mismatch {
                    Some((place, (asked, _))) => {
                        Err(at(place, &format!("here there are {asked} to choose from")))
                    }
                    None => Ok((clause, check, evidence)),
                };
            }
            Err(unfit) => first = first.or(Some(unfit)),
        }
    }
    Err(refused(first.unwrap_or(ScriptError::Unbroken)))
}

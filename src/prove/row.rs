//! A row of the ledger, as it is printed and stored.

use std::path::Path;

use schemars::JsonSchema;
use serde::Serialize;
use tautline_io::atomic_file::{AtomicFile, Replaceable};
use tautline_io::diagnostic::Halt;
use tautline_proofs::clause::Variant;
use tautline_proofs::decide::{Answer, Depiction, Verdict};
use tautline_proofs::engine::states::{self, MemoryLimit};
use tautline_proofs::ledger::{self, Row};

use crate::evidence::{self, EvidenceJson, shown};
use crate::folder::keep;
use crate::output::{Output, replay_line};
use tautline_sim::counterexample::refutation;
use tautline_sim::trace;

#[derive(JsonSchema, Serialize)]
#[expect(clippy::struct_excessive_bools, reason = "each is a field of the JSON")]
pub(crate) struct Ledger {
    pub(super) clauses: Vec<Line>,
    /// Whether every verdict is the registered one, and none is missing.
    pub(super) as_registered: bool,
    /// Whether every check was decided: none is missing because a signal ended the work.
    pub(super) complete: bool,
    /// Checks that are missing.
    pub(super) left: usize,
    /// Whether a search was cut off for want of memory.
    pub(super) out_of_memory: bool,
    /// Whether a step of a check did not end.
    pub(super) unended: bool,
}

#[derive(JsonSchema, Serialize)]
pub(super) struct Line {
    id: &'static str,
    sentence: &'static str,
    rule: &'static str,
    engine: &'static str,
    bound: String,
    cases: u64,
    /// Cases that were given up undecided, which are not among them.
    given_up: u64,
    verdict: &'static str,
    registered: &'static str,
    /// The part that is machine-checked beyond the bound.
    #[serde(skip_serializing_if = "Option::is_none")]
    composition: Option<String>,
    /// Why it is registered as refuted, if not as the sentence of a paper.
    #[serde(skip_serializing_if = "Option::is_none")]
    reason: Option<&'static str>,
    counterexample: Option<EvidenceJson>,
    /// Where it is stored, if it is.
    file: Option<String>,
    mutants: Mutants,
    /// The other readings of the rule, and the verdict under each.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    readings: Vec<ReadingLine>,
    /// Why the check, or a mutant, was not decided, if a step did not end.
    #[serde(skip_serializing_if = "Option::is_none")]
    undecided: Option<String>,
    /// The time that threads spent on it and its mutants. What several checks share is counted for the first of them.
    seconds: f64,
}

#[derive(JsonSchema, Serialize)]
struct ReadingLine {
    name: &'static str,
    verdict: &'static str,
    registered: &'static str,
}

#[derive(JsonSchema, Serialize)]
struct Mutants {
    killed: usize,
    of: usize,
    survived: Vec<&'static str>,
}

pub(super) fn line((row, file): (&Row, &Option<String>)) -> Result<Line, Halt> {
    let Row { clause, check, ref decision, undecided, seconds, .. } = *row;
    let evidence = decision.counterexample.as_ref();
    Ok(Line {
        id: clause.id,
        sentence: clause.sentence,
        rule: check.rule(),
        engine: check.engine(),
        bound: check.bound(),
        cases: decision.cases,
        given_up: decision.given_up,
        verdict: decision.verdict.word(),
        registered: check.expected().word(),
        composition: row.composition(),
        reason: check.reason(),
        counterexample: evidence.map(|evidence| shown(check, evidence)).transpose()?,
        file: file.clone(),
        mutants: Mutants {
            killed: decision.killed.len(),
            of: decision.killed.len() + decision.survived.len(),
            survived: decision.survived.clone(),
        },
        readings: readings(row),
        undecided: undecided.map(|undecided| undecided.to_string()),
        seconds,
    })
}

/// Stores what refutes the clause of a row in `folder`: the place of the file.
pub(crate) fn stored(
    row: &Row,
    folder: &Path,
    replaceable: &Replaceable,
    out: &mut Output,
) -> Result<Option<String>, Halt> {
    let Row { clause, number, check, ref decision, .. } = *row;
    let Some(evidence) = &decision.counterexample else { return Ok(None) };
    let path = refutation::path(folder, clause, number);
    let run = match &evidence.seen {
        Depiction::Robots(run) => evidence::setup(check, run)?.zip(evidence::breach(run)),
        Depiction::Choices | Depiction::Story(_) | Depiction::Agents(_) | Depiction::Messages { .. } => None,
    };
    let file = match run {
        Some((setup, breach)) => trace::store(&path, &setup, breach, replaceable)?.0,
        None => refutation::store(&path, clause, check, evidence, replaceable)?,
    };
    Ok(keep(file, out))
}

/// Stores the proof of a row in `folder`, or the certificate of what its search has exhausted.
pub(super) fn certify(
    (row, memory): (&Row, &MemoryLimit),
    folder: &Path,
    replaceable: &Replaceable,
    out: &mut Output,
) {
    let Row { clause, number, check, .. } = *row;
    let limits = states::Limits { memory: memory.memory(), ..states::Limits::NONE };
    let (path, content) = if let Some(terms) = check.certificate() {
        let name = format!("{}_{}", clause.id, check.rule()).replace('-', "_") + ".v";
        (folder.join(name), terms.map(String::into_bytes))
    } else {
        let path = refutation::path(folder, clause, number).with_extension("cert");
        (path, ledger::certificate(clause, number, limits))
    };
    match content {
        Err(why) => tracing::warn!("{} as {} gets no certificate: {why}", clause.id, check.rule()),
        Ok(content) => {
            let mut file = AtomicFile::late(&path, replaceable);
            file.append(content);
            keep(file, out);
        }
    }
}

/// The story of a counterexample, and where it is stored.
pub(crate) fn story(row: &Row, file: Option<&str>) -> Result<String, Halt> {
    let Some(evidence) = &row.decision.counterexample else { return Ok(String::new()) };
    let story = evidence::story(row.clause, row.check, evidence)?;
    let file = file.map(|file| format!("\n{}", replay_line(file)));
    Ok(format!("\n{story}{}", file.unwrap_or_default()))
}

/// The variants that did not come out as they are registered.
pub(super) fn of_variants(row: &Row) -> Vec<String> {
    let mutants = row.decision.survived.iter().map(|mutant| format!("the mutant {mutant:?} survives"));
    let others = readings(row).into_iter().filter(|reading| reading.verdict != reading.registered);
    let others = others.map(|ReadingLine { name, verdict, registered }| {
        format!("under the reading {name:?} {verdict}, registered as {registered}")
    });
    mutants.chain(others).collect()
}

/// The other readings of the rule of a row.
fn readings(row: &Row) -> Vec<ReadingLine> {
    let registered = row.check.variants().into_iter().filter_map(Variant::reading);
    let line = |((name, registered), answer): ((&'static str, Verdict), &Answer)| ReadingLine {
        name,
        verdict: answer.verdict.word(),
        registered: registered.word(),
    };
    registered.zip(&row.decision.readings).map(line).collect()
}

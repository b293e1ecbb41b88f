//! `tautline check`: certificates of checks that hold, examined without a search.

use std::fmt::Write;
use std::path::{Path, PathBuf};

use clap::Args;
use schemars::JsonSchema;
use serde::Serialize;
use tautline_io::diagnostic::{Diagnostic, Halt};
use tautline_proofs::ledger::{self, Examination, examine};
use tautline_proofs::plural::counted;

use super::exit::Exit;
use super::judge::ground::bytes;
use super::options::{Format, FormatArgs};
use super::output::Output;

const EXAMPLES: &str = "\
Examples:
  tautline check certificates/kit-2-repaired-states.cert
  tautline check certificates/*.cert --format json

Write certificates with: tautline prove KIT-2 --certificate certificates";

/// The largest certificate that is read: of the states in it a checker keeps up to 32 times as many bytes.
const MOST_BYTES: u64 = 1 << 28;

/// Check certificates that `prove --certificate` wrote: does each show that its clause holds?
///
/// The checker shares no code with the search. docs/certificates.md says what it looks at.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct Check {
    /// The certificates.
    #[arg(value_name = "FILE", required = true)]
    files: Vec<PathBuf>,
    #[command(flatten)]
    format: FormatArgs,
}

#[derive(JsonSchema, Serialize)]
pub(super) struct CheckJson {
    certificates: Vec<CertificateJson>,
}

#[derive(JsonSchema, Serialize)]
struct CertificateJson {
    file: String,
    clause: &'static str,
    sentence: &'static str,
    rule: &'static str,
    bound: String,
    /// Systems, each of which has a section in the file.
    systems: usize,
    accepted: Option<AcceptanceJson>,
    refused: Option<RefusalJson>,
}

#[derive(JsonSchema, Serialize)]
struct AcceptanceJson {
    states: u64,
    steps: u64,
    /// States from which no step is bound to be made.
    ends: u64,
}

#[derive(JsonSchema, Serialize)]
struct RefusalJson {
    /// The number of the section, from 1.
    section: usize,
    reason: String,
}

impl CertificateJson {
    fn of(file: &Path, examined: Examination) -> Self {
        let Examination { clause, number, systems, outcome } = examined;
        let check = clause.checks[number];
        let (accepted, refused) = match outcome {
            Ok(counts) => {
                (Some(AcceptanceJson { states: counts.states, steps: counts.steps, ends: counts.ends }), None)
            }
            Err((section, refusal)) => (None, Some(RefusalJson { section, reason: refusal.to_string() })),
        };
        let (clause, sentence, rule, bound) = (clause.id, clause.sentence, check.rule(), check.bound());
        Self { file: file.display().to_string(), clause, sentence, rule, bound, systems, accepted, refused }
    }

    fn text(&self) -> String {
        let Self { file, clause, sentence, rule, bound, systems, accepted, refused } = self;
        let mut text = match (accepted, refused) {
            (Some(AcceptanceJson { states, steps, ends }), _) => {
                let counts = [counted(*states, "state"), counted(*steps, "step"), counted(*ends, "end")];
                format!("{file}: accepted: {} in {}\n", counts.join(", "), counted(*systems as u64, "system"))
            }
            (None, Some(RefusalJson { section, reason })) => {
                format!("{file}: refused: section {section}, {reason}\n")
            }
            (None, None) => String::new(),
        };
        // Writing to a string cannot fail.
        let _ = write!(text, "  {clause} as {rule}: {sentence}\n{}", ledger::indented(2, bound));
        text
    }
}

impl Check {
    pub(super) fn run(&self, out: &mut Output) -> Result<Exit, Halt> {
        let check = |file: &PathBuf| -> Result<CertificateJson, Diagnostic> {
            let clauses = ledger::clauses().chain(tautline_library::clauses());
            let bytes = bytes(file, MOST_BYTES, "name the certificate of a smaller search")?;
            let examined = examine(&bytes, clauses).map_err(|mismatch| {
                let remedy =
                    "name a file that `tautline prove --certificate` of this version wrote, as it wrote it";
                Diagnostic::in_file(file, mismatch, remedy)
            })?;
            Ok(CertificateJson::of(file, examined))
        };
        let mut certificates = Vec::new();
        for file in &self.files {
            let certificate = check(file)?;
            if self.format.format == Format::Text {
                out.text(certificate.text())?;
            }
            certificates.push(certificate);
        }
        let is_refused = certificates.iter().any(|one| one.refused.is_some());
        if self.format.format == Format::Json {
            out.json(&CheckJson { certificates })?;
        }
        Ok(if is_refused { Exit::Violation } else { Exit::Expected })
    }
}

//! What a CI shows of a command: annotations, as GitHub reads them on stdout, and a JUnit file, as most others read it.

use std::fmt::Write;
use std::time::Duration;

use clap::{Args, ValueEnum};
use quick_junit::{NonSuccessKind, Report, TestCase, TestCaseStatus, TestSuite};
use tautline_sim::diagnostic::Diagnostic;

/// What stdout gets of a command that decides something.
#[derive(Clone, Copy, PartialEq, Eq, Debug, ValueEnum)]
pub(super) enum Format {
    /// For people.
    Text,
    /// One JSON object, with its schema_version.
    Json,
    /// Annotations for GitHub: one for each verdict that is not as expected.
    Github,
    /// A JUnit file: one test case for each verdict.
    Junit,
}

impl Format {
    /// The same where nothing is decided.
    ///
    /// # Errors
    /// A [`Diagnostic`] if only a decision has this format.
    pub(super) fn plain(self) -> Result<super::Format, Diagnostic> {
        match self {
            Self::Text => Ok(super::Format::Text),
            Self::Json => Ok(super::Format::Json),
            Self::Github | Self::Junit => {
                let remedy = "give --format text or json here, and this one where the verdict is";
                Err(Diagnostic::usage("nothing is decided here that a CI could show", remedy))
            }
        }
    }
}

#[derive(Debug, Args)]
pub(super) struct FormatArgs {
    /// What stdout gets.
    #[arg(long, value_enum, default_value = "text")]
    pub(super) format: Format,
}

/// One thing that was decided.
pub(super) struct Case {
    /// What it is of: a family of clauses, or a scheme.
    pub(super) class: String,
    /// What was decided.
    pub(super) name: String,
    pub(super) outcome: Outcome,
    /// How long it took, if that was measured.
    pub(super) seconds: Option<f64>,
}

/// What came of it.
pub(super) enum Outcome {
    /// As expected.
    Expected,
    /// The work was ended before its bound.
    Unfinished(String),
    /// Not as expected: what is so, in a line, and what there is to see.
    Broken(String, String),
}

/// As annotations: an error for what is not as expected, a warning for what was ended, and `summary` as a notice.
pub(super) fn github(findings: &[Case], summary: &str) -> String {
    let mut text = String::new();
    for Case { name, outcome, .. } in findings {
        // Writing to a string cannot fail.
        let _ = match outcome {
            Outcome::Expected => Ok(()),
            Outcome::Unfinished(why) => {
                writeln!(text, "::warning title={}::{}", property(name), message(why))
            }
            Outcome::Broken(what, story) => {
                let said = format!("{what}\n{story}");
                writeln!(text, "::error title={}::{}", property(name), message(said.trim_end()))
            }
        };
    }
    let _ = writeln!(text, "::notice title=tautline::{}", message(summary.trim()));
    text
}

/// The text of an annotation.
fn message(text: &str) -> String {
    text.replace('%', "%25").replace('\r', "%0D").replace('\n', "%0A")
}

/// A property of an annotation.
fn property(text: &str) -> String {
    message(text).replace(':', "%3A").replace(',', "%2C")
}

/// As a JUnit file, `command` being the name of its suite.
///
/// # Errors
/// A [`Diagnostic`] if it cannot be written.
pub(super) fn junit(command: &str, findings: &[Case]) -> Result<String, Diagnostic> {
    let mut suite = TestSuite::new(format!("tautline {command}"));
    suite.add_test_cases(findings.iter().map(|Case { class, name, outcome, seconds }| {
        let status = match outcome {
            Outcome::Expected => TestCaseStatus::success(),
            Outcome::Unfinished(why) => {
                let mut status = TestCaseStatus::skipped();
                status.set_message(why.as_str());
                status
            }
            Outcome::Broken(what, story) => {
                let mut status = TestCaseStatus::non_success(NonSuccessKind::Failure);
                status.set_message(what.as_str());
                status.set_description(story.as_str());
                status
            }
        };
        let mut case = TestCase::new(name.as_str(), status);
        case.set_classname(class.as_str());
        if let Some(time) = seconds.and_then(|seconds| Duration::try_from_secs_f64(seconds).ok()) {
            case.set_time(time);
        }
        case
    }));
    let mut report = Report::new("tautline");
    report.add_test_suite(suite);
    let text = report.to_string();
    text.map_err(|error| Diagnostic::usage(error, "report it: this is a bug of tautline"))
}

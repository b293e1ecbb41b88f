//! The findings of a command as a CI shows them: annotations, as GitHub reads them on stdout, and a JUnit file, as
//! most others read it.

use std::fmt::Write;

use clap::{Args, ValueEnum};
use tautline_io::diagnostic::Diagnostic;
use tautline_io::svg::escaped;

use super::{ascii, options};

/// The format of a command that decides something.
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
    /// This format where nothing is decided.
    ///
    /// # Errors
    /// A [`Diagnostic`] if only a decision has this format.
    pub(super) fn plain(self) -> Result<options::Format, Diagnostic> {
        match self {
            Self::Text => Ok(options::Format::Text),
            Self::Json => Ok(options::Format::Json),
            Self::Github | Self::Junit => {
                let remedy = "give --format text or json here, and this one where the verdict is";
                Err(Diagnostic::usage("nothing is decided here that a CI could show", remedy))
            }
        }
    }
}

#[derive(Clone, Copy, Debug, Args)]
pub(super) struct FormatArgs {
    /// How the result is printed.
    #[arg(long, value_enum, default_value = "text")]
    pub(super) format: Format,
}

/// One thing that was decided.
pub(super) struct Case {
    /// The family of clauses, or the scheme, that it is of.
    pub(super) class: String,
    /// The name of what was decided.
    pub(super) name: String,
    pub(super) outcome: Outcome,
    /// How long it took, if that was measured.
    pub(super) seconds: Option<f64>,
}

impl Case {
    /// The rest of a work that a signal has ended.
    pub(super) fn left(why: String) -> Self {
        let (class, name) = ("tautline".to_owned(), "the checks that are left".to_owned());
        Self { class, name, outcome: Outcome::Unfinished(why), seconds: None }
    }
}

/// The outcome of a decision.
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
pub(super) fn junit(command: &str, findings: &[Case]) -> String {
    let count = |is: fn(&Outcome) -> bool| findings.iter().filter(|case| is(&case.outcome)).count();
    let tests = findings.len();
    let skipped = count(|outcome| matches!(outcome, Outcome::Unfinished(_)));
    let failures = count(|outcome| matches!(outcome, Outcome::Broken(..)));
    let cases: String = findings.iter().map(case).collect();
    ascii::xml(format!(
        r#"<?xml version="1.0" encoding="UTF-8"?>
<testsuites name="tautline" tests="{tests}" skipped="{skipped}" failures="{failures}" errors="0">
    <testsuite name="tautline {command}" tests="{tests}" skipped="{skipped}" errors="0" failures="{failures}">
{cases}    </testsuite>
</testsuites>
"#
    ))
}

/// As a test case of a JUnit file.
fn case(Case { class, name, outcome, seconds }: &Case) -> String {
    let time = seconds.map_or(String::new(), |seconds| format!(r#" time="{seconds:.3}""#));
    let within = match outcome {
        Outcome::Expected => None,
        Outcome::Unfinished(why) => Some(format!(r#"<skipped message="{}"/>"#, escaped(why))),
        Outcome::Broken(what, story) => {
            let story: Vec<String> = story.split('\n').map(escaped).collect();
            Some(format!(r#"<failure message="{}">{}</failure>"#, escaped(what), story.join("\n")))
        }
    };
    let case = format!(r#"        <testcase name="{}" classname="{}"{time}"#, escaped(name), escaped(class));
    match within {
        None => case + "/>\n",
        Some(within) => format!("{case}>\n            {within}\n        </testcase>\n"),
    }
}

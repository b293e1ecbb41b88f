//! A minimal run, and why there is none.

use std::collections::BTreeSet;
use std::fmt;

use tautline_io::diagnostic::Halt;
use tautline_proofs::plural::listed;

use super::shrink::Extent;
use crate::explore::{ClauseId, Report, Setup, Violation};

/// A run in which nothing can go.
#[derive(Clone, Debug)]
pub struct Minimal {
    /// The setup that makes it. The run stops at the team move that breaks the clause; another clause may be broken
    /// before.
    pub setup: Setup,
    /// The clause that its last team move breaks.
    pub clause: ClauseId,
    /// How large the run was that it is made from.
    pub before: Extent,
    /// How large it is.
    pub after: Extent,
    /// Runs that were made to find it.
    pub runs: u32,
}

/// Why there is nothing to minimise.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Refusal {
    /// The run breaks no clause.
    Unbroken,
    /// The run is made by the choices of a search, and its rule is not hunted.
    Chosen,
    /// The run breaks other clauses than the one asked for.
    Otherwise {
        /// The clause that was asked for.
        asked: ClauseId,
        /// The clauses that are broken.
        broken: Vec<ClauseId>,
    },
}

impl Refusal {
    /// The fault and its remedy.
    fn words(&self) -> (String, String) {
        let (what, remedy) = match self {
            Self::Unbroken => (
                "this run breaks no clause: there is nothing to minimise",
                "name a counterexample of `tautline hunt`, or a trace of a run that ended `tautline explore` with \
                 exit code 1",
            ),
            Self::Chosen => (
                "a search has found this run, and nothing searches for a smaller one",
                "draw it with `tautline replay`",
            ),
            Self::Otherwise { asked, broken } => {
                let what = format!("this run does not break {asked}: there is nothing to minimise");
                return (what, format!("it breaks {}", listed(broken)));
            }
        };
        (what.to_owned(), remedy.to_owned())
    }

    /// The remedy.
    pub fn remedy(&self) -> String {
        self.words().1
    }
}

impl fmt::Display for Refusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.words().0)
    }
}

impl std::error::Error for Refusal {}

/// Why nothing was minimised.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Failure {
    /// There is nothing to minimise.
    Refused(Refusal),
    /// The work was ended.
    Halted(Halt),
}

impl From<Refusal> for Failure {
    fn from(refused: Refusal) -> Self {
        Self::Refused(refused)
    }
}

impl From<Halt> for Failure {
    fn from(halt: Halt) -> Self {
        Self::Halted(halt)
    }
}

/// The first violation of what is `asked`, if something is.
pub(super) fn first_violation(report: &Report, asked: Option<ClauseId>) -> Result<Violation, Refusal> {
    let mut violations = report.violations.iter();
    let found = violations.find(|violation| asked.is_none_or(|asked| violation.clause == asked));
    found.copied().ok_or_else(|| match asked {
        Some(asked) if !report.violations.is_empty() => {
            let broken: BTreeSet<ClauseId> =
                report.violations.iter().map(|violation| violation.clause).collect();
            Refusal::Otherwise { asked, broken: broken.into_iter().collect() }
        }
        Some(_) | None => Refusal::Unbroken,
    })
}

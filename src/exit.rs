//! How a command ended, and the exit codes.

use std::process::ExitCode;

/// How a command ended. Where several are so, the last of them in this order is told.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub(crate) enum Exit {
    /// As expected.
    Expected,
    /// A violation was found.
    Violation,
    /// A budget or the user ended the work before its bound.
    Unfinished,
    /// A merge has gaps.
    Gaps,
    /// Wrong usage or bad input, or a file could not be stored.
    Diagnostic,
    /// A bug of ours.
    Bug,
}

impl Exit {
    /// The exit code of the process.
    pub(crate) const fn code(self) -> u8 {
        match self {
            Self::Expected => 0,
            Self::Violation => 1,
            Self::Diagnostic => 2,
            Self::Unfinished => 3,
            Self::Gaps => 4,
            Self::Bug => 70,
        }
    }
}

impl From<Exit> for ExitCode {
    fn from(exit: Exit) -> Self {
        Self::from(exit.code())
    }
}

/// The meaning of the exit codes, for the help, the manual pages and the documents.
pub(crate) const EXIT_CODES: &str = "0 as expected · 1 a violation was found · 2 wrong usage or bad input, or a file \
                          could not be stored · 3 a budget, Ctrl-C, SIGTERM or SIGHUP ended the work before \
                          its bound, also if something was found by then, or a log does not say enough · 4 a \
                          merge has gaps · 70 a bug of ours. Where several apply, the code is the first of \
                          70, 2, 4, 3, 1, 0. With --exit-zero 1 is 0.";

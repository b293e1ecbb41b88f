//! Helpers for the tests of several schemes.

use std::ops::ControlFlow;

use tautline_io::diagnostic::Diagnostic;
use tautline_sim::explore::hunt::{Far, Hunter};

/// Nobody watches; the hunts of these tests keep no file.
pub(crate) struct Unwatched;

impl Hunter for Unwatched {
    fn hears(&mut self, _: Far<'_>) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }

    fn is_left_out(&mut self, fault: &Diagnostic) {
        panic!("{fault}");
    }
}

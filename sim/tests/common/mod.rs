//! Helpers for the tests of several schemes.

use std::ops::ControlFlow;

use tautline_grids::layout::{Generator, Layout};
use tautline_io::diagnostic::Diagnostic;
use tautline_sim::explore::explore;
use tautline_sim::explore::hunt::{Exhibit, Far, HuntReport, Hunter};

/// The layout of this seed that a description stands for.
pub(crate) fn generated(description: &str, seed: u64) -> Layout {
    description.parse::<Generator>().expect("a generator").generate(seed).expect("a layout")
}

/// Runs each counterexample that has a file once more, checks that it breaks its clause, and counts them.
pub(crate) fn run_again(hunted: &HuntReport) -> usize {
    let stored = hunted.found.iter().filter_map(|finding| match finding.shown {
        Exhibit::Run(clause) | Exhibit::Story(clause, _) => Some((clause, finding)),
        Exhibit::Endless | Exhibit::Told(_) => None,
    });
    let mut count = 0;
    for (clause, finding) in stored {
        let report = explore(&finding.setup, &mut |_| Ok(())).expect("a run");
        let is_broken = report.violations.iter().any(|violation| violation.clause == clause);
        assert!(is_broken, "{clause}: {:?}", report.violations);
        count += 1;
    }
    count
}

/// Nobody watches; the hunts of these tests keep no file.
pub(crate) struct NoWatcher;

impl Hunter for NoWatcher {
    fn hears(&mut self, _: Far<'_>) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }

    fn is_left_out(&mut self, fault: &Diagnostic) {
        panic!("{fault}");
    }
}

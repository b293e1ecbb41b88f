//! Progress on stderr, on a terminal only.

use std::ops::ControlFlow;

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use tautline_proofs::search::Progress;

use super::interrupt;

const STYLE: &str = "{prefix} {wide_bar} {percent} % {msg}";

/// A bar for work of `of` parts.
pub(super) fn bar(prefix: impl Into<String>, of: u64) -> ProgressBar {
    let bar = ProgressBar::with_draw_target(Some(of), ProgressDrawTarget::stderr());
    bar.set_style(ProgressStyle::with_template(STYLE).unwrap_or_else(|_| ProgressStyle::default_bar()));
    bar.with_prefix(prefix.into())
}

/// Shows how far a search is, and ends it when the user wants that.
pub(super) fn show(bar: &ProgressBar, progress: Progress) -> ControlFlow<()> {
    bar.set_length(progress.of);
    bar.set_position(progress.done);
    bar.set_message(format!("{} runs, {} moves", progress.runs, progress.moves));
    if interrupt::is_requested() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
}

/// A sign of life for work of unknown length.
pub(super) fn spinner(prefix: impl Into<String>) -> ProgressBar {
    let bar = ProgressBar::with_draw_target(None, ProgressDrawTarget::stderr());
    bar.set_style(
        ProgressStyle::with_template("{prefix} {spinner} {msg}")
            .unwrap_or_else(|_| ProgressStyle::default_spinner()),
    );
    bar.with_prefix(prefix.into())
}

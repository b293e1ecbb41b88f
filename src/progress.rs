//! Progress on stderr, on a terminal only.

use std::ops::ControlFlow;
use std::time::{Duration, Instant};

use indicatif::{HumanCount, HumanDuration, ProgressBar, ProgressDrawTarget, ProgressStyle};
use tautline_io::diagnostic::{Halt, Watch};
use tautline_proofs::engine::tree::Progress;

use super::interrupt;

const STYLE: &str = "{prefix} {wide_bar} {percent} % {msg}";

/// A bar for work of `of` parts.
pub(super) fn bar(prefix: impl Into<String>, of: u64) -> ProgressBar {
    let bar = ProgressBar::with_draw_target(Some(of), ProgressDrawTarget::stderr());
    bar.set_style(ProgressStyle::with_template(STYLE).unwrap_or_else(|_| ProgressStyle::default_bar()));
    bar.with_prefix(prefix.into())
}

/// Does work of `of` parts under a bar. After a signal, no other part is begun.
pub(super) fn during<T>(
    prefix: impl Into<String>,
    of: u64,
    work: impl FnOnce(&Watch<'_>) -> Result<T, Halt>,
) -> Result<T, Halt> {
    let (prefix, start) = (prefix.into(), Instant::now());
    let bar = bar(prefix.clone(), of);
    interrupt::defer();
    let done = work(&|| {
        interrupt::check()?;
        bar.inc(1);
        Ok(())
    });
    bar.finish_and_clear();
    tracing::info!("{prefix}: {} of {of} in {:.3} s", bar.position(), start.elapsed().as_secs_f64());
    done
}

/// Shows how far a search is, and ends it when the user wants that. What is left is estimated.
#[expect(clippy::cast_precision_loss, reason = "an estimate")]
pub(super) fn show(bar: &ProgressBar, progress: &Progress<'_>) -> ControlFlow<()> {
    let Progress { runs, moves, levels, max_walls, edges: _, wave: _ } = *progress;
    let expected = progress.expected_moves().unwrap_or(0.0).max(moves as f64);
    bar.set_length(expected as u64);
    bar.set_position(moves);
    let rate = bar.per_sec();
    let rest = Duration::try_from_secs_f64((expected - moves as f64) / rate)
        .map_or_else(|_| String::new(), |rest| format!(", about {} left", HumanDuration(rest)));
    bar.set_message(format!(
        "walls {} of {max_walls}, runs {}, moves {}, {}/s{rest}",
        levels.len().min(max_walls as usize),
        HumanCount(runs),
        HumanCount(moves),
        HumanCount(rate as u64),
    ));
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

//! Progress on stderr, on a terminal only.

use std::ops::ControlFlow;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

use indicatif::{HumanCount, HumanDuration, ProgressBar, ProgressDrawTarget, ProgressStyle};
use tautline_io::diagnostic::{Halt, Watch};
use tautline_proofs::engine::tree::Progress;
use tautline_proofs::ledger::{Hear, News};

use super::{ascii, interrupt};

const STYLE: &str = "{prefix} {wide_bar} {percent} % {msg}";

fn style(template: &str, default: fn() -> ProgressStyle) -> ProgressStyle {
    let style = ProgressStyle::with_template(template).unwrap_or_else(|_| default());
    if ascii::is_asked() { style.progress_chars("#- ").tick_chars("|/-\\ ") } else { style }
}

/// A bar for work of `of` parts.
pub(super) fn bar(prefix: impl Into<String>, of: u64) -> ProgressBar {
    let bar = ProgressBar::with_draw_target(Some(of), ProgressDrawTarget::stderr());
    bar.set_style(style(STYLE, ProgressStyle::default_bar));
    bar.with_prefix(prefix.into())
}

/// Does work of `of` parts under a bar. After a signal, no other part is begun.
pub(super) fn during<T>(
    prefix: impl Into<String>,
    of: u64,
    work: impl FnOnce(&Watch<'_>) -> Result<T, Halt>,
) -> Result<T, Halt> {
    let (prefix, start, begun) = (prefix.into(), Instant::now(), AtomicU64::new(0));
    let bar = bar(prefix.clone(), of);
    interrupt::defer();
    let done = work(&|| {
        interrupt::check()?;
        bar.inc(1);
        tell_of_part(&prefix, begun.fetch_add(1, Ordering::Relaxed) + 1, of);
        Ok(())
    });
    bar.finish_and_clear();
    tracing::info!("{prefix}: {} of {of} in {:.3} s", bar.position(), start.elapsed().as_secs_f64());
    done
}

/// Shows how far checks are on `bar`, and ends all of them after a signal. A step that does not end is told of.
pub(super) fn hears(bar: &ProgressBar, shown: Shown, patience_s: u32) -> Hear {
    let seen = bar.clone();
    Arc::new(move |heard: News<'_>| {
        match heard {
            News::Search(progress) => {
                if shown == Shown::Search {
                    // A search that a signal ends would be an answer; all of them are ended together.
                    let _ = show(&seen, progress);
                }
            }
            News::Second if interrupt::is_requested() => return ControlFlow::Break(()),
            News::Second => {}
            News::Done { clause, jobs, of } => {
                seen.set_length(of as u64);
                seen.set_position(jobs as u64);
                seen.set_message(format!("{jobs} of {of}, the last of {clause}"));
                tracing::debug!("{jobs} of {of} jobs are done, the last of {clause}");
            }
            News::Unended { clause } => {
                tracing::warn!("a step of {clause} has not ended within {patience_s} s");
            }
        }
        ControlFlow::Continue(())
    })
}

/// The part of the work that a bar shows.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Shown {
    /// How many checks are done.
    Checks,
    /// How far the search of the one check is.
    Search,
}

/// Says in the log how far work is: whenever twice as many parts are under way or done as the last time.
pub(super) fn tell_of_part(prefix: &str, parts: u64, of: u64) {
    if parts.is_power_of_two() {
        tracing::debug!("{prefix}: {parts} of {of}");
    }
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
    bar.set_style(style("{prefix} {spinner} {msg}", ProgressStyle::default_spinner));
    bar.with_prefix(prefix.into())
}

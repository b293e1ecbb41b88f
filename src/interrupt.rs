//! Signals that end the work: Ctrl-C, SIGTERM and, unless the process was started to ignore it, SIGHUP. The first ends
//! the process at once, unless the work in hand has results to keep; then it ends the work, and the second the process.
//! One that comes right behind the first is the same: `timeout` sends it to the process and to its group. No unfinished
//! file stays.

use super::exit::Exit;
use std::fmt;
use std::io::{self, IsTerminal, Write};
use std::process;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use tautline_io::atomic_file;
use tautline_io::diagnostic::Halt;

static REQUESTED: AtomicBool = AtomicBool::new(false);
static DEFERRED: AtomicBool = AtomicBool::new(false);
/// When the first signal came.
static FIRST: OnceLock<Instant> = OnceLock::new();

/// A signal that comes so soon behind the first is the same.
const SAME: Duration = Duration::from_millis(200);

/// Listens from now on.
pub(super) fn listen() {
    if let Err(error) = system::on_signals(heard) {
        tracing::warn!("Ctrl-C will end the work at once, and may leave unfinished files: {error}");
    }
}

fn heard() {
    let is_first = !REQUESTED.swap(true, Ordering::Relaxed);
    let is_same = FIRST.get_or_init(Instant::now).elapsed() < SAME;
    if is_same && DEFERRED.load(Ordering::Relaxed) {
        return;
    }
    atomic_file::abandon();
    if is_first {
        tell_of_nothing();
    }
    process::exit(Exit::Unfinished.code().into());
}

/// Says that nothing has come of the work.
pub(super) fn tell_of_nothing() {
    // A bar may stand on the line; and who reads may have gone, which is what the signal may have told.
    let line = if io::stderr().is_terminal() { "\n" } else { "" };
    let _ = writeln!(io::stderr(), "{line}Interrupted before the end: nothing is claimed.");
}

/// The line below a result of the first runs of a campaign that a signal has ended.
pub(super) fn part(made: u64, of: impl fmt::Display) -> String {
    format!("\nA signal ended the work: this is what the first {made} of {of} give.\n")
}

/// From now on the first signal ends the work and not the process: what was found by then is to be kept.
pub(super) fn defer() {
    DEFERRED.store(true, Ordering::Relaxed);
}

/// As [`defer`], for work that other threads do while this one hears of it. The one thread of a pool does the work
/// itself, and hears nothing meanwhile: a signal ends the process then.
pub(super) fn defer_for_pool() {
    if rayon::current_thread_index().is_none() {
        defer();
    }
}

/// Whether the user wants the work to stop.
pub(super) fn is_requested() -> bool {
    REQUESTED.load(Ordering::Relaxed)
}

/// Nothing, as long as the work may go on.
///
/// # Errors
/// [`Halt::Interrupted`] if the user wants it to stop.
pub(super) fn check() -> Result<(), Halt> {
    if is_requested() { Err(Halt::Interrupted) } else { Ok(()) }
}

#[cfg(unix)]
mod system {
    use std::io;
    use std::sync::atomic::AtomicBool;
    use std::sync::{Arc, mpsc};
    use std::{fs, thread};

    use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM, SIGXFSZ};
    use signal_hook::{flag, iterator::Signals};

    /// Calls `heard` for each signal, one after the other.
    pub(super) fn on_signals(heard: fn()) -> io::Result<()> {
        // No signal is taken from the system before there is a thread that hears it.
        let (give, take) = mpsc::channel::<Signals>();
        let hear = move || take.iter().for_each(|mut signals| signals.forever().for_each(|_| heard()));
        thread::Builder::new().spawn(hear)?;
        // A file that may grow no more is a fault of its own, and no reason to die.
        flag::register(SIGXFSZ, Arc::new(AtomicBool::new(false)))?;
        let signals = Signals::new([SIGINT, SIGTERM])?;
        if !is_hangup_ignored() {
            signals.add_signal(SIGHUP)?;
        }
        give.send(signals).map_err(|_| io::Error::other("nobody hears them"))
    }

    /// Whether the process was started to outlive its terminal, as by nohup.
    fn is_hangup_ignored() -> bool {
        let status = fs::read_to_string("/proc/self/status").unwrap_or_default();
        let ignored = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
        let ignored = ignored.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok());
        ignored.is_some_and(|mask| mask >> (SIGHUP - 1) & 1 == 1)
    }
}

#[cfg(not(unix))]
mod system {
    /// Calls `heard` for each signal, one after the other.
    pub(super) fn on_signals(heard: fn()) -> Result<(), ctrlc::Error> {
        ctrlc::set_handler(heard)
    }
}

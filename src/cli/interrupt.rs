//! Ctrl-C. The first asks the work to stop where it can; the second ends the process.

use std::process;
use std::sync::atomic::{AtomicBool, Ordering};

use super::Exit;
use crate::fault::Halt;

static REQUESTED: AtomicBool = AtomicBool::new(false);

/// Listens from now on.
pub(super) fn listen() {
    let heard = ctrlc::set_handler(|| {
        if REQUESTED.swap(true, Ordering::Relaxed) {
            process::exit(Exit::Unfinished as i32);
        }
    });
    if let Err(error) = heard {
        tracing::warn!("Ctrl-C will end the work at once: {error}");
    }
}

/// Whether the user wants the work to stop.
pub(super) fn is_requested() -> bool {
    REQUESTED.load(Ordering::Relaxed)
}

/// Goes on unless the user wants the work to stop.
///
/// # Errors
/// [`Halt::Interrupted`].
pub(super) fn check() -> Result<(), Halt> {
    if is_requested() { Err(Halt::Interrupted) } else { Ok(()) }
}

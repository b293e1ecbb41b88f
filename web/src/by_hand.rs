//! Worlds of the proofs that are played by hand.

use tautline_sim::diagnostic::Diagnostic;

use crate::play::Play;
use crate::settings::Settings;

pub(crate) fn start(settings: &Settings) -> Result<Box<dyn Play>, Diagnostic> {
    let what = format!("no world of {} is played by hand", settings.scheme);
    Err(Diagnostic::usage(what, "play it on a layout"))
}

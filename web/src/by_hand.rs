//! Worlds of the proofs that are played by hand: whatever may happen next is a question, and the seed answers where
//! nobody else does. A world says how its states look; how it is played is the same for all.

mod frontier;
mod kit;
mod mrc;
mod notice;
mod scene;
mod setup;

use tautline_io::diagnostic::Diagnostic;

use self::setup::ByHand;
pub(crate) use self::setup::{HuntFindings, Order, Search, switched};
use crate::play::Play;
use crate::settings::Settings;

/// The worlds.
pub(crate) const WORLDS: [ByHand; 4] = [kit::KIT, frontier::FRONTIER, notice::NOTICE, mrc::MRC];

/// How the world of these settings is hunted, if no catalogue has it.
pub(crate) fn hunt(settings: &Settings) -> Option<Search> {
    let world = WORLDS.iter().find(|world| world.name == settings.scheme)?;
    world.row.map(|(_, search)| search)
}

/// The world of these settings, at its start.
pub(crate) fn start(settings: &Settings) -> Result<Box<dyn Play>, Diagnostic> {
    let world = WORLDS.iter().find(|world| world.name == settings.scheme);
    let world = world.ok_or_else(|| {
        let what = format!("no world of {} is played by hand", settings.scheme);
        Diagnostic::usage(what, "play it on a layout")
    })?;
    (world.start)(settings)
}

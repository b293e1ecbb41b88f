//! Channels by name, as command lines and stored runs have them.

use clap::ValueEnum;
use serde::{Deserialize, Serialize};

use super::{Channel, Shared};

/// What lies between the nodes.
#[derive(Clone, Copy, PartialEq, Eq, Debug, ValueEnum, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum ChannelName {
    /// Whoever is in range hears at once.
    Ideal,
    /// Messages take time and collide; nodes listen before they send.
    Shared,
}

impl ChannelName {
    /// The channel of this name: the shared one is that of a sensor's radio.
    pub const fn channel(self) -> Channel {
        match self {
            Self::Ideal => Channel::Ideal,
            Self::Shared => Channel::Shared(Shared::SENSOR),
        }
    }

    /// Its name.
    pub const fn word(self) -> &'static str {
        match self {
            Self::Ideal => "ideal",
            Self::Shared => "shared",
        }
    }
}

//! Channels by name, as command lines and stored runs have them.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use tautline_io::named_values::NamedValues;

use super::{Channel, SharedChannel};

/// The channel between the nodes.
#[derive(Clone, Copy, PartialEq, Eq, Debug, JsonSchema, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum ChannelName {
    /// Whoever is in range hears at once.
    Ideal,
    /// Messages take time and collide; nodes listen before they send.
    Shared,
}

impl NamedValues for ChannelName {
    const WORDS: &'static [(Self, &'static str, &'static str)] = &[
        (Self::Ideal, "ideal", "Whoever is in range hears at once"),
        (Self::Shared, "shared", "Messages take time and collide; nodes listen before they send"),
    ];
}

impl ChannelName {
    /// The channel of this name: the shared one is that of a sensor's radio.
    pub const fn channel(self) -> Channel {
        match self {
            Self::Ideal => Channel::Ideal,
            Self::Shared => Channel::Shared(SharedChannel::SENSOR),
        }
    }
}

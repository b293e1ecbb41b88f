//! The setting of a rescue, as the user gives it: plain numbers, which are checked when the field is laid out.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::radio::{ChannelName, FREE_SPACE, Model};
use tautline_io::named_values::NamedValues;
use tautline_sim::explore::RuleName;

/// The most robots: what a WFR and a path node remember is sized by it.
pub const MAX_ROBOTS: usize = 16;

/// The most WFRs: what a robot and a path node remember is sized by it.
pub const MAX_WFRS: usize = 16;

/// The most events at each WFR.
pub const MAX_EVENTS: usize = 16;

/// How calls are broadcast.
#[derive(Clone, Copy, PartialEq, Eq, Debug, JsonSchema, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum SchemeName {
    /// k-farthest-node forwarding.
    KFnf,
    /// Everybody forwards.
    Flooding,
    /// Who has heard more than k senders, the first counted, is silent.
    Counter,
    /// Who has heard a sender nearer than 0.8 of the range is silent.
    Distance,
    /// Who has no neighbour left to reach is silent.
    Sba,
}

impl NamedValues for SchemeName {
    const WORDS: &'static [(Self, &'static str, &'static str)] = &[
        (
            Self::KFnf,
            "k-fnf",
            "k-farthest-node forwarding: as counter, and of the nodes that hear a sender the farthest goes first",
        ),
        (Self::Flooding, "flooding", "Every node forwards once"),
        (
            Self::Counter,
            "counter",
            "A node that has heard more than k senders, the first included, is silent",
        ),
        (Self::Distance, "distance", "A node that has heard a sender nearer than 0.8 of the range is silent"),
        (Self::Sba, "sba", "A node whose neighbours all have the call already is silent"),
    ];
}

/// When something happens at the WFRs for the first time.
#[derive(Clone, Copy, PartialEq, Eq, Debug, JsonSchema, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum CallTimes {
    /// At all in the beginning.
    Together,
    /// At each at a random time of the first ten minutes.
    Spread,
}

impl NamedValues for CallTimes {
    const WORDS: &'static [(Self, &'static str, &'static str)] = &[
        (Self::Together, "together", "At all in the beginning"),
        (Self::Spread, "spread", "At each at a random time of the first ten minutes"),
    ];
}

/// A rescue, but for its seed.
#[derive(Clone, PartialEq, Debug, JsonSchema, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Setting {
    /// MRC as published, or repaired.
    pub rule: RuleName,
    /// How calls are broadcast.
    pub scheme: SchemeName,
    /// How many senders, the first not counted, make a node silent under k-FNF and the counter-based scheme.
    pub k: u8,
    /// Sensor nodes.
    pub nodes: usize,
    /// Width and height, in metres.
    pub area_m: [f64; 2],
    /// The radio range of nodes and robots, in metres.
    pub range_m: f64,
    /// West, north, east and south of each obstacle, in metres.
    pub obstacles_m: Vec<[f64; 4]>,
    /// How many nodes call.
    pub wfrs: usize,
    /// Which nodes call, as far as they are not to be random ones.
    pub wfrs_at: Vec<u32>,
    /// How many robots there are.
    pub robots: usize,
    /// Where robots begin, x and y in metres, as far as they are not to be at random places.
    pub robots_at_m: Vec<[f64; 2]>,
    /// How often something happens at each WFR: again at a random time of the ten minutes after a robot has served it.
    #[serde(default = "once")]
    pub events_per_wfr: usize,
    /// When something happens at the WFRs for the first time.
    pub calls: CallTimes,
    /// The channel between a sender and those who hear it.
    pub channel: ChannelName,
    /// How likely it is that a message is lost, on each link anew.
    pub loss: f64,
    /// The standard deviation of the shadow on each link, in dB.
    #[serde(default)]
    pub shadowing_db: f64,
    /// α: power falls with the distance to the power of it.
    #[serde(default = "free_space")]
    pub exponent: f64,
    /// The standard deviation of the strength of a signal, each time anew, in dB.
    pub noise_db: f64,
    /// How many robots fail, each at a random time of the first ten minutes.
    pub failing: usize,
    /// How many nodes fail, likewise. No WFR does.
    pub failing_nodes: usize,
}

impl Setting {
    /// How signals spread.
    pub(super) fn model(&self) -> Model {
        let Self { exponent, shadowing_db: deviation_db, .. } = *self;
        let is_plain = [exponent, deviation_db] == [FREE_SPACE, 0.0];
        if is_plain { Model::Disc } else { Model::Shadowed { exponent, deviation_db } }
    }
}

/// The number of events in stored rescues that do not say it.
const fn once() -> usize {
    1
}

/// The fall of power in stored rescues that do not say it.
const fn free_space() -> f64 {
    FREE_SPACE
}

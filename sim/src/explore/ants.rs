//! Ants [Ferranti 2009]: agents that go where they have been least. Their row; the team is that of all agents.

use tautline_kernel::ants::Rule as Ants;
use tautline_kernel::floor::SensorFate::{Beside, Counted};

use super::agents::AGENTS;
use super::hunt_states::crew;
use super::{Knowledge, Profile, Rule, RuleId};

const BESIDE: Ants = Ants::Published(Beside);
const COUNTED: Ants = Ants::Published(Counted);

/// Agents on a sensor floor that go where they have been least; they never know that they are done.
pub static ANTS: Profile = Profile {
    name: "ants",
    about: "Agents on a sensor floor that go where they have been least; they never know that they are done",
    rules: &[
        crew!(Rule::published, Ants::PUBLISHED),
        crew!(Rule::repaired, Ants::Repaired),
        crew!("beside", "A missed sensor stays beside the new one; the higher is read", BESIDE),
        crew!("counted", "A new sensor counts on from a missed one", COUNTED),
    ],
    knowledge: Some(Knowledge::None),
    ..AGENTS
};

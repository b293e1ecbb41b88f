//! Ants [Ferranti 2009]: agents that go where they have been least. Their row; the team is that of all agents.

use tautline_kernel::ants::Rule as Ants;
use tautline_proofs::floor::trap::Way;

use super::agents::{AGENTS, start};
use super::hunt_states::Traps;
use super::setup::{Knowledge, Profile, Rule};

const PUBLISHED: Way = Way::Ants(Ants::Published);
const REPAIRED: Way = Way::Ants(Ants::Repaired);

/// Agents on a sensor floor that go where they have been least; they never know that they are done.
pub static ANTS: Profile = Profile {
    name: "ants",
    about: "Agents on a sensor floor that go where they have been least; they never know that they are done",
    rules: &[
        Rule::published(|setup| Ok(start(setup, PUBLISHED)), &Traps(PUBLISHED)),
        Rule::repaired(|setup| Ok(start(setup, REPAIRED)), &Traps(REPAIRED)),
    ],
    knowledge: Some(Knowledge::None),
    ..AGENTS
};

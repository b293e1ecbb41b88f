//! Ants [Ferranti 2009]: agents that go where they have been least. Their row; the team is that of all agents.

use tautline_kernel::ants::Rule as Ants;

use super::agents::AGENTS;
use super::catalogue::{Knowledge, Profile};
use super::hunt_states::crew;
use super::rule::Rule;

/// Agents on a sensor floor that go where they have been least; they never know that they are done.
pub static ANTS: Profile = Profile {
    name: "ants",
    about: "Agents on a sensor floor that go where they have been least; they never know that they are done",
    rules: &[crew!(Rule::published, Ants::Published), crew!(Rule::repaired, Ants::Repaired)],
    knowledge: Some(Knowledge::None),
    ..AGENTS
};

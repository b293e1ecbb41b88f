//! The rivals of Brick&Mortar: MDFS, the classic that its authors compared it with, and helpers. Their rows; the team
//! is that of all agents.

use tautline_kernel::bricks::tree::Rule as Trees;
use tautline_proofs::bricks::tree::mdfs::Mdfs;

use super::bricks::MARKING;
use super::hunt_states::{crew, switched_crew};
use super::{Profile, Rule, RuleId};

/// Multiple depth first search.
pub static MDFS: Profile = Profile {
    name: "mdfs",
    about: "Multiple depth first search: each agent on a sensor floor has a tree of its own, and is done too early",
    rules: &[crew!(Rule::published, Mdfs)],
    ..MARKING
};

/// Depth first search with helpers.
pub static HELPERS: Profile = Profile {
    name: "helpers",
    about: "Depth first search by agents on a sensor floor that share the trees that they meet",
    rules: &[
        switched_crew!(Rule::repaired; Trees::ROBUST),
        switched_crew!("trusting", "As if no sensor were ever missed"; Trees::HELPERS),
        switched_crew!("doubting", "Places sensors unasked, after three scans in a row that miss one"; Trees::DOUBTING),
    ],
    ..MARKING
};

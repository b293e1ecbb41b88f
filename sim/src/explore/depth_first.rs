//! The rivals of Brick&Mortar: MDFS, the classic that its authors compared it with, and helpers. Their rows; the team
//! is that of all agents.

use tautline_proofs::bricks::tree::Way;

use super::agents::start;
use super::bricks::MARKING;
use super::hunt_runs::Tries;
use super::rule::RuleId;
use super::setup::{Profile, Rule};
use super::trees::{HELPERS_DOUBTING, HELPERS_ROBUST, HELPERS_TRUSTING};

/// Multiple depth first search.
pub static MDFS: Profile = Profile {
    name: "mdfs",
    about: "Multiple depth first search: each agent on a sensor floor has a tree of its own, and is done too early",
    rules: &[Rule {
        name: RuleId::PUBLISHED,
        about: "As the paper publishes it",
        start: |setup| Ok(start(setup, Way::Mdfs)),
        hunt: Some(&Tries(Way::Mdfs)),
    }],
    ..MARKING
};

/// Depth first search with helpers.
pub static HELPERS: Profile = Profile {
    name: "helpers",
    about: "Depth first search by agents on a sensor floor that share the trees that they meet",
    rules: &[
        Rule {
            name: RuleId::REPAIRED,
            about: "With the repairs of its refuted claims",
            start: |setup| Ok(start(setup, HELPERS_ROBUST)),
            hunt: Some(&Tries(HELPERS_ROBUST)),
        },
        Rule {
            name: RuleId::new("trusting"),
            about: "As if no sensor were ever missed",
            start: |setup| Ok(start(setup, HELPERS_TRUSTING)),
            hunt: Some(&Tries(HELPERS_TRUSTING)),
        },
        Rule {
            name: RuleId::new("doubting"),
            about: "Places sensors unasked, after three scans in a row that miss one",
            start: |setup| Ok(start(setup, HELPERS_DOUBTING)),
            hunt: Some(&Tries(HELPERS_DOUBTING)),
        },
    ],
    ..MARKING
};

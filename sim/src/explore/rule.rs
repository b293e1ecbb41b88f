//! The names of the rules that a team can follow.

use std::fmt;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use tautline_io::named_values::NamedValues;
use tautline_proofs::chain::Subject;

use super::clause::kept;

/// Whether a scheme is taken as its paper has it.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug, JsonSchema, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum RuleName {
    /// As the paper publishes it.
    Published,
    /// With the repairs of its refuted claims.
    Repaired,
}

impl NamedValues for RuleName {
    const WORDS: &'static [(Self, &'static str, &'static str)] = &[
        (Self::Published, "published", "As the paper publishes it"),
        (Self::Repaired, "repaired", "With the repairs of its refuted claims"),
    ];
}

impl RuleName {
    /// Both rules.
    pub const ALL: [Self; 2] = [Self::Published, Self::Repaired];

    /// The chain that follows it.
    pub const fn observed(self) -> Subject {
        match self {
            Self::Published => Subject::PUBLISHED,
            Self::Repaired => Subject::REPAIRED,
        }
    }
}

impl fmt::Display for RuleName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.word())
    }
}

/// The name of a rule of a scheme: `published`, `repaired`, or what else the scheme offers.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug, Serialize)]
pub struct RuleId(&'static str);

impl RuleId {
    /// As the paper publishes it.
    pub const PUBLISHED: Self = Self("published");
    /// With the repairs of its refuted claims.
    pub const REPAIRED: Self = Self("repaired");

    /// The rule with this name.
    pub const fn new(name: &'static str) -> Self {
        Self(name)
    }

    /// The rule with the name that stands in a file.
    pub(crate) fn read(name: &str) -> Self {
        Self(kept(name))
    }

    /// The name as it is typed, printed and stored.
    pub const fn as_str(self) -> &'static str {
        self.0
    }
}

impl From<RuleName> for RuleId {
    fn from(rule: RuleName) -> Self {
        Self(rule.word())
    }
}

impl fmt::Display for RuleId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.0)
    }
}

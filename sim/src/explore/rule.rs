//! The rules that a team can follow, by their names.

use std::fmt;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use tautline_io::diagnostic::Diagnostic;
use tautline_io::named_values::NamedValues;
use tautline_kernel::chain;
use tautline_kernel::conditions::Conditional;
use tautline_proofs::chain::Subject;

use super::clause::kept;
use super::hunt::Hunt;
use super::run::Team;
use super::setup::Setup;

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

    /// The chain's rule.
    pub const fn chain(self) -> chain::Rule {
        self.observed().rule
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
        match rule {
            RuleName::Published => Self::PUBLISHED,
            RuleName::Repaired => Self::REPAIRED,
        }
    }
}

impl PartialEq<RuleName> for RuleId {
    fn eq(&self, rule: &RuleName) -> bool {
        self.0 == rule.word()
    }
}

impl fmt::Display for RuleId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.0)
    }
}

/// A rule of a scheme.
#[derive(Clone, Copy, Debug)]
pub struct Rule {
    /// Its name.
    pub name: RuleId,
    /// One line about it.
    pub about: &'static str,
    /// The team of a setup at its start.
    pub start: Start,
    /// How it is hunted, if it is.
    pub hunt: Option<&'static dyn Hunt>,
    /// Its conditions, if it has any that can be switched.
    pub switches: Option<&'static dyn Switches>,
}

/// The team of a setup at its start.
pub type Start = fn(&Setup) -> Result<Box<dyn Team>, Diagnostic>;

/// The conditions of a rule, which can be switched one by one: with one off that the rule has, it is a mutant.
pub trait Switches: fmt::Debug + Sync {
    /// The conditions, each by its name and the sentence that it stands for.
    fn conditions(&self) -> &'static [(&'static str, &'static str)];

    /// Those in force, a bit for each in their order.
    fn in_force(&self) -> u16;

    /// The team of a setup, with these conditions in force and no others.
    ///
    /// # Errors
    /// A [`Diagnostic`] if the setup does not fit its scheme.
    fn start(&self, setup: &Setup, in_force: u16) -> Result<Box<dyn Team>, Diagnostic>;

    /// The hunt with these conditions in force and no others, if there is one.
    fn hunt(&self, in_force: u16) -> Option<Box<dyn Hunt>>;
}

/// The team of a setup that follows a rule of the kernel, at its start.
pub(super) type StartBy<R> = fn(&Setup, R) -> Result<Box<dyn Team>, Diagnostic>;

/// A rule of the kernel whose conditions can be switched: how its team starts, and how it is hunted.
pub(super) struct SwitchableRule<R: 'static> {
    /// The rule.
    pub(super) rule: R,
    /// The team of a setup that follows a rule.
    pub(super) start: StartBy<R>,
    /// The hunt of a rule that claims to be the other one, if there is one.
    pub(super) hunt: fn(R, R) -> Option<Box<dyn Hunt>>,
}

impl<R: Conditional + fmt::Debug + Sync> Switches for SwitchableRule<R> {
    fn conditions(&self) -> &'static [(&'static str, &'static str)] {
        R::CONDITIONS
    }

    fn in_force(&self) -> u16 {
        self.rule.in_force()
    }

    fn start(&self, setup: &Setup, in_force: u16) -> Result<Box<dyn Team>, Diagnostic> {
        setup.check()?;
        (self.start)(setup, self.rule.with_in_force(in_force))
    }

    fn hunt(&self, in_force: u16) -> Option<Box<dyn Hunt>> {
        (self.hunt)(self.rule.with_in_force(in_force), self.rule)
    }
}

impl<R: fmt::Debug> fmt::Debug for SwitchableRule<R> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.rule.fmt(f)
    }
}

impl Rule {
    /// A rule that is not hunted.
    pub const fn new(name: RuleId, about: &'static str, start: Start) -> Self {
        Self { name, about, start, hunt: None, switches: None }
    }

    /// This rule, hunted so.
    pub const fn hunted(self, hunt: &'static dyn Hunt) -> Self {
        Self { hunt: Some(hunt), ..self }
    }

    /// This rule, whose conditions can be switched.
    pub const fn switched(self, switches: &'static dyn Switches) -> Self {
        Self { switches: Some(switches), ..self }
    }

    /// As the paper publishes it.
    pub const fn published(start: Start, hunt: &'static dyn Hunt) -> Self {
        Self::new(RuleId::PUBLISHED, "As the paper publishes it", start).hunted(hunt)
    }

    /// With the repairs of its refuted claims.
    pub const fn repaired(start: Start, hunt: &'static dyn Hunt) -> Self {
        Self::new(RuleId::REPAIRED, "With the repairs of its refuted claims", start).hunted(hunt)
    }
}

//! NOTICE (NOTICE): what is promised of an event that spreads through a network, under every order in which messages
//! arrive and waits end.

pub mod clauses;
pub mod networks;
mod random;
mod shapes;
pub mod spread;

use tautline_kernel::notice::{Condition, Conditions, Count, Rule, Scheme};

/// What k counts where a packet comes twice.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum Counted {
    /// The senders that a node hears besides the first.
    Senders,
    /// The packets after the first one.
    Packets,
}

/// The nodes of a network that is observed.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Subject {
    /// The conditions that they follow.
    pub conditions: Conditions,
    /// Whether k = ∞ is taken for k = 1, as a mutant does.
    pub takes_endless_for_one: bool,
    /// What k counts.
    pub counted: Counted,
}

impl Subject {
    /// As published.
    pub const PUBLISHED: Self =
        Self { conditions: Conditions::PUBLISHED, takes_endless_for_one: false, counted: Counted::Senders };

    /// Repaired.
    pub const REPAIRED: Self = Self { conditions: Conditions::REPAIRED, ..Self::PUBLISHED };

    /// Nodes that follow the repaired rule without one condition.
    pub const fn hearing_without(condition: Condition) -> Self {
        Self { conditions: Conditions::REPAIRED.without(condition), ..Self::REPAIRED }
    }

    /// Nodes that broadcast by `scheme`.
    const fn rule(&self, scheme: Scheme) -> Rule {
        Rule { conditions: self.conditions, ..Rule::new(scheme, spread::RANGE, 0) }
    }

    /// k-FNF.
    fn farthest(&self, k: Option<Count>) -> Rule {
        let k = if self.takes_endless_for_one { k.or(Some(Count::ONE)) } else { k };
        self.rule(Scheme::Farthest { k })
    }
}

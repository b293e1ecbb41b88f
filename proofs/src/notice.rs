//! NOTICE (NOTICE): what is promised of an event that spreads through a network, under every order in which messages
//! arrive and waits end.

pub mod clauses;
pub mod networks;
mod random;
mod shapes;
pub mod spread;

use tautline_kernel::notice::{Condition, Conditions, Count, Rule, Scheme};

pub use self::spread::CountOf;

/// How nodes take k, as a mutant does.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Miscount {
    /// ∞ for 1.
    EndlessForOne,
    /// A number for one less, 1 for itself.
    OneFewer,
    /// A number for one more.
    OneMore,
}

/// The nodes of a network that is observed.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Subject {
    /// The conditions that they follow.
    pub conditions: Conditions,
    /// How they take k, if not for what it is.
    pub miscount: Option<Miscount>,
    /// The senders or packets that k counts.
    pub counted: CountOf,
}

impl Subject {
    /// As published.
    pub const PUBLISHED: Self =
        Self { conditions: Conditions::PUBLISHED, miscount: None, counted: CountOf::Senders };

    /// Repaired.
    pub const REPAIRED: Self = Self { conditions: Conditions::REPAIRED, ..Self::PUBLISHED };

    /// Nodes that follow the published rule without one condition.
    pub const fn hearing_without(condition: Condition) -> Self {
        Self { conditions: Conditions::PUBLISHED.without(condition), ..Self::PUBLISHED }
    }

    /// Nodes that broadcast by `scheme`.
    const fn rule(&self, scheme: Scheme) -> Rule {
        Rule { conditions: self.conditions, ..Rule::new(scheme, spread::RANGE, 0) }
    }

    /// These nodes, which take k for another one.
    const fn miscounting(self, miscount: Miscount) -> Self {
        Self { miscount: Some(miscount), ..self }
    }

    /// k-FNF.
    fn farthest(&self, k: Option<Count>) -> Rule {
        let k = match self.miscount {
            Some(Miscount::EndlessForOne) => k.or(Some(Count::ONE)),
            Some(Miscount::OneFewer) => k.and_then(|k| Count::new(k.get().max(2) - 1)),
            Some(Miscount::OneMore) => k.and_then(|k| Count::new(k.get() + 1)),
            None => k,
        };
        self.rule(Scheme::Farthest { k })
    }
}

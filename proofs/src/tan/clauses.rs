//! The clauses of TAN, in the order of `SPEC.md`.

use super::legs::{self, Reading};
use crate::clause::{Check, Clause, Named};
use crate::decide::{Exhaustive, Verdict};

const REPAIRED: Named<Reading> = Named::new("repaired", Reading::True);

const FOLLOWS: Check<Reading> = Check::new(
    REPAIRED,
    &Exhaustive {
        body: legs::follows,
        range: legs::signals,
        covers: &["a signal followed", "a signal ignored"],
    },
    Verdict::Holds,
    &[
        Named::new("any nearer node", Reading::AnyNearer),
        Named::new("any node", Reading::AnyNode),
        Named::new("any tree", Reading::AnyTree),
    ],
);

const GOES_ON: Check<Reading> = Check::new(
    REPAIRED,
    &Exhaustive {
        body: legs::goes_on,
        range: legs::signals,
        covers: &["at a node", "at the WFR", "no signal followed", "the signal lost"],
    },
    Verdict::Holds,
    &[Named::new("a node is its own parent", Reading::NoParent)],
);

/// The clauses.
pub static CLAUSES: [Clause; 2] = [
    Clause {
        id: "TAN-1",
        sentence: "A robot MUST follow only the signal of the node that it has asked, one hop nearer than itself in the \
                   tree of its WFR.",
        checks: &[&FOLLOWS],
    },
    Clause {
        id: "TAN-2",
        sentence: "A robot that has come to a node MUST have arrived if the node is its WFR, and ask the node's parent \
                   next if it is not.",
        checks: &[&GOES_ON],
    },
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::clause::AnyCheck;
    use crate::decide::Memory;
    use crate::engine::tree::unwatched;

    #[test]
    fn whatever_one_machine_hears_the_clauses_hold_and_their_mutants_are_rejected() {
        for check in [&FOLLOWS, &GOES_ON] {
            let decision =
                check.decide(&mut Memory::default(), &mut unwatched).expect("a body can be decided");
            assert!(decision.is_as_registered(check), "{}: {decision:?}", check.bound());
        }
    }
}

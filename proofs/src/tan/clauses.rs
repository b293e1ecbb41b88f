//! The clauses of TAN, in the order of `SPEC.md`.

use super::legs::{self, Reading};
use super::way::{self, Patience, TRUE};
use crate::clause::{Check, Clause, NamedRule};
use crate::decide::EveryAnswer;

const REPAIRED: NamedRule<Reading> = NamedRule::new("repaired", Reading::True);

const FOLLOWS: Check<Reading> = Check::holds(
    REPAIRED,
    &EveryAnswer::new(legs::follows, legs::signals, &["a signal followed", "a signal ignored"]),
    &[
        NamedRule::new("any nearer node", Reading::AnyNearer),
        NamedRule::new("any node", Reading::AnyNode),
        NamedRule::new("any tree", Reading::AnyTree),
    ],
);

const GOES_ON: Check<Reading> = Check::holds(
    REPAIRED,
    &EveryAnswer::new(
        legs::goes_on,
        legs::signals,
        &["at a node", "at the WFR", "no signal followed", "the signal lost"],
    ),
    &[NamedRule::new("a node is its own parent", Reading::NoParent)],
);

const WHOLE_WAY: Check<Patience> = Check::holds(
    NamedRule::new("repaired", TRUE),
    &EveryAnswer::new(way::whole_way, way::events, &["at the WFR", "it asks", "lost", "on its way"]),
    &[
        NamedRule::new("asks three times", Patience { tries: 3, ..TRUE }),
        NamedRule::new("goes nearer twice", Patience { times: 2, ..TRUE }),
        NamedRule::new("walks past", Patience { walks_past: true, ..TRUE }),
        NamedRule::new("goes on while as strong as in the scan", Patience { recalls_scan: true, ..TRUE }),
    ],
);

const GUIDES: Check<bool> = Check::holds(
    NamedRule::new("repaired", true),
    &EveryAnswer::new(way::guides, way::requests, &["idle", "it keeps silent", "it signals"]),
    &[NamedRule::new("others do not count", false)],
);

/// The clauses.
pub const CLAUSES: [Clause; 4] = [
    Clause {
        id: "TAN-1",
        sentence: "A robot MUST follow only the signal of the node that it has asked, one hop \
                   nearer than itself in the tree of its WFR.",
        checks: &[&FOLLOWS],
    },
    Clause {
        id: "TAN-2",
        sentence: "A robot that has come to a node MUST have arrived if the node is its WFR, and ask the node's parent \
                   next if it is not.",
        checks: &[&GOES_ON],
    },
    Clause {
        id: "TAN-3",
        sentence: "A robot MUST walk in the first of the strongest directions, scan again when the signal gets \
                   weaker or its way is barred, ask again what it does not hear, and go nearer to the node before \
                   when that was in vain, as often as it may.",
        checks: &[&WHOLE_WAY],
    },
    Clause {
        id: "TAN-4",
        sentence: "A node MUST signal for T_x if it was asked before it had to keep silent, as \
                   it was asked last, and else keep silent.",
        checks: &[&GUIDES],
    },
];

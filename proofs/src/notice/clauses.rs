//! The clauses of NOTICE, in the order of `SPEC.md`.

use tautline_kernel::notice::Condition::{FirstHeard, FrozenOnceForwarded, LeastHops, RememberEvent};

use super::spread::Demand;
use super::{CountOf, Miscount, Subject, networks, random};
use crate::ambiguity::Charity::{Charitable, Literal};
use crate::ambiguity::{Ambiguity, Interpretation, Paper};
use crate::clause::{Check, Clause, NamedRule, Reading, holding, readings};
use crate::decide::{Body, RandomAnswers, Verdict};
use crate::step_checks;

const PUBLISHED: NamedRule<Subject> = NamedRule::new("published", Subject::PUBLISHED);
const REPAIRED: NamedRule<Subject> = NamedRule::new("repaired", Subject::REPAIRED);

const PACKETS: [(&str, Subject); 1] =
    [("packets", Subject { counted: CountOf::Packets, ..Subject::PUBLISHED })];
const UNREFUTED: &[Reading<Subject>] = &readings(PACKETS, [Verdict::Unrefuted]);
const REFUTED: &[Reading<Subject>] = &holding(PACKETS, []);

static PAPER: Paper = Paper {
    ambiguities: &[Ambiguity {
        words: "“if it hears k nodes forwarding the packet”; “receives totally k NOTICE packets”",
        interpretations: &[
            Interpretation::new("senders", "k counts nodes, each of them once", Charitable),
            Interpretation::new("packets", "k counts packets, also one that comes twice", Literal),
        ],
    }],
    excluded: &[],
    repairs: &[],
};

/// Runs of random networks.
const RUNS: u64 = 500;

const LATER: NamedRule<Subject> = NamedRule::new(
    "a later NOTICE with HC ≤ own changes the parent",
    Subject::hearing_without(FrozenOnceForwarded),
);

const UNFROZEN: [NamedRule<Subject>; 1] = [LATER];

const ANOTHER_PARENT: [NamedRule<Subject>; 3] = [
    LATER,
    NamedRule::new("the parent is the last heard", Subject::hearing_without(LeastHops)),
    NamedRule::new("of equal HC the last heard", Subject::hearing_without(FirstHeard)),
];

const FORGETFUL: [NamedRule<Subject>; 1] =
    [NamedRule::new("who has forwarded an event forgets it", Subject::hearing_without(RememberEvent))];

const FINITE: [NamedRule<Subject>; 1] =
    [NamedRule::new("k = ∞ is taken for 1", Subject::PUBLISHED.miscounting(Miscount::EndlessForOne))];

/// Random networks in which this is tried.
const fn at_random(body: Body<Subject>) -> RandomAnswers<Subject> {
    RandomAnswers::new(body, RUNS, random::random_networks, &random::SPREADS)
}

step_checks! { Subject;
    second_event: random::second_event, REPAIRED, random::later_events,
        covers ["silent about the first", "through with the first", "unaware of the first", "waiting with the first"],
        unwind 12, mutants {
            published: "as published" => Subject::PUBLISHED,
            one_fewer: "one fewer than k silence" => Subject::REPAIRED.miscounting(Miscount::OneFewer),
            one_more: "one more than k silence" => Subject::REPAIRED.miscounting(Miscount::OneMore),
        };
}

/// The clauses.
pub const CLAUSES: [Clause; 6] = [
    Clause {
        id: "NOTICE-1",
        sentence: "At every moment the parent pointers MUST form a tree rooted at the source, each node one hop \
                   farther from it than its parent.",
        checks: &[
            &Check::holds(PUBLISHED, &networks::TREE, &UNFROZEN),
            &Check::unrefuted(
                PUBLISHED,
                &at_random(|subject, oracle| random::spread_at_random(subject, oracle, Demand::Tree)),
                &UNFROZEN,
            )
            .under(UNREFUTED)
            .of(&PAPER),
        ],
    },
    Clause {
        id: "NOTICE-2",
        sentence: "A node MUST forward an event at most once.",
        checks: &[
            &Check::holds(PUBLISHED, &networks::ONCE, &FORGETFUL),
            &Check::unrefuted(
                PUBLISHED,
                &at_random(|subject, oracle| random::spread_at_random(subject, oracle, Demand::Once)),
                &FORGETFUL,
            )
            .under(UNREFUTED)
            .of(&PAPER),
        ],
    },
    Clause {
        id: "NOTICE-3",
        sentence: "With k = ∞ every node that links connect to the source MUST receive the event and forward it, as \
                   under flooding.",
        checks: &[
            &Check::holds(PUBLISHED, &networks::FLOOD, &FINITE),
            &Check::unrefuted(
                PUBLISHED,
                &RandomAnswers::new(
                    |subject, oracle| random::spread_at_random(subject, oracle, Demand::Floods),
                    RUNS,
                    random::random_floods,
                    &["most nodes forward"],
                ),
                &FINITE,
            ),
        ],
    },
    Clause {
        id: "NOTICE-4",
        sentence: "A node MUST take the first NOTICE of a newer event of a source as a first one, whatever it has \
                   made of the events before.",
        checks: &[
            &Check::refuted(PUBLISHED, second_event::CHECK.method).judged(random::later),
            &second_event::CHECK,
        ],
    },
    Clause {
        id: "NOTICE-5",
        sentence: "Every node that links connect to the source MUST receive the event.",
        checks: &[
            &Check::refuted(PUBLISHED, &networks::REACH_WITH_ONE).under(REFUTED).of(&PAPER),
            &Check::refuted(PUBLISHED, &networks::REACH_WITH_TWO).under(REFUTED).of(&PAPER),
            &Check::holds(PUBLISHED, &networks::REACH_WITH_ALL, &FINITE),
        ],
    },
    Clause {
        id: "NOTICE-6",
        sentence: "Of the senders that a node has heard before it forwards or falls silent, its parent MUST be one \
                   with the least hop count, and of several the first heard.",
        checks: &[
            &Check::holds(PUBLISHED, &networks::NEAREST_PARENT, &ANOTHER_PARENT),
            &Check::unrefuted(
                PUBLISHED,
                &at_random(|subject, oracle| {
                    random::spread_at_random(subject, oracle, Demand::NearestParent)
                }),
                &ANOTHER_PARENT,
            )
            .under(UNREFUTED)
            .of(&PAPER),
        ],
    },
];

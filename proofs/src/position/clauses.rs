//! The clauses of POSITION, in the order of `SPEC.md`.

use super::belief::{self, Takes};
use super::lattice;
use super::minima;
use super::refusals;
use super::swarm::{self, Best, Conduct};
use super::way::{self, Way};
use super::wrong_ways;
use crate::ambiguity::Charity::{Charitable, Literal};
use crate::ambiguity::{Ambiguity, Interpretation, Paper};
use crate::clause::{Check, Clause, NamedRule, holding};
use crate::decide::{EveryAnswer, RandomAnswers, Verdict};

const PUBLISHED: NamedRule<Way> = NamedRule::new("published", way::published);
/// The three that are heard strongest.
const STRONGEST: NamedRule<Way> =
    NamedRule::new("published", |ranges, area| way::published(&way::strongest(ranges), area));
const REPAIRED: NamedRule<Way> = NamedRule::new("repaired", way::repaired);
const METRES: NamedRule<Way> = NamedRule::new("metres", way::metres);
const DECIBELS: NamedRule<Way> = NamedRule::new("decibels", way::decibels);

/// The readings of four anchors, of which three are taken.
const OF_FOUR: [(&str, Way); 3] = [
    ("renamed", |ranges, area| way::renamed(&way::strongest(ranges), area)),
    ("told best", |ranges, area| way::published(&way::best_told(ranges), area)),
    ("renamed + told best", |ranges, area| way::renamed(&way::best_told(ranges), area)),
];

static PAPER: Paper = Paper {
    ambiguities: &[
        Ambiguity {
            words: "equation (8) divides by x_c − x_b",
            interpretations: &[
                Interpretation::new(
                    "printed",
                    "A, B and C are in the order in which they are heard",
                    Literal,
                ),
                Interpretation::new("renamed", "A, B and C are renamed where it divides by 0", Charitable),
            ],
        },
        Ambiguity {
            words: "“selects the best three anchors”",
            interpretations: &[
                Interpretation::new("strongest", "the three that are heard strongest", Literal),
                Interpretation::new("told best", "the three, on no line, with the least bound", Charitable),
            ],
        },
    ],
    excluded: &[],
    repairs: &["repaired", "metres", "decibels"],
};

/// Random triples of anchors.
const TRIPLES: u64 = 20_000;

/// Random swarms.
const SWARMS: u64 = 2_000;

const EXACT: EveryAnswer<Way> = EveryAnswer {
    body: lattice::is_exact,
    range: lattice::places,
    covers: &["four anchors", "three anchors"],
};

const INEXACT: [NamedRule<Way>; 2] = [
    NamedRule::new("each anchor takes the distance of the next", wrong_ways::exchanged),
    NamedRule::new("the last distance is that of the first", wrong_ways::without_the_last),
];

const REFUSES: EveryAnswer<Way> = EveryAnswer {
    body: refusals::is_refused_or_told,
    range: refusals::numbers,
    covers: &["refused for want of anchors or numbers", "told"],
};

const CREDULOUS: [NamedRule<Way>; 2] = [
    NamedRule::new("nobody looks at what is divided by", wrong_ways::unchecked),
    NamedRule::new("a distance that is no number is 0", wrong_ways::lenient),
];

const MIRRORED: EveryAnswer<Way> = EveryAnswer {
    body: minima::tells_the_mirror_image,
    range: minima::lines,
    covers: &["a slanting line", "a straight line"],
};

const FOLLOWS: EveryAnswer<Way> =
    EveryAnswer { body: lattice::follows, range: lattice::moves, covers: &["one position"] };

const FOLLOWS_TWO: EveryAnswer<Way> =
    EveryAnswer { body: lattice::follows, range: lattice::moves, covers: &["one position", "two positions"] };

const UNMOVED: [NamedRule<Way>; 2] = [
    NamedRule::new("places are told from the first anchor", wrong_ways::from_the_first),
    NamedRule::new("distances along y count twice", wrong_ways::stretched),
];

const COARSE: EveryAnswer<Conduct> = EveryAnswer {
    body: swarm::never_worsens,
    range: swarm::coarse_draws,
    covers: &["it does not improve", "it improves"],
};

const FORGETFUL: [NamedRule<Conduct>; 2] = [
    NamedRule::new("the best of the present positions", Conduct { best: Best::Now, ..Conduct::REPAIRED }),
    NamedRule::new("the position of the first particle", Conduct { best: Best::First, ..Conduct::REPAIRED }),
];

const INSIDE: EveryAnswer<Way> = EveryAnswer {
    body: lattice::keeps_inside,
    range: lattice::rectangles,
    covers: &["inside", "on the rim"],
};

/// The clauses.
pub const CLAUSES: [Clause; 7] = [
    Clause {
        id: "POSITION-1",
        sentence: "From distances without error a way MUST return where the robot is, \
                   wherever anchors are that are not on one line.",
        checks: &[
            &Check::refuted(
                PUBLISHED,
                &EveryAnswer {
                    body: lattice::is_exact_of_three,
                    range: lattice::places_of_three,
                    covers: &["three anchors"],
                },
            )
            .under(&holding([("renamed", way::renamed as Way)], [0]))
            .of(&PAPER)
            .judged(lattice::exact),
            &Check::refuted(
                STRONGEST,
                &EveryAnswer {
                    body: lattice::is_exact_of_four,
                    range: lattice::places_of_four,
                    covers: &["four anchors"],
                },
            )
            .under(&holding(OF_FOUR, [2]))
            .of(&PAPER)
            .judged(lattice::exact_of_strongest),
            &Check::holds(REPAIRED, &EXACT, &INEXACT),
            &Check::holds(METRES, &EXACT, &INEXACT),
            &Check::holds(DECIBELS, &EXACT, &INEXACT),
        ],
    },
    Clause {
        id: "POSITION-2",
        sentence: "Anchors at fewer than three places, and distances that are negative, infinite \
                   or no numbers, MUST be refused; anchors on one line never give one position \
                   beside it, and every coordinate is a number.",
        checks: &[
            &Check::holds(PUBLISHED, &REFUSES, &CREDULOUS),
            &Check::holds(REPAIRED, &REFUSES, &CREDULOUS),
            &Check::holds(METRES, &REFUSES, &CREDULOUS),
            &Check::holds(DECIBELS, &REFUSES, &CREDULOUS),
        ],
    },
    Clause {
        id: "POSITION-3",
        sentence: "Two positions that fit alike MUST both be told.",
        checks: &[
            &Check::holds(
                METRES,
                &MIRRORED,
                &[NamedRule::new("the better one alone", wrong_ways::better_alone)],
            ),
            &Check::holds(
                DECIBELS,
                &MIRRORED,
                &[NamedRule::new("the better one alone", wrong_ways::better_level_alone)],
            ),
            &Check::refuted(
                METRES,
                &RandomAnswers {
                    body: minima::tells_second_minima,
                    runs: TRIPLES,
                    range: minima::random_anchors,
                    covers: &["one minimum", "two minima"],
                },
            )
            .because("with noise, rarely, the second is not told")
            .judged(minima::second),
        ],
    },
    Clause {
        id: "POSITION-4",
        sentence: "When anchors are moved, turned and mirrored, positions MUST \
                   be moved, turned and mirrored with them.",
        checks: &[
            &Check::refuted(PUBLISHED, &FOLLOWS)
                .under(&holding([("renamed", way::renamed as Way)], [0]))
                .of(&PAPER)
                .judged(lattice::turned),
            &Check::holds(REPAIRED, &FOLLOWS, &UNMOVED),
            &Check::holds(METRES, &FOLLOWS_TWO, &UNMOVED),
            &Check::holds(DECIBELS, &FOLLOWS_TWO, &UNMOVED),
        ],
    },
    Clause {
        id: "POSITION-5",
        sentence: "The best position of a swarm MUST never fit worse than the one before, nor than any particle does.",
        checks: &[
            &Check::holds(NamedRule::new("published", Conduct::PUBLISHED), &COARSE, &FORGETFUL),
            &Check::holds(NamedRule::new("repaired", Conduct::REPAIRED), &COARSE, &FORGETFUL),
            &Check::new(
                NamedRule::new("repaired", Conduct::REPAIRED),
                &RandomAnswers {
                    body: swarm::never_worsens_at_random,
                    runs: SWARMS,
                    range: swarm::random_swarms,
                    covers: &["it improves"],
                },
                Verdict::Unrefuted,
                &FORGETFUL,
            ),
        ],
    },
    Clause {
        id: "POSITION-6",
        sentence: "A position that is asked for within a rectangle MUST be in it, and the same as \
                   without the rectangle if that one is in it.",
        checks: &[
            &Check::holds(
                METRES,
                &INSIDE,
                &[NamedRule::new("the rectangle is forgotten", |ranges, _| way::metres(ranges, None))],
            ),
            &Check::holds(
                DECIBELS,
                &INSIDE,
                &[NamedRule::new("the rectangle is forgotten", |ranges, _| way::decibels(ranges, None))],
            ),
        ],
    },
    Clause {
        id: "POSITION-7",
        sentence: "A belief MUST be the mean of what wheels and a fix say, each weighed by its covariance, and MUST \
                   leave out a fix that is as unlikely as one in a thousand.",
        checks: &[&Check::holds(
            NamedRule::new("repaired", belief::fused as Takes),
            &EveryAnswer {
                body: belief::is_mean,
                range: belief::drives,
                covers: &["a fix that counts", "an outlier"],
            },
            &[
                NamedRule::new("fixes are believed without covariance", belief::believed),
                NamedRule::new("wheels alone", belief::by_wheels_alone),
                NamedRule::new("no gate", belief::ungated),
            ],
        )],
    },
];

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
use crate::decide::{EveryAnswer, RandomAnswers};

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

const EXACT: EveryAnswer<Way> =
    EveryAnswer::new(lattice::is_exact, lattice::places, &["four anchors", "three anchors"]);

/// Ways that are as this one but for one thing.
macro_rules! wrong {
    ($way:path: $($name:literal => $wrong:ident),+) => {
        &[$(NamedRule::new($name, |ranges, area| wrong_ways::$wrong($way, ranges, area))),+]
    };
}

macro_rules! inexact {
    ($way:path) => {
        wrong!($way:
            "each anchor takes the distance of the next" => exchanged,
            "the last distance is that of the first" => without_the_last)
    };
}

macro_rules! unmoved {
    ($way:path) => {
        wrong!($way:
            "places are told from the first anchor" => from_the_first,
            "distances along y count twice" => stretched)
    };
}

macro_rules! credulous {
    ($way:path) => {
        wrong!($way:
            "a third anchor is made up" => made_up,
            "a distance that is no number is 1 m" => lenient)
    };
}

const REFUSES: EveryAnswer<Way> = EveryAnswer::new(
    refusals::is_refused_or_told,
    refusals::numbers,
    &["refused for want of anchors or numbers", "told"],
);

const MIRRORED: EveryAnswer<Way> =
    EveryAnswer::new(minima::tells_the_mirror_image, minima::lines, &["a slanting line", "a straight line"]);

const FOLLOWS: EveryAnswer<Way> = EveryAnswer::new(lattice::follows, lattice::moves, &["one position"]);

const FOLLOWS_TWO: EveryAnswer<Way> =
    EveryAnswer::new(lattice::follows, lattice::moves, &["one position", "two positions"]);

const COARSE: EveryAnswer<Conduct> =
    EveryAnswer::new(swarm::never_worsens, swarm::coarse_draws, &["it does not improve", "it improves"]);

/// Swarms that do not keep their best position.
const fn forgetful(conduct: Conduct) -> [NamedRule<Conduct>; 2] {
    [
        NamedRule::new("the best of the present positions", Conduct { best: Best::Now, ..conduct }),
        NamedRule::new("the position of the first particle", Conduct { best: Best::First, ..conduct }),
    ]
}

const INSIDE: EveryAnswer<Way> =
    EveryAnswer::new(lattice::keeps_inside, lattice::rectangles, &["inside", "on the rim"]);

/// The clauses.
pub const CLAUSES: [Clause; 7] = [
    Clause {
        id: "POSITION-1",
        sentence: "From distances without error a way MUST return where the robot is, \
                   wherever anchors are that are not on one line.",
        checks: &[
            &Check::refuted(
                PUBLISHED,
                &EveryAnswer::new(lattice::is_exact_of_three, lattice::places_of_three, &["three anchors"]),
            )
            .under(&holding([("renamed", way::renamed as Way)], [0]))
            .of(&PAPER)
            .judged(lattice::exact),
            &Check::refuted(
                STRONGEST,
                &EveryAnswer::new(lattice::is_exact_of_four, lattice::places_of_four, &["four anchors"]),
            )
            .under(&holding(OF_FOUR, [2]))
            .of(&PAPER)
            .judged(lattice::exact_of_strongest),
            &Check::holds(REPAIRED, &EXACT, inexact!(way::repaired)),
            &Check::holds(METRES, &EXACT, inexact!(way::metres)),
            &Check::holds(DECIBELS, &EXACT, inexact!(way::decibels)),
        ],
    },
    Clause {
        id: "POSITION-2",
        sentence: "Anchors at fewer than three places, and distances that are negative, infinite \
                   or no numbers, MUST be refused; anchors on one line never give one position \
                   beside it, and every coordinate is a number.",
        checks: &[
            &Check::holds(
                PUBLISHED,
                &REFUSES,
                &[
                    NamedRule::new("nobody looks at what is divided by", wrong_ways::unchecked),
                    NamedRule::new("a distance that is no number is 1 m", |ranges, area| {
                        wrong_ways::lenient(way::published, ranges, area)
                    }),
                ],
            ),
            &Check::holds(REPAIRED, &REFUSES, credulous!(way::repaired)),
            &Check::holds(METRES, &REFUSES, credulous!(way::metres)),
            &Check::holds(DECIBELS, &REFUSES, credulous!(way::decibels)),
        ],
    },
    Clause {
        id: "POSITION-3",
        sentence: "Two positions that fit alike MUST both be told.",
        checks: &[
            &Check::holds(METRES, &MIRRORED, wrong!(way::metres: "the better one alone" => better_alone)),
            &Check::holds(DECIBELS, &MIRRORED, wrong!(way::decibels: "the better one alone" => better_alone)),
            &Check::refuted(
                METRES,
                &RandomAnswers::new(
                    minima::tells_second_minima,
                    TRIPLES,
                    minima::random_anchors,
                    &["one minimum", "two minima"],
                ),
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
            &Check::holds(REPAIRED, &FOLLOWS, unmoved!(way::repaired)),
            &Check::holds(METRES, &FOLLOWS_TWO, unmoved!(way::metres)),
            &Check::holds(DECIBELS, &FOLLOWS_TWO, unmoved!(way::decibels)),
        ],
    },
    Clause {
        id: "POSITION-5",
        sentence: "The best position of a swarm MUST never fit worse than the one before, nor than any particle does.",
        checks: &[
            &Check::holds(
                NamedRule::new("published", Conduct::PUBLISHED),
                &COARSE,
                &forgetful(Conduct::PUBLISHED),
            ),
            &Check::holds(
                NamedRule::new("repaired", Conduct::REPAIRED),
                &COARSE,
                &forgetful(Conduct::REPAIRED),
            ),
            &Check::unrefuted(
                NamedRule::new("repaired", Conduct::REPAIRED),
                &RandomAnswers::new(
                    swarm::never_worsens_at_random,
                    SWARMS,
                    swarm::random_swarms,
                    &["it improves"],
                ),
                &forgetful(Conduct::REPAIRED),
            ),
        ],
    },
    Clause {
        id: "POSITION-6",
        sentence: "A position that is asked for within a rectangle MUST be in it, and the same as \
                   without the rectangle if that one is in it.",
        checks: &[
            &Check::holds(METRES, &INSIDE, wrong!(way::metres: "the rectangle is forgotten" => anywhere)),
            &Check::holds(DECIBELS, &INSIDE, wrong!(way::decibels: "the rectangle is forgotten" => anywhere)),
        ],
    },
    Clause {
        id: "POSITION-7",
        sentence: "A belief MUST be the mean of what wheels and a fix say, each weighed by its covariance, and MUST \
                   leave out a fix that is as unlikely as one in a thousand.",
        checks: &[&Check::holds(
            NamedRule::new("repaired", belief::fused as Takes),
            &EveryAnswer::new(belief::is_mean, belief::drives, &["a fix that counts", "an outlier"]),
            &[
                NamedRule::new("fixes are believed without covariance", belief::believed),
                NamedRule::new("wheels alone", belief::by_wheels_alone),
                NamedRule::new("no gate", belief::ungated),
            ],
        )],
    },
];

//! The readings of what Rajesh, Nagaraja and Suja 2024 leave open of frontier cells.

use tautline_kernel::frontier::Condition::{Look, Record};
use tautline_kernel::frontier::{Basis, Otherwise, Rule};

use crate::ambiguity::Charity::{Charitable, Literal};
use crate::ambiguity::{Ambiguity, Interpretation, Paper};

/// Makes the readings of one robot, and those of teams, whose robots may be obstacles to each other.
macro_rules! readings {
    ($(($name:literal, $rule:expr),)*) => {
        /// The readings of the published rule but for the main one, as far as one robot can tell them apart: what a
        /// robot without a candidate does, how it avoids an obstacle, what equation (11) means, and whether the
        /// threshold follows from earlier probabilities of neighbours. Where those of the robot's own cells count as
        /// well, robots at midpoints decide as with a threshold of ½.
        pub(super) const READINGS: [(&str, Rule); 15] = [$(($name, $rule),)*];

        /// All readings but for the main one: first those under which robots do not see each other.
        pub(super) const OF_TEAMS: [(&str, Rule); 31] =
            [$(($name, $rule),)* ("sees", SEES), $((concat!($name, " + sees"), sees($rule)),)*];
    };
}

readings! {
    ("wanders", Rule::WANDERS),
    ("literal", Rule::LITERAL),
    ("wanders + literal", wandering(Rule::LITERAL)),
    ("printed", Rule::PRINTED),
    ("wanders + printed", wandering(Rule::PRINTED)),
    ("literal + printed", Rule::PRINTED.without(Record)),
    ("wanders + literal + printed", wandering(Rule::PRINTED.without(Record))),
    ("adaptive", adaptive(Rule::PUBLISHED)),
    ("wanders + adaptive", adaptive(Rule::WANDERS)),
    ("literal + adaptive", LITERAL_T),
    ("wanders + literal + adaptive", adaptive(wandering(Rule::LITERAL))),
    ("printed + adaptive", adaptive(Rule::PRINTED)),
    ("wanders + printed + adaptive", adaptive(wandering(Rule::PRINTED))),
    ("literal + printed + adaptive", adaptive(Rule::PRINTED.without(Record))),
    ("wanders + literal + printed + adaptive", adaptive(wandering(Rule::PRINTED.without(Record)))),
}

/// The passages that the paper leaves open.
pub(super) static PAPER: Paper = Paper {
    ambiguities: &[
        Ambiguity {
            words: "nothing is said of a robot without a candidate",
            interpretations: &[
                Interpretation::new("stops", "a robot without a candidate stops", Literal),
                Interpretation::new(
                    "wanders",
                    "a robot without a candidate goes to an explored side neighbour",
                    Charitable,
                ),
            ],
        },
        Ambiguity {
            words: "“takes 90° turn and move 5 steps forward and turn 90° again … continues moving until it reaches \
                    the destination”",
            interpretations: &[
                Interpretation::new(
                    "gives up",
                    "a robot gives a cell that it cannot enter up as an obstacle",
                    Charitable,
                ),
                Interpretation::new("literal", "a robot goes on until it is there", Literal),
            ],
        },
        Ambiguity {
            words: "“exactly at the midpoint of the cell, occupancy probability value will be 1”",
            interpretations: &[
                Interpretation::new(
                    "corrected",
                    "d_r in equation (11) is the distance to the rim of the circle",
                    Charitable,
                ),
                Interpretation::new(
                    "printed",
                    "d_r in equation (11) is the distance to the midpoint",
                    Literal,
                ),
            ],
        },
        Ambiguity {
            words: "“threshold value is decided based on previous probability values”",
            interpretations: &[
                Interpretation::new(
                    "fixed",
                    "the threshold is ½, as it is where the robot's own cell counts",
                    Charitable,
                ),
                Interpretation::new(
                    "adaptive",
                    "the threshold is the mean of the four neighbours' probabilities",
                    Literal,
                ),
            ],
        },
        Ambiguity {
            words: "“uses the ultrasonic sensors for obstacle avoidance. If an obstacle is detected”",
            interpretations: &[
                Interpretation::new("blind", "the sensors see what fills a cell, and no robots", Literal),
                Interpretation::new(
                    "sees",
                    "a robot in the next cell, or on its way there, is an obstacle",
                    Charitable,
                ),
            ],
        },
    ],
    excluded: &[],
    repairs: &["plain", "repaired"],
};

const fn wandering(rule: Rule) -> Rule {
    Rule { otherwise: Otherwise::Wanders, ..rule }
}

/// Robots that do not store obstacles, whose threshold follows from earlier probabilities.
pub(super) const LITERAL_T: Rule = adaptive(Rule::LITERAL);

/// Robots that are obstacles to each other.
pub(super) const SEES: Rule = sees(Rule::PUBLISHED);

/// This rule for robots that are obstacles to each other.
const fn sees(rule: Rule) -> Rule {
    Rule { conditions: rule.conditions.with(Look), ..rule }
}

/// This rule with a threshold that is the mean of the neighbours' probabilities.
pub(super) const fn adaptive(rule: Rule) -> Rule {
    Rule { basis: Basis::Neighbours, ..rule }
}

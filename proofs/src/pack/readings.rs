//! The readings of what Jasmine Xavier and Shantha Selva Kumari 2013 leave open. The judge's plain words follow them,
//! so that the kernel has the published one alone.

use tautline_kernel::pack::Rule;

use crate::ambiguity::Charity::{Literal, Probable};
use crate::ambiguity::{Ambiguity, Interpretation, Paper};
use crate::judge::pack::Metric;

/// A pack as a check looks at it.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) struct Subject {
    pub(super) rule: Rule,
    /// The distance that its robots compare: another one than the published one
    /// is followed by the published rule alone.
    pub(super) metric: Metric,
    /// A flaw that no condition expresses: a mutant's.
    pub(super) flaw: Option<Flaw>,
}

/// A flaw of a pack beside its rule.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Flaw {
    /// Robots choose by what they would see alone, however far it is. They choose beside the rule, where gains are
    /// compared, and their team moves are the rule's.
    HeedsNoWay,
    /// Robots forget after each team move what they have seen.
    Forgets,
    /// They make two team moves in one.
    TwoAtOnce,
}

impl Subject {
    pub(super) const fn of(rule: Rule) -> Self {
        Self { rule, metric: Metric::CellsBySteps, flaw: None }
    }
}

/// The published pack that compares this.
const fn read(metric: Metric) -> Subject {
    Subject { metric, ..Subject::of(Rule::PUBLISHED) }
}

/// The readings but for the published one.
pub(super) const READINGS: [(&str, Subject); 3] = [
    ("share", read(Metric::ShareBySteps)),
    ("line", read(Metric::CellsByLine)),
    ("share + line", read(Metric::ShareByLine)),
];

/// The passages that the paper leaves open.
pub(super) static PAPER: Paper = Paper {
    ambiguities: &[
        Ambiguity {
            words: "“the fraction of unexplored areas around a point, which are inside the sensing radius”",
            interpretations: &[
                Interpretation::new("cells", "the visibility gain is the number of unknown cells", Probable),
                Interpretation::new("share", "it is their share of the cells in sight", Literal),
            ],
        },
        Ambiguity {
            words: "“the distance … a robot has to travel”",
            interpretations: &[
                Interpretation::new("steps", "the distance is that over known cells", Literal),
                Interpretation::new("line", "it is that of the straight line", Literal),
            ],
        },
    ],
    excluded: &[],
    repairs: &["repaired"],
};

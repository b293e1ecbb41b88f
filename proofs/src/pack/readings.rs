//! The readings of what Jasmine Xavier and Shantha Selva Kumari 2013 leave open. The judge's plain words follow them,
//! so that the kernel has the published one alone.

use tautline_kernel::pack::Rule;

use crate::ambiguity::Charity::{Literal, Probable};
use crate::ambiguity::{Ambiguity, Interpretation, Paper};
use crate::judge::pack::{Choice, Frontier, Metric};

/// A pack as a check looks at it.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) struct Subject {
    pub(super) rule: Rule,
    /// How its robots choose: another way than the published one is followed by the published rule alone.
    pub(super) choice: Choice,
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
        Self { rule, choice: Choice::PUBLISHED, flaw: None }
    }
}

/// The published pack that compares this, among these cells.
const fn read(metric: Metric, frontier: Frontier) -> Subject {
    Subject { choice: Choice { metric, frontier }, ..Subject::of(Rule::PUBLISHED) }
}

/// The readings but for the published one.
pub(super) const READINGS: [(&str, Subject); 7] = [
    ("share", read(Metric::ShareBySteps, Frontier::Explored)),
    ("line", read(Metric::CellsByLine, Frontier::Explored)),
    ("share + line", read(Metric::ShareByLine, Frontier::Explored)),
    ("unexplored", read(Metric::CellsBySteps, Frontier::Unexplored)),
    ("share + unexplored", read(Metric::ShareBySteps, Frontier::Unexplored)),
    ("line + unexplored", read(Metric::CellsByLine, Frontier::Unexplored)),
    ("share + line + unexplored", read(Metric::ShareByLine, Frontier::Unexplored)),
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
        Ambiguity {
            words: "“at the boundary between the explored and the unexplored area”",
            interpretations: &[
                Interpretation::new(
                    "explored",
                    "a frontier cell is explored, beside an unexplored one",
                    Probable,
                ),
                Interpretation::new("unexplored", "it is unexplored, beside an explored one", Literal),
            ],
        },
    ],
    excluded: &[],
    repairs: &["repaired"],
};

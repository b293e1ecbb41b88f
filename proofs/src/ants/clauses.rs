//! The clauses of Ants.

use std::convert::Infallible;

use tautline_kernel::ants::Rule;
use tautline_kernel::floor::Replaced::{Beside, Counted};

use super::{replaced, ties};
use crate::ambiguity::Paper;
use crate::clause::{Check, Clause, NamedRule, readings};
use crate::decide::{EveryAnswer, Verdict};
use crate::floor::plans::Area;
use crate::floor::series::{Deception, Floors, MISSED, Subject};
use crate::floor::team::{Demand, Series};

const PUBLISHED: NamedRule<Subject<Rule>> = NamedRule::new("published", Subject::of(Rule::PUBLISHED));
const REPAIRED: NamedRule<Subject<Rule>> = NamedRule::new("repaired", Subject::of(Rule::Repaired));

static PAPER: Paper = Paper { ambiguities: &[MISSED], excluded: &[], repairs: &["repaired"] };

const BESIDE: NamedRule<Rule> = NamedRule::new("beside", Rule::Published(Beside));
const COUNTED: NamedRule<Rule> = NamedRule::new("counted", Rule::Published(Counted));
const READINGS: [(&str, Rule); 2] = [(BESIDE.name, BESIDE.rule), (COUNTED.name, COUNTED.rule)];
const EXPLORING: [(&str, Subject<Rule>); 2] =
    [(BESIDE.name, Subject::of(BESIDE.rule)), (COUNTED.name, Subject::of(COUNTED.rule))];

/// Ants that lose what a missed sensor counts.
const LOST: &[NamedRule<Rule>] = &[NamedRule::new("the missed sensor is lost", Rule::PUBLISHED)];

/// Ants whose sensors count nothing.
const fn uncounted(scheme: Rule) -> NamedRule<Subject<Rule>> {
    NamedRule::new("sensors count nothing", Subject { scheme, deception: Deception::CountsNothing })
}

/// A run is over when every cell is explored, since crossings go on to grow for ever.
const EXPLORES: Floors<Infallible> = Floors::new(
    &[
        Series::new(Area::blocked(4, 4), 1),
        Series::missing(Area::blocked(3, 3), 1, 2),
        Series::new(Area::blocked(3, 2), 2),
    ],
    Demand::Explores,
);

const KEEPS: EveryAnswer<Rule> = EveryAnswer {
    body: replaced::keeps,
    range: replaced::pairs,
    covers: &["a missed sensor", "a sensor that is seen"],
};

/// The clauses.
pub static CLAUSES: [Clause; 3] = [
    Clause {
        id: "ANTS-1",
        sentence: "Ants MUST explore every cell that is connected with their start, whatever sensors are missed a \
               finite number of times.",
        checks: &[
            &Check::new(PUBLISHED, &EXPLORES, Verdict::Holds, &[])
                .under(&readings(EXPLORING, [Verdict::Holds; 2]))
                .of(&PAPER),
            &Check::new(REPAIRED, &EXPLORES, Verdict::Holds, &[uncounted(Rule::Repaired)]),
        ],
    },
    Clause {
        id: "ANTS-2",
        sentence: "An ant MUST go to the side neighbour that was entered least, the first in the order of the compass.",
        checks: &[&Check::new(
            PUBLISHED,
            &EveryAnswer { body: ties::ties, range: ties::counts, covers: &["a side", "no side"] },
            Verdict::Holds,
            &[uncounted(Rule::PUBLISHED)],
        )],
    },
    Clause {
        id: "ANTS-3",
        sentence: "A cell MUST NOT count fewer agents after a missed sensor was replaced than before.",
        checks: &[
            &Check::new(NamedRule::new("published", Rule::PUBLISHED), &KEEPS, Verdict::Refuted, &[])
                .under(&readings(READINGS, [Verdict::Holds; 2]))
                .of(&PAPER)
                .judged(replaced::replacement),
            &Check::new(BESIDE, &KEEPS, Verdict::Holds, LOST),
            &Check::new(COUNTED, &KEEPS, Verdict::Holds, LOST),
            &Check::new(NamedRule::new("repaired", Rule::Repaired), &KEEPS, Verdict::Refuted, &[])
                .because("the repair loses counts as well")
                .judged(replaced::replacement),
        ],
    },
];

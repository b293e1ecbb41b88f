//! The readings of what Kovács, Pásztor and Istenes 2011 leave open. The plain recursion follows them, so that the
//! kernel has the published one alone.

use tautline_kernel::conditions;
use tautline_kernel::ground::Cell;

use crate::ambiguity::Charity::{Literal, Probable};
use crate::ambiguity::{Ambiguity, Interpretation, Paper};

conditions! {
    /// A reading other than the published one, by the sentence it stands for.
    pub enum Reading in u16 {
        /// The robots start in a row from the base to the east, over sides that are known to be open.
        InARow,
        /// The null move stands at the end of the leader's list.
        NullLast,
        /// A candidate of the leader outside E_C of the robot behind gets its virtual obstacle when it is examined.
        OnceExamined,
        /// Of the leader's candidates those alone get a virtual obstacle for which followers were sought in vain.
        Unfollowed,
        /// A follower has no candidate where no unexplored cell can be walked to.
        Pathless,
        /// A backtrack takes the last team move back that moved a robot.
        LastMoved,
    }
}

/// A set of readings.
pub type Readings = Conditions;

/// Where `robots` start, base first.
pub(super) fn starts(readings: Readings, base: Cell, robots: usize) -> impl Iterator<Item = Cell> {
    let columns = i16::from(readings.has(Reading::InARow));
    (0..robots).map(move |robot| base.at_offset(robot as i16 * columns, 0))
}

/// The passages that the paper leaves open, as far as they make a difference.
pub(super) static PAPER: Paper = Paper {
    ambiguities: &[
        Ambiguity {
            words: "“we are back in the original position”",
            interpretations: &[
                Interpretation::new("together", "all robots start in the base", Probable),
                Interpretation::new("row", "the robots start in a row from the base", Literal),
            ],
        },
        Ambiguity {
            words: "“substitutes the proposed position by P_N in PLN_N”",
            interpretations: &[
                Interpretation::new("in place", "the null move stands where the candidate stood", Literal),
                Interpretation::new("last", "the null move stands at the end of the list", Literal),
            ],
        },
    ],
    excluded: &[],
    repairs: &[],
};

//! What a run of the chain may never break: the safety sentences that every frame is checked against (CHAIN-1, CHAIN-2,
//! CHAIN-3), and those about what plans cost and how runs end.

use serde::{Deserialize, Serialize};
use tautline_kernel::chain::{Kind, Message, Outcome};
use tautline_kernel::ground::{Cell, Circle, Step};

use crate::run::Frame;

/// The frame of a team move after which the messages of R_2 … R_N were sent and the team was in `cells`.
pub fn frame(kind: Kind, messages: &[u8], cells: &[Cell]) -> Frame {
    let base = Message { step: Step::Stay, outcome: Outcome::Arrived };
    let messages = messages.iter().filter_map(|&byte| Message::decode(byte).ok());
    let (steps, blocked) = std::iter::once(base)
        .chain(messages)
        .map(|message| (message.step, message.outcome == Outcome::Blocked))
        .unzip();
    Frame { kind, steps, blocked, cells: cells.to_vec() }
}

/// What no chain may do, whatever the layout.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Breach {
    /// The whole cell of a neighbour in the chain is not covered: CHAIN-1, E_C membership.
    Contact,
    /// Three robots or more are in one cell outside the base: CHAIN-2.
    Crowding,
    /// The centres of two neighbours in the chain were, perhaps only on the way, out of range: CHAIN-3.
    Coverage,
    /// A plan looked at more than [`CHEAP_LOOKS`] candidates of followers for each robot: CHAIN-12.
    Costly,
    /// The run has ended, and a cell within reach is unexplored: CHAIN-13.
    Completeness,
}

impl Breach {
    /// Those of the chain that are seen in where its robots are.
    pub const CHAIN: [Self; 4] = [Self::Contact, Self::Crowding, Self::Coverage, Self::Completeness];

    /// The id of the clause that is broken.
    pub const fn clause(self) -> &'static str {
        match self {
            Self::Contact => "CHAIN-1",
            Self::Crowding => "CHAIN-2",
            Self::Coverage => "CHAIN-3",
            Self::Costly => "CHAIN-12",
            Self::Completeness => "CHAIN-13",
        }
    }

    /// Whether the team move from `before` to `after` commits it; the base stands first in both. Completeness is of
    /// the end of a run, and in no team move; where robots are does not tell what they know, or what a plan has cost.
    #[inline]
    pub fn is_in(self, before: &[Cell], after: &[Cell]) -> bool {
        match self {
            Self::Contact => {
                let mut pairs = after.iter().zip(after.iter().skip(1));
                pairs.any(|(&one, &other)| !Circle::COVERED.covers(one, other))
            }
            Self::Crowding => (3..after.len()).any(|robot| {
                let (cell, others) = (after[robot], &after[1..robot]);
                cell != after[0] && others.iter().filter(|&&other| other == cell).count() >= 2
            }),
            Self::Coverage => {
                let ways = before.iter().zip(after).map(|(&from, &to)| [from, to]);
                ways.clone().zip(ways.skip(1)).any(|(one, other)| !stays_in_range(one, other))
            }
            Self::Costly | Self::Completeness => false,
        }
    }
}

/// Candidates of followers for each robot of a chain, the base counted, that a plan may look at by CHAIN-12.
pub const CHEAP_LOOKS: u32 = 100;

/// Whether two robots that go from the first to the second of their cells, each at any speeds and with any
/// pauses, keep their centres within r_cov of each other. Their offset moves inside the parallelogram of the
/// four differences, and distance is convex, so its corners decide.
#[inline]
pub fn stays_in_range(one: [Cell; 2], other: [Cell; 2]) -> bool {
    let reaches = |a: usize, b: usize| Circle::COVERED.reaches(one[a], other[b]);
    reaches(0, 0) & reaches(0, 1) & reaches(1, 0) & reaches(1, 1)
}

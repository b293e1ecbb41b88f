//! The sentences that no run of the chain may break: the safety sentences that every frame is checked against (CHAIN-1,
//! CHAIN-2, CHAIN-3), and those about what plans cost and how runs end.

use std::mem::replace;

use serde::{Deserialize, Serialize};
use tautline_kernel::chain::{Kind, Message, Outcome};
use tautline_kernel::ground::{Cell, Circle, Step};

use crate::judge::chain::Move;
use crate::run::{Frame, place};

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

/// The team move of `frame` as the judge reads it.
pub fn written(frame: &Frame) -> Move {
    Move {
        is_backtrack: frame.kind == Kind::Backtrack,
        tried: frame.steps.iter().map(|&step| place(Cell::new(0, 0).after(step))).collect(),
        blocked: frame.blocked.clone(),
        places: frame.cells.iter().copied().map(place).collect(),
    }
}

/// A violation that no chain may commit, whatever the layout.
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

    /// The demand that it breaks, in words.
    pub(super) const fn words(self) -> &'static str {
        match self {
            Self::Contact => "each neighbour's cell is wholly covered",
            Self::Crowding => "no three robots are in one cell outside the base",
            Self::Coverage => "the neighbours' centres stay within r_cov",
            Self::Costly | Self::Completeness => "this is seen in no team move",
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
                cell != after[0] && others.iter().filter(|&&other| other == cell).nth(1).is_some()
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

/// Whether a team move commits none of the breaches that are seen in where robots are, at a glance: if not, each of
/// them tells. The base stands first in both.
#[inline]
pub(super) fn is_harmless(before: &[Cell], after: &[Cell]) -> bool {
    let mut robots = before.iter().zip(after).map(|(&from, &to)| (from, Pairs::way(from, to)));
    let Some(mut behind) = robots.next() else { return true };
    let keep_contact = robots.all(|ahead| Pairs::TABLE.keep_contact(replace(&mut behind, ahead), ahead));
    keep_contact && !Breach::Crowding.is_in(before, after)
}

/// By the offset of two robots, from −4 to 3 columns and rows, what the first does and what the other does: whether
/// they are in E_C of each other afterwards and their centres stay in range.
struct Pairs([[u16; 9]; 64]);

impl Pairs {
    const TABLE: &Self = &Self::new();

    const fn new() -> Self {
        let mut pairs = [[0; 9]; 64];
        let mut place = 0;
        while place < 64 * 81 {
            let (offset, one, other) = (place / 81, place / 9 % 9, place % 9);
            let (origin, from) =
                (Cell::new(0, 0), Cell::new((offset % 8) as i16 - 4, (offset / 8) as i16 - 4));
            let (to, other_to) = (Self::moved(origin, one), Self::moved(from, other));
            let keeps =
                Circle::COVERED.covers(to, other_to) && stays_in_range([origin, to], [from, other_to]);
            pairs[offset][one] |= (keeps as u16) << other;
            place += 1;
        }
        Self(pairs)
    }

    const fn moved(from: Cell, way: usize) -> Cell {
        Cell::new(from.x + (way % 3) as i16 - 1, from.y + (way / 3) as i16 - 1)
    }

    /// Which of the nine cells in and round its own a robot goes to; more than eight if none.
    #[inline]
    fn way(from: Cell, to: Cell) -> usize {
        let columns = (i32::from(to.x) - i32::from(from.x) + 1) as u32;
        let rows = (i32::from(to.y) - i32::from(from.y) + 1) as u32;
        if columns < 3 && rows < 3 { (3 * rows + columns) as usize } else { usize::MAX }
    }

    #[inline]
    fn keep_contact(&self, (from, way): (Cell, usize), (other_from, other_way): (Cell, usize)) -> bool {
        let columns = (i32::from(other_from.x) - i32::from(from.x) + 4) as u32;
        let rows = (i32::from(other_from.y) - i32::from(from.y) + 4) as u32;
        let offset = (rows << 3 | columns) as usize;
        let kept = if columns < 8 { self.0.get(offset).and_then(|ways| ways.get(way)) } else { None };
        kept.is_some_and(|kept| other_way < 9 && kept >> other_way & 1 == 1)
    }
}

/// Whether two robots that go from the first to the second of their cells, each at any speeds and with any
/// pauses, keep their centres within r_cov of each other. Their offset moves inside the parallelogram of the
/// four differences, and distance is convex, so its corners decide.
#[inline]
pub const fn stays_in_range(one: [Cell; 2], other: [Cell; 2]) -> bool {
    let circle = Circle::COVERED;
    circle.reaches(one[0], other[0])
        & circle.reaches(one[0], other[1])
        & circle.reaches(one[1], other[0])
        & circle.reaches(one[1], other[1])
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every two robots near each other, whatever they do, also what no robot can.
    #[test]
    fn what_is_harmless_at_a_glance_commits_no_breach() {
        let near = || (-5..=5).flat_map(|x| (-5..=5).map(move |y| Cell::new(x, y)));
        let round =
            |from: Cell| (-2..=2).flat_map(move |x| (-2..=2).map(move |y| Cell::new(from.x + x, from.y + y)));
        let mut harmless = 0;
        for (from, to) in near().flat_map(|from| round(from).map(move |to| (from, to))) {
            for other_to in round(Cell::new(0, 0)) {
                let (before, after) = ([Cell::new(0, 0), from], [other_to, to]);
                let commits = [Breach::Contact, Breach::Crowding, Breach::Coverage]
                    .iter()
                    .any(|breach| breach.is_in(&before, &after));
                assert!(!(commits && is_harmless(&before, &after)), "{before:?} {after:?}");
                let are_steps = [(before[0], after[0]), (from, to)].iter().all(|(from, to)| {
                    let (columns, rows) = from.apart(*to);
                    columns.max(rows) <= 1
                });
                assert!(commits || !are_steps || is_harmless(&before, &after), "{before:?} {after:?}");
                harmless += u32::from(!commits);
            }
        }
        assert!(harmless > 0);
    }
}

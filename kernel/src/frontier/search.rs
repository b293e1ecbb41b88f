//! The ways to the cells that a robot knows nothing of.

use core::ops::ControlFlow;

use super::map::{BY_NUMBER, Map, Status};
use crate::ground::{Cell, Side};

/// What a search knows of a cell.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Reached {
    /// The search that has reached it last.
    round: u32,
    distance: u32,
    first: Side,
}

impl Reached {
    /// No search has reached it.
    pub const NEVER: Self = Self { round: 0, distance: 0, first: Side::East };
}

/// The memory of one search.
#[derive(Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub(super) struct Search<'a> {
    pub(super) reached: &'a mut [Reached],
    pub(super) queue: &'a mut [Cell],
    pub(super) rounds: &'a mut u32,
}

/// An unexplored cell that a search has reached through explored ones.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Found {
    /// The cell.
    pub cell: Cell,
    /// Moves to it.
    pub distance: u32,
    /// The side through which the first of them goes: of ways as short the one whose side leads to the lowest number.
    pub first: Side,
}

/// Tells of the unexplored cells that are reached from `from` through explored ones in at most so many moves, the nearest first,
/// until it is told to stop. Of ways as short the one counts whose first side leads to the lowest number.
pub(super) fn search<M: Map>(
    map: &M,
    from: Cell,
    most: u32,
    memory: &mut Search<'_>,
    mut tell: impl FnMut(Found) -> ControlFlow<()>,
) {
    let area = map.area();
    let place = |cell| area.locate(cell).map(|(column, row)| row * area.width() + column);
    *memory.rounds = memory.rounds.wrapping_add(1);
    let round = *memory.rounds;
    let (mut head, mut tail) = (0, 0);
    let mut left = map.frontier();
    let mut at = Found { cell: from, distance: 0, first: Side::East };
    if let Some(reached) = place(from).and_then(|place| memory.reached.get_mut(place)) {
        *reached = Reached { round, ..Reached::NEVER };
    }
    while at.distance < most && left > 0 {
        for side in BY_NUMBER {
            let cell = at.cell.beyond(side);
            let Some(reached) = place(cell).and_then(|place| memory.reached.get_mut(place)) else {
                continue;
            };
            if reached.round == round {
                continue;
            }
            let status = map.status(cell);
            if status == Status::Obstacle {
                continue;
            }
            let first = if at.distance == 0 { side } else { at.first };
            *reached = Reached { round, distance: at.distance + 1, first };
            let found = Found { cell, distance: at.distance + 1, first };
            if status == Status::Unexplored {
                left = left.saturating_sub(1);
                if tell(found).is_break() {
                    return;
                }
            } else if let Some(next) = memory.queue.get_mut(tail) {
                *next = cell;
                tail += 1;
            }
        }
        let Some(&cell) = memory.queue.get(head).filter(|_| head < tail) else { return };
        head += 1;
        let Some(reached) = place(cell).and_then(|place| memory.reached.get(place)) else { return };
        at = Found { cell, distance: reached.distance, first: reached.first };
    }
}

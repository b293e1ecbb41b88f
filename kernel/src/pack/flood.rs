//! A flood over the cells that are known to be free: nearest first, each with the side through which it was entered.

use super::chart::{Chart, Status};
use crate::ground::{Cell, Side};

/// The memory of floods, for as many cells as the area has; with less, cells are left out.
#[derive(Debug)]
pub struct Scratch<'a> {
    /// One for each cell: zeros at first.
    pub reached: &'a mut [u32],
    /// One for each cell.
    pub queue: &'a mut [Cell],
    /// One for each cell: zeros at first. The visibility gain that a robot would have had there when it
    /// was last looked at, and one more. Gains never grow, since unknown cells only become known, and let
    /// rays pass before that: so it is a bound.
    pub gains: &'a mut [u16],
    /// Floods so far: it goes on from the last one with the same memory.
    pub rounds: &'a mut u32,
}

/// The lowest bits of what is noted of a cell: through which side it was entered.
const SIDE_BITS: u32 = 2;
const SIDES: u32 = (1 << SIDE_BITS) - 1;

/// A flood that goes on as long as it is asked.
pub(super) struct Flood<'f, 'm, W> {
    chart: &'f Chart<W>,
    memory: &'f mut Scratch<'m>,
    start: Cell,
    /// Cells told so far, and cells in the queue.
    told: usize,
    queued: usize,
    /// Where the cells end that are as far as the last one told, and how far that is.
    level_end: usize,
    level: u32,
}

impl<'f, 'm, W: AsRef<[[u64; 2]]>> Flood<'f, 'm, W> {
    pub(super) fn new(chart: &'f Chart<W>, memory: &'f mut Scratch<'m>, start: Cell) -> Self {
        if *memory.rounds >= u32::MAX >> SIDE_BITS {
            memory.reached.fill(0);
            *memory.rounds = 0;
        }
        *memory.rounds += 1;
        let mut flood = Self { chart, memory, start, told: 0, queued: 0, level_end: 1, level: 0 };
        flood.reach(start, Side::East);
        flood
    }

    /// Reaches `cell` through the side `by` of the cell before it, if it is new.
    #[inline]
    fn reach(&mut self, cell: Cell, by: Side) {
        let Some(place) = self.chart.area().place(cell) else { return };
        let Some(reached) = self.memory.reached.get_mut(place) else { return };
        if *reached >> SIDE_BITS == *self.memory.rounds {
            return;
        }
        *reached = *self.memory.rounds << SIDE_BITS | by as u32;
        if let Some(free) = self.memory.queue.get_mut(self.queued) {
            *free = cell;
            self.queued += 1;
        }
    }

    /// The next cell, how far it is, and whether it is beside an unknown one.
    #[inline]
    pub(super) fn next(&mut self) -> Option<(Cell, u32, bool)> {
        if self.told >= self.queued {
            return None;
        }
        if self.told == self.level_end {
            self.level += 1;
            self.level_end = self.queued;
        }
        let cell = *self.memory.queue.get(self.told)?;
        self.told += 1;
        let mut is_frontier = false;
        for side in Side::ALL {
            let beyond = cell.beyond(side);
            match self.chart.status(beyond) {
                Status::Free => self.reach(beyond, side),
                Status::Unknown => is_frontier = true,
                Status::Obstacle => {}
            }
        }
        Some((cell, self.level, is_frontier))
    }

    /// No less than the visibility gain of `cell`, by what was noted of it; `None` if nothing was.
    pub(super) fn bound(&self, cell: Cell) -> Option<u32> {
        let noted = *self.memory.gains.get(self.chart.area().place(cell)?)?;
        noted.checked_sub(1).map(u32::from)
    }

    /// Notes the visibility gain of `cell`.
    pub(super) fn note(&mut self, cell: Cell, gain: u32) {
        let place = self.chart.area().place(cell);
        if let Some(noted) = place.and_then(|place| self.memory.gains.get_mut(place)) {
            *noted = u16::try_from(gain + 1).unwrap_or(u16::MAX);
        }
    }

    /// The side of the cell before `cell` through which the flood came to it; `None`
    /// at the start, and where it did not come.
    pub(super) fn side_before(&self, cell: Cell) -> Option<Side> {
        let reached = *self.memory.reached.get(self.chart.area().place(cell)?)?;
        let is_after_start = cell != self.start && reached >> SIDE_BITS == *self.memory.rounds;
        is_after_start.then_some(())?;
        Side::ALL.get((reached & SIDES) as usize).copied()
    }
}

//! The ways to the cells that a robot knows nothing of.

use core::ops::ControlFlow;

use super::map::{BY_NUMBER, Map, Status};
use crate::ground::{Cell, Side};

/// A search's record of a cell.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct SearchCell {
    /// The search that has reached it last.
    round: u32,
    distance: u32,
    first: Side,
}

impl SearchCell {
    /// No search has reached it.
    pub const NEVER: Self = Self { round: 0, distance: 0, first: Side::East };
}

/// The memory of searches, for as many cells as the area has.
#[derive(Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Search<'a> {
    /// One for each cell.
    pub reached: &'a mut [SearchCell],
    /// One for each cell.
    pub queue: &'a mut [Cell],
    /// Searches so far: it goes on from the last one with the same memory.
    pub rounds: &'a mut u32,
}

/// An unexplored cell that a search has reached through explored ones.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Target {
    /// The cell.
    pub cell: Cell,
    /// Moves to it.
    pub distance: u32,
    /// The side through which the first of them goes: of ways as short the one whose side leads to the lowest number.
    pub first: Side,
}

/// A robot's way to an unexplored cell, and whose that cell is as far as the others have told.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Way {
    /// It is the cell of the robot's pair.
    Paired(Target),
    /// All cells are the others', and this one comes first for the robot.
    Taken(Target),
    /// The cell of the robot's pair is farther than the robot may go, and this one comes first for it.
    Near(Target),
}

/// Tells of the unexplored cells that are reached from `from` through explored ones in at most
/// so many moves, the nearest first, until it is told to stop. Of ways as short the one counts
/// whose first side leads to the lowest number.
pub(super) fn search<M: Map>(
    map: &M,
    from: Cell,
    most: u32,
    memory: &mut Search<'_>,
    mut tell: impl FnMut(Target) -> ControlFlow<()>,
) {
    let area = map.area();
    *memory.rounds = memory.rounds.wrapping_add(1);
    let round = *memory.rounds;
    let (mut head, mut tail) = (0, 0);
    let mut left = map.frontier();
    let mut at = Target { cell: from, distance: 0, first: Side::East };
    if let Some(reached) = area.place(from).and_then(|place| memory.reached.get_mut(place)) {
        *reached = SearchCell { round, ..SearchCell::NEVER };
    }
    while at.distance < most && left > 0 {
        for side in BY_NUMBER {
            let cell = at.cell.beyond(side);
            let reached = area.place(cell).and_then(|place| memory.reached.get_mut(place));
            let Some(reached) = reached.filter(|reached| reached.round != round) else { continue };
            let status = map.status(cell);
            if matches!(status, Status::Obstacle | Status::Body) {
                continue;
            }
            let first = if at.distance == 0 { side } else { at.first };
            *reached = SearchCell { round, distance: at.distance + 1, first };
            let found = Target { cell, distance: at.distance + 1, first };
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
        let Some(reached) = area.place(cell).and_then(|place| memory.reached.get(place)) else { return };
        at = Target { cell, distance: reached.distance, first: reached.first };
    }
}

#[cfg(test)]
mod tests {
    use core::cell::Cell as Counter;

    use super::*;
    use crate::frontier::TinyMap;
    use crate::ground::Area;

    /// A map that counts how often it is asked.
    struct CountingMap {
        map: TinyMap,
        frontier: usize,
        times: Counter<u32>,
    }

    impl Map for CountingMap {
        fn area(&self) -> Area {
            self.map.area()
        }

        fn status(&self, cell: Cell) -> Status {
            self.times.set(self.times.get() + 1);
            self.map.status(cell)
        }

        fn frontier(&self) -> usize {
            self.frontier
        }

        fn learn(&mut self, cell: Cell, status: Status) {
            self.map.learn(cell, status);
        }
    }

    /// A corridor of eight cells, of which the first and the seventh are unexplored.
    fn corridor() -> CountingMap {
        let area = Area::new(Cell::new(0, 0), Cell::new(7, 0)).expect("an area");
        let mut map = TinyMap::new(area).expect("8 cells");
        for x in [1, 2, 3, 4, 5, 7] {
            map.learn(Cell::new(x, 0), Status::Explored);
        }
        CountingMap { map, frontier: usize::MAX, times: Counter::new(0) }
    }

    /// The cells that are found within so many moves of the cell in this column: the column and the distance of each.
    fn found(map: &CountingMap, column: i16, most: u32) -> ([(i16, u32); 4], usize) {
        let (mut reached, mut queue, mut rounds) = ([SearchCell::NEVER; 8], [Cell::new(0, 0); 8], 0);
        let mut memory = Search { reached: &mut reached, queue: &mut queue, rounds: &mut rounds };
        let (mut cells, mut count) = ([(0, 0); 4], 0);
        search(map, Cell::new(column, 0), most, &mut memory, |found| {
            cells[count] = (found.cell.x, found.distance);
            count += 1;
            ControlFlow::Continue(())
        });
        (cells, count)
    }

    #[test]
    fn cells_are_found_within_so_many_moves_and_no_more() {
        let map = corridor();
        assert_eq!(found(&map, 2, 1).1, 0);
        for most in 2..4 {
            assert_eq!(found(&map, 2, most), ([(0, 2), (0, 0), (0, 0), (0, 0)], 1), "within {most} moves");
        }
        for most in [4, u32::MAX] {
            assert_eq!(found(&map, 2, most), ([(0, 2), (6, 4), (0, 0), (0, 0)], 2), "within {most} moves");
        }
    }

    #[test]
    fn the_cell_where_a_search_begins_is_not_found_though_it_is_unexplored() {
        assert_eq!(found(&corridor(), 0, u32::MAX), ([(6, 6), (0, 0), (0, 0), (0, 0)], 1));
    }

    #[test]
    fn a_search_that_has_found_the_whole_frontier_looks_no_farther() {
        let all = corridor();
        assert_eq!(found(&all, 2, u32::MAX).1, 2);
        let one = CountingMap { frontier: 1, ..corridor() };
        assert_eq!(found(&one, 2, u32::MAX), ([(0, 2), (0, 0), (0, 0), (0, 0)], 1));
        assert!(one.times.get() < all.times.get());
    }
}

//! A team's knowledge of its area: explored cells, and the sides that were tried.

use std::collections::VecDeque;

use tautline_kernel::ground::{Area, Cell, Edge, Side};

/// A side, as far as it is known.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum SideStatus {
    Nothing,
    Open,
    Wall,
}

/// The map, and how far each cell is from an unexplored one.
#[derive(Clone, Debug)]
pub(super) struct Map {
    area: Area,
    /// Row by row.
    is_explored: Vec<bool>,
    unexplored: usize,
    /// Row by row: the east side and the south side of each cell.
    sides: Vec<[SideStatus; 2]>,
    /// Row by row; [`FAR`] for cells from which none can be reached.
    distances: Vec<u32>,
    is_stale: bool,
}

/// The distance of cells from which no unexplored cell can be reached.
const FAR: u32 = u32::MAX;

impl Map {
    /// Nothing of `area` is explored.
    pub(super) fn new(area: Area) -> Self {
        let cells = area.width() * area.height();
        Self {
            area,
            is_explored: vec![false; cells],
            unexplored: cells,
            sides: vec![[SideStatus::Nothing; 2]; cells],
            distances: vec![0; cells],
            is_stale: true,
        }
    }

    pub(super) const fn area(&self) -> Area {
        self.area
    }

    /// Whether every cell is explored.
    pub(super) const fn is_whole(&self) -> bool {
        self.unexplored == 0
    }

    /// Notes that a robot is in `cell`; whether that is new.
    pub(super) fn explore(&mut self, cell: Cell) -> bool {
        let Some(place) = self.area.place(cell).filter(|&place| !self.is_explored[place]) else {
            return false;
        };
        self.is_explored[place] = true;
        self.unexplored -= 1;
        self.is_stale = true;
        true
    }

    fn side(&self, edge: Edge) -> SideStatus {
        let is_inner = self.area.contains(edge.cell().beyond(edge.side()));
        let place = self.area.place(edge.cell()).filter(|_| is_inner);
        place.map_or(SideStatus::Wall, |place| self.sides[place][usize::from(edge.side() == Side::South)])
    }

    /// Whether `edge` is known to be a wall; all sides of the area are.
    pub(super) fn is_wall(&self, edge: Edge) -> bool {
        self.side(edge) == SideStatus::Wall
    }

    /// Whether `edge` is known to be open.
    pub(super) fn is_open(&self, edge: Edge) -> bool {
        self.side(edge) == SideStatus::Open
    }

    /// Notes what a robot met that tried to cross `edge`; whether that is a new wall.
    pub(super) fn meet(&mut self, edge: Edge, is_open: bool) -> bool {
        let Some(place) = self.area.place(edge.cell()) else { return false };
        let side = &mut self.sides[place][usize::from(edge.side() == Side::South)];
        let is_new = *side == SideStatus::Nothing && !is_open;
        *side = if is_open { SideStatus::Open } else { SideStatus::Wall };
        self.is_stale |= is_new;
        is_new
    }

    /// How many sides, none of them known to be a wall, are crossed on the shortest way from `cell` to an unexplored
    /// cell; `None` if there is no such way.
    pub(super) fn distance(&self, cell: Cell) -> Option<u32> {
        self.area.place(cell).map(|place| self.distances[place]).filter(|&distance| distance != FAR)
    }

    /// Brings the distances up to date: a flood fill from all unexplored cells at once.
    pub(super) fn refresh(&mut self) {
        if !self.is_stale {
            return;
        }
        self.is_stale = false;
        self.distances.fill(FAR);
        let mut queue: VecDeque<Cell> = VecDeque::new();
        for (place, cell) in self.area.cells().enumerate() {
            if !self.is_explored[place] {
                self.distances[place] = 0;
                queue.push_back(cell);
            }
        }
        while let Some(cell) = queue.pop_front() {
            let next = self.distance(cell).unwrap_or(0) + 1;
            for side in Side::ALL {
                let beyond = cell.beyond(side);
                if !self.is_wall(Edge::new(cell, side))
                    && let Some(place) = self.area.place(beyond).filter(|&place| self.distances[place] == FAR)
                {
                    self.distances[place] = next;
                    queue.push_back(beyond);
                }
            }
        }
    }
}

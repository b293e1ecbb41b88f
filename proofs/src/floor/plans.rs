//! Small areas for the searches over all layouts of agents on a floor: which cells are free, and the walls between
//! them.

use std::fmt;

use tautline_kernel::ground::{Cell, Edge, Side};

use crate::floor_trace::{Course, Scene, Turn};

/// The most cells of a small floor.
pub(crate) const CELLS: usize = 16;

/// A small area: which cells are free, and the walls between them.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct FloorPlan {
    pub(crate) width: i16,
    pub(crate) height: i16,
    /// Row by row.
    pub(crate) free: u16,
    pub(crate) walls: Edges,
}

/// Sets of edges, by the cells that have them on their eastern and on their southern sides.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub(crate) struct Edges {
    pub(crate) east: u16,
    pub(crate) south: u16,
}

impl FloorPlan {
    #[inline]
    pub(crate) fn place(&self, cell: Cell) -> Option<usize> {
        // West or north of the area a coordinate reads as more than any width or height.
        let is_inside = (cell.x as u16) < self.width as u16 && (cell.y as u16) < self.height as u16;
        if !is_inside {
            return None;
        }
        let place = (cell.y * self.width + cell.x) as usize;
        (self.free >> place & 1 == 1).then_some(place)
    }

    pub(crate) fn cell(&self, place: usize) -> Cell {
        Cell::new(place as i16 % self.width, place as i16 / self.width)
    }

    /// Whether `edge` is between two free cells, and no wall is on it.
    pub(crate) fn is_open(&self, edge: Edge) -> bool {
        let ends = [edge.cell(), edge.cell().beyond(edge.side())];
        ends.iter().all(|&cell| self.place(cell).is_some()) && !self.has_wall(edge)
    }

    /// Whether a wall is on `edge`, which is between two free cells.
    #[inline]
    pub(crate) fn has_wall(&self, edge: Edge) -> bool {
        let walls = match edge.side() {
            Side::East | Side::West => self.walls.east,
            Side::South | Side::North => self.walls.south,
        };
        let Cell { x, y } = edge.cell();
        walls >> (y * self.width + x) & 1 == 1
    }

    /// The blocked cells and the walls: how many.
    pub(crate) const fn barriers(&self) -> u32 {
        let cells = (self.width * self.height) as u32;
        cells - self.free.count_ones() + self.walls.east.count_ones() + self.walls.south.count_ones()
    }

    /// The free cells.
    pub(crate) fn cells(&self) -> impl Iterator<Item = Cell> + use<> {
        let plan = *self;
        (0..CELLS).filter(move |place| plan.free >> place & 1 == 1).map(move |place| plan.cell(place))
    }

    /// These turns on this floor, of which the last `round` come over and over, and how they end.
    pub(crate) fn course(&self, turns: Vec<Turn>, round: usize, end: Scene) -> Course {
        let Self { width, height, .. } = *self;
        let area = (0..width * height).map(|place| self.cell(place as usize));
        let sides = |cell| [Side::East, Side::South].map(|side| Edge::new(cell, side));
        let is_wall =
            |edge: &Edge| self.place(edge.cell().beyond(edge.side())).is_some() && !self.is_open(*edge);
        Course {
            width,
            height,
            blocked: area.filter(|&cell| self.place(cell).is_none()).collect(),
            walls: self.cells().flat_map(sides).filter(is_wall).collect(),
            turns,
            round,
            end,
        }
    }

    /// Every way to put so many agents into free cells.
    pub(crate) fn starts(&self, agents: u32) -> impl Iterator<Item = Vec<Cell>> + use<> {
        let cells: Vec<Cell> = self.cells().collect();
        (0..cells.len().pow(agents)).map(move |start| {
            (0..agents).map(|agent| cells[start / cells.len().pow(agent) % cells.len()]).collect()
        })
    }

    /// Those of `cells` that can be reached from its first one through `cells` and edges that are not `shut`.
    pub(crate) fn spread(&self, cells: u16, shut: Edges) -> u16 {
        let (row, rows) = (self.width as u32, 0..self.height as u32);
        let last_column = rows.fold(0, |set: u16, number| set | 1 << (row * (number + 1) - 1));
        let east = cells & cells >> 1 & !(self.walls.east | shut.east | last_column);
        let south = cells & cells.unbounded_shr(row) & !(self.walls.south | shut.south);
        let mut reached = cells & cells.wrapping_neg();
        loop {
            let along_rows = (reached & east) << 1 | reached >> 1 & east;
            let along_columns = (reached & south).unbounded_shl(row) | reached.unbounded_shr(row) & south;
            let wider = reached | along_rows | along_columns;
            if wider == reached {
                return reached;
            }
            reached = wider;
        }
    }

    /// Whether there are free cells, and all of them are connected.
    pub(crate) fn is_one(&self) -> bool {
        self.free != 0 && self.spread(self.free, Edges::default()) == self.free
    }
}

/// The rows, a `#` for each blocked cell, and the walls.
impl fmt::Display for FloorPlan {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for place in 0..(self.width * self.height) as usize {
            if place > 0 && place.is_multiple_of(self.width as usize) {
                f.write_str("/")?;
            }
            f.write_str(if self.free >> place & 1 == 1 { "." } else { "#" })?;
        }
        for cell in self.cells() {
            for edge in [Side::East, Side::South].map(|side| Edge::new(cell, side)) {
                if self.has_wall(edge) {
                    write!(f, " {cell}|{}", cell.beyond(edge.side()))?;
                }
            }
        }
        Ok(())
    }
}

/// All plans of so many columns and rows.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) struct Area {
    width: i16,
    height: i16,
    varies: Part,
}

/// The part of a plan that is drawn in every way.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Part {
    BlockedCells,
    Walls,
}

impl Area {
    /// Blocked cells are drawn in every way.
    pub(crate) const fn blocked(width: i16, height: i16) -> Self {
        Self { width, height, varies: Part::BlockedCells }
    }

    /// Walls between free cells are drawn in every way.
    pub(crate) const fn walled(width: i16, height: i16) -> Self {
        Self { width, height, varies: Part::Walls }
    }

    /// Its cells, free or blocked.
    pub(crate) const fn cells(self) -> i16 {
        self.width * self.height
    }

    /// Every plan of which all free cells are connected.
    pub(crate) fn plans(self) -> Box<dyn Iterator<Item = FloorPlan>> {
        match self.varies {
            Part::BlockedCells => Box::new(blocked(self.width, self.height)),
            Part::Walls => Box::new(walled(self.width, self.height)),
        }
    }
}

impl fmt::Display for Area {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}×{}", self.width, self.height)?;
        match self.varies {
            Part::BlockedCells => Ok(()),
            Part::Walls => f.write_str(" with walls"),
        }
    }
}

/// Every plan of `width` by `height` cells, blocked cells drawn in every way, of which all free cells are connected.
pub(crate) fn blocked(width: i16, height: i16) -> impl Iterator<Item = FloorPlan> {
    let all = open(width, height);
    (0..=all.free)
        .map(move |blocked| FloorPlan { free: all.free & !blocked, ..all })
        .filter(FloorPlan::is_one)
}

/// Every plan of `width` by `height` free cells, walls drawn between them in every way, that is connected.
fn walled(width: i16, height: i16) -> impl Iterator<Item = FloorPlan> {
    let all = open(width, height);
    let edges: Vec<Edge> = all
        .cells()
        .flat_map(|cell| [Side::East, Side::South].map(|side| Edge::new(cell, side)))
        .filter(|&edge| all.is_open(edge))
        .collect();
    (0_u32..1 << edges.len())
        .map(move |walls| {
            let mut plan = all;
            for edge in
                edges.iter().enumerate().filter(|&(bit, _)| walls >> bit & 1 == 1).map(|(_, edge)| edge)
            {
                let place = plan.place(edge.cell()).unwrap_or_default();
                match edge.side() {
                    Side::East | Side::West => plan.walls.east |= 1 << place,
                    Side::South | Side::North => plan.walls.south |= 1 << place,
                }
            }
            plan
        })
        .filter(FloorPlan::is_one)
}

/// The plan of `width` by `height` free cells without walls; at most [`CELLS`] cells.
fn open(width: i16, height: i16) -> FloorPlan {
    let free = ((1_u32 << (width * height)) - 1) as u16;
    FloorPlan { width, height, free, walls: Edges::default() }
}

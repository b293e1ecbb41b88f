//! A team's knowledge of its area: walls, open sides, explored cells, virtual obstacles, and the distance to the
//! nearest unexplored cell [Kovács 2011, equation (4)]. [`Grid`] is the trait that the rules ask;
//! [`BitGrid`](super::BitGrid) is its home in a few machine words, small enough to be copied at every fork of a search.

use core::ops::ControlFlow;

use super::{Cell, Edge, Side, Step, Steps};

/// A mark on a cell.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum CellMark {
    /// A robot has occupied the cell. Cells outside the area count as explored: nothing is to be found there.
    Explored,
    /// A robot is in the cell now. Set only while a plan is made.
    Occupied,
    /// Two robots or more are in the cell now. Set only while a plan is made.
    Full,
    /// A robot is to be in the cell after the move. Set only while a plan is made.
    Planned,
}

/// A mark on an edge.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum EdgeMark {
    /// Known to be a wall. The area's border is known from the start.
    Wall,
    /// Known to be open: a robot has crossed it.
    Open,
    /// A virtual obstacle: the leader does not cross it in this epoch.
    Virtual,
}

/// A kind of cell that a path to the frontier may not cross.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Avoid {
    /// Known walls: the followers' distance.
    Walls,
    /// Known walls and virtual obstacles: the leader's distance.
    WallsAndVirtual,
}

/// The knowledge of a team about its area. The grid owns the distance, since it knows best how to find it.
pub trait Grid {
    /// How far cells are from one of them: see [`Grid::bearings`].
    type Bearings;
    /// The cells it spans.
    fn area(&self) -> Area;
    /// Whether `cell` carries `mark`.
    fn has(&self, mark: CellMark, cell: Cell) -> bool;
    /// Puts `mark` on `cell`; no effect outside the area.
    fn put(&mut self, mark: CellMark, cell: Cell);
    /// Takes `mark` off `cell`; no effect outside the area.
    fn take(&mut self, mark: CellMark, cell: Cell);
    /// Whether `edge` carries `mark`. Every edge on or beyond the border is a wall.
    fn edge_has(&self, mark: EdgeMark, edge: Edge) -> bool;
    /// The sides of `cell` that carry `mark`, as the steps across them.
    fn sides(&self, mark: EdgeMark, cell: Cell) -> Steps {
        Steps::ALL.filter(|step| match step {
            Step::Cross(side) => self.edge_has(mark, Edge::new(cell, side)),
            Step::Stay => false,
        })
    }
    /// Those of the `steps` from `at`, none of which leaves the area, that lead to a cell with `mark`.
    fn steps_to(&self, mark: CellMark, at: Cell, steps: Steps) -> Steps {
        steps.filter(|step| self.has(mark, at.after(step)))
    }
    /// Puts `mark` on `edge`; no effect on or beyond the border.
    fn put_edge(&mut self, mark: EdgeMark, edge: Edge);
    /// Puts every mark on an edge that it carries in `other`, a grid of the same area.
    fn add_edges(&mut self, other: &Self) {
        for edge in self.area().edges() {
            for mark in [EdgeMark::Wall, EdgeMark::Open, EdgeMark::Virtual] {
                if other.edge_has(mark, edge) {
                    self.put_edge(mark, edge);
                }
            }
        }
    }
    /// Takes `mark` off every edge inside the area.
    fn clear_edges(&mut self, mark: EdgeMark);
    /// Whether no cell of the area is left unexplored.
    fn is_explored(&self) -> bool;
    /// Steps on the shortest path from `from` to an unexplored cell: 0 if `from` is unexplored itself, `None`
    /// if there is no path.
    fn distance(&mut self, from: Cell, avoid: Avoid) -> Option<u32>;
    /// Tells of the `steps` from `at`, nearest first, which lead to cells with one and the same distance, until it is
    /// told to stop; not of those from which there is no path.
    fn approach(
        &mut self,
        at: Cell,
        steps: Steps,
        avoid: Avoid,
        mut tell: impl FnMut(Steps) -> ControlFlow<()>,
    ) {
        let mut distances = [None; Step::ALL.len()];
        for step in steps.iter() {
            distances[step.place()] = self.distance(at.after(step), avoid);
        }
        let mut untold = steps.filter(|step| distances[step.place()].is_some());
        while let Some(least) = untold.iter().filter_map(|step| distances[step.place()]).min() {
            let nearest = untold.filter(|step| distances[step.place()] == Some(least));
            untold = untold.minus(nearest);
            if tell(nearest).is_break() {
                return;
            }
        }
    }
    /// A walk from `from` to the unexplored cell that is fewest [`links`](super::links) away, the first in row order of
    /// these: how many links it has, at most one less than there are `stops`, and the cells where they begin and end in
    /// `stops`, `from` first. Going back, each stop is the first of those linked to the one after it that is
    /// nearer to `from`. `None` if all cells so near are explored.
    fn stops(&mut self, from: Cell, stops: &mut [Cell]) -> Option<usize>;
    /// The unexplored cell that comes next behind `last` in the order of the number of steps on the shortest path from
    /// `from` over sides that are not known to be walls, at most `most`, and then of rows; with its distance. The first
    /// if there is no `last`; `None` if there is no more.
    fn next_unexplored(&self, from: Cell, last: Option<(u32, Cell)>, most: u32) -> Option<(u32, Cell)>;
    /// Fewer steps than these lead from `from` to no unexplored cell over sides that are not known to be walls. A grid
    /// that keeps what its searches have found tells more than 0; then far fewer of them are needed.
    fn least_distance(&mut self, _from: Cell) -> u32 {
        0
    }
    /// The distances to `to`, over sides that are not known to be walls, of all cells at most `most` steps away.
    fn bearings(&mut self, to: Cell, most: u32) -> Self::Bearings;
    /// The steps from `at` that lead one step nearer; none if `at` is too far, or there.
    fn nearer(&self, bearings: &Self::Bearings, at: Cell) -> Steps;
}

/// A rectangle of cells, not empty: what a team is to explore.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Area {
    first: Cell,
    last: Cell,
}

impl Area {
    /// The rectangle with `first` in its north-west corner and `last` in its south-east corner; `None` if it
    /// holds no cell.
    pub fn new(first: Cell, last: Cell) -> Option<Self> {
        (first.x <= last.x && first.y <= last.y).then_some(Self { first, last })
    }

    /// One cell alone.
    pub const fn of(cell: Cell) -> Self {
        Self { first: cell, last: cell }
    }

    /// The cells of this area at most `range_cells` columns and rows from `centre`; `None` if the centre
    /// is outside.
    pub fn around(self, centre: Cell, range_cells: u16) -> Option<Self> {
        if !self.contains(centre) {
            return None;
        }
        let range = i16::try_from(range_cells).unwrap_or(i16::MAX);
        let (first, last) = (centre.at_offset(-range, -range), centre.at_offset(range, range));
        Self::new(
            Cell::new(first.x.max(self.first.x), first.y.max(self.first.y)),
            Cell::new(last.x.min(self.last.x), last.y.min(self.last.y)),
        )
    }

    /// The cell in the north-west corner.
    pub const fn first(self) -> Cell {
        self.first
    }

    /// The cell in the south-east corner.
    pub const fn last(self) -> Cell {
        self.last
    }

    /// Number of columns.
    pub const fn width(self) -> usize {
        self.last.x.wrapping_sub(self.first.x) as u16 as usize + 1
    }

    /// Number of rows.
    pub const fn height(self) -> usize {
        self.last.y.wrapping_sub(self.first.y) as u16 as usize + 1
    }

    /// Column and row of `cell` counted from the north-west corner; `None` outside.
    #[inline]
    pub const fn locate(self, cell: Cell) -> Option<(usize, usize)> {
        // West or north of the area the difference wraps round to more than its width or height.
        let (column, row) = (cell.x.wrapping_sub(self.first.x), cell.y.wrapping_sub(self.first.y));
        let (column, row) = (column as u16 as usize, row as u16 as usize);
        if column < self.width() && row < self.height() { Some((column, row)) } else { None }
    }

    /// The place of `cell` among all cells, row by row; `None` outside.
    #[inline]
    pub const fn place(self, cell: Cell) -> Option<usize> {
        match self.locate(cell) {
            Some((column, row)) => Some(row * self.width() + column),
            None => None,
        }
    }

    /// Whether `cell` is in the area.
    #[inline]
    pub const fn contains(self, cell: Cell) -> bool {
        self.locate(cell).is_some()
    }

    /// All cells, row by row.
    pub fn cells(self) -> impl Iterator<Item = Cell> {
        (self.first.y..=self.last.y)
            .flat_map(move |y| (self.first.x..=self.last.x).map(move |x| Cell::new(x, y)))
    }

    /// All edges between two cells of the area, row by row, a cell's east side before its south side.
    pub fn edges(self) -> impl Iterator<Item = Edge> {
        self.cells().flat_map(move |cell| {
            [Side::East, Side::South]
                .into_iter()
                .filter(move |&side| self.contains(cell.beyond(side)))
                .map(move |side| Edge::new(cell, side))
        })
    }
}

//! What a team knows of its area: walls, open sides, explored cells, virtual obstacles, and the distance to
//! the nearest unexplored cell (paper 000, equation (4)). [`Grid`] is what the rules ask for; [`BitGrid`] is
//! its home in a few machine words, small enough to be copied at every fork of a search.

use core::ops::{BitAnd, BitAndAssign, BitOr, BitOrAssign, Not, Shl, Shr};

use crate::lattice::{Cell, Edge, Side};

/// What is marked on cells.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
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

/// What is marked on edges.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum EdgeMark {
    /// Known to be a wall. The area's border is known from the start.
    Wall,
    /// Known to be open: a robot has crossed it.
    Open,
    /// A virtual obstacle: the leader does not cross it in this epoch.
    Virtual,
}

/// What a path to the frontier may not cross.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Avoid {
    /// Known walls: the followers' distance.
    Walls,
    /// Known walls and virtual obstacles: the leader's distance.
    WallsAndVirtual,
}

/// The knowledge of a team about its area. The grid owns the distance, since it knows best how to find it.
pub trait Grid {
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
    /// Puts `mark` on `edge`; no effect on or beyond the border.
    fn put_edge(&mut self, mark: EdgeMark, edge: Edge);
    /// Takes `mark` off every edge inside the area.
    fn clear_edges(&mut self, mark: EdgeMark);
    /// Whether no cell of the area is left unexplored.
    fn is_explored(&self) -> bool;
    /// Steps on the shortest path from `from` to an unexplored cell: 0 if `from` is unexplored itself, `None`
    /// if there is no path.
    fn distance(&mut self, from: Cell, avoid: Avoid) -> Option<u32>;
}

/// A rectangle of cells, not empty: what a team is to explore.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
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

    /// The cells of this area at most `range_cells` columns and rows from `centre`; `None` if there are none.
    pub fn around(self, centre: Cell, range_cells: u16) -> Option<Self> {
        let range = i16::try_from(range_cells).unwrap_or(i16::MAX);
        let (first, last) = (self.first, self.last);
        Self::new(
            Cell::new(
                first.x.max(centre.x.saturating_sub(range)),
                first.y.max(centre.y.saturating_sub(range)),
            ),
            Cell::new(last.x.min(centre.x.saturating_add(range)), last.y.min(centre.y.saturating_add(range))),
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
        self.first.x.abs_diff(self.last.x) as usize + 1
    }

    /// Number of rows.
    pub const fn height(self) -> usize {
        self.first.y.abs_diff(self.last.y) as usize + 1
    }

    /// Column and row of `cell` counted from the north-west corner; `None` outside.
    pub fn locate(self, cell: Cell) -> Option<(usize, usize)> {
        let inside = self.first.x <= cell.x
            && cell.x <= self.last.x
            && self.first.y <= cell.y
            && cell.y <= self.last.y;
        let (column, row) = self.first.apart(cell);
        inside.then_some((usize::from(column), usize::from(row)))
    }

    /// Whether `cell` is in the area.
    pub fn contains(self, cell: Cell) -> bool {
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

/// A row of cells, one bit each.
pub trait Word:
    Copy
    + Eq
    + BitAnd<Output = Self>
    + BitOr<Output = Self>
    + BitAndAssign
    + BitOrAssign
    + Not<Output = Self>
    + Shl<u32, Output = Self>
    + Shr<u32, Output = Self>
{
    /// No cell.
    const EMPTY: Self;
    /// The westernmost cell alone.
    const FIRST: Self;
    /// Cells in a row.
    const BITS: u32;
}

macro_rules! words {
    ($($word:ty),*) => {$(
        impl Word for $word {
            const EMPTY: Self = 0;
            const FIRST: Self = 1;
            const BITS: u32 = <$word>::BITS;
        }
    )*};
}
words!(u16, u32, u64, u128);

/// One bit for every cell: `HEIGHT` rows of one word.
type Plane<W, const HEIGHT: usize> = [W; HEIGHT];

/// A grid in machine words: at most `W::BITS` columns and `HEIGHT` rows. Distances are flood fills of whole
/// rows at a time.
#[derive(Clone, Copy, PartialEq, Eq)]
pub struct BitGrid<W, const HEIGHT: usize> {
    area: Area,
    cells: [Plane<W, HEIGHT>; 4],
    /// Marks on the east sides.
    east: [Plane<W, HEIGHT>; 3],
    /// Marks on the south sides.
    south: [Plane<W, HEIGHT>; 3],
}

/// The grid of a chain of up to eight robots.
pub type SmallGrid = BitGrid<u16, 16>;
/// The grid of a chain of up to 32 robots.
pub type MediumGrid = BitGrid<u64, 64>;
/// The grid of a chain of up to 64 robots.
pub type LargeGrid = BitGrid<u128, 128>;

impl<W: Word, const HEIGHT: usize> BitGrid<W, HEIGHT> {
    /// Nothing known of `area` but its border; `None` if it is wider or higher than this grid holds.
    pub fn new(area: Area) -> Option<Self> {
        if area.width() > W::BITS as usize || area.height() > HEIGHT {
            return None;
        }
        let mut grid = Self {
            area,
            cells: [[W::EMPTY; HEIGHT]; 4],
            east: [[W::EMPTY; HEIGHT]; 3],
            south: [[W::EMPTY; HEIGHT]; 3],
        };
        let inside = |row: usize| if row < area.height() { columns(area.width()) } else { W::EMPTY };
        for row in 0..HEIGHT {
            grid.cells[CellMark::Explored as usize][row] = !inside(row);
            // A side is a wall unless the cells on both sides of it are in the area.
            grid.east[EdgeMark::Wall as usize][row] = !(inside(row) >> 1);
            grid.south[EdgeMark::Wall as usize][row] = !inside(row + 1);
        }
        Some(grid)
    }

    fn bit(&self, cell: Cell) -> Option<(usize, W)> {
        self.area.locate(cell).map(|(column, row)| (row, W::FIRST << column as u32))
    }

    fn edge_plane(&self, mark: EdgeMark, edge: Edge) -> &Plane<W, HEIGHT> {
        match edge.side() {
            Side::East | Side::West => &self.east[mark as usize],
            Side::South | Side::North => &self.south[mark as usize],
        }
    }
}

/// The `count` westernmost cells of a row; `count` is at least 1.
fn columns<W: Word>(count: usize) -> W {
    !W::EMPTY >> (W::BITS - count as u32)
}

impl<W: Word, const HEIGHT: usize> Grid for BitGrid<W, HEIGHT> {
    fn area(&self) -> Area {
        self.area
    }

    fn has(&self, mark: CellMark, cell: Cell) -> bool {
        match self.bit(cell) {
            Some((row, bit)) => self.cells[mark as usize][row] & bit != W::EMPTY,
            None => mark == CellMark::Explored,
        }
    }

    fn put(&mut self, mark: CellMark, cell: Cell) {
        if let Some((row, bit)) = self.bit(cell) {
            self.cells[mark as usize][row] |= bit;
        }
    }

    fn take(&mut self, mark: CellMark, cell: Cell) {
        if let Some((row, bit)) = self.bit(cell) {
            self.cells[mark as usize][row] &= !bit;
        }
    }

    fn edge_has(&self, mark: EdgeMark, edge: Edge) -> bool {
        match self.bit(edge.cell()) {
            Some((row, bit)) => self.edge_plane(mark, edge)[row] & bit != W::EMPTY,
            None => mark == EdgeMark::Wall,
        }
    }

    fn put_edge(&mut self, mark: EdgeMark, edge: Edge) {
        if !self.area.contains(edge.cell().beyond(edge.side())) {
            return;
        }
        if let Some((row, bit)) = self.bit(edge.cell()) {
            let plane = match edge.side() {
                Side::East | Side::West => &mut self.east[mark as usize],
                Side::South | Side::North => &mut self.south[mark as usize],
            };
            plane[row] |= bit;
        }
    }

    fn clear_edges(&mut self, mark: EdgeMark) {
        self.east[mark as usize] = [W::EMPTY; HEIGHT];
        self.south[mark as usize] = [W::EMPTY; HEIGHT];
    }

    fn is_explored(&self) -> bool {
        self.cells[CellMark::Explored as usize] == [!W::EMPTY; HEIGHT]
    }

    fn distance(&mut self, from: Cell, avoid: Avoid) -> Option<u32> {
        let (row, bit) = self.bit(from)?;
        let mut blocked_east = self.east[EdgeMark::Wall as usize];
        let mut blocked_south = self.south[EdgeMark::Wall as usize];
        match avoid {
            Avoid::Walls => {}
            Avoid::WallsAndVirtual => {
                for row in 0..HEIGHT {
                    blocked_east[row] |= self.east[EdgeMark::Virtual as usize][row];
                    blocked_south[row] |= self.south[EdgeMark::Virtual as usize][row];
                }
            }
        }
        let explored = &self.cells[CellMark::Explored as usize];
        let mut reached = [W::EMPTY; HEIGHT];
        reached[row] = bit;
        let mut steps = 0;
        loop {
            let mut found = W::EMPTY;
            for row in 0..HEIGHT {
                found |= reached[row] & !explored[row];
            }
            if found != W::EMPTY {
                return Some(steps);
            }
            let mut wider = reached;
            for row in 0..HEIGHT {
                wider[row] |=
                    ((reached[row] & !blocked_east[row]) << 1) | ((reached[row] >> 1) & !blocked_east[row]);
            }
            for row in 1..HEIGHT {
                wider[row] |= reached[row - 1] & !blocked_south[row - 1];
                wider[row - 1] |= reached[row] & !blocked_south[row - 1];
            }
            if wider == reached {
                return None;
            }
            reached = wider;
            steps += 1;
        }
    }
}

//! The ground truth of a run: an area of square cells with walls between cells, blocked cells, and, where a drawing
//! says so, the base and the number of robots. Only the simulator has one; a robot team learns of it edge by edge.
//! [`load`] makes one of a generator's description, or of a file of one of three formats. Rows are counted southwards
//! from 0 in every format, as text and images are read.

mod coarse;
mod file;
mod form;
pub mod generate;
mod image;
mod load;
pub mod movingai;
pub mod ros;
mod size;
pub mod text;
mod yaml;

use std::collections::VecDeque;
use std::iter;
use std::num::NonZeroU16;

use tautline_io::diagnostic::Diagnostic;
use tautline_kernel::chain::MAX_ROBOTS;
use tautline_kernel::ground::{Cell, Edge, Side};

use size::Bitmap;

pub use coarse::Coarse;
pub use file::Misread;
pub use generate::Generator;
pub use load::{inputs, is_ros, load, load_coarse};
pub use size::{MAX_CELLS, MAX_SIDE_CELLS, Size, of_size, outside};

/// A cell, as it is written: column and row.
pub type ColumnRow = [i16; 2];

/// An area of cells. The outer rim is closed; three bits a cell hold the rest.
#[derive(Clone, PartialEq, Eq, Hash)]
pub struct Layout {
    size: Size,
    /// Walls on the eastern side of a cell; never on the rim.
    east: Bitmap,
    /// Walls on the southern side of a cell; never on the rim.
    south: Bitmap,
    blocked: Bitmap,
    /// Always a free cell.
    base: Option<Cell>,
    robots: Option<NonZeroU16>,
}

impl Layout {
    /// An area without walls and blocked cells, `width` and `height` in cells.
    ///
    /// # Errors
    /// [`Diagnostic`] when a side is 0 or above [`MAX_SIDE_CELLS`], or the area above [`MAX_CELLS`];
    /// nothing is allocated then.
    pub fn open(width: u64, height: u64) -> Result<Self, Diagnostic> {
        Size::new(width, height).map(Self::of)
    }

    /// An area without walls and blocked cells.
    pub fn of(size: Size) -> Self {
        let plane = Bitmap::new(size.cells());
        let (east, south, blocked) = (plane.clone(), plane.clone(), plane);
        Self { size, east, south, blocked, base: None, robots: None }
    }

    /// Columns and rows.
    pub const fn size(&self) -> Size {
        self.size
    }

    /// Columns.
    pub const fn width(&self) -> i16 {
        self.size.width()
    }

    /// Rows.
    pub const fn height(&self) -> i16 {
        self.size.height()
    }

    /// Whether `cell` lies inside the rim.
    #[inline]
    pub const fn contains(&self, cell: Cell) -> bool {
        self.size.contains(cell)
    }

    /// Whether a robot can stand in `cell`: it is inside and not blocked.
    #[inline]
    pub fn is_free(&self, cell: Cell) -> bool {
        self.size.index(cell).is_some_and(|index| !self.blocked.has(index))
    }

    /// All cells, row by row.
    pub fn cells(&self) -> impl Iterator<Item = Cell> + use<> {
        let (width, height) = (self.width(), self.height());
        (0..height).flat_map(move |y| (0..width).map(move |x| Cell::new(x, y)))
    }

    /// How many cells are free.
    pub fn free_cells(&self) -> usize {
        self.size.cells() - self.blocked.count()
    }

    /// This layout, in which a robot can stand somewhere.
    fn with_free_cell(self) -> Result<Self, Diagnostic> {
        if self.free_cells() == 0 { Err(no_free_cell()) } else { Ok(self) }
    }

    /// Whether a robot can cross `edge`: both cells are free and no wall stands between them.
    #[inline]
    pub fn is_open(&self, edge: Edge) -> bool {
        let (cell, beyond) = both(edge);
        self.is_free(cell) && self.is_free(beyond) && !self.has_wall(edge)
    }

    /// Whether a wall stands on `edge`. The rim is a wall; outside it there is none.
    #[inline]
    pub fn has_wall(&self, edge: Edge) -> bool {
        let (cell, beyond) = both(edge);
        match self.inner(edge) {
            Some(index) => self.walls_beside(edge.side()).has(index),
            None => self.contains(cell) || self.contains(beyond),
        }
    }

    /// Puts a wall on `edge`. The rim stays closed and the outside stays empty, whatever is asked.
    pub fn build_wall(&mut self, edge: Edge) {
        if let Some(index) = self.inner(edge) {
            self.walls_beside_mut(edge.side()).put(index);
        }
    }

    /// Takes the wall on `edge` away. The rim stays closed.
    pub fn remove_wall(&mut self, edge: Edge) {
        if let Some(index) = self.inner(edge) {
            self.walls_beside_mut(edge.side()).take(index);
        }
    }

    /// Blocks `cell`. A base that stood there is gone: the base is always free.
    pub fn block(&mut self, cell: Cell) {
        if let Some(index) = self.size.index(cell) {
            self.blocked.put(index);
            self.base = self.base.filter(|&base| base != cell);
        }
    }

    /// This layout, with these cells blocked.
    #[must_use]
    pub fn with_blocked(mut self, cells: impl IntoIterator<Item = Cell>) -> Self {
        cells.into_iter().for_each(|cell| self.block(cell));
        self
    }

    /// This layout, with walls on these edges.
    #[must_use]
    pub fn with_walls(mut self, edges: impl IntoIterator<Item = Edge>) -> Self {
        edges.into_iter().for_each(|edge| self.build_wall(edge));
        self
    }

    /// The cells that are reached from `starts`, those among them, row by row.
    pub fn reachable(&self, starts: &[Cell]) -> Vec<Cell> {
        let mut cells: Vec<Cell> = self.spread(starts).collect();
        cells.sort_unstable_by_key(|cell| (cell.y, cell.x));
        cells
    }

    /// The cells that are reached from `starts`, those among them, the nearest first.
    pub fn spread(&self, starts: &[Cell]) -> impl Iterator<Item = Cell> + use<'_> {
        let mut reached = Bitmap::new(self.size.cells());
        let mut is_new = move |cell: &Cell| {
            let index = self.size.index(*cell).filter(|&index| !reached.has(index));
            index.is_some_and(|index| {
                reached.put(index);
                true
            })
        };
        let mut ahead: VecDeque<Cell> = starts.iter().copied().filter(&mut is_new).collect();
        iter::from_fn(move || {
            let cell = ahead.pop_front()?;
            let open = Side::ALL.into_iter().filter(|&side| self.is_open(Edge::new(cell, side)));
            ahead.extend(open.map(|side| cell.beyond(side)).filter(&mut is_new));
            Some(cell)
        })
    }

    /// Makes `cell` free. Walls beside it stay.
    pub fn unblock(&mut self, cell: Cell) {
        if let Some(index) = self.size.index(cell) {
            self.blocked.take(index);
        }
    }

    /// All edges inside the rim, by row, then column, then eastern before southern.
    pub fn edges(&self) -> impl Iterator<Item = Edge> + use<> {
        let size = self.size;
        self.cells()
            .flat_map(|cell| [Side::East, Side::South].map(|side| Edge::new(cell, side)))
            .filter(move |&edge| size.contains(edge.cell().beyond(edge.side())))
    }

    /// The walls inside the rim, in the order of [`Layout::edges`].
    pub fn walls(&self) -> impl Iterator<Item = Edge> {
        self.edges().filter(|&edge| self.has_wall(edge))
    }

    /// The base, if the layout names one.
    pub const fn base(&self) -> Option<Cell> {
        self.base
    }

    /// The free cell nearest the centre of the area, ties by row, then by column.
    ///
    /// # Errors
    /// [`Diagnostic`] when all cells are blocked.
    pub fn default_base(&self) -> Result<Cell, Diagnostic> {
        let centre = (i64::from(self.width()) - 1, i64::from(self.height()) - 1);
        self.nearest_free(centre).ok_or_else(no_free_cell)
    }

    /// Puts the base in `cell`.
    ///
    /// # Errors
    /// [`Diagnostic`] if it is no free cell; the nearest one is named then, and the base stays where it was.
    pub fn place_base(&mut self, cell: Cell) -> Result<(), Diagnostic> {
        self.check_base(cell)?;
        self.base = Some(cell);
        Ok(())
    }

    /// Whether the base can be in `cell`.
    ///
    /// # Errors
    /// [`Diagnostic`] if it is no free cell; the nearest one is named then.
    pub fn check_base(&self, cell: Cell) -> Result<(), Diagnostic> {
        self.check_free(cell, "base", "put the base on")
    }

    /// Whether a robot can start in `cell`.
    ///
    /// # Errors
    /// [`Diagnostic`] if it is no free cell; the nearest one is named then.
    pub fn check_start(&self, cell: Cell) -> Result<(), Diagnostic> {
        self.check_free(cell, "start", "start on")
    }

    /// Checks that `cell`, which is to be `what`, is free.
    fn check_free(&self, cell: Cell, what: &str, remedy: &str) -> Result<(), Diagnostic> {
        if !self.contains(cell) {
            return Err(outside(what, cell, self.size));
        }
        if self.is_free(cell) {
            return Ok(());
        }
        let nearest = self.nearest_free((2 * i64::from(cell.x), 2 * i64::from(cell.y)));
        Err(nearest.map_or_else(no_free_cell, |nearest| {
            let what = format!("the {what} {cell} is on a blocked cell; the nearest free cell is {nearest}");
            Diagnostic::usage(what, format!("{remedy} {nearest}"))
        }))
    }

    /// How many robots the layout is meant for, the base counted, if it says so.
    pub fn robots(&self) -> Option<u16> {
        self.robots.map(NonZeroU16::get)
    }

    /// Says how many robots the layout is meant for.
    ///
    /// # Errors
    /// [`Diagnostic`] if they are more than any team has.
    pub fn set_robots(&mut self, robots: NonZeroU16) -> Result<(), Diagnostic> {
        self.robots = Some(robots_of(&robots.to_string())?);
        Ok(())
    }

    /// The free cell with the least distance to a point, given in half cells from the centre of the cell 0,0;
    /// ties by row, then by column.
    fn nearest_free(&self, point: (i64, i64)) -> Option<Cell> {
        let distance = |cell: Cell| {
            let (dx, dy) = (2 * i64::from(cell.x) - point.0, 2 * i64::from(cell.y) - point.1);
            dx * dx + dy * dy
        };
        self.cells().filter(|&cell| self.is_free(cell)).min_by_key(|&cell| distance(cell))
    }

    /// Where the wall bit of an edge inside the rim is kept.
    #[inline]
    fn inner(&self, edge: Edge) -> Option<usize> {
        let (cell, beyond) = both(edge);
        self.size.index(cell).filter(|_| self.contains(beyond))
    }

    #[inline]
    const fn walls_beside(&self, side: Side) -> &Bitmap {
        match side {
            Side::East | Side::West => &self.east,
            Side::South | Side::North => &self.south,
        }
    }

    const fn walls_beside_mut(&mut self, side: Side) -> &mut Bitmap {
        match side {
            Side::East | Side::West => &mut self.east,
            Side::South | Side::North => &mut self.south,
        }
    }
}

#[inline]
const fn both(edge: Edge) -> (Cell, Cell) {
    (edge.cell(), edge.cell().beyond(edge.side()))
}

/// Every cell is blocked.
pub fn no_free_cell() -> Diagnostic {
    Diagnostic::usage("no cell is free", "leave at least one cell free for the base")
}

/// The number of robots that a layout can be meant for.
fn robots_of(count: &str) -> Result<NonZeroU16, Diagnostic> {
    let robots = count.parse().ok().filter(|robots: &NonZeroU16| usize::from(robots.get()) <= MAX_ROBOTS);
    robots.ok_or_else(|| {
        let remedy = format!("write `robots N` with N from 1 to {MAX_ROBOTS}, or leave the line out");
        Diagnostic::usage(format!("{count:?} is no number of robots"), remedy)
    })
}

//! The grid in machine words: a [`Plane`] for every mark. Distances are flood fills of whole planes at a time.

use core::ops::ControlFlow;

use super::plane::Plane;
use super::{Area, Avoid, Cell, CellMark, Edge, EdgeMark, Grid, Side, Step, Steps, links};

/// A grid in machine words: at most [`Plane::COLUMNS`] columns and [`Plane::ROWS`] rows.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct BitGrid<P> {
    area: Area,
    cells: [P; 4],
    /// Marks on the east sides, and on the south sides.
    edges: [[P; 2]; 3],
}

/// The grid of a chain of up to four robots: one word for each mark.
pub type TinyGrid = BitGrid<u64>;
/// The grid of a chain of up to six robots.
pub type CompactGrid = BitGrid<u128>;
/// The grid of a chain of up to eight robots.
pub type SmallGrid = BitGrid<[u16; 16]>;
/// The grid of a chain of up to 32 robots.
pub type MediumGrid = BitGrid<[u64; 64]>;
/// The grid of a chain of up to 64 robots.
pub type LargeGrid = BitGrid<[u128; 128]>;

impl<P: Plane> BitGrid<P> {
    /// Nothing known of `area` but its border; `None` if it is wider or higher than this grid holds.
    pub fn new(area: Area) -> Option<Self> {
        if area.width() > P::COLUMNS || area.height() > P::ROWS {
            return None;
        }
        let mut grid = Self { area, cells: [P::NONE; 4], edges: [[P::NONE; 2]; 3] };
        grid.cells[CellMark::Explored as usize] = rectangle::<P>(area.width(), area.height()).not();
        grid.clear_edges(EdgeMark::Wall);
        Some(grid)
    }

    /// The cells whose east, and whose south side may be crossed.
    #[inline]
    fn open(&self, avoid: Avoid) -> [P; 2] {
        let walls = &self.edges[EdgeMark::Wall as usize];
        let obstacles = &self.edges[EdgeMark::Virtual as usize];
        core::array::from_fn(|axis| match avoid {
            Avoid::Walls => walls[axis].not(),
            Avoid::WallsAndVirtual => walls[axis].or(&obstacles[axis]).not(),
        })
    }

    /// The steps from a cell that leave the area.
    #[inline]
    fn leaving(&self, column: usize, row: usize) -> Steps {
        let east = u8::from(column + 1 == self.area.width());
        let south = u8::from(row + 1 == self.area.height());
        Steps::of_bits(east | south << 1 | u8::from(column == 0) << 2 | u8::from(row == 0) << 3)
    }

    /// Floods the area from the frontier outwards, one cell at a time, until all the cells are reached where `steps`
    /// lead from `at`, or as many as can be. Hears which are reached by how many cells, and whether that is enough.
    #[inline]
    fn flood(
        &self,
        at: Cell,
        steps: Steps,
        avoid: Avoid,
        mut arrive: impl FnMut(Steps, u32) -> ControlFlow<()>,
    ) {
        // From outside at most one step leads into the area: it is reached where that cell is.
        let way_in = || steps.iter().find(|&step| self.area.contains(at.after(step)));
        let entering = if self.area.contains(at) { None } else { way_in() };
        let (at, steps) = entering.map_or((at, steps), |step| (at.after(step), Steps::only(Step::Stay)));
        let Some((column, row)) = self.area.locate(at) else { return };
        let [east, south] = self.open(avoid);
        let unexplored = self.cells[CellMark::Explored as usize].not();
        let mut missing = steps.minus(self.leaving(column, row));
        // A way of so many cells leaves no more rows on either side. Mostly the frontier is near.
        let near = if P::ROWS > FEW_ROWS { [NEAR_ROWS, P::ROWS] } else { [P::ROWS; 2] };
        let mut first_length = 0;
        for reach in near {
            let (top, bottom) = (row.saturating_sub(reach), (row + reach).min(P::ROWS - 1));
            let mut rows = (top, bottom);
            let mut reached = unexplored;
            for length in 0.. {
                if length >= first_length {
                    let arrived = reached.steps_from(column, row).and(missing);
                    let told = entering.map_or(arrived, Steps::only);
                    if !arrived.is_empty() && arrive(told, length).is_break() {
                        return;
                    }
                    missing = missing.minus(arrived);
                    first_length = length + 1;
                }
                let is_far = length as usize + 1 >= reach && reach < P::ROWS;
                if missing.is_empty() || is_far {
                    break;
                }
                let Some(wider) = reached.spread(&east, &south, rows) else { break };
                let (first, last) = beside::<P>(wider);
                rows = (first.max(top), last.min(bottom));
            }
            if missing.is_empty() || reach >= P::ROWS {
                return;
            }
        }
    }
}

/// Planes of more rows than so many are flooded near by first: so many rows to either side.
const FEW_ROWS: usize = 16;
const NEAR_ROWS: usize = 8;

/// The rows into which cells in the rows from `first` to `last` spread.
#[inline]
const fn beside<P: Plane>((first, last): (usize, usize)) -> (usize, usize) {
    (first.saturating_sub(1), if last + 1 < P::ROWS { last + 1 } else { last })
}

/// The place of the planes of an edge's axis.
#[inline]
const fn axis(edge: Edge) -> usize {
    match edge.side() {
        Side::East | Side::West => 0,
        Side::South | Side::North => 1,
    }
}

/// The cells of the first `width` columns and `height` rows.
fn rectangle<P: Plane>(width: usize, height: usize) -> P {
    let mut plane = P::NONE;
    for row in 0..height {
        for column in 0..width {
            plane.put(column, row);
        }
    }
    plane
}

/// The cells by their distance from one of them, modulo 3: the distances of two cells with an open side between them
/// differ by one.
#[derive(Clone, Copy, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Layers<P>([P; 3]);

impl<P: Plane> Grid for BitGrid<P> {
    type Bearings = Layers<P>;

    fn area(&self) -> Area {
        self.area
    }

    #[inline]
    fn has(&self, mark: CellMark, cell: Cell) -> bool {
        match self.area.locate(cell) {
            Some((column, row)) => self.cells[mark as usize].has(column, row),
            None => mark == CellMark::Explored,
        }
    }

    #[inline]
    fn put(&mut self, mark: CellMark, cell: Cell) {
        if let Some((column, row)) = self.area.locate(cell) {
            self.cells[mark as usize].put(column, row);
        }
    }

    #[inline]
    fn take(&mut self, mark: CellMark, cell: Cell) {
        if let Some((column, row)) = self.area.locate(cell) {
            self.cells[mark as usize].take(column, row);
        }
    }

    #[inline]
    fn edge_has(&self, mark: EdgeMark, edge: Edge) -> bool {
        match self.area.locate(edge.cell()) {
            Some((column, row)) => self.edges[mark as usize][axis(edge)].has(column, row),
            None => mark == EdgeMark::Wall,
        }
    }

    #[inline]
    fn sides(&self, mark: EdgeMark, cell: Cell) -> Steps {
        match self.area.locate(cell) {
            // The border is a wall, and nothing else: so is what stands before the first column and row.
            Some((column, row)) => {
                let [east, south] = &self.edges[mark as usize];
                P::steps_across(east, south, column, row)
            }
            None if mark == EdgeMark::Wall => Steps::ALL.without(Step::Stay),
            None => Steps::NONE,
        }
    }

    #[inline]
    fn steps_to(&self, mark: CellMark, at: Cell, steps: Steps) -> Steps {
        match self.area.locate(at) {
            Some((column, row)) => steps.and(self.cells[mark as usize].steps_from(column, row)),
            None if mark == CellMark::Explored => steps,
            None => Steps::NONE,
        }
    }

    #[inline]
    fn put_edge(&mut self, mark: EdgeMark, edge: Edge) {
        if !self.area.contains(edge.cell().beyond(edge.side())) {
            return;
        }
        if let Some((column, row)) = self.area.locate(edge.cell()) {
            self.edges[mark as usize][axis(edge)].put(column, row);
        }
    }

    fn add_edges(&mut self, other: &Self) {
        for (own, others) in self.edges.iter_mut().zip(&other.edges) {
            for (own, other) in own.iter_mut().zip(others) {
                *own = own.or(other);
            }
        }
    }

    fn clear_edges(&mut self, mark: EdgeMark) {
        let (width, height) = (self.area.width(), self.area.height());
        // A side is a wall unless the cells on both sides of it are in the area.
        self.edges[mark as usize] = match mark {
            EdgeMark::Wall => {
                [rectangle(width - 1, height), rectangle(width, height - 1)].map(|inside: P| inside.not())
            }
            EdgeMark::Open | EdgeMark::Virtual => [P::NONE; 2],
        };
    }

    fn is_explored(&self) -> bool {
        self.cells[CellMark::Explored as usize] == P::NONE.not()
    }

    fn distance(&mut self, from: Cell, avoid: Avoid) -> Option<u32> {
        let mut distance = None;
        self.flood(from, Steps::only(Step::Stay), avoid, |_, length| {
            distance = Some(length);
            ControlFlow::Break(())
        });
        distance
    }

    #[inline]
    fn approach(
        &mut self,
        at: Cell,
        steps: Steps,
        avoid: Avoid,
        mut tell: impl FnMut(Steps) -> ControlFlow<()>,
    ) {
        self.flood(at, steps, avoid, |arrived, _| tell(arrived));
    }

    fn stops(&mut self, from: Cell, stops: &mut [Cell]) -> Option<usize> {
        let (column, row) = self.area.locate(from)?;
        let [east, south] = self.open(Avoid::Walls);
        let unexplored = self.cells[CellMark::Explored as usize].not();
        let mut reached = P::NONE;
        reached.put(column, row);
        // The cells by how many links away they are, modulo 3: linked cells differ by one at most.
        let mut layers = [reached, P::NONE, P::NONE];
        let mut count = 0;
        while reached.and(&unexplored) == P::NONE {
            count += 1;
            let (beside, above) = (reached.along_rows(&east), reached.along_columns(&south));
            let round = beside.along_columns(&south).or(&above.along_rows(&east));
            let wider = reached.or(&beside).or(&above).or(&round);
            if wider == reached || count >= stops.len() {
                return None;
            }
            layers[count % 3] = layers[count % 3].or(&wider.and(&reached.not()));
            reached = wider;
        }
        let is_in =
            |plane: &P, cell| self.area.locate(cell).is_some_and(|(column, row)| plane.has(column, row));
        let targets = reached.and(&unexplored);
        let mut stop = self.area.cells().find(|&cell| is_in(&targets, cell))?;
        for place in (1..=count).rev() {
            stops[place] = stop;
            let nearer = &layers[(place - 1) % 3];
            stop = links(self, stop).map(|(cell, _)| cell).find(|&cell| is_in(nearer, cell))?;
        }
        *stops.first_mut()? = stop;
        Some(count)
    }

    fn next_unexplored(&self, from: Cell, last: Option<(u32, Cell)>, most: u32) -> Option<(u32, Cell)> {
        let (column, row) = self.area.locate(from)?;
        let [east, south] = self.open(Avoid::Walls);
        let unexplored = self.cells[CellMark::Explored as usize].not();
        let mut reached = P::NONE;
        reached.put(column, row);
        let (mut ring, mut rows) = (reached, beside::<P>((row, row)));
        let is_behind = |distance, cell: Cell| match last {
            None => true,
            Some((last, before)) => distance > last || (before.y, before.x) < (cell.y, cell.x),
        };
        for distance in 0..=most {
            let found = ring.and(&unexplored);
            if last.is_none_or(|(last, _)| distance >= last) && found != P::NONE {
                let is_in = |cell| self.area.locate(cell).is_some_and(|(column, row)| found.has(column, row));
                let mut cells = self.area.around(from, distance as u16)?.cells();
                if let Some(cell) = cells.find(|&cell| is_in(cell) && is_behind(distance, cell)) {
                    return Some((distance, cell));
                }
            }
            let before = reached;
            rows = beside::<P>(reached.spread(&east, &south, rows)?);
            ring = reached.and(&before.not());
        }
        None
    }

    fn bearings(&mut self, to: Cell, most: u32) -> Layers<P> {
        let [east, south] = self.open(Avoid::Walls);
        let mut layers = [P::NONE; 3];
        let Some((column, row)) = self.area.locate(to) else { return Layers(layers) };
        layers[0].put(column, row);
        let (mut reached, mut rows) = (layers[0], beside::<P>((row, row)));
        for distance in 1..=most as usize {
            let before = reached;
            let Some(wider) = reached.spread(&east, &south, rows) else { break };
            rows = beside::<P>(wider);
            let layer = &mut layers[distance % 3];
            *layer = layer.or(&reached.and(&before.not()));
        }
        Layers(layers)
    }

    fn nearer(&self, Layers(layers): &Layers<P>, at: Cell) -> Steps {
        let Some((column, row)) = self.area.locate(at) else { return Steps::NONE };
        let own = (0..3).find(|&layer| layers[layer].has(column, row));
        let open = Steps::ALL.without(Step::Stay).minus(self.sides(EdgeMark::Wall, at));
        own.map_or(Steps::NONE, |own| open.and(layers[(own + 2) % 3].steps_from(column, row)))
    }
}

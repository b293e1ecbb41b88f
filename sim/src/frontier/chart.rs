//! A repository of any size, which remembers in which order it learned what it knows: so a robot that joins it again
//! looks only at what is new.

use tautline_kernel::frontier::{Map, Pair, Scratch, Search, SearchCell, Status};
use tautline_kernel::ground::{Area, Cell, Side};

/// A repository on the heap.
#[derive(Clone, Debug)]
pub(super) struct Chart {
    area: Area,
    /// By place: row by row, with a rim of obstacles around the area, so that every cell has four neighbours.
    pub(super) statuses: Vec<Status>,
    /// The cells that it has learned, in order.
    learned: Vec<(Cell, Status)>,
    /// Unexplored cells beside explored ones.
    frontier: usize,
    /// How many cells are explored.
    pub(super) explored: usize,
    /// Whether a cell was explored that was noted as an obstacle before.
    pub(super) has_erred: bool,
}

impl Chart {
    /// Nothing known of `area`.
    pub(super) fn new(area: Area) -> Self {
        let statuses = vec![Status::Obstacle; (area.width() + 2) * (area.height() + 2)];
        let mut chart =
            Self { area, statuses, learned: Vec::new(), frontier: 0, explored: 0, has_erred: false };
        for place in area.cells().filter_map(|cell| chart.place(cell)).collect::<Vec<_>>() {
            chart.statuses[place] = Status::Unexplored;
        }
        chart
    }

    /// The cells that it has learned since it knew so much.
    pub(super) fn learned(&self, since: usize) -> &[(Cell, Status)] {
        self.learned.get(since..).unwrap_or_default()
    }

    /// How much it has learned.
    pub(super) const fn len(&self) -> usize {
        self.learned.len()
    }

    /// How far the place of a neighbour is from that of a cell: in the order of the numbers of the cells beyond the
    /// sides.
    pub(super) fn steps(&self) -> [(isize, Side); 4] {
        let row = self.area.width() as isize + 2;
        [(-row, Side::North), (-1, Side::West), (1, Side::East), (row, Side::South)]
    }

    /// The place of a cell of the area.
    pub(super) fn place(&self, cell: Cell) -> Option<usize> {
        self.area.locate(cell).map(|(column, row)| (row + 1) * (self.area.width() + 2) + column + 1)
    }

    /// The cell in a place.
    pub(super) fn cell(&self, place: usize) -> Cell {
        let (first, row) = (self.area.first(), self.area.width() + 2);
        Cell::new(first.x + (place % row) as i16 - 1, first.y + (place / row) as i16 - 1)
    }

    /// Whether a cell is unexplored and beside an explored one.
    fn is_frontier(&self, cell: Cell) -> bool {
        let is_explored = |side: Side| self.status(cell.beyond(side)) == Status::Explored;
        self.status(cell) == Status::Unexplored && Side::ALL.into_iter().any(is_explored)
    }

    /// Notes what is so of a cell, and counts the frontier anew around it.
    fn note(&mut self, (place, cell): (usize, Cell), status: Status) {
        let around = |chart: &Self| {
            let beside = Side::ALL.map(|side| cell.beyond(side));
            beside.into_iter().chain([cell]).filter(|&cell| chart.is_frontier(cell)).count()
        };
        let before = around(self);
        self.has_erred |= self.statuses[place] == Status::Obstacle;
        self.explored += usize::from(status == Status::Explored);
        self.statuses[place] = status;
        self.learned.push((cell, status));
        self.frontier = self.frontier + around(self) - before;
    }
}

impl Map for Chart {
    fn area(&self) -> Area {
        self.area
    }

    fn status(&self, cell: Cell) -> Status {
        self.place(cell).map_or(Status::Obstacle, |place| self.statuses[place])
    }

    fn frontier(&self) -> usize {
        self.frontier
    }

    fn learn(&mut self, cell: Cell, status: Status) {
        if let Some(place) = self.place(cell).filter(|&place| self.statuses[place] < status) {
            self.note((place, cell), status);
        }
    }
}

/// The memory of searches in an area.
#[derive(Clone, Debug)]
pub(super) struct Memory {
    reached: Vec<SearchCell>,
    queue: Vec<Cell>,
    rounds: u32,
    pairs: Vec<Option<Pair>>,
}

impl Memory {
    /// For so many robots.
    pub(super) fn new(area: Area, robots: usize) -> Self {
        let cells = area.width() * area.height();
        Self {
            reached: vec![SearchCell::NEVER; cells],
            queue: vec![Cell::new(0, 0); cells],
            rounds: 0,
            pairs: vec![None; robots * robots],
        }
    }

    pub(super) fn scratch(&mut self) -> Scratch<'_> {
        let Self { reached, queue, rounds, pairs } = self;
        Scratch { search: Search { reached, queue, rounds }, pairs }
    }
}

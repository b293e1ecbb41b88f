//! The grid of areas of any size: what [`BitGrid`](tautline_kernel::ground::BitGrid) is to a small area, on the
//! heap. Its distances [Kovács 2011, equation (4)] come from a search that learns. Cells become explored and edges
//! become blocked, hardly ever the reverse, so a distance once found stays a lower bound. Every search is an A*
//! from the asking cell with those bounds as its estimate, and leaves better bounds behind (Adaptive A*, Koenig
//! and Likhachev 2005): a path that still stands is walked straight down, and a region without a way out is
//! searched once.

mod map;
mod search;

use std::collections::VecDeque;
use std::sync::Arc;

use tautline_kernel::ground::{Area, Avoid, Cell, CellMark, Edge, EdgeMark, Grid, Step, Steps, links};

pub use self::map::Near;
use self::map::{EXPLORED, Map, UNREACHED, all_sides, cell_mark, edge_mark};
use self::search::{Field, Search};

/// A grid on the heap, of any width and height.
#[derive(Clone, Debug)]
pub struct HeapGrid {
    area: Area,
    /// How many cells are unexplored.
    unexplored: usize,
    map: Map,
    /// The edges with a virtual obstacle.
    virtual_edges: Vec<Edge>,
    followers: Field,
    /// Bounds that are never below the followers'.
    leader: Field,
    search: Search,
    /// The last walk asked for, as long as nothing more is explored or a wall.
    walk: Option<Walk>,
    /// The last bearings asked for, as long as no wall has changed them.
    bearings: VecDeque<Bearings>,
}

/// The last bearings that are kept: as many as one plan of a reel asks for.
const MOST_BEARINGS: usize = 64;

/// The findings of [`Grid::bearings`].
#[derive(Clone, Debug)]
struct Bearings {
    to: Cell,
    most: u32,
    near: Arc<Near>,
}

/// The findings of [`Grid::stops`].
#[derive(Clone, Debug)]
struct Walk {
    from: Cell,
    /// Most links.
    most: usize,
    stops: Option<Vec<Cell>>,
}

impl HeapGrid {
    /// Nothing known of `area` but its border. It takes 22 bytes a cell.
    pub fn new(area: Area) -> Self {
        let cells = area.width() * area.height();
        let mut map = Map { width: area.width(), marks: vec![0; cells] };
        map.close_border();
        Self {
            area,
            unexplored: cells,
            map,
            virtual_edges: Vec::new(),
            followers: Field::new(cells, &[EdgeMark::Wall]),
            leader: Field::new(cells, &[EdgeMark::Wall, EdgeMark::Virtual]),
            search: Search::new(cells),
            walk: None,
            bearings: VecDeque::new(),
        }
    }

    /// The cell at `place`.
    fn cell(&self, place: usize) -> Cell {
        let first = self.area.first();
        Cell::new(first.x + (place % self.map.width) as i16, first.y + (place / self.map.width) as i16)
    }

    /// The stops of the walk of at most `most` links from `from` to an unexplored cell, if there is one.
    fn find_stops(&mut self, from: Cell, most: usize) -> Option<Vec<Cell>> {
        let start = self.place(from)?;
        let target = self.search.link_up(&self.map, start, most);
        let stops = target.map(|(target, links_away)| {
            let mut stops = vec![self.cell(target)];
            for nearer in (0..links_away).rev() {
                let is_nearer =
                    |cell| self.place(cell).is_some_and(|place| self.search.steps[place] == nearer);
                let mut linked = links(self, stops[stops.len() - 1]).map(|(cell, _)| cell);
                stops.extend(linked.find(|&cell| is_nearer(cell)));
            }
            stops.reverse();
            stops
        });
        self.search.clear();
        stops
    }

    /// The place of `cell` in the lists of cells; `None` outside the area.
    fn place(&self, cell: Cell) -> Option<usize> {
        self.area.locate(cell).map(|(column, row)| row * self.map.width + column)
    }
}

impl Grid for HeapGrid {
    type Bearings = Arc<Near>;

    fn area(&self) -> Area {
        self.area
    }

    fn has(&self, mark: CellMark, cell: Cell) -> bool {
        match self.place(cell) {
            Some(place) => self.map.marks[place] & cell_mark(mark) != 0,
            None => mark == CellMark::Explored,
        }
    }

    fn put(&mut self, mark: CellMark, cell: Cell) {
        let Some(place) = self.place(cell) else { return };
        if mark == CellMark::Explored && self.map.marks[place] & EXPLORED == 0 {
            self.unexplored -= 1;
            self.walk = None;
            self.followers.doubt();
            self.leader.doubt();
        }
        self.map.marks[place] |= cell_mark(mark);
    }

    fn take(&mut self, mark: CellMark, cell: Cell) {
        let Some(place) = self.place(cell) else { return };
        if mark == CellMark::Explored && self.map.marks[place] & EXPLORED != 0 {
            self.unexplored += 1;
            self.walk = None;
            self.followers.forget();
            self.leader.forget();
        }
        self.map.marks[place] &= !cell_mark(mark);
    }

    fn edge_has(&self, mark: EdgeMark, edge: Edge) -> bool {
        match self.place(edge.cell()) {
            Some(place) => self.map.marks[place] & edge_mark(mark, edge.side()) != 0,
            None => mark == EdgeMark::Wall,
        }
    }

    fn put_edge(&mut self, mark: EdgeMark, edge: Edge) {
        let (cell, side) = (edge.cell(), edge.side());
        let (Some(near), Some(far)) = (self.place(cell), self.place(cell.beyond(side))) else { return };
        // At the rim of the coordinates a cell is its own neighbour: that edge is border, too.
        if near == far || self.map.marks[near] & edge_mark(mark, side) != 0 {
            return;
        }
        self.map.marks[near] |= edge_mark(mark, side);
        self.map.marks[far] |= edge_mark(mark, side.opposite());
        match mark {
            EdgeMark::Wall => {
                self.walk = None;
                self.bearings.retain(|bearings| self.map.outlasts(&bearings.near, near, far));
            }
            EdgeMark::Open => {}
            EdgeMark::Virtual => self.virtual_edges.push(edge),
        }
        for field in [&mut self.followers, &mut self.leader] {
            if field.blocked & all_sides(mark) != 0 {
                field.doubt();
            }
        }
    }

    fn clear_edges(&mut self, mark: EdgeMark) {
        match mark {
            EdgeMark::Wall => {
                self.walk = None;
                self.bearings.clear();
                self.map.clear(mark);
                self.map.close_border();
                self.followers.forget();
                self.leader.forget();
            }
            EdgeMark::Open => self.map.clear(mark),
            // An epoch may be short in a large area: only what it changed is changed back.
            EdgeMark::Virtual => {
                for edge in std::mem::take(&mut self.virtual_edges) {
                    let (cell, side) = (edge.cell(), edge.side());
                    for (cell, side) in [(cell, side), (cell.beyond(side), side.opposite())] {
                        if let Some(place) = self.place(cell) {
                            self.map.marks[place] &= !edge_mark(mark, side);
                        }
                    }
                }
                self.leader.fall_back(&self.followers);
            }
        }
    }

    fn is_explored(&self) -> bool {
        self.unexplored == 0
    }

    fn distance(&mut self, from: Cell, avoid: Avoid) -> Option<u32> {
        let from = self.place(from)?;
        if self.map.marks[from] & EXPLORED == 0 {
            return Some(0);
        }
        let field = match avoid {
            Avoid::Walls => &mut self.followers,
            Avoid::WallsAndVirtual => &mut self.leader,
        };
        if !field.bounds[from].is_exact() {
            self.search.run(&self.map, field, from);
            match avoid {
                Avoid::Walls => self.leader.keep_up(&self.followers, &self.search.reached),
                Avoid::WallsAndVirtual => self.leader.get_ahead(&self.search.reached),
            }
            self.search.clear();
        }
        let field = match avoid {
            Avoid::Walls => &self.followers,
            Avoid::WallsAndVirtual => &self.leader,
        };
        let steps = field.bounds[from].steps;
        (steps != UNREACHED).then_some(steps)
    }

    fn stops(&mut self, from: Cell, stops: &mut [Cell]) -> Option<usize> {
        let most = stops.len().checked_sub(1)?;
        let known = self.walk.take().filter(|walk| (walk.from, walk.most) == (from, most));
        let walk = known.unwrap_or_else(|| Walk { from, most, stops: self.find_stops(from, most) });
        let found = self.walk.insert(walk).stops.as_deref()?;
        stops[..found.len()].copy_from_slice(found);
        Some(found.len() - 1)
    }

    fn next_unexplored(&self, from: Cell, last: Option<(u32, Cell)>, most: u32) -> Option<(u32, Cell)> {
        let from = self.place(from)?;
        let last = last.map(|(distance, cell)| (distance, (cell.y, cell.x)));
        let mut found = None;
        self.map.flood(from, most, |place, distance| {
            if found.is_some_and(|(nearest, _)| nearest < distance) {
                return false;
            }
            let cell = self.cell(place);
            let is_next = last.is_none_or(|last| (distance, (cell.y, cell.x)) > last);
            if self.map.marks[place] & EXPLORED == 0 && is_next {
                let nearer =
                    found.is_none_or(|(_, other): (u32, Cell)| (cell.y, cell.x) < (other.y, other.x));
                found = if nearer { Some((distance, cell)) } else { found };
            }
            true
        });
        found
    }

    fn least_distance(&mut self, from: Cell) -> u32 {
        self.distance(from, Avoid::Walls).unwrap_or(UNREACHED)
    }

    fn bearings(&mut self, to: Cell, most: u32) -> Arc<Near> {
        if let Some(known) = self.bearings.iter().find(|known| (known.to, known.most) == (to, most)) {
            return Arc::clone(&known.near);
        }
        let near = self.place(to).map_or(Near::NOTHING, |to| self.map.flood(to, most, |_, _| true));
        let near = Arc::new(near);
        if self.bearings.len() == MOST_BEARINGS {
            self.bearings.pop_front();
        }
        self.bearings.push_back(Bearings { to, most, near: Arc::clone(&near) });
        near
    }

    fn nearer(&self, near: &Arc<Near>, at: Cell) -> Steps {
        let distance = |cell: Cell| self.place(cell).and_then(|place| near.distance(place));
        let Some(own) = distance(at) else { return Steps::NONE };
        let open = Steps::ALL.without(Step::Stay).minus(self.sides(EdgeMark::Wall, at));
        open.filter(|step| distance(at.after(step)).is_some_and(|there| there < own))
    }
}

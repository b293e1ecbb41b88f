//! The grid of areas of any size: what [`BitGrid`](tautline_kernel::ground::BitGrid) is to a small area, on the
//! heap. Its distances (paper 000, equation (4)) come from a search that learns. Cells become explored and edges
//! become blocked, hardly ever the reverse, so a distance once found stays a lower bound. Every search is an A*
//! from the asking cell with those bounds as its estimate, and leaves better bounds behind (Adaptive A*, Koenig
//! and Likhachev 2005): a path that still stands is walked straight down, and a region without a way out is
//! searched once.

use std::collections::{HashMap, HashSet};

use tautline_kernel::ground::{Area, Avoid, Cell, CellMark, Edge, EdgeMark, Grid, Side, Step, Steps, links};

/// The marks of one cell: four bits for the cell, then for each mark of edges four bits, one a side. An edge is
/// marked in both its cells, so that one word tells a search all about a cell.
type Marks = u16;

const EXPLORED: Marks = cell_mark(CellMark::Explored);

const fn cell_mark(mark: CellMark) -> Marks {
    1 << mark as u16
}

const fn edge_mark(mark: EdgeMark, side: Side) -> Marks {
    1 << (4 + 4 * mark as u16 + side as u16)
}

const fn all_sides(mark: EdgeMark) -> Marks {
    0b1111 << (4 + 4 * mark as u16)
}

/// A grid on the heap, of any width and height.
#[derive(Clone, Debug)]
pub struct WideGrid {
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
}

/// What [`Grid::stops`] found.
#[derive(Clone, Debug)]
struct Walk {
    from: Cell,
    /// Most links.
    most: usize,
    stops: Option<Vec<Cell>>,
}

impl WideGrid {
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
            search: Search { steps: vec![UNREACHED; cells], reached: Vec::new(), open: Default::default() },
            walk: None,
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

/// The distances of the cells near one of them, by place.
#[derive(Clone, Debug)]
pub struct Near(HashMap<usize, u32>);

impl Grid for WideGrid {
    type Bearings = Near;

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
            EdgeMark::Wall => self.walk = None,
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

    fn bearings(&self, to: Cell, most: u32) -> Near {
        let mut near = HashMap::new();
        if let Some(to) = self.place(to) {
            self.map.flood(to, most, |place, distance| {
                near.insert(place, distance);
                true
            });
        }
        Near(near)
    }

    fn nearer(&self, Near(near): &Near, at: Cell) -> Steps {
        let distance = |cell: Cell| self.place(cell).and_then(|place| near.get(&place));
        let open = Steps::ALL.without(Step::Stay).minus(self.sides(EdgeMark::Wall, at));
        let own = distance(at).copied();
        open.filter(|step| distance(at.after(step)).zip(own).is_some_and(|(there, own)| *there < own))
    }
}

/// The marks of all cells, row by row.
#[derive(Clone, Debug)]
struct Map {
    /// Cells in a row.
    width: usize,
    marks: Vec<Marks>,
}

impl Map {
    /// Takes `mark` off all edges.
    fn clear(&mut self, mark: EdgeMark) {
        for marks in &mut self.marks {
            *marks &= !all_sides(mark);
        }
    }

    /// Marks the border as walls.
    fn close_border(&mut self) {
        let (width, last) = (self.width, self.marks.len() - self.width);
        for row in self.marks.chunks_exact_mut(width) {
            row[0] |= edge_mark(EdgeMark::Wall, Side::West);
            row[width - 1] |= edge_mark(EdgeMark::Wall, Side::East);
        }
        for marks in &mut self.marks[..width] {
            *marks |= edge_mark(EdgeMark::Wall, Side::North);
        }
        for marks in &mut self.marks[last..] {
            *marks |= edge_mark(EdgeMark::Wall, Side::South);
        }
    }

    /// The neighbours of the cell at `place` beyond sides that carry none of the `blocked` marks. The border,
    /// a wall for good, keeps them in the area.
    fn neighbours(&self, place: usize, blocked: Marks) -> impl Iterator<Item = usize> + use<> {
        let (closed, width) = (self.marks[place] & blocked, self.width);
        Side::ALL
            .into_iter()
            .filter(move |&side| closed & edge_sides(side) == 0)
            .map(move |side| beyond(place, side, width))
    }

    /// Tells of the cells at most `most` steps from the one at `from` over sides without a wall, nearest first, with their
    /// distances, until `tell` says that it has heard enough.
    fn flood(&self, from: usize, most: u32, mut tell: impl FnMut(usize, u32) -> bool) {
        let mut reached = HashSet::from([from]);
        let mut ring = vec![from];
        for distance in 0..=most {
            let mut next = Vec::new();
            for place in ring {
                if !tell(place, distance) {
                    return;
                }
                let beyond = self.neighbours(place, all_sides(EdgeMark::Wall));
                next.extend(beyond.filter(|&place| reached.insert(place)));
            }
            ring = next;
        }
    }

    /// The neighbours of the cell at `place` that are one link away: beyond its sides, and round its corners.
    fn linked(&self, place: usize) -> impl Iterator<Item = usize> {
        let open = |place: usize| {
            let walls = self.marks[place];
            Side::ALL.into_iter().filter(move |&side| walls & edge_mark(EdgeMark::Wall, side) == 0)
        };
        open(place).flat_map(move |side| {
            let next = beyond(place, side, self.width);
            let turns = open(next).filter(move |&turn| turn != side && turn != side.opposite());
            std::iter::once(next).chain(turns.map(move |turn| beyond(next, turn, self.width)))
        })
    }
}

/// The neighbour beyond `side` of the cell at `place`, where rows have `width` cells.
const fn beyond(place: usize, side: Side, width: usize) -> usize {
    match side {
        Side::East => place + 1,
        Side::South => place + width,
        Side::West => place - 1,
        Side::North => place - width,
    }
}

/// All marks of edges on this `side`.
const fn edge_sides(side: Side) -> Marks {
    edge_mark(EdgeMark::Wall, side) | edge_mark(EdgeMark::Open, side) | edge_mark(EdgeMark::Virtual, side)
}

/// What is known of a cell's distance to the nearest unexplored cell.
#[derive(Clone, Copy, Default, Debug)]
struct Bound {
    /// It is not less than this many steps; `UNREACHED` if there is no path.
    steps: u32,
    /// It is just that.
    exact: bool,
    /// It may be above the followers' bound.
    ahead: bool,
}

impl Bound {
    /// Whether no search would find more.
    const fn is_exact(self) -> bool {
        self.exact || self.steps == UNREACHED
    }
}

/// More steps than any path has.
const UNREACHED: u32 = u32::MAX;

/// Bounds on the distances of all cells, for one choice of what blocks. The bounds of two cells with an open
/// edge between them differ by one at most, so that a search never has to come back to a cell.
#[derive(Clone, Debug)]
struct Field {
    /// The marks of edges that block, on all sides.
    blocked: Marks,
    bounds: Vec<Bound>,
    /// The cells whose bound is exact as long as nothing more is explored or blocked.
    exact: Vec<usize>,
    /// The cells whose bound may be above the followers'.
    ahead: Vec<usize>,
}

impl Field {
    fn new(cells: usize, blocking: &[EdgeMark]) -> Self {
        let blocked = blocking.iter().fold(0, |blocked, &mark| blocked | all_sides(mark));
        Self { blocked, bounds: vec![Bound::default(); cells], exact: Vec::new(), ahead: Vec::new() }
    }

    /// Distances may have grown. Where there was no path, there is still none.
    fn doubt(&mut self) {
        for place in self.exact.drain(..) {
            self.bounds[place].exact = false;
        }
    }

    /// Distances may have shrunk.
    fn forget(&mut self) {
        self.bounds.fill(Bound::default());
        self.exact.clear();
        self.ahead.clear();
    }

    /// The leader's bounds rise to what the `followers` have learned of the cells `reached`.
    fn keep_up(&mut self, followers: &Self, reached: &[usize]) {
        for &place in reached {
            let bound = &mut self.bounds[place];
            bound.steps = bound.steps.max(followers.bounds[place].steps);
        }
    }

    /// The leader has learned something by itself of the cells `reached`.
    fn get_ahead(&mut self, reached: &[usize]) {
        for &place in reached {
            if !std::mem::replace(&mut self.bounds[place].ahead, true) {
                self.ahead.push(place);
            }
        }
    }

    /// Without virtual obstacles, the leader's distances are the followers'.
    fn fall_back(&mut self, followers: &Self) {
        for place in self.ahead.drain(..) {
            self.bounds[place] = Bound { steps: followers.bounds[place].steps, ..Bound::default() };
        }
        self.exact.clear();
    }
}

/// The working space of a search.
#[derive(Clone, Debug)]
struct Search {
    /// Steps, or links, from the start to each cell on the shortest path found, or `UNREACHED`.
    steps: Vec<u32>,
    /// The cells with a path found.
    reached: Vec<usize>,
    /// Cells to look at, by the sum of steps and bound, modulo 3: a neighbour's sum is larger by 2 at most.
    open: [Vec<usize>; 3],
}

impl Search {
    /// Makes the bound of `from` exact and betters those of the cells on its way, all cells that are reached.
    fn run(&mut self, map: &Map, field: &mut Field, from: usize) {
        let mut sum = field.bounds[from].steps;
        self.reach(from, 0, sum);
        let end = loop {
            let Some(later) = (0..3).find(|later| !self.open[(sum + later) as usize % 3].is_empty()) else {
                break None;
            };
            sum += later;
            // The last one put in is the farthest on its way.
            let Some(place) = self.open[sum as usize % 3].pop() else { continue };
            let steps = self.steps[place];
            if steps + field.bounds[place].steps != sum {
                continue; // A shorter path to it was found meanwhile, and followed.
            }
            if map.marks[place] & EXPLORED == 0 || field.bounds[place].is_exact() {
                break Some(place);
            }
            for next in map.neighbours(place, field.blocked) {
                if steps + 1 < self.steps[next] && field.bounds[next].steps != UNREACHED {
                    self.reach(next, steps + 1, steps + 1 + field.bounds[next].steps);
                }
            }
        };
        match end {
            Some(end) => self.learn(map, field, end, sum),
            None => {
                for &place in &self.reached {
                    field.bounds[place].steps = UNREACHED;
                }
            }
        }
    }

    /// Reaches the cells at most `most` links from the one at `start`, up to the nearest unexplored: the place of
    /// the first of these, and how many links away it is. `steps` are links until the next search.
    fn link_up(&mut self, map: &Map, start: usize, most: usize) -> Option<(usize, u32)> {
        self.steps[start] = 0;
        self.reached.push(start);
        let mut layer = 0;
        for count in 0..=most as u32 {
            let unexplored = |&&place: &&usize| map.marks[place] & EXPLORED == 0;
            if let Some(&target) = self.reached[layer..].iter().filter(unexplored).min() {
                return Some((target, count));
            }
            let nearer = layer..self.reached.len();
            layer = nearer.end;
            for index in nearer {
                for next in map.linked(self.reached[index]) {
                    if self.steps[next] == UNREACHED {
                        self.steps[next] = count + 1;
                        self.reached.push(next);
                    }
                }
            }
        }
        None
    }

    /// Makes ready for the next search.
    fn clear(&mut self) {
        for place in self.reached.drain(..) {
            self.steps[place] = UNREACHED;
        }
        self.open.iter_mut().for_each(Vec::clear);
    }

    fn reach(&mut self, place: usize, steps: u32, sum: u32) {
        if self.steps[place] == UNREACHED {
            self.reached.push(place);
        }
        self.steps[place] = steps;
        self.open[sum as usize % 3].push(place);
    }

    /// From the start it is `distance` steps to the frontier, on a path over the cell at `end`.
    fn learn(&self, map: &Map, field: &mut Field, end: usize, distance: u32) {
        for &place in &self.reached {
            let bound = &mut field.bounds[place];
            bound.steps = bound.steps.max(distance.saturating_sub(self.steps[place]));
        }
        let mut place = end;
        while let Some(fewer) = self.steps[place].checked_sub(1) {
            let mut neighbours = map.neighbours(place, field.blocked);
            let Some(next) = neighbours.find(|&next| self.steps[next] == fewer) else { break };
            field.bounds[next].exact = true;
            field.exact.push(next);
            place = next;
        }
    }
}

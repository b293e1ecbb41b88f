//! The ground on which a team moves: what is fixed, what is any, and what is decided as robots meet it.

use std::fmt;

use tautline_kernel::choice::Oracle;
use tautline_kernel::ground::{Area, Cell, Edge, EdgeMark, Grid, Side, SmallGrid};

use crate::decide::MethodError;
use crate::plural::counted;

/// Which walls there are, or which blocked cells.
#[derive(Clone, Copy, Debug)]
pub enum Which<T: 'static> {
    /// None.
    None,
    /// These.
    These(&'static [T]),
    /// At most so many in one run, each decided when a robot meets it.
    Met(u32),
    /// Every set of at most so many, decided before the run begins.
    Any(u32),
}

impl<T> Which<T> {
    /// Most that a run meets.
    pub(super) const fn most_met(&self) -> u32 {
        match *self {
            Self::Met(most) => most,
            Self::None | Self::These(_) | Self::Any(_) => 0,
        }
    }

    /// Whether they are the same in every run.
    const fn is_known(&self) -> bool {
        matches!(self, Self::None | Self::These(_))
    }
}

/// The layouts in which a team moves.
#[derive(Clone, Copy, Debug)]
pub struct Ground {
    /// Columns and rows: at most 16.
    pub size: (i16, i16),
    /// Walls between cells; the border is not counted.
    pub walls: Which<Edge>,
    /// Blocked cells.
    pub obstacles: Which<Cell>,
    /// Only layouts of which this is so, in words and as a question, which is asked before the run begins.
    pub assume: Option<Assumption>,
}

/// A kind of layouts: the words that stand in the bound, and whether a layout is of that kind.
pub type Assumption = (&'static str, fn(&Map) -> bool);

impl Ground {
    /// So many columns and rows without walls and blocked cells.
    pub const fn open(width: i16, height: i16) -> Self {
        Self { size: (width, height), walls: Which::None, obstacles: Which::None, assume: None }
    }

    /// This ground with these walls.
    #[must_use]
    pub const fn walls(self, walls: Which<Edge>) -> Self {
        Self { walls, ..self }
    }

    /// This ground with these blocked cells.
    #[must_use]
    pub const fn obstacles(self, obstacles: Which<Cell>) -> Self {
        Self { obstacles, ..self }
    }

    /// This ground, only in layouts of which this is so. The words stand in the bound, behind "where".
    #[must_use]
    pub const fn assume(self, words: &'static str, is_so: fn(&Map) -> bool) -> Self {
        Self { assume: Some((words, is_so)), ..self }
    }

    /// The cells.
    pub(super) fn area(&self) -> Option<Area> {
        let (width, height) = self.size;
        let area =
            (width > 0 && height > 0).then(|| Area::new(Cell::new(0, 0), Cell::new(width - 1, height - 1)));
        area.flatten()
    }

    /// Most walls and blocked cells that a run can meet.
    pub(super) fn mishaps(&self) -> u32 {
        let area = self.area();
        let edges = area.map_or(0, |area| area.edges().count());
        let cells = area.map_or(0, |area| area.cells().count());
        let of = |most: u32, all: usize| if most > 0 { all as u32 } else { 0 };
        of(self.walls.most_met(), edges) + of(self.obstacles.most_met(), cells)
    }

    /// Every layout as it is known before a run begins.
    ///
    /// # Errors
    /// [`MethodError`] if the area is too large, a given wall or blocked cell is outside, or layouts are too many.
    pub(super) fn maps(&self) -> Result<Vec<Map>, MethodError> {
        let area = self.area().ok_or_else(|| MethodError::new("the area holds no cell"))?;
        let blank = Map::new(area).ok_or_else(|| MethodError::new("an area has at most 16×16 cells"))?;
        let edges: Vec<Edge> = area.edges().collect();
        let cells: Vec<Cell> = area.cells().collect();
        if let Which::These(these) = self.obstacles
            && let Some(outside) = these.iter().find(|cell| !cells.contains(cell))
        {
            return Err(MethodError::new(format_args!("the blocked cell {outside} is outside of the area")));
        }
        if let Which::These(these) = self.walls
            && let Some(outside) = these.iter().find(|edge| !edges.contains(edge))
        {
            let (one, other) = (outside.cell(), outside.cell().beyond(outside.side()));
            let why = format_args!("the wall {one}|{other} is between no two cells of the area");
            return Err(MethodError::new(why));
        }
        let mut maps = Vec::new();
        for walls in sets(&edges, self.walls)? {
            for blocked in sets(&cells, self.obstacles)? {
                let mut map = blank;
                for &edge in &walls {
                    map.note_edge(edge, false);
                }
                for &cell in &blocked {
                    map.note_cell(cell, false);
                }
                (map.walls, map.obstacles) = (0, 0);
                map.note_rest(self);
                if self.assume.is_none_or(|(_, is_so)| is_so(&map)) {
                    maps.push(map);
                }
            }
        }
        Ok(maps)
    }
}

impl fmt::Display for Ground {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { size: (width, height), walls, obstacles, assume } = self;
        let which = if walls.is_known() && obstacles.is_known() { "" } else { "all layouts of " };
        write!(f, "{which}{width}×{height} cells")?;
        f.write_str(if matches!(walls, Which::None) { " without walls" } else { "" })?;
        for words in [words(walls, "wall"), words(obstacles, "blocked cell")].into_iter().flatten() {
            write!(f, ", {words}")?;
        }
        assume.map_or(Ok(()), |(words, _)| write!(f, ", where {words}"))
    }
}

/// The words of a bound for walls or blocked cells.
fn words<T>(which: &Which<T>, one: &str) -> Option<String> {
    match *which {
        Which::None => None,
        Which::These(these) => Some(format!("{} given", counted(these.len() as u32, one))),
        Which::Met(most) => Some(format!("at most {}", counted(most, one))),
        Which::Any(most) => Some(format!("any {} at most", counted(most, one))),
    }
}

/// Most layouts that are made before a search begins.
const MOST_LAYOUTS: usize = 1 << 20;

/// The sets of `all` that are meant.
fn sets<T: Copy>(all: &[T], which: Which<T>) -> Result<Vec<Vec<T>>, MethodError> {
    let most = match which {
        Which::None | Which::Met(_) => return Ok(vec![Vec::new()]),
        Which::These(these) => return Ok(vec![these.to_vec()]),
        Which::Any(most) => most as usize,
    };
    let mut sets = vec![Vec::new()];
    for &next in all {
        for number in 0..sets.len() {
            if sets[number].len() < most {
                let set = [&sets[number][..], &[next]].concat();
                sets.push(set);
            }
        }
        if sets.len() > MOST_LAYOUTS {
            let what =
                format_args!("there are more than {MOST_LAYOUTS} layouts to begin with: ask for fewer walls");
            return Err(MethodError::new(what));
        }
    }
    sets.sort_by_key(Vec::len);
    Ok(sets)
}

/// A layout as far as it is decided: all of it, once a run can meet no more walls and blocked cells. So the ways by
/// which robots came to where they are differ in no map if they met the same walls.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub struct Map {
    grid: SmallGrid,
    /// By row, a bit for each column.
    free: [u16; 16],
    blocked: [u16; 16],
    /// Walls and blocked cells that were met.
    walls: u32,
    obstacles: u32,
}

impl Map {
    fn new(area: Area) -> Option<Self> {
        let grid = SmallGrid::new(area)?;
        Some(Self { grid, free: [0; 16], blocked: [0; 16], walls: 0, obstacles: 0 })
    }

    /// The cells.
    pub fn area(&self) -> Area {
        self.grid.area()
    }

    /// Whether robots can cross `edge`; `None` if that is decided when somebody meets it.
    pub fn edge(&self, edge: Edge) -> Option<bool> {
        if self.grid.edge_has(EdgeMark::Wall, edge) {
            return Some(false);
        }
        self.grid.edge_has(EdgeMark::Open, edge).then_some(true)
    }

    /// Whether robots can be in `cell`; `None` if that is decided when somebody meets it.
    pub fn cell(&self, cell: Cell) -> Option<bool> {
        let Some((column, row)) = self.area().locate(cell) else { return Some(false) };
        let has = |rows: &[u16; 16]| rows[row] >> column & 1 == 1;
        if has(&self.blocked) {
            return Some(false);
        }
        has(&self.free).then_some(true)
    }

    /// The walls that are known, but for the border.
    pub fn walls(&self) -> Vec<Edge> {
        self.area().edges().filter(|&edge| self.edge(edge) == Some(false)).collect()
    }

    /// The blocked cells that are known.
    pub fn obstacles(&self) -> Vec<Cell> {
        self.area().cells().filter(|&cell| self.cell(cell) == Some(false)).collect()
    }

    /// The free cells, of all that is not known to be blocked.
    pub fn free(&self) -> Vec<Cell> {
        self.area().cells().filter(|&cell| self.cell(cell) != Some(false)).collect()
    }

    /// Whether a robot can go from `cell` through `side`, of all that is not known to be shut.
    pub fn is_passable(&self, cell: Cell, side: Side) -> bool {
        self.edge(Edge::new(cell, side)) != Some(false) && self.cell(cell.beyond(side)) != Some(false)
    }

    /// The cells that a robot can reach from `start` without entering `without`.
    fn reach(&self, start: Cell, without: Option<Cell>) -> Vec<Cell> {
        let mut reached = vec![start];
        let mut next = 0;
        while let Some(&cell) = reached.get(next) {
            next += 1;
            for side in Side::ALL {
                let beyond = cell.beyond(side);
                if self.is_passable(cell, side) && Some(beyond) != without && !reached.contains(&beyond) {
                    reached.push(beyond);
                }
            }
        }
        reached
    }

    /// Whether every free cell can be reached from every other one.
    pub fn is_connected(&self) -> bool {
        let free = self.free();
        free.first().is_some_and(|&first| self.reach(first, None).len() == free.len())
    }

    /// Whether the free cells are connected, and stay so whichever one of them is taken out.
    pub fn is_biconnected(&self) -> bool {
        let free = self.free();
        let stays = |&without: &Cell| {
            let first = free.iter().find(|&&cell| cell != without);
            first.is_none_or(|&first| self.reach(first, Some(without)).len() == free.len() - 1)
        };
        self.is_connected() && free.iter().all(stays)
    }

    fn note_edge(&mut self, edge: Edge, is_open: bool) {
        self.walls += u32::from(!is_open);
        self.grid.put_edge(if is_open { EdgeMark::Open } else { EdgeMark::Wall }, edge);
    }

    pub(super) fn note_cell(&mut self, cell: Cell, is_free: bool) {
        self.obstacles += u32::from(!is_free);
        if let Some((column, row)) = self.area().locate(cell) {
            let rows = if is_free { &mut self.free } else { &mut self.blocked };
            rows[row] |= 1 << column;
        }
    }

    /// Makes open and free whatever nobody can meet any more.
    fn note_rest(&mut self, ground: &Ground) {
        if self.walls >= ground.walls.most_met() {
            for edge in self.area().edges() {
                if self.edge(edge).is_none() {
                    self.grid.put_edge(EdgeMark::Open, edge);
                }
            }
        }
        if self.obstacles >= ground.obstacles.most_met() {
            for cell in self.area().cells() {
                if self.cell(cell).is_none() {
                    self.note_cell(cell, true);
                }
            }
        }
    }

    /// Whether robots can cross `edge`, which is decided now if it was not before.
    pub(super) fn meet_edge(&mut self, ground: &Ground, edge: Edge, world: &mut dyn Oracle) -> bool {
        self.edge(edge).unwrap_or_else(|| {
            let is_open = world.is_open(edge);
            self.note_edge(edge, is_open);
            if !is_open {
                self.note_rest(ground);
            }
            is_open
        })
    }

    /// Whether robots can be in `cell`, which is decided now if it was not before.
    pub(super) fn meet_cell(&mut self, ground: &Ground, cell: Cell, world: &mut dyn Oracle) -> bool {
        self.cell(cell).unwrap_or_else(|| {
            let is_free = world.is_free(cell);
            self.note_cell(cell, is_free);
            if !is_free {
                self.note_rest(ground);
            }
            is_free
        })
    }
}

/// Whether robots can go from a cell through a side, which is decided now if it was not before.
pub(super) fn passes(
    ground: &Ground,
    map: &mut Option<Map>,
    (cell, side): (Cell, Side),
    world: &mut dyn Oracle,
) -> bool {
    let (edge, beyond) = (Edge::new(cell, side), cell.beyond(side));
    match map {
        Some(map) => map.meet_edge(ground, edge, world) && map.meet_cell(ground, beyond, world),
        None => world.is_open(edge) && world.is_free(beyond),
    }
}

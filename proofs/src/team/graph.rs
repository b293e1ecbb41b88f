//! Layouts as graphs: their free cells by number, which are beside each other, and how far apart they are. A rule over
//! states is quantified over them.

use std::fmt;
use std::sync::Arc;

use tautline_kernel::ground::{Cell, Side};

use super::Moves;
use super::ground::{Ground, Map, Which};
use crate::decide::MethodError;
use crate::plural::counted;
use crate::protocol::{Bound, arrangements};

/// A kind of layouts.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Kind {
    /// Every cell can be reached from every other one.
    Connected,
    /// Connected, and so whichever cell is taken out: one cell and two beside each other are so, too.
    Biconnected,
}

/// All layouts of a kind that have so many cells and fit into an area, each shape once wherever it stands.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Graphs {
    /// Columns and rows of the area.
    pub size: (i16, i16),
    /// The kind.
    pub kind: Kind,
    /// The fewest and the most cells.
    pub cells: (usize, usize),
}

impl Graphs {
    /// The layouts of a kind within an area, however many cells they have.
    pub const fn within(kind: Kind, width: i16, height: i16) -> Self {
        Self { size: (width, height), kind, cells: (1, width as usize * height as usize) }
    }

    /// The layouts, the fewest cells first.
    ///
    /// # Errors
    /// [`MethodError`] if the area holds no cell, or too many.
    pub fn all(&self) -> Result<Vec<Graph>, MethodError> {
        let (width, height) = self.size;
        let ground = Ground::open(width, height).obstacles(Which::Any(u32::MAX));
        let is_meant = |map: &Map| match self.kind {
            Kind::Connected => map.is_connected(),
            Kind::Biconnected => map.is_biconnected(),
        };
        let (fewest, most) = self.cells;
        let maps = ground.maps()?.into_iter().rev().filter(is_meant);
        let mut graphs: Vec<Graph> = Vec::new();
        for graph in maps.map(|map| Graph::new(&map)) {
            if (fewest..=most).contains(&graph.len()) && !graphs.contains(&graph) {
                graphs.push(graph);
            }
        }
        graphs.sort_by_key(Graph::len);
        Ok(graphs)
    }
}

impl fmt::Display for Graphs {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { size: (width, height), kind, cells: (fewest, most) } = self;
        let kind = match kind {
            Kind::Connected => "connected",
            Kind::Biconnected => "biconnected",
        };
        let all = *width as usize * *height as usize;
        write!(f, "all {kind} layouts within {width}×{height} cells")?;
        if (*fewest, *most) == (1, all) { Ok(()) } else { write!(f, ", {fewest} to {most} of them free") }
    }
}

/// So many robots in layouts, from every start to every goal: no two robots
/// start in one cell, and no two have one goal.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Teams {
    /// How many robots.
    pub robots: usize,
    /// The layouts.
    pub graphs: Graphs,
}

/// A layout, and where robots are to go in it.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Task {
    /// The layout.
    pub graph: Arc<Graph>,
    /// The goal of each robot.
    pub goals: Vec<u8>,
}

impl Teams {
    /// So many robots in all layouts of a kind within an area.
    pub const fn within(kind: Kind, width: i16, height: i16, robots: usize) -> Self {
        Self { robots, graphs: Graphs::within(kind, width, height) }
    }

    /// These teams in the layouts that have so many cells, at least and at most.
    #[must_use]
    pub const fn of_cells(mut self, fewest: usize, most: usize) -> Self {
        self.graphs.cells = (fewest, most);
        self
    }
}

impl fmt::Display for Teams {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}, {}, every start and goal", counted(self.robots as u32, "robot"), self.graphs)
    }
}

/// Layouts without room for the robots are left out.
impl Bound for Teams {
    type Surroundings = Task;

    fn each(&self) -> Result<Vec<Task>, MethodError> {
        let of = |graph: Graph| {
            let (places, graph) = (graph.places(self.robots), Arc::new(graph));
            places.into_iter().map(move |goals| Task { graph: Arc::clone(&graph), goals })
        };
        Ok(self.graphs.all()?.into_iter().flat_map(of).collect())
    }
}

impl Task {
    /// Every start of the robots.
    pub fn starts(&self) -> Vec<Vec<u8>> {
        self.graph.places(self.goals.len())
    }

    /// A drawing of robots by number, each cell with the letter of the robot whose goal it is.
    pub fn draw(&self, robots: &[u8]) -> String {
        let sign = |cells: &[u8], cell: u8, first: u8| {
            let place = cells.iter().position(|&other| other == cell);
            place.map_or('.', |place| char::from(first + place as u8))
        };
        self.graph.draw(|cell| [sign(robots, cell, b'0'), sign(&self.goals, cell, b'a')].iter().collect())
    }
}

/// So many robots in layouts, from every start. They act one at a time.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Crew {
    /// How many robots.
    pub robots: usize,
    /// The layouts.
    pub graphs: Graphs,
}

impl fmt::Display for Crew {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}, {}, every start", counted(self.robots as u32, "robot"), self.graphs)?;
        if self.robots == 1 { Ok(()) } else { write!(f, ", {}", Moves::OneAtATime) }
    }
}

/// A layout, and how many robots start in it.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Deployment {
    /// The layout.
    pub graph: Graph,
    /// How many robots.
    pub robots: usize,
}

/// Layouts without room for the robots are left out.
impl Bound for Crew {
    type Surroundings = Deployment;

    fn each(&self) -> Result<Vec<Deployment>, MethodError> {
        let graphs = self.graphs.all()?.into_iter().filter(|graph| graph.len() >= self.robots);
        Ok(graphs.map(|graph| Deployment { graph, robots: self.robots }).collect())
    }
}

/// A layout of at most 64 cells as far as robots know it, or have covered it.
#[derive(Clone, Copy, Debug)]
pub struct KnownGraph<'a> {
    /// The layout.
    pub graph: &'a Graph,
    /// The cells that are known, a bit for each.
    pub cells: u64,
}

impl KnownGraph<'_> {
    /// Whether a cell is known.
    pub const fn has(&self, cell: u8) -> bool {
        self.cells >> cell & 1 == 1
    }

    /// Whether all cells are known.
    pub const fn is_whole(&self) -> bool {
        self.cells.count_ones() as usize == self.graph.len()
    }

    /// Whether a cell is a frontier: known, and beside one that is not.
    pub fn is_frontier(&self, cell: u8) -> bool {
        self.has(cell) && self.graph.beside(cell).iter().any(|&other| !self.has(other))
    }

    /// The frontiers, by number.
    pub fn frontiers(&self) -> impl Iterator<Item = u8> {
        (0..self.graph.len() as u8).filter(|&cell| self.is_frontier(cell))
    }

    /// Steps from a cell to each, through known cells but these; [`u8::MAX`] where no way leads.
    pub fn steps(&self, from: u8, but: &[u8]) -> Vec<u8> {
        self.graph.steps_through(from, |cell| self.has(cell) && !but.contains(&cell))
    }

    /// The known cells, and a cell with those beside it.
    pub fn with_sight(&self, cell: u8) -> u64 {
        self.graph.beside(cell).iter().fold(self.cells | 1 << cell, |cells, beside| cells | 1 << beside)
    }
}

/// Whether two robots come into one cell, or change places.
pub fn conflicts(before: &[u8], after: &[u8]) -> bool {
    let robots = 0..before.len();
    robots.clone().any(|one| {
        let is_swap = |other: usize| before[one] == after[other] && after[one] == before[other];
        (0..one).any(|other| after[one] == after[other] || is_swap(other))
    })
}

/// The free cells of a layout by number, by rows and from left to right.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Graph {
    /// Columns and rows from the first free cell.
    cells: Vec<(u8, u8)>,
    beside: Vec<Vec<u8>>,
    /// Steps between two cells; [`u8::MAX`] if no way leads there.
    steps: Vec<Vec<u8>>,
}

impl Graph {
    /// The graph of a layout of at most 255 free cells.
    pub fn new(map: &Map) -> Self {
        let cells = map.free();
        let number = |wanted: Cell| cells.iter().position(|&cell| cell == wanted).map(|place| place as u8);
        let open = |&cell: &Cell| {
            let sides = Side::ALL.into_iter().filter(move |&side| map.is_passable(cell, side));
            sides.filter_map(|side| number(cell.beyond(side))).collect()
        };
        let beside: Vec<Vec<u8>> = cells.iter().map(open).collect();
        let steps = (0..cells.len()).map(|from| distances(&beside, from as u8, |_| true)).collect();
        let first = cells.iter().fold((i16::MAX, i16::MAX), |(x, y), cell| (x.min(cell.x), y.min(cell.y)));
        let placed = cells.iter().map(|cell| ((cell.x - first.0) as u8, (cell.y - first.1) as u8)).collect();
        Self { cells: placed, beside, steps }
    }

    /// How many cells there are.
    pub const fn len(&self) -> usize {
        self.cells.len()
    }

    /// Whether there is no cell.
    pub const fn is_empty(&self) -> bool {
        self.cells.is_empty()
    }

    /// The cells beside a cell.
    pub fn beside(&self, cell: u8) -> &[u8] {
        &self.beside[usize::from(cell)]
    }

    /// The cell beside a cell on this side, if robots can go there.
    pub fn to_side(&self, cell: u8, side: Side) -> Option<u8> {
        let (x, y) = self.cells[usize::from(cell)];
        let beyond = Cell::new(x.into(), y.into()).beyond(side);
        let is_beyond = |other: &&u8| {
            let (x, y) = self.cells[usize::from(**other)];
            beyond == Cell::new(x.into(), y.into())
        };
        self.beside(cell).iter().find(is_beyond).copied()
    }

    /// Steps from one cell to another; [`u8::MAX`] if no way leads there.
    pub fn steps(&self, from: u8, to: u8) -> u8 {
        self.steps[usize::from(from)][usize::from(to)]
    }

    /// Steps from a cell to each, through cells of which this is so; [`u8::MAX`] where no such way leads.
    pub fn steps_through(&self, from: u8, is_free: impl Fn(u8) -> bool) -> Vec<u8> {
        distances(&self.beside, from, is_free)
    }

    /// The cell beside a cell that is nearest by these steps, if it is nearer.
    pub fn nearer(&self, cell: u8, steps: &[u8]) -> Option<u8> {
        let of = |cell: u8| steps[usize::from(cell)];
        let nearest = self.beside(cell).iter().copied().min_by_key(|&beside| of(beside))?;
        (of(nearest) < of(cell)).then_some(nearest)
    }

    /// Every way to put so many robots into cells, no two into one.
    pub fn places(&self, robots: usize) -> Vec<Vec<u8>> {
        arrangements(&(0..self.len() as u8).collect::<Vec<_>>(), robots)
    }

    /// A drawing of the layout, each cell as `sign` says, all of them alike in width. What is blocked is `#`; walls are
    /// not drawn.
    pub fn draw(&self, sign: impl Fn(u8) -> String) -> String {
        let signs: Vec<String> = (0..self.len() as u8).map(sign).collect();
        let width = signs.iter().map(|sign| sign.chars().count()).max().unwrap_or(1);
        let most = self.cells.iter().fold((0, 0), |(x, y), cell| (cell.0.max(x), cell.1.max(y)));
        let blocked = vec!["#".repeat(width); usize::from(most.0) + 1];
        let mut rows = vec![blocked; usize::from(most.1) + 1];
        for (sign, &(column, row)) in signs.into_iter().zip(&self.cells) {
            rows[usize::from(row)][usize::from(column)] = sign;
        }
        let between = if width > 1 { " " } else { "" };
        rows.into_iter().map(|row| row.join(between)).collect::<Vec<_>>().join("\n")
    }
}

/// Steps from a cell to each.
fn distances(beside: &[Vec<u8>], from: u8, is_free: impl Fn(u8) -> bool) -> Vec<u8> {
    let mut steps = vec![u8::MAX; beside.len()];
    steps[usize::from(from)] = 0;
    let mut reached = vec![from];
    let mut next = 0;
    while let Some(&cell) = reached.get(next) {
        next += 1;
        for &beyond in &beside[usize::from(cell)] {
            if steps[usize::from(beyond)] == u8::MAX && is_free(beyond) {
                steps[usize::from(beyond)] = steps[usize::from(cell)] + 1;
                reached.push(beyond);
            }
        }
    }
    steps
}

#[cfg(test)]
mod tests {
    use super::*;

    const SMALL: Graphs = Graphs::within(Kind::Biconnected, 3, 2);

    fn count(graphs: Graphs) -> usize {
        graphs.all().expect("a small area").len()
    }

    /// Of 3×2 cells: one cell, two beside each other in two ways, the square, and the whole.
    #[test]
    fn every_shape_of_a_kind_is_there_once_the_smallest_first() {
        let graphs = SMALL.all().expect("a small area");
        let drawn: Vec<String> = graphs.iter().map(|graph| graph.draw(|_| ".".to_owned())).collect();
        assert_eq!(drawn, [".", "..", ".\n.", "..\n..", "...\n..."]);
        assert_eq!(count(Graphs { cells: (4, 6), ..SMALL }), 2);
        assert_eq!(SMALL.to_string(), "all biconnected layouts within 3×2 cells");
    }

    #[test]
    fn a_layout_without_room_for_the_robots_is_left_out() {
        let tasks = |robots| Teams { robots, graphs: SMALL }.each().expect("a small area");
        assert_eq!(tasks(5).iter().map(|task| task.starts().len()).collect::<Vec<_>>(), [720; 720]);
        assert_eq!(tasks(7), []);
    }

    #[test]
    fn a_way_leads_only_through_cells_that_are_free() {
        let graphs = Graphs { cells: (6, 6), ..SMALL }.all().expect("a small area");
        let graph = &graphs[0];
        assert_eq!((graph.steps(0, 5), graph.beside(1)), (3, &[2, 4, 0][..]));
        assert_eq!(graph.steps_through(0, |cell| cell != 1)[2], 4);
        assert_eq!(graph.steps_through(0, |cell| cell == 1)[5], u8::MAX);
    }
}

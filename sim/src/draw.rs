//! Drawings in text that a person can judge: layouts, team moves, the order of exploration, the environments of a cell.
//! Walls are drawn as in our layout format. Pictures for pages are in [`svg`], the words that go with a
//! counterexample in [`story`].

pub mod page;
pub mod story;
pub mod svg;

use std::fmt::Write;

use tautline_io::text_blocks::{Block, across, beside};
use tautline_kernel::chain::Kind;
use tautline_kernel::floor::Mark;
use tautline_kernel::ground::{Area, Cell, Circle, Edge, Side, Step, neighbours};
use tautline_proofs::floor_trace::{Scene, Turn};
use tautline_proofs::plural::listed;

use crate::explore::{Look, Play, Setup, Survey, TeamMove};
use tautline_grids::layout::Layout;

/// The meaning of the signs in a drawing of team moves.
pub const fn legend(look: Look) -> &'static str {
    match look {
        Look::Linked { .. } => {
            "B is the base, with the robots beside it or +K for K of them; 2, 3, … are the robots, the last one leads; \
             · is explored, ## blocked; x stands where a robot met a wall."
        }
        Look::Tree { .. } => {
            "B is the base, with the robots beside it or +K for K of them; 2, 3, … are the robots; \
             · is explored, ## blocked; x stands where a robot met a wall."
        }
        Look::Apart => {
            "1, 2, … are the agents, K× stands for K of them in one cell; · is explored, : explored and entered by \
             nobody any more, ░░░ visited, ▒▒▒ sealed, ## blocked; ? is a sensor that an agent missed."
        }
        Look::Robots => {
            "1, 2, … are the robots, K× stands for K of them in one cell; · is explored, ## blocked; \
             x stands where a robot met a wall."
        }
        Look::Own => {
            "0, 1, … are the robots, K× stands for K of them in one cell; · is a cell where a robot was, ## blocked; \
             x stands where a robot met a wall."
        }
    }
}

/// The cells of `area`, with a label of at most `width` characters in each. `is_marked` says which edges show an x.
fn grid(
    layout: &Layout,
    area: Area,
    width: usize,
    label: impl Fn(Cell) -> String,
    is_marked: impl Fn(Edge) -> bool,
) -> Vec<String> {
    let is_closed = |edge: Edge| {
        let sides = [edge.cell(), edge.cell().beyond(edge.side())];
        layout.has_wall(edge) || sides.iter().any(|&cell| !area.contains(cell))
    };
    let sign = |edge: Edge, wall: char| match (is_marked(edge), is_closed(edge)) {
        (true, _) => 'x',
        (false, true) => wall,
        (false, false) => ' ',
    };
    let (first, last) = (area.first(), area.last());
    let mut lines = Vec::with_capacity(2 * area.height() + 1);
    for y in first.y..=last.y.saturating_add(1) {
        let walls = (first.x..=last.x).map(|x| sign(Edge::new(Cell::new(x, y), Side::North), '-'));
        let walls: Vec<String> = walls.map(|wall| wall.to_string().repeat(width)).collect();
        lines.push(format!("+{}+", walls.join("+")));
        if y > last.y {
            break;
        }
        let mut cells = String::new();
        for x in first.x..=last.x.saturating_add(1) {
            let cell = Cell::new(x, y);
            cells.push(sign(Edge::new(cell, Side::West), '|'));
            if x <= last.x {
                let inside = if layout.is_free(cell) { label(cell) } else { "#".repeat(width) };
                // Writing to a string cannot fail.
                let _ = write!(cells, "{inside:^width$}");
            }
        }
        lines.push(cells);
    }
    lines
}

/// The moment that a drawing of a team move shows.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Pose {
    /// The robots where they were, each with the arrow of what it tries.
    Before,
    /// The robots where they are.
    After,
}

/// One team move of a run. `chart` knows the explored cells.
pub fn team_move(run: &dyn Play, chart: &Survey, made: &TeamMove<'_>, pose: Pose) -> Block {
    TeamMoves::new(run, chart).draw(made, pose)
}

/// The team moves of a run, drawn one by one.
#[derive(Debug)]
pub struct TeamMoves<'a> {
    setup: &'a Setup,
    chart: &'a Survey,
    is_bare: bool,
}

impl<'a> TeamMoves<'a> {
    /// Those of `run`. `chart` knows the explored cells.
    pub fn new(run: &'a dyn Play, chart: &'a Survey) -> Self {
        let setup = run.setup();
        Self { setup, chart, is_bare: is_bare(setup, chart.area()) }
    }

    /// The meaning of the signs in these drawings.
    pub fn legend(&self, pose: Pose) -> String {
        let short = " Here a is 10, b is 11 and so on, and * stands for several in one cell.";
        let is_short = self.is_bare && pose == Pose::After;
        legend(self.setup.scheme.look).to_owned() + if is_short { short } else { "" }
    }

    /// Whether one character for each cell is enough to draw a team move.
    fn is_bare(&self, made: &TeamMove<'_>, pose: Pose) -> bool {
        self.is_bare && made.unseen.is_empty() && pose == Pose::After
    }

    fn labels<'b>(&self, made: &'b TeamMove<'_>, pose: Pose) -> Labels<'b> {
        let (cells, steps) = match pose {
            Pose::Before => (made.before, Some(&made.frame.steps)),
            Pose::After => (made.frame.cells.as_slice(), None),
        };
        Labels { look: self.setup.scheme.look, cells, steps, unseen: made.unseen }
    }

    /// Columns of the drawing of a team move.
    pub fn columns(&self, made: &TeamMove<'_>, pose: Pose) -> usize {
        let width = self.chart.area().width();
        let columns = if self.is_bare(made, pose) {
            width + 2
        } else {
            width * (self.labels(made, pose).width() + 1) + 1
        };
        columns.max(title(made).chars().count())
    }

    /// How many team moves of at most so many columns fit into so many lines: at least one.
    pub fn fitting(&self, columns: usize, lines: usize) -> u32 {
        let height = self.chart.area().height();
        let block = if self.is_bare { height + 2 } else { 2 * height + 1 };
        ((lines / (block + 2)).max(1) * across(columns)) as u32
    }

    /// A team move.
    pub fn draw(&self, made: &TeamMove<'_>, pose: Pose) -> Block {
        let Self { setup, chart, .. } = self;
        let step = match pose {
            Pose::Before => made.step - 1,
            Pose::After => made.step,
        };
        let labels = self.labels(made, pose);
        let bumps: Vec<Edge> = made.frame.bumps().collect();
        let lines = if self.is_bare(made, pose) {
            bare(setup.scheme.look, chart.area(), labels.cells, |cell| chart.mark(cell, step))
        } else {
            let label = |cell| labels.label(cell, chart.mark(cell, step));
            grid(&setup.layout, chart.area(), labels.width(), label, |edge| bumps.contains(&edge))
        };
        Block { title: title(made), lines }
    }
}

/// Agents on a floor with such marks, one of them with the arrow of what it tries if that is given, with the sensors
/// that it misses.
fn agents(layout: &Layout, scene: &Scene, tries: Option<&Turn>) -> Vec<String> {
    let steps = tries.map(|turn| {
        let step = |agent| if agent == turn.agent { turn.step } else { Step::Stay };
        (0..scene.cells.len()).map(step).collect()
    });
    let unseen = tries.map_or(&[][..], |turn| &turn.unseen);
    let labels = Labels { look: Look::Apart, cells: &scene.cells, steps: steps.as_ref(), unseen };
    let mark =
        |cell| scene.marks.iter().find(|(at, _)| *at == cell).map_or(Mark::Unexplored, |&(_, mark)| mark);
    grid(layout, layout.size().area(), labels.width(), |cell| labels.label(cell, mark(cell)), |_| false)
}

fn title(made: &TeamMove<'_>) -> String {
    let kind = match made.frame.kind {
        Kind::Advance => "",
        Kind::Backtrack => " (back)",
    };
    let again = if made.team.comes_again() { " (again)" } else { "" };
    let (said, joined) = match made.team.title() {
        None => (String::new(), " "),
        Some(title) => (format!(": {title}"), "; "),
    };
    let broken = match made.broken {
        [] => String::new(),
        broken => format!("{joined}breaks {}", listed(broken)),
    };
    format!("move {}{kind}{again}{said}{broken}", made.step)
}

/// The place of the first robot that is drawn as one: a base is drawn for itself.
const fn first_drawn(look: Look) -> usize {
    if look.has_base() { 1 } else { 0 }
}

/// The labels of the cells in a drawing of a team.
struct Labels<'a> {
    look: Look,
    cells: &'a [Cell],
    /// The step that each robot tries, if arrows are to be drawn.
    steps: Option<&'a Vec<Step>>,
    /// Cells of sensors that were missed.
    unseen: &'a [Cell],
}

impl Labels<'_> {
    fn label(&self, cell: Cell, mark: Mark) -> String {
        let first = first_drawn(self.look);
        let here: Vec<usize> = (first..self.cells.len()).filter(|&robot| self.cells[robot] == cell).collect();
        if self.look.has_base() && self.cells[0] == cell {
            let rests = |&robot: &usize| self.steps.is_none_or(|steps| steps[robot] == Step::Stay);
            let (resting, leaving): (Vec<usize>, Vec<usize>) = here.into_iter().partition(rests);
            return match (resting.len(), leaving.len()) {
                (0 | 1, _) => format!("B{}{}", self.names(&resting), self.names(&leaving)),
                (many, 0) => format!("B+{many}"),
                (many, _) => format!("B+{many} {}", self.names(&leaving)),
            };
        }
        match (self.look, here.as_slice()) {
            (_, []) if self.unseen.contains(&cell) => match mark {
                Mark::Unexplored | Mark::Explored => "·?".to_owned(),
                Mark::Closing => ":?".to_owned(),
                Mark::Visited => "░?░".to_owned(),
                Mark::Sealed => "▒?▒".to_owned(),
            },
            (_, []) => match mark {
                Mark::Unexplored => String::new(),
                Mark::Explored => "·".to_owned(),
                Mark::Closing => ":".to_owned(),
                Mark::Visited => "░░░".to_owned(),
                Mark::Sealed => "▒▒▒".to_owned(),
            },
            (Look::Apart | Look::Robots | Look::Own, here) if self.unseen.contains(&cell) => {
                format!("{}?", self.team(here))
            }
            (Look::Apart | Look::Robots | Look::Own, here) => self.team(here),
            (Look::Linked { .. } | Look::Tree { .. }, here) => self.names(here),
        }
    }

    /// Agents in one cell.
    fn team(&self, agents: &[usize]) -> String {
        if agents.len() > 2 { format!("{}×", agents.len()) } else { self.names(agents) }
    }

    fn names(&self, robots: &[usize]) -> String {
        let names: Vec<String> = robots.iter().map(|&robot| self.name(robot)).collect();
        names.join(if self.cells.len() > 9 && self.steps.is_none() { "," } else { "" })
    }

    fn name(&self, robot: usize) -> String {
        let arrow = self.steps.map_or("", |steps| arrow(steps[robot]));
        format!("{}{arrow}", robot + self.look.first_number())
    }

    /// Columns of the widest label.
    fn width(&self) -> usize {
        let least = if self.cells.len() > 9 { 4 } else { 3 };
        let widths = self.cells.iter().map(|&cell| self.label(cell, Mark::Unexplored).chars().count());
        widths.max().unwrap_or(0).max(least)
    }
}

/// The arrow of a step; a robot that stays has a dot.
const fn arrow(step: Step) -> &'static str {
    ["→", "↓", "←", "↑", "·"][step.place()]
}

/// Digits and letters: the robots that have a character of their own.
const SYMBOLS: &str = "0123456789abcdefghijklmnopqrstuvwxyz";

/// Whether one character for each cell is enough to draw the run: nothing is in the way.
fn is_bare(setup: &Setup, area: Area) -> bool {
    usize::from(setup.robots) < SYMBOLS.len() && area.edges().all(|edge| setup.layout.is_open(edge))
}

/// A drawing with one character for each cell, of a team in an area with nothing in the way.
fn bare(look: Look, area: Area, team: &[Cell], mark: impl Fn(Cell) -> Mark) -> Vec<String> {
    let symbol = |cell: Cell| {
        let mut here = (first_drawn(look)..team.len()).filter(|&robot| team[robot] == cell);
        match (here.next(), here.next(), mark(cell)) {
            _ if look.has_base() && cell == team[0] => 'B',
            (Some(robot), None, _) => SYMBOLS.chars().nth(robot + look.first_number()).unwrap_or('*'),
            (Some(_), Some(_), _) => '*',
            (None, _, Mark::Unexplored) => ' ',
            (None, _, Mark::Explored) => '·',
            (None, _, Mark::Closing) => ':',
            (None, _, Mark::Visited) => '░',
            (None, _, Mark::Sealed) => '▒',
        }
    };
    let rim = format!("+{}+", "-".repeat(area.width()));
    let (first, last) = (area.first(), area.last());
    let rows = (first.y..=last.y).map(|y| {
        let row: String = (first.x..=last.x).map(|x| symbol(Cell::new(x, y))).collect();
        format!("|{row}|")
    });
    std::iter::once(rim.clone()).chain(rows).chain([rim.clone()]).collect()
}

/// The order of exploration: in each cell the team move in which it was explored.
pub fn order(run: &dyn Play, chart: &Survey) -> String {
    let Setup { layout, scheme, .. } = run.setup();
    let label = |cell| match (chart.step(cell), scheme.look) {
        (Some(0), Look::Linked { .. } | Look::Tree { .. }) => "B".to_owned(),
        (Some(step), _) => step.to_string(),
        (None, _) => String::new(),
    };
    let width = chart.area().cells().map(|cell| label(cell).len()).max().unwrap_or(0).max(2);
    grid(layout, chart.area(), width, label, |_| false).join("\n") + "\n"
}

/// The cells that were explored, and where the team is in the end.
pub fn outcome(run: &dyn Play, chart: &Survey, team: &[Cell]) -> String {
    let Setup { layout, scheme, .. } = run.setup();
    let labels = Labels { look: scheme.look, cells: team, steps: None, unseen: &[] };
    let label = |cell| labels.label(cell, chart.mark(cell, u32::MAX));
    grid(layout, chart.area(), labels.width(), label, |_| false).join("\n") + "\n"
}

/// A set of cells round one cell.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Environment {
    /// E_N: where a robot can be after one step.
    Neighbours,
    /// E_S: the cells wholly within r_safe.
    Safe,
    /// E_C: the cells wholly within r_cov.
    Covered,
}

impl Environment {
    /// All three, the smallest first.
    pub const ALL: [Self; 3] = [Self::Neighbours, Self::Safe, Self::Covered];

    /// Its symbol in the paper, its name in words, and the circle that decides it, if one does.
    const fn row(self) -> (&'static str, &'static str, Option<Circle>) {
        match self {
            Self::Neighbours => ("E_N", "one step or none", None),
            Self::Safe => ("E_S", "wholly within r_safe", Some(Circle::SAFE)),
            Self::Covered => ("E_C", "wholly within r_cov", Some(Circle::COVERED)),
        }
    }

    /// Its symbol in the paper.
    pub const fn symbol(self) -> &'static str {
        self.row().0
    }

    /// Its name in words.
    pub const fn words(self) -> &'static str {
        self.row().1
    }

    /// The radius of that circle in sides of a cell.
    pub fn radius(self) -> Option<f64> {
        match self {
            Self::Neighbours => None,
            Self::Safe => Some(1.5 * 2_f64.sqrt()),
            Self::Covered => Some(26_f64.sqrt() / 2.0),
        }
    }

    /// Columns and rows from the centre to its cells, row by row.
    pub fn offsets(self) -> impl Iterator<Item = Cell> {
        let centre = Cell::new(0, 0);
        let square = (-REACH..=REACH).flat_map(|y| (-REACH..=REACH).map(move |x| Cell::new(x, y)));
        square.filter(move |&cell| self.has(centre, cell))
    }

    /// Whether `cell` is in it.
    pub fn has(self, centre: Cell, cell: Cell) -> bool {
        self.row().2.map_or_else(|| neighbours(centre, cell), |circle| circle.covers(centre, cell))
    }
}

/// Cells shown on each side of the centre of an environment.
const REACH: i16 = 3;

/// The three environments of the cell R.
pub fn environments() -> String {
    let centre = Cell::new(0, 0);
    let blocks = Environment::ALL.map(|environment| {
        let symbol = |cell| match (cell == centre, environment.has(centre, cell)) {
            (true, _) => "R",
            (false, true) => "#",
            (false, false) => "·",
        };
        let rows = (-REACH..=REACH).map(|y| {
            let row: Vec<&str> = (-REACH..=REACH).map(|x| symbol(Cell::new(x, y))).collect();
            row.join(" ")
        });
        Block { title: format!("{}, {}", environment.symbol(), environment.words()), lines: rows.collect() }
    });
    beside(blocks.into())
}

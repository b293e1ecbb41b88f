//! A case is shrunk by its parts, whoever wrote its team.

use std::ops::Range;

use schemars::JsonSchema;
use serde::Serialize;
use tautline_io::diagnostic::{Diagnostic, Halt};
use tautline_kernel::ground::{Area, Cell, Edge, Side};

use tautline_grids::layout::Layout;

/// How large a run is.
#[derive(Clone, Copy, PartialEq, Eq, Debug, JsonSchema, Serialize)]
pub struct Extent {
    /// Robots, the base counted.
    pub robots: u16,
    /// Columns of the layout.
    pub columns: i16,
    /// Rows of the layout.
    pub rows: i16,
    /// Walls inside the rim.
    pub walls: usize,
    /// Blocked cells.
    pub blocked: usize,
    /// Missed sensors, of those that are named.
    #[serde(default, skip_serializing_if = "is_none")]
    pub missed: usize,
    /// Team moves up to the one that breaks the clause.
    pub steps: u32,
}

/// Whether there are none, as in all runs of robots without sensors.
#[expect(clippy::trivially_copy_pass_by_ref, reason = "serde passes what it writes so")]
const fn is_none(count: &usize) -> bool {
    *count == 0
}

impl Extent {
    pub(super) fn new(robots: u16, layout: &Layout, missed: usize, steps: u32) -> Self {
        Self {
            robots,
            columns: layout.width(),
            rows: layout.height(),
            walls: layout.walls().count(),
            blocked: layout.size().cells() - layout.free_cells(),
            missed,
            steps,
        }
    }
}

/// How far the work is.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Progress {
    /// Runs so far.
    pub runs: u32,
    /// The smallest of them that breaks the clause.
    pub smallest: Extent,
}

/// A part of a run that can go, or become smaller.
#[derive(Clone, Debug)]
pub struct Case {
    /// Robots, the base counted.
    pub robots: u16,
    /// The layout, with the base if there is one.
    pub layout: Layout,
    /// Where the robots start.
    pub base: Cell,
    /// Where each robot starts, if that is said of each.
    pub starts: Vec<Cell>,
    /// The sensors that are missed, by their numbers among all that are asked about.
    pub missed: Vec<u32>,
}

/// A run that breaks the clause.
#[derive(Clone, Debug)]
pub struct BrokenClause {
    /// Team moves up to the one that breaks it.
    pub steps: u32,
    /// The edges and cells that the run met; where nothing else makes a difference to it, all the rest can go at once.
    pub met: Option<Obstacles>,
}

/// The edges and cells that a run met.
#[derive(Clone, Debug)]
pub struct Obstacles {
    /// The cells in the team's reach.
    pub area: Area,
    /// The edges at which robots stood before a wall or a blocked cell.
    pub edges: Vec<Edge>,
}

/// Makes the run of a case, and says whether it breaks the clause; it is told how far the work is.
pub type Breaks<'a> = dyn FnMut(&Case, Progress) -> Result<Option<BrokenClause>, Halt> + 'a;

/// The result of the work.
#[derive(Clone, Debug)]
pub struct Shrinkage {
    /// The smallest case: without any one robot, column, row, blocked cell or wall of it the clause is not broken.
    pub case: Case,
    /// How large it is.
    pub extent: Extent,
    /// Runs that were made to find it.
    pub runs: u32,
}

/// Shrinks `case`, which breaks a clause in team move number `steps`, as far as `breaks` says that the clause is still
/// broken. A team has at least `least` robots. Any team can be shrunk so, of this program or not.
///
/// # Errors
/// [`Halt`] if `breaks` ended the work.
pub fn shrink(case: Case, steps: u32, least: u16, breaks: &mut Breaks<'_>) -> Result<Shrinkage, Halt> {
    let extent = Extent::new(case.robots, &case.layout, case.missed.len(), steps);
    let progress = Progress { runs: 0, smallest: extent };
    let mut shrinker = Shrinker { smallest: case, progress, breaks };
    shrinker.attempt(&shrinker.smallest.clone())?;
    loop {
        let last = shrinker.progress.smallest;
        shrinker.dismiss_robots(least)?;
        for part in Part::ALL {
            shrinker.thin(part)?;
        }
        if shrinker.progress.smallest == last {
            break;
        }
    }
    let Shrinker { smallest: case, progress: Progress { runs, smallest: extent }, breaks: _ } = shrinker;
    Ok(Shrinkage { case, extent, runs })
}

/// Of what a layout is made that can go, in the order in which it is tried.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Part {
    Columns,
    Rows,
    Blocked,
    Walls,
    Missed,
}

impl Part {
    const ALL: [Self; 5] = [Self::Columns, Self::Rows, Self::Blocked, Self::Walls, Self::Missed];

    /// How many there are.
    fn count(self, extent: &Extent) -> usize {
        match self {
            Self::Columns => extent.columns as usize,
            Self::Rows => extent.rows as usize,
            Self::Blocked => extent.blocked,
            Self::Walls => extent.walls,
            Self::Missed => extent.missed,
        }
    }

    /// The cases that `case` can become without those in `range`, the first choice first.
    fn without(self, case: &Case, range: &Range<usize>) -> Result<Vec<Case>, Diagnostic> {
        let whole = &case.layout;
        let (mut layout, columns, rows) = (whole.clone(), whole.width(), whole.height());
        match self {
            Self::Columns => return with_lines(case, &outside(range, columns), &outside(&(0..0), rows)),
            Self::Rows => return with_lines(case, &outside(&(0..0), columns), &outside(range, rows)),
            Self::Blocked => {
                let blocked = whole.cells().filter(|&cell| !whole.is_free(cell));
                blocked.skip(range.start).take(range.len()).for_each(|cell| layout.unblock(cell));
            }
            Self::Walls => {
                let walls = whole.walls().skip(range.start).take(range.len());
                walls.for_each(|wall| layout.remove_wall(wall));
            }
            Self::Missed => {
                let mut missed = case.missed.clone();
                missed.drain(range.start..range.end.min(case.missed.len()));
                return Ok(vec![Case { missed, ..case.clone() }]);
            }
        }
        Ok(vec![Case { layout, ..case.clone() }])
    }
}

/// The lines below `count` that are not in `range`.
fn outside(range: &Range<usize>, count: i16) -> Vec<i16> {
    (0..count).filter(|&line| !range.contains(&(line as usize))).collect()
}

/// The cases that `case` can become with only these columns and rows: one for each place that the base can have.
fn with_lines(case: &Case, columns: &[i16], rows: &[i16]) -> Result<Vec<Case>, Diagnostic> {
    if columns.is_empty() || rows.is_empty() {
        return Ok(Vec::new());
    }
    let whole = &case.layout;
    let mut layout = Layout::open(columns.len() as u64, rows.len() as u64)?;
    for (y, &row) in (0..).zip(rows) {
        for (x, &column) in (0..).zip(columns) {
            let cell = Cell::new(x, y);
            if !whole.is_free(Cell::new(column, row)) {
                layout.block(cell);
            }
            let next_column = columns.get(x as usize + 1).copied().unwrap_or(column);
            if (column..next_column).any(|x| whole.has_wall(Edge::new(Cell::new(x, row), Side::East))) {
                layout.build_wall(Edge::new(cell, Side::East));
            }
            let next_row = rows.get(y as usize + 1).copied().unwrap_or(row);
            if (row..next_row).any(|y| whole.has_wall(Edge::new(Cell::new(column, y), Side::South))) {
                layout.build_wall(Edge::new(cell, Side::South));
            }
        }
    }
    let start =
        |&start: &Cell| Some(Cell::new(places(columns, start.x).next()?, places(rows, start.y).next()?));
    let starts: Vec<Cell> = case.starts.iter().filter_map(start).collect();
    let mut cases = Vec::new();
    for y in places(rows, case.base.y) {
        for x in places(columns, case.base.x) {
            let base = Cell::new(x, y);
            if layout.is_free(base) {
                let mut layout = layout.clone();
                layout.place_base(base)?;
                cases.push(Case { layout, base, starts: starts.clone(), ..case.clone() });
            }
        }
    }
    Ok(cases)
}

/// Where among the lines that are left `line` is: its own place, or, if it went, those of the next line after it and
/// of the last one before it.
fn places(left: &[i16], line: i16) -> impl Iterator<Item = i16> {
    let next = left.partition_point(|&other| other < line);
    let went = left.get(next) != Some(&line);
    let last = next.checked_sub(1).filter(|_| went);
    [Some(next).filter(|&next| next < left.len()), last].into_iter().flatten().map(|place| place as i16)
}

/// `case` with nothing but what was met.
fn cut_down(case: &Case, Obstacles { area, edges }: &Obstacles) -> Result<Case, Diagnostic> {
    let whole = &case.layout;
    let origin = area.first();
    let shifted = |cell: Cell| Cell::new(cell.x - origin.x, cell.y - origin.y);
    let mut layout = Layout::open(area.width() as u64, area.height() as u64)?;
    for edge in edges {
        let (cell, side) = (edge.cell(), edge.side());
        for cell in [cell, cell.beyond(side)] {
            if !whole.is_free(cell) {
                layout.block(shifted(cell));
            }
        }
        if whole.has_wall(*edge) {
            layout.build_wall(Edge::new(shifted(cell), side));
        }
    }
    let base = shifted(case.base);
    layout.place_base(base)?;
    let starts = case.starts.iter().copied().map(shifted).collect();
    Ok(Case { layout, base, starts, ..case.clone() })
}

/// The work under way.
struct Shrinker<'a, 'b> {
    /// The smallest case so far.
    smallest: Case,
    progress: Progress,
    breaks: &'a mut Breaks<'b>,
}

impl Shrinker<'_, '_> {
    /// Makes the smallest team that breaks the clause in this layout the team;
    /// robots with starts of their own go one by one.
    fn dismiss_robots(&mut self, least: u16) -> Result<(), Halt> {
        if self.smallest.starts.is_empty() {
            for robots in least..self.smallest.robots {
                if self.attempt(&Case { robots, ..self.smallest.clone() })? {
                    break;
                }
            }
            return Ok(());
        }
        let mut robot = self.smallest.starts.len();
        while robot > 0 && self.smallest.robots > least {
            robot -= 1;
            let mut starts = self.smallest.starts.clone();
            starts.remove(robot);
            let base = starts.first().copied().unwrap_or(self.smallest.base);
            let mut layout = self.smallest.layout.clone();
            layout.place_base(base)?;
            let robots = self.smallest.robots - 1;
            self.attempt(&Case { robots, layout, base, starts, ..self.smallest.clone() })?;
        }
        Ok(())
    }

    /// Leaves out what it can of `part`, in ever smaller chunks.
    fn thin(&mut self, part: Part) -> Result<(), Halt> {
        let mut chunk = part.count(&self.progress.smallest);
        while chunk > 0 {
            let mut start = 0;
            while start < part.count(&self.progress.smallest) {
                let range = start..start + chunk;
                if !self.leave_out(part, &range)? {
                    start = range.end;
                }
            }
            chunk /= 2;
        }
        Ok(())
    }

    /// Leaves out those of `part` in `range`; whether the clause is broken without them.
    fn leave_out(&mut self, part: Part, range: &Range<usize>) -> Result<bool, Halt> {
        for candidate in part.without(&self.smallest, range)? {
            if self.attempt(&candidate)? {
                return Ok(true);
            }
        }
        Ok(false)
    }

    /// Runs `candidate` and, if it breaks the clause, makes it the smallest case, or what it met if that breaks the
    /// clause, too. Whether it does.
    fn attempt(&mut self, candidate: &Case) -> Result<bool, Halt> {
        let Some(BrokenClause { mut steps, met }) = self.run(candidate)? else { return Ok(false) };
        self.smallest = candidate.clone();
        if let Some(met) = met {
            let cut = cut_down(candidate, &met)?;
            if cut.layout != candidate.layout
                && let Some(again) = self.run(&cut)?
            {
                (self.smallest, steps) = (cut, again.steps);
            }
        }
        let Case { robots, layout, missed, .. } = &self.smallest;
        self.progress.smallest = Extent::new(*robots, layout, missed.len(), steps);
        Ok(true)
    }

    fn run(&mut self, case: &Case) -> Result<Option<BrokenClause>, Halt> {
        self.progress.runs += 1;
        (self.breaks)(case, self.progress)
    }
}

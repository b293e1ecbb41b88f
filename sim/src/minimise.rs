//! From a run that breaks a clause to a minimal one: a run of the same scheme and rule that breaks the same clause, in
//! a layout of which nothing can go. Taken alone, without any one of its robots, columns, rows, blocked cells and
//! walls, the clause is not broken.
//!
//! What it is that goes:
//! - *A robot*: the team has one less. A chain then has a shorter range, too.
//! - *A column*: its cells, blocked or free, and the columns on its two sides become neighbours. Between two cells
//!   that were on its two sides stands a wall if one stood on either side of the cell that was between them. The
//!   rim closes up to the first or last column that is left. A base in the column that goes is put into the next cell
//!   east of it or, if there is none, or it is blocked, or the clause is not broken from there, into the next one
//!   west of it. A layout keeps at least one column.
//! - *A row*: likewise, south for east and north for west.
//! - *A blocked cell*: it is free then. Walls beside it stay.
//! - *A wall* inside the rim.
//!
//! What a run never met goes all at once, before anything else and after everything that goes: the cells out of the
//! team's reach, and the walls and blocked cells that no robot bumped into. The run is the same without. Then the
//! robots are tried, the smallest team first, and columns, rows, blocked cells and walls in this order: all, then in
//! chunks half as large each time (Zeller and Hildebrandt 2002, *Simplifying and Isolating Failure-Inducing Input*),
//! then single ones; all this until nothing goes any more. There is no chance in it.

use std::collections::BTreeSet;
use std::fmt;
use std::ops::Range;

use serde::Serialize;
use tautline_kernel::ground::{Area, Cell, Edge, Side};
use tautline_proofs::chain::breach::Breach;

use crate::explore::{Crew, Limits, OnViolation, Report, Setup, Violation, explore};
use crate::fault::{Fault, Halt};
use crate::layout::{Layout, Problem};

/// A run in which nothing can go.
#[derive(Clone, Debug)]
pub struct Minimal {
    /// What makes it. The run stops at the team move that breaks the clause; another clause may be broken before.
    pub setup: Setup,
    /// What its last team move breaks.
    pub breach: Breach,
    /// How large the run was that it is made from.
    pub before: Extent,
    /// How large it is.
    pub after: Extent,
    /// Runs that were made to find it.
    pub runs: u32,
}

/// How large a run is.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize)]
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
    /// Team moves up to the one that breaks the clause.
    pub steps: u32,
}

impl Extent {
    fn new(setup: &Setup, steps: u32) -> Self {
        let layout = &setup.layout;
        Self {
            robots: setup.robots,
            columns: layout.width(),
            rows: layout.height(),
            walls: layout.walls().count(),
            blocked: layout.size().cells() - layout.free_cells(),
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

/// Why there is nothing to minimise.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Refused {
    /// The run breaks no clause.
    Unbroken,
    /// The run is not that of a chain: what agents never met, their sensors may still have seen.
    OfAgents,
    /// The run breaks other clauses than the one asked for.
    Otherwise {
        /// What was asked for.
        asked: Breach,
        /// What is broken.
        broken: Vec<Breach>,
    },
}

impl Refused {
    /// What would be right.
    pub fn remedy(&self) -> String {
        match self {
            Self::Unbroken => "name a counterexample of `tautline hunt`, or a trace of a run that ended \
                               `tautline explore` with exit code 1"
                .to_owned(),
            Self::OfAgents => "name a run of the scheme chain".to_owned(),
            Self::Otherwise { broken, .. } => {
                let broken: Vec<&str> = broken.iter().map(|breach| breach.clause()).collect();
                format!("it breaks {}", broken.join(", "))
            }
        }
    }
}

impl fmt::Display for Refused {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Unbroken => f.write_str("this run breaks no clause: there is nothing to minimise"),
            Self::OfAgents => f.write_str("this is a run of agents: they are not minimised"),
            Self::Otherwise { asked, .. } => {
                write!(f, "this run does not break {}: there is nothing to minimise", asked.clause())
            }
        }
    }
}

impl std::error::Error for Refused {}

/// Why nothing was minimised.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Failure {
    /// There is nothing to minimise.
    Refused(Refused),
    /// The work was ended.
    Halted(Halt),
}

impl From<Refused> for Failure {
    fn from(refused: Refused) -> Self {
        Self::Refused(refused)
    }
}

impl From<Halt> for Failure {
    fn from(halt: Halt) -> Self {
        Self::Halted(halt)
    }
}

/// The minimal run that the run of `setup` shrinks to; what stays broken is `asked`, or else what the run breaks first.
/// `watch` is called after every team move of every run, and may end the work for good.
///
/// # Errors
/// [`Failure`] if the run does not break that, if the setup does not fit its scheme, or if `watch` ended the work.
pub fn minimise(
    setup: &Setup,
    asked: Option<Breach>,
    watch: &mut dyn FnMut(Progress) -> Result<(), Halt>,
) -> Result<Minimal, Failure> {
    match setup.crew() {
        Crew::Chain => {}
        Crew::Agents(_) => return Err(Refused::OfAgents.into()),
    }
    let mut before = Extent::new(setup, 0);
    let violation = match (setup.limits.violation, asked) {
        (OnViolation::GoOn, Some(asked)) => OnViolation::StopAt(asked),
        (OnViolation::GoOn, None) => OnViolation::Stop,
        (stop @ (OnViolation::Stop | OnViolation::StopAt(_)), _) => stop,
    };
    let first = Setup { limits: Limits { violation, ..setup.limits }, ..setup.clone() };
    let report = explore(&first, &mut |_| watch(Progress { runs: 0, smallest: before }))?;
    let Violation { breach, step } = first_violation(&report, asked)?;
    before.steps = step;
    let limits = Limits { violation: OnViolation::StopAt(breach), ..Limits::default() };
    let smallest = Setup { limits, ..first };
    let mut shrinking = Shrinking { smallest, progress: Progress { runs: 0, smallest: before }, watch };
    shrinking.attempt(&shrinking.smallest.clone())?;
    loop {
        let last = shrinking.progress.smallest;
        shrinking.dismiss_robots()?;
        for part in Part::ALL {
            shrinking.thin(part)?;
        }
        if shrinking.progress.smallest == last {
            break;
        }
    }
    let Shrinking { smallest: setup, progress: Progress { runs, smallest: after }, watch: _ } = shrinking;
    Ok(Minimal { setup, breach, before, after, runs })
}

/// The first violation of what is `asked`, if something is.
fn first_violation(report: &Report, asked: Option<Breach>) -> Result<Violation, Refused> {
    let mut violations = report.violations.iter();
    let found = violations.find(|violation| asked.is_none_or(|asked| violation.breach == asked));
    found.copied().ok_or_else(|| match asked {
        Some(asked) if !report.violations.is_empty() => {
            let broken: BTreeSet<Breach> =
                report.violations.iter().map(|violation| violation.breach).collect();
            Refused::Otherwise { asked, broken: broken.into_iter().collect() }
        }
        Some(_) | None => Refused::Unbroken,
    })
}

/// Of what a layout is made that can go, in the order in which it is tried.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Part {
    Columns,
    Rows,
    Blocked,
    Walls,
}

impl Part {
    const ALL: [Self; 4] = [Self::Columns, Self::Rows, Self::Blocked, Self::Walls];

    /// How many there are.
    fn count(self, extent: &Extent) -> usize {
        match self {
            Self::Columns => extent.columns as usize,
            Self::Rows => extent.rows as usize,
            Self::Blocked => extent.blocked,
            Self::Walls => extent.walls,
        }
    }

    /// What `setup` can become without those in `range`, the first choice first.
    fn without(self, setup: &Setup, range: &Range<usize>) -> Result<Vec<Setup>, Problem> {
        let whole = &setup.layout;
        let mut layout = whole.clone();
        match self {
            Self::Columns => {
                return with_lines(setup, &outside(range, whole.width()), &outside(&(0..0), whole.height()));
            }
            Self::Rows => {
                return with_lines(setup, &outside(&(0..0), whole.width()), &outside(range, whole.height()));
            }
            Self::Blocked => {
                let blocked = whole.cells().filter(|&cell| !whole.is_free(cell));
                blocked.skip(range.start).take(range.len()).for_each(|cell| layout.unblock(cell));
            }
            Self::Walls => {
                let walls = whole.walls().skip(range.start).take(range.len());
                walls.for_each(|wall| layout.remove_wall(wall));
            }
        }
        Ok(vec![Setup { layout, ..setup.clone() }])
    }
}

/// The lines below `count` that are not in `range`.
fn outside(range: &Range<usize>, count: i16) -> Vec<i16> {
    (0..count).filter(|&line| !range.contains(&(line as usize))).collect()
}

/// What `setup` can become with only these columns and rows: one for each place that the base can have.
fn with_lines(setup: &Setup, columns: &[i16], rows: &[i16]) -> Result<Vec<Setup>, Problem> {
    if columns.is_empty() || rows.is_empty() {
        return Ok(Vec::new());
    }
    let whole = &setup.layout;
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
    let mut setups = Vec::new();
    for y in places(rows, setup.base.y) {
        for x in places(columns, setup.base.x) {
            let base = Cell::new(x, y);
            if layout.is_free(base) {
                let mut layout = layout.clone();
                layout.place_base(base)?;
                setups.push(Setup { layout, base, ..setup.clone() });
            }
        }
    }
    Ok(setups)
}

/// Where among the lines that are left `line` is: its own place, or, if it went, those of the next line after it and
/// of the last one before it.
fn places(left: &[i16], line: i16) -> impl Iterator<Item = i16> {
    let next = left.partition_point(|&other| other < line);
    let went = left.get(next) != Some(&line);
    let last = next.checked_sub(1).filter(|_| went);
    [Some(next).filter(|&next| next < left.len()), last].into_iter().flatten().map(|place| place as i16)
}

/// `setup` with nothing but the cells of `area`, and what was met at the edges in `met`.
fn cut_down(setup: &Setup, area: Area, met: &[Edge]) -> Result<Setup, Problem> {
    let whole = &setup.layout;
    let origin = area.first();
    let shifted = |cell: Cell| Cell::new(cell.x - origin.x, cell.y - origin.y);
    let mut layout = Layout::open(area.width() as u64, area.height() as u64)?;
    for edge in met {
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
    let base = shifted(setup.base);
    layout.place_base(base)?;
    Ok(Setup { layout, base, ..setup.clone() })
}

/// The work under way.
struct Shrinking<'a> {
    /// The smallest run so far.
    smallest: Setup,
    progress: Progress,
    watch: &'a mut dyn FnMut(Progress) -> Result<(), Halt>,
}

impl Shrinking<'_> {
    /// Makes the smallest team that breaks the clause in this layout the team.
    fn dismiss_robots(&mut self) -> Result<(), Halt> {
        for robots in 2..self.smallest.robots {
            if self.attempt(&Setup { robots, ..self.smallest.clone() })? {
                break;
            }
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
        for candidate in part.without(&self.smallest, range).map_err(|problem| fault(&problem))? {
            if self.attempt(&candidate)? {
                return Ok(true);
            }
        }
        Ok(false)
    }

    /// Runs `candidate` and, if it breaks the clause, makes what it met the smallest run. Whether it does.
    fn attempt(&mut self, candidate: &Setup) -> Result<bool, Halt> {
        self.progress.runs += 1;
        let mut met = Vec::new();
        let report = explore(candidate, &mut |made| {
            met.extend(made.frame.bumps());
            (self.watch)(self.progress)
        })?;
        let violation = candidate.limits.violation;
        if !report.violations.iter().any(|broken| violation.is_final(broken.breach)) {
            return Ok(false);
        }
        self.smallest = cut_down(candidate, report.chart.area(), &met).map_err(|problem| fault(&problem))?;
        self.progress.smallest = Extent::new(&self.smallest, report.steps);
        Ok(true)
    }
}

/// No part of a layout is too large for one.
fn fault(problem: &Problem) -> Fault {
    Fault::usage(problem, problem.remedy())
}

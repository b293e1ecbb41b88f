//! Our own drawing of a layout: read and written, and the same to the byte after both. A first line with the
//! version, `robots N` if the layout says so, then the area: corners `+`, walls `--` and `|`, and two
//! characters for each cell: two spaces free, `##` blocked, `B` and a space the base. The rim is drawn and
//! closed. `\r\n`, blank lines at the end and a missing last newline are read, never written.
//!
//! ```text
//! tautline layout 1
//! robots 4
//! +--+--+--+
//! |     |  |
//! +  +--+  +
//! |   B  ##|
//! +--+--+--+
//! ```

use std::fmt;
use std::str::FromStr;

use tautline_io::diagnostic::Diagnostic;
use tautline_kernel::ground::{Cell, Edge, Side};

use super::file::{Line, Misread, end, lines};
use super::{Layout, MAX_SIDE_CELLS, robots_of};

const MAGIC: &str = "tautline layout ";
const VERSION: u32 = 1;

const FREE: &str = "  ";
const BLOCKED: &str = "##";
const BASE: &str = "B ";

const CORNERS: &str =
    "a line between two rows is made of `+` corners, each followed by `--` (a wall) or two spaces";
const CELLS: &str = "a cell is two spaces (free), `##` (blocked) or `B` and a space (the base); \
                     before each cell, and at the end of the row, stands `|` (a wall) or a space";

/// Reads a drawing.
///
/// # Errors
/// The first [`Diagnostic`] from the top and the bytes it lies in: another version, an unknown symbol, rows of
/// unequal length, an open rim, a drawing cut short, a second base, or no free cell.
pub fn read(source: &str) -> Result<Layout, Misread> {
    let cut = || Misread { at: end(source), problem: cut_short() };
    let mut lines = lines(source);
    check_version(&lines.next().ok_or_else(cut)?)?;
    let second = lines.next().ok_or_else(cut)?;
    let robots = second.text.strip_prefix("robots ").map(|count| {
        let at = second.text.len() - count.len()..second.text.len();
        robots_of(count).map_err(|problem| second.misread_at(at, problem))
    });
    let robots = robots.transpose()?;
    let rim = if robots.is_some() { lines.next().ok_or_else(cut)? } else { second };
    let rows: Vec<Line<'_>> = lines.take(2 * (MAX_SIDE_CELLS as usize + 1)).collect();

    let width = rim.text.len().saturating_sub(1) / 3;
    if width == 0 || rim.text != format!("+{}", "--+".repeat(width)) {
        let remedy = "draw it as `+--+--+`, one `--` for each column";
        return Err(rim.misread(Diagnostic::usage("the northern rim should be drawn here", remedy)));
    }
    let pairs = rows.chunks_exact(2);
    if rows.is_empty() || !pairs.remainder().is_empty() {
        return Err(cut());
    }
    let mut layout =
        Layout::open(width as u64, pairs.len() as u64).map_err(|problem| rim.misread(problem))?;
    let last = layout.height() - 1;
    for (y, pair) in (0..).zip(pairs) {
        if let [cells, below] = pair {
            read_cells(cells, y, &mut layout)?;
            read_walls_below(below, y, if y == last { Below::Rim } else { Below::Row }, &mut layout)?;
        }
    }
    layout.robots = robots;
    layout.with_free_cell().map_err(|problem| rim.misread(problem))
}

/// The drawing ends too early.
fn cut_short() -> Diagnostic {
    let remedy = "a drawing is a line of walls, then for each row a line of cells and a line of walls";
    Diagnostic::usage("the drawing ends before its southern rim", remedy)
}

fn open_rim() -> Diagnostic {
    Diagnostic::usage("the rim has a gap", "close it: `--` in the north and south, `|` in the east and west")
}

/// The line that lies south of a row.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Below {
    Row,
    Rim,
}

fn check_version(line: &Line<'_>) -> Result<(), Misread> {
    let version = line.text.strip_prefix(MAGIC).and_then(|version| version.parse::<u32>().ok());
    match version {
        Some(VERSION) => Ok(()),
        Some(other) => {
            let what = format!("this is version {other}, this program reads version 1");
            let problem = Diagnostic::usage(what, "write the drawing again with this program");
            Err(line.misread_at(MAGIC.len()..line.text.len(), problem))
        }
        None => Err(line.misread(Diagnostic::usage(
            "this is not the first line of a layout",
            "a drawing begins with `tautline layout 1`; name MovingAI maps .map and ROS maps .yaml",
        ))),
    }
}

/// The row `y` of cells, with the walls between them.
fn read_cells(line: &Line<'_>, y: i16, layout: &mut Layout) -> Result<(), Misread> {
    let width = layout.width();
    line.check_length(3 * width as usize + 1)?;
    for x in 0..=width {
        let cell = Cell::new(x, y);
        let at = 3 * x as usize;
        match line.text.get(at..=at) {
            Some("|") => layout.build_wall(Edge::new(cell, Side::West)),
            Some(" ") if x == 0 || x == width => return Err(line.misread_at(at..at + 1, open_rim())),
            Some(" ") => {}
            Some(_) | None => return Err(line.unknown(at..at + 1, CELLS)),
        }
        if x == width {
            break;
        }
        let inside = at + 1..at + 3;
        match (line.text.get(inside.clone()), layout.base()) {
            (Some(FREE), _) => {}
            (Some(BLOCKED), _) => layout.block(cell),
            (Some(BASE), None) => layout.place_base(cell).map_err(|problem| line.misread(problem))?,
            (Some(BASE), Some(first)) => {
                let problem =
                    Diagnostic::usage(format!("a second base; the first is {first}"), "leave one of them");
                return Err(line.misread_at(inside, problem));
            }
            (Some(_) | None, _) => return Err(line.unknown(inside, CELLS)),
        }
    }
    Ok(())
}

/// The line south of the row `y` of cells.
fn read_walls_below(line: &Line<'_>, y: i16, below: Below, layout: &mut Layout) -> Result<(), Misread> {
    let width = layout.width();
    line.check_length(3 * width as usize + 1)?;
    for x in 0..=width {
        let at = 3 * x as usize;
        if line.text.get(at..=at) != Some("+") {
            return Err(line.unknown(at..at + 1, CORNERS));
        }
        if x == width {
            break;
        }
        let side = at + 1..at + 3;
        match (line.text.get(side.clone()), below) {
            (Some("--"), _) => layout.build_wall(Edge::new(Cell::new(x, y), Side::South)),
            (Some("  "), Below::Row) => {}
            (Some("  "), Below::Rim) => return Err(line.misread_at(side, open_rim())),
            (Some(_) | None, _) => return Err(line.unknown(side, CORNERS)),
        }
    }
    Ok(())
}

/// The drawing that [`read`] reads.
impl fmt::Display for Layout {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{MAGIC}{VERSION}")?;
        if let Some(robots) = self.robots() {
            writeln!(f, "robots {robots}")?;
        }
        for y in 0..self.height() {
            write_walls_above(self, y, f)?;
            for x in 0..self.width() {
                let cell = Cell::new(x, y);
                let wall = if self.has_wall(Edge::new(cell, Side::West)) { "|" } else { " " };
                let inside = match (self.is_free(cell), self.base()) {
                    (false, _) => BLOCKED,
                    (true, Some(base)) if base == cell => BASE,
                    (true, Some(_) | None) => FREE,
                };
                write!(f, "{wall}{inside}")?;
            }
            writeln!(f, "|")?;
        }
        write_walls_above(self, self.height(), f)
    }
}

impl fmt::Debug for Layout {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "\n{self}")
    }
}

impl FromStr for Layout {
    type Err = Misread;

    fn from_str(source: &str) -> Result<Self, Misread> {
        read(source)
    }
}

fn write_walls_above(layout: &Layout, y: i16, f: &mut fmt::Formatter<'_>) -> fmt::Result {
    for x in 0..layout.width() {
        let wall = layout.has_wall(Edge::new(Cell::new(x, y), Side::North));
        f.write_str(if wall { "+--" } else { "+  " })?;
    }
    writeln!(f, "+")
}

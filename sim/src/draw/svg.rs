//! Pictures as SVG, for light and dark pages: layouts, the environments of a cell, the order of exploration, team
//! moves. Every text is made of numbers and our own words, or escaped.

mod map;
mod moment;

use std::fmt::Write;
use std::ops::RangeInclusive;

use tautline_io::diagnostic::{Diagnostic, Halt};
use tautline_io::svg::{Panel, SERIES, SERIES_STYLE};
use tautline_kernel::floor::Mark;
use tautline_kernel::ground::{Area, Cell, Edge, Side, Step};

use super::{Environment, REACH, first_drawn};
use crate::explore::{Look, Play, Report, Setup, Survey, TeamMove};
use tautline_grids::layout::Layout;

pub use map::{known, map};
pub use moment::moment;

/// The side of a cell.
const CELL: i32 = 24;

/// Cells of an area that is drawn. What is larger no browser shows.
const MAX_CELLS: usize = 1 << 19;

/// Checks that `area` is not too large to be drawn.
///
/// # Errors
/// A [`Diagnostic`] of the command line.
pub fn check_size(area: Area) -> Result<(), Diagnostic> {
    let (columns, rows) = (area.width(), area.height());
    if columns * rows <= MAX_CELLS {
        return Ok(());
    }
    let what = format!("an area of {columns}x{rows} cells is too large to be drawn");
    let remedy = format_args!("leave out the picture and the page, or take at most {MAX_CELLS} cells");
    Err(Diagnostic::usage(what, remedy))
}

/// A drawing of `layout`, the base marked if it has one.
pub fn layout(layout: &Layout) -> Panel {
    let area = layout.size().area();
    let mut body = ground(layout, area);
    if let Some(base) = layout.base() {
        body.push_str(&base_mark(Frame(area), base));
    }
    panel(area, String::new(), body + &walls(layout, area))
}

/// The order of exploration.
pub fn order(run: &dyn Play, chart: &Survey) -> Panel {
    let Setup { layout, base, scheme, .. } = run.setup();
    let area = chart.area();
    let frame = Frame(area);
    let last = area.cells().filter_map(|cell| chart.step(cell)).max().unwrap_or(0).max(1);
    let mut body = ground(layout, area);
    for (cell, step) in area.cells().filter_map(|cell| chart.step(cell).map(|step| (cell, step))) {
        let (x, y) = frame.corner(cell);
        let (cx, cy) = frame.centre(cell);
        let percent = 8 + 50 * u64::from(step) / u64::from(last);
        let _ = write!(
            body,
            "<rect class=\"order\" x=\"{x}\" y=\"{y}\" width=\"{CELL}\" \
             height=\"{CELL}\" fill-opacity=\"0.{percent:02}\"/>"
        );
        if step > 0 {
            let _ = write!(body, "<text class=\"small\" x=\"{cx}\" y=\"{cy}\">{step}</text>");
        }
    }
    if scheme.look.has_base() {
        body.push_str(&base_mark(frame, *base));
    }
    let caption = format!("{}: when each cell was explored", run.setup().title());
    panel(area, caption, body + &walls(layout, area))
}

/// One team move: where the robots were, what they tried, where they are.
pub fn team_move(run: &dyn Play, chart: &Survey, made: &TeamMove<'_>) -> Panel {
    let area = chart.area();
    let frame = Frame(area);
    let Setup { layout, scheme, .. } = run.setup();
    let mut body = ground(layout, area);
    for cell in area.cells() {
        body.push_str(&marked_cell(frame, cell, chart.mark(cell, made.step)));
    }
    body.push_str(&walls(layout, area));
    body.push_str(&team(scheme.look, frame, made));
    panel(area, super::title(made), body)
}

/// Team moves that a picture can hold.
const MAX_PANELS: u32 = 200;

/// Checks that a picture can hold a panel for each of `moves`.
///
/// # Errors
/// A [`Diagnostic`] of the command line.
pub fn check_moves(moves: &RangeInclusive<u32>) -> Result<(), Diagnostic> {
    if moves.end().saturating_sub(*moves.start()) < MAX_PANELS {
        return Ok(());
    }
    let what = format!("a picture of more than {MAX_PANELS} team moves");
    let remedy = format_args!("store a trace, and draw at most {MAX_PANELS} with `tautline replay --moves`");
    Err(Diagnostic::usage(what, remedy))
}

/// Bytes of the panels that a picture can hold.
const MAX_PANEL_BYTES: usize = 64 << 20;

/// A picture of the team moves in `moves` of a run that came out as `report`, one panel each.
///
/// # Errors
/// [`Halt`] if they are too many or too large, or the run cannot be made.
pub fn team_moves(run: &dyn Play, report: &Report, moves: &RangeInclusive<u32>) -> Result<String, Halt> {
    check_moves(&(*moves.start()..=report.steps.min(*moves.end())))?;
    let (mut panels, mut bytes) = (Vec::new(), 0);
    run.among(moves, &mut |made| {
        let panel = team_move(run, &report.chart, made);
        bytes += panel.bytes();
        if bytes > MAX_PANEL_BYTES {
            let what = format!("a picture of more than {} MiB", MAX_PANEL_BYTES >> 20);
            return Err(Diagnostic::usage(what, "draw fewer team moves").into());
        }
        panels.push(panel);
        Ok(())
    })?;
    Ok(Panel::picture(&run.setup().title(), &panels))
}

/// The ways of robots from cell to cell, beside each other where they go the same way.
pub fn trajectories(layout: &Layout, area: Area, caption: &str, ways: &[Vec<Cell>]) -> Panel {
    let frame = Frame(area);
    let mut body = format!("<style>{SERIES_STYLE}</style>") + &ground(layout, area);
    for (robot, way) in (0_i32..).zip(ways) {
        let file = 2 * robot - ways.len() as i32 + 1;
        let points = way.iter().map(|&cell| frame.centre(cell)).fold(String::new(), |mut points, (x, y)| {
            let _ = write!(points, "{},{} ", x + file, y + file);
            points
        });
        let colour = robot as usize % SERIES;
        let dashes = if robot as usize >= SERIES { "stroke-dasharray:5 3;" } else { "" };
        let _ = write!(
            body,
            "<polyline points=\"{}\" style=\"fill:none;{dashes}stroke-width:1.5;stroke:var(--series-{colour})\"/>",
            points.trim_end()
        );
    }
    if let Some(base) = layout.base() {
        body.push_str(&base_mark(frame, base));
    }
    panel(area, caption.to_owned(), body + &walls(layout, area))
}

/// The three environments.
pub fn environments() -> Vec<Panel> {
    let centre = Cell::new(0, 0);
    let area = Area::new(Cell::new(-REACH, -REACH), Cell::new(REACH, REACH)).unwrap_or(Area::of(centre));
    let frame = Frame(area);
    Environment::ALL
        .map(|environment| {
            let mut body = lines(area);
            for cell in environment.offsets() {
                let (x, y) = frame.corner(cell);
                let _ = write!(
                    body,
                    "<rect class=\"member\" x=\"{x}\" y=\"{y}\" width=\"{CELL}\" height=\"{CELL}\"/>"
                );
            }
            let (x, y) = frame.centre(centre);
            if let Some(radius) = environment.radius() {
                let radius = radius * f64::from(CELL);
                let _ = write!(
                    body,
                    "<circle class=\"way\" fill=\"none\" cx=\"{x}\" cy=\"{y}\" r=\"{radius:.1}\"/>"
                );
            }
            let _ = write!(body, "<circle class=\"robot\" cx=\"{x}\" cy=\"{y}\" r=\"8\"/>");
            panel(area, format!("{}: {}", environment.symbol(), environment.words()), body)
        })
        .into()
}

fn panel(area: Area, caption: String, body: String) -> Panel {
    Panel::new(caption, (area.width() as i32 * CELL, area.height() as i32 * CELL), body)
}

/// Where the cells of an area are in its picture.
#[derive(Clone, Copy)]
struct Frame(Area);

impl Frame {
    fn corner(self, cell: Cell) -> (i32, i32) {
        let first = self.0.first();
        (CELL * (i32::from(cell.x) - i32::from(first.x)), CELL * (i32::from(cell.y) - i32::from(first.y)))
    }

    fn centre(self, cell: Cell) -> (i32, i32) {
        let (x, y) = self.corner(cell);
        (x + CELL / 2, y + CELL / 2)
    }
}

/// The lines between cells.
fn lines(area: Area) -> String {
    let (columns, rows) = (area.width() as i32, area.height() as i32);
    let mut path = String::new();
    for column in 0..=columns {
        let _ = write!(path, "M{} 0v{}", CELL * column, CELL * rows);
    }
    for row in 0..=rows {
        let _ = write!(path, "M0 {}h{}", CELL * row, CELL * columns);
    }
    format!("<path class=\"lines\" d=\"{path}\"/>")
}

/// The lines between cells, and the blocked cells.
fn ground(layout: &Layout, area: Area) -> String {
    lines(area) + &blocked(layout, area)
}

/// The blocked cells.
fn blocked(layout: &Layout, area: Area) -> String {
    let path = stripes(Frame(area), area.cells().filter(|&cell| !layout.is_free(cell)));
    if path.is_empty() { path } else { format!("<path class=\"blocked\" d=\"{path}\"/>") }
}

/// The outlines of `cells`, which come row by row; those beside each other have one.
fn stripes(frame: Frame, cells: impl IntoIterator<Item = Cell>) -> String {
    let mut path = String::new();
    let mut cells = cells.into_iter().peekable();
    while let Some(first) = cells.next() {
        let mut last = first;
        while let Some(next) = cells.next_if(|&cell| cell == last.beyond(Side::East)) {
            last = next;
        }
        let (x, y) = frame.corner(first);
        let width = frame.corner(last).0 - x + CELL;
        let _ = write!(path, "M{x} {y}h{width}v{CELL}h-{width}z");
    }
    path
}

/// The walls and the rim.
fn walls(layout: &Layout, area: Area) -> String {
    let frame = Frame(area);
    let (columns, rows) = (CELL * area.width() as i32, CELL * area.height() as i32);
    let mut path = format!("M0 0h{columns}v{rows}h-{columns}z");
    for edge in area.edges().filter(|&edge| layout.has_wall(edge)) {
        path.push_str(&side(frame, edge));
    }
    format!("<path class=\"walls\" d=\"{path}\"/>")
}

fn side(frame: Frame, edge: Edge) -> String {
    let (x, y) = frame.corner(edge.cell().beyond(edge.side()));
    match edge.side() {
        Side::East | Side::West => format!("M{x} {y}v{CELL}"),
        Side::South | Side::North => format!("M{x} {y}h{CELL}"),
    }
}

/// The class of cells with a mark, unless they are unexplored.
const fn class(mark: Mark) -> Option<&'static str> {
    match mark {
        Mark::Unexplored => None,
        Mark::Explored => Some("explored"),
        Mark::Closing => Some("closing"),
        Mark::Visited => Some("visited"),
        Mark::Sealed => Some("sealed"),
    }
}

/// A cell with its mark; nothing if it is unexplored.
fn marked_cell(frame: Frame, cell: Cell, mark: Mark) -> String {
    let Some(class) = class(mark) else { return String::new() };
    let (x, y) = frame.corner(cell);
    let inner = CELL - 1;
    format!("<rect class=\"{class}\" x=\"{x}.5\" y=\"{y}.5\" width=\"{inner}\" height=\"{inner}\"/>")
}

/// A frame inside a cell of which something was missed: its sensor, or the cell as a whole.
fn unseen(frame: Frame, cell: Cell) -> String {
    let (x, y) = frame.corner(cell);
    let inner = CELL - 6;
    format!("<rect class=\"unseen\" x=\"{}\" y=\"{}\" width=\"{inner}\" height=\"{inner}\"/>", x + 3, y + 3)
}

fn base_mark(frame: Frame, base: Cell) -> String {
    base_frame(frame, base) + &name(frame.centre(base), "B")
}

fn base_frame(frame: Frame, base: Cell) -> String {
    let (x, y) = frame.corner(base);
    format!("<rect class=\"base\" x=\"{}\" y=\"{}\" width=\"16\" height=\"16\" rx=\"3\"/>", x + 4, y + 4)
}

/// The base, with the number of the robots in its cell if they would hide it.
fn base_with(frame: Frame, team: &[Cell]) -> String {
    let (x, y) = frame.centre(team[0]);
    match team.iter().filter(|&&cell| cell == team[0]).count() - 1 {
        0..=BESIDE_BASE => base_mark(frame, team[0]),
        others => {
            base_frame(frame, team[0]) + &name((x, y - 4), "B") + &name((x, y + 4), &format!("+{others}"))
        }
    }
}

fn name((x, y): (i32, i32), text: &str) -> String {
    format!("<text class=\"name\" x=\"{x}\" y=\"{y}\">{text}</text>")
}

/// The links and the base of a team that has them, the ways of the robots and the robots.
fn team(look: Look, frame: Frame, made: &TeamMove<'_>) -> String {
    let (before, after) = (made.before, made.frame.cells.as_slice());
    let mut body: String = made.unseen.iter().map(|&cell| unseen(frame, cell)).collect();
    body += &match look {
        Look::Linked { is_lost } => links(frame, is_lost, before, after) + &base_with(frame, after),
        Look::Tree { is_linked } => tree(frame, is_linked, after) + &base_with(frame, after),
        Look::Apart | Look::Robots | Look::Own => String::new(),
    };
    for (robot, &from) in before.iter().enumerate().skip(first_drawn(look)) {
        if let Step::Cross(side) = made.frame.steps[robot] {
            body.push_str(&way(frame, from, side, made.frame.blocked[robot]));
        }
    }
    for robot in first_drawn(look)..after.len() {
        body.push_str(&self::robot(look, frame, after, robot));
    }
    body
}

fn links(frame: Frame, is_lost: fn(&[Cell], &[Cell]) -> bool, before: &[Cell], after: &[Cell]) -> String {
    let mut body = String::new();
    for (from, to) in before.windows(2).zip(after.windows(2)) {
        let class = if is_lost(from, to) { "broken" } else { "link" };
        let ((x, y), (to_x, to_y)) = (frame.centre(to[0]), frame.centre(to[1]));
        if (x, y) != (to_x, to_y) {
            let _ = write!(body, "<path class=\"{class}\" d=\"M{x} {y}L{to_x} {to_y}\"/>");
        }
    }
    body
}

/// A tree of links from the base to all robots that links join to it, by the fewest links.
fn tree(frame: Frame, is_linked: fn(Cell, Cell) -> bool, team: &[Cell]) -> String {
    let mut body = String::new();
    let (mut joined, mut rest) = (team[..1].to_vec(), team[1..].to_vec());
    let mut place = 0;
    while let Some(&from) = joined.get(place) {
        let (near, far): (Vec<Cell>, Vec<Cell>) = rest.into_iter().partition(|&cell| is_linked(from, cell));
        let (x, y) = frame.centre(from);
        for &cell in near.iter().filter(|&&cell| cell != from) {
            let (to_x, to_y) = frame.centre(cell);
            let _ = write!(body, "<path class=\"link\" d=\"M{x} {y}L{to_x} {to_y}\"/>");
        }
        joined.extend(near);
        rest = far;
        place += 1;
    }
    body
}

/// The arrow of a robot that crosses `side`, or the bump of one that could not.
fn way(frame: Frame, from: Cell, side: Side, is_blocked: bool) -> String {
    let (x, y) = frame.centre(from);
    let (dx, dy) = match side {
        Side::East => (1, 0),
        Side::South => (0, 1),
        Side::West => (-1, 0),
        Side::North => (0, -1),
    };
    let half = CELL / 2;
    let (edge_x, edge_y) = (x + half * dx, y + half * dy);
    if is_blocked {
        let (across_x, across_y) = (half * dy, half * dx);
        return format!(
            "<path class=\"way\" d=\"M{x} {y}L{edge_x} {edge_y}\"/><path class=\"bump\" d=\"M{} {}L{} {}\"/>",
            edge_x - across_x,
            edge_y - across_y,
            edge_x + across_x,
            edge_y + across_y
        );
    }
    // The tip is where the circle of the robot begins.
    let (tip_x, tip_y) = (edge_x + 3 * dx, edge_y + 3 * dy);
    let (foot_x, foot_y) = (edge_x - 2 * dx, edge_y - 2 * dy);
    format!(
        "<path class=\"way\" d=\"M{x} {y}L{foot_x} {foot_y}\"/><path \
         class=\"tip\" d=\"M{tip_x} {tip_y}L{} {}L{} {}z\"/>",
        foot_x + 3 * dy,
        foot_y + 3 * dx,
        foot_x - 3 * dy,
        foot_y - 3 * dx
    )
}

/// Where robots that share a cell are drawn, from its centre.
const CORNERS: [(i32, i32); 4] = [(-6, -6), (6, -6), (-6, 6), (6, 6)];

/// Robots that are drawn beside the base. More are counted.
const BESIDE_BASE: usize = 2;

/// A robot, beside the others in its cell.
fn robot(look: Look, frame: Frame, team: &[Cell], robot: usize) -> String {
    let cell = team[robot];
    let is_base = look.has_base() && cell == team[0];
    let others = (first_drawn(look)..robot).filter(|&other| team[other] == cell).count();
    let all = (first_drawn(look)..team.len()).filter(|&other| team[other] == cell).count();
    let (x, y) = frame.centre(cell);
    let (dx, dy) = match (all, is_base, CORNERS.get(others)) {
        (_, true, _) if all > BESIDE_BASE => return String::new(),
        (1, false, _) => (0, 0),
        (2, false, _) => (12 * others as i32 - 6, 0),
        (_, _, Some(&corner)) => corner,
        // More do not fit; those that are drawn hide them.
        (_, _, None) => return String::new(),
    };
    let class = match (look, all > 2 && !is_base, robot + 1 == team.len()) {
        (Look::Linked { .. } | Look::Tree { .. }, true, _) => "crowded",
        (Look::Linked { .. }, false, true) => "leader",
        (Look::Linked { .. }, false, false)
        | (Look::Tree { .. }, false, _)
        | (Look::Apart | Look::Robots | Look::Own, ..) => "robot",
    };
    let (radius, dx, dy) = match class {
        // A wall that they met is as red as they are, and stays in sight beside them.
        "crowded" => (5, dx.signum() * 5, dy.signum() * 5),
        _ if all == 1 && !is_base => (9, dx, dy),
        _ => (6, dx, dy),
    };
    let at = (x + dx, y + dy);
    format!("<circle class=\"{class}\" cx=\"{}\" cy=\"{}\" r=\"{radius}\"/>", at.0, at.1)
        + &name(at, &(robot + look.first_number()).to_string())
}

//! The marks of a picture: cells, walls, the base, links, ways and robots.

use std::fmt::Write;

use tautline_io::svg::Panel;
use tautline_kernel::floor::Mark;
use tautline_kernel::ground::{Area, Cell, Edge, Side, Step};

use crate::draw::first_drawn;
use crate::explore::{Look, TeamMove};
use tautline_grids::layout::Layout;

/// The side of a cell.
pub(super) const CELL: i32 = 24;

pub(super) fn panel(area: Area, caption: String, body: String) -> Panel {
    Panel::new(caption, (area.width() as i32 * CELL, area.height() as i32 * CELL), body)
}

/// Where the cells of an area are in its picture.
#[derive(Clone, Copy)]
pub(super) struct Frame(pub(super) Area);

impl Frame {
    pub(super) fn corner(self, cell: Cell) -> (i32, i32) {
        let first = self.0.first();
        (CELL * (i32::from(cell.x) - i32::from(first.x)), CELL * (i32::from(cell.y) - i32::from(first.y)))
    }

    pub(super) fn centre(self, cell: Cell) -> (i32, i32) {
        let (x, y) = self.corner(cell);
        (x + CELL / 2, y + CELL / 2)
    }
}

/// The lines between cells.
pub(super) fn lines(area: Area) -> String {
    let (columns, rows) = (area.width() as i32, area.height() as i32);
    let down = (0..=columns).map(|column| format!("M{} 0v{}", CELL * column, CELL * rows));
    let across = (0..=rows).map(|row| format!("M0 {}h{}", CELL * row, CELL * columns));
    format!("<path class=\"lines\" d=\"{}\"/>", down.chain(across).collect::<String>())
}

/// The lines between cells, and the blocked cells.
pub(super) fn ground(layout: &Layout, area: Area) -> String {
    let path = stripes(Frame(area), area.cells().filter(|&cell| !layout.is_free(cell)));
    lines(area) + &if path.is_empty() { path } else { format!("<path class=\"blocked\" d=\"{path}\"/>") }
}

/// The outlines of `cells`, which come row by row; those beside each other have one.
pub(super) fn stripes(frame: Frame, cells: impl IntoIterator<Item = Cell>) -> String {
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
pub(super) fn walls(layout: &Layout, area: Area) -> String {
    let frame = Frame(area);
    let (columns, rows) = (CELL * area.width() as i32, CELL * area.height() as i32);
    let mut path = format!("M0 0h{columns}v{rows}h-{columns}z");
    path.extend(area.edges().filter(|&edge| layout.has_wall(edge)).map(|edge| side(frame, edge)));
    format!("<path class=\"walls\" d=\"{path}\"/>")
}

fn side(frame: Frame, edge: Edge) -> String {
    let (x, y) = frame.corner(edge.cell().beyond(edge.side()));
    match edge.side() {
        Side::East | Side::West => format!("M{x} {y}v{CELL}"),
        Side::South | Side::North => format!("M{x} {y}h{CELL}"),
    }
}

/// A cell with its mark; nothing if it is unexplored.
pub(super) fn marked_cell(frame: Frame, cell: Cell, mark: Mark) -> String {
    let class = match mark {
        Mark::Unexplored => return String::new(),
        Mark::Explored => "explored",
        Mark::Closing => "closing",
        Mark::Visited => "visited",
        Mark::Sealed => "sealed",
    };
    let (x, y) = frame.corner(cell);
    let inner = CELL - 1;
    format!("<rect class=\"{class}\" x=\"{x}.5\" y=\"{y}.5\" width=\"{inner}\" height=\"{inner}\"/>")
}

/// A frame inside a cell of which something was missed: its sensor, or the cell as a whole.
pub(super) fn unseen(frame: Frame, cell: Cell) -> String {
    let (x, y) = frame.corner(cell);
    square("unseen", (x + 3, y + 3), CELL - 6)
}

/// A square of this class, from its corner on.
pub(super) fn square(class: &str, (x, y): (i32, i32), side: i32) -> String {
    format!("<rect class=\"{class}\" x=\"{x}\" y=\"{y}\" width=\"{side}\" height=\"{side}\"/>")
}

pub(super) fn base_mark(frame: Frame, base: Cell) -> String {
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

pub(super) fn name((x, y): (i32, i32), text: &str) -> String {
    format!("<text class=\"name\" x=\"{x}\" y=\"{y}\">{text}</text>")
}

/// The links and the base of a team that has them, the ways of the robots and the robots.
pub(super) fn team(look: Look, frame: Frame, made: &TeamMove<'_>) -> String {
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
    body.extend((first_drawn(look)..after.len()).map(|robot| self::robot(look, frame, after, robot)));
    body
}

fn links(frame: Frame, is_lost: fn(&[Cell], &[Cell]) -> bool, before: &[Cell], after: &[Cell]) -> String {
    let apart = before.windows(2).zip(after.windows(2)).filter(|(_, to)| to[0] != to[1]);
    let link = |(from, to): (&[Cell], &[Cell])| {
        let class = if is_lost(from, to) { "broken" } else { "link" };
        line(class, frame.centre(to[0]), frame.centre(to[1]))
    };
    apart.map(link).collect()
}

/// A line of this class from one place to another.
pub(super) fn line(class: &str, (x, y): (i32, i32), (to_x, to_y): (i32, i32)) -> String {
    format!("<path class=\"{class}\" d=\"M{x} {y}L{to_x} {to_y}\"/>")
}

/// A tree of links from the base to all robots that links join to it, by the fewest links.
fn tree(frame: Frame, is_linked: fn(Cell, Cell) -> bool, team: &[Cell]) -> String {
    let mut body = String::new();
    let (mut joined, mut rest) = (team[..1].to_vec(), team[1..].to_vec());
    let mut place = 0;
    while let Some(&from) = joined.get(place) {
        let near: Vec<Cell> = rest.extract_if(.., |cell| is_linked(from, *cell)).collect();
        let others = near.iter().filter(|&&cell| cell != from);
        body.extend(others.map(|&cell| line("link", frame.centre(from), frame.centre(cell))));
        joined.extend(near);
        place += 1;
    }
    body
}

/// The arrow of a robot that crosses `side`, or the bump of one that could not.
pub(super) fn way(frame: Frame, from: Cell, side: Side, is_blocked: bool) -> String {
    let (x, y) = frame.centre(from);
    let beside = Cell::new(0, 0).beyond(side);
    let (dx, dy) = (i32::from(beside.x), i32::from(beside.y));
    let half = CELL / 2;
    let (edge_x, edge_y) = (x + half * dx, y + half * dy);
    if is_blocked {
        let (across_x, across_y) = (half * dy, half * dx);
        let ends = [(edge_x - across_x, edge_y - across_y), (edge_x + across_x, edge_y + across_y)];
        return line("way", (x, y), (edge_x, edge_y)) + &line("bump", ends[0], ends[1]);
    }
    // The tip is where the circle of the robot begins.
    let (tip_x, tip_y) = (edge_x + 3 * dx, edge_y + 3 * dy);
    let (foot_x, foot_y) = (edge_x - 2 * dx, edge_y - 2 * dy);
    let (left, right) = ((foot_x + 3 * dy, foot_y + 3 * dx), (foot_x - 3 * dy, foot_y - 3 * dx));
    let path = format!("M{tip_x} {tip_y}L{} {}L{} {}z", left.0, left.1, right.0, right.1);
    line("way", (x, y), (foot_x, foot_y)) + &format!("<path class=\"tip\" d=\"{path}\"/>")
}

/// Where robots that share a cell are drawn, from its centre.
const CORNERS: [(i32, i32); 4] = [(-6, -6), (6, -6), (-6, 6), (6, 6)];

/// Robots that are drawn beside the base. More are counted.
const BESIDE_BASE: usize = 2;

/// A robot, beside the others in its cell.
pub(super) fn robot(look: Look, frame: Frame, team: &[Cell], robot: usize) -> String {
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

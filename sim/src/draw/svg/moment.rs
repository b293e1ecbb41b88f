//! A moment of a log: robots anywhere on a layout, those of them that break a clause, and cells that nobody visited.

use std::fmt::Write;

use tautline_io::svg::{Panel, escaped};
use tautline_kernel::ground::Cell;

use super::marks::{CELL, Frame, ground, line, name, panel, unseen, walls};
use tautline_grids::layout::Layout;

/// Robots in cells from the corner of a layout, each with its name; `broken` are those that break a clause, with a line
/// between them if they are two. The cells that are `unvisited`, though a clause demands it, have a frame.
pub fn moment(
    layout: &Layout,
    caption: &str,
    (robots, broken): (&[([f64; 2], String)], &[usize]),
    unvisited: &[Cell],
) -> Panel {
    let area = layout.size().area();
    let mut body = ground(layout, area);
    body.extend(unvisited.iter().map(|&cell| unseen(Frame(area), cell)));
    body += &walls(layout, area);
    let pixel = |along: f64| (along * f64::from(CELL)).round() as i32;
    let place = |robot: usize| robots.get(robot).map(|(place, _)| place.map(pixel));
    if let [one, other] = broken
        && let (Some(one), Some(other)) = (place(*one), place(*other))
    {
        body += &line("broken", one.into(), other.into());
    }
    for (robot, (place, label)) in robots.iter().enumerate() {
        let class = if broken.contains(&robot) { "crowded" } else { "robot" };
        let [x, y] = place.map(pixel);
        let _ = write!(body, "<circle class=\"{class}\" cx=\"{x}\" cy=\"{y}\" r=\"8\"/>");
        body += &name((x, y), &escaped(label));
    }
    panel(area, caption.to_owned(), body)
}

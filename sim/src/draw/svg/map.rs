//! The map that a team has made: what it knows of each cell, and the objects that it has found.

use std::fmt::Write;

use tautline_io::svg::{Panel, text_width};
use tautline_kernel::ground::{Area, Cell, Side};

use super::marks::{CELL, Frame, lines, stripes};
use crate::explore::{Play, Report, Setup};
use crate::objects::{ObjectEstimate, ObjectReport};

/// The knowledge of a team about a cell: whether it is free, if that is known. A cell that a robot was in is, and a
/// blocked one beside such a cell is not.
pub fn known(setup: &Setup, report: &Report, cell: Cell) -> Option<bool> {
    let is_explored = |cell| report.chart.step(cell).is_some();
    let is_met = || Side::ALL.iter().any(|&side| is_explored(cell.beyond(side)));
    match (is_explored(cell), setup.layout.is_free(cell)) {
        (true, _) => Some(true),
        (false, false) if is_met() => Some(false),
        (false, _) => None,
    }
}

/// The map of a run: free cells, obstacles and, left empty, what is not known; objects as squares, and crosses in the
/// ellipses in which robots take them to be with 95 %.
pub fn map(run: &dyn Play, report: &Report) -> Panel {
    let (setup, area) = (run.setup(), report.chart.area());
    let frame = Frame(area);
    let mut body = STYLE.to_owned() + &lines(area);
    for (class, is_free) in [("explored", true), ("blocked", false)] {
        let cells = area.cells().filter(|&cell| known(setup, report, cell) == Some(is_free));
        // Writing to a string cannot fail.
        let _ = write!(body, "<path class=\"{class}\" d=\"{}\"/>", stripes(frame, cells));
    }
    let pixel = |[column, row]: [f64; 2]| {
        let along = |number: f64, first: i16| (number - f64::from(first) + 0.5) * f64::from(CELL);
        (along(column, area.first().x), along(row, area.first().y))
    };
    for ObjectReport { at, found } in &report.objects {
        let (x, y) = pixel(*at);
        let _ =
            write!(body, "<path class=\"way\" fill=\"none\" d=\"M{:.1} {:.1}h4v4h-4z\"/>", x - 2.0, y - 2.0);
        let Some(ObjectEstimate { at, deviations, correlation, .. }) = found else { continue };
        let (x, y) = pixel(*at);
        // Of Cholesky's factor of the covariance, which makes a circle the ellipse.
        let [across, down] = deviations.map(|sides| sides * f64::from(CELL) * WITHIN);
        let rest = (1.0 - correlation * correlation).max(0.0).sqrt();
        let _ = write!(
            body,
            "<path class=\"found\" d=\"M{:.1} {y:.1}h4M{x:.1} {:.1}v4\"/><circle class=\"found\" r=\"1\" \
             vector-effect=\"non-scaling-stroke\" transform=\"matrix({across:.2} {:.2} 0 {:.2} {x:.1} {y:.1})\"/>",
            x - 2.0,
            y - 2.0,
            down * correlation,
            down * rest
        );
    }
    let (key, [width, height]) = key(area, !report.objects.is_empty());
    Panel::new(format!("{}: the map", setup.title()), (width, height), body + &key)
}

/// The key below the map of an area, and the size of both.
fn key(area: Area, has_objects: bool) -> (String, [i32; 2]) {
    const LINE: i32 = 20;
    let square = |class: &str| format!("<path class=\"{class}\" d=\"M0-6h12v12h-12z\"/>");
    let mut key = vec![
        (square("explored"), "a robot was here: free"),
        (square("blocked"), "an obstacle beside such a cell"),
        (square("lines"), "not known"),
    ];
    if has_objects {
        let found =
            "<path class=\"found\" d=\"M4 0h4M6-2v4\"/><ellipse class=\"found\" cx=\"6\" rx=\"6\" ry=\"4\"/>";
        key.push(("<path class=\"way\" fill=\"none\" d=\"M4-2h4v4h-4z\"/>".to_owned(), "where an object is"));
        key.push((found.to_owned(), "where robots take it to be, and with 95 % within the ellipse"));
    }
    let (mut width, mut y) = (area.width() as i32 * CELL, area.height() as i32 * CELL);
    let mut text = String::new();
    for (mark, meaning) in key {
        y += LINE;
        width = width.max(LINE + text_width(meaning));
        let line = format!("{mark}<text class=\"caption\" x=\"{LINE}\">{meaning}</text>");
        // Writing to a string cannot fail.
        let _ = write!(text, "<g transform=\"translate(0,{y})\">{line}</g>");
    }
    (text, [width, y + LINE / 2])
}

/// The style of guesses.
const STYLE: &str = "<style>.found{fill:none;stroke:var(--leader)}</style>";

/// The square root of the 95 % quantile of χ² with two degrees of freedom.
const WITHIN: f64 = 2.447_746_830_680_816;

//! Pictures as SVG, for light and dark pages: layouts, the environments of a cell, the order of exploration, team
//! moves. Every text is made of numbers and our own words, or escaped.

mod map;
mod marks;
mod moment;

use std::fmt::Write;
use std::ops::RangeInclusive;

use tautline_io::diagnostic::{Diagnostic, Halt};
use tautline_io::svg::{Panel, SERIES, SERIES_STYLE};
use tautline_kernel::ground::{Area, Cell};

use super::{Environment, REACH};
use crate::explore::{Play, Report, Setup, Survey, TeamMove};
use tautline_grids::layout::Layout;

pub use map::{known, map};
use marks::{CELL, Frame, base_mark, ground, lines, marked_cell, panel, square, team, walls};
pub use moment::moment;

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
    body.extend(layout.base().map(|base| base_mark(Frame(area), base)));
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
    body.extend(area.cells().map(|cell| marked_cell(frame, cell, chart.mark(cell, made.step))));
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
        let places = way.iter().map(|&cell| frame.centre(cell));
        let points: Vec<String> = places.map(|(x, y)| format!("{},{}", x + file, y + file)).collect();
        let colour = robot as usize % SERIES;
        let dashes = if robot as usize >= SERIES { "stroke-dasharray:5 3;" } else { "" };
        let _ = write!(
            body,
            "<polyline points=\"{}\" style=\"fill:none;{dashes}stroke-width:1.5;stroke:var(--series-{colour})\"/>",
            points.join(" ")
        );
    }
    body.extend(layout.base().map(|base| base_mark(frame, base)));
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
            body.extend(environment.offsets().map(|cell| square("member", frame.corner(cell), CELL)));
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

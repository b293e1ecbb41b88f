//! Rescues drawn: a map of the ways that robots went, and a page that plays what happened, event by event.

use std::fmt::Write;

use super::field::{ALONE, Map, ROBOT, STYLE, Scale, Terminus, Trail, ground, numbered};
use super::page::{TEAM, moved, parts};
use super::svg::{MARGIN, SERIES, SERIES_STYLE, document, text_width};
use crate::fault::Fault;
use crate::radio::Point;
use crate::rescue::{Event, Fix, Logged, Ordinal, Report, seconds};

/// Robots that a page can draw, over all its events.
const MAX_DRAWN: usize = 100_000;

/// The map of a rescue: the nodes, the WFRs, and where each robot went. The place where one failed is marked.
pub fn map(caption: String, report: &Report) -> Map<'_> {
    let trail = |(number, path): (Ordinal, &Vec<Fix>)| {
        let fails =
            |logged: &Logged| matches!(logged.event, Event::RobotFails { robot, .. } if robot == number);
        let end = if report.log.iter().any(fails) { Terminus::Failed } else { Terminus::There };
        let places = path.iter().map(|fix| fix.at).collect();
        Trail { name: format!("robot {number}"), places, end }
    };
    Map {
        caption,
        field: &report.field,
        nodes: report.field.nodes().len(),
        links: Vec::new(),
        trails: (0..).map(Ordinal).zip(&report.paths).map(trail).collect(),
        wfrs: report.wfrs.clone(),
    }
}

/// The page that plays a rescue.
///
/// # Errors
/// A [`Fault`] if it would be too large.
pub fn page(title: &str, outcome: &str, report: &Report) -> Result<String, Fault> {
    if (report.log.len() + 1) * report.paths.len() > MAX_DRAWN {
        let what = format!("a page of more than {MAX_DRAWN} robots in all its events");
        return Err(Fault::usage(what, "take fewer robots or WFRs, or store a trace"));
    }
    let map = map(String::new(), report);
    let (scale, (width, height)) = Scale::of(&map, ALONE);
    let mut body = format!("<g transform=\"translate({MARGIN},{MARGIN})\">{}", ground(&map, scale));
    for (number, &wfr) in (0..).map(Ordinal).zip(&report.wfrs) {
        body.push_str(&numbered(&scale.place(wfr), number));
    }
    let mut before_ns = 0;
    let mut moves = moved(0, "The start", &robots(report, scale, 0));
    for (step, Logged { at_ns, event }) in (1..).zip(&report.log) {
        let words = format!("{:.3} s: {event}", seconds(*at_ns));
        body += &ways(report, scale, step, (before_ns, *at_ns));
        moves += &moved(step, &words, &robots(report, scale, *at_ns));
        before_ns = *at_ns;
    }
    body = body + TEAM + "</g>";
    let names = (0..report.paths.len()).map(|robot| format!("robot {}", Ordinal(robot)));
    let mut x = MARGIN;
    let y = height + 2 * MARGIN;
    for (look, name) in names.enumerate() {
        // Writing to a string cannot fail.
        let _ = write!(
            body,
            "<g class=\"trail-{}\" transform=\"translate({x},{y})\"><path class=\"mark\" d=\"M6 0{ROBOT}\"/></g>\
             <text class=\"start\" x=\"{}\" y=\"{y}\">{name}</text>",
            look % SERIES,
            x + 18
        );
        x += 18 + text_width(&name) + MARGIN;
    }
    let size = (x.max(width + 2 * MARGIN), y + MARGIN);
    let picture = document(title, &format!("{SERIES_STYLE}{STYLE}"), size, &body);
    let [head, middle, foot] = parts("", ["event", "Events"], title, outcome);
    Ok([head, picture, middle, moves, foot].concat())
}

/// Where the robots have gone between an event and the one before.
fn ways(report: &Report, scale: Scale, step: u32, (from_ns, to_ns): (u64, u64)) -> String {
    let mut ways = String::new();
    for (look, path) in report.paths.iter().enumerate() {
        let (from, to) = (place(path, from_ns), place(path, to_ns));
        let between = path.iter().filter(|fix| (from_ns..to_ns).contains(&fix.at_ns)).map(|fix| fix.at);
        let look = look % SERIES;
        if from != to {
            let mut line = format!("M{}", scale.place(from));
            for at in between.chain([to]) {
                let _ = write!(line, "L{}", scale.place(at));
            }
            let _ = write!(ways, "<path class=\"trail trail-{look}\" d=\"{line}\"/>");
        }
    }
    if ways.is_empty() { ways } else { format!("<g class=\"cell\" data-step=\"{step}\">{ways}</g>\n") }
}

/// Where the robots are at a time.
fn robots(report: &Report, scale: Scale, at_ns: u64) -> String {
    report.paths.iter().enumerate().fold(String::new(), |mut robots, (look, path)| {
        let (look, at) = (look % SERIES, scale.place(place(path, at_ns)));
        let _ = write!(robots, "<g class=\"trail-{look}\"><path class=\"mark\" d=\"M{at}{ROBOT}\"/></g>");
        robots
    })
}

/// Where a robot is at a time.
#[expect(clippy::cast_precision_loss, reason = "a place in a drawing")]
fn place(path: &[Fix], at_ns: u64) -> Point {
    let after = path.partition_point(|fix| fix.at_ns <= at_ns);
    match (path.get(after.wrapping_sub(1)), path.get(after)) {
        (Some(from), Some(to)) => {
            let part = (at_ns - from.at_ns) as f64 / (to.at_ns - from.at_ns).max(1) as f64;
            let along = |from: f64, to: f64| from + part * (to - from);
            Point { x_m: along(from.at.x_m, to.at.x_m), y_m: along(from.at.y_m, to.at.y_m) }
        }
        (Some(only), None) | (None, Some(only)) => only.at,
        (None, None) => Point { x_m: 0.0, y_m: 0.0 },
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn between_two_fixes_a_robot_goes_straight() {
        let fix = |at_ns: u64, x_m: f64| Fix { at_ns, at: Point { x_m, y_m: 2.0 } };
        let path = [fix(0, 1.0), fix(10, 1.0), fix(20, 3.0)];
        for (at_ns, x_m) in [(0, 1.0), (5, 1.0), (10, 1.0), (15, 2.0), (20, 3.0), (99, 3.0)] {
            assert_eq!(place(&path, at_ns), Point { x_m, y_m: 2.0 });
        }
    }
}

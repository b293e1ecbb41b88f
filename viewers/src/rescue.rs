//! A rescue as a recording of ROS 2: the field, the robots on their ways, and what happened. `docs/formats.md` lists
//! the topics.

use serde::Serialize;

use crate::mcap::file::{BLUE, Drawing, File, ORANGE, PURPLE, Shape, headed};
use tautline_field::radio::Point;
use tautline_field::rescue::trace::Last;
use tautline_field::rescue::{Fix, Report, Setting, seconds};
use tautline_io::atomic_file::AtomicFile;
use tautline_io::diagnostic::Diagnostic;

const SECOND_NS: u64 = 1_000_000_000;

/// A point of the recording: y goes north, and the south-western corner of the area is at 0, 0.
fn place(height_m: f64, at: Point) -> [f64; 2] {
    [at.x_m, height_m - at.y_m]
}

/// Where a robot is, between two fixes on its straight way, and the direction of that way; one that stands looks east.
fn pose(path: &[Fix], at_ns: u64) -> Option<(Point, [f64; 2])> {
    let next = path.partition_point(|fix| fix.at_ns <= at_ns);
    let last = *path.get(next.saturating_sub(1))?;
    let stands = (last.at, [1.0, 0.0]);
    let Some(next) = path.get(next).filter(|_| next > 0) else { return Some(stands) };
    let (x_m, y_m) = (next.at.x_m - last.at.x_m, next.at.y_m - last.at.y_m);
    let length_m = (x_m * x_m + y_m * y_m).sqrt();
    if length_m == 0.0 {
        return Some(stands);
    }
    let share = seconds(at_ns - last.at_ns) / seconds(next.at_ns - last.at_ns);
    let at = Point { x_m: last.at.x_m + share * x_m, y_m: last.at.y_m + share * y_m };
    Some((at, [x_m / length_m, -y_m / length_m]))
}

/// When the robots are told of: at each event and each fix, and every second in which one of them is on its way.
fn times(report: &Report) -> Vec<u64> {
    let fixes = report.paths.iter().flatten().map(|fix| fix.at_ns);
    let events = report.log.iter().map(|logged| logged.at_ns);
    let ways = report.paths.iter().flat_map(|path| path.windows(2)).filter(|ends| ends[0].at != ends[1].at);
    let seconds = ways.flat_map(|ends| {
        (ends[0].at_ns.div_ceil(SECOND_NS)..=ends[1].at_ns / SECOND_NS).map(|second| second * SECOND_NS)
    });
    let mut times: Vec<u64> = fixes.chain(events).chain(seconds).chain([0]).collect();
    times.sort_unstable();
    times.dedup();
    times
}

/// A line of the trace, as a message.
fn line(at_ns: u64, line: &impl Serialize) -> Vec<u8> {
    let mut message = headed(at_ns);
    // What the trace can write, this can.
    message.string(&serde_json::to_string(line).unwrap_or_default());
    message.into_bytes()
}

/// Writes a rescue to `file`.
///
/// # Errors
/// A [`Diagnostic`] if it has more messages than the format can count.
pub fn write(file: &mut AtomicFile, setting: &Setting, seed: u64, report: &Report) -> Result<(), Diagnostic> {
    let height_m = report.field.area().height_m();
    let setting = serde_json::to_string(setting).unwrap_or_default();
    let mut file = File::begin(file, &[("seed", seed.to_string()), ("setting", setting)])?;
    let points =
        |places: &[Point], ink| -> Vec<_> { places.iter().map(|&at| (place(height_m, at), ink)).collect() };
    let nodes = Drawing { name: "nodes", shape: Shape::Points, width_m: 1.5 };
    file.marker("/nodes", 0, &nodes, &points(report.field.nodes(), BLUE))?;
    let wfrs = Drawing { name: "WFRs", shape: Shape::Points, width_m: 5.0 };
    file.marker("/wfrs", 0, &wfrs, &points(&report.wfrs, ORANGE))?;
    let sides = report.field.obstacles().iter().flat_map(|of| {
        let corner = |x_m, y_m| place(height_m, Point { x_m, y_m });
        let corners = [
            corner(of.west_m, of.north_m),
            corner(of.east_m, of.north_m),
            corner(of.east_m, of.south_m),
            corner(of.west_m, of.south_m),
        ];
        (0..4).flat_map(move |side| [(corners[side], PURPLE), (corners[(side + 1) % 4], PURPLE)])
    });
    let sides: Vec<_> = sides.collect();
    if !sides.is_empty() {
        let obstacles = Drawing { name: "obstacles", shape: Shape::Lines, width_m: 0.5 };
        file.marker("/obstacles", 0, &obstacles, &sides)?;
    }
    let mut log = report.log.iter().peekable();
    let mut last_ns = 0;
    for at_ns in times(report) {
        let poses = report.paths.iter().filter_map(|path| pose(path, at_ns));
        let poses: Vec<_> = poses.map(|(at, way)| (place(height_m, at), way)).collect();
        file.poses("/robots", at_ns, &poses)?;
        while let Some(logged) = log.next_if(|logged| logged.at_ns <= at_ns) {
            file.send("/event", "tautline/Line", at_ns, &line(at_ns, logged))?;
        }
        last_ns = at_ns;
    }
    file.send("/end", "tautline/Line", last_ns, &line(last_ns, &Last::of(report)))?;
    file.end()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_robot_goes_straight_between_two_fixes() {
        let fix = |seconds: u64, x_m, y_m| Fix { at_ns: seconds * SECOND_NS, at: Point { x_m, y_m } };
        let path = [fix(2, 0.0, 0.0), fix(4, 6.0, 8.0), fix(9, 6.0, 8.0)];
        let at = |seconds: u64| pose(&path, seconds * SECOND_NS).map(|(at, way)| ([at.x_m, at.y_m], way));
        let east = [1.0, 0.0];
        assert_eq!(at(0), Some(([0.0, 0.0], east)));
        // South-east, where y goes north.
        assert_eq!(at(3), Some(([3.0, 4.0], [0.6, -0.8])));
        assert_eq!(at(5), Some(([6.0, 8.0], east)));
        assert_eq!(at(20), Some(([6.0, 8.0], east)));
        assert_eq!(pose(&[], 0), None);
    }
}

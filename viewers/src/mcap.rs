//! A run as MCAP, the container of ROS 2's recordings: messages in CDR, each with the definition of its type.
//! `docs/formats.md` lists the topics. The start is at 0 s, and team move k at k seconds.

mod cdr;
mod definition;
pub(crate) mod file;
mod points;

use std::collections::VecDeque;

use tautline_kernel::ground::{Cell, Side, Step};

use self::file::{BLUE, Drawing, File, Ink, ORANGE, PURPLE, headed, stamp};
use self::points::{Points, Rectangle};
use tautline_io::atomic_file::AtomicFile;
use tautline_io::diagnostic::{Diagnostic, Halt};
use tautline_sim::explore::{
    Joins, Layer, Look, Play, Report, Scene, Setup, Shape, TeamMove, Violation, Zone,
};
use tautline_sim::trace::{StoredMove, numbered_from};

/// The points of a map are so many metres wide, of cells of one metre. The first is a post, whose middle is at 0, 0.
const POINT_M: f64 = 0.5;

/// A map of at most so many points is sent whole each time that it changes. Of a larger one what changes is sent, and
/// the whole again when that has taken as many bytes.
const MOST_WHOLE: usize = 64 * 64;

/// Links by their zones; those in none are lost.
const ZONE_INKS: [Ink; 2] = [BLUE, ORANGE];
const LOST_INK: Ink = PURPLE;

/// The time of a team move.
const fn at_ns(step: u32) -> u64 {
    step as u64 * 1_000_000_000
}

/// Writes `run` to `file`.
///
/// # Errors
/// [`Halt`] if the run cannot be made, or has more messages than the format can count.
pub fn write(file: &mut AtomicFile, run: &dyn Play) -> Result<(), Halt> {
    let mut recording = Recording::begin(file, run.setup())?;
    let report = run.play(&mut |made| Ok(recording.add(made)?))?;
    Ok(recording.end(&report, run)?)
}

/// A file in the making.
struct Recording<'f> {
    file: File<'f>,
    look: Look,
    rows: i16,
    known: Points,
    /// Bytes of what has changed in a large map since the whole was sent.
    sent: usize,
    links: Option<(Joins, &'static [Zone])>,
}

impl<'f> Recording<'f> {
    /// Writes the still part, and the start.
    fn begin(file: &'f mut AtomicFile, setup: &Setup) -> Result<Self, Diagnostic> {
        let mut facts = vec![
            ("scheme", setup.scheme.name.to_owned()),
            ("rule", setup.rule.to_string()),
            ("robots", setup.robots.to_string()),
            ("seed", setup.seed.to_string()),
            ("layout", setup.layout.to_string()),
        ];
        facts.extend(numbered_from(setup.scheme.look).map(|first| ("numbered_from", first.to_string())));
        let (file, starts) = (File::begin(file, &facts)?, setup.starts());
        let known = Points::at_start(&setup.layout, &starts);
        let mut recording =
            Self { file, look: setup.scheme.look, rows: setup.layout.height(), known, sent: 0, links: None };
        recording.send("/layout", "nav_msgs/OccupancyGrid", 0, &grid(&Points::whole(&setup.layout), 0))?;
        recording.known.changed();
        recording.map(0)?;
        let faces: Vec<(Cell, Option<Side>)> = starts.into_iter().map(|cell| (cell, None)).collect();
        recording.poses(0, &faces)?;
        Ok(recording)
    }

    fn send(&mut self, topic: &'static str, kind: &str, step: u32, message: &[u8]) -> Result<(), Diagnostic> {
        self.file.send(topic, kind, at_ns(step), message)
    }

    /// A team move, and what the team knows after it.
    fn add(&mut self, made: &TeamMove<'_>) -> Result<(), Diagnostic> {
        let mut scene = Scene::default();
        made.team.show(made.before, &mut scene);
        if made.step == 1 {
            self.links = links(&made.team.layers());
            self.links(0, made.before)?;
        }
        let stored = StoredMove::new(made, self.look);
        let mut message = headed(at_ns(made.step));
        message.u32(made.step);
        message.string(stored.kind());
        message.string(stored.tried());
        message.list(&made.frame.blocked, |cdr, &blocked| cdr.bool(blocked));
        message.list(&made.frame.cells, |cdr, cell| {
            cdr.i32(cell.x.into());
            cdr.i32(cell.y.into());
        });
        message.list(made.broken, |cdr, clause| cdr.string(clause.as_str()));
        message.string(stored.title());
        message.bool(stored.is_again());
        self.send("/team_move", "tautline/TeamMove", made.step, &message.into_bytes())?;
        let face = |(&cell, &step): (&Cell, &Step)| match step {
            Step::Cross(side) => (cell, Some(side)),
            Step::Stay => (cell, None),
        };
        let faces: Vec<_> = made.frame.cells.iter().zip(&made.frame.steps).map(face).collect();
        self.poses(made.step, &faces)?;
        self.links(made.step, &made.frame.cells)?;
        self.known.take(made, &scene);
        let changed = self.known.changed();
        if changed.is_empty() {
            return Ok(());
        }
        if self.known.values().len() <= MOST_WHOLE {
            return self.map(made.step);
        }
        for part in changed {
            self.update(made.step, part)?;
        }
        if self.sent >= self.known.values().len() { self.map(made.step) } else { Ok(()) }
    }

    /// The whole of what the team knows.
    fn map(&mut self, step: u32) -> Result<(), Diagnostic> {
        self.sent = 0;
        let message = grid(&self.known, step);
        self.send("/map", "nav_msgs/OccupancyGrid", step, &message)
    }

    /// Writes the change in this part of it.
    fn update(&mut self, step: u32, part: Rectangle) -> Result<(), Diagnostic> {
        let mut message = headed(at_ns(step));
        message.i32(part.x as i32);
        message.i32(part.y as i32);
        message.u32(part.width as u32);
        message.u32(part.height as u32);
        message.bytes(self.known.within(part).into_iter());
        let message = message.into_bytes();
        self.sent += message.len();
        self.send("/map_updates", "map_msgs/OccupancyGridUpdate", step, &message)
    }

    /// Where the robots are, turned to where they tried to go; one that stays looks east.
    fn poses(&mut self, step: u32, faces: &[(Cell, Option<Side>)]) -> Result<(), Diagnostic> {
        let poses = faces.iter().map(|&(cell, side)| {
            let way = match side {
                None | Some(Side::East) => [1.0, 0.0],
                Some(Side::North) => [0.0, 1.0],
                Some(Side::West) => [-1.0, 0.0],
                Some(Side::South) => [0.0, -1.0],
            };
            (place(self.rows, cell), way)
        });
        let poses: Vec<_> = poses.collect();
        self.file.poses("/robots", at_ns(step), &poses)
    }

    /// The links of robots in these cells, where the scheme has links.
    fn links(&mut self, step: u32, cells: &[Cell]) -> Result<(), Diagnostic> {
        let Some((joins, zones)) = self.links else { return Ok(()) };
        let ends = joined(joins, zones, cells).into_iter().flat_map(|(one, other, zone)| {
            let ink = zone.map_or(LOST_INK, |zone| ZONE_INKS[zone % ZONE_INKS.len()]);
            [one, other].map(|robot| (place(self.rows, cells[robot]), ink))
        });
        let ends: Vec<_> = ends.collect();
        let drawing = Drawing { name: "links", shape: file::Shape::Lines, width_m: 0.08 };
        self.file.marker("/links", at_ns(step), &drawing, &ends)
    }

    /// Writes the outcome of the run, and in words the demands of a rule of one's own that it breaks.
    fn end(mut self, report: &Report, run: &dyn Play) -> Result<(), Diagnostic> {
        let mut message = headed(at_ns(report.steps));
        // The word that the trace has for it.
        let stopped = serde_json::to_value(report.stopped).unwrap_or_default();
        message.string(stopped.as_str().unwrap_or_default());
        for number in [report.steps, report.explored, report.cells] {
            message.u32(number);
        }
        message.list(&report.violations, |cdr, violation| {
            cdr.string(violation.clause.as_str());
            cdr.u32(violation.step);
        });
        self.send("/end", "tautline/End", report.steps, &message.into_bytes())?;
        if numbered_from(self.look).is_some() {
            let demand = |violation: &Violation| {
                Some((violation.clause.as_str(), run.sentence(violation.clause)?.to_owned()))
            };
            let demands: Vec<_> = report.violations.iter().filter_map(demand).collect();
            if !demands.is_empty() {
                self.file.note("tautline demands", &demands)?;
            }
        }
        self.file.end()
    }
}

/// The middle of a cell, in metres, in a layout of so many rows.
fn place(rows: i16, cell: Cell) -> [f64; 2] {
    [f64::from(cell.x) + 0.5, f64::from(rows - cell.y) - 0.5]
}

/// A map, whole.
fn grid(points: &Points, step: u32) -> Vec<u8> {
    let mut message = headed(at_ns(step));
    stamp(&mut message, 0);
    message.f32(POINT_M as f32);
    message.u32(points.width as u32);
    message.u32(points.height as u32);
    message.f64s([-POINT_M / 2.0, -POINT_M / 2.0, 0.0, 0.0, 0.0, 0.0, 1.0]);
    message.bytes(points.values().iter().copied());
    message.into_bytes()
}

/// The links that a team shows, if it does.
fn links(layers: &[Layer]) -> Option<(Joins, &'static [Zone])> {
    layers.iter().find_map(|layer| match layer.shape {
        Shape::Links(joins, zones) => Some((joins, zones)),
        Shape::Cells(_)
        | Shape::Sides(_)
        | Shape::CellsOfEach(_)
        | Shape::SidesOfEach(_)
        | Shape::Circle(_)
        | Shape::Marks(_)
        | Shape::Messages(_)
        | Shape::Reports => None,
    })
}

/// Pairs of robots with a link, by their places, and its zone; none if it is lost.
fn joined(joins: Joins, zones: &[Zone], cells: &[Cell]) -> Vec<(usize, usize, Option<usize>)> {
    let zone = |one: usize, other: usize| zones.iter().position(|zone| (zone.has)(cells[one], cells[other]));
    let link = |one: usize, other: usize| Some((one, other, Some(zone(one, other)?)));
    match joins {
        Joins::Next => (1..cells.len()).map(|robot| (robot - 1, robot, zone(robot - 1, robot))).collect(),
        Joins::All => {
            let pairs =
                (0..cells.len()).flat_map(|one| (one + 1..cells.len()).map(move |other| (one, other)));
            pairs.filter_map(|(one, other)| link(one, other)).collect()
        }
        Joins::Tree => {
            let (mut found, mut left) = (Vec::new(), (1..cells.len()).collect::<Vec<_>>());
            let mut next: VecDeque<usize> = (0..cells.len().min(1)).collect();
            while let Some(one) = next.pop_front() {
                left.retain(|&other| {
                    let link = link(one, other);
                    next.extend(link.map(|_| other));
                    found.extend(link);
                    link.is_none()
                });
            }
            found
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn links_join_neighbours_in_the_order_all_in_reach_or_a_tree() {
        const BESIDE: Zone = Zone { name: "", about: "", has: |one, other| one.x.abs_diff(other.x) <= 1 };
        let cells: Vec<Cell> = [0, 1, 0, 2, 9].map(|x| Cell::new(x, 0)).into();
        let joined = |joins| {
            let joined = joined(joins, &[BESIDE], &cells).into_iter();
            joined.map(|(one, other, zone)| (one, other, zone.is_some())).collect::<Vec<_>>()
        };
        assert_eq!(joined(Joins::Next), [(0, 1, true), (1, 2, true), (2, 3, false), (3, 4, false)]);
        assert_eq!(joined(Joins::All), [(0, 1, true), (0, 2, true), (1, 2, true), (1, 3, true)]);
        assert_eq!(joined(Joins::Tree), [(0, 1, true), (0, 2, true), (1, 3, true)]);
    }
}

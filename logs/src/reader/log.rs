//! The positions that a log has, as they are taken one by one, and what is wrong where one cannot be read.

use std::collections::HashMap;
use std::fmt;
use std::ops::Range;

/// The samples that are held: some 400 MB.
pub const MOST_SAMPLES: usize = 1 << 24;

/// The frames that are named.
const MOST_FRAMES: usize = 8;

/// The farthest that a position may be along an axis, in millimetres: distances between positions fit into their
/// numbers.
const FARTHEST_MM: f64 = 1e9;

/// The form of a log.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Form {
    /// A table with a line of names at its top.
    Csv,
    /// An object of JSON a line.
    JsonLines,
    /// MCAP, the container of ROS 2's recordings.
    Mcap,
}

impl Form {
    /// The word for a place in such a log.
    pub const fn place(self) -> &'static str {
        match self {
            Self::Csv | Self::JsonLines => "line",
            Self::Mcap => "message",
        }
    }
}

/// The position of a robot at a moment.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Sample {
    /// The stamp in microseconds, from an origin that the log does not say.
    pub at_us: i64,
    /// The robot, as a number of [`Log::names`].
    pub robot: u32,
    /// Along the first axis, in millimetres.
    pub x_mm: i32,
    /// Along the second axis, in millimetres.
    pub y_mm: i32,
    /// The line or the message of the log, from 1.
    pub place: u32,
}

/// The positions that a log has, in its order.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Log {
    /// The form that it is in.
    pub form: Form,
    /// The positions.
    pub samples: Vec<Sample>,
    /// The names of the robots, in the order of the log; also of those of whom no position is taken.
    pub names: Vec<String>,
    /// The first frames that its positions are given in, where it names any.
    pub frames: Vec<String>,
    /// The last place, if the log ends in the midst of it. What stands there is not taken.
    pub cut: Option<u32>,
    /// How many positions are no numbers or more than 1,000 km away, and where the first is. They are not taken.
    pub unplaced: Option<(u32, u32)>,
}

/// Something in a log that cannot be read.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Fault {
    /// Where it is.
    pub place: FaultPlace,
    /// The words for it.
    pub what: String,
    /// The words for what would be right.
    pub remedy: String,
}

/// The place of a fault.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum FaultPlace {
    /// The log as a whole.
    Whole,
    /// The bytes of a line.
    Line {
        /// The number of the line, from 1.
        line: usize,
        /// The line.
        text: String,
        /// The bytes of it that are meant.
        bytes: Range<usize>,
    },
    /// A message, from 1.
    Message(u32),
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.place {
            FaultPlace::Whole => {}
            FaultPlace::Line { line, .. } => write!(f, "line {line}: ")?,
            FaultPlace::Message(message) => write!(f, "message {message}: ")?,
        }
        write!(f, "{}; {}", self.what, self.remedy)
    }
}

impl std::error::Error for Fault {}

impl Fault {
    pub(super) fn whole(what: impl Into<String>, remedy: impl Into<String>) -> Self {
        Self { place: FaultPlace::Whole, what: what.into(), remedy: remedy.into() }
    }

    pub(super) fn message(message: u32, what: impl Into<String>, remedy: impl Into<String>) -> Self {
        Self { place: FaultPlace::Message(message), what: what.into(), remedy: remedy.into() }
    }
}

/// A log in the making.
pub(super) struct Reading {
    pub(super) log: Log,
    robots: HashMap<String, u32>,
}

/// A position as a log has it.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(super) struct Pose<'a> {
    pub(super) at_us: i64,
    pub(super) robot: &'a str,
    pub(super) mm: [f64; 2],
}

impl Reading {
    pub(super) fn new(form: Form) -> Self {
        let (samples, names, frames) = (Vec::new(), Vec::new(), Vec::new());
        Self { log: Log { form, samples, names, frames, cut: None, unplaced: None }, robots: HashMap::new() }
    }

    /// Takes a position that stands in this place.
    pub(super) fn take(&mut self, place: u32, pose: Pose<'_>) -> Result<(), Fault> {
        let log = &mut self.log;
        if log.samples.len().max(log.names.len()) >= MOST_SAMPLES {
            let what = format!("the log has more than {MOST_SAMPLES} positions");
            return Err(Fault::whole(what, "cut it into parts, or leave positions out"));
        }
        // A robot whose positions are not taken is one all the same, and silent.
        let robot = if let Some(&known) = self.robots.get(pose.robot) {
            known
        } else {
            log.names.push(pose.robot.to_owned());
            let new = log.names.len() as u32 - 1;
            self.robots.insert(pose.robot.to_owned(), new);
            new
        };
        if !pose.mm.iter().all(|along| along.abs() <= FARTHEST_MM) {
            let (count, _) = log.unplaced.get_or_insert((0, place));
            *count += 1;
            return Ok(());
        }
        let [x_mm, y_mm] = pose.mm.map(|along| along.round() as i32);
        log.samples.push(Sample { at_us: pose.at_us, robot, x_mm, y_mm, place });
        Ok(())
    }

    /// Notes the frame of a position.
    pub(super) fn frame(&mut self, frame: &str) {
        let frames = &mut self.log.frames;
        if frames.len() < MOST_FRAMES && !frame.is_empty() && frames.iter().all(|known| known != frame) {
            frames.push(frame.to_owned());
        }
    }
}

/// The farthest stamp from 0, in microseconds.
pub(super) const MOST_US: f64 = 9e18;

/// Microseconds of seconds and nanoseconds, or nothing if there is no such moment.
pub(super) fn micros(seconds: i64, nanos: i64) -> Option<i64> {
    seconds.checked_mul(1_000_000)?.checked_add(nanos / 1_000)
}

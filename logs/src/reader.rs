//! Reading a log: its form is told by its first bytes, and each form yields the same samples.

mod cdr;
mod columns;
mod lines;
mod recording;
mod table;

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

/// The byte order mark that some editors put before a text; it is no part of it.
pub(crate) const BOM: &str = "\u{feff}";

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
    fn whole(what: impl Into<String>, remedy: impl Into<String>) -> Self {
        Self { place: FaultPlace::Whole, what: what.into(), remedy: remedy.into() }
    }

    fn message(message: u32, what: impl Into<String>, remedy: impl Into<String>) -> Self {
        Self { place: FaultPlace::Message(message), what: what.into(), remedy: remedy.into() }
    }
}

/// A log in the making.
struct Reading {
    log: Log,
    robots: HashMap<String, u32>,
}

/// A position as a log has it.
#[derive(Clone, Copy, PartialEq, Debug)]
struct Pose<'a> {
    at_us: i64,
    robot: &'a str,
    mm: [f64; 2],
}

impl Reading {
    fn new(form: Form) -> Self {
        let (samples, names, frames) = (Vec::new(), Vec::new(), Vec::new());
        Self { log: Log { form, samples, names, frames, cut: None, unplaced: None }, robots: HashMap::new() }
    }

    /// Takes a position that stands in this place.
    fn take(&mut self, place: u32, pose: Pose<'_>) -> Result<(), Fault> {
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
    fn frame(&mut self, frame: &str) {
        let frames = &mut self.log.frames;
        if frames.len() < MOST_FRAMES && !frame.is_empty() && frames.iter().all(|known| known != frame) {
            frames.push(frame.to_owned());
        }
    }
}

/// The farthest stamp from 0, in microseconds.
const MOST_US: f64 = 9e18;

/// Microseconds of seconds and nanoseconds, or nothing if there is no such moment.
fn micros(seconds: i64, nanos: i64) -> Option<i64> {
    seconds.checked_mul(1_000_000)?.checked_add(nanos / 1_000)
}

/// Reads a log.
///
/// # Errors
/// A [`Fault`] if it is none, has no position, or too many. A log that ends in the midst of a line or a message is read
/// up to there.
pub fn read(bytes: &[u8]) -> Result<Log, Fault> {
    const REMEDY: &str = "name a table with columns time, robot, x and y, lines of JSON with \
                          these fields, or a recording of ROS 2 in MCAP";
    let bytes = bytes.strip_prefix(BOM.as_bytes()).unwrap_or(bytes);
    let log = match bytes.iter().find(|byte| !byte.is_ascii_whitespace()) {
        None => return Err(Fault::whole("the log is empty", REMEDY)),
        Some(0x89) => recording::read(bytes)?,
        Some(b'{') => lines::read(bytes)?,
        Some(_) => table::read(bytes)?,
    };
    if log.samples.is_empty() {
        return Err(Fault::whole("the log has no position", REMEDY));
    }
    Ok(log)
}

//! A recording in the making: channels that are opened as their first messages come, and what messages have in common.

use std::collections::BTreeMap;

use tautline_io::atomic_file::{AtomicFile, MCAP_LIBRARY, MCAP_PROFILE};
use tautline_io::diagnostic::Diagnostic;

use ::mcap::records::{MessageHeader, Metadata};
use ::mcap::write::NoSeek;
use ::mcap::{McapError, WriteOptions, Writer};

use super::cdr::Cdr;
use super::definition::definition;

/// The frame of all places: x goes east, y goes north.
const FRAME: &str = "map";

/// The actions of a `visualization_msgs/Marker`.
const ADD: i32 = 0;
const DELETE: i32 = 2;

/// Red, green, blue.
pub(crate) type Ink = [f32; 3];

/// Blue, orange and red-purple: the colour-blind tell them apart, too.
pub(crate) const BLUE: Ink = [0.0, 0.45, 0.7];
pub(crate) const ORANGE: Ink = [0.9, 0.6, 0.0];
pub(crate) const PURPLE: Ink = [0.8, 0.4, 0.7];

#[expect(clippy::needless_pass_by_value, reason = "it is given to `map_err`")]
fn unwritten(error: McapError) -> Diagnostic {
    Diagnostic::usage(format_args!("the MCAP file cannot be written: {error}"), "store a shorter run")
}

/// A record with these facts.
fn record(name: &str, facts: &[(&str, String)]) -> Metadata {
    let metadata = facts.iter().map(|(name, fact)| ((*name).to_owned(), fact.clone())).collect();
    Metadata { name: name.to_owned(), metadata }
}

/// A file in the making.
pub(crate) struct File<'f> {
    writer: Writer<NoSeek<&'f mut AtomicFile>>,
    /// By topic: its channel, and how many messages it has.
    channels: BTreeMap<&'static str, (u16, u32)>,
}

impl<'f> File<'f> {
    /// A file that says this of itself.
    ///
    /// # Errors
    /// A [`Diagnostic`], as of all that writes to it, if the format has no room for it.
    pub(crate) fn begin(file: &'f mut AtomicFile, facts: &[(&str, String)]) -> Result<Self, Diagnostic> {
        let options = WriteOptions::new().profile(MCAP_PROFILE).library(MCAP_LIBRARY);
        let options = options.compression(None).disable_seeking(true);
        let mut writer = options.create(NoSeek::new(file)).map_err(unwritten)?;
        writer.write_metadata(&record("tautline", facts)).map_err(unwritten)?;
        Ok(Self { writer, channels: BTreeMap::new() })
    }

    /// Adds a record with more facts.
    pub(crate) fn note(&mut self, name: &str, facts: &[(&str, String)]) -> Result<(), Diagnostic> {
        self.writer.write_metadata(&record(name, facts)).map_err(unwritten)
    }

    /// Adds a message of the type `kind`, so many nanoseconds after the start.
    pub(crate) fn send(
        &mut self,
        topic: &'static str,
        kind: &str,
        at_ns: u64,
        message: &[u8],
    ) -> Result<(), Diagnostic> {
        let (channel_id, sequence) = match self.channels.get(topic) {
            Some(&known) => known,
            None => (self.open(topic, kind).map_err(unwritten)?, 0),
        };
        self.channels.insert(topic, (channel_id, sequence + 1));
        let header = MessageHeader { channel_id, sequence, log_time: at_ns, publish_time: at_ns };
        self.writer.write_to_known_channel(&header, message).map_err(unwritten)
    }

    /// The channel of a new topic with messages of this type.
    fn open(&mut self, topic: &str, kind: &str) -> Result<u16, McapError> {
        let name = kind.replace('/', "/msg/");
        let schema = self.writer.add_schema(&name, "ros2msg", definition(kind).as_bytes())?;
        self.writer.add_channel(schema, topic, "cdr", &BTreeMap::new())
    }

    /// Where robots are, in metres, each turned to a direction of length 1.
    pub(crate) fn poses(
        &mut self,
        topic: &'static str,
        at_ns: u64,
        poses: &[([f64; 2], [f64; 2])],
    ) -> Result<(), Diagnostic> {
        let mut message = headed(at_ns);
        message.list(poses, |cdr, &([x, y], [east, north])| {
            // Half of the angle from the east, without its sine and cosine: those differ from library to library.
            let half = |twice_squared: f64| (twice_squared.max(0.0) / 2.0).sqrt();
            cdr.f64s([x, y, 0.0, 0.0, 0.0, half(1.0 - east).copysign(north), half(1.0 + east)]);
        });
        self.send(topic, "geometry_msgs/PoseArray", at_ns, &message.into_bytes())
    }

    /// A drawing by points in metres, each with its colour. One without points takes back the one before it.
    pub(crate) fn marker(
        &mut self,
        topic: &'static str,
        at_ns: u64,
        drawing: &Drawing<'_>,
        points: &[([f64; 2], Ink)],
    ) -> Result<(), Diagnostic> {
        let mut message = headed(at_ns);
        message.string(drawing.name);
        for number in [0, drawing.shape as i32, if points.is_empty() { DELETE } else { ADD }] {
            message.i32(number);
        }
        message.f64s([0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0]);
        message.f64s([drawing.width_m, drawing.width_m, 0.0]);
        colour(&mut message, PURPLE);
        // For ever, and not locked to the frame.
        stamp(&mut message, 0);
        message.bool(false);
        message.list(points, |cdr, &([x, y], _)| cdr.f64s([x, y, 0.0]));
        message.list(points, |cdr, &(_, ink)| colour(cdr, ink));
        // No texture: its name, its image with a header and of no format, and no place in it; no text, and no mesh.
        message.string("");
        stamp(&mut message, 0);
        message.string("");
        message.string("");
        message.length(0);
        message.length(0);
        message.string("");
        message.string("");
        message.string("");
        message.length(0);
        message.bool(false);
        self.send(topic, "visualization_msgs/Marker", at_ns, &message.into_bytes())
    }

    /// Writes what is left.
    pub(crate) fn end(mut self) -> Result<(), Diagnostic> {
        self.writer.finish().map(|_| ()).map_err(unwritten)
    }
}

/// A drawing in a recording.
pub(crate) struct Drawing<'a> {
    pub(crate) name: &'a str,
    pub(crate) shape: Shape,
    /// How wide a line or a point is.
    pub(crate) width_m: f64,
}

/// How the points of a drawing are taken, by their numbers in `visualization_msgs/Marker`.
#[derive(Clone, Copy)]
pub(crate) enum Shape {
    /// Two and two are the ends of a line.
    Lines = 5,
    /// Each is one.
    Points = 8,
}

/// A time.
pub(crate) fn stamp(message: &mut Cdr, at_ns: u64) {
    message.i32((at_ns / 1_000_000_000) as i32);
    message.u32((at_ns % 1_000_000_000) as u32);
}

/// A message that begins with a header.
pub(crate) fn headed(at_ns: u64) -> Cdr {
    let mut message = Cdr::new();
    stamp(&mut message, at_ns);
    message.string(FRAME);
    message
}

fn colour(message: &mut Cdr, [red, green, blue]: Ink) {
    for part in [red, green, blue, 1.0] {
        message.f32(part);
    }
}

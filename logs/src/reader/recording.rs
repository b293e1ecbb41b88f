//! Recordings in MCAP. Positions are taken of messages in CDR of the types that are listed here, and of messages in
//! JSON. The robot is the topic; in a list of poses the topic with the place in the list behind it, in a list of
//! transforms the frame that moves.

use std::collections::BTreeSet;

use mcap::records::op;
use mcap::{McapError, MessageStream};
use serde_json::{Map, Value};

use super::cdr::Cdr;
use super::lines;
use super::log::{Fault, Form, Log, Pose, Reading, micros};

/// The messages of ROS 2 that have positions.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Kind {
    /// `PoseStamped`, `PoseWithCovarianceStamped`: a header and a pose first.
    Pose,
    /// `Odometry`: a name between them.
    Odometry,
    /// `PoseArray`.
    Poses,
    /// `TFMessage`.
    Transforms,
}

const KINDS: [(&str, Kind); 5] = [
    ("geometry_msgs/msg/PoseStamped", Kind::Pose),
    ("geometry_msgs/msg/PoseWithCovarianceStamped", Kind::Pose),
    ("nav_msgs/msg/Odometry", Kind::Odometry),
    ("geometry_msgs/msg/PoseArray", Kind::Poses),
    ("tf2_msgs/msg/TFMessage", Kind::Transforms),
];

/// Numbers in a pose, and in a transform: three of the place, four of the turn.
const IN_POSE: usize = 7;

/// The positions of a message.
struct Taker<'a> {
    reading: &'a mut Reading,
    topic: &'a str,
    message: u32,
    log_us: i64,
}

impl Taker<'_> {
    /// Takes the position of a robot by its name. A stamp of 0 is one that nobody has set.
    fn take(&mut self, (seconds, nanos): (i32, u32), robot: &str, metres: [f64; 2]) -> Result<(), Fault> {
        let stamp = if (seconds, nanos) == (0, 0) { None } else { micros(seconds.into(), nanos.into()) };
        let pose = Pose { at_us: stamp.unwrap_or(self.log_us), robot, mm: metres.map(|along| along * 1e3) };
        self.reading.take(self.message, pose)
    }

    /// Takes what a message in CDR says; `None` if it ends too early.
    fn cdr(&mut self, kind: Kind, cdr: &mut Cdr<'_>) -> Option<Result<(), Fault>> {
        if kind == Kind::Transforms {
            for _ in 0..cdr.u32()? {
                let stamp = cdr.stamp()?;
                self.reading.frame(cdr.text()?);
                let (robot, metres) = (cdr.text()?, cdr.first_two_of(IN_POSE)?);
                if let fault @ Err(_) = self.take(stamp, robot, metres) {
                    return Some(fault);
                }
            }
            return Some(Ok(()));
        }
        let stamp = cdr.stamp()?;
        self.reading.frame(cdr.text()?);
        match kind {
            Kind::Pose | Kind::Transforms => {}
            Kind::Odometry => drop(cdr.text()?),
            Kind::Poses => {
                for number in 1..=cdr.u32()? {
                    let metres = cdr.first_two_of(IN_POSE)?;
                    let robot = format!("{}/{number}", self.topic);
                    if let fault @ Err(_) = self.take(stamp, &robot, metres) {
                        return Some(fault);
                    }
                }
                return Some(Ok(()));
            }
        }
        let metres = cdr.first_two_of(IN_POSE)?;
        Some(self.take(stamp, self.topic, metres))
    }
}

pub(super) fn read(bytes: &[u8]) -> Result<Log, Fault> {
    let mut reading = Reading::new(Form::Mcap);
    let (mut number, mut others) = (0_u32, BTreeSet::new());
    if !bytes.starts_with(mcap::MAGIC) {
        return Err(unread(0, &McapError::BadMagic));
    }
    if overruns(bytes) {
        return Err(Fault::whole("a record of this MCAP says that it ends where none can", REPAIR));
    }
    let stream = MessageStream::new(bytes).map_err(|error| unread(0, &error))?;
    for message in stream {
        number = number.saturating_add(1);
        let message = match message {
            Ok(message) => message,
            // The file ends in the midst, or without its end.
            Err(
                McapError::UnexpectedEof
                | McapError::UnexpectedEoc
                | McapError::BadMagic
                | McapError::BadFooter,
            ) => {
                reading.log.cut = Some(number);
                break;
            }
            Err(error) => return Err(unread(number, &error)),
        };
        let channel = &message.channel;
        let name = channel.schema.as_ref().map_or("", |schema| &schema.name);
        let log_us = (message.log_time / 1_000) as i64;
        let kind = KINDS.iter().find(|(known, _)| *known == name).map(|&(_, kind)| kind);
        match (channel.message_encoding.as_str(), kind) {
            ("cdr", Some(kind)) => {
                let mut taker =
                    Taker { reading: &mut reading, topic: &channel.topic, message: number, log_us };
                let taken = Cdr::new(&message.data).and_then(|mut cdr| taker.cdr(kind, &mut cdr));
                taken.ok_or_else(|| {
                    let what = format!("this message on {} is no {name} in CDR", channel.topic);
                    Fault::message(number, what, "record it anew, or leave the topic out")
                })??;
            }
            ("json", _) => {
                let object = serde_json::from_slice::<Map<String, Value>>(&message.data).unwrap_or_default();
                match lines::pose(&object, Some(log_us)) {
                    Ok((at_us, mm)) => reading.take(number, Pose { at_us, robot: &channel.topic, mm })?,
                    Err(_) => drop(others.insert(channel.topic.clone())),
                }
            }
            (encoding, _) => drop(others.insert(format!("{name} in {encoding}"))),
        }
    }
    if reading.log.samples.is_empty() && !others.is_empty() {
        let others: Vec<_> = others.into_iter().take(8).collect();
        let known = KINDS.map(|(name, _)| name).join(", ");
        let what = format!("the recording has no position: its messages are {}", others.join(", "));
        return Err(Fault::whole(what, format!("record {known} in CDR, or poses in JSON")));
    }
    Ok(reading.log)
}

/// Whether a record says that it ends behind its chunk, or behind all bytes that there can be: the reader does not
/// check that. What ends behind the recording alone is cut.
fn overruns(bytes: &[u8]) -> bool {
    let mut rest = bytes.get(mcap::MAGIC.len()..).unwrap_or_default();
    while let Some((kind, length, behind)) = record(rest) {
        let content = behind.get(..length as usize).unwrap_or(behind);
        let is_whole = content.len() as u64 == length;
        if length >= isize::MAX as u64 || kind == op::CHUNK && is_overrun(content, length).unwrap_or(is_whole)
        {
            return true;
        }
        if kind == op::FOOTER || !is_whole {
            break;
        }
        rest = &behind[length as usize..];
    }
    false
}

/// Whether records of a chunk that has so many bytes, or more than are there, end behind it; `None` if it ends before
/// that can be told.
fn is_overrun(chunk: &[u8], length: u64) -> Option<bool> {
    // Two times, the size once it is unpacked, and a checksum; then the name of the compression.
    let rest = chunk.get(3 * 8 + 4..)?;
    let (name, rest) = rest.split_first_chunk()?;
    let rest = rest.get(u32::from_le_bytes(*name) as usize..)?;
    let (left, mut rest) = rest.split_first_chunk()?;
    let mut left = u64::from_le_bytes(*left);
    if left > length - (chunk.len() - rest.len()) as u64 {
        return Some(true);
    }
    while left > 0 && *name == [0; 4] {
        let Some((_, length, behind)) = record(rest) else { return Some(left < RECORD) };
        let Some(after) = left.checked_sub(RECORD).and_then(|left| left.checked_sub(length)) else {
            return Some(true);
        };
        (left, rest) = (after, behind.get(length as usize..)?);
    }
    Some(false)
}

/// Bytes of a record before its content: its kind and its length.
const RECORD: u64 = 9;

/// The kind and the length of the record that begins here, and the bytes behind them.
fn record(bytes: &[u8]) -> Option<(u8, u64, &[u8])> {
    let (&kind, rest) = bytes.split_first()?;
    let (length, rest) = rest.split_first_chunk()?;
    Some((kind, u64::from_le_bytes(*length), rest))
}

const REPAIR: &str = "record it anew, or repair it, as `mcap recover` does";

fn unread(message: u32, error: &McapError) -> Fault {
    let remedy = match error {
        McapError::UnsupportedCompression(_) => "unpack its chunks, as `mcap decompress` does",
        _ => REPAIR,
    };
    if message == 0 {
        return Fault::whole(format!("this is no MCAP: {error}"), remedy);
    }
    Fault::message(message, format!("the recording is damaged: {error}"), remedy)
}

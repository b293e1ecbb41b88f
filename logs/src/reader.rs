//! Reading a log: its form is told by its first bytes, and each form yields the same samples.

mod cdr;
mod columns;
mod lines;
mod log;
mod recording;
mod table;

pub use self::log::{Fault, FaultPlace, Form, Log, MOST_SAMPLES, Sample};

/// The byte order mark that some editors put before a text; it is no part of it.
pub(crate) const BOM: &str = "\u{feff}";

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

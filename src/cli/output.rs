//! Stdout. A reader that has gone away, as in `tautline … | head`, ends the printing and not the work, so that the exit
//! code is that of the whole.

use std::fmt;
use std::io::{self, BufWriter, ErrorKind, StdoutLock, Write};

use serde::Serialize;

use super::SCHEMA_VERSION;
use crate::fault::Fault;

pub(super) struct Output(Option<BufWriter<StdoutLock<'static>>>);

/// What every JSON object begins with.
#[derive(Serialize)]
struct Versioned<'a, T> {
    schema_version: u32,
    #[serde(flatten)]
    content: &'a T,
}

impl Output {
    pub(super) fn stdout() -> Self {
        Self(Some(BufWriter::new(io::stdout().lock())))
    }

    /// Prints `text` as it is.
    pub(super) fn text(&mut self, text: impl fmt::Display) -> Result<(), Fault> {
        write!(self, "{text}").map_err(|error| unwritable(&error))
    }

    /// Prints bytes as they are.
    pub(super) fn bytes(&mut self, bytes: &[u8]) -> Result<(), Fault> {
        self.write_all(bytes).map_err(|error| unwritable(&error))
    }

    /// Prints `content` as one JSON object on one line.
    pub(super) fn json(&mut self, content: &impl Serialize) -> Result<(), Fault> {
        let versioned = Versioned { schema_version: SCHEMA_VERSION, content };
        let written = serde_json::to_writer(&mut *self, &versioned).map_err(io::Error::from);
        written.and_then(|()| writeln!(self)).map_err(|error| unwritable(&error))
    }

    fn unless_gone<T>(
        &mut self,
        done: T,
        act: impl FnOnce(&mut BufWriter<StdoutLock<'static>>) -> io::Result<T>,
    ) -> io::Result<T> {
        let Some(stdout) = &mut self.0 else { return Ok(done) };
        match act(stdout) {
            Err(error) if error.kind() == ErrorKind::BrokenPipe => {
                // What is still buffered has no reader: it is not to be written when dropped.
                if let Some(stdout) = self.0.take() {
                    let _ = stdout.into_parts();
                }
                Ok(done)
            }
            result => result,
        }
    }
}

impl Write for Output {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.unless_gone(bytes.len(), |stdout| stdout.write(bytes))
    }

    fn flush(&mut self) -> io::Result<()> {
        self.unless_gone((), Write::flush)
    }
}

pub(super) fn unwritable(error: &io::Error) -> Fault {
    Fault::in_file("standard output", error, "make room, or send it elsewhere")
}

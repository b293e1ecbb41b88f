//! The output of a command: text on stdout, and files. A reader that has gone away, as in `tautline … | head`, ends the
//! printing and not the work, so that the exit code is that of the whole. A file that cannot be stored is left out, and
//! nothing else.

use std::fmt;
use std::io::{self, BufWriter, ErrorKind, IsTerminal, StdoutLock, Write};
use std::mem;

use schemars::JsonSchema;
use serde::Serialize;
use tautline_io::atomic_file::{self, AtomicFile, FinishedFile};
use tautline_io::diagnostic::{Diagnostic, Halt};

use super::ascii;
use super::report::{Colour, render};

/// The version of every JSON object on stdout.
pub(super) const SCHEMA_VERSION: u32 = 1;

pub(super) struct Output {
    /// Unless its reader has gone away.
    stdout: Option<BufWriter<StdoutLock<'static>>>,
    /// Files that are written to their ends, and stand in their places when the command ends: all, or none of them.
    files: Vec<FinishedFile>,
    has_left_out: bool,
}

/// The beginning of every JSON object.
#[derive(JsonSchema, Serialize)]
pub(super) struct VersionedJson<'a, T> {
    schema_version: u32,
    #[serde(flatten)]
    content: &'a T,
}

/// `path` as an argument of a command that a person pastes into a shell.
pub(super) fn argument(path: &str) -> String {
    if ascii::is_asked() && !path.is_ascii() {
        return ascii::quoted(path);
    }
    let is_plain = |sign: char| sign.is_alphanumeric() || "/._-+,:=@%".contains(sign);
    let path = if path.starts_with('-') { format!("./{path}") } else { path.to_owned() };
    if path.chars().all(is_plain) { path } else { format!("'{}'", path.replace('\'', r"'\''")) }
}

/// The line that says how to see the run of a file again.
pub(super) fn replay_line(file: &str) -> String {
    format!("replay it with: tautline replay {}\n", argument(file))
}

impl Output {
    pub(super) fn stdout() -> Self {
        Self { stdout: Some(BufWriter::new(io::stdout().lock())), files: Vec::new(), has_left_out: false }
    }

    /// Leaves stdout to somebody else.
    #[cfg(feature = "mcp")]
    pub(super) fn leave(&mut self) {
        self.stdout = None;
    }

    /// Writes a file, if it has a place, and keeps it until the command ends.
    ///
    /// # Errors
    /// [`Halt`], as of `write`.
    pub(super) fn store(
        &mut self,
        file: Option<AtomicFile>,
        write: impl FnOnce(&mut AtomicFile) -> Result<(), Halt>,
    ) -> Result<(), Halt> {
        let Some(mut file) = file else { return Ok(()) };
        write(&mut file)?;
        self.keep(file);
        Ok(())
    }

    /// Keeps a file until the command ends. Whether it will stand in its place; otherwise it is left out.
    pub(super) fn keep(&mut self, file: AtomicFile) -> bool {
        let finished = file.finish().map_err(|fault| self.leave_out(&fault));
        finished.map(|file| self.files.push(file)).is_ok()
    }

    /// Puts all files that were kept in their places.
    pub(super) fn place(&mut self) {
        for fault in atomic_file::place(mem::take(&mut self.files)) {
            self.leave_out(&fault);
        }
    }

    /// Tells why a file is left out. The command goes on, and ends as one with a fault.
    pub(super) fn leave_out(&mut self, fault: &Diagnostic) {
        complain(fault);
        self.has_left_out = true;
    }

    /// Whether a file was left out.
    pub(super) const fn has_left_out(&self) -> bool {
        self.has_left_out
    }

    /// Whether nobody reads any more what is printed.
    pub(super) const fn is_gone(&self) -> bool {
        self.stdout.is_none()
    }

    /// Prints `text`, in signs of ASCII if that is asked for.
    pub(super) fn text(&mut self, text: impl fmt::Display) -> Result<(), Diagnostic> {
        let written = if ascii::is_asked() {
            self.write_all(ascii::plain(&text.to_string()).as_bytes())
        } else {
            write!(self, "{text}")
        };
        written.map_err(|error| unwritable(&error))
    }

    /// Prints bytes as they are.
    pub(super) fn bytes(&mut self, bytes: &[u8]) -> Result<(), Diagnostic> {
        self.write_all(bytes).map_err(|error| unwritable(&error))
    }

    /// Prints `content` as one JSON object on one line.
    pub(super) fn json(&mut self, content: &impl Serialize) -> Result<(), Diagnostic> {
        let versioned = VersionedJson { schema_version: SCHEMA_VERSION, content };
        let written = if ascii::is_asked() {
            let json = serde_json::to_string(&versioned).map_err(io::Error::from);
            json.and_then(|json| self.write_all(ascii::json(json).as_bytes()))
        } else {
            serde_json::to_writer(&mut *self, &versioned).map_err(io::Error::from)
        };
        written.and_then(|()| writeln!(self)).map_err(|error| unwritable(&error))
    }

    fn unless_gone<T>(
        &mut self,
        done: T,
        act: impl FnOnce(&mut BufWriter<StdoutLock<'static>>) -> io::Result<T>,
    ) -> io::Result<T> {
        let Some(stdout) = &mut self.stdout else { return Ok(done) };
        match act(stdout) {
            Err(error) if error.kind() == ErrorKind::BrokenPipe => {
                // What is still buffered has no reader: it is not to be written when dropped.
                if let Some(stdout) = self.stdout.take() {
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

pub(super) fn unwritable(error: &io::Error) -> Diagnostic {
    Diagnostic::in_file("standard output", error, "make room, or send it elsewhere")
}

/// Tells on stderr what went wrong, if anybody is there to read it.
pub(super) fn complain(fault: &Diagnostic) {
    let _ = ascii::Stderr.write_all(render(fault, colour()).as_bytes());
}

pub(super) fn colour() -> Colour {
    if ascii::is_asked() {
        return Colour::Ascii;
    }
    let is_refused = std::env::var_os("NO_COLOR").is_some_and(|value| !value.is_empty());
    if io::stderr().is_terminal() && !is_refused { Colour::Ansi } else { Colour::Plain }
}

//! Stored files of JSON lines, read one at a time and compared with what their header makes. A line that is not as it
//! should be is a fault with its place.

use std::fmt::{self, Display};
use std::fs::File;
use std::io::{BufRead, BufReader, Cursor, Read};
use std::ops::Range;
use std::path::{Path, PathBuf};

use serde::de::IgnoredAny;
use serde::{Deserialize, Serialize};

use crate::diagnostic::{self, BOM, Diagnostic};

/// Larger files are refused before they are read. The drawing of the largest layout is smaller.
pub const MAX_FILE_BYTES: u64 = 128 << 20;

/// Longer lines are refused; the header with its drawing may be longer. The end of a run that breaks clauses in a
/// million team moves is shorter.
pub const MAX_LINE_BYTES: u64 = 1 << 26;

/// The beginning of a header, in every version.
#[derive(Deserialize)]
pub(crate) struct Magic {
    format: String,
    version: u32,
}

impl Magic {
    /// The field in which it is not that of a `format` of this `version`, and what is wrong with it.
    pub(crate) fn differs(&self, format: &str, version: u32) -> Option<(&'static str, String)> {
        let Self { format: found, version: other } = self;
        if found != format {
            Some(("format", format!("the format is {found:?}")))
        } else if *other != version {
            Some(("version", format!("this is version {other}, this program reads version {version}")))
        } else {
            None
        }
    }
}

/// A line of a file: `value`, and its end.
pub fn line_of(value: &impl Serialize) -> String {
    // Strings, numbers and lists of them can always be written.
    serde_json::to_string(value).unwrap_or_default() + "\n"
}

/// The format that the first line of a file names, if it names one. Nothing is taken out of a pipe.
pub fn format(path: &Path) -> Option<String> {
    if !path.is_file() {
        return None;
    }
    let mut bytes = Vec::new();
    let file = File::open(path).ok()?;
    BufReader::new(file).take(MAX_FILE_BYTES).read_until(b'\n', &mut bytes).ok()?;
    let text = str::from_utf8(&bytes).ok()?;
    serde_json::from_str(text.strip_prefix(BOM).unwrap_or(text)).ok().map(|magic: Magic| magic.format)
}

/// The lines of a file, one at a time.
pub struct Lines {
    path: PathBuf,
    input: Box<dyn BufRead + Send>,
    /// How many were read.
    count: usize,
    /// How to make such a file again.
    again: &'static str,
}

impl fmt::Debug for Lines {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Lines").field("path", &self.path).field("count", &self.count).finish_non_exhaustive()
    }
}

impl Lines {
    /// The lines of the file at `path`; `again` says how to make such a file.
    ///
    /// # Errors
    /// A [`Diagnostic`] if it cannot be opened.
    pub fn open(path: &Path, again: &'static str) -> Result<Self, Diagnostic> {
        let unopened = |what: String| {
            Diagnostic::in_file(path, what, "name a file that `trace` or `tautline hunt` wrote")
        };
        if path.is_dir() {
            return Err(unopened("this is a folder".to_owned()));
        }
        if path.exists() && !path.is_file() {
            let what = "this is a pipe or a device, and a stored run is read more than once";
            return Err(Diagnostic::in_file(path, what, "store it in a file first"));
        }
        let file = File::open(path).map_err(|error| unopened(diagnostic::unreadable(&error)))?;
        if let Ok(about) = file.metadata() {
            let bytes = about.len();
            tracing::info!("reading {}: {bytes} byte{}", path.display(), if bytes == 1 { "" } else { "s" });
        }
        Ok(Self { path: path.to_owned(), input: Box::new(BufReader::new(file)), count: 0, again })
    }

    /// The lines of a `text` that is called so; `again` says how to make one.
    pub fn of(name: &str, text: String, again: &'static str) -> Self {
        Self { path: name.into(), input: Box::new(Cursor::new(text)), count: 0, again }
    }

    /// These lines, with other words for how to make such a file again.
    pub fn made_by(self, again: &'static str) -> Self {
        Self { again, ..self }
    }

    /// The file.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// The first line, of at most `most` bytes, if it is the header of a `format` of this `version`.
    ///
    /// # Errors
    /// A [`Diagnostic`] that says what it is instead.
    pub fn header(&mut self, format: &str, version: u32, most: u64) -> Result<String, Diagnostic> {
        let text = self.next(most)?.ok_or_else(|| {
            let remedy = format!("a trace begins with its header; {}", self.again);
            Diagnostic::in_file(&self.path, "the file is empty", remedy)
        })?;
        let magic: Magic =
            self.parse(&text, "a trace begins with its header; name a file that `trace` wrote")?;
        match magic.differs(format, version) {
            None => Ok(text),
            Some((field @ "format", what)) => {
                Err(self.fault(&text, field, what, format_args!("name a {format:?}")))
            }
            Some((field, what)) => Err(self.fault(&text, field, what, self.again)),
        }
    }

    /// The next line without its end, at most `most` bytes; `None` after the last.
    ///
    /// # Errors
    /// A [`Diagnostic`] if it cannot be read, is longer, or no text.
    pub fn next(&mut self, most: u64) -> Result<Option<String>, Diagnostic> {
        if self.count == 0 {
            self.skip_bom();
        }
        let mut bytes = Vec::new();
        let read = self.input.by_ref().take(most + 1).read_until(b'\n', &mut bytes);
        let read = read.map_err(|error| {
            let remedy = "make it readable";
            Diagnostic::in_file(&self.path, format_args!("the file cannot be read: {error}"), remedy)
        })?;
        if read == 0 {
            return Ok(None);
        }
        self.count += 1;
        let is_long = bytes.len() as u64 > most;
        let not_text = |bytes: &[u8]| {
            let line = String::from_utf8_lossy(bytes);
            let at = line.find(char::REPLACEMENT_CHARACTER).unwrap_or_default();
            Diagnostic::in_line(
                &self.path,
                self.count,
                &line,
                at..at + 1,
                "this is not UTF-8 text",
                self.again,
            )
        };
        let mut text = String::from_utf8(bytes).map_err(|error| not_text(error.as_bytes()))?;
        if is_long {
            return Err(self.whole(&text, format_args!("this line has more than {most} bytes"), self.again));
        }
        text.truncate(text.trim_end_matches(['\n', '\r']).len());
        Ok(Some(text))
    }

    /// Leaves out a byte order mark. What cannot be read is told by whoever reads on.
    fn skip_bom(&mut self) {
        let mut bom = [0; BOM.len_utf8()];
        let bom = BOM.encode_utf8(&mut bom).as_bytes();
        if self.input.fill_buf().is_ok_and(|text| text.starts_with(bom)) {
            self.input.consume(bom.len());
        }
    }

    /// Checks that the next line is `expected`.
    ///
    /// # Errors
    /// A [`Diagnostic`] where it first differs.
    pub fn expect<T>(&mut self, expected: &T) -> Result<(), Diagnostic>
    where
        T: Serialize + PartialEq + for<'a> Deserialize<'a>,
    {
        let wanted = line_of(expected);
        let Some(text) = self.next(MAX_LINE_BYTES)? else {
            let what =
                format!("the trace ends after line {}; here the run has {}", self.count, wanted.trim_end());
            return Err(Diagnostic::in_file(&self.path, what, self.again));
        };
        let found: T = self.parse(&text, self.again)?;
        if found == *expected {
            return Ok(());
        }
        Err(self.differs(&text, expected, "the rule does not make this run; here it has"))
    }

    /// A fault where the line begins to differ from `expected`, which stands behind `what`.
    pub fn differs(&self, text: &str, expected: &impl Serialize, what: &str) -> Diagnostic {
        let wanted = line_of(expected);
        let same = text.bytes().zip(wanted.bytes()).take_while(|(one, other)| one == other).count();
        self.at(text, same..same + 1, format_args!("{what} {}", wanted.trim_end()), self.again)
    }

    /// Checks that there is no line left.
    ///
    /// # Errors
    /// A [`Diagnostic`] if there is one.
    pub fn end(&mut self) -> Result<(), Diagnostic> {
        match self.next(MAX_LINE_BYTES)? {
            Some(text) if !text.trim().is_empty() => {
                Err(self.whole(&text, "a line after the end", "leave it out"))
            }
            Some(_) | None => Ok(()),
        }
    }

    /// The value that a line holds.
    ///
    /// # Errors
    /// A [`Diagnostic`] where it is no such thing.
    pub fn parse<'a, T: Deserialize<'a>>(&self, text: &'a str, remedy: &str) -> Result<T, Diagnostic> {
        parse(text).map_err(|(column, message)| self.no_line_at(text, column, message, remedy))
    }

    fn no_line_at(&self, text: &str, column: usize, what: impl Display, remedy: &str) -> Diagnostic {
        let what = format_args!("this is no line of a stored run: {what}");
        self.at(text, column..column + 1, what, remedy)
    }

    /// A fault at the end of the value that `key` has in the line, which is none.
    pub fn no_line(&self, text: &str, key: &str, what: impl Display, remedy: &str) -> Diagnostic {
        self.no_line_at(text, value_of(text, key).end.saturating_sub(1), what, remedy)
    }

    /// A fault where `key` stands in the line.
    pub fn fault(&self, text: &str, key: &str, what: impl Display, remedy: impl Display) -> Diagnostic {
        self.at(text, key_of(text, key), what, remedy)
    }

    /// A fault in the value that `key` has in the line.
    pub fn fault_in(&self, text: &str, key: &str, what: impl Display, remedy: impl Display) -> Diagnostic {
        self.at(text, value_of(text, key), what, remedy)
    }

    /// A fault of the line.
    pub fn whole(&self, text: &str, what: impl Display, remedy: impl Display) -> Diagnostic {
        self.at(text, 0..text.len(), what, remedy)
    }

    fn at(&self, text: &str, range: Range<usize>, what: impl Display, remedy: impl Display) -> Diagnostic {
        Diagnostic::in_line(&self.path, self.count, text, range, what, remedy)
    }
}

/// The value that a line holds.
///
/// # Errors
/// The column, from 0 on, at which the line holds no such value, and the reason.
pub fn parse<'a, T: Deserialize<'a>>(text: &'a str) -> Result<T, (usize, String)> {
    serde_json::from_str(text).map_err(|error| {
        let message = error.to_string();
        let message = message.split(" at line ").next().unwrap_or_default();
        (error.column().saturating_sub(1), in_words_of_json(message))
    })
}

/// A message of the parser in which types of programs are those of JSON.
fn in_words_of_json(message: &str) -> String {
    let message = match message.split_once("EOF while parsing ") {
        Some((_, within)) => format!("the line ends within {within}"),
        None => message.replace("invalid type: map", "invalid type: object"),
    };
    let message = message.replace("invalid type: sequence", "invalid type: list");
    let Some((found, expected)) = message.split_once("expected ") else { return message };
    let kind = match expected.split(' ').next().unwrap_or_default() {
        "struct" | "map" | "enum" | "internally" | "adjacently" => "an object",
        "u8" | "u16" | "u32" | "u64" | "usize" => "a whole number from 0 on that is not too large",
        "i8" | "i16" | "i32" | "i64" => "a whole number that is not too large",
        "f32" | "f64" => "a number",
        "tuple" => "a list",
        "ident" => "value",
        _ => match expected {
            "a map" => "an object",
            "a sequence" => "a list",
            _ if expected.starts_with("a nonzero u") => "a whole number from 1 on that is not too large",
            _ => return message,
        },
    };
    format!("{found}expected {kind}")
}

/// Where `key` stands in a line.
pub fn key_of(text: &str, key: &str) -> Range<usize> {
    let name = format!("\"{key}\"");
    let start = text.find(&name).unwrap_or_default();
    start..start + name.len()
}

/// Where the value stands that `key` has in a line.
pub(crate) fn value_of(text: &str, key: &str) -> Range<usize> {
    let name = format!("\"{key}\"");
    let rest = text.find(&name).map_or(text, |start| &text[start + name.len()..]);
    let start = text.len() - rest.trim_start_matches([' ', ':']).len();
    let mut values = serde_json::Deserializer::from_str(&text[start..]).into_iter::<IgnoredAny>();
    let _ = values.next();
    start..start + values.byte_offset()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_wrong_with_a_line_is_said_in_words_of_json() {
        let said = |text| parse::<Magic>(text).map(|_| ()).expect_err("no header").1;
        assert_eq!(said("[]"), "invalid length 0, expected an object");
        assert_eq!(said("7"), "invalid type: integer `7`, expected an object");
        assert_eq!(said(r#"{"format":{}}"#), "invalid type: object, expected a string");
        let version = said(r#"{"format":"","version":-1}"#);
        let wanted = "a whole number from 0 on that is not too large";
        assert_eq!(version, format!("invalid value: integer `-1`, expected {wanted}"));
        assert_eq!(said("{"), "the line ends within an object");
    }
}

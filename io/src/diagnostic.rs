//! A fault of something the user gave, its place, and its remedy: the one error type of all that is not a rule, as
//! data. How it is shown, and by which flag a field is given, is the caller's business. A fault in a text keeps only
//! the line it points at, clipped, however large the file.

use std::convert::Infallible;
use std::fmt;
use std::io::{self, ErrorKind};
use std::ops::Range;
use std::path::Path;

/// Characters of the offending line kept on each side of the spot.
const CLIP_CHARS: usize = 32;

/// Longer names and messages are clipped: they may quote the input.
const MAX_MESSAGE_CHARS: usize = 1_000;

/// Numbers with more digits are shortened. Twenty are the most of a number of 64 bits.
const MAX_DIGITS: usize = 24;

/// The byte order mark that some editors put before a text; it is no part of it.
pub const BOM: char = '\u{feff}';

/// A place, what is wrong there, and the remedy. `Display` is one plain line,
/// `file:line:column: what; remedy`.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Diagnostic(Box<Parts>);

#[derive(Clone, PartialEq, Eq, Debug)]
struct Parts {
    place: Place,
    what: String,
    remedy: String,
}

/// Where a fault is. Its `Display` ends with a colon and a blank, or is empty.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Place {
    /// In what was asked for.
    Request {
        /// The field that is wrong, if one alone is.
        field: Option<&'static str>,
    },
    /// In a file as a whole.
    File(String),
    /// In a text.
    Spot {
        /// The file's name.
        file: String,
        /// Line, from 1.
        line: usize,
        /// Column, from 1, in characters.
        column: usize,
        /// The line there.
        excerpt: Excerpt,
    },
}

/// The neighbourhood of a spot: one line without control characters, clipped, and the bytes of it that are meant.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Excerpt {
    /// The line.
    pub text: String,
    /// The bytes that are meant, between characters.
    pub mark: Range<usize>,
}

/// Why a piece of work ended before its end.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Halt {
    /// Something was wrong with what the user gave.
    Diagnostic(Diagnostic),
    /// The user asked it to stop.
    Interrupted,
}

impl fmt::Display for Halt {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Diagnostic(fault) => fault.fmt(f),
            Self::Interrupted => f.write_str("interrupted"),
        }
    }
}

impl std::error::Error for Halt {}

impl From<Infallible> for Diagnostic {
    fn from(never: Infallible) -> Self {
        match never {}
    }
}

impl From<Diagnostic> for Halt {
    fn from(fault: Diagnostic) -> Self {
        Self::Diagnostic(fault)
    }
}

/// Is called after each part of a work, from any thread, and may stop the work.
pub type Watch<'a> = dyn Fn() -> Result<(), Halt> + Sync + 'a;

impl Diagnostic {
    /// A fault in the bytes `range` of `text`, the content of `file`. A range that ends beyond its first line
    /// is cut there; one that lies outside the text, or inside a character, is moved to the nearest
    /// character.
    pub fn at(
        file: impl AsRef<Path>,
        text: &str,
        range: Range<usize>,
        what: impl fmt::Display,
        remedy: impl fmt::Display,
    ) -> Self {
        let begin = text.len() - text.strip_prefix(BOM).unwrap_or(text).len();
        let start = text.floor_char_boundary(range.start).max(begin);
        let line_start = text[..start].rfind('\n').map_or(begin, |newline| newline + 1);
        let line_end = text[start..].find('\n').map_or(text.len(), |newline| start + newline);
        let end = text.ceil_char_boundary(range.end).clamp(start, line_end);
        let place = Place::Spot {
            file: name(file.as_ref()),
            line: 1 + text[..start].matches('\n').count(),
            column: 1 + text[line_start..start].chars().count(),
            excerpt: Excerpt::of(&text[line_start..line_end], start - line_start..end - line_start),
        };
        Self::new(place, what, remedy)
    }

    /// A fault in the bytes `range` of `text`, which is line number `line`, counted from 1, of `file`.
    pub fn in_line(
        file: impl AsRef<Path>,
        line: usize,
        text: &str,
        range: Range<usize>,
        what: impl fmt::Display,
        remedy: impl fmt::Display,
    ) -> Self {
        let mut fault = Self::at(file, text, range, what, remedy);
        if let Place::Spot { line: first, .. } = &mut fault.0.place {
            *first += line - 1;
        }
        fault
    }

    /// A fault of a file as a whole.
    pub fn in_file(file: impl AsRef<Path>, what: impl fmt::Display, remedy: impl fmt::Display) -> Self {
        Self::new(Place::File(name(file.as_ref())), what, remedy)
    }

    /// A fault of what was asked for.
    pub fn usage(what: impl fmt::Display, remedy: impl fmt::Display) -> Self {
        Self::new(Place::Request { field: None }, what, remedy)
    }

    /// A fault of one field of what was asked for. Where its words name a field, the name stands between backticks.
    pub fn of_field(field: &'static str, what: impl fmt::Display, remedy: impl fmt::Display) -> Self {
        Self::new(Place::Request { field: Some(field) }, what, remedy)
    }

    fn new(place: Place, what: impl fmt::Display, remedy: impl fmt::Display) -> Self {
        Self(Box::new(Parts {
            place,
            what: one_line(&shortened(&what.to_string())),
            remedy: one_line(&remedy.to_string()),
        }))
    }

    /// Where it is.
    pub const fn place(&self) -> &Place {
        &self.0.place
    }

    /// The field of what was asked for that is wrong, if one alone is.
    pub const fn field(&self) -> Option<&'static str> {
        match self.0.place {
            Place::Request { field } => field,
            Place::File(_) | Place::Spot { .. } => None,
        }
    }

    /// The fault in words, without the place.
    pub fn what(&self) -> &str {
        &self.0.what
    }

    /// The remedy.
    pub fn remedy(&self) -> &str {
        &self.0.remedy
    }

    /// This fault, as one that a whole file has made.
    #[must_use]
    pub fn found_in(mut self, file: impl AsRef<Path>) -> Self {
        self.0.place = Place::File(name(file.as_ref()));
        self
    }

    /// This fault with another remedy.
    #[must_use]
    pub fn with_remedy(mut self, remedy: impl fmt::Display) -> Self {
        self.0.remedy = one_line(&remedy.to_string());
        self
    }
}

impl Excerpt {
    /// `line` round the bytes `mark`, which begin and end between characters. At least one character is
    /// marked, if need be the blank after the line.
    fn of(line: &str, mark: Range<usize>) -> Self {
        let before: Vec<char> = line[..mark.start].chars().rev().take(CLIP_CHARS + 1).collect();
        let mut text = String::new();
        if before.len() > CLIP_CHARS {
            text.push('…');
        }
        text.extend(before.into_iter().take(CLIP_CHARS).rev().map(printable));
        let start = text.len();
        text.extend(line[mark.clone()].chars().take(CLIP_CHARS).map(printable));
        if text.len() == start {
            text.push(line[mark.end..].chars().next().map_or(' ', printable));
        }
        let end = text.len();
        let marked = text[start..end].chars().count().max(1);
        let rest = line[mark.start..].chars().skip(marked);
        text.extend(rest.clone().take(CLIP_CHARS).map(printable));
        if rest.clone().nth(CLIP_CHARS).is_some() {
            text.push('…');
        }
        Self { text, mark: start..end }
    }
}

/// Control characters and the Unicode line ends would break the drawing or steer the terminal.
fn printable(character: char) -> char {
    match character {
        '\t' | '\n' | '\r' | '\u{2028}' | '\u{2029}' => ' ',
        control if control.is_control() => char::REPLACEMENT_CHARACTER,
        other => other,
    }
}

/// Why a file cannot be read, in words.
pub fn unreadable(error: &io::Error) -> String {
    match error.kind() {
        ErrorKind::NotFound | ErrorKind::NotADirectory => "there is no such file".to_owned(),
        ErrorKind::IsADirectory => "this is a folder".to_owned(),
        ErrorKind::PermissionDenied => "this file may not be read".to_owned(),
        _ => format!("the file cannot be read: {error}"),
    }
}

/// Why a place takes no file and no folder, in words. The system's own words stand where there are none.
pub fn unmade(error: &io::Error) -> String {
    let words = match error.kind() {
        ErrorKind::NotFound => "the system makes nothing there",
        ErrorKind::PermissionDenied => "you may not write there",
        ErrorKind::ReadOnlyFilesystem => "the disk there can only be read",
        ErrorKind::StorageFull | ErrorKind::QuotaExceeded => "there is no room for it",
        ErrorKind::InvalidFilename => "its name is longer than the disk takes",
        _ => return error.to_string(),
    };
    words.to_owned()
}

fn name(file: &Path) -> String {
    one_line(&file.to_string_lossy())
}

/// `text` as it may stand in a line that a terminal shows, clipped if it is very long.
pub fn one_line(text: &str) -> String {
    let mut characters = text.chars();
    let mut line: String = characters.by_ref().take(MAX_MESSAGE_CHARS).map(printable).collect();
    if characters.next().is_some() {
        line.push('…');
    }
    line
}

/// `text`, of whose numbers only the first digits stand, if one has more than any number in use: 1e308 has 309.
fn shortened(text: &str) -> String {
    let mut digits = 0;
    let sign = |sign: char| {
        digits = if sign.is_ascii_digit() { digits + 1 } else { 0 };
        match digits {
            0..=MAX_DIGITS => Some(sign),
            _ => (digits == MAX_DIGITS + 1).then_some('…'),
        }
    };
    text.chars().filter_map(sign).collect()
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Request { field: _ } => Ok(()),
            Self::File(file) => write!(f, "{file}: "),
            Self::Spot { file, line, column, excerpt: _ } => write!(f, "{file}:{line}:{column}: "),
        }
    }
}

impl fmt::Display for Diagnostic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}{}; {}", self.0.place, self.0.what, self.0.remedy)
    }
}

impl std::error::Error for Diagnostic {}

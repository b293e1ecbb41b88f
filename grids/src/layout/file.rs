//! The part that the readers of all formats share: a file as text or bytes, the lines of a text with their places, and
//! the faults of what is wrong there.

use std::fmt;
use std::fs::{self, File};
use std::io::Read;
use std::ops::Range;
use std::path::Path;

use tautline_io::diagnostic::{BOM, Diagnostic, unreadable};
use tautline_io::json_lines::MAX_FILE_BYTES;

use super::form::examples;
use super::size::sizes;

/// A problem in the bytes `at` of a text.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Misread {
    /// The bytes of the text.
    pub at: Range<usize>,
    /// The fault in them.
    pub problem: Diagnostic,
}

impl fmt::Display for Misread {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "byte {}: {}", self.at.start, self.problem.what())
    }
}

impl std::error::Error for Misread {}

/// The text of `file`.
pub(super) fn read_text(file: &Path) -> Result<String, Diagnostic> {
    let bytes = read_bytes(file).map_err(|problem| problem.found_in(file))?;
    let not_text = |byte| {
        let remedy = "a layout is a drawing, a MovingAI map or a ROS map's .yaml file";
        Diagnostic::in_file(file, format_args!("byte {byte} is not UTF-8 text"), remedy)
    };
    String::from_utf8(bytes).map_err(|error| not_text(error.utf8_error().valid_up_to()))
}

/// The bytes of `file`, at least one and at most [`MAX_FILE_BYTES`].
pub(super) fn read_bytes(file: &Path) -> Result<Vec<u8>, Diagnostic> {
    let unread = |error| no_file(&unreadable(&error));
    let about = fs::metadata(file).map_err(unread)?;
    if about.is_dir() {
        return Err(no_file("this is a folder"));
    }
    if about.len() > MAX_FILE_BYTES {
        return Err(too_large());
    }
    let mut bytes = Vec::new();
    let opened = File::open(file).map_err(unread)?;
    opened.take(MAX_FILE_BYTES + 1).read_to_end(&mut bytes).map_err(unread)?;
    match bytes.len() as u64 {
        0 => Err(Diagnostic::usage("the file is empty", "a drawing begins with `tautline layout 1`")),
        size @ 1..=MAX_FILE_BYTES => {
            tracing::info!("read {}: {size} B", file.display());
            Ok(bytes)
        }
        _ => Err(too_large()),
    }
}

/// There is no such file.
fn no_file(what: &str) -> Diagnostic {
    Diagnostic::usage(what, format_args!("name a layout file or one of the generators {}", examples()))
}

fn too_large() -> Diagnostic {
    Diagnostic::usage(format!("the file has more than {} MiB", MAX_FILE_BYTES >> 20), sizes())
}

/// The fault of a problem in a text.
pub(super) fn at(file: &Path, source: &str, misread: &Misread) -> Diagnostic {
    Diagnostic::at(file, source, misread.at.clone(), misread.problem.what(), misread.problem.remedy())
}

/// A line without its end (`\n` or `\r\n`), and the byte at which it starts.
#[derive(Clone, Copy)]
pub(super) struct Line<'a> {
    pub(super) text: &'a str,
    start: usize,
}

/// The lines of `source`, blank ones at its end left out, and a byte order mark before them.
pub(super) fn lines(source: &str) -> impl Iterator<Item = Line<'_>> {
    let text = source.strip_prefix(BOM).unwrap_or(source);
    let begin = source.len() - text.len();
    text.trim_end_matches(['\r', '\n']).split('\n').scan(begin, |next, raw| {
        let start = *next;
        *next += raw.len() + 1;
        Some(Line { text: raw.strip_suffix('\r').unwrap_or(raw), start })
    })
}

/// The end of the last line: where what is missing should have stood.
pub(super) fn end(source: &str) -> Range<usize> {
    let end = source.trim_end_matches(['\r', '\n']).len();
    end..end
}

impl Line<'_> {
    /// The problem of the whole line.
    pub(super) fn misread(&self, problem: Diagnostic) -> Misread {
        self.misread_at(0..self.text.len(), problem)
    }

    /// The bytes `range` of this line, as bytes of the whole text.
    pub(super) const fn at(&self, range: Range<usize>) -> Range<usize> {
        self.start + range.start..self.start + range.end
    }

    /// The problem of the bytes `range` of this line.
    pub(super) fn misread_at(&self, range: Range<usize>, problem: Diagnostic) -> Misread {
        Misread { at: self.at(range), problem }
    }

    /// The problem of a symbol that none of the `known` ones is: the characters that begin in the bytes
    /// `range`.
    pub(super) fn unknown(&self, range: Range<usize>, known: &'static str) -> Misread {
        let (start, end) =
            (self.text.floor_char_boundary(range.start), self.text.ceil_char_boundary(range.end));
        let what = format!("the symbol {:?} is unknown", &self.text[start..end]);
        self.misread_at(start..end, Diagnostic::usage(what, known))
    }

    /// Checks that the line has `expected` characters.
    pub(super) fn check_length(&self, expected: usize) -> Result<(), Misread> {
        let found = self.text.chars().count();
        if found == expected {
            return Ok(());
        }
        let what = format!("this row ends after character {found}, not {expected}");
        Err(self.misread(Diagnostic::usage(what, "make all rows equally long")))
    }
}

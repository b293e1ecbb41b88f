//! The lines of a text with their places, whichever way they end.

use std::ops::Range;

use tautline_proofs::plural::counted;

use super::{Misread, Problem};
use crate::diagnostic::BOM;

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
    pub(super) fn misread(&self, problem: Problem) -> Misread {
        self.misread_at(0..self.text.len(), problem)
    }

    /// The problem of the bytes `range` of this line.
    pub(super) fn misread_at(&self, range: Range<usize>, problem: Problem) -> Misread {
        Misread { at: self.start + range.start..self.start + range.end, problem }
    }

    /// The problem of a symbol that none of the `known` ones is: the characters that begin in the bytes
    /// `range`.
    pub(super) fn unknown(&self, range: Range<usize>, known: &'static str) -> Misread {
        let (start, end) =
            (self.text.floor_char_boundary(range.start), self.text.ceil_char_boundary(range.end));
        let what = format!("the symbol {:?} is unknown", &self.text[start..end]);
        self.misread_at(start..end, Problem::new(what, known))
    }

    /// Checks that the line has `expected` characters.
    pub(super) fn check_length(&self, expected: usize) -> Result<(), Misread> {
        let found = self.text.chars().count();
        if found == expected {
            return Ok(());
        }
        let what = format!("this row has {}, not {expected}", counted(found, "character"));
        Err(self.misread(Problem::new(what, "make all rows equally long")))
    }
}

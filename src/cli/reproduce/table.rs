//! A table with a row for each figure and a column for each thing that was measured.

use std::fmt::Write;

/// A table as it is written.
pub(super) struct Table<'a, T> {
    text: String,
    /// How wide the names are.
    width: usize,
    measured: &'a [T],
}

impl<'a, T> Table<'a, T> {
    /// A table under a line that says what was measured.
    pub(super) fn new(heading: String, width: usize, measured: &'a [T]) -> Self {
        Self { text: heading + "\n", width, measured }
    }

    /// The rows that follow are about this.
    pub(super) fn title(&mut self, words: &str) {
        self.text.push_str("\n\n");
        self.text.push_str(words);
    }

    /// A figure of everything that was measured.
    pub(super) fn row(&mut self, name: &str, figure: impl Fn(&T) -> String) {
        // Writing to a string cannot fail.
        let _ = write!(self.text, "\n{name:<0$}", self.width);
        for one in self.measured {
            let _ = write!(self.text, "  {:>14}", figure(one));
        }
    }

    /// The whole table, with what its words mean below.
    pub(super) fn with_notes(self, notes: &str) -> String {
        self.text + "\n\n" + notes + "\n"
    }
}

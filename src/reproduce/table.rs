//! A table with a row for each figure and a column for each thing that was measured.

use std::fmt::Write;

/// A table as it is filled.
pub(super) struct Table<'a, T> {
    heading: String,
    measured: &'a [T],
    lines: Vec<Line>,
}

enum Line {
    /// What the rows that follow are about.
    Title(&'static str),
    /// A figure's name, and the figure of everything that was measured.
    Row(String, Vec<String>),
}

impl<'a, T> Table<'a, T> {
    /// A table under a line that says what was measured.
    pub(super) const fn new(heading: String, measured: &'a [T]) -> Self {
        Self { heading, measured, lines: Vec::new() }
    }

    /// The rows that follow are about this.
    pub(super) fn title(&mut self, words: &'static str) {
        self.lines.push(Line::Title(words));
    }

    /// A figure of everything that was measured.
    pub(super) fn row(&mut self, name: impl Into<String>, figure: impl Fn(&T) -> String) {
        self.lines.push(Line::Row(name.into(), self.measured.iter().map(figure).collect()));
    }

    /// The whole table, with what its words mean below.
    pub(super) fn with_notes(self, notes: &str) -> String {
        let rows = || {
            self.lines.iter().filter_map(|line| match line {
                Line::Title(_) => None,
                Line::Row(name, figures) => Some((name, figures)),
            })
        };
        let width_of = |text: &String| text.chars().count();
        let of_names = rows().map(|(name, _)| width_of(name)).max().unwrap_or(0);
        let of_figures = rows().flat_map(|(_, figures)| figures).map(width_of).max().unwrap_or(0);
        let mut text = self.heading + "\n";
        // Writing to a string cannot fail.
        for line in &self.lines {
            match line {
                Line::Title(words) => {
                    let _ = write!(text, "\n\n{words}");
                }
                Line::Row(name, figures) => {
                    let _ = write!(text, "\n{name:<of_names$}");
                    for figure in figures {
                        let _ = write!(text, "  {figure:>of_figures$}");
                    }
                }
            }
        }
        text + "\n\n" + notes + "\n"
    }
}

//! Text in columns: rows of cells, with titles between them. Widths are counted in characters.

use std::fmt::Write;

/// The side on which a cell stands that is narrower than its column.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Align {
    /// Text.
    Left,
    /// Numbers.
    Right,
}

/// The characters between two columns.
const GAP: usize = 2;

/// Rows of cells. A column is as wide as its widest cell.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct TextTable {
    columns: Vec<Align>,
    lines: Vec<Line>,
}

#[derive(Clone, PartialEq, Eq, Debug)]
enum Line {
    Title(String),
    Row(Vec<String>),
}

impl TextTable {
    /// No row yet, of columns that are set so.
    pub fn new(columns: impl IntoIterator<Item = Align>) -> Self {
        Self { columns: columns.into_iter().collect(), lines: Vec::new() }
    }

    /// The rows that follow are about this; an empty line stands before it.
    pub fn title(&mut self, words: impl Into<String>) {
        self.lines.push(Line::Title(words.into()));
    }

    /// One more row, with a cell for each column.
    pub fn row<C: Into<String>>(&mut self, cells: impl IntoIterator<Item = C>) {
        self.lines.push(Line::Row(cells.into_iter().map(Into::into).collect()));
    }

    /// All lines, each with its end.
    pub fn text(&self) -> String {
        let widths: Vec<usize> = (0..self.columns.len()).map(|place| self.width(place)).collect();
        let mut text = String::new();
        for line in &self.lines {
            match line {
                Line::Title(words) => text.extend(["\n", words]),
                Line::Row(cells) => {
                    for (place, ((cell, align), &width)) in
                        cells.iter().zip(&self.columns).zip(&widths).enumerate()
                    {
                        let gap = if place == 0 { 0 } else { GAP };
                        // Writing to a string cannot fail.
                        let _ = match align {
                            Align::Right => write!(text, "{:gap$}{cell:>width$}", ""),
                            Align::Left if place + 1 == cells.len() => write!(text, "{:gap$}{cell}", ""),
                            Align::Left => write!(text, "{:gap$}{cell:<width$}", ""),
                        };
                    }
                }
            }
            text.push('\n');
        }
        text
    }

    fn width(&self, column: usize) -> usize {
        let cells = self.lines.iter().filter_map(|line| match line {
            Line::Title(_) => None,
            Line::Row(cells) => cells.get(column),
        });
        cells.map(|cell| cell.chars().count()).max().unwrap_or(0)
    }
}

/// A row for each figure, and a column for each thing that was measured.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Figures<'a, T> {
    heading: String,
    measured: &'a [T],
    columns: TextTable,
}

impl<'a, T> Figures<'a, T> {
    /// No figure yet, under a line that says what was measured.
    pub fn new(heading: String, measured: &'a [T]) -> Self {
        let columns = TextTable::new([Align::Left].into_iter().chain(measured.iter().map(|_| Align::Right)));
        Self { heading, measured, columns }
    }

    /// The rows that follow are about this.
    pub fn title(&mut self, words: &str) {
        self.columns.title(words);
    }

    /// A figure of everything that was measured.
    pub fn row(&mut self, name: impl Into<String>, figure: impl Fn(&T) -> String) {
        self.columns.row([name.into()].into_iter().chain(self.measured.iter().map(figure)));
    }

    /// The whole text, with what its words mean below.
    pub fn with_notes(self, notes: &str) -> String {
        format!("{}\n\n{}\n{notes}\n", self.heading, self.columns.text())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_are_as_wide_as_their_widest_cells() {
        let mut columns = TextTable::new([Align::Left, Align::Right, Align::Left]);
        columns.row(["name", "1", "a"]);
        columns.title("more");
        columns.row(["é", "22222", "last"]);
        assert_eq!(columns.text(), "name      1  a\n\nmore\né     22222  last\n");
    }

    #[test]
    fn figures_stand_between_a_heading_and_notes() {
        let mut figures = Figures::new("Two numbers".to_owned(), &[7, 11]);
        figures.row("plain", ToString::to_string);
        figures.title("Squares");
        figures.row("square", |number| (number * number).to_string());
        let text = figures.with_notes("both prime");
        assert_eq!(text, "Two numbers\n\nplain    7   11\n\nSquares\nsquare  49  121\n\nboth prime\n");
    }
}

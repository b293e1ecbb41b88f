//! Text in columns: rows of cells, with titles between them. Widths are counted in characters.

use std::fmt::Write;

/// How one column is set.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Column {
    side: Side,
    width: Width,
    gap: usize,
}

/// Where a cell stands that is narrower than its column.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Side {
    Left,
    Right,
}

/// How wide a column is.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Width {
    /// As wide as its widest cell.
    Fit,
    /// As wide as the widest cell of all such columns.
    Alike,
    /// So many characters; a wider cell pushes on what follows it.
    Of(usize),
}

impl From<usize> for Width {
    fn from(characters: usize) -> Self {
        Self::Of(characters)
    }
}

impl Column {
    /// The characters between two columns.
    const GAP: usize = 2;

    /// A column of text.
    pub const fn left(width: Width) -> Self {
        Self { side: Side::Left, width, gap: Self::GAP }
    }

    /// A column of numbers.
    pub const fn right(width: Width) -> Self {
        Self { side: Side::Right, width, gap: Self::GAP }
    }

    /// This column, with so many characters between the column before and it.
    pub const fn after(self, gap: usize) -> Self {
        Self { gap, ..self }
    }
}

/// Rows of cells.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct TextTable {
    columns: Vec<Column>,
    lines: Vec<Line>,
}

#[derive(Clone, PartialEq, Eq, Debug)]
enum Line {
    Title(String),
    Row(Vec<String>),
}

impl TextTable {
    /// No row yet.
    pub fn new(columns: impl IntoIterator<Item = Column>) -> Self {
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
        let widths = self.widths();
        let mut text = String::new();
        // Writing to a string cannot fail.
        for line in &self.lines {
            match line {
                Line::Title(words) => {
                    let _ = write!(text, "\n{words}");
                }
                Line::Row(cells) => {
                    for (place, ((cell, column), width)) in
                        cells.iter().zip(&self.columns).zip(&widths).enumerate()
                    {
                        let gap = if place == 0 { 0 } else { column.gap };
                        let _ = match column.side {
                            Side::Right => write!(text, "{:gap$}{cell:>width$}", ""),
                            Side::Left if place + 1 == cells.len() => write!(text, "{:gap$}{cell}", ""),
                            Side::Left => write!(text, "{:gap$}{cell:<width$}", ""),
                        };
                    }
                }
            }
            text.push('\n');
        }
        text
    }

    fn widths(&self) -> Vec<usize> {
        let widest = |place: usize| {
            let cells = self.lines.iter().filter_map(|line| match line {
                Line::Title(_) => None,
                Line::Row(cells) => cells.get(place),
            });
            cells.map(|cell| cell.chars().count()).max().unwrap_or(0)
        };
        let alike = (0..self.columns.len()).filter(|&place| self.columns[place].width == Width::Alike);
        let alike = alike.map(widest).max().unwrap_or(0);
        let width = |(place, column): (usize, &Column)| match column.width {
            Width::Fit => widest(place),
            Width::Alike => alike,
            Width::Of(width) => width,
        };
        self.columns.iter().enumerate().map(width).collect()
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
        let of_figures = measured.iter().map(|_| Column::right(Width::Alike));
        let columns = TextTable::new([Column::left(Width::Fit)].into_iter().chain(of_figures));
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
    fn columns_are_as_wide_as_they_say() {
        let mut columns = TextTable::new([
            Column::left(Width::Fit),
            Column::right(Width::Alike),
            Column::right(Width::Alike).after(1),
            Column::right(Width::Of(3)),
            Column::left(Width::Fit),
        ]);
        columns.row(["name", "1", "22222", "1234", "a"]);
        columns.title("more");
        columns.row(["é", "1", "2", "3", "last"]);
        let text = columns.text();
        assert_eq!(text, "name      1 22222  1234  a\n\nmore\né         1     2    3  last\n");
    }

    #[test]
    fn figures_stand_between_a_heading_and_notes() {
        let mut figures = Figures::new("Two numbers".to_owned(), &[7, 11]);
        figures.row("plain", ToString::to_string);
        figures.title("Squares");
        figures.row("square", |number| (number * number).to_string());
        let text = figures.with_notes("both prime");
        assert_eq!(text, "Two numbers\n\nplain     7   11\n\nSquares\nsquare   49  121\n\nboth prime\n");
    }
}

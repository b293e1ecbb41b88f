//! Tables of text whose columns are data: each has a heading, a width, and what of a line stands in it.

use tautline_field::stats::Estimate;
use tautline_io::text_table::{Column, TextTable, Width};

use super::estimates::{percent, plain, text};

/// Lines, and the columns in which they are told.
pub(super) struct Columns<L> {
    title: Option<String>,
    lines: Vec<L>,
    gap: usize,
    /// The heading of each column, its width, and its cells, one for each line.
    cells: Vec<(String, Column, Vec<String>)>,
}

impl<L: Copy> Columns<L> {
    /// A row for each of `lines`, and no column yet.
    pub(super) fn of(lines: impl IntoIterator<Item = L>) -> Self {
        Self { title: None, lines: lines.into_iter().collect(), gap: 2, cells: Vec::new() }
    }

    /// A line above the table, after an empty one.
    pub(super) fn title(self, title: impl Into<String>) -> Self {
        Self { title: Some(title.into()), ..self }
    }

    /// So many characters stand before each column that follows.
    pub(super) fn gap(self, gap: usize) -> Self {
        Self { gap, ..self }
    }

    /// A column of text.
    pub(super) fn left<D: ToString>(
        self,
        heading: impl Into<String>,
        width: impl Into<Width>,
        cell: impl Fn(L) -> D,
    ) -> Self {
        self.column(heading.into(), Column::left(width.into()), &|line| cell(line).to_string())
    }

    /// A column of numbers.
    pub(super) fn right<D: ToString>(
        self,
        heading: impl Into<String>,
        width: impl Into<Width>,
        cell: impl Fn(L) -> D,
    ) -> Self {
        self.column(heading.into(), Column::right(width.into()), &|line| cell(line).to_string())
    }

    /// A column of numbers with so many decimals.
    pub(super) fn number<N: Into<Option<f64>>>(
        self,
        heading: impl Into<String>,
        width: impl Into<Width>,
        decimals: usize,
        cell: impl Fn(L) -> N,
    ) -> Self {
        self.right(heading, width, move |line| plain(cell(line), decimals))
    }

    /// A column of estimates with so many decimals.
    pub(super) fn estimate<E: Into<Option<Estimate>>>(
        self,
        heading: impl Into<String>,
        width: impl Into<Width>,
        decimals: usize,
        cell: impl Fn(L) -> E,
    ) -> Self {
        self.right(heading, width, move |line| text(cell(line), decimals))
    }

    /// A column of shares in percent with so many decimals.
    pub(super) fn percent<E: Into<Option<Estimate>>>(
        self,
        heading: impl Into<String>,
        width: impl Into<Width>,
        decimals: usize,
        cell: impl Fn(L) -> E,
    ) -> Self {
        self.right(heading, width, move |line| percent(cell(line), decimals))
    }

    fn column(mut self, heading: String, column: Column, cell: &dyn Fn(L) -> String) -> Self {
        let cells = self.lines.iter().map(|&line| cell(line)).collect();
        self.cells.push((heading, column.after(self.gap), cells));
        self
    }

    /// The whole table. Where no column has a heading, there is no row of them.
    pub(super) fn text(&self) -> String {
        let mut table = TextTable::new(self.cells.iter().map(|&(_, column, _)| column));
        if let Some(title) = &self.title {
            table.title(title);
        }
        if self.cells.iter().any(|(heading, ..)| !heading.is_empty()) {
            table.row(self.cells.iter().map(|(heading, ..)| heading));
        }
        for line in 0..self.lines.len() {
            table.row(self.cells.iter().map(|(.., cells)| &cells[line]));
        }
        table.text()
    }
}

//! Tables of text whose columns are data: each has a heading, and what of a line stands in it.

use tautline_field::stats::Estimate;
use tautline_io::text_table::{Align, TextTable};

use super::estimates::{percent, plain, text};

/// Lines, and the columns in which they are told.
pub(super) struct Columns<L> {
    title: Option<String>,
    lines: Vec<L>,
    /// The heading of each column, and its cells, one for each line.
    cells: Vec<(String, Align, Vec<String>)>,
}

impl<L: Copy> Columns<L> {
    /// A row for each of `lines`, and no column yet.
    pub(super) fn of(lines: impl IntoIterator<Item = L>) -> Self {
        Self { title: None, lines: lines.into_iter().collect(), cells: Vec::new() }
    }

    /// A line above the table, after an empty one.
    pub(super) fn title(self, title: impl Into<String>) -> Self {
        Self { title: Some(title.into()), ..self }
    }

    /// A column of text.
    pub(super) fn left<D: ToString>(self, heading: impl Into<String>, cell: impl Fn(L) -> D) -> Self {
        self.column(heading.into(), Align::Left, &|line| cell(line).to_string())
    }

    /// A column of numbers.
    pub(super) fn right<D: ToString>(self, heading: impl Into<String>, cell: impl Fn(L) -> D) -> Self {
        self.column(heading.into(), Align::Right, &|line| cell(line).to_string())
    }

    /// A column of numbers with so many decimals.
    pub(super) fn number<N: Into<Option<f64>>>(
        self,
        heading: impl Into<String>,
        decimals: usize,
        cell: impl Fn(L) -> N,
    ) -> Self {
        self.right(heading, move |line| plain(cell(line), decimals))
    }

    /// A column of estimates with so many decimals.
    pub(super) fn estimate<E: Into<Option<Estimate>>>(
        self,
        heading: impl Into<String>,
        decimals: usize,
        cell: impl Fn(L) -> E,
    ) -> Self {
        self.right(heading, move |line| text(cell(line), decimals))
    }

    /// A column of shares in percent with so many decimals.
    pub(super) fn percent<E: Into<Option<Estimate>>>(
        self,
        heading: impl Into<String>,
        decimals: usize,
        cell: impl Fn(L) -> E,
    ) -> Self {
        self.right(heading, move |line| percent(cell(line), decimals))
    }

    fn column(mut self, heading: String, align: Align, cell: &dyn Fn(L) -> String) -> Self {
        let cells = self.lines.iter().map(|&line| cell(line)).collect();
        self.cells.push((heading, align, cells));
        self
    }

    /// The whole table. Where no column has a heading, there is no row of them.
    pub(super) fn text(&self) -> String {
        let mut table = TextTable::new(self.cells.iter().map(|&(_, align, _)| align));
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

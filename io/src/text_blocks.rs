//! Blocks of text beside each other, as many in a row as a page or a terminal holds.

use std::fmt;
use std::mem;
use std::sync::OnceLock;

/// Drawings beside each other take up at most so many columns where no program says otherwise.
const PAGE_COLUMNS: usize = 100;

/// The columns that a program has, once it has said so.
static COLUMNS: OnceLock<usize> = OnceLock::new();

/// Makes drawings beside each other take up at most so many columns, from now on. The first word counts.
pub fn fit_into(columns: usize) {
    COLUMNS.get_or_init(|| columns.min(PAGE_COLUMNS));
}

/// How many blocks of so many columns stand beside each other.
pub fn across(width: usize) -> usize {
    ((COLUMNS.get().unwrap_or(&PAGE_COLUMNS) + 3) / (width + 3)).max(1)
}

/// Lines of text with a title above them.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Block {
    /// One line.
    pub title: String,
    /// The drawing.
    pub lines: Vec<String>,
}

impl Block {
    /// Columns of its longest line.
    fn width(&self) -> usize {
        self.lines.iter().chain([&self.title]).map(|line| line.chars().count()).max().unwrap_or(0)
    }
}

impl fmt::Display for Block {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}\n{}", self.title, self.lines.join("\n"))
    }
}

/// Blocks beside each other, as many in a row as the page holds.
pub fn beside(blocks: Vec<Block>) -> String {
    let mut rows = Rows::new(blocks.iter().map(Block::width).max().unwrap_or(0));
    let text: String = blocks.into_iter().map(|block| rows.add(block)).collect();
    text + &rows.rest()
}

/// Blocks of at most so many columns beside each other, as many in a row as the page holds, and no more than a row at a
/// time.
#[derive(Debug)]
pub struct Rows {
    width: usize,
    row: Vec<Block>,
    is_first: bool,
}

impl Rows {
    /// No block yet.
    pub const fn new(width: usize) -> Self {
        Self { width, row: Vec::new(), is_first: true }
    }

    /// Adds a block: the row that it fills, or nothing.
    pub fn add(&mut self, block: Block) -> String {
        self.row.push(block);
        if self.row.len() < across(self.width) { String::new() } else { self.rest() }
    }

    /// The blocks in the row that is not full.
    pub fn rest(&mut self) -> String {
        let (row, width) = (mem::take(&mut self.row), self.width);
        if row.is_empty() {
            return String::new();
        }
        let mut text = if mem::take(&mut self.is_first) { String::new() } else { "\n".to_owned() };
        let height = row.iter().map(|block| block.lines.len()).max().unwrap_or(0);
        for line in 0..=height {
            let parts: Vec<String> = row
                .iter()
                .map(|block| match line.checked_sub(1) {
                    None => format!("{:width$}", block.title),
                    Some(line) => format!("{:width$}", block.lines.get(line).map_or("", String::as_str)),
                })
                .collect();
            text.push_str(parts.join("   ").trim_end());
            text.push('\n');
        }
        text
    }
}

//! The `.map` format of the `MovingAI` benchmarks (N. Sturtevant, "Benchmarks for Grid-Based Pathfinding",
//! IEEE Transactions on Computational Intelligence and AI in Games 4(2), 2012). A header of `type octile`,
//! `height`, `width` and `map`, then one symbol for each cell: `.` and `G` ground, free; `S` swamp, free, as
//! a robot can enter it from ground; `W` water, blocked, as it cannot; `@` and `O` out of bounds and `T`
//! trees, blocked. The format has no walls between cells and no base. `\r\n` and a missing last newline are
//! read.

use tautline_io::diagnostic::Diagnostic;
use tautline_kernel::ground::Cell;

use super::file::{Line, Misread, end, lines};
use super::{Layout, MAX_SIDE_CELLS};

const SYMBOLS: &str = "a cell is `.`, `G` or `S` (free), `@`, `O`, `T` or `W` (blocked)";

const ROWS: &str = "make `height` the number of rows that follow `map`";

/// A header line is not as it should be.
fn no_header(expected: &str) -> Diagnostic {
    let remedy = "a map begins with the lines `type octile`, `height N`, `width N` and `map`";
    Diagnostic::usage(format!("the header line `{expected}` is missing here"), remedy)
}

/// Reads a map.
///
/// # Errors
/// The first [`Diagnostic`] from the top and the bytes it lies in: a header line that is not as above, a size
/// out of bounds, a number that is none, rows of another length or number than the header
/// says, an unknown symbol, or no free cell.
pub fn read(source: &str) -> Result<Layout, Misread> {
    let mut lines = lines(source);
    let cut = |expected| Misread { at: end(source), problem: no_header(expected) };
    let mut header = |expected| lines.next().ok_or_else(|| cut(expected));

    literal(&header("type octile")?, "type octile")?;
    let first = header("height N")?;
    let height = count(&first, "height N")?;
    let width = count(&header("width N")?, "width N")?;
    literal(&header("map")?, "map")?;

    let mut layout = Layout::open(width, height).map_err(|problem| first.misread(problem))?;
    for y in 0..layout.height() {
        let line = lines.next().ok_or_else(|| {
            let what = format!("the map ends after row {y}, not {}", layout.height());
            Misread { at: end(source), problem: Diagnostic::usage(what, ROWS) }
        })?;
        read_row(&line, y, &mut layout)?;
    }
    match lines.next() {
        Some(line) => {
            let height = layout.height();
            let what = format!("this is row {}, but `height` is {height}", height + 1);
            Err(line.misread(Diagnostic::usage(what, ROWS)))
        }
        None => layout.with_free_cell().map_err(|problem| first.misread(problem)),
    }
}

fn read_row(line: &Line<'_>, y: i16, layout: &mut Layout) -> Result<(), Misread> {
    line.check_length(layout.width() as usize)?;
    for (x, (at, symbol)) in (0..).zip(line.text.char_indices()) {
        match symbol {
            '.' | 'G' | 'S' => {}
            '@' | 'O' | 'T' | 'W' => layout.block(Cell::new(x, y)),
            _ => return Err(line.unknown(at..at + 1, SYMBOLS)),
        }
    }
    Ok(())
}

fn literal(line: &Line<'_>, expected: &'static str) -> Result<(), Misread> {
    if line.text.trim_end() == expected { Ok(()) } else { Err(line.misread(no_header(expected))) }
}

/// The number of a header line such as `height 32`.
fn count(line: &Line<'_>, expected: &'static str) -> Result<u64, Misread> {
    let name = expected.trim_end_matches([' ', 'N']);
    let number = line.text.strip_prefix(name).filter(|rest| rest.is_empty() || rest.starts_with(' '));
    let number = number.ok_or_else(|| line.misread(no_header(expected)))?.trim();
    number.parse().map_err(|_| {
        let start = line.text.trim_end().len() - number.len();
        let what = format!("{number:?} is not the number N of the header line `{expected}`");
        let problem = Diagnostic::usage(what, format!("write a whole number from 1 to {MAX_SIDE_CELLS}"));
        line.misread_at(start..start + number.len(), problem)
    })
}

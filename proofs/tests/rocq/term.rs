//! Rocq terms.

use tautline_kernel::ground::{Cell, Edge, Side};

/// The head of every generated file.
pub(super) const HEAD: &str = "From Coq Require Import ZArith NArith List.\nImport ListNotations.\n";

/// `Definition name : kind := value.`
pub(super) fn definition(name: &str, kind: &str, value: &str) -> String {
    format!("Definition {name} : {kind} := {value}.\n")
}

/// A term that there may be.
pub(super) fn option(term: Option<String>) -> String {
    term.map_or("None".to_owned(), |term| format!("(Some {term})"))
}

/// Bits as one hexadecimal number, the first in the lowest place.
pub(super) fn bits(bits: &[bool]) -> String {
    let digit = |four: &[bool]| {
        let number = four.iter().enumerate().fold(0, |sum, (place, &bit)| sum | u32::from(bit) << place);
        char::from_digit(number, 16).expect("four bits")
    };
    let digits: String = bits.chunks(4).rev().map(digit).collect();
    format!("0x{digits}%N")
}

/// A list, as many entries on a line as fit.
pub(super) fn list(entries: impl IntoIterator<Item = String>) -> String {
    let mut text = String::from("[");
    let mut width = 0;
    for (place, entry) in entries.into_iter().enumerate() {
        if place > 0 {
            text.push(';');
        }
        if width + entry.len() > 110 && !entry.starts_with('\n') {
            text.push_str("\n  ");
            width = 0;
        }
        width += entry.len() + 1;
        text.push_str(&entry);
    }
    text.push(']');
    text
}

pub(super) fn cell(cell: Cell) -> String {
    format!("({},{})", cell.x, cell.y)
}

/// An edge: the cell to its west or north, and whether it is on the east of that.
pub(super) fn edge(edge: Edge) -> String {
    format!("({},{})", cell(edge.cell()), edge.side() == Side::East)
}

/// Bytes as one hexadecimal number, the first in the lowest place.
pub(super) fn number(bytes: impl DoubleEndedIterator<Item = u8> + ExactSizeIterator) -> String {
    let digits = 2 * bytes.len();
    let number = bytes.rev().fold(0_u64, |number, byte| number << 8 | u64::from(byte));
    format!("0x{number:0digits$x}")
}

/// Columns and rows that are at most `reach`, row by row.
pub(super) fn offsets(reach: i16) -> impl Iterator<Item = (i16, i16)> + Clone {
    (-reach..=reach).flat_map(move |y| (-reach..=reach).map(move |x| (x, y)))
}

pub(super) const fn at(cell: Cell, (x, y): (i16, i16)) -> Cell {
    Cell::new(cell.x + x, cell.y + y)
}

/// The answer, the same wherever on the lattice it is asked.
pub(super) fn everywhere(ask: impl Fn(Cell) -> bool) -> bool {
    let places = [(0, 0), (7, -3), (-120, 255), (32_000, -32_000), (-32_000, 32_000)];
    let answers = places.map(|place| ask(Cell::from(place)));
    assert!(answers.iter().all(|&answer| answer == answers[0]), "an answer depends on where it is asked");
    answers[0]
}

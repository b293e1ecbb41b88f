//! The nodes within three columns and rows of one, as the bits of a word: what is in reach of it, and what is joined with it
//! by short paths.

use super::stance::in_reach;
use crate::ground::{Cell, Step};

/// Nodes around one, a bit for each: 8·(rows + 3) + columns + 3, of −3 to 3 columns and rows.
pub(super) type Places = u64;

/// The bit of an offset of at most three columns and rows.
pub(super) const fn bit(columns: i16, rows: i16) -> u32 {
    (8 * (rows + 3) + columns + 3) as u32
}

/// The node itself.
pub(super) const HERE: Places = 1 << bit(0, 0);

/// The places in reach, but for the very same node.
pub(super) const IN_REACH: Places = {
    let mut places = 0;
    let mut place = 0;
    while place < 56 {
        let offset = Cell::new(place % 8 - 3, place / 8 - 3);
        if in_reach(Cell::new(0, 0), offset) && place != bit(0, 0) as i16 && place % 8 < 7 {
            places |= 1 << place;
        }
        place += 1;
    }
    places
};

/// The place of `other` around `node`, if it is so near.
pub(super) fn place_of(node: Cell, other: Cell) -> Option<Places> {
    let (columns, rows) = (other.x.checked_sub(node.x)?, other.y.checked_sub(node.y)?);
    let is_near = (-3..=3).contains(&columns) && (-3..=3).contains(&rows);
    is_near.then(|| 1 << bit(columns, rows))
}

/// The places after the other robot has taken this step.
pub(super) const fn moved(places: Places, step: Step) -> Places {
    match step.place() {
        0 => places << 1,
        1 => places << 8,
        2 => places >> 1,
        3 => places >> 8,
        _ => places,
    }
}

/// The offsets of these places.
pub(super) fn offsets(places: Places) -> impl Iterator<Item = (i16, i16)> {
    let mut rest = places;
    core::iter::from_fn(move || {
        let place = rest.trailing_zeros() as i16;
        rest &= rest.wrapping_sub(1);
        (place < 64).then_some((place % 8 - 3, place / 8 - 3))
    })
}

/// The node at this offset of `node`.
pub(super) const fn at_offset(node: Cell, (columns, rows): (i16, i16)) -> Cell {
    Cell::new(node.x.saturating_add(columns), node.y.saturating_add(rows))
}

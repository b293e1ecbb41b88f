//! The nodes that may be in reach of one, as the bits of a word: what is in reach of it,
//! and what is joined with it by short paths.

use super::stance::Reach;
use crate::ground::{Cell, Step};

/// Nodes around one, a bit for each: row by row, of [`SIDE`] columns and rows with the node in the middle.
pub(super) type Places = u128;

/// Columns and rows to each side.
const MOST: i16 = Reach::MOST_PATHS as i16;
pub(super) const SIDE: i16 = 2 * MOST + 1;

/// The bit of an offset.
pub(super) const fn bit(columns: i16, rows: i16) -> u32 {
    (SIDE * (rows + MOST) + columns + MOST) as u32
}

/// The node itself.
pub(super) const HERE: Places = 1 << bit(0, 0);

/// The places within each squared distance, but for the very same node.
const WITHIN: [Places; (MOST * MOST) as usize + 1] = {
    let mut within = [0; (MOST * MOST) as usize + 1];
    let mut place = 0;
    while place < SIDE * SIDE {
        let (x, y) = (place % SIDE - MOST, place / SIDE - MOST);
        let mut squared = (x * x + y * y) as usize;
        while 0 < squared && squared < within.len() {
            within[squared] |= 1 << place;
            squared += 1;
        }
        place += 1;
    }
    within
};

/// The places in reach, but for the very same node.
pub(super) const fn in_reach(reach: Reach) -> Places {
    WITHIN[reach.squared() as usize]
}

/// The place of `other` around `node`, if it is so near.
pub(super) fn place_of(node: Cell, other: Cell) -> Option<Places> {
    let (columns, rows) = (other.x.checked_sub(node.x)?, other.y.checked_sub(node.y)?);
    let is_near = (-MOST..=MOST).contains(&columns) && (-MOST..=MOST).contains(&rows);
    is_near.then(|| 1 << bit(columns, rows))
}

/// The places after the other robot has taken this step. From the last column a place in reach comes to the first one
/// of the next row, which is out of reach, and the other way round.
pub(super) const fn moved(places: Places, step: Step) -> Places {
    match step.place() {
        0 => places << 1,
        1 => places << SIDE,
        2 => places >> 1,
        3 => places >> SIDE,
        _ => places,
    }
}

/// The offsets of these places.
pub(super) fn offsets(places: Places) -> impl Iterator<Item = (i16, i16)> {
    let mut rest = places;
    core::iter::from_fn(move || {
        let place = rest.trailing_zeros() as i16;
        rest &= rest.wrapping_sub(1);
        (place < SIDE * SIDE).then_some((place % SIDE - MOST, place / SIDE - MOST))
    })
}

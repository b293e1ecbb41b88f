//! The nodes within three columns and rows of one, as the bits of a word: what is in reach of it, and what is joined with it
//! by short paths.

use super::stance::Reach;
use crate::ground::{Cell, Step};

/// Nodes around one, a bit for each: 8·(rows + 3) + columns + 3, of −3 to 3 columns and rows.
pub(super) type Places = u64;

/// The bit of an offset of at most three columns and rows.
pub(super) const fn bit(columns: i16, rows: i16) -> u32 {
    (8 * (rows + 3) + columns + 3) as u32
}

/// The node itself.
pub(super) const HERE: Places = 1 << bit(0, 0);

/// The places within each squared distance, but for the very same node.
const WITHIN: [Places; Reach::PAPER.squared() as usize + 1] = {
    let mut within = [0; Reach::PAPER.squared() as usize + 1];
    let mut place = 0;
    while place < 56 {
        let (x, y) = (place % 8 - 3, place / 8 - 3);
        let mut squared = (x * x + y * y) as usize;
        while 0 < squared && squared < within.len() && x <= 3 {
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

/// The places in the paper's reach, but for the very same node.
pub(super) const IN_REACH: Places = in_reach(Reach::PAPER);

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

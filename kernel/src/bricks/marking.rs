//! The local rules: whether a cell may be marked as visited [Ferranti 2009, II.A and Fig. 2], and whether a side may be
//! shut.

use super::rule::{Condition, Rule};
use crate::floor::{COMPASS, Scan};
use crate::ground::Side;

/// Whether the cell blocks the way between two accessible side neighbours, judged on the eight cells around: then it
/// is marked as explored, else as visited. It does not block if its reachable side neighbours, going round, form one
/// chain in which each is joined to the next: by the square that both make with the cell and the corner between them.
pub fn blocks(rule: Rule, scan: &Scan) -> bool {
    let reachable = scan.reachable();
    reachable.count() > 1
        && !COMPASS
            .into_iter()
            .any(|first| reachable.has(first) && is_chain(rule, scan, first, reachable.count()))
}

/// Whether `sides` side neighbours, clockwise from the one beyond `first`, are each joined to the next.
fn is_chain(rule: Rule, scan: &Scan, first: Side, sides: u32) -> bool {
    let mut side = first;
    (1..sides).all(|joined| {
        // What reads as unexplored may be a missed sensor: a connection may end there, but not go through.
        let is_sure = joined == 1 || !rule.has(Condition::SeenOnly) || scan.explored.has(side);
        let is_joined = is_sure && is_joined(rule, scan, side);
        side = side.turned_right();
        is_joined
    })
}

/// Whether the neighbour beyond `side` is joined to the next one clockwise.
fn is_joined(rule: Rule, scan: &Scan, side: Side) -> bool {
    let is_passable = !rule.has(Condition::Corners) || scan.is_filled_right(side);
    let is_sure = !rule.has(Condition::SeenOnly) || scan.explored.has_right_of(side);
    is_passable && is_sure && scan.reachable().has(side.turned_right())
}

/// Whether the way through `side`, which is reachable, has material on both sides: no square beside it is free all
/// round.
pub fn is_thin(scan: &Scan, side: Side) -> bool {
    !scan.is_filled_left(side) && !scan.is_filled_right(side)
}

//! Which robot goes to which unexplored cell: robots and cells are paired, the nearest pair first.
//!
//! Every robot computes the pairs by itself, from its own map and from what the others have told. A robot takes one of as many
//! cells as there are robots, the others at most all but one of them: so a list of that length for each robot is enough.

use core::ops::ControlFlow;

use super::map::{BY_NUMBER, Found, Map, Search, Status, search};
use super::rule::{Condition, Rule};
use crate::ground::{Area, Cell, Side};

/// A robot and an unexplored cell that it could go to.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Pair {
    rank: Rank,
    /// The side through which the robot leaves its cell.
    first: Side,
}

/// What is less goes first. Robots and cells count by the row and the column of their cells.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
struct Rank {
    distance: u32,
    is_unclaimed: bool,
    /// Unexplored neighbours of the cell.
    unexplored: u8,
    /// Cells to the rim of the area.
    inland: u16,
    robot: (i16, i16),
    cell: (i16, i16),
}

/// A robot that is to be paired.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) struct Seeker {
    pub(super) cell: Cell,
    /// The cell that it has claimed.
    pub(super) aim: Option<Cell>,
}

impl Pair {
    const fn cell(&self) -> Cell {
        Cell::new(self.rank.cell.1, self.rank.cell.0)
    }

    /// Whether a robot in `from` may be as near to the cell of this pair as the robot of this pair is.
    fn may_be_lost_to(&self, from: Cell) -> bool {
        let (columns, rows) = from.apart(self.cell());
        u32::from(columns) + u32::from(rows) <= self.rank.distance
    }

    fn found(&self) -> Found {
        Found { cell: self.cell(), distance: self.rank.distance, first: self.first }
    }
}

const fn number(cell: Cell) -> (i16, i16) {
    (cell.y, cell.x)
}

/// How far `cell` is from the rim of `area`.
fn inland(area: Area, cell: Cell) -> u16 {
    let (first, last) = (area.first(), area.last());
    let columns = cell.x.abs_diff(first.x).min(cell.x.abs_diff(last.x));
    let rows = cell.y.abs_diff(first.y).min(cell.y.abs_diff(last.y));
    columns.min(rows)
}

fn rank<M: Map>(map: &M, rule: &Rule, seeker: Seeker, found: &Found) -> Rank {
    let is_corner = rule.has(Condition::Corner);
    let unexplored = |side: &Side| map.status(found.cell.beyond(*side)) == Status::Unexplored;
    Rank {
        distance: found.distance,
        is_unclaimed: rule.has(Condition::Claim) && seeker.aim != Some(found.cell),
        unexplored: if is_corner { BY_NUMBER.iter().filter(|side| unexplored(side)).count() as u8 } else { 0 },
        inland: if is_corner { inland(map.area(), found.cell) } else { 0 },
        robot: number(seeker.cell),
        cell: number(found.cell),
    }
}

/// Fills `list` with the pairs of `seeker` that come first, and returns the first one, and `None` if there is none.
fn fill<M: Map>(
    map: &M,
    rule: &Rule,
    seeker: Seeker,
    search_in: &mut Search<'_>,
    list: &mut [Option<Pair>],
) -> Option<Found> {
    list.fill(None);
    let mut best: Option<Pair> = None;
    search(map, seeker.cell, search_in, |found| {
        let last = list.last().map_or(best, |last| *last);
        if last.is_some_and(|last| last.rank.distance < found.distance) {
            return ControlFlow::Break(());
        }
        let pair = Pair { rank: rank(map, rule, seeker, &found), first: found.first };
        best = Some(best.filter(|best| best.rank < pair.rank).unwrap_or(pair));
        let place = list.iter().position(|known| known.is_none_or(|known| pair.rank < known.rank));
        if let Some(after) = place.and_then(|place| list.get_mut(place..)) {
            after.rotate_right(1);
            if let Some(free) = after.first_mut() {
                *free = Some(pair);
            }
        }
        ControlFlow::Continue(())
    });
    best.map(|best| best.found())
}

/// The unexplored cell that `own` is paired with among `others`, or the one that comes first for it if all cells are the others';
/// `None` if it reaches none.
///
/// A robot that is nowhere near enough to a cell of those that count, measured by columns and rows, takes none of these before they do,
/// and is left out.
pub(super) fn paired<M: Map>(
    map: &M,
    rule: &Rule,
    own: Seeker,
    others: impl ExactSizeIterator<Item = Seeker> + Clone,
    search_in: &mut Search<'_>,
    pairs: &mut [Option<Pair>],
) -> Option<Found> {
    let robots = others.len() + 1;
    let each = (pairs.len() / robots).min(robots);
    let Some((own_list, rest)) = pairs.split_at_mut_checked(each) else { return None };
    let first = fill(map, rule, own, search_in, own_list)?;
    rest.fill(None);
    let mut filled = each;
    loop {
        let before = filled;
        for other in others.clone() {
            let (known, free) = pairs.split_at_mut(filled);
            let is_in = known.iter().flatten().any(|pair| pair.rank.robot == number(other.cell));
            let counts = known.iter().flatten().any(|pair| pair.may_be_lost_to(other.cell));
            if is_in || !counts {
                continue;
            }
            let Some(list) = free.get_mut(..each) else { continue };
            if fill(map, rule, other, search_in, list).is_some() {
                filled += each;
            }
        }
        if filled == before {
            break;
        }
    }
    while let Some(next) = pairs.iter().take(filled).flatten().min_by_key(|pair| pair.rank).copied() {
        if next.rank.robot == number(own.cell) {
            return Some(next.found());
        }
        let is_over = |pair: &Pair| pair.rank.robot == next.rank.robot || pair.rank.cell == next.rank.cell;
        pairs.iter_mut().filter(|pair| pair.as_ref().is_some_and(is_over)).for_each(|pair| *pair = None);
    }
    Some(first)
}

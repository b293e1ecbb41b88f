//! The input of the judge, and what can be said against it.

use std::collections::BTreeSet;

use super::place::{Place, SIDES, add, side_between};

/// A counterexample, written down.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct JudgeInput {
    /// The clause that its last move is said to break, `CHAIN-1`, `CHAIN-2`, `CHAIN-3`, `CHAIN-19`, `CHAIN-27` or
    /// `CHAIN-28`, or its end, `CHAIN-13` or `CHAIN-14`.
    pub clause: &'static str,
    /// The rule that the team is said to follow.
    pub repairs: Repairs,
    /// Columns of the layout.
    pub width: i32,
    /// Rows of the layout.
    pub height: i32,
    /// Pairs of neighbouring cells, the western or northern first, with a wall between them.
    pub walls: BTreeSet<(Place, Place)>,
    /// Cells that nobody can enter.
    pub blocked: BTreeSet<Place>,
    /// The base.
    pub base: Place,
    /// Robots, base included.
    pub robots: usize,
    /// The team moves.
    pub moves: Vec<Move>,
}

/// Whether the team follows the repaired rule.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Repairs {
    /// The rule as published.
    Without,
    /// The rule with all repairs.
    With,
}

/// One team move, base first.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Move {
    /// Whether it takes an earlier move back.
    pub is_backtrack: bool,
    /// The steps that the robots tried: columns and rows.
    pub tried: Vec<Place>,
    /// Whether it was blocked.
    pub blocked: Vec<bool>,
    /// Where it is now.
    pub places: Vec<Place>,
}

impl JudgeInput {
    /// A run in a layout of so many columns and rows without walls, before its first move.
    pub fn open(
        clause: &'static str,
        repairs: Repairs,
        (width, height): (i32, i32),
        base: Place,
        robots: usize,
    ) -> Self {
        let (walls, blocked) = (BTreeSet::new(), BTreeSet::new());
        Self { clause, repairs, width, height, walls, blocked, base, robots, moves: Vec::new() }
    }

    pub(super) fn is_free(&self, (x, y): Place) -> bool {
        (0..self.width).contains(&x) && (0..self.height).contains(&y) && !self.blocked.contains(&(x, y))
    }

    pub(super) fn is_open(&self, side: (Place, Place)) -> bool {
        self.is_free(side.0) && self.is_free(side.1) && !self.walls.contains(&side)
    }

    /// Whether a place is in the area that the team is given.
    pub(super) fn is_inside(&self, (x, y): Place) -> bool {
        let range = self.robots as i32 - 1;
        (0..self.width).contains(&x)
            && (0..self.height).contains(&y)
            && (x - self.base.0).abs() <= range
            && (y - self.base.1).abs() <= range
    }

    /// The places of that area.
    pub(super) fn inside(&self) -> impl Iterator<Item = Place> {
        let range = i32::try_from(self.robots).unwrap_or(i32::MAX) - 1;
        let (x, y) = self.base;
        let columns = x.saturating_sub(range).max(0)..=x.saturating_add(range).min(self.width - 1);
        let rows = y.saturating_sub(range).max(0)..=y.saturating_add(range).min(self.height - 1);
        rows.flat_map(move |y| columns.clone().map(move |x| (x, y)))
    }

    /// The border of the area: known from the start.
    pub(super) fn is_border(&self, side: (Place, Place)) -> bool {
        !(self.is_inside(side.0) && self.is_inside(side.1))
    }

    /// The places of the area at most N−1 links from the base, where links cross the sides that `is_open`.
    pub(super) fn within_reach(&self, is_open: impl Fn((Place, Place)) -> bool) -> BTreeSet<Place> {
        let pass = |from: Place, step: Place| {
            let to = add(from, step);
            (self.is_inside(to) && is_open(side_between(from, to))).then_some(to)
        };
        let linked = |from: Place| {
            SIDES
                .into_iter()
                .filter_map(move |(x, y)| pass(from, (x, y)).map(|next| (next, (x, y))))
                .flat_map(move |(next, (x, y))| {
                    let turns = [(y, x), (-y, -x)].into_iter().filter_map(move |turn| pass(next, turn));
                    std::iter::once(next).chain(turns)
                })
        };
        let mut reached = BTreeSet::from([self.base]);
        let mut rim = vec![self.base];
        for _ in 1..self.robots {
            rim = rim.into_iter().flat_map(linked).filter(|&place| reached.insert(place)).collect();
        }
        reached
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_area_is_what_is_in_the_layout_and_at_most_n_minus_1_columns_and_rows_from_the_base() {
        for (robots, base) in [(2, (0, 0)), (2, (3, 1)), (3, (2, 2)), (4, (1, 3)), (9, (4, 0))] {
            let blocked = BTreeSet::from([(1, 1), (4, 3), (-1, 2)]);
            let mut input = JudgeInput::open("", Repairs::With, (6, 4), base, robots);
            input.blocked.clone_from(&blocked);
            let range = i32::try_from(robots).expect("few") - 1;
            let mut area = BTreeSet::new();
            for place in (-2..=8).flat_map(|x| (-2..=8).map(move |y| (x, y))) {
                let (x, y) = place;
                let is_there = (0..6).contains(&x) && (0..4).contains(&y);
                assert_eq!(input.is_free(place), is_there && !blocked.contains(&place), "{place:?}");
                let is_near = (x - base.0).abs().max((y - base.1).abs()) <= range;
                assert_eq!(input.is_inside(place), is_there && is_near, "{robots} {place:?}");
                area.extend((is_there && is_near).then_some(place));
            }
            assert_eq!(input.inside().collect::<BTreeSet<_>>(), area, "{robots}");
        }
    }
}

//! PACK-1 to PACK-4.

use std::collections::BTreeSet;

use super::{BrokenClause, Floor, Place, add, broken};

/// A run of robots that see, as far as it is heard.
pub(crate) struct Pack<'a> {
    floor: &'a Floor,
    starts: Vec<Place>,
    cells: Vec<Place>,
    sight: i32,
    range: i32,
    /// The free cells that a robot has seen.
    seen: BTreeSet<Place>,
}

impl<'a> Pack<'a> {
    pub(crate) fn new(floor: &'a Floor, starts: &[Place], sight: i32, range: i32) -> Self {
        let (starts, cells) = (starts.to_vec(), starts.to_vec());
        let mut pack = Self { floor, starts, cells, sight, range, seen: BTreeSet::new() };
        pack.look();
        pack
    }

    /// Hears where all are after a team move.
    pub(crate) fn hear(&mut self, after: &[Place]) -> Result<(), BrokenClause> {
        broken(self.floor.leaps(&self.cells, after).is_some(), "PACK-2", || "a robot leaps".to_owned())?;
        let alone: BTreeSet<Place> = after.iter().copied().collect();
        broken(alone.len() < after.len(), "PACK-2", || format!("two robots in one cell: {after:?}"))?;
        broken(!self.is_connected(after), "PACK-1", || format!("not connected: {after:?}"))?;
        self.cells = after.to_vec();
        self.look();
        Ok(())
    }

    /// Hears that the run is over, by itself or not.
    pub(crate) fn end(&self, by_itself: bool) -> Result<(), BrokenClause> {
        broken(!by_itself, "PACK-4", || "the run goes on".to_owned())?;
        let left = self.floor.walkable(&self.starts).into_iter().find(|cell| !self.seen.contains(cell));
        let clause = if self.are_side_by_side() { "PACK-3" } else { "PACK-5" };
        broken(left.is_some(), clause, || format!("{left:?} is left out"))
    }

    /// Whether the robots start side by side, all of them together.
    fn are_side_by_side(&self) -> bool {
        let (mut joined, mut rest) = (vec![self.starts[0]], self.starts[1..].to_vec());
        let mut place = 0;
        while place < joined.len() {
            let (x, y) = joined[place];
            let (near, far): (Vec<Place>, Vec<Place>) =
                rest.into_iter().partition(|other| (other.0 - x).abs() + (other.1 - y).abs() == 1);
            joined.extend(near);
            rest = far;
            place += 1;
        }
        rest.is_empty()
    }

    /// Whether links join all: the whole cell of one robot is within range of the midpoint of the other's.
    fn is_connected(&self, cells: &[Place]) -> bool {
        let is_linked = |one: Place, other: Place| {
            let corner = |apart: i32| 2 * apart.abs() + 1;
            corner(one.0 - other.0).pow(2) + corner(one.1 - other.1).pow(2) <= 4 * self.range.pow(2)
        };
        let mut joined = vec![cells[0]];
        let mut rest = cells[1..].to_vec();
        let mut place = 0;
        while place < joined.len() {
            let (near, far): (Vec<Place>, Vec<Place>) =
                rest.into_iter().partition(|&other| is_linked(joined[place], other));
            joined.extend(near);
            rest = far;
            place += 1;
        }
        rest.is_empty()
    }

    fn look(&mut self) {
        for from in self.cells.clone() {
            for to in (-self.sight..=self.sight).flat_map(|x| (-self.sight..=self.sight).map(move |y| (x, y)))
            {
                let is_near = to.0 * to.0 + to.1 * to.1 <= self.sight * self.sight;
                if is_near && self.floor.is_free(add(from, to)) && self.sees(from, to) {
                    self.seen.insert(add(from, to));
                }
            }
        }
    }

    /// Whether a ray goes from the midpoint of a cell to that of the free cell so far from it: no cell that it crosses
    /// has an obstacle, and it passes no corner between two.
    fn sees(&self, from: Place, (dx, dy): Place) -> bool {
        let is_obstacle = |place: Place| !self.floor.is_free(place);
        let (x_step, y_step) = (dx.signum(), dy.signum());
        let (dx, dy) = (dx.abs(), dy.abs());
        let (mut across, mut down, mut at) = (0, 0, from);
        while across < dx || down < dy {
            // The next line between columns is crossed after (2·across + 1) / (2·dx) of the way.
            let (by_column, by_row) = ((2 * across + 1) * dy, (2 * down + 1) * dx);
            let goes_across = across < dx && (down == dy || by_column <= by_row);
            let goes_down = down < dy && (across == dx || by_row <= by_column);
            let (beside, below) = (add(at, (x_step, 0)), add(at, (0, y_step)));
            if goes_across && goes_down && is_obstacle(beside) && is_obstacle(below) {
                return false;
            }
            if goes_across {
                at.0 += x_step;
                across += 1;
            }
            if goes_down {
                at.1 += y_step;
                down += 1;
            }
            if is_obstacle(at) {
                return false;
            }
        }
        true
    }
}

#[test]
fn a_ray_ends_at_an_obstacle_and_between_two() {
    let floor = |blocked: &[Place]| Floor {
        columns: 5,
        rows: 5,
        blocked: blocked.iter().copied().collect(),
        walls: BTreeSet::new(),
    };
    let sees = |blocked: &[Place], to: Place| Pack::new(&floor(blocked), &[(0, 0)], 7, 3).sees((0, 0), to);
    assert!(sees(&[], (4, 4)) && sees(&[], (4, 1)) && sees(&[(1, 0)], (4, 4)) && sees(&[(0, 1)], (4, 4)));
    assert!(!sees(&[(1, 0), (0, 1)], (4, 4)) && !sees(&[(2, 2)], (4, 4)) && !sees(&[(1, 0)], (4, 0)));
    // From (0, 0) to (2, 1) the ray crosses (1, 0), then the corner of nothing, then (1, 1).
    assert!(!sees(&[(1, 0)], (2, 1)) && !sees(&[(1, 1)], (2, 1)) && sees(&[(2, 0)], (2, 1)));
}

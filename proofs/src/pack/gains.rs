//! Which frontier cell a robot of a pack goes to (PACK-8), where all of them are looked at.

use std::collections::VecDeque;

use rustc_hash::FxHashMap;
use tautline_kernel::ground::{Cell, Circle, Side};
use tautline_kernel::pack::{Chart, Rule, Status};

use super::rays::gain;

/// Whether it is looked at how robots choose their aims: that takes most of the time.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Gains {
    /// It is not.
    Unseen,
    /// Each choice is compared with all others.
    Compared,
}

/// How many R_c farther than the nearest cell that a robot may go to it looks for a better one.
const HORIZONS: u32 = 2;

/// A pack's rule, and what it has seen.
pub(super) struct Outlook<'a, W> {
    pub(super) rule: &'a Rule,
    pub(super) chart: &'a Chart<W>,
}

impl<W: AsRef<[[u64; 2]]>> Outlook<'_, W> {
    /// Whether the aims that robots in `cells` have `chosen`, one after the other, are best; those that are `kept` are
    /// not chosen anew. Two robots that get into each other's way in the move may have exchanged theirs. Of more than
    /// two robots nothing is said.
    pub(super) fn are_best(&self, cells: &[Cell], kept: &[Option<Cell>], chosen: &[Option<Cell>]) -> bool {
        let are_chosen = |chosen: &[Option<Cell>]| {
            let mut aims = kept.to_vec();
            for (robot, &from) in cells.iter().enumerate() {
                if kept[robot].is_some() {
                    if chosen[robot] != kept[robot] {
                        return false;
                    }
                    continue;
                }
                let others: Vec<Cell> = aims.iter().flatten().copied().collect();
                if !self.is_best(from, &others, chosen[robot]) {
                    return false;
                }
                aims[robot] = chosen[robot];
            }
            true
        };
        match (cells, chosen) {
            ([_], _) => are_chosen(chosen),
            (&[one, other], &[first, second]) => {
                let (columns, rows) = one.apart(other);
                are_chosen(chosen) || columns + rows <= 2 && are_chosen(&[second, first])
            }
            _ => true,
        }
    }

    /// The aims that robots choose, one after the other, which go where they would see most, however far it is.
    pub(super) fn most_seen(&self, cells: &[Cell], kept: &[Option<Cell>]) -> Vec<Option<Cell>> {
        let mut aims = kept.to_vec();
        for (robot, &from) in cells.iter().enumerate().filter(|&(robot, _)| kept[robot].is_none()) {
            let others: Vec<Cell> = aims.iter().flatten().copied().collect();
            let nearby = self.in_horizon(self.choices(from, &others));
            let seen = |&cell: &Cell| self.seen(cell, &others);
            aims[robot] = nearby.into_keys().max_by_key(|cell| (seen(cell), *cell));
        }
        aims
    }

    /// The steps to each frontier cell that a robot in `from` may go to which has heard where the others go.
    fn choices(&self, from: Cell, others: &[Cell]) -> FxHashMap<Cell, u32> {
        let range_cells = u64::from(self.rule.range_cells());
        let circle = Circle::new(4 * range_cells.pow(2));
        let mut far = self.distances(from);
        far.retain(|&cell, _| {
            self.chart.is_frontier(cell)
                && (others.is_empty() || others.iter().any(|&other| circle.covers(other, cell)))
        });
        far
    }

    /// Those of them that are not too far beyond the nearest.
    fn in_horizon(&self, mut far: FxHashMap<Cell, u32>) -> FxHashMap<Cell, u32> {
        let nearest = far.values().min().copied().unwrap_or_default();
        far.retain(|_, &mut steps| steps <= nearest + HORIZONS * u32::from(self.rule.range_cells()));
        far
    }

    /// Whether no frontier cell has a greater metric gain than `aim`, for a robot in `from` that has heard where the
    /// others go.
    fn is_best(&self, from: Cell, others: &[Cell], aim: Option<Cell>) -> bool {
        let far = self.choices(from, others);
        let Some(aim) = aim else { return far.is_empty() };
        let Some(&own) = far.get(&aim) else { return false };
        let far = self.in_horizon(far);
        let own_gain = self.seen(aim, others);
        let is_over = |(&cell, &steps): (&Cell, &u32)| match (own_gain, self.seen(cell, others)) {
            (0, 0) => steps < own,
            (own_gain, gain) => gain * own > own_gain * steps,
        };
        far.contains_key(&aim) && !far.iter().any(is_over)
    }

    /// The steps to each cell that is reached over cells known to be free.
    fn distances(&self, from: Cell) -> FxHashMap<Cell, u32> {
        let (mut far, mut left) = (FxHashMap::from_iter([(from, 0)]), VecDeque::from([from]));
        while let Some(cell) = left.pop_front() {
            let steps = far[&cell] + 1;
            for beyond in Side::ALL.map(|side| cell.beyond(side)) {
                if self.chart.status(beyond) == Status::Free && !far.contains_key(&beyond) {
                    far.insert(beyond, steps);
                    left.push_back(beyond);
                }
            }
        }
        far
    }

    /// The visibility gain of `cell`.
    fn seen(&self, cell: Cell, others: &[Cell]) -> u32 {
        gain(self.chart, self.rule.sight().radius_cells(), cell, others)
    }
}

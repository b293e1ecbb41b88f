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

/// Whether the aims that robots in `cells` have `chosen`, one after the other, are best; those that are `kept` are not
/// chosen anew. Two robots that get into each other's way in the move may have exchanged theirs. Of more than two
/// robots nothing is said.
pub(super) fn are_best<W: AsRef<[[u64; 2]]>>(
    rule: &Rule,
    chart: &Chart<W>,
    cells: &[Cell],
    kept: &[Option<Cell>],
    chosen: &[Option<Cell>],
) -> bool {
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
            if !is_best(rule, chart, from, &others, chosen[robot]) {
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
pub(super) fn most_seen<W: AsRef<[[u64; 2]]>>(
    rule: &Rule,
    chart: &Chart<W>,
    cells: &[Cell],
    kept: &[Option<Cell>],
) -> Vec<Option<Cell>> {
    let mut aims = kept.to_vec();
    for (robot, &from) in cells.iter().enumerate().filter(|&(robot, _)| kept[robot].is_none()) {
        let others: Vec<Cell> = aims.iter().flatten().copied().collect();
        let nearby = in_horizon(rule, choices(rule, chart, from, &others));
        let seen = |&cell: &Cell| gain(chart, rule.sight().radius_cells(), cell, &others);
        aims[robot] = nearby.into_keys().max_by_key(|cell| (seen(cell), *cell));
    }
    aims
}

/// The steps to each frontier cell that a robot in `from` may go to which has heard where the others go.
fn choices<W: AsRef<[[u64; 2]]>>(
    rule: &Rule,
    chart: &Chart<W>,
    from: Cell,
    others: &[Cell],
) -> FxHashMap<Cell, u32> {
    let range_cells = u64::from(rule.range_cells());
    let circle = Circle::new(4 * range_cells.pow(2));
    let mut far = distances(chart, from);
    far.retain(|&cell, _| {
        chart.is_frontier(cell)
            && (others.is_empty() || others.iter().any(|&other| circle.covers(other, cell)))
    });
    far
}

/// Those of them that are not too far beyond the nearest.
fn in_horizon(rule: &Rule, mut far: FxHashMap<Cell, u32>) -> FxHashMap<Cell, u32> {
    let nearest = far.values().min().copied().unwrap_or_default();
    far.retain(|_, &mut steps| steps <= nearest + HORIZONS * u32::from(rule.range_cells()));
    far
}

/// Whether no frontier cell has a greater metric gain than `aim`, for a robot in `from` that has heard where the others
/// go.
fn is_best<W: AsRef<[[u64; 2]]>>(
    rule: &Rule,
    chart: &Chart<W>,
    from: Cell,
    others: &[Cell],
    aim: Option<Cell>,
) -> bool {
    let far = choices(rule, chart, from, others);
    let Some(aim) = aim else { return far.is_empty() };
    let Some(&own) = far.get(&aim) else { return false };
    let far = in_horizon(rule, far);
    let seen = |cell: Cell| gain(chart, rule.sight().radius_cells(), cell, others);
    let own_gain = seen(aim);
    let is_over = |(&cell, &steps): (&Cell, &u32)| match (own_gain, seen(cell)) {
        (0, 0) => steps < own,
        (own_gain, gain) => gain * own > own_gain * steps,
    };
    far.contains_key(&aim) && !far.iter().any(is_over)
}

/// The steps to each cell that is reached over cells known to be free.
fn distances<W: AsRef<[[u64; 2]]>>(chart: &Chart<W>, from: Cell) -> FxHashMap<Cell, u32> {
    let (mut far, mut left) = (FxHashMap::from_iter([(from, 0)]), VecDeque::from([from]));
    while let Some(cell) = left.pop_front() {
        let steps = far[&cell] + 1;
        for beyond in Side::ALL.map(|side| cell.beyond(side)) {
            if chart.status(beyond) == Status::Free && !far.contains_key(&beyond) {
                far.insert(beyond, steps);
                left.push_back(beyond);
            }
        }
    }
    far
}

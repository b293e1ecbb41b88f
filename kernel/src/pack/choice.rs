//! Which frontier cell a robot goes to: the one with the greatest metric gain V/d (II.B.2), V being the
//! unknown cells that it would see there, and d the steps on the shortest way over known free cells. Robots
//! choose in the order of their numbers: a cell must have a link to a cell to which another robot is going, if
//! there is one, and unknown cells within R_s of such a cell do not count for V. Where V is 0 everywhere, the
//! robot goes to the nearest cell that it may go to.
//!
//! Frontier cells are told nearest first. No cell's V is more than the disc has cells, so the flood ends as soon as the
//! best gain is at least that number over the distance, and at the latest [`HORIZONS`] R_c beyond the nearest
//! candidate. Rays are followed only from a cell whose unknown cells, in sight or not, and whose V when it was last
//! looked at would be enough for a greater gain.

use super::aim::Aim;
use super::chart::Chart;
use super::flood::{Flood, Scratch};
use super::rule::Rule;
use super::sight::Window;
use crate::ground::Cell;

/// How many R_c farther than the nearest candidate a robot looks for a better one.
const HORIZONS: u32 = 2;

/// A gain over a distance.
#[derive(Clone, Copy)]
struct Gain {
    cells: u32,
    far: u32,
}

impl Gain {
    const fn is_over(self, other: Self) -> bool {
        self.cells as u64 * other.far as u64 > other.cells as u64 * self.far as u64
    }
}

/// The choice of a robot in `from`, `others` being where the others are going; `None` if it reaches no frontier cell.
pub(super) fn choose<W: AsRef<[[u64; 2]]>>(
    rule: &Rule,
    chart: &Chart<W>,
    from: Cell,
    others: &(impl Iterator<Item = Cell> + Clone),
    memory: &mut Scratch<'_>,
) -> Option<Aim> {
    let sight = rule.sight();
    let mut best: Option<(Gain, Cell)> = None;
    let mut nearest = None;
    let is_first = others.clone().next().is_none();
    let mut flood = Flood::new(chart, memory, from);
    while let Some((cell, far, is_frontier)) = flood.next() {
        let is_over = |gain: Gain| best.is_none_or(|(best, _)| gain.is_over(best));
        let is_beyond =
            nearest.is_some_and(|(near, _)| far > near + HORIZONS * u32::from(rule.range_cells()));
        if is_beyond || !is_over(Gain { cells: sight.cells(), far }) {
            break;
        }
        if !is_frontier || !(is_first || others.clone().any(|other| rule.links(other, cell))) {
            continue;
        }
        nearest = nearest.or(Some((far, cell)));
        if flood.bound(cell).is_some_and(|bound| !is_over(Gain { cells: bound, far })) {
            continue;
        }
        let mut window = Window::new(chart, sight, cell);
        for other in others.clone() {
            window.take(sight, other);
        }
        let most = window.most();
        if most == 0 || !is_over(Gain { cells: most, far }) {
            continue;
        }
        let (all, own) = window.gain();
        flood.note(cell, all);
        let gain = Gain { cells: own, far };
        if gain.cells > 0 && is_over(gain) {
            best = Some((gain, cell));
        }
    }
    let (far, cell) = best.map(|(gain, cell)| (gain.far, cell)).or(nearest)?;
    Some(Aim::new(&flood, cell, far))
}

/// The shortest way from a cell to another one; `None` if there is none.
pub(super) fn way<W: AsRef<[[u64; 2]]>>(
    chart: &Chart<W>,
    from: Cell,
    to: Cell,
    memory: &mut Scratch<'_>,
) -> Option<Aim> {
    let mut flood = Flood::new(chart, memory, from);
    let (_, far, _) = core::iter::from_fn(|| flood.next()).find(|&(cell, ..)| cell == to)?;
    Some(Aim::new(&flood, to, far))
}

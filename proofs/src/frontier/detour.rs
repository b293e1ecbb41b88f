//! A robot that goes round an obstacle smaller than a cell (FRONTIER-12): how far it comes, along the
//! way to the next cell and across it, is written down here; of the kernel only the turns and the ways
//! are used. Lengths are in sides of a cell.

use tautline_kernel::choice::{Oracle, one_of};
use tautline_kernel::frontier::{DETOUR, FIVE_STEPS, midpoint};
use tautline_kernel::ground::{Cell, Side};
use tautline_kernel::position::{Belief, Odometry, Point};

use crate::engine::{Outcome, assume, require};

/// Parts of a cell's side.
const PARTS: u32 = 16;

/// Turns with the ways after them, and which errors are borne.
#[derive(Clone, Copy, Debug)]
pub(super) struct Round {
    legs: [(f64, f64); 2],
    /// The limit that E + F has to be below, in parts of a cell's side.
    below: u32,
}

impl Round {
    /// E + F < L/2.
    pub(super) const FIVE_STEPS: Self = Self { legs: DETOUR, below: PARTS / 2 };
    /// E + F ≤ L/2.
    pub(super) const AT_MOST: Self = Self { below: PARTS / 2 + 1, ..Self::FIVE_STEPS };
    /// The steps lead straight on.
    pub(super) const STRAIGHT: Self = Self { legs: [(0.0, FIVE_STEPS), (0.0, 0.0)], ..Self::FIVE_STEPS };
    /// Twice as many steps.
    pub(super) const TEN_STEPS: Self =
        Self { legs: [(DETOUR[0].0, 2.0 * FIVE_STEPS), DETOUR[1]], ..Self::FIVE_STEPS };
}

/// The bound of [`goes_round`], in words.
pub(super) fn errors() -> String {
    format!("every error of a place in 1/{PARTS} of a cell, along both axes, through each side")
}

/// FRONTIER-12: a robot that takes itself to be at the midpoint of its cell, and
/// meets an obstacle on its way through a side.
///
/// # Errors
/// [`Stop`](crate::engine::Stop) if the clause is broken.
pub(super) fn goes_round(round: &Round, oracle: &mut dyn Oracle) -> Outcome {
    let most = oracle.pick(PARTS);
    let five = (f64::from(PARTS) * FIVE_STEPS) as u32;
    assume(most + five < round.below)?;
    let mut off = || (f64::from(oracle.pick(2 * most + 1)) - f64::from(most)) / f64::from(PARTS);
    let off = Point::new(off(), off());
    let here = Cell::new(0, 0);
    let to = here.beyond(one_of(oracle, &Side::ALL));
    let mut belief = Belief::known(midpoint(here), 0.0);
    // Along the way to the next cell, and across it.
    let place = |belief: &Belief| {
        let (x, y) = (belief.at().x_m + off.x_m, belief.at().y_m + off.y_m);
        let (columns, rows) = (f64::from(to.x), f64::from(to.y));
        (x * columns + y * rows, y * columns - x * rows)
    };
    let mut goes = |turn: f64, way: f64| {
        belief.turned(turn, &Odometry::EXACT);
        belief.driven(way, &Odometry::EXACT);
        belief
    };
    let (turn, _) = Belief::known(midpoint(here), 0.0).towards(midpoint(to));
    let mut beside = goes(turn, 0.0);
    for (turn, way) in round.legs {
        beside = goes(turn, way);
    }
    let (from_along, from_across) = place(&beside);
    let is_inside = |along: f64, across: f64| along.abs() < 0.5 && across.abs() < 0.5;
    require(is_inside(from_along, from_across), "after the five steps it is in its cell still")?;
    let (turn, way) = beside.towards(midpoint(to));
    let (to_along, to_across) = place(&goes(turn, way));
    require(is_inside(to_along - 1.0, to_across), "it arrives in the next cell")?;
    let share = (0.5 - from_along) / (to_along - from_along);
    let passed = (from_across + share * (to_across - from_across)).abs();
    require(passed < 0.5, "it enters the next cell through the side between both")?;
    let beside = FIVE_STEPS / 2.0 - (1.0 + FIVE_STEPS) * f64::from(most) / f64::from(PARTS);
    require(passed >= beside - 1e-9, "it passes the middle of that side as far as is said")?;
    Ok(if beside > 0.0 { "it passes an obstacle" } else { "it may touch one" })
}

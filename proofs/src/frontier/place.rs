//! Robots whose positions have an error: which cell a robot takes itself to be in (FRONTIER-6, FRONTIER-7), and the
//! occupancy probability (FRONTIER-8). Places are on a lattice of 1/16 of a cell.

use tautline_kernel::choice::Oracle;
use tautline_kernel::frontier::{HALF, Occupancy, Place, SIDE, clamped, taken_for};
use tautline_kernel::ground::{Area, Cell};

use crate::engine::{Choices, Outcome, Replay, Stop, assume, require};
use crate::judge::{AnyCase, frontier as judge};

/// Parts of a cell's side.
const PARTS: i32 = 16;

/// One of them.
const PART: i32 = SIDE / PARTS;

/// Which errors a robot bears: of the fix that it believes before a move, of the one after it, and of its odometry.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ErrorBudget {
    /// How often the error of a fix counts.
    fixes: i32,
    /// How often that of the odometry counts.
    odometry: i32,
    /// The limit that the sum has to be below, in parts of a cell's side.
    below: i32,
}

impl ErrorBudget {
    /// Each fix is believed: 2E + D < L/2.
    pub(crate) const FIXES: Self = Self { fixes: 2, odometry: 1, below: PARTS / 2 };
    /// The cell is counted by moves: E + D < L/2.
    pub(crate) const TRACKED: Self = Self { fixes: 1, ..Self::FIXES };
    /// 2E + D ≤ L/2.
    pub(crate) const FIXES_AT_MOST: Self = Self { below: PARTS / 2 + 1, ..Self::FIXES };
    /// E + D ≤ L/2.
    pub(crate) const TRACKED_AT_MOST: Self = Self { fixes: 1, ..Self::FIXES_AT_MOST };
    /// The odometry is forgotten.
    pub(crate) const FIXES_ALONE: Self = Self { odometry: 0, ..Self::FIXES };
    /// The odometry of a robot that counts is forgotten.
    pub(crate) const TRACKED_ALONE: Self = Self { odometry: 0, ..Self::TRACKED };
}

/// The bound of [`believes`] and [`counts`], in words.
pub(super) fn errors() -> String {
    format!("every error of a fix and of a move in 1/{PARTS} of a cell, along one axis")
}

/// A number of parts from −most to most.
fn within(oracle: &mut dyn Oracle, most: i32) -> i32 {
    oracle.pick(2 * most as u32 + 1) as i32 - most
}

/// Errors that are borne, and where a robot really is after a move to the midpoint of the cell 1 of three, which had
/// them.
fn moved(bears: &ErrorBudget, oracle: &mut dyn Oracle) -> Result<(i32, i32), Stop> {
    let most = PARTS / 2;
    let (fix, odometry) = (oracle.pick(most as u32 + 1) as i32, oracle.pick(most as u32 + 1) as i32);
    assume(bears.fixes * fix + bears.odometry * odometry < bears.below)?;
    // It drives as far as its fix before the move says, which erred by so much.
    let at = -within(oracle, fix) + within(oracle, odometry);
    Ok((at, fix))
}

fn row() -> Result<Area, Stop> {
    Area::new(Cell::new(0, 0), Cell::new(2, 0)).ok_or(Stop::Assumed)
}

/// FRONTIER-6: a robot that believes each fix.
///
/// # Errors
/// [`Stop`] if the clause is broken.
pub(super) fn believes(bears: &ErrorBudget, oracle: &mut dyn Oracle) -> Outcome {
    let (at, most) = moved(bears, oracle)?;
    let fix = at + within(oracle, most);
    let taken = taken_for(row()?, Place::new(SIDE + fix * PART, 0));
    require(taken == Cell::new(1, 0), "a fix is taken for the cell that the robot has moved to")?;
    Ok(if at == 0 { "at the midpoint" } else { "beside the midpoint" })
}

/// FRONTIER-7: a robot that counts its cell by its moves.
///
/// # Errors
/// [`Stop`] if the clause is broken.
pub(super) fn counts(bears: &ErrorBudget, oracle: &mut dyn Oracle) -> Outcome {
    let (at, most) = moved(bears, oracle)?;
    let is_inside = at.abs() < PARTS / 2;
    require(is_inside, "the robot is inside the cell that it has counted")?;
    let fix = at + within(oracle, most);
    let counted = clamped(Cell::new(1, 0), Place::new(SIDE + fix * PART, 0));
    let is_nearer = (counted.x - SIDE - at * PART).abs() <= (fix - at).abs() * PART;
    require(is_nearer, "a fix within the counted cell errs by no more than the fix")?;
    Ok(if at == 0 { "at the midpoint" } else { "beside the midpoint" })
}

/// Two places within a cell of the midpoint of 0,0, in parts, those near to the midpoint first.
fn two(oracle: &mut dyn Oracle) -> [(i32, i32); 2] {
    let mut offset = || {
        let number = oracle.pick(PARTS as u32 + 1) as i32;
        if number % 2 == 0 { -number / 2 } else { number / 2 + 1 }
    };
    [(); 2].map(|()| (offset(), offset()))
}

/// The places that these choices of [`occupies`] make, written down for the judge.
pub(super) fn occupied(occupancy: &Occupancy, choices: &Choices) -> Option<Box<dyn AnyCase>> {
    let distance = match occupancy {
        Occupancy::Printed => judge::Distance::ToMidpoint,
        Occupancy::Rim => judge::Distance::ToSide,
        // It breaks nothing.
        Occupancy::Corrected => return None,
    };
    let answers: Vec<u32> = choices.all().collect();
    let mut replay = Replay::new(&answers);
    let places = two(&mut replay);
    let written = judge::Occupancy { clause: "FRONTIER-8", distance, places };
    replay.matches().then(|| Box::new(written) as Box<dyn AnyCase>)
}

/// The bound of [`occupies`], in words.
pub(super) fn places() -> String {
    format!("two places of a cell, its rim included, on a lattice of 1/{PARTS}")
}

/// FRONTIER-8: the occupancy probability at two places.
///
/// # Errors
/// [`Stop`] if the clause is broken.
pub(super) fn occupies(occupancy: &Occupancy, oracle: &mut dyn Oracle) -> Outcome {
    let cell = Cell::new(0, 0);
    let [near, far] = two(oracle).map(|(x, y)| Place::new(x * PART, y * PART));
    let distance = |place: Place| place.distance(Place::midpoint(cell));
    assume(distance(near) <= distance(far))?;
    let [near_by, far_off] = [near, far].map(|place| occupancy.of(cell, place));
    require(distance(near) > 0 || i32::from(near_by) == HALF, "it is 1 at the midpoint")?;
    require(near_by >= far_off, "it does not grow with the distance")?;
    let is_outside = distance(far) >= HALF as u32;
    require(!is_outside || far_off == 0, "it is 0 half a cell from the midpoint and farther")?;
    Ok(if is_outside { "outside" } else { "inside" })
}

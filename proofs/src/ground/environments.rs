//! The three environments of a cell (LATTICE-1), over every offset.

use tautline_kernel::choice::Oracle;
use tautline_kernel::ground::{Cell, Circle, neighbours};

use crate::engine::{Outcome, require};

/// The circles that E_S and E_C are derived from.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) struct Circles {
    /// That of E_S.
    pub safe: Circle,
    /// That of E_C.
    pub covered: Circle,
}

impl Circles {
    /// Those of the paper.
    pub(crate) const PUBLISHED: Self = Self { safe: Circle::SAFE, covered: Circle::COVERED };
}

/// How many columns and rows LATTICE-1 looks in every direction.
const FAR: u32 = 4;

/// The bound of [`environments`], in words.
pub(super) fn offsets() -> String {
    format!("{} offsets", (2 * FAR + 1).pow(2))
}

/// LATTICE-1: every offset is in the environments that the paper draws, and in no other.
///
/// # Errors
/// [`crate::engine::Stop`] if the clause is broken.
pub(super) fn environments(circles: &Circles, oracle: &mut dyn Oracle) -> Outcome {
    let mut offset = || oracle.pick(2 * FAR + 1) as i16 - FAR as i16;
    let (dx, dy) = (offset(), offset());
    let (centre, cell) = (Cell::new(0, 0), Cell::new(dx, dy));
    let block = dx.abs() <= 1 && dy.abs() <= 1;
    let tips = dx.abs().max(dy.abs()) == 2 && dx.abs().min(dy.abs()) == 0;
    let cross = dx.abs() + dy.abs() <= 1;
    require(neighbours(centre, cell) == cross, "E_N is the cell and its four side neighbours")?;
    require(circles.safe.covers(centre, cell) == block, "E_S is the block of nine cells")?;
    require(circles.covered.covers(centre, cell) == (block || tips), "E_C is E_S and the four tips")?;
    Ok(match (cross, block, tips) {
        (true, _, _) => "in E_N",
        (_, true, _) => "in E_S alone",
        (_, _, true) => "in E_C alone",
        (false, false, false) => "in none",
    })
}

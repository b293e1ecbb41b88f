//! The frontier cell that a robot of a pack goes to, and the way there.

use super::flood::Flood;
use crate::ground::{Cell, Side};

/// Where a robot is going.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub(super) struct Aim {
    pub(super) cell: Cell,
    /// Steps to it.
    pub(super) far: u32,
    /// The first of them, two bits a step, the next one lowest. A robot that
    /// has taken them all looks for its way again.
    steps: u128,
    known: u32,
}

/// Steps that are kept.
const MOST_STEPS: u32 = u128::BITS / 2;

impl Aim {
    /// The cell `to` at the end of a flood that began where the robot is, `far` steps away.
    pub(super) fn new<W: AsRef<[[u64; 2]]>>(flood: &Flood<'_, '_, W>, to: Cell, far: u32) -> Self {
        let (mut steps, mut cell) = (0, to);
        while let Some(side) = flood.side_before(cell) {
            steps = steps << 2 | side as u128;
            cell = cell.beyond(side.opposite());
        }
        Self { cell: to, far, steps, known: far.min(MOST_STEPS) }
    }

    /// The next step; `None` if it is not known.
    pub(super) fn side(&self) -> Option<Side> {
        if self.known == 0 { None } else { Side::ALL.get((self.steps & 3) as usize).copied() }
    }

    /// The aim after the next step.
    pub(super) const fn after_step(self) -> Self {
        let (far, known) = (self.far.saturating_sub(1), self.known.saturating_sub(1));
        Self { far, steps: self.steps >> 2, known, ..self }
    }
}

//! Robots that explore cells (Rajesh, Nagaraja and Suja 2024) in a whole layout: the kernel's robots, a layout that
//! answers for what they see, messages with a range that may be lost, and positions with an error; and rivals that
//! assign frontier cells to robots.
//!
//! In a team move every robot that stands decides and looks, in the order of the robots, and all that enter a cell
//! arrive together. A slot is a team move. What is left to chance is drawn from `ChaCha8`, seeded with the seed of the
//! run as layouts are, with the tag `frontier`.

mod allowance;
mod assignment;
mod chart;
mod field;
mod place;
mod radio;
mod team;
mod waves;

pub use allowance::Allowance;
pub use assignment::{AssignedTeam, Assignment};
pub use place::cell_at;
pub use team::Explorers;

use tautline_kernel::chain::Kind;
use tautline_kernel::ground::{Cell, Side, Step};
use tautline_proofs::run::Frame;

/// Team moves for each cell without anything new, after which a run is over.
const PATIENCE: usize = 100;

/// The deeds of each robot in a team move.
#[derive(Clone, Debug)]
pub(crate) struct Moves {
    steps: Vec<Step>,
    blocked: Vec<bool>,
}

impl Moves {
    /// Every robot stays.
    pub(crate) fn none(robots: usize) -> Self {
        Self { steps: vec![Step::Stay; robots], blocked: vec![false; robots] }
    }

    /// A robot goes through a side.
    pub(crate) fn goes(&mut self, robot: usize, side: Side) {
        self.steps[robot] = Step::Cross(side);
    }

    /// A robot has tried a side in vain.
    pub(crate) fn bumps(&mut self, robot: usize, side: Side) {
        self.goes(robot, side);
        self.blocked[robot] = true;
    }

    pub(crate) fn frame(self, cells: &[Cell]) -> Frame {
        Frame { kind: Kind::Advance, steps: self.steps, blocked: self.blocked, cells: cells.to_vec() }
    }
}

/// The outcome of a team move.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum TeamEnd {
    /// No robot will ever do anything, and every robot knows that nothing is left.
    Known,
    /// No robot will ever do anything.
    Still,
    /// Every robot would do the same again, for ever.
    Endless,
    /// Nothing new was found for so long that the team may go on for ever, or be slow.
    Idle,
}

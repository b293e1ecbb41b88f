//! A run written down for the judge of counterexamples, who shares no code with what made the run.

use tautline_kernel::chain::Kind;
use tautline_kernel::lattice::Cell;
use tautline_proofs::judge::{Exhibit, Move, Place, Repairs};
use tautline_proofs::run::{Breach, Frame};

use crate::explore::{RuleName, Setup};

/// The run of `setup` with these frames, said to break `clause`.
pub fn exhibit(setup: &Setup, clause: Breach, frames: &[Frame]) -> Exhibit {
    let layout = &setup.layout;
    Exhibit {
        clause: clause.clause().to_owned(),
        repairs: match setup.rule {
            RuleName::Published => Repairs::Without,
            RuleName::Repaired => Repairs::With,
        },
        width: layout.width().into(),
        height: layout.height().into(),
        walls: layout
            .walls()
            .map(|wall| (place(wall.cell()), place(wall.cell().beyond(wall.side()))))
            .collect(),
        blocked: layout.cells().filter(|&cell| !layout.is_free(cell)).map(place).collect(),
        base: place(setup.base),
        robots: setup.robots.into(),
        moves: frames.iter().map(written_down).collect(),
    }
}

/// A team move of a chain as the judge reads it.
pub fn written_down(frame: &Frame) -> Move {
    Move {
        is_backtrack: match frame.kind {
            Kind::Advance => false,
            Kind::Backtrack => true,
        },
        tried: frame.steps.iter().map(|&step| place(Cell::new(0, 0).after(step))).collect(),
        blocked: frame.blocked.clone(),
        places: frame.cells.iter().copied().map(place).collect(),
    }
}

fn place(cell: Cell) -> Place {
    (cell.x.into(), cell.y.into())
}

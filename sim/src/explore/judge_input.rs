//! A run written down for the judges of counterexamples, who share no code with what made the run.

use tautline_proofs::chain::breach::written;
use tautline_proofs::judge::chain::{JudgeInput, Repairs};
use tautline_proofs::run::{Frame, place, sides};

use super::{RuleId, Setup};

/// The run of `setup` with these frames, said to break `clause`.
pub fn judge_input(setup: &Setup, clause: &'static str, frames: &[Frame]) -> JudgeInput {
    let layout = &setup.layout;
    JudgeInput {
        clause,
        repairs: if setup.rule == RuleId::PUBLISHED { Repairs::Without } else { Repairs::With },
        width: layout.width().into(),
        height: layout.height().into(),
        walls: layout.walls().map(sides).collect(),
        blocked: layout.cells().filter(|&cell| !layout.is_free(cell)).map(place).collect(),
        base: place(setup.base),
        robots: setup.robots.into(),
        moves: frames.iter().map(written).collect(),
    }
}

//! A run written down for the judges of counterexamples, who share no code with what made the run.

use tautline_proofs::chain::breach::written;
use tautline_proofs::judge::chain::{JudgeInput, Repairs};
use tautline_proofs::judge::floor;
use tautline_proofs::run::{Frame, place, sides};

use super::{ClauseId, RuleId, Setup};

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

/// The run of the only agent of `setup` with these frames, which is done in the last one, said to break `clause`.
pub fn of_agent(setup: &Setup, clause: ClauseId, frames: &[Frame]) -> floor::JudgeInput {
    let layout = &setup.layout;
    let turn = |(number, frame): (usize, &Frame)| floor::Turn {
        agent: 0,
        to: frame.cells.first().copied().map_or((-1, -1), place),
        is_done: number == frames.len(),
    };
    floor::JudgeInput {
        clause: clause.as_str(),
        width: layout.width().into(),
        height: layout.height().into(),
        walls: layout.walls().map(sides).collect(),
        blocked: layout.cells().filter(|&cell| !layout.is_free(cell)).map(place).collect(),
        starts: setup.starts().into_iter().map(place).collect(),
        turns: (1..).zip(frames).map(turn).collect(),
        round: 0,
    }
}

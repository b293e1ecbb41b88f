//! The judge of counterexamples. It reads a layout and the moves of a run as anyone may write them down, knows only
//! the sentences of `SPEC.md`, and has geometry, history and knowledge of its own: it shares no code with the
//! planner, the search or the simulator.

mod court;
mod duty;
mod judge_input;
mod milestone;
mod place;
mod violations;

use court::Court;
use duty::{Duty, MOST_LED};
pub use judge_input::{JudgeInput, Move, Repairs};
pub use milestone::Sooner;
use violations::{Violation, broken};

use super::Case;
pub use super::{Objection, Place};

/// Judges a run: whether its moves are possible in its layout and admitted by its rule; whether in each of them
/// the leader does what its rule says, and a backtrack is due; whether each of the walls was met; and whether the last
/// move, and no earlier one, breaks the clause, or the run is over after it and not before, and its end breaks the
/// clause. What followers prefer among the moves that are admitted is not asked, nor by which way a chain unfolds. Of
/// more than 12 robots it is not asked either what the leader does, so that the end of their runs cannot be judged.
///
/// # Errors
/// The first [`Objection`].
pub fn judge(input: &JudgeInput) -> Result<(), Objection> {
    let Some(clause) = broken(input.clause) else {
        return Err("there is no such clause to break in a run".into());
    };
    let first = input.moves.first().filter(|_| input.robots >= 2);
    let Some(first) = first else { return Err("a counterexample needs two robots and a move".into()) };
    if !input.is_free(input.base) {
        return Err("the base is not a free cell of the layout".into());
    }
    if matches!(clause, Violation::AtEnd(_)) && input.robots > MOST_LED {
        return Err("the judge cannot say of more than 12 robots whether their run is over".into());
    }
    let mut court = Court::new(input, first.places.len());
    for (index, made) in input.moves.iter().enumerate() {
        let at = index + 1;
        let object = |what| Objection { at, what };
        court.are_all_there(made).map_err(object)?;
        if input.robots <= MOST_LED {
            court.duty().and_then(|duty| duty.is_done_by(made)).map_err(object)?;
        }
        court.hear(made).map_err(object)?;
        let is_last = at == input.moves.len();
        if let Violation::ByMove(is_broken) = clause {
            match (is_broken(&court, made), is_last) {
                (true, false) => return Err(object("the clause is broken before the last move")),
                (false, true) => return Err(object("the last move does not break the clause")),
                (true, true) | (false, false) => {}
            }
        }
        court.places.clone_from(&made.places);
    }
    if let Violation::AtEnd(is_broken) = clause {
        if court.duty()? != Duty::Nothing {
            return Err("the run goes on after the last move".into());
        }
        if !is_broken(&court)? {
            return Err("the end of the run does not break the clause".into());
        }
    }
    if input.walls.iter().any(|wall| !court.walls.contains(wall)) {
        return Err("a wall was never met".into());
    }
    Ok(())
}

impl Case for JudgeInput {
    fn clause(&self) -> &'static str {
        self.clause
    }

    fn step(&self) -> &'static str {
        "team move"
    }

    fn judge(&self) -> Result<(), Objection> {
        judge(self)
    }
}

/// Whether the judge knows this clause.
pub fn judges(clause: &str) -> bool {
    broken(clause).is_some()
}

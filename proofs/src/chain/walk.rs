//! One pair of neighbours in the chain while it unfolds along a walk: the inductive step of what CHAIN-13 rests on.
//! Whatever the walk looks like where they are, what they plan is admitted, and after the move, if no wall was met,
//! they are again such a pair. A wall ends the unfolding.

use tautline_kernel::chain::{Move, Role, goes_on};
use tautline_kernel::choice::{Oracle, one_of};
use tautline_kernel::ground::{Cell, Side, Step};

use super::subject::Subject;
use crate::engine::{Outcome, assume, require};

/// R_i and R_{i+1} on the walk. Cells are counted along it, from the cell of R_i on.
struct Pair {
    /// The next two cells of the walk, and that of R_i before them.
    walk: [Cell; 3],
    /// Whether R_i is in the base, where a walk begins.
    is_base: bool,
    /// Where R_i stops: here, or later.
    last: usize,
    /// Where R_{i+1} stops.
    last_ahead: usize,
    /// Where R_{i+1} is.
    ahead: usize,
}

impl Pair {
    /// Whether R_{i+1} can be where it is: not behind R_i, outside the base not with it, and not more than a cell
    /// ahead unless R_i has stopped and it has not passed its own last stop.
    const fn is_on_the_walk(&self, own: usize) -> bool {
        let is_apart = own < self.ahead || (self.is_base && own == 0 && self.ahead == 0);
        is_apart && self.ahead <= self.last_ahead && (self.ahead <= own + 1 || own == self.last)
    }

    /// One of the pair plans to go on, or to stay where it is.
    fn plan(&self, at: usize, goes_on: bool, known_open: bool) -> Move {
        let from = self.walk[at];
        match Side::ALL.into_iter().find(|&side| goes_on && from.beyond(side) == self.walk[at + 1]) {
            Some(side) => Move { from, step: Step::Cross(side), known_open },
            None => Move::stay(from),
        }
    }
}

/// The bound of [`unfolding`], in words.
pub(super) fn walks() -> String {
    "every pair of neighbours on a walk, and every turn of it".to_owned()
}

/// CHAIN-13, inductive step: neighbours on a walk plan what is admitted, and stay neighbours on it.
///
/// # Errors
/// [`crate::engine::Stop`] if the choices are no case, or break the clause.
pub(super) fn unfolding(observed: &Subject, oracle: &mut dyn Oracle) -> Outcome {
    let rule = &observed.rule;
    let start = Cell::new(0, 0);
    let sides = [one_of(oracle, &Side::ALL), one_of(oracle, &Side::ALL)];
    // A walk comes to no cell twice.
    assume(sides[1] != sides[0].opposite())?;
    let walk = [start, start.beyond(sides[0]), start.beyond(sides[0]).beyond(sides[1])];
    // Two stops have a side between them, or a corner and the cell that the walk turns in.
    let has_stopped = oracle.flip();
    let is_corner = oracle.flip();
    assume(!is_corner || sides[0] != sides[1])?;
    let last = usize::from(!has_stopped);
    let last_ahead = if has_stopped && !is_corner { 1 } else { 2 };
    let pair = Pair { walk, is_base: oracle.flip(), last, last_ahead, ahead: oracle.pick(3) as usize };
    assume(pair.is_on_the_walk(0))?;
    let ahead_goes_on = oracle.flip();
    assume(!ahead_goes_on || pair.ahead < pair.last_ahead)?;
    let planned_ahead = pair.ahead + usize::from(ahead_goes_on);
    let goes_on = goes_on(0, pair.last, planned_ahead);
    let known_open = oracle.flip();
    let own = pair.plan(0, goes_on, known_open);
    let ahead = pair.plan(pair.ahead, ahead_goes_on, known_open);
    require(rule.admits_ahead(own, ahead), "the robot behind plans what is admitted behind the one ahead")?;
    require(
        !ahead_goes_on || rule.admits_behind(ahead.to(), own.from),
        "the robot ahead plans what is admitted ahead of the one behind",
    )?;
    // Outside the base those on the walk are one to a cell: whoever goes on finds the robot ahead at most.
    let entry = rule.admits_entry(Role::Leader, 1) && rule.admits_entry(Role::Follower, 1);
    require(entry, "a robot may enter a cell with one robot in it")?;
    let after = Pair { ahead: planned_ahead, ..pair };
    require(after.is_on_the_walk(usize::from(goes_on)), "they are neighbours on the walk again")?;
    Ok(match (goes_on, ahead_goes_on) {
        (true, _) => "both go on",
        (false, true) => "the robot ahead goes on",
        (false, false) => "both stay",
    })
}

//! Three robots and a cell outside the base: the inductive step of CHAIN-2. As long as it is any three robots and
//! any cell, no three are ever in one.

use tautline_kernel::chain::{Condition, Role};
use tautline_kernel::choice::{Oracle, one_of};
use tautline_kernel::ground::{Cell, Step};

use super::pair::World;
use super::subject::Subject;
use crate::engine::{Outcome, assume, require};

/// How many robots must not be in one cell.
const ROBOTS: usize = 3;

/// The bound of [`crowding`], in words.
pub(super) fn crowds() -> String {
    format!("any {ROBOTS} robots in a cell or beside it, every plan and answer")
}

/// CHAIN-2, inductive step: if not all three are in the cell, they are not after the move.
///
/// # Errors
/// [`crate::engine::Stop`] if the choices are no case, or break the clause.
pub(super) fn crowding(observed: &Subject, oracle: &mut dyn Oracle) -> Outcome {
    let rule = &observed.rule;
    let cell = Cell::new(0, 0);
    // One of them may be the leader, or none.
    let leader = oracle.pick(ROBOTS as u32 + 1) as usize;
    let from = [(); ROBOTS].map(|()| cell.after(one_of(oracle, &Step::ALL)));
    let present = from.iter().filter(|&&at| at == cell).count();
    assume(present < ROBOTS)?;
    let mut world = World::<ROBOTS>::new();
    let tried = from.map(|at| world.pick(at, oracle));
    let entering = |robot: usize| from[robot] != cell && tried[robot].plan.to() == cell;
    for robot in 0..ROBOTS {
        let role = if robot == leader { Role::Leader } else { Role::Follower };
        // Those of the three that are there are others, since this one is not.
        assume(!entering(robot) || rule.admits_entry(role, present))?;
    }
    let planned = tried.iter().filter(|robot| robot.plan.to() == cell).count();
    assume(planned < 2 || !rule.has(Condition::Distinct))?;
    let arrived = tried.iter().filter(|robot| robot.arrived == cell).count();
    require(arrived < ROBOTS, "no three robots end in one cell outside the base")?;
    Ok(match (present, arrived) {
        (2, _) => "two were there",
        (_, 0) => "none arrives",
        (_, 1) => "one arrives",
        _ => "two arrive",
    })
}

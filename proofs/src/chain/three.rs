//! The chain of three as published, during one team move: the inductive step of CHAIN-15. The base stands still, so
//! R_2 can stay wherever it is; and it prefers to, unless that costs R_3 a way. The order of preference beyond that
//! first place is left open.

use tautline_kernel::chain::{Condition, Move, Rule};
use tautline_kernel::choice::Oracle;
use tautline_kernel::ground::{Cell, Circle, Step};

use super::pair::{self, World};
use super::subject::Subject;
use crate::engine::{Outcome, assume, require};

/// How many columns and rows R_2 is looked at from the base, and R_3 from R_2.
const FAR: [u32; 2] = [1, 2];

/// The bound of [`contact`], in words.
pub(super) fn places() -> String {
    let [second, third] = FAR;
    format!("R_2 up to {second} from the base, R_3 up to {third} from R_2, every plan and answer")
}

/// A cell at most so many columns and rows from `cell`.
fn near(cell: Cell, far: u32, oracle: &mut dyn Oracle) -> Cell {
    let mut offset = || oracle.pick(2 * far + 1) as i16 - far as i16;
    Cell::new(cell.x + offset(), cell.y + offset())
}

/// Whether `rule` admits what R_2 and R_3 plan, wherever R_2 rather goes.
fn is_admitted(rule: &Rule, base: Cell, own: Move, leader: Move) -> bool {
    let to = leader.to();
    pair::admits(rule, own, leader)
        && pair::admits(rule, Move::stay(base), own)
        && (own.to() != to || to == base || !rule.has(Condition::Distinct))
}

/// Whether R_2 in the cell `at` prefers to stay.
fn stays_first(rule: &Rule, base: Cell, at: Cell, leader: Move) -> bool {
    is_admitted(rule, base, Move::stay(at), leader) && rule.high_steps(at, leader).has(Step::Stay)
}

/// Whether `rule` admits what R_2 and R_3 plan, and R_2 stays if it prefers to.
pub(super) fn admits(rule: &Rule, base: Cell, own: Move, leader: Move) -> bool {
    is_admitted(rule, base, own, leader)
        && (own.step == Step::Stay || !stays_first(rule, base, own.from, leader))
}

/// CHAIN-15, inductive step: a base, R_2 in E_S of it, and R_3 in E_C of R_2.
///
/// # Errors
/// [`Stop`](crate::engine::Stop) if the choices are no case, or break the clause.
pub(super) fn contact(observed: &Subject, oracle: &mut dyn Oracle) -> Outcome {
    let rule = &observed.rule;
    let base = Cell::new(0, 0);
    let at = near(base, FAR[0], oracle);
    let ahead = near(at, FAR[1], oracle);
    assume(Circle::COVERED.covers(at, ahead))?;
    let mut world = World::<2>::new();
    let leader = world.pick(ahead, oracle);
    let follower = world.pick(at, oracle);
    let stays_first = stays_first(rule, base, at, leader.plan);
    assume(admits(rule, base, follower.plan, leader.plan))?;
    require(
        Circle::COVERED.covers(follower.arrived, leader.arrived),
        "R_3 is in E_C of R_2 after the move, and R_2 of it",
    )?;
    require(Circle::SAFE.covers(base, follower.arrived), "R_2 is in E_S of the base after the move")?;
    Ok(if stays_first { "R_2 stays" } else { "R_2 may do anything else" })
}

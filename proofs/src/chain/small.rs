//! Small clauses over every value of their arguments: the message (CHAIN-8) and the ring argument (CHAIN-10).

use core::cmp::Ordering;

use tautline_kernel::chain::{Message, Move, Outcome as StepOutcome};
use tautline_kernel::choice::{Oracle, one_of};
use tautline_kernel::ground::{Cell, Step};

use super::subject::Subject;
use crate::engine::{Outcome, assume, require};

/// Values of a byte.
const BYTES: u32 = 1 << u8::BITS;

/// The bound of [`message`], in words.
pub(super) fn messages() -> String {
    format!("every message, all {BYTES} bytes")
}

/// CHAIN-8: a message survives its byte, and a byte that is no message is refused.
///
/// # Errors
/// [`crate::engine::Stop`] if the clause is broken.
pub(super) fn message(observed: &Subject, oracle: &mut dyn Oracle) -> Outcome {
    if oracle.flip() {
        let byte = oracle.pick(BYTES) as u8;
        let Ok(message) = Message::decode(byte) else { return Ok("no message") };
        require(message.encode() == byte, "a message has one byte")?;
        return Ok("a byte");
    }
    let step = one_of(oracle, &Step::ALL);
    let outcome = one_of(oracle, &[StepOutcome::Arrived, StepOutcome::Blocked, StepOutcome::TookBack]);
    assume(step != Step::Stay || outcome != StepOutcome::Blocked)?;
    let message = Message { step, outcome };
    let byte = observed.deception.carry(message.encode());
    require(
        byte < 1 << 5,
        "a message is five bits: three for the step, one for a wall, one for a backtrack",
    )?;
    require(Message::decode(byte) == Ok(message), "a message is read as it was sent")?;
    Ok("a message")
}

/// Columns and rows in which the robot behind is looked at, from the base on.
const BEHIND: u32 = 4;

/// How many columns and rows the robot ahead may be from the one behind.
const AHEAD: u32 = 3;

/// The bound of [`ring_of_neighbours`], in words.
pub(super) fn pairs_in_rings() -> String {
    let last = BEHIND - 1;
    format!("every pair up to {AHEAD} apart, the robot behind in 0…{last} by 0…{last}")
}

/// CHAIN-10, first fact: a robot is at most one ring farther out than the one behind it, so that R_N alone comes
/// to ring N−1.
///
/// # Errors
/// [`crate::engine::Stop`] if the clause is broken.
pub(super) fn ring_of_neighbours(observed: &Subject, oracle: &mut dyn Oracle) -> Outcome {
    let behind = Cell::new(oracle.pick(BEHIND) as i16, oracle.pick(BEHIND) as i16);
    let mut offset = || oracle.pick(2 * AHEAD + 1) as i16 - AHEAD as i16;
    let ahead = Cell::new(behind.x + offset(), behind.y + offset());
    assume(observed.rule.admits_ahead(Move::stay(behind), Move::stay(ahead)))?;
    let farther = ring(ahead).cmp(&ring(behind));
    require(ring(ahead) <= ring(behind) + 1, "a robot is at most one ring farther out than the one behind")?;
    Ok(match farther {
        Ordering::Less => "farther in",
        Ordering::Equal => "in the same ring",
        Ordering::Greater => "farther out",
    })
}

/// Which ring round the base in 0,0 a cell is in.
fn ring(cell: Cell) -> u16 {
    let (dx, dy) = Cell::new(0, 0).apart(cell);
    dx.max(dy)
}

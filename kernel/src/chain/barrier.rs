//! The barrier between two team moves, where bytes can be lost (ours: the paper lets every byte arrive). A robot plans
//! the next team move only when it has the bytes of all others about the last one. Two bits that a message leaves free
//! count team moves, modulo 4. A robot that misses a byte repeats its own; whoever hears a byte of the team move before
//! says its byte of then again, with a third bit, so that nobody answers it in turn. One bit would not do: that
//! repeated byte looks like one about the next team move to a robot that is one ahead. So a lost, repeated or late byte
//! delays a team and never misleads it (CHAIN-20), and a robot that falls silent stops it where it is, in contact
//! (CHAIN-19). No byte may be late by four team moves.

use super::message::{Damage, Message};

/// The place of the two bits of a byte that count team moves.
const TURN_SHIFT: u32 = 5;
const TURN_BITS: u8 = 0b11 << TURN_SHIFT;
/// The bit of a byte that was asked for by one of the team move before.
const ANSWER_BIT: u8 = 1 << 7;

/// The effect of a byte.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum ByteEffect {
    /// It is about this team move, and was missing.
    New,
    /// It is about this team move, and was known.
    Again,
    /// It is about the team move before: its sender lacks the byte that is to be said again.
    Late(u8),
    /// It is about the team move after this: its sender goes on as soon as it has this robot's byte about it.
    Early,
    /// It is about no team move that a byte can be about now, or of nobody else in the team.
    Foreign,
}

/// One robot's side of the barrier.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Barrier<const ROBOTS: usize> {
    robots: usize,
    own: usize,
    /// Team moves that all bytes have come of.
    turn: u32,
    /// This robot's byte about the team move before this.
    before: Option<u8>,
    /// By robot, the base first: the messages about this team move, this robot's among them.
    messages: [Option<u8>; ROBOTS],
}

impl<const ROBOTS: usize> Barrier<ROBOTS> {
    /// The barrier of the robot in place `own` of `robots`, both at most `ROBOTS`; the base, in place 0, says nothing.
    pub const fn new(robots: usize, own: usize) -> Self {
        Self { robots, own, turn: 0, before: None, messages: [None; ROBOTS] }
    }

    /// Team moves that all bytes have come of.
    pub const fn turn(&self) -> u32 {
        self.turn
    }

    /// The byte that carries `message` about team move `turn`.
    const fn byte(turn: u32, message: u8) -> u8 {
        message | ((turn % 4) as u8) << TURN_SHIFT
    }

    /// Tells its own `message` about this team move. Returns the byte to be sent; the same may be sent again.
    pub fn say(&mut self, message: u8) -> u8 {
        if let Some(own) = self.messages.get_mut(self.own) {
            *own = Some(message);
        }
        Self::byte(self.turn, message)
    }

    /// The byte to be sent again, if it has said one about this team move.
    pub fn again(&self) -> Option<u8> {
        let own = self.messages.get(self.own).copied().flatten()?;
        Some(Self::byte(self.turn, own))
    }

    /// Takes the `byte` that the robot in place `from` sent.
    ///
    /// # Errors
    /// [`Damage`] if it is no message, or another one than that robot has sent about this team move.
    pub fn hear(&mut self, from: usize, byte: u8) -> Result<ByteEffect, Damage> {
        let (message, is_answer) = (byte & !(TURN_BITS | ANSWER_BIT), byte & ANSWER_BIT != 0);
        let byte = byte & !ANSWER_BIT;
        Message::decode(message)?;
        if from == self.own || from == 0 || from >= self.robots.min(ROBOTS) {
            return Ok(ByteEffect::Foreign);
        }
        let before = self.turn.wrapping_sub(1);
        if byte == Self::byte(before, message) {
            let answer = |own| ByteEffect::Late(Self::byte(before, own) | ANSWER_BIT);
            return Ok(self.before.filter(|_| !is_answer).map_or(ByteEffect::Foreign, answer));
        }
        if byte != Self::byte(self.turn, message) {
            let is_early = byte == Self::byte(self.turn.wrapping_add(1), message);
            return Ok(if is_early { ByteEffect::Early } else { ByteEffect::Foreign });
        }
        match self.messages[from].replace(message) {
            None => Ok(ByteEffect::New),
            Some(known) if known == message => Ok(ByteEffect::Again),
            Some(known) => {
                self.messages[from] = Some(known);
                Err(Damage::OtherStep(from + 1))
            }
        }
    }

    /// The messages of R_2 … R_N about this team move, when all have come: then the next one begins. Else `None`.
    pub fn pass(&mut self) -> Option<[u8; ROBOTS]> {
        let mut messages = [0; ROBOTS];
        for robot in 1..self.robots.min(ROBOTS) {
            messages[robot - 1] = self.messages[robot]?;
        }
        self.before = self.messages.get(self.own).copied().flatten();
        self.messages = [None; ROBOTS];
        self.turn = self.turn.wrapping_add(1);
        Some(messages)
    }
}

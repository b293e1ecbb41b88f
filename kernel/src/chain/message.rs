//! A robot's broadcast after a team move [Kovács 2011, III.D]: its step in three bits and whether it met a wall in one.
//! Of the byte's other four bits one says that the move was taken back, so that a log of messages read backwards pairs
//! itself (clause CHAIN-8).

use crate::error::sentences;
use crate::ground::Step;

/// How a robot's step came out.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Outcome {
    /// It is where the plan sent it.
    Arrived,
    /// It met a wall and is where it was. A robot that stays cannot be blocked.
    Blocked,
    /// The step was part of a backtrack.
    TookBack,
}

/// One robot's message about one team move.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Message {
    /// The step that it tried.
    pub step: Step,
    /// The outcome of the step.
    pub outcome: Outcome,
}

/// Why messages cannot be those of this team. Robots are numbered from 1, the base.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Damage {
    /// A byte is no message.
    Byte(u8),
    /// It is not as long as the run.
    Length {
        /// Bytes it has.
        bytes: usize,
        /// Bytes that the team sent: one for each robot but the base and each team move.
        sent: usize,
    },
    /// The move to be taken back was a backtrack itself, of this robot at least.
    TakenBack(usize),
    /// With the move taken back, this robot and the one behind it would not be in contact.
    OutOfContact(usize),
    /// With the move taken back, three robots would be in one cell other than the base.
    Crowded,
    /// All moves would be taken back, and this robot would not be in the base.
    NotHome(usize),
    /// This robot's message about a team move does not fit the plan.
    OtherStep(usize),
    /// This robot says that it crossed a side which nobody is known to have crossed, or met a wall which is not known
    /// to be one; or of a side that is new to the team it says something else than another robot.
    OtherWorld(usize),
}

sentences!(Damage {
    Self::Byte(byte) => "byte {byte:#04x} is no message of the chain";
    Self::Length { bytes, sent } =>
        "there are {bytes} messages, the team sent {sent}: keep all of them, in their order";
    Self::TakenBack(robot) => "R_{robot} says that the move to be taken back was a backtrack itself";
    Self::OutOfContact(robot) =>
        "with the move taken back, R_{robot} would have no contact with R_{}", robot.saturating_sub(1);
    Self::Crowded => "with the move taken back, three robots would be in one cell";
    Self::NotHome(robot) => "with all moves taken back, R_{robot} would not be in the base";
    Self::OtherStep(robot) => "R_{robot} says that it did something else than planned";
    Self::OtherWorld(robot) => "what R_{robot} says of a side contradicts what the team knows of it";
});

const WALL_BIT: u8 = 1 << 3;
const BACKTRACK_BIT: u8 = 1 << 4;

impl Message {
    /// The step that the robot really made: none if it was blocked.
    pub const fn made(self) -> Step {
        match self.outcome {
            Outcome::Arrived | Outcome::TookBack => self.step,
            Outcome::Blocked => Step::Stay,
        }
    }

    /// Bits 0 to 2: the step's place in direction order. Bit 3: met a wall. Bit 4: taken back.
    pub const fn encode(self) -> u8 {
        let step = self.step.place() as u8;
        match self.outcome {
            Outcome::Arrived => step,
            Outcome::Blocked => step | WALL_BIT,
            Outcome::TookBack => step | BACKTRACK_BIT,
        }
    }

    /// The message in a byte.
    ///
    /// # Errors
    /// [`Damage`] if no message is encoded so.
    pub fn decode(byte: u8) -> Result<Self, Damage> {
        let step = *Step::ALL.get(usize::from(byte & 0b111)).ok_or(Damage::Byte(byte))?;
        let outcome = match byte & !0b111 {
            0 => Outcome::Arrived,
            WALL_BIT if step != Step::Stay => Outcome::Blocked,
            BACKTRACK_BIT => Outcome::TookBack,
            _ => return Err(Damage::Byte(byte)),
        };
        Ok(Self { step, outcome })
    }

    pub(super) const fn is_backtrack(byte: u8) -> bool {
        byte & BACKTRACK_BIT != 0
    }
}

//! Two robots at the barrier between team moves while bytes are lost, repeated and late (CHAIN-20): their bytes wait in
//! the air, those of one robot in the order in which it sent them, and what happens to which of them next is open. Then
//! nothing is lost any more: the air must be empty soon while no robot repeats its own byte, and both robots must go on
//! when they do.

use std::collections::VecDeque;

use tautline_kernel::chain::{Barrier, ByteEffect, Message, Outcome as Came};
use tautline_kernel::choice::Oracle;
use tautline_kernel::ground::Step;

use crate::engine::{Outcome, Stop, require};

/// How the robots read the bits of a byte that carry no message.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Reading {
    /// As they were sent.
    True,
    /// Every byte is taken for one about the present team move.
    Present,
    /// One of the two bits alone is sent.
    OneBit,
    /// As they were sent, but nobody says a byte of the team move before again.
    Mute,
    /// The two bits that count team moves as they were sent, and the third bit never.
    NoAnswers,
}

/// The bits that count team moves, and the lower of them.
const BITS: u8 = 0b11 << 5;
const LOW_BIT: u8 = 1 << 5;

/// The bit of an answer.
const ANSWER_BIT: u8 = 1 << 7;

/// Things that happen before nothing is lost any more.
const EVENTS: u32 = 7;

/// Bytes of one robot that are in the air.
const IN_THE_AIR: usize = 2;

/// The places of the two robots, behind the base.
const PLACES: [usize; 2] = [1, 2];

/// The bound of [`barrier`], in words.
pub(super) fn losses() -> String {
    format!(
        "two robots, {EVENTS} bytes sent, heard, lost or heard and repeated, none \
         repeated with {IN_THE_AIR} of it in the air"
    )
}

/// The message of the robot in `place` about team move `turn`: another one in each of three that follow each other.
fn message(place: usize, turn: u32) -> u8 {
    let step = Step::ALL[(place + turn as usize) % 4];
    Message { step, outcome: if turn % 3 == 2 { Came::Blocked } else { Came::Arrived } }.encode()
}

/// The two robots, and the air.
#[derive(Clone)]
struct Pair {
    reading: Reading,
    barriers: [Barrier<3>; 2],
    /// Bytes of each robot that the other has yet to hear.
    air: [VecDeque<u8>; 2],
}

impl Pair {
    fn new(reading: Reading) -> Self {
        let mut barriers = PLACES.map(|place| Barrier::new(3, place));
        barriers.iter_mut().zip(PLACES).for_each(|(barrier, place)| {
            barrier.say(message(place, 0));
        });
        Self { reading, barriers, air: Default::default() }
    }

    /// The bits of a robot's present team move.
    fn bits(&self, robot: usize) -> u8 {
        self.barriers[robot].again().map_or(0, |own| own & BITS)
    }

    /// A robot says again what it has said about its present team move.
    fn repeat(&mut self, robot: usize) {
        let again = self.barriers[robot].again();
        self.air[robot].extend(again);
    }

    /// The other robot hears a byte of `robot`.
    fn hear(&mut self, robot: usize, byte: u8) -> Outcome {
        let other = 1 - robot;
        let turn = self.barriers[other].turn();
        let byte = match self.reading {
            Reading::True | Reading::Mute => byte,
            Reading::NoAnswers => byte & !ANSWER_BIT,
            Reading::Present => byte & !BITS | self.bits(other),
            // The nearest team move with this bit, the present one or else the one before.
            Reading::OneBit if (byte ^ self.bits(other)) & LOW_BIT == 0 => byte & !BITS | self.bits(other),
            Reading::OneBit => byte & !BITS | self.bits(other).wrapping_sub(LOW_BIT) & BITS,
        };
        let heard = self.barriers[other].hear(PLACES[robot], byte);
        let situation =
            match heard.map_err(|_| Stop::Violated("no byte contradicts one that was heard before"))? {
                ByteEffect::New => "a byte that was missing",
                ByteEffect::Again => "a byte once more",
                ByteEffect::Early => "a byte of the team move after",
                ByteEffect::Foreign => "a byte that can be of no team move now",
                ByteEffect::Late(missed) => {
                    if self.reading != Reading::Mute {
                        self.air[other].push_back(missed);
                    }
                    "a byte of the team move before"
                }
            };
        if let Some(messages) = self.barriers[other].pass() {
            let sent = PLACES.map(|place| message(place, turn));
            require(messages[..2] == sent, "a robot goes on with what all have said about this team move")?;
            self.barriers[other].say(message(PLACES[other], turn + 1));
        }
        let [one, two] = [0, 1].map(|robot| self.barriers[robot].turn());
        require(one.abs_diff(two) <= 1, "no robot is more than one team move ahead")?;
        Ok(situation)
    }

    /// Every byte in the air is heard, and no robot repeats its own: a byte causes at most one more, its answer.
    fn falls_silent(mut self) -> Result<(), Stop> {
        let sent: usize = self.air.iter().map(VecDeque::len).sum();
        for _ in 0..2 * sent {
            let Some(robot) = [0, 1].into_iter().find(|&robot| !self.air[robot].is_empty()) else { break };
            if let Some(byte) = self.air[robot].pop_front() {
                self.hear(robot, byte)?;
            }
        }
        require(
            self.air.iter().all(VecDeque::is_empty),
            "a byte causes at most one answer, and an answer none",
        )
    }
}

/// CHAIN-20: whatever is lost, repeated and late, both robots go on with the same messages, both go on once nothing is
/// lost any more, and no answer is answered.
///
/// # Errors
/// [`Stop::Violated`] if they do not.
pub(super) fn barrier(reading: &Reading, oracle: &mut dyn Oracle) -> Outcome {
    let mut pair = Pair::new(*reading);
    let mut situation = "nothing is heard";
    for _ in 0..EVENTS {
        let robot = oracle.pick(2) as usize;
        match (oracle.pick(4), pair.air[robot].front().copied()) {
            (0, _) if pair.air[robot].len() < IN_THE_AIR => pair.repeat(robot),
            (1, Some(byte)) => {
                pair.air[robot].pop_front();
                situation = pair.hear(robot, byte)?;
            }
            (2, Some(_)) => {
                pair.air[robot].pop_front();
                situation = "a byte is lost";
            }
            (3, Some(byte)) => situation = pair.hear(robot, byte)?,
            (0 | 4.., _) | (_, None) => return Err(Stop::Assumed),
        }
    }
    pair.clone().falls_silent()?;
    let turns = pair.barriers.map(|barrier| barrier.turn());
    for _ in 0..4 {
        for robot in [0, 1] {
            pair.repeat(robot);
            while let Some(byte) = pair.air[robot].pop_front() {
                pair.hear(robot, byte)?;
            }
        }
    }
    let has_gone_on = |robot: usize| pair.barriers[robot].turn() > turns[robot];
    require(has_gone_on(0) && has_gone_on(1), "once nothing is lost any more, both robots go on")?;
    Ok(situation)
}

//! Two robots anywhere on the lattice, at any speeds (KIT-1, KIT-3), and what they send each other (KIT-9).

use tautline_kernel::choice::{Oracle, one_of};
use tautline_kernel::ground::{Cell, Side, Step, Steps};
use tautline_kernel::kit::{Condition, Message, Reach, Rule, Stance};

use crate::engine::{Choices, Outcome, Replay, assume, outcomes, require};
use crate::judge::AnyCase;
use crate::judge::kit::{Wire, WireMessage};

/// Offsets of the second robot that are looked at: columns and rows, from −4 on.
/// Farther off no stance is in the paper's reach.
const OFFSETS: u32 = 9;

/// Parts of a path at which robots are looked at.
const PARTS: i64 = 3;

/// Where the first of two robots is: at a node, or on one of its paths.
fn stance(at: Cell, oracle: &mut dyn Oracle) -> Stance {
    match one_of(oracle, &Step::ALL) {
        Step::Cross(side) => Stance::Drives { from: at, to: at.beyond(side) },
        Step::Stay => Stance::Stands(at),
    }
}

/// Two robots, the first at 0,0 and the other one at one of so many offsets.
fn pair(offsets: u32, oracle: &mut dyn Oracle) -> [Stance; 2] {
    let one = stance(Cell::new(0, 0), oracle);
    let [columns, rows] = [(); 2].map(|()| oracle.pick(offsets) as i16 - offsets as i16 / 2);
    [one, stance(Cell::new(columns, rows), oracle)]
}

/// The squared distance of two robots that have made so many parts of their paths, in squared parts.
fn distance_squared([one, other]: [Stance; 2], [of_one, of_other]: [i64; 2]) -> i64 {
    let place = |stance: Stance, parts: i64| {
        let (from, to) = (stance.from(), stance.to());
        let at = |from: i16, to: i16| (PARTS - parts) * i64::from(from) + parts * i64::from(to);
        (at(from.x, to.x), at(from.y, to.y))
    };
    let ((x, y), (other_x, other_y)) = (place(one, of_one), place(other, of_other));
    (x - other_x).pow(2) + (y - other_y).pow(2)
}

/// How far two robots are on their paths.
fn parts(oracle: &mut dyn Oracle) -> [i64; 2] {
    [(); 2].map(|()| i64::from(oracle.pick(PARTS as u32 + 1)))
}

fn situation(stances: [Stance; 2]) -> &'static str {
    match stances.map(Stance::stands) {
        [true, true] => "both stand",
        [false, false] => "both drive",
        [true, false] | [false, true] => "one drives",
    }
}

/// The bound of [`contact`] and [`apart`], in words.
pub(super) fn pairs() -> String {
    let (stances, offsets) = (Step::ALL.len() as u32, OFFSETS.pow(2));
    format!(
        "two robots, {} places of one round the other, each at every third of its path",
        stances * stances * offsets
    )
}

/// The largest distances of two robots of which that is so, squared, in squared paths: while both stand, and wherever
/// they are on their paths.
pub fn farthest(is: impl Fn(Stance, Stance) -> bool) -> [u32; 2] {
    let offsets = 2 * u32::from(Reach::MOST_PATHS + 1) + 1;
    let pairs = outcomes(|oracle| Some(pair(offsets, oracle))).filter(|&[one, other]| is(one, other));
    let mut farthest = [0; 2];
    for [one, other] in pairs {
        // Distance is convex, so it is largest where each is at an end of its path.
        for (from, to) in [one.from(), one.to()]
            .into_iter()
            .flat_map(|from| [other.from(), other.to()].map(|to| (from, to)))
        {
            let (dx, dy) = from.apart(to);
            let squared = u32::from(dx).pow(2) + u32::from(dy).pow(2);
            let first = usize::from(!one.stands() || !other.stands());
            farthest[first..].iter_mut().for_each(|most| *most = squared.max(*most));
        }
    }
    farthest
}

/// KIT-1: who is sure to hear another one is at most 10 m from it, wherever the two are on their paths.
pub(super) fn contact(sure: &Certainty, oracle: &mut dyn Oracle) -> Outcome {
    let [one, other] = pair(OFFSETS, oracle);
    assume((sure.contact)(one, other))?;
    // 10 m are 10/3 of a path.
    let squared = distance_squared([one, other], parts(oracle));
    require(
        9 * squared <= 100 * PARTS.pow(2),
        "robots that are sure to hear each other are at most 10 m apart",
    )?;
    Ok(situation([one, other]))
}

/// KIT-3: who is sure to be apart from another one is at least 3 m from it, wherever the two are on their paths.
pub(super) fn apart(sure: &Certainty, oracle: &mut dyn Oracle) -> Outcome {
    let [one, other] = pair(OFFSETS, oracle);
    assume((sure.apart)(one, other))?;
    let squared = distance_squared([one, other], parts(oracle));
    require(squared >= PARTS.pow(2), "robots that are sure to be apart are at least 3 m apart")?;
    Ok(situation([one, other]))
}

/// Whether these robots hear each other within the paper's reach at whatever speeds they drive.
const fn is_in_contact(one: Stance, other: Stance) -> bool {
    one.is_sure_of(other, Reach::PAPER)
}

/// Predicates about two robots that follow from where they are.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Certainty {
    contact: fn(Stance, Stance) -> bool,
    apart: fn(Stance, Stance) -> bool,
}

impl Certainty {
    /// The kernel's predicates.
    pub(super) const OURS: Self = Self { contact: is_in_contact, apart: Stance::is_apart_from };
    /// Only where both go counts.
    pub(super) const ENDS: Self = Self {
        contact: |one, other| is_in_contact(Stance::Stands(one.to()), Stance::Stands(other.to())),
        apart: |one, other| one.to() != other.to(),
    };
    /// Where the other one has left counts, and where a robot itself has left does not.
    pub(super) const NEXT_OF_ONE: Self = Self {
        contact: |one, other| is_in_contact(Stance::Stands(one.to()), other),
        apart: |one, other| !other.has(one.to()),
    };
}

/// The bound of [`read_back`], in words.
pub(super) fn messages() -> String {
    format!("4 messages, {} nodes, 16 sets of sides, 3 numbers; of each one field spoilt", NODES.len())
}

/// Nodes that are told.
const NODES: [Cell; 4] = [Cell::new(0, 0), Cell::new(3, 3), Cell::new(-2, 7), Cell::new(i16::MAX, i16::MIN)];

/// A message, the number of its request, and what it is.
fn drawn(oracle: &mut dyn Oracle) -> (Message, u8, &'static str) {
    let kind = oracle.pick(4);
    let node = one_of(oracle, &NODES);
    let sides = Side::ALL
        .into_iter()
        .fold(Steps::NONE, |sides, side| if oracle.flip() { sides.with(Step::Cross(side)) } else { sides });
    let number = one_of(oracle, &[0, 1, u8::MAX]);
    let (message, situation) = match kind {
        0 => (Message::Request { node, sides }, "a request"),
        1 => (Message::Acknowledged, "an acknowledgement"),
        2 => (Message::Response { next: node, sides }, "a response"),
        _ => (Message::ResponseAcknowledged, "an acknowledgement"),
    };
    (message, number, situation)
}

/// The message that these choices of [`read_back`] send and read, written down for the judge.
pub(super) fn wire(rule: &Rule, choices: &Choices) -> Option<Box<dyn AnyCase>> {
    let answers: Vec<u32> = choices.all().collect();
    let mut replay = Replay::new(&answers);
    let (message, number, _) = drawn(&mut replay);
    let fields = message.encode(number, rule);
    let written = |message: Message, number: u8| {
        let (kind, node, sides) = match message {
            Message::Request { node, sides } => (0, node, sides),
            Message::Acknowledged => (1, Cell::new(0, 0), Steps::NONE),
            Message::Response { next, sides } => (2, next, sides),
            Message::ResponseAcknowledged => (3, Cell::new(0, 0), Steps::NONE),
        };
        let order = [Side::North, Side::East, Side::South, Side::West];
        let sides = order.map(|side| sides.has(Step::Cross(side)));
        WireMessage { kind, node: (node.x.into(), node.y.into()), sides, number: number.into() }
    };
    let wire = Wire {
        clause: "KIT-9",
        flags: if rule.has(Condition::Flags) { 4 } else { 3 },
        sent: written(message, number),
        fields: fields.map(i32::from),
        read: Message::decode(fields, rule).ok().map(|(message, number)| written(message, number)),
    };
    // A field that is spoilt is one more choice.
    replay.matches().then(|| Box::new(wire) as Box<dyn AnyCase>)
}

/// Fields that are spoilt, and by how much: the first so many also in a message that tells of a node and its sides, of
/// which the others make another message.
const TOLD: usize = 5;
const SPOILT: [(usize, i16); 11] =
    [(0, -2000), (3, 2), (4, -2), (5, 7), (6, 2), (1, 1), (2, -1), (3, 1), (4, 1), (5, 1), (6, 1)];

/// KIT-9: what is sent is what is read.
pub(super) fn read_back(rule: &Rule, oracle: &mut dyn Oracle) -> Outcome {
    let (message, number, situation) = drawn(oracle);
    let fields = message.encode(number, rule);
    require(Message::decode(fields, rule) == Ok((message, number)), "what is sent is what is read")?;
    let mut spoilt = fields;
    let is_empty = matches!(message, Message::Acknowledged | Message::ResponseAcknowledged);
    let ways = if is_empty { SPOILT.len() } else { TOLD };
    let (place, by) = SPOILT[oracle.pick(ways as u32) as usize];
    spoilt[place] += by;
    require(Message::decode(spoilt, rule).is_err(), "fields that are no message are refused")?;
    Ok(situation)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The pairs of stances, the first robot at 0,0, of which that is so, and the largest and the least squared
    /// distance of their ends.
    fn count(is: impl Fn(Stance, Stance) -> bool) -> (usize, i64, i64) {
        let pairs: Vec<[Stance; 2]> =
            outcomes(|oracle| Some(pair(OFFSETS, oracle))).filter(|&[one, other]| is(one, other)).collect();
        let corners = [[0, 0], [0, PARTS], [PARTS, 0], [PARTS, PARTS]];
        let distances = || {
            let all = pairs.iter().flat_map(|&pair| corners.map(|parts| distance_squared(pair, parts)));
            all.map(|squared| squared / PARTS.pow(2))
        };
        (pairs.len(), distances().max().unwrap_or(0), distances().min().unwrap_or(0))
    }

    #[test]
    fn there_are_653_pairs_in_contact_at_most_9_49_m_and_580_of_them_at_least_3_m_apart() {
        // √10 paths of 3 m are 9.49 m.
        assert_eq!(count(is_in_contact), (653, 10, 0));
        let both = |one: Stance, other: Stance| is_in_contact(one, other) && one.is_apart_from(other);
        assert_eq!(count(both), (580, 10, 1));
        assert_eq!(farthest(is_in_contact), [10, 10]);
    }
}

//! The messages of robots (Peiris, section 5, figures 5 to 8): a request, its acknowledgement, the response, and the
//! acknowledgement of that, each in seven fields: flag, x, y, and the four sides. Clause KIT-9.
//!
//! The paper gives three flags to the four messages. [`Condition::Flags`] gives the fourth one its own, and the number
//! of a request stands above the flag, since there is no field for it.

use super::rule::{Condition, Rule};
use crate::error::sentences;
use crate::ground::{Cell, Side, Step, Steps};

/// Fields of a message: flag, x, y, north, east, south, west.
pub const FIELDS: usize = 7;

/// The sides in the order of the fields.
const SIDES: [Side; 4] = [Side::North, Side::East, Side::South, Side::West];

/// Flags from one number to the next.
const FLAGS: i16 = 4;

/// A robot's message.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Message {
    /// Which sides of this node are covered?
    Request {
        /// The node where it stands.
        node: Cell,
        /// The sides of the node that count as covered for it; as published none.
        sides: Steps,
    },
    /// The request has come.
    Acknowledged,
    /// The answer to a request.
    Response {
        /// The node where the robot that answers will be next.
        next: Cell,
        /// The sides of the node asked for that count as covered for it.
        sides: Steps,
    },
    /// The response has come.
    ResponseAcknowledged,
}

/// Why fields are no message.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Damage {
    /// No message has this flag.
    Flag(i16),
    /// A side is neither 0, not covered, nor 1, covered.
    Covered(i16),
    /// An acknowledgement says more than that it is one.
    Overfull,
}

sentences!(Damage {
    Self::Flag(flag) => "{flag} is no flag of a message: flags are 0 to 3";
    Self::Covered(field) => "a side is 0 or 1, and not {field}";
    Self::Overfull => "an acknowledgement has no node and no sides";
});

impl Message {
    /// The seven fields of this message with the number of its request.
    pub fn encode(self, number: u8, rule: &Rule) -> [i16; FIELDS] {
        let last_flag = if rule.has(Condition::Flags) { 3 } else { 2 };
        let (flag, node, sides) = match self {
            Self::Request { node, sides } => (0, node, sides),
            Self::Acknowledged => (1, Cell::new(0, 0), Steps::NONE),
            Self::Response { next, sides } => (2, next, sides),
            Self::ResponseAcknowledged => (last_flag, Cell::new(0, 0), Steps::NONE),
        };
        let [north, east, south, west] = SIDES.map(|side| i16::from(sides.has(Step::Cross(side))));
        [flag + FLAGS * i16::from(number), node.x, node.y, north, east, south, west]
    }

    /// The message in these fields, and the number of its request.
    ///
    /// # Errors
    /// [`Damage`] if no message is encoded so.
    pub fn decode(fields: [i16; FIELDS], rule: &Rule) -> Result<(Self, u8), Damage> {
        let [flag, x, y, covered @ ..] = fields;
        let number = u8::try_from(flag.div_euclid(FLAGS)).map_err(|_| Damage::Flag(flag))?;
        let mut sides = Steps::NONE;
        for (side, field) in SIDES.into_iter().zip(covered) {
            match field {
                0 => {}
                1 => sides = sides.with(Step::Cross(side)),
                _ => return Err(Damage::Covered(field)),
            }
        }
        let is_empty = (x, y) == (0, 0) && sides.is_empty();
        let plain = |message| if is_empty { Ok(message) } else { Err(Damage::Overfull) };
        let message = match flag.rem_euclid(FLAGS) {
            0 => Self::Request { node: Cell::new(x, y), sides },
            1 => plain(Self::Acknowledged)?,
            2 => Self::Response { next: Cell::new(x, y), sides },
            _ if rule.has(Condition::Flags) => plain(Self::ResponseAcknowledged)?,
            _ => return Err(Damage::Flag(flag)),
        };
        Ok((message, number))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_messages_of_the_figures_have_the_fields_of_the_figures() {
        let rule = Rule::PUBLISHED;
        let request = Message::Request { node: Cell::new(3, 3), sides: Steps::NONE };
        assert_eq!(request.encode(0, &rule), [0, 3, 3, 0, 0, 0, 0]);
        assert_eq!(Message::Acknowledged.encode(0, &rule), [1, 0, 0, 0, 0, 0, 0]);
        let sides = Steps::only(Step::Cross(Side::North)).with(Step::Cross(Side::South));
        let response = Message::Response { next: Cell::new(6, 0), sides };
        assert_eq!(response.encode(0, &rule), [2, 6, 0, 1, 0, 1, 0]);
    }

    #[test]
    fn what_is_no_message_is_refused() {
        let decode = |fields| Message::decode(fields, &Rule::REPAIRED);
        assert_eq!(decode([-1, 0, 0, 0, 0, 0, 0]), Err(Damage::Flag(-1)));
        assert_eq!(decode([1024, 0, 0, 0, 0, 0, 0]), Err(Damage::Flag(1024)));
        assert_eq!(decode([0, 0, 0, 0, 2, 0, 0]), Err(Damage::Covered(2)));
        assert_eq!(decode([1, 0, 1, 0, 0, 0, 0]), Err(Damage::Overfull));
        assert_eq!(Message::decode([3, 0, 0, 0, 0, 0, 0], &Rule::PUBLISHED), Err(Damage::Flag(3)));
    }
}

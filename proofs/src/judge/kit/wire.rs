//! The fields of a message (KIT-9).

use super::super::change::plain;
use super::super::{Case, Objection, Place, must};

/// A message as it is sent, its fields, and what is read in them.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Wire {
    /// The clause that it is said to break.
    pub clause: &'static str,
    /// How many flags there are: three as published, four with *Flags*.
    pub flags: i32,
    /// The message that is sent.
    pub sent: WireMessage,
    /// Flag, column and row, north, east, south, west.
    pub fields: [i32; 7],
    /// The message that is read, if it is one.
    pub read: Option<WireMessage>,
}

/// A message with the number of its request.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct WireMessage {
    /// Request, acknowledgement, response, acknowledgement of the response, from 0.
    pub kind: i32,
    /// The node that it tells.
    pub node: Place,
    /// Whether the sides count as covered, in the order of the fields.
    pub sides: [bool; 4],
    /// The number of the request.
    pub number: i32,
}

plain!(Wire { flags, sent, fields, read });
plain!(WireMessage { kind, node, sides, number });

impl WireMessage {
    /// A request and a response tell a node and its sides, an acknowledgement nothing.
    fn is_one(&self) -> bool {
        let is_plain = self.node == (0, 0) && self.sides == [false; 4];
        (0..4).contains(&self.kind) && (0..256).contains(&self.number) && (self.kind % 2 == 0 || is_plain)
    }

    fn fields(&self, flags: i32) -> [i32; 7] {
        let [north, east, south, west] = self.sides.map(i32::from);
        let flag = self.kind.min(flags - 1) + 4 * self.number;
        [flag, self.node.0, self.node.1, north, east, south, west]
    }

    /// The message in these fields, if it is one: of all that are encoded so the first.
    fn in_fields(fields: [i32; 7], flags: i32) -> Option<Self> {
        let [flag, x, y, ref sides @ ..] = fields;
        let sides = [0, 1, 2, 3].map(|side| sides[side] == 1);
        let (kind, number) = (flag.rem_euclid(4), flag.div_euclid(4));
        let read = Self { kind, node: (x, y), sides, number };
        (read.is_one() && read.fields(flags) == fields).then_some(read)
    }
}

impl Case for Wire {
    fn clause(&self) -> &'static str {
        self.clause
    }

    fn judge(&self) -> Result<(), Objection> {
        let Self { flags, sent, fields, read, .. } = self;
        must(self.clause == "KIT-9" && [3, 4].contains(flags), "the judge does not know this")?;
        must(sent.is_one(), "that is no message")?;
        must(sent.fields(*flags) == *fields, "the message has other fields")?;
        must(WireMessage::in_fields(*fields, *flags) == *read, "something else is read in these fields")?;
        Ok(must(*read != Some(*sent), "the message is read as it was sent")?)
    }
}

//! The features of a scheme: where its robots start, how they learn of a layout, what they draw, how they look.

use std::fmt;

use tautline_kernel::ground::Cell;

use super::rule::RuleId;
use crate::options::Extra;

/// Where the robots of a team start.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Starts {
    /// All of them at the base.
    Base,
    /// Each in any free cell.
    Anywhere,
    /// Each in any free cell: without another word as repaired the first one at the base and the others beside it, and
    /// else all at the base.
    Beside,
    /// Each in a free cell of its own: without another word the first one at the base, and the others beside it.
    Alone,
}

/// Something that runs of a scheme draw by their seed.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct RandomPart {
    /// Its name in words.
    pub what: &'static str,
    /// In which runs it is drawn.
    pub by: By,
}

/// In which runs something is drawn.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum By {
    /// In all.
    Every,
    /// Where sensors are missed by chance.
    Miss,
    /// Where this is told.
    Told(&'static Extra),
    /// In those of this rule.
    Rule(RuleId),
}

/// Says what is drawn, and by which field.
impl fmt::Display for RandomPart {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { what, by } = self;
        match by {
            By::Every => f.write_str(what),
            By::Miss => write!(f, "{what}, with `miss`"),
            By::Told(extra) => write!(f, "{what}, with `{}`", extra.field),
            By::Rule(rule) => write!(f, "{what}, with `rule` {rule}"),
        }
    }
}

/// How a team is drawn and told of.
#[derive(Clone, Copy, Debug)]
pub enum Look {
    /// The first robot is the base, the last one leads, and those beside each other in their order have a link.
    Linked {
        /// Whether the link of two robots is lost that go from the first to the second of these pairs of cells.
        is_lost: fn(&[Cell], &[Cell]) -> bool,
    },
    /// The first robot is the base, and links join the robots in a tree.
    Tree {
        /// Whether robots in these cells have a link.
        is_linked: fn(Cell, Cell) -> bool,
    },
    /// Every robot is an agent for itself.
    Apart,
    /// Every robot is an agent for itself, and is called a robot.
    Robots,
    /// The robots of a rule of one's own, which have the numbers that the rule gives them: from 0.
    Own,
}

impl Look {
    /// Whether the first robot is the base.
    pub const fn has_base(self) -> bool {
        match self {
            Self::Linked { .. } | Self::Tree { .. } => true,
            Self::Apart | Self::Robots | Self::Own => false,
        }
    }

    /// The number of the first robot.
    pub const fn first_number(self) -> usize {
        match self {
            Self::Linked { .. } | Self::Tree { .. } | Self::Apart | Self::Robots => 1,
            Self::Own => 0,
        }
    }

    /// The robots whose link with the next one is lost when all go from the first to the second of these cells.
    pub fn lost(self, before: &[Cell], after: &[Cell]) -> Vec<u32> {
        let Self::Linked { is_lost } = self else { return Vec::new() };
        let pairs = (0..).zip(before.windows(2).zip(after.windows(2)));
        pairs.filter(|(_, (from, to))| is_lost(from, to)).map(|(robot, _)| robot).collect()
    }

    /// The noun for a robot.
    pub const fn robot(self) -> &'static str {
        match self {
            Self::Linked { .. } | Self::Tree { .. } | Self::Robots | Self::Own => "robot",
            Self::Apart => "agent",
        }
    }
}

/// The knowledge that agents have of a sensor floor in the end.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Knowledge {
    /// Nothing: whoever watches them ends the run.
    None,
    /// Which cells are visited, and when they are done.
    Visited,
}

/// How robots learn of a layout.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Senses {
    /// A robot knows the edges that were tried. What no robot met can go, and the run stays the same.
    Bumps,
    /// Agents read sensors on the floor, and may miss some.
    Floor,
}

/// How much of what robots learn their cells, their bumps and the open sides around them are.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Completeness {
    /// All of it.
    All,
    /// Not all: robots also see cells farther away, hear messages, or act in an order that is drawn.
    Part,
}

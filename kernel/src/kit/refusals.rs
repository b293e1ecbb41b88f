//! Why a team cannot start, and what a robot cannot be told.

use super::stance::Reach;
use crate::error::sentences;
use crate::ground::Cell;

/// Why a team cannot start.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum SetupError {
    /// A team has at least one robot, and no more than it holds.
    Robots {
        /// Robots asked for.
        robots: usize,
        /// Robots that it holds.
        most: usize,
    },
    /// A robot starts outside of the map.
    Outside(Cell),
    /// The map has more nodes than a plan has room for.
    TooManyNodes {
        /// Nodes of the map.
        nodes: usize,
        /// Nodes that there is room for.
        most: usize,
    },
    /// Two robots start at one node.
    OneNode(Cell),
    /// The robots do not hear each other within this reach.
    OutOfContact(Reach),
}

sentences!(SetupError {
    Self::Robots { robots, most } => "a team has 1 to {most} robots, and not {robots}";
    Self::Outside(start) => "the start {start} is outside of the map";
    Self::TooManyNodes { nodes, most } => "the map has {nodes} nodes, and there is room for {most}";
    Self::OneNode(start) => "two robots start at {start}: give each a node of its own";
    Self::OutOfContact(Reach::PAPER) =>
        "the robots do not hear each other where they start: a node is in reach of another at most 3 columns or rows \
         away, and 1 to the side";
    Self::OutOfContact(reach) =>
        "the robots do not hear each other where they start: a node is in reach of another if the squares of the \
         columns and rows between them add up to at most {}", reach.squared();
});

/// A robot was told something that does not fit what it does.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Misuse {
    /// It may not decide now: see [`Kit::may_decide`](super::Kit::may_decide).
    Decides,
    /// It looks at no side.
    Looks,
    /// It does not drive.
    Drives,
}

sentences!(Misuse {
    Self::Decides => "the robot may not decide now: ask `may_decide` before";
    Self::Looks => "the robot looks at no side: `looked` comes after `Next::Looks`";
    Self::Drives => "the robot does not drive: `arrived` comes after `Next::Drives`";
});

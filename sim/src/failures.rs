//! Failures while a chain explores: a robot that dies, a wall that appears, bytes that are lost, and robots that
//! go at speeds of their own.

use std::fmt;
use std::num::NonZeroU32;
use std::str::FromStr;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use tautline_kernel::ground::{Cell, Edge, Side};

use tautline_grids::layout::ColumnRow;

/// A robot dies on its way: it does not go in this team move, and says nothing from then on.
#[derive(Clone, Copy, PartialEq, Eq, Debug, JsonSchema, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Failure {
    /// The robot, numbered from 1, the base.
    pub robot: u16,
    /// The team move, counted from 1.
    #[serde(rename = "move")]
    pub step: NonZeroU32,
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}@{}", self.robot, self.step)
    }
}

impl FromStr for Failure {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let parts =
            text.split_once('@').and_then(|(robot, step)| Some((robot.parse().ok()?, step.parse().ok()?)));
        parts.map(|(robot, step)| Self { robot, step }).ok_or_else(|| {
            format!("{text:?} is no robot and team move: write both as whole numbers from 1 on, as in 3@20")
        })
    }
}

/// A wall appears on a side of a cell: from this team move on no robot crosses it.
#[derive(Clone, Copy, PartialEq, Eq, Debug, JsonSchema, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct WallAppearance {
    /// The cell.
    #[schemars(with = "ColumnRow")]
    pub cell: Cell,
    /// Which side of it.
    pub side: Compass,
    /// The team move, counted from 1.
    #[serde(rename = "move")]
    pub step: NonZeroU32,
}

/// A side of a cell by its letter.
#[derive(Clone, Copy, PartialEq, Eq, Debug, JsonSchema, Serialize, Deserialize)]
pub enum Compass {
    /// East.
    E,
    /// South.
    S,
    /// West.
    W,
    /// North.
    N,
}

impl Compass {
    /// All, by their letters and in the order of [`Side::ALL`].
    const ALL: [(&'static str, Self); 4] = [("E", Self::E), ("S", Self::S), ("W", Self::W), ("N", Self::N)];
}

impl WallAppearance {
    /// Where the wall stands.
    pub const fn edge(&self) -> Edge {
        Edge::new(self.cell, Side::ALL[self.side as usize])
    }
}

impl fmt::Display for WallAppearance {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{},{:?}@{}", self.cell, self.side, self.step)
    }
}

impl FromStr for WallAppearance {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let read = || {
            let (place, step) = text.split_once('@')?;
            let mut parts = place.split(',');
            let cell = Cell::new(parts.next()?.parse().ok()?, parts.next()?.parse().ok()?);
            let letter = parts.next()?;
            let (_, side) = Compass::ALL.into_iter().find(|(name, _)| *name == letter)?;
            let is_over = parts.next().is_none();
            is_over.then_some(Self { cell, side, step: step.parse().ok()? })
        };
        read().ok_or_else(|| {
            format!(
                "{text:?} is no side of a cell and team move: write column, row, one of E, S, W and N, and \
                 a whole number from 1 on, as in 7,6,E@20"
            )
        })
    }
}

/// In what order the robots go in a team move.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, JsonSchema, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum MoveOrder {
    /// All at once.
    #[default]
    AtOnce,
    /// One after the other, in a new random order each time.
    OneByOne,
}

impl MoveOrder {
    /// Whether nobody has said anything about it.
    pub const fn is_usual(&self) -> bool {
        matches!(self, Self::AtOnce)
    }
}

/// The failures of a run, and what came of them.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, JsonSchema, Serialize)]
pub struct Failures {
    /// Bytes that one robot said and another one did not hear.
    pub lost_bytes: u64,
    /// How often robots said their bytes at the barrier, each robot that had to once.
    pub rounds: u64,
    /// The team move in which a robot died.
    pub died: Option<u32>,
    /// Team moves taken back until the others were in contact as a chain of one fewer, once they are.
    pub taken_back: Option<u32>,
    /// Team moves taken back when that chain came home for what was left.
    pub home: u32,
}

//! What can fail while a chain explores: a robot that dies, bytes that are lost, and robots that go at speeds of their own.

use std::fmt;
use std::num::NonZeroU32;
use std::str::FromStr;

use serde::{Deserialize, Serialize};

/// A robot dies on its way: it does not go in this team move, and says nothing from then on.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize)]
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

/// Words that name no failure.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct NoFailure(String);

impl fmt::Display for NoFailure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:?} is no robot and team move: write both as whole numbers from 1 on, as in 3@20", self.0)
    }
}

impl std::error::Error for NoFailure {}

impl FromStr for Failure {
    type Err = NoFailure;

    fn from_str(text: &str) -> Result<Self, NoFailure> {
        let parts =
            text.split_once('@').and_then(|(robot, step)| Some((robot.parse().ok()?, step.parse().ok()?)));
        parts.map(|(robot, step)| Self { robot, step }).ok_or_else(|| NoFailure(text.to_owned()))
    }
}

/// In what order the robots go in a team move.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Going {
    /// All at once.
    #[default]
    AtOnce,
    /// One after the other, in a new random order each time.
    OneByOne,
}

impl Going {
    /// Whether nobody has said anything about it.
    pub const fn is_usual(&self) -> bool {
        matches!(self, Self::AtOnce)
    }
}

/// What has failed in a run, and what came of it.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, Serialize)]
pub struct Faults {
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

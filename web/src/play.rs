//! The game that a page plays: a board that stands still, and steps that say what they change.

use serde::Serialize;
use serde_json::Value;
use tautline_sim::draw::page::film::LayerJson;

use crate::ask::Answers;

/// Something that is played step by step.
pub(crate) trait Play {
    /// The board.
    fn board(&self) -> Board;

    /// Makes the next step.
    fn step(&mut self, world: &mut Answers) -> Step;

    /// The steps that robots cannot take next, and what refuses them.
    fn refusals(&self) -> Vec<Refusal> {
        Vec::new()
    }
}

/// The part of a game that stands still.
#[derive(Serialize)]
pub(crate) struct Board {
    pub(crate) columns: usize,
    pub(crate) rows: usize,
    /// The area of the team: the first cell, columns and rows.
    pub(crate) area: [i16; 4],
    /// The noun for a robot.
    pub(crate) robot: &'static str,
    /// The noun for a step.
    pub(crate) unit: &'static str,
    /// The robots that are drawn as squares: so many of the first.
    pub(crate) squares: usize,
    /// The names of the robots, if they are not their numbers.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(crate) names: Vec<String>,
    pub(crate) has_leader: bool,
    /// Whether robots see which sides of their cells are open.
    pub(crate) sees: bool,
    /// The cells that are to be explored.
    pub(crate) due: u32,
    pub(crate) layers: Vec<LayerJson>,
    /// How it is at the start.
    pub(crate) start: Delta,
}

/// A step, or why there is none.
#[derive(Serialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum Step {
    /// The changes that it makes.
    Made(Box<Delta>),
    /// The run is over.
    Over(Over),
}

/// The changes of a step. Cells and sides are told by their numbers in the whole board.
#[derive(Default, Serialize)]
pub(crate) struct Delta {
    /// The number of the step.
    pub(crate) step: u32,
    /// Where robots are.
    pub(crate) cells: Vec<Option<u32>>,
    /// The sides that they tried, a letter each, small where they met a wall.
    pub(crate) tried: String,
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub(crate) back: bool,
    /// The step in words.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub(crate) words: String,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(crate) explored: Vec<u32>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(crate) unseen: Vec<u32>,
    /// The sides that are known from now on, and whether they are open.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(crate) known: Vec<(u32, bool)>,
    /// The layers that are emptied.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(crate) clear: Vec<usize>,
    /// Layer, robot, place and value.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(crate) put: Vec<(usize, Option<usize>, u32, u8)>,
    /// Layer, thing, value, and the figures of where it is.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(crate) marks: Vec<(usize, usize, u8, Vec<i32>)>,
    /// Layer, kind, who says it, and who hears it; all if nobody is named.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(crate) say: Vec<(usize, usize, usize, Option<Vec<usize>>)>,
    /// The robots whose link with the next is lost.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(crate) lost: Vec<u32>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(crate) failed: Vec<usize>,
    /// The walls that an answer has made or taken away.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(crate) walls: Vec<(u32, bool)>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(crate) broken: Vec<BrokenClause>,
}

/// A clause that was broken.
#[derive(Clone, Serialize)]
pub(crate) struct BrokenClause {
    pub(crate) clause: String,
    pub(crate) sentence: &'static str,
    /// How, a line for each pair or cell.
    pub(crate) told: Vec<String>,
    /// The cells that are missed, at the end.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(crate) cells: Vec<u32>,
}

/// The end of a run.
#[derive(Serialize)]
pub(crate) struct Over {
    pub(crate) words: String,
    pub(crate) broken: Vec<BrokenClause>,
}

/// A step that a robot cannot take.
#[derive(Serialize)]
pub(crate) struct Refusal {
    pub(crate) robot: usize,
    /// The cell to which it would go.
    pub(crate) to: u32,
    /// The conditions that refuse it; none if a known wall does.
    pub(crate) by: Vec<&'static str>,
}

/// A value as JSON.
pub(crate) fn json(value: &impl Serialize) -> Value {
    serde_json::to_value(value).unwrap_or_default()
}

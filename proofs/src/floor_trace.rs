//! A run of agents on a small floor, turn by turn, as a person looks at it: the counterexample of a check of floors.

use tautline_kernel::floor::Mark;
use tautline_kernel::ground::{Cell, Edge, Step};

/// A run of agents on a small floor.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Course {
    /// Columns.
    pub width: i16,
    /// Rows.
    pub height: i16,
    /// Cells that are blocked, row by row.
    pub blocked: Vec<Cell>,
    /// Walls between free cells.
    pub walls: Vec<Edge>,
    /// The turns, in order.
    pub turns: Vec<Turn>,
    /// The last of the turns that can go on for ever; 0 if the run ends.
    pub round: usize,
    /// The agents and the floor at the end.
    pub end: Scene,
}

/// A turn of one agent.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Turn {
    /// Before it.
    pub before: Scene,
    /// The place of the agent.
    pub agent: usize,
    /// Where it goes.
    pub step: Step,
    /// Whether it is done from then on.
    pub is_done: bool,
    /// The cells of the sensors that it misses.
    pub unseen: Vec<Cell>,
}

/// Agents on a floor.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Scene {
    /// Where each agent is.
    pub cells: Vec<Cell>,
    /// The free cells with their marks, row by row.
    pub marks: Vec<(Cell, Mark)>,
}

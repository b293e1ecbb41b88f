//! A run of robots as plain data: where they start, and one [`Frame`] for each team move. Simulation, search and proofs
//! all use it.

use tautline_kernel::chain::Kind;
use tautline_kernel::ground::{Area, Cell, Edge, Side, Step};

/// One team move of robots in the order of their numbers; the base of a chain is the first.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Frame {
    /// An advance or a backtrack.
    pub kind: Kind,
    /// The steps that the robots tried.
    pub steps: Vec<Step>,
    /// Whether it met a wall.
    pub blocked: Vec<bool>,
    /// Where it is now.
    pub cells: Vec<Cell>,
}

impl Frame {
    /// The edges where robots met a wall or a blocked cell: they stand where they stood.
    pub fn bumps(&self) -> impl Iterator<Item = Edge> {
        let tried = self.cells.iter().zip(self.steps.iter().zip(&self.blocked));
        tried.filter_map(|(&cell, (&step, &blocked))| match step {
            Step::Cross(side) if blocked => Some(Edge::new(cell, side)),
            Step::Cross(_) | Step::Stay => None,
        })
    }
}

/// A run of robots in a layout, as a search finds it.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Run {
    /// The scheme's name.
    pub scheme: &'static str,
    /// The cells that all layouts of the search have in common.
    pub area: Area,
    /// Where the robots start; the base of a chain is the first.
    pub starts: Vec<Cell>,
    /// The walls that they met.
    pub walls: Vec<Edge>,
    /// The blocked cells that they met.
    pub obstacles: Vec<Cell>,
    /// The team moves.
    pub frames: Vec<Frame>,
    /// The id of the clause that the run breaks as anyone sees who watches it, if it is one of these.
    pub breaks: Option<&'static str>,
    /// How it breaks a clause.
    pub ending: Ending,
    /// The words that frames cannot show.
    pub words: Words,
}

/// The words about a run that its frames cannot show; none for runs of which a frame shows all.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Words {
    /// The demand that is broken.
    pub demand: &'static str,
    /// Of each team move what happened in it, such as that a robot died; none, or one for each.
    pub titles: Vec<String>,
    /// How many of the last team moves come again and again, if the run goes round for ever.
    pub round: usize,
}

/// A run that a search has made by its choices: the layout that it met, without frames, and the choices that make it
/// again there, as the runs of its scheme read them.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct ScriptedRun {
    /// Where it takes place, and what it breaks.
    pub run: Run,
    /// The choices.
    pub choices: Vec<u32>,
}

/// How a run breaks a clause.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Ending {
    /// By its last team move.
    Move,
    /// By having ended.
    Over,
    /// By going on for ever: its last team moves lead back to where it was.
    Endless,
}

/// The name of a side.
pub const fn name_of(side: Side) -> &'static str {
    ["east", "south", "west", "north"][side as usize]
}

/// A cell as judges have it: its column and its row.
pub fn place(cell: Cell) -> (i32, i32) {
    (cell.x.into(), cell.y.into())
}

/// A wall as judges have it: the places on its two sides, the western or northern one first.
pub fn sides(wall: Edge) -> ((i32, i32), (i32, i32)) {
    (place(wall.cell()), place(wall.cell().beyond(wall.side())))
}

/// The walls that `frames` met, each once.
pub fn walls(frames: &[Frame]) -> Vec<Edge> {
    let mut walls: Vec<Edge> = frames.iter().flat_map(Frame::bumps).collect();
    walls.sort_unstable();
    walls.dedup();
    walls
}

//! The scene that a team shows beside its robots and the cells that they enter: named layers, and what each team move
//! changes in them. A page draws a layer by its shape; it knows no scheme.

use serde::Serialize;
use tautline_kernel::ground::{Cell, Edge, Step};
use tautline_kernel::position::{Point, SymmetricMatrix};

use crate::objects::spread;

/// A layer of a page, which can be shown or hidden.
#[derive(Clone, Debug)]
pub struct Layer {
    /// Its name in the legend.
    pub name: &'static str,
    /// Its meaning, in one line.
    pub about: String,
    /// How it is drawn.
    pub shape: Shape,
}

impl Layer {
    /// The layer with this name and this meaning.
    pub fn new(name: &'static str, about: impl Into<String>, shape: Shape) -> Self {
        Self { name, about: about.into(), shape }
    }
}

/// How a layer is drawn.
#[derive(Clone, Copy, Debug)]
pub enum Shape {
    /// Cells that [`Scene::put`] gives one of these values, for the whole team.
    Cells(&'static [Value]),
    /// Sides of cells, likewise.
    Sides(&'static [Value]),
    /// Cells as each robot has them for itself: the page shows those of the robot that it follows.
    CellsOfEach(&'static [Value]),
    /// Sides of cells, likewise.
    SidesOfEach(&'static [Value]),
    /// Links of robots, drawn by the first of these zones, the narrowest first, in which one has the other.
    Links(Joins, &'static [Zone]),
    /// A circle round each robot, its radius in thousandths of a cell's side.
    Circle(u32),
    /// Places that [`Scene::mark`] gives one of these values, wherever in a cell they are.
    Marks(&'static [Value]),
    /// The messages that [`Scene::say`] tells, by their kinds.
    Messages(&'static [Kind]),
    /// After each team move every robot tells all others what it tried and what came of it.
    Reports,
}

/// A value that a cell or a side can have in a layer.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Value {
    /// Its name in the legend.
    pub name: &'static str,
    /// How it is painted.
    pub ink: Ink,
}

/// A kind of message.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Kind {
    /// Its name.
    pub name: &'static str,
    /// Whether it comes to those whom it is for.
    #[serde(rename = "heard")]
    pub is_heard: bool,
}

impl Kind {
    /// A kind of message that is heard.
    pub const fn heard(name: &'static str) -> Self {
        Self { name, is_heard: true }
    }

    /// A kind of message that is not.
    pub const fn lost(name: &'static str) -> Self {
        Self { name, is_heard: false }
    }
}

/// How something is painted. No two inks differ by their colours alone.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Ink {
    /// Free to go through.
    Open,
    /// In the way.
    Wall,
    /// In the way by agreement.
    Barred,
    /// Where somebody is going.
    Aim,
    /// Where the followed robot itself is going.
    Goal,
    /// About to be closed.
    Closing,
    /// Done with.
    Closed,
    /// Done with, and shut.
    Sealed,
}

/// Which robots have links.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Joins {
    /// Each with the next, in the order of their numbers.
    Next,
    /// A tree from the first robot on, by the fewest links, of those that are in a zone.
    Tree,
    /// All that are in a zone.
    All,
}

/// The cells round a robot in which another one is.
#[derive(Clone, Copy, Debug)]
pub struct Zone {
    /// Its name in the legend.
    pub name: &'static str,
    /// Its meaning, in one line.
    pub about: &'static str,
    /// Whether the zone round the first cell has the second one, which is at most [`Zone::REACH`] away in columns and
    /// rows.
    pub has: fn(Cell, Cell) -> bool,
}

impl Zone {
    /// How far zones reach.
    pub const REACH: i16 = 8;

    /// The columns and rows from a robot to the cells of its zone.
    pub fn offsets(&self) -> Vec<[i16; 2]> {
        let across = || -Self::REACH..=Self::REACH;
        let square = across().flat_map(|y| across().map(move |x| [x, y]));
        square.filter(|&[x, y]| (self.has)(Cell::new(0, 0), Cell::new(x, y))).collect()
    }
}

/// A place in a layer.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub enum Place {
    /// A cell.
    Cell(Cell),
    /// A side of a cell.
    Side(Edge),
}

/// Where something is, or is taken to be, in whole numbers.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub struct Mark {
    /// The number of the thing in its layer.
    pub number: usize,
    /// Its value, by its number from 1.
    pub value: u8,
    /// Its place, in thousandths of a cell's side; if it is a guess, the standard deviations of both coordinates and
    /// their correlation in thousandths; with a heading, that and its standard deviation in milliradians.
    pub figures: Vec<i32>,
}

impl Mark {
    /// A thing that is at `at`, in sides of a cell.
    pub fn exact(number: usize, value: u8, at: Point) -> Self {
        Self { number, value, figures: [at.x_m, at.y_m].map(thousandths).to_vec() }
    }

    /// A thing that is taken to be at `at`.
    #[must_use]
    pub fn guess(number: usize, value: u8, at: Point, covariance: SymmetricMatrix) -> Self {
        let (deviations, correlation) = spread(covariance);
        let mut mark = Self::exact(number, value, at);
        mark.figures.extend([deviations[0], deviations[1], correlation].map(thousandths));
        mark
    }

    /// This thing, which heads there.
    #[must_use]
    pub fn heading(mut self, radians: f64, variance: f64) -> Self {
        self.figures.extend([radians, variance.sqrt()].map(thousandths));
        self
    }
}

fn thousandths(number: f64) -> i32 {
    (1000.0 * number).round() as i32
}

/// Who hears a message.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Hearers {
    /// All other robots.
    All,
    /// These.
    These(Vec<usize>),
}

/// A change that a team move makes.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Change {
    /// A layer, by its place among [`Team::layers`](super::Team::layers), is empty.
    Clear {
        /// The layer.
        layer: usize,
    },
    /// A place has a value, by its number from 1; 0 takes it away.
    Put {
        /// The layer.
        layer: usize,
        /// For which robot, in a layer of each.
        robot: Option<usize>,
        /// The place.
        place: Place,
        /// The value.
        value: u8,
    },
    /// A thing is here from now on, or is taken to be.
    Mark {
        /// The layer.
        layer: usize,
        /// The thing.
        mark: Mark,
    },
    /// The team knows a side without having tried it.
    Know {
        /// The side.
        side: Edge,
        /// Whether it can be crossed.
        is_open: bool,
    },
    /// A robot says something.
    Say {
        /// The layer.
        layer: usize,
        /// The kind of the message, by its place in the layer.
        kind: usize,
        /// Who says it.
        from: usize,
        /// Who hears it.
        to: Hearers,
    },
    /// A robot is on its way for so many milliseconds.
    Take {
        /// The robot.
        robot: usize,
        /// How long.
        milliseconds: u64,
    },
    /// A robot has died.
    Fail {
        /// The robot.
        robot: usize,
    },
}

/// A step that the conditions of a rule refuse.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Refusal {
    /// The robot that would take it.
    pub robot: usize,
    /// The step.
    pub step: Step,
    /// The conditions that refuse it, each by itself; none if a wall does that the team knows.
    pub by: Vec<&'static str>,
}

/// The changes that a team move makes in the layers of its team.
#[derive(Clone, Debug, Default)]
pub struct Scene(Vec<Change>);

impl Scene {
    /// Notes a change.
    pub fn note(&mut self, change: Change) {
        self.0.push(change);
    }

    /// A place of a layer of the whole team has a value.
    pub fn put(&mut self, layer: usize, place: Place, value: u8) {
        self.note(Change::Put { layer, robot: None, place, value });
    }

    /// A place has a value for this robot.
    pub fn put_for(&mut self, layer: usize, robot: usize, place: Place, value: u8) {
        self.note(Change::Put { layer, robot: Some(robot), place, value });
    }

    /// A thing of a layer is here from now on, or is taken to be.
    pub fn mark(&mut self, layer: usize, mark: Mark) {
        self.note(Change::Mark { layer, mark });
    }

    /// A robot says something of this kind.
    pub fn say(&mut self, layer: usize, kind: usize, from: usize, to: Hearers) {
        self.note(Change::Say { layer, kind, from, to });
    }

    /// The changes, in order.
    pub fn changes(&self) -> &[Change] {
        &self.0
    }
}

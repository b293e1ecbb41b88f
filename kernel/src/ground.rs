//! The ground that all robots move on: square cells with sides, steps and edges, the environments that radio range
//! gives them, and what a team knows of its area.

mod around;
mod bits;
mod grid;
mod lattice;
mod link;
mod plane;
mod steps;

pub use around::{neighbouring_steps, steps_to};
pub use bits::{BitGrid, CompactGrid, LargeGrid, Layers, MediumGrid, SmallGrid, TinyGrid};
pub use grid::{Area, Avoid, CellMark, EdgeMark, Grid};
pub use lattice::{Cell, Circle, Edge, Side, Step, neighbours};
pub use link::{Link, link, links};
pub use plane::Plane;
pub use steps::Steps;

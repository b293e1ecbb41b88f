//! The radio field: nodes in an area, the links between them, and what becomes of what they send. A [`Field`] has
//! positions and obstacles; a [`Network`] the links that a [`Radio`] makes of them; [`run`] lets a [`Protocol`] send
//! and hear over a [`Channel`]. Everything left to chance is asked of an `Oracle`: the same answers make the same run.
//!
//! Results depend on `+ − × ÷ √` and whole numbers alone, which are the same on every machine, and, where signals have
//! a shadow or noise, on the power function of libm. Time is in nanoseconds, distances between nodes are in
//! micrometres.

mod air;
mod broadcast;
mod field;
mod grid;
mod lake;
mod names;
mod network;
mod problem;
mod queue;

pub use air::{Air, Channel, Faults, Protocol, SharedChannel, run};
pub use broadcast::{Broadcast, LONGEST_WAIT_NS, Reach, Report, broadcast};
pub use field::{Area, Field, Obstacle, Point};
pub(crate) use grid::Grid;
pub use lake::{Lake, SHAPES};
pub use names::ChannelName;
pub use network::{FREE_SPACE, Link, Model, Network, Radio};
pub(crate) use problem::checked_deviation;
pub use problem::{MAX_NODES, MAX_RANGE_M, Problem};

//! Bringing a robot over a radio field to the node that waits for rescue (WFR): TAN [Jiang 2011, 3.4] by the kernel's
//! rules, and the ways that the paper compares it with. A [`Walker`] is one robot on its way by TAN: each thing that it
//! does says how long it takes, so that a simulation can have several on the way and let anything go wrong in between.
//! [`Site`] walks whole journeys, of TAN and of its rivals, over a network in which nothing does.
//!
//! The model: a robot hears nodes, and is heard by them, a hundredth farther than they hear each other
//! ([`ROBOT_REACH`]). Obstacles stop signals and robots. How strong a signal is falls with the distance as the field's
//! model has it, and with the angle off the axis of the robot's [`Antenna`].
//!
//! Positions depend on `+ − × ÷ √` alone, strengths on the logarithm and the arc tangent of libm besides: all are the
//! same on every machine.

mod antenna;
mod back_and_forth;
mod ear;
mod gradient;
mod journey;
mod rival;
mod shortest;
mod tree;
mod walker;

pub use antenna::Antenna;
pub use ear::{Ear, NEAREST_M, ROBOT_REACH, Signal};
pub use gradient::NextSensor;
pub use journey::{End, Journey, Site};
pub use shortest::shortest_m;
pub use tree::{Tree, hops};
pub use walker::{Equipment, Gait, Scans, Walker};

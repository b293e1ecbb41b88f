//! Bringing a robot that does not know where it is to the node that waits for rescue (WFR): Tree Assisted Navigation,
//! TAN (paper 003, 3.4), and the ways that the paper compares it with or tells of: Verma's credit field, Reich's gradient
//! and Sheu's back-and-forth (paper 003, 2.1).
//!
//! All are pure rules over what the robot hears. Where it is, how strong a signal arrives and how long a walk takes is
//! the caller's business; only Verma's robot is told positions. Directions are multiples of 15°, strengths are whole
//! numbers of any unit that grows with the power received, lengths are in micrometres.

mod heading;
mod homing;
mod rival;
mod sheu;

pub use heading::{Heading, Scan};
pub use homing::{Conduct, Guide, Homing, Nav, Nearness, Order, ReqNav, Stage};
pub use rival::{Gradient, Position, Station, reich, verma};
pub use sheu::{BackAndForth, Walk};

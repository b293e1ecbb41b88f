//! Bringing a robot that does not know where it is to the node that waits for rescue (WFR): Tree Assisted Navigation,
//! TAN [Jiang 2011, 3.4]. Clauses TAN-1 to TAN-4.
//!
//! It is a pure rule over what the robot hears. Where it is, how strong a signal arrives and how long a walk takes is
//! the caller's business. Directions are multiples of 15°, strengths are whole numbers of any unit that grows with the
//! power received, lengths are in micrometres.

mod heading;
mod homing;

pub use heading::{Heading, Scan};
pub use homing::{Guide, Homing, Nav, Nearness, Order, ReqNav, Stage};

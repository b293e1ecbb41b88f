//! Robot teams in radio fields: broadcasts, antennas, rescues end to end and positions, and how they are drawn and
//! counted.

mod campaign;
pub mod draw;
pub mod position;
pub mod radio;
pub mod rescue;
pub mod stats;
pub mod tan;

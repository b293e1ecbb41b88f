//! Pack exploration (Jasmine Xavier and Shantha Selva Kumari 2013, II.A and II.B): robots that see as far as R_s
//! explore an area of square cells together, and stay connected within R_c, without a base. The paper has the
//! definitions: the visibility gain, the metric gain, and the connection graph. How robots choose and go is ours.
//! Clauses: PACK-1 … PACK-9.
//!
//! A [`Team`] is a plain value with one call: [`Team::advance`] makes a team move. After it, each robot looks round:
//! [`Chart::look`] takes what it sees into the map that all robots share. A robot sees all four cells beside its own,
//! so no step is ever blocked by an obstacle.
//!
//! A team takes about 1.8 KB. A search takes 10 bytes a cell of lent memory ([`Scratch`]), and the history one step a
//! robot and team move, which the caller stores ([`Past`]).

mod aim;
mod chart;
mod choice;
mod flood;
mod march;
mod rule;
mod sight;
mod team;

pub use chart::{Chart, Status};
pub use flood::Scratch;
pub use rule::{Condition, Conditions, RangeError, Rule};
pub use sight::{Sight, Window};
pub use team::{End, MoveKind, Past, SetupError, Team, is_connected};

/// The most robots of a team.
pub const MAX_ROBOTS: usize = 32;

//! The recursive chain of robots [Kovács 2011, III: Algorithms 1 to 3]: a base, a leader that seeks the nearest
//! unexplored cell, and followers between them that keep radio contact. Clauses CHAIN-1 to CHAIN-28.
//!
//! [`Chain::plan`] says what the team intends; [`Chain::settle`] takes the answers of the world, or [`Chain::hear`] the
//! messages of those who met them. The history that backtracking needs is the log of the robots' one-byte messages,
//! kept by the caller and read backwards.

mod admission;
mod barrier;
mod choices;
mod habit;
mod message;
mod past;
mod plan;
mod planner;
mod reel;
mod reform;
mod rule;
mod settle;
mod solver;
mod team;
mod unfold;
mod walk;

pub use barrier::{Barrier, ByteEffect};
pub use habit::{Habit, Habits};
pub use message::{Damage, Message, Outcome};
pub use plan::{Kind, Plan};
pub use reform::{Parts, ReformError, Reformation};
pub use rule::{Budget, Condition, Conditions, High, Move, Pursuit, Role, Rule};
pub use team::{Chain, End, Intent, MoveOutcome, SetupError, Walls, area};
pub use walk::goes_on;

/// The longest chain, base included: its area is 511×511 cells.
pub const MAX_ROBOTS: usize = 256;

//! KIT, Keep In Touch (Peiris, Al-Jumaily and Jiang): robots on a lattice of nodes 3 m apart, which drive every path
//! between two nodes and keep radio contact of 10 m. Clauses: KIT-1 … KIT-14.
//!
//! [`Kit`] is a team as a plain value: what each robot has recorded, and where each is. [`Kit::decide`] begins a
//! decision and says at which side the robot looks; [`Kit::looked`] takes what it sees, until it drives, stays, or is
//! done; [`Kit::arrived`] ends a drive. It has no clock: when a robot arrives, and who decides first, is the caller's
//! business, a search that tries every order, a simulator with speeds, or the world itself. A robot of flesh and wire
//! keeps such a team of its own, as far as it was told, and tells by [`Message`]s; [`Talk`] says when it sends which.

mod admission;
mod alone;
mod around;
mod caravan;
mod message;
mod refusals;
mod rule;
mod stance;
mod talk;
mod team;
mod tether;
mod ways;

pub use message::{Damage, FIELDS, Message};
pub use refusals::{Misuse, SetupError};
pub use rule::{Answers, Condition, Conditions, Fallback, Filter, Records, Rule, Runs};
pub use stance::{Reach, Stance, touch};
pub use talk::{Letter, NUMBERS, Outbox, Phase, Talk};
pub use team::{Crew, Kit, MAX_ROBOTS, Next, Robot, Sight};

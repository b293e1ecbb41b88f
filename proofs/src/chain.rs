//! The chain (CHAIN): what is promised of it, the search over all layouts that it is played in, what it can reach, and
//! in how few team moves.

mod appearing_walls;
pub mod areas;
mod barrier;
pub mod bounds;
pub mod breach;
pub mod clauses;
mod crowd;
mod death;
mod environment;
mod every_area;
mod game;
pub mod invariant;
pub mod links;
pub mod local;
mod milestones;
pub mod optimum;
pub mod own_clauses;
mod pair;
pub mod paper_clauses;
pub mod plain;
mod plain_game;
mod plain_reel;
mod plain_walk;
pub mod reach;
pub mod readings;
pub mod search;
mod small;
mod subject;
mod three;
mod walk;
mod whole_runs;

pub use pair::{Farthest, farthest};
pub use subject::{Deception, Subject};

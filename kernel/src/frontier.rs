//! Frontier cells (Rajesh, Nagaraja and Suja 2024, 4, “Frontier Cell Selection” and “Moving to the Selected Frontier
//! Cell”; 5, “Implementation”): robots that explore an area of equal square cells. Each keeps a repository, a [`Map`]
//! of which cells are explored and which are obstacles, goes to an unexplored neighbour of its cell, and tells the
//! others. Clauses: FRONTIER-1 … FRONTIER-13.
//!
//! A [`Robot`] is a plain value with three calls. [`Robot::next`] says what it does next; [`Robot::looked`] takes what
//! it sees of the cell that it is about to enter; [`Robot::arrived`] ends the move. [`Robot::hears`] takes what another
//! robot tells. Which robot acts when, which cells are blocked and which messages arrive is the caller's business.
//!
//! [`Place`] is for robots whose position has an error: where a robot is within its cell, the occupancy probability of
//! equation (11), and the cell that a fix is taken for; [`Rule::may_go`] says whether such a robot is sure enough to
//! move. A robot takes a map and 16 bytes. A decision searches the map as far as the cell that the robot goes to, once
//! for itself and for each robot nearby, and again where others take the cells that are nearer.

mod map;
mod pairs;
mod place;
mod robot;
mod rule;
mod search;

pub use map::{Map, Status, TinyMap};
pub use pairs::{Pair, Scratch, Seeker};
pub use place::{HALF, Occupancy, Place, SIDE, Threshold, clamped, taken_for};
pub use robot::{Next, Other, Robot, Sight, Slot, Stance, View};
pub use rule::{
    Basis, Condition, Conditions, DETOUR, FIVE_STEPS, Otherwise, Rule, SURE_DEVIATIONS, Ties, midpoint,
};
pub use search::{Search, SearchCell, Target, Way};

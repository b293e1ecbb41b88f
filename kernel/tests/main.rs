//! The kernel, tried as a whole.

mod backtracks;
mod beliefs;
mod chain;
mod choice;
mod corridors;
mod errors;
#[path = "support/floors.rs"]
mod floors;
mod frontier;
mod grids;
mod hearing;
mod kit;
mod minima;
mod notice;
#[path = "support/numbers.rs"]
mod numbers;
mod pack;
mod position;
#[path = "support/ranges.rs"]
mod ranges;
mod reforming;
mod sight;
mod sizes;
mod stored;
mod trees;

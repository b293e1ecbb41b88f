//! The kernel, tried as a whole.

#![expect(
    clippy::disallowed_methods,
    reason = "a test that shares nothing with what it tries has its bounds beside it"
)]

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

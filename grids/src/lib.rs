//! Grids of any size: the ground truth of a run as files and generators give it, what a chain of robots knows of a
//! large area, and dice that fall the same on every machine. It knows no run and no engine.

pub mod chance;
pub mod heap_grid;
pub mod layout;

//! The simulator, tried as a whole.

mod agents;
mod beyond;
mod common;
mod explore;
mod failures;
mod frontier;
mod kit;
mod laps;
mod minimise;
mod noticed;
mod own_team;
mod pack;

//! What the simulator does, tried as a whole.

mod agents;
mod beyond;
mod common;
mod explore;
mod faults;
mod frontier;
mod kit;
mod laps;
mod minimise;
mod own_team;
mod pack;
mod page;
mod rivals;
mod same_runs;
mod seeds;
mod wide;

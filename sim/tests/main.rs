//! The simulator, tried as a whole.

#![expect(
    clippy::disallowed_methods,
    reason = "a test that shares nothing with what it tries has its bounds beside it"
)]

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
mod own_round;
mod own_run;
mod own_team;
mod pack;

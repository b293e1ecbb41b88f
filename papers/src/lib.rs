//! The tables and figures of the papers and SPEC.md, measured again, and dealt out to many machines.

pub mod chart;
mod nxt;
pub mod rivals;
pub mod shards;
pub mod tables;

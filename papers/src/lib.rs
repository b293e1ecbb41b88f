//! What the papers and SPEC.md report as tables and figures, measured again, and dealt out to many machines.

pub mod chart;
mod nxt;
pub mod rivals;
pub mod shards;
pub mod tables;

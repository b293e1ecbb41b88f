//! The ground (LATTICE): what all schemes on cells rest on.

pub mod clauses;
mod environments;
mod frontier;

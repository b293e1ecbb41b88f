//! Positions by signal strength (POSITION): what is promised of the ways from distances to a position.

mod belief;
pub mod clauses;
mod lattice;
mod minima;
mod refusals;
mod swarm;
mod way;
mod wrong_ways;

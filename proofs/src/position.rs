//! Positions by signal strength (POSITION): what is promised of the ways from distances to a position.

mod belief;
mod broken;
pub mod clauses;
mod lattice;
mod minima;
mod refused;
mod swarm;
mod way;

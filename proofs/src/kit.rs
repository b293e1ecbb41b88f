//! KIT (KIT): what is promised of robots that keep in touch, over all states on small lattices, over all orders of
//! their messages, and over all pairs of places.

pub mod clauses;
pub mod counterexample;
mod lattices;
pub mod local;
mod pairs;
mod plain;
pub mod symmetry;
mod talks;
#[cfg(test)]
mod told;
#[cfg(test)]
mod traps;
pub mod world;

pub use pairs::farthest;

//! KIT (KIT): what is promised of robots that keep in touch, over all states on small lattices, over all orders of their
//! messages, and over all pairs of places.

pub mod clauses;
mod lattices;
mod pairs;
mod plain;
mod talks;
mod world;

pub use lattices::{Smallest, smallest};

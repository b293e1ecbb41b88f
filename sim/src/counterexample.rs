//! Counterexamples: how they are found, made minimal and stored.

pub mod minimise;
pub mod own;
pub mod refutation;

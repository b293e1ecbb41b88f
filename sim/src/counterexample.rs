//! Counterexamples: how they are found, made minimal, stored, and written down for judges who share no code with what
//! made them.

pub mod judge_input;
pub mod minimise;
pub mod own;
pub mod refutation;

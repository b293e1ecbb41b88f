//! What Tautline claims, and how the claims are decided: the clauses of `SPEC.md` with their mutants, the engines
//! that answer every choice, the search over all layouts, what a chain can reach and in how few team moves, and the
//! judges of counterexamples.

mod ants;
mod bricks;
pub mod clause;
pub mod course;
pub mod crowd;
pub mod decide;
pub mod engine;
pub mod evidence;
pub mod floor_judge;
pub mod frontier;
pub mod homing;
pub mod invariant;
pub mod judge;
pub mod links;
mod marking;
pub mod notice;
pub mod optimum;
pub mod pair;
pub mod plain;
mod plans;
pub mod reach;
pub mod registry;
pub mod rescue;
pub mod run;
pub mod search;
pub mod small;
mod states;
#[cfg(kani)]
mod symbolic;
pub mod three;
pub mod trap;
pub mod walk;
pub mod whole;
pub mod words;

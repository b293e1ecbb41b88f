//! What Tautline claims, and how the claims are decided. The clauses of `SPEC.md` stand in the rooms of their schemes,
//! with their mutants; shared rooms know no scheme, so that anyone can bring a rule of their own.

pub mod ants;
pub mod bricks;
pub mod chain;
pub mod clause;
pub mod decide;
pub mod engine;
pub mod floor;
pub mod floor_trace;
pub mod frontier;
pub mod ground;
pub mod judge;
pub mod kit;
pub mod ledger;
pub mod mrc;
pub mod notice;
pub mod pack;
pub mod plural;
pub mod position;
pub mod run;
mod step_check;
pub mod tan;
pub mod team;

//! Frontier cells (Rajesh, Nagaraja and Suja 2024): the clauses FRONTIER-1 to FRONTIER-11 and what decides them.

pub mod areas;
pub mod clauses;
pub mod drift;
mod fused;
pub mod local;
mod pairs;
mod place;
pub mod world;

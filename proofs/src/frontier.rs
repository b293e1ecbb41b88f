//! Frontier cells (Rajesh, Nagaraja and Suja 2024): the clauses FRONTIER-1 to FRONTIER-8 and what decides them.

pub mod areas;
pub mod clauses;
pub mod drift;
mod place;
pub mod world;

//! Frontier cells (Rajesh, Nagaraja and Suja 2024): the clauses FRONTIER-1 to FRONTIER-12 and what decides them.

pub mod areas;
pub mod clauses;
mod detour;
pub mod drift;
mod fused;
pub mod local;
mod pairs;
mod place;
mod readings;
pub mod world;

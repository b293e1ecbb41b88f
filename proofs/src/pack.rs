//! Pack exploration (Jasmine Xavier and Shantha Selva Kumari 2013, II): the clauses PACK-1 to PACK-9 and what decides
//! them.

pub mod clauses;
mod floors;
mod gains;
pub mod local;
mod rays;
mod readings;
mod run;

pub use floors::are_side_by_side;
pub use run::Moves;

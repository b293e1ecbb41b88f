//! The rivals of the chain [Kovács 2011, C and D]: teams whose links are a tree through the base, and whose next team
//! move is the one of highest utility, of all that there are ([`full`]: Full search) or of some drawn at random
//! ([`pool`]: Rooker and Birk 2007). Every reading of the paper, and every number that it leaves open, is a field of
//! [`Parameters`]. The links of [`joint_step`] are those of a chain; there the best joint step is found without a
//! search.

pub mod full;
pub mod joint;
pub mod joint_step;
mod knowledge;
pub mod parameters;
pub mod pool;
mod rows;
pub mod team;

pub use self::parameters::{
    Cells, Deadlock, Links, Moves, Null, ParameterError, Parameters, Search, Weights,
};
pub use self::rows::{
    CATALOGUE, COVERED, COVERED_SHARED, FULL_SEARCH, RIVALS, ROOKER_BIRK, SCATTER, SHARED, fault, rival,
};
pub use self::team::{Standstill, Team};

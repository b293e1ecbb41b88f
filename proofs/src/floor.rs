//! Small sensor floors, shared by all agents on them: what a scheme of agents is, which plans there are, and all states
//! of many of them.

pub mod crew;
pub(crate) mod plans;
pub(crate) mod search;
pub(crate) mod series;
pub(crate) mod small;
pub(crate) mod team;
pub mod trap;

//! Small sensor floors, shared by all agents on them: which plans there are, what is missed, and all states of many of
//! them.

mod agents;
pub(crate) mod look;
pub(crate) mod plans;
pub(crate) mod small;
pub mod trap;
mod way;

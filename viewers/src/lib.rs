//! Runs and rescues as files for the viewers that people have.

pub mod itf;
pub mod mcap;
pub mod rescue;

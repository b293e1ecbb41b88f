//! TAN (TAN): what is promised of a robot on its way from node to node.

pub mod clauses;
mod legs;
#[cfg(test)]
mod silence;
mod way;

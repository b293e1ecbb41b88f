//! Broadcasting an event through a network of sensor nodes (paper 003, 3.2): k-farthest-node forwarding, and the
//! schemes that it is compared with. Clauses NOTICE-1 to NOTICE-6.
//!
//! A node's state is a plain value, [`Node`], one for each source that it hears of. [`Node::receive`] says what a
//! NOTICE makes of it, [`Node::expire`] whether the node forwards when its wait is over. Time and distance are whole
//! numbers, so that a run is the same on every machine. What is left to chance, how long a node waits under the schemes
//! that wait at random, is asked of a [`Source`](crate::choice::Source).

mod node;
mod rule;
mod strength;
mod surroundings;

pub use node::{Node, Notice, Reaction, Reception, Stage};
pub use rule::{Condition, Conditions, Count, Rule, Scheme};
pub use strength::Propagation;
pub use surroundings::{Surroundings, words};

/// The identity of a node: its number in the network.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Default)]
pub struct NodeId(pub u32);

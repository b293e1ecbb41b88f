//! Broadcasting an event through a network of sensor nodes [Jiang 2011, 3.2]: k-farthest-node forwarding, and the
//! schemes that it is compared with. Clauses NOTICE-1 to NOTICE-6.
//!
//! A node's state is a plain value, [`Node`], one for each source that it hears of. [`Node::receive`] says what a
//! NOTICE makes of it, [`Node::expire`] whether the node forwards when its wait is over. Time and distance are whole
//! numbers, so that a run is the same on every machine. What is left to chance, how long a node waits under the schemes
//! that wait at random, is asked of an [`Oracle`](crate::choice::Oracle).

mod node;
mod rule;
mod surroundings;

pub use node::{Node, Reaction, Stage};
pub use rule::{Condition, Conditions, Count, Rule, Scheme};
pub use surroundings::{Surroundings, words};

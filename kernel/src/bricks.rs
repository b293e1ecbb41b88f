//! Brick&Mortar [Ferranti 2009, II.A]: agents thicken the walls by marking cells as visited, which nobody goes through
//! again, and keep the cells that are left connected; an agent that can go nowhere knows that all is explored. The
//! marking is the paper's. The way to the next cell and loop closure, which the paper leaves out, and what makes
//! agents robust against missed sensors are ours. Clauses: BRICKS-1 … BRICKS-15.

mod agent;
mod lap;
mod marking;
mod rule;
pub mod tree;

pub use agent::{Act, Agent, Next, Pass, act, carry_out};
pub use lap::Lap;
pub use marking::{blocks, is_thin};
pub use rule::{Condition, Conditions, Precedence, Rule};

//! Brick-tree (ours): Brick&Mortar [Ferranti 2009] whose loops are closed by trees in place of laps. A cell that does
//! not block is marked as visited, as the paper has it. One that blocks joins the tree of a cell beside it; where there
//! is none and nothing is left to explore, the agent founds one. A cell of a tree without children is visited once all
//! cells of trees beside it are of its own tree, and its agent goes to its parent. Clauses: BRICKS-1 … BRICKS-14.
//!
//! *Helpers* is the same without bricks: depth first search, several agents sharing the trees that they
//! meet: *careful* ones look underfoot before they place a sensor, *doubting* ones place it unasked and
//! believe what they miss after several scans.

mod agent;
mod note;
mod rule;
mod view;

pub use agent::{Act, Agent, Next, act, carry_out};
pub use note::{Label, Note, State, settle};
pub use rule::{Condition, Conditions, Rule};
pub use view::View;

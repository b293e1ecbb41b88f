//! Engines: ways to answer every choice. They know no scheme, and of the kernel only its choices.
//!
//! A *body* is one case of a clause; the same body is a bounded proof under [`exhaust`], a property under a [`Tape`]
//! that proptest or a fuzzer wrote, a random test under [`SeededOracle`], a regression under [`Replay`], and a Kani
//! harness. A [`Game`](tree::Game) is a team in layouts that are decided as it meets them; a [`System`](states::System)
//! has states that many ways lead to; [`Cases`](cases::Cases) are examined each by itself. What was found by any of
//! them is a list of [`Choices`], which anyone can make again.

mod bodies;
pub mod cases;
pub mod model;
mod script;
pub mod smallest;
pub mod states;
#[cfg(kani)]
pub mod symbolic;
pub mod threads;
pub mod tree;
pub mod watchdog;
pub mod world;

pub use bodies::{
    Outcome, Replay, SeededOracle, Stop, Tally, Tape, assume, cover, exhaust, outcomes, require, sample,
};
pub use script::{Choices, Script, ScriptError};

/// How far an engine goes.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Until {
    /// To the end of its bound.
    Exhausted,
    /// To any violation: enough to reject a mutant.
    Violation,
}

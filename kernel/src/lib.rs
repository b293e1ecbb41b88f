//! Tautline's rules: pure functions from what a robot team knows to what it does next.
//!
//! The kernel does no input or output, allocates nothing and asks nobody anything. A team step is two calls:
//! *plan* says what the team intends, *settle* takes the answers of the world and gives the next state. Who
//! answers, a layout, a generator, an adversary or a solver, is the caller's business. Every rule names the
//! paper and the equation it comes from; `SPEC.md` lists what is claimed of it.

#![no_std]

pub mod ants;
pub mod bricks;
pub mod chain;
pub mod choice;
pub mod conditions;
mod error;
pub mod floor;
pub mod frontier;
pub mod ground;
pub mod kit;
pub mod mrc;
pub mod net;
pub mod notice;
pub mod pack;
pub mod position;
pub mod tan;

/// For [`conditions!`], wherever it is used.
#[cfg(feature = "defmt")]
#[doc(hidden)]
pub use defmt;

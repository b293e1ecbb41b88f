//! Tautline's claims, and how they are decided. The clauses of `SPEC.md` stand in the rooms of their schemes, with
//! their mutants; shared rooms know no scheme, so that anyone can bring a rule of their own.
//!
//! Without the feature `rooms` there are the engines alone: [`engine`], [`team`], [`protocol`], [`local`], [`decide`],
//! [`clause`], [`ambiguity`], [`ledger`], [`judge`].

pub mod ambiguity;
#[cfg(feature = "rooms")]
pub mod ants;
#[cfg(feature = "rooms")]
pub mod bricks;
#[cfg(feature = "rooms")]
pub mod chain;
pub mod clause;
pub mod decide;
pub mod engine;
#[cfg(feature = "rooms")]
pub mod floor;
pub mod floor_trace;
#[cfg(feature = "rooms")]
pub mod frontier;
#[cfg(feature = "rooms")]
pub mod ground;
pub mod judge;
#[cfg(feature = "rooms")]
pub mod kit;
pub mod ledger;
pub mod local;
#[cfg(feature = "rooms")]
pub mod mrc;
#[cfg(feature = "rooms")]
pub mod notice;
#[cfg(feature = "rooms")]
pub mod pack;
pub mod plural;
#[cfg(feature = "rooms")]
pub mod position;
pub mod protocol;
pub mod run;
mod step_check;
#[cfg(feature = "rooms")]
pub mod tan;
pub mod team;

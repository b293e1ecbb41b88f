//! Tautline: verified multi-robot coordination. The simulator around the kernel, and its command line.

pub mod aside;
pub mod cli;
pub mod exhibit;
pub mod explore;
pub mod fault;
pub mod homing;
pub mod hunt;
pub mod layout;
pub mod minimise;
pub mod radio;
pub mod refutation;
pub mod reproduce;
pub mod rescue;
pub mod trace;
pub mod view;
pub mod wide;

/// The README's code, compiled and run.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

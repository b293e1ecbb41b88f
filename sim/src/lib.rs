//! Robot teams in layouts and radio fields: the runs of the kernel's rules, their traces and counterexamples, and how they
//! are drawn and counted. What a person types, and how an error is printed, is the program's business.

pub mod aside;
pub mod columns;
pub mod exhibit;
pub mod explore;
pub mod fault;
pub mod hunt;
pub mod layout;
pub mod minimise;
pub mod radio;
pub mod reading;
pub mod refutation;
pub mod rescue;
pub mod stats;
pub mod tables;
pub mod tan;
pub mod trace;
pub mod view;
pub mod wide;
pub mod words;

/// The README's code, compiled and run.
#[cfg(doctest)]
#[doc = include_str!("../../README.md")]
struct Readme;

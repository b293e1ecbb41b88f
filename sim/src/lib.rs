//! Robot teams in layouts and radio fields: the runs of the kernel's rules, their traces and counterexamples, and how they
//! are drawn and counted. What a person types, and how an error is printed, is the program's business.

pub mod aside;
pub mod columns;
pub mod counterexample;
pub mod draw;
pub mod explore;
pub mod fault;
pub mod faults;
pub mod frontier;
mod kept;
pub mod kit;
pub mod layout;
pub mod part;
pub mod position;
pub mod radio;
pub mod reading;
pub mod rescue;
pub mod rivals;
pub mod schema;
pub mod shards;
pub mod stats;
pub mod tables;
pub mod tan;
pub mod trace;
pub mod tribot;
pub mod wide;
pub mod words;

/// The code of the page on embedding, compiled and run.
#[cfg(doctest)]
#[doc = include_str!("../../docs/embed.md")]
struct Embedding;

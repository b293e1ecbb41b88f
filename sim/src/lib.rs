//! Robot teams in layouts: the runs of the kernel's rules, their traces and counterexamples, and how they are drawn. What a person types, and how an error is printed, is the program's business.

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
pub mod noise;
pub mod part;
pub mod reading;
pub mod rivals;
pub mod schema;
pub mod shards;
pub mod trace;
pub mod wide;
pub mod words;

/// The code of the page on embedding, compiled and run.
#[cfg(doctest)]
#[doc = include_str!("../../docs/embed.md")]
struct Embedding;

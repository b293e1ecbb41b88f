//! Robot teams in layouts: the runs of the kernel's rules, their traces and counterexamples, and how they are drawn.
//! Reading what a person types, and printing errors, is left to a program.

pub mod counterexample;
pub mod draw;
pub mod explore;
pub mod failures;
pub mod frontier;
pub mod kit;
pub mod objects;
pub mod options;
pub mod shards;
pub mod trace;

/// The code of the page on embedding, compiled and run.
#[cfg(doctest)]
#[doc = include_str!("../../docs/embed.md")]
struct Embedding;

//! Robot teams in layouts: the runs of the kernel's rules, their traces and counterexamples, and how they are drawn.
//! Reading what a person types, and printing errors, is left to a program.

pub mod atomic_file;
pub mod checkpoint;
pub mod counterexample;
pub mod diagnostic;
pub mod draw;
pub mod explore;
pub mod failures;
pub mod frontier;
pub mod heap_grid;
pub mod kit;
pub mod layout;
pub mod named_values;
pub mod noise;
pub mod objects;
pub mod options;
pub mod schema;
pub mod shards;
pub mod text_table;
pub mod trace;
pub mod value_parser;

/// The code of the page on embedding, compiled and run.
#[cfg(doctest)]
#[doc = include_str!("../../docs/embed.md")]
struct Embedding;

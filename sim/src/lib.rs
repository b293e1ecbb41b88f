//! Robot teams in layouts: the runs of the kernel's rules, their traces and counterexamples, and how they are drawn.
//! What a person types, and how an error is printed, is the program's business.

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

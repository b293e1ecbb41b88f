//! The program as users run it, and the documents beside it.

mod circles;
mod cli;
mod commands;
mod conform;
mod documents;
mod folder;
mod foreign;
#[expect(unreachable_pub, reason = "the library of the fuzz targets is a module here")]
mod fuzz_corpus;
mod judge;
mod layouts;
mod mcap;
mod mcp;
mod names;
mod page;
mod proved;
mod python;
mod recipes;
mod refutations;
mod schema;
mod schemas;
mod tidy;

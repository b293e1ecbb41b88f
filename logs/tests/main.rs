//! Logs are read as they were written, and judged by the sentences of SPEC.md.

mod forms;
mod ground;
mod judged;
mod many;
mod read;

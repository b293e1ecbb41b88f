//! Certificates that a search over all states has broken nothing, and their checker. It shares no code with a search:
//! of a system it knows the step function alone ([`Model`]), and enumerates by itself what an oracle may answer.
//!
//! A certificate is a file with a header, a *section* for each system, and a digest of all before it. A section lists
//! the states of a system as a tree: from each state every step, which either leads to a state that stands next in the
//! tree, or to one that stands elsewhere, by its number. So the checker comes by the states without their bytes: it
//! starts where the model starts, and makes each step. `docs/certificates.md` says why a clause holds whose certificate
//! is accepted.

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

mod file;
mod model;
mod runs;
mod states;
mod verdict;

pub use file::{Fault, File, Header, digest, put, read, take, write};
pub use model::{Model, Step};
pub use runs::{Ready, Runs, check_runs};
pub use states::check_states;
pub use verdict::{Counts, Refusal};

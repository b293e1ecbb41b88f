//! Judges of counterexamples, who know no rule of the kernel and nothing of the engines that find them.

pub mod chain;
pub mod floor;

//! Tautline: verified multi-robot coordination. The simulator around the kernel, and its command line.

pub mod fault;
pub mod layout;
pub mod wide;

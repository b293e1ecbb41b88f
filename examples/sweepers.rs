//! A team of one's own, simulated.

fn main() {}

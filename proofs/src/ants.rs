//! Ants (ANTS): what is promised of agents that go where they have been least, over all states on small floors.

pub mod clauses;
mod colony;
mod ties;
mod walk;

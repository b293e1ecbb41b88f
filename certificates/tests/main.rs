//! The checker by itself.

mod runs;
mod states;

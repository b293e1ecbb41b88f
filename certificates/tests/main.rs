//! The checker by itself.

mod check;

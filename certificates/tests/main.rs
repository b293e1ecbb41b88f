//! The checker by itself.

mod drawn;
mod runs;
mod states;

/// A number that seed and place make.
fn drawn(seed: u64, number: u64) -> u64 {
    let mixed = (seed ^ number).wrapping_mul(0x9E37_79B9_7F4A_7C15);
    (mixed ^ mixed >> 29).wrapping_mul(0xBF58_476D_1CE4_E5B9) >> 20
}

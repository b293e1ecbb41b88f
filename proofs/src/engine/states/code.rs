//! States in a few bytes, and their hashes.

use std::hash::{BuildHasher, Hash, Hasher};

use rustc_hash::FxBuildHasher;

/// The hash of a state.
pub(super) type HashOfState = u32;

/// A state by the numbers of its parts, most of which are also those of the states before and after it; at first it has
/// none.
#[derive(Clone, Default)]
pub(super) struct Code {
    pub(super) bytes: Vec<u8>,
    /// Bytes of a number.
    width: usize,
    pub(super) hash: HashOfState,
}

impl Code {
    /// Has no numbers any more; the next ones are of so many bytes.
    pub(super) fn clear(&mut self, width: usize) {
        self.bytes.clear();
        (self.width, self.hash) = (width, 0);
    }

    /// Adds the number in the next place.
    pub(super) fn push(&mut self, number: u32) {
        self.widen(width_of(number));
        let place = self.bytes.len() / self.width;
        self.bytes.extend_from_slice(&number.to_le_bytes()[..self.width]);
        self.hash ^= hash_at(place, number);
    }

    /// Makes `number` the one in this place.
    pub(super) fn put(&mut self, place: usize, number: u32) {
        self.widen(width_of(number));
        let bytes = &mut self.bytes[place * self.width..(place + 1) * self.width];
        self.hash ^= hash_at(place, self::number(bytes)) ^ hash_at(place, number);
        bytes.iter_mut().zip(number.to_le_bytes()).for_each(|(byte, of)| *byte = of);
    }

    /// The number in this place, if there is one.
    pub(super) fn at(&self, place: usize) -> Option<u32> {
        self.bytes.get(place * self.width..(place + 1) * self.width).map(number)
    }

    /// Writes its numbers with at least so many bytes.
    pub(super) fn widen(&mut self, width: usize) {
        if width > self.width {
            self.bytes = widened(&self.bytes, self.width, width);
            self.width = width;
        }
    }

    pub(super) fn set_to(&mut self, other: &Self) {
        self.bytes.clone_from(&other.bytes);
        (self.width, self.hash) = (other.width, other.hash);
    }
}

/// The bytes that a number needs.
pub(super) const fn width_of(number: u32) -> usize {
    (u32::BITS - (number | 1).leading_zeros()).div_ceil(8) as usize
}

/// The numbers of `code`, which are of `before` bytes, each in `width` of them.
pub(super) fn widened(code: &[u8], before: usize, width: usize) -> Vec<u8> {
    let numbers = code.chunks_exact(before.max(1)).map(number);
    numbers.flat_map(|number| number.to_le_bytes().into_iter().take(width)).collect()
}

/// A number in these bytes.
pub(super) fn number(bytes: &[u8]) -> u32 {
    match *bytes {
        [a] => u32::from(a),
        [a, b] => u32::from_le_bytes([a, b, 0, 0]),
        [a, b, c] => u32::from_le_bytes([a, b, c, 0]),
        _ => bytes.iter().rev().fold(0, |number, &byte| number << 8 | u32::from(byte)),
    }
}

/// The share of a place in the hash of a state, so that where one part changes, one share does (Zobrist 1970):
/// splitmix64 (Steele, Lea and Flood 2014) of place and number.
const fn hash_at(place: usize, number: u32) -> HashOfState {
    let mixed = ((place as u64 + 1) << u32::BITS | number as u64).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    let mixed = (mixed ^ mixed >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let mixed = (mixed ^ mixed >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
    (mixed >> u32::BITS) as HashOfState
}

/// The hash of bytes.
pub(super) fn hash_of(bytes: &[u8]) -> HashOfState {
    let mut hasher = FxBuildHasher.build_hasher();
    hasher.write(bytes);
    folded(hasher.finish())
}

/// The hash of a part.
pub(super) fn hash_of_part(part: &impl Hash) -> HashOfState {
    folded(FxBuildHasher.hash_one(part))
}

/// The bits of a hash that depend on all of it.
const fn folded(hash: u64) -> HashOfState {
    (hash.wrapping_mul(0x9e37_79b9_7f4a_7c15) >> u32::BITS) as HashOfState
}

//! How much of a tree is searched. Each answer to a question has an equal share of what the question has, and all runs
//! together have the whole: so what a search has done can be compared with what it was dealt, however it went about it.
//!
//! Shares are numbers modulo a prime, in which every small number has an inverse: their sums are exact, and parts that
//! were left out or searched twice go unseen in one case of 2⁶¹.

use serde::{Deserialize, Serialize};

/// A Mersenne prime.
const PRIME: u64 = (1 << 61) - 1;

/// A share of a tree.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, Serialize, Deserialize)]
#[serde(transparent)]
pub(super) struct Share(u64);

impl Share {
    pub(super) const NONE: Self = Self(0);

    pub(super) const WHOLE: Self = Self(1);

    /// This and another one.
    pub(super) const fn and(self, other: Self) -> Self {
        Self((self.0 % PRIME + other.0 % PRIME) % PRIME)
    }

    /// So many times this one.
    pub(super) const fn times(self, count: u32) -> Self {
        match self.0.checked_mul(count as u64) {
            Some(product) => Self(product % PRIME),
            None => Self((self.0 as u128 * count as u128 % PRIME as u128) as u64),
        }
    }

    /// That of each of so many equal parts; there is at least one, and fewer than the prime.
    pub(super) const fn part_of(self, count: u32) -> Self {
        if count == 2 {
            // An odd number is halved as the even one that stands for the same.
            return Self(if self.0.is_multiple_of(2) { self.0 / 2 } else { self.0.div_ceil(2) + PRIME / 2 });
        }
        // By Fermat's little theorem.
        let (mut inverse, mut square, mut power) = (1, count as u128, PRIME - 2);
        while power > 0 {
            if power % 2 == 1 {
                inverse = inverse * square % PRIME as u128;
            }
            square = square * square % PRIME as u128;
            power /= 2;
        }
        Self((self.0 as u128 * inverse % PRIME as u128) as u64)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_parts_add_up_to_what_is_divided() {
        for share in [1, 2, 3, PRIME / 2, PRIME - 2, PRIME - 1].map(Share) {
            for count in 1..100 {
                let part = share.part_of(count);
                assert_eq!(part.times(count), share);
                assert_eq!((0..count).fold(Share::NONE, |sum, _| sum.and(part)), share);
            }
        }
    }
}

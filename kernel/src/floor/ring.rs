//! The eight cells around a cell, as a ring of bits: clockwise from the northern one, so that side neighbours have
//! even places and corners odd ones.

use crate::ground::Side;

/// The cells around, clockwise from the northern one as the bits of a [`Ring`], and
/// the side that leads from each to the next.
pub(super) const AROUND: [(i16, i16, Side); 8] = [
    (0, -1, Side::East),
    (1, -1, Side::South),
    (1, 0, Side::South),
    (1, 1, Side::West),
    (0, 1, Side::West),
    (-1, 1, Side::North),
    (-1, 0, Side::North),
    (-1, -1, Side::East),
];

/// A set of the eight cells around a cell, or of the eight edges between each of them and the next.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Default)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Ring(pub u8);

impl Ring {
    /// The place of the neighbour beyond `side`.
    pub const fn place(side: Side) -> u32 {
        match side {
            Side::North => 0,
            Side::East => 2,
            Side::South => 4,
            Side::West => 6,
        }
    }

    /// The place of the cell in which a sensor lies that is localised `east` and `south` of the centre of the agent's
    /// cell, in the unit of the `side` of a cell; `None` if it is the agent's own, or none of the eight. Where in its
    /// cell the sensor lies does not matter to any rule.
    pub fn locate(east: i32, south: i32, side: u16) -> Option<u32> {
        let side = i32::from(side);
        if side == 0 || east.unsigned_abs() >= 1 << 20 || south.unsigned_abs() >= 1 << 20 {
            return None;
        }
        let offset = [east, south].map(|offset| (offset + side / 2).div_euclid(side));
        let is_there = |&(_, (x, y, _)): &(u32, (i16, i16, Side))| [x, y].map(i32::from) == offset;
        (0..).zip(AROUND).find(is_there).map(|(place, _)| place)
    }

    /// The neighbour beyond `side`.
    pub const fn of(side: Side) -> Self {
        Self(1 << Self::place(side))
    }

    /// Whether the neighbour beyond `side` is in the set.
    pub const fn has(self, side: Side) -> bool {
        self.0 & Self::of(side).0 != 0
    }

    /// Whether the corner clockwise from the neighbour beyond `side` is in the set.
    pub const fn has_right_of(self, side: Side) -> bool {
        self.0 & Self::of(side).0 << 1 != 0
    }

    /// Those in both sets.
    pub const fn and(self, other: Self) -> Self {
        Self(self.0 & other.0)
    }

    /// Those in either set.
    pub const fn or(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }

    /// Those not in the set.
    pub const fn not(self) -> Self {
        Self(!self.0)
    }

    /// How many there are.
    pub const fn count(self) -> u32 {
        self.0.count_ones()
    }

    /// The cells around the one beyond `side` that are in this set, or are the cell itself that the set is around, by
    /// their places around that one.
    pub const fn seen_beyond(self, side: Side) -> Self {
        let turned = self.0.rotate_right(Self::place(side));
        let ahead = (turned & 0b110) << 1 | 1 << 4 | (turned & 0b1100_0000) >> 1;
        Self(ahead.rotate_left(Self::place(side)))
    }

    /// The cells one step along the ring from those of the set, where `rims` are the edges that can be crossed; edge
    /// *i* lies between the cells in places *i* and *i*+1.
    pub const fn beside(self, rims: Self) -> Self {
        Self((self.0 & rims.0).rotate_left(1) | self.0.rotate_right(1) & rims.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cell_of_both_sets_is_in_either() {
        let (one, other) = (Ring(0b0000_0110), Ring(0b0001_0010));
        assert_eq!(one.or(other), Ring(0b0001_0110));
        assert_eq!(one.and(other), Ring(0b0000_0010));
    }

    #[test]
    fn a_cell_between_two_of_the_set_is_beside_them() {
        let set = Ring(0b0000_0101);
        assert_eq!(set.beside(Ring(0b1111_1111)), Ring(0b1000_1010));
        assert_eq!(set.beside(Ring(0b0000_0010)), Ring(0b0000_0010), "from the second one alone");
        assert_eq!(set.beside(Ring::default()), Ring::default());
    }
}

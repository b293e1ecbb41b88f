//! Where a robot is within its cell, how likely it occupies a cell (equation (11)), and which cell a fix is taken for.
//!
//! Lengths are whole numbers, [`SIDE`] to the side of a cell, so that results are the same on every machine.

use core::num::NonZeroU16;

use crate::ground::{Area, Cell};

/// The side L of a cell.
pub const SIDE: i32 = 256;

/// Half of it: from the midpoint of a cell to its rim.
pub const HALF: i32 = SIDE / 2;

/// A place: `x` grows eastwards, `y` southwards, from the midpoint of the cell 0,0.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Default)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Place {
    /// Eastwards.
    pub x: i32,
    /// Southwards.
    pub y: i32,
}

impl Place {
    /// The place with these coordinates.
    pub const fn new(x: i32, y: i32) -> Self {
        Self { x, y }
    }

    /// The midpoint of `cell`.
    pub const fn midpoint(cell: Cell) -> Self {
        Self { x: cell.x as i32 * SIDE, y: cell.y as i32 * SIDE }
    }

    /// This place, moved as far as `to` is from `from`.
    #[must_use]
    pub const fn moved(self, from: Self, to: Self) -> Self {
        Self {
            x: self.x.saturating_add(to.x.saturating_sub(from.x)),
            y: self.y.saturating_add(to.y.saturating_sub(from.y)),
        }
    }

    /// The distance to `other`, rounded down.
    pub const fn distance(self, other: Self) -> u32 {
        let (x, y) = (self.x.abs_diff(other.x) as u64, self.y.abs_diff(other.y) as u64);
        (x * x + y * y).isqrt() as u32
    }
}

/// The cell of `area` whose midpoint is nearest to `place`; of several the one with the lowest number.
pub fn taken_for(area: Area, place: Place) -> Cell {
    let nearest = |coordinate: i32, first: i16, last: i16| {
        // On the rim between two cells the first one counts.
        let line = coordinate.saturating_add(HALF - 1).div_euclid(SIDE);
        line.clamp(first.into(), last.into()) as i16
    };
    let (first, last) = (area.first(), area.last());
    Cell::new(nearest(place.x, first.x, last.x), nearest(place.y, first.y, last.y))
}

/// The place of `cell` that is nearest to `fix`: what a fix tells a robot that counts its cell by its moves.
pub fn clamped(cell: Cell, fix: Place) -> Place {
    let midpoint = Place::midpoint(cell);
    let within = |coordinate: i32, middle: i32| {
        coordinate.clamp(middle.saturating_sub(HALF), middle.saturating_add(HALF))
    };
    Place { x: within(fix.x, midpoint.x), y: within(fix.y, midpoint.y) }
}

/// How the occupancy probability of a cell follows from a robot's distance d to its midpoint (equation (11)), which
/// does not say from where to where d_r is measured.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Occupancy {
    /// d / (L/2), as the equation is printed, at most 1: 0 at the midpoint.
    Printed,
    /// 1 − d / (L/2), at least 0, as the text describes it: 1 at the midpoint. It is the equation as printed, with the
    /// distance to the rim of the circle of radius r = L/2 in place of d.
    Corrected,
    /// The equation as printed, with the distance to the nearest side of the cell in place of d; 0 outside the cell.
    Rim,
}

impl Occupancy {
    /// The occupancy probability of `cell` with a robot at `place`, in units of 1 / [`HALF`].
    pub fn of(self, cell: Cell, place: Place) -> u16 {
        let midpoint = Place::midpoint(cell);
        let within = |distance: u32| if distance < HALF as u32 { distance as u16 } else { HALF as u16 };
        match self {
            Self::Printed => within(place.distance(midpoint)),
            Self::Corrected => HALF as u16 - within(place.distance(midpoint)),
            Self::Rim => {
                let farthest = place.x.abs_diff(midpoint.x).max(place.y.abs_diff(midpoint.y));
                HALF as u16 - within(farthest)
            }
        }
    }
}

/// The threshold T of the occupancy probability, from 0 to 1.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Threshold {
    /// The lowest occupancy probability, in units of 1 / [`HALF`], that is not below it, and 1 more, so that an
    /// optional threshold takes no more memory.
    after: NonZeroU16,
}

impl Threshold {
    /// ½.
    pub const HALF: Self = Self::of(HALF as u16 / 2);

    const fn of(occupancy: u16) -> Self {
        Self { after: NonZeroU16::MIN.saturating_add(occupancy) }
    }

    /// The threshold `share`, rounded to 1 / [`HALF`]; `None` if it is not from 0 to 1.
    pub fn new(share: f64) -> Option<Self> {
        (0.0..=1.0).contains(&share).then(|| Self::of(libm::round(share * f64::from(HALF)) as u16))
    }

    /// Whether an occupancy probability, in units of 1 / [`HALF`], is below it.
    pub const fn is_above(self, occupancy: u16) -> bool {
        occupancy.saturating_add(1) < self.after.get()
    }

    /// The mean of these occupancy probabilities, in units of 1 / [`HALF`], rounded down.
    pub(super) fn mean(values: impl Iterator<Item = u16>) -> Self {
        let (sum, count) = values.fold((0, 0), |(sum, count), value| (sum + u32::from(value), count + 1));
        Self::of(sum.checked_div(count).unwrap_or(0) as u16)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_place_is_taken_for_the_nearest_cell_and_on_a_rim_for_the_lower_number() {
        let area = Area::new(Cell::new(0, 0), Cell::new(2, 1)).expect("an area");
        let taken = |x, y| taken_for(area, Place::new(x, y));
        assert_eq!(taken(0, 0), Cell::new(0, 0));
        assert_eq!(taken(HALF, 0), Cell::new(0, 0));
        assert_eq!(taken(HALF + 1, HALF + 1), Cell::new(1, 1));
        assert_eq!(taken(9 * SIDE, -SIDE), Cell::new(2, 0));
    }

    #[test]
    fn to_the_sides_a_probability_is_one_at_the_midpoint_and_nought_only_outside_the_cell() {
        let at = |x, y| Occupancy::Rim.of(Cell::new(1, 0), Place::new(SIDE + x, y));
        assert_eq!([at(0, 0), at(0, HALF - 1), at(-HALF, 3), at(HALF + 5, 0)], [HALF as u16, 1, 0, 0]);
        let corner = Place::new(SIDE + 100, 100);
        assert_eq!((at(100, 100), Occupancy::Corrected.of(Cell::new(1, 0), corner)), (28, 0));
    }

    #[test]
    fn the_mean_of_probabilities_is_a_threshold() {
        assert_eq!(Threshold::mean([128, 0, 0, 0, 1].into_iter()), Threshold::of(25));
        assert_eq!(Threshold::mean([].into_iter()), Threshold::of(0));
    }

    #[test]
    fn thresholds_are_shares() {
        assert_eq!(Threshold::new(0.5), Some(Threshold::HALF));
        assert!([-0.1, 1.1, f64::NAN].map(Threshold::new).iter().all(Option::is_none));
    }

    #[test]
    fn an_occupancy_that_is_as_high_as_the_threshold_is_not_below_it() {
        let half = HALF as u16 / 2;
        assert!(Threshold::HALF.is_above(half - 1) && !Threshold::HALF.is_above(half));
        assert_eq!(Threshold::new(0.0).map(|none| none.is_above(0)), Some(false));
    }
}

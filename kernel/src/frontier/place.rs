//! Where a robot is within its cell, how likely it occupies a cell (equation (11)), and which cell a fix is taken for.
//!
//! Lengths are whole numbers, [`SIDE`] to the side of a cell, so that results are the same on every machine.

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

/// How the occupancy probability of a cell follows from a robot's distance d to its midpoint (equation (11)).
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Occupancy {
    /// d / (L/2), as the equation is printed, at most 1: 0 at the midpoint.
    Printed,
    /// 1 − d / (L/2), at least 0, as the text describes it: 1 at the midpoint.
    Corrected,
}

impl Occupancy {
    /// The occupancy probability of `cell` with a robot at `place`, in units of 1 / [`HALF`].
    pub const fn of(self, cell: Cell, place: Place) -> u16 {
        let distance = place.distance(Place::midpoint(cell));
        let near = if distance < HALF as u32 { distance as u16 } else { HALF as u16 };
        match self {
            Self::Printed => near,
            Self::Corrected => HALF as u16 - near,
        }
    }
}

/// The threshold T of the occupancy probability, from 0 to 1.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Threshold(u16);

impl Threshold {
    /// ½.
    pub const HALF: Self = Self(HALF as u16 / 2);

    /// The threshold `share`, rounded to 1 / [`HALF`]; `None` if it is not from 0 to 1.
    pub fn new(share: f64) -> Option<Self> {
        (0.0..=1.0).contains(&share).then(|| Self(libm::round(share * f64::from(HALF)) as u16))
    }

    /// Whether an occupancy probability, in units of 1 / [`HALF`], is below it.
    pub const fn is_above(self, occupancy: u16) -> bool {
        occupancy < self.0
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

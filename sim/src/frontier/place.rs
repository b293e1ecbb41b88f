//! Places in whole units, and the cells that they are in.

use tautline_kernel::frontier::{HALF, Place, SIDE};
use tautline_kernel::ground::Cell;
use tautline_kernel::position::Point;

/// The cell that a place is in, in sides of a cell.
pub fn cell_at(at: Point) -> Cell {
    cell_of(place_of(at))
}

/// A place in whole units.
pub(super) fn place_of(at: Point) -> Place {
    let units = |sides: f64| libm::round(sides * f64::from(SIDE)) as i32;
    Place::new(units(at.x_m), units(at.y_m))
}

/// The cell that a place is in.
pub(super) fn cell_of(place: Place) -> Cell {
    let line = |coordinate: i32| (coordinate + HALF).div_euclid(SIDE) as i16;
    Cell::new(line(place.x), line(place.y))
}

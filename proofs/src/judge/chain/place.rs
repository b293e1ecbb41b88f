//! Geometry: places, the sides between them, and the two environments of a robot.

/// Column and row.
pub type Place = (i32, i32);

/// East, south, west, north: the order that settles ties.
pub(super) const SIDES: [Place; 4] = [(1, 0), (0, 1), (-1, 0), (0, -1)];

pub(super) fn add(place: Place, step: Place) -> Place {
    (place.0 + step.0, place.1 + step.1)
}

pub(super) fn side_between(one: Place, other: Place) -> (Place, Place) {
    (one.min(other), one.max(other))
}

/// E_S: the block of nine cells.
pub(super) fn is_safe(centre: Place, place: Place) -> bool {
    (centre.0 - place.0).abs() <= 1 && (centre.1 - place.1).abs() <= 1
}

/// E_C: E_S, and the four cells two steps straight ahead.
pub(super) fn is_covered(centre: Place, place: Place) -> bool {
    is_safe(centre, place) || (centre.0 - place.0).abs() + (centre.1 - place.1).abs() == 2
}

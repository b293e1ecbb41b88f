//! Geometry: places, the sides between them, and the two environments of a robot.

pub(super) use crate::judge::{Place, SIDES, path as side_between};

pub(super) fn add(place: Place, step: Place) -> Place {
    (place.0 + step.0, place.1 + step.1)
}

/// E_S: the block of nine cells.
pub(super) fn is_safe(centre: Place, place: Place) -> bool {
    (centre.0 - place.0).abs() <= 1 && (centre.1 - place.1).abs() <= 1
}

/// E_C: E_S, and the four cells two steps straight ahead.
pub(super) fn is_covered(centre: Place, place: Place) -> bool {
    is_safe(centre, place) || (centre.0 - place.0).abs() + (centre.1 - place.1).abs() == 2
}

//! Numbers of every kind (POSITION-2): what tells no position is refused, and no coordinate is anything but a number.

use tautline_kernel::choice::{Oracle, one_of};
use tautline_kernel::position::{Point, Range};

use super::lattice::is_line;
use super::way::Way;
use crate::engine::{Outcome, require};

/// Places of anchors: on one line, at one place, nearly so, and beside it.
const PLACES: [Point; 7] = [
    Point::new(0.0, 0.0),
    Point::new(2.0, 0.0),
    Point::new(3.0, 0.0),
    Point::new(1.0, 1e-13),
    Point::new(1e-170, 0.0),
    Point::new(0.0, 1.0),
    Point::new(f64::NAN, 1e300),
];

/// Distances of robots, good ones first.
const DISTANCES_M: [f64; 7] = [1.5, 0.0, 40.0, -1.0, f64::NAN, f64::INFINITY, 1e200];

/// Anchors at least and at most.
const ANCHORS: [u32; 2] = [2, 3];

/// The bound of [`is_refused_or_told`], in words.
pub(super) fn numbers() -> String {
    let ([fewest, most], places, distances) = (ANCHORS, PLACES.len(), DISTANCES_M.len());
    format!("{fewest} and {most} anchors at any of {places} places, each at any of {distances} distances")
}

/// POSITION-2.
///
/// # Errors
/// [`Stop`](crate::engine::Stop) if the clause is broken.
pub(super) fn is_refused_or_told(way: &Way, oracle: &mut dyn Oracle) -> Outcome {
    let count = ANCHORS[0] + oracle.pick(ANCHORS[1] - ANCHORS[0] + 1);
    let ranges: Vec<Range> =
        (0..count).map(|_| Range::new(one_of(oracle, &PLACES), one_of(oracle, &DISTANCES_M))).collect();
    let anchors: Vec<Point> = ranges.iter().map(|range| range.anchor).collect();
    let is_number =
        |range: &Range| range.anchor.is_finite() && range.distance_m.is_finite() && range.distance_m >= 0.0;
    // Places that differ by what no number shows are one place.
    let first = |place: &Point| anchors.iter().position(|other| other.distance_m(*place) < 1e-9);
    let places = (0..anchors.len()).filter(|&number| first(&anchors[number]) == Some(number)).count();
    let is_hopeless = places < 3 || !ranges.iter().all(is_number);
    let Ok(told) = way(&ranges, None) else {
        return Ok(if is_hopeless { "refused for want of anchors or numbers" } else { "refused otherwise" });
    };
    require(!is_hopeless, "fewer than three places, and distances that are none, are refused")?;
    require(told.places().all(Point::is_finite), "every coordinate is a number")?;
    // A robot on the line of the anchors has no mirror image.
    let is_beside = told.best.y_m.abs() > 0.1;
    require(
        !is_line(&anchors) || told.other.is_some() || !is_beside,
        "anchors on one line never tell one position beside it",
    )?;
    Ok(if is_line(&anchors) { "anchors on one line" } else { "told" })
}

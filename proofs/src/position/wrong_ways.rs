//! Ways that are wrong in one thing.

use tautline_kernel::position::{Area, Point, Range, Refusal};

use super::way::{WayResult, decibels, metres, published, repaired};

/// Each anchor takes the distance of the next.
pub(super) fn exchanged(ranges: &[Range], area: Option<Area>) -> Result<WayResult, Refusal> {
    let next = ranges.iter().cycle().skip(1);
    let ranges: Vec<Range> = ranges
        .iter()
        .zip(next)
        .map(|(range, next)| Range { distance_m: next.distance_m, ..*range })
        .collect();
    metres(&ranges, area)
}

/// The last anchor is left out, and the first one counts twice.
pub(super) fn without_the_last(ranges: &[Range], area: Option<Area>) -> Result<WayResult, Refusal> {
    let mut ranges = ranges.to_vec();
    if let [first, .., last] = &mut ranges[..] {
        // A place beside the line of the others, at the distance of no robot: it only keeps them from being on one.
        last.distance_m = first.distance_m;
    }
    repaired(&ranges, area)
}

/// Places are told from the first anchor, as if it were the origin.
pub(super) fn from_the_first(ranges: &[Range], area: Option<Area>) -> Result<WayResult, Refusal> {
    let told = metres(ranges, area)?;
    let first = ranges.first().map_or(Point::default(), |range| range.anchor);
    let from = |place: Point| Point::new(place.x_m - first.x_m, place.y_m - first.y_m);
    Ok(WayResult { best: from(told.best), other: told.other.map(from) })
}

/// Distances along y count twice.
pub(super) fn stretched(ranges: &[Range], area: Option<Area>) -> Result<WayResult, Refusal> {
    let ranges: Vec<Range> = ranges
        .iter()
        .map(|range| Range { anchor: Point::new(range.anchor.x_m, 2.0 * range.anchor.y_m), ..*range })
        .collect();
    let halved = |place: Point| Point::new(place.x_m, place.y_m / 2.0);
    let told = decibels(&ranges, area)?;
    Ok(WayResult { best: halved(told.best), other: told.other.map(halved) })
}

/// Of two positions only the better one is told.
pub(super) fn better_alone(ranges: &[Range], area: Option<Area>) -> Result<WayResult, Refusal> {
    metres(ranges, area).map(|told| WayResult { other: None, ..told })
}

/// Of two positions in decibels only the better one is told.
pub(super) fn better_level_alone(ranges: &[Range], area: Option<Area>) -> Result<WayResult, Refusal> {
    decibels(ranges, area).map(|told| WayResult { other: None, ..told })
}

/// Equations (5) to (8) without a look at what they divide by.
pub(super) fn unchecked(ranges: &[Range], area: Option<Area>) -> Result<WayResult, Refusal> {
    let &[a, b, c] = ranges else { return published(ranges, area) };
    let square = |range: Range| {
        let Point { x_m, y_m } = range.anchor;
        range.distance_m * range.distance_m - x_m * x_m - y_m * y_m
    };
    let (v_a, v_b) = ((square(b) - square(c)) / 2.0, (square(b) - square(a)) / 2.0);
    let (to_a, to_c) = (a.anchor.x_m - b.anchor.x_m, c.anchor.x_m - b.anchor.x_m);
    let (up_a, up_c) = (a.anchor.y_m - b.anchor.y_m, c.anchor.y_m - b.anchor.y_m);
    let y_m = (v_b * to_c - v_a * to_a) / (up_a * to_c - up_c * to_a);
    Ok(WayResult::one(Point::new((v_a - y_m * up_c) / to_c, y_m)))
}

/// A distance that is no number counts as 0.
pub(super) fn lenient(ranges: &[Range], area: Option<Area>) -> Result<WayResult, Refusal> {
    // The greater of a number and of none is the number.
    let ranges: Vec<Range> =
        ranges.iter().map(|range| Range { distance_m: range.distance_m.max(0.0), ..*range }).collect();
    metres(&ranges, area)
}

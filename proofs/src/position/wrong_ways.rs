//! Ways that are wrong in one thing, and else as the way that they are given.

use tautline_kernel::position::{Area, Point, Range, Refusal};

use super::way::{Way, WayResult, published};

type Told = Result<WayResult, Refusal>;

/// Each anchor takes the distance of the next.
pub(super) fn exchanged(way: Way, ranges: &[Range], area: Option<Area>) -> Told {
    let next = ranges.iter().cycle().skip(1);
    let ranges: Vec<Range> = ranges
        .iter()
        .zip(next)
        .map(|(range, next)| Range { distance_m: next.distance_m, ..*range })
        .collect();
    way(&ranges, area)
}

/// The last anchor is left out, and the first one counts twice.
pub(super) fn without_the_last(way: Way, ranges: &[Range], area: Option<Area>) -> Told {
    let mut ranges = ranges.to_vec();
    if let [first, .., last] = &mut ranges[..] {
        // A place beside the line of the others, at the distance of no robot: it only keeps them from being on one.
        last.distance_m = first.distance_m;
    }
    way(&ranges, area)
}

/// Places are told from the first anchor, as if it were the origin.
pub(super) fn from_the_first(way: Way, ranges: &[Range], area: Option<Area>) -> Told {
    let told = way(ranges, area)?;
    let first = ranges.first().map_or(Point::default(), |range| range.anchor);
    let from = |place: Point| Point::new(place.x_m - first.x_m, place.y_m - first.y_m);
    Ok(WayResult { best: from(told.best), other: told.other.map(from) })
}

/// Distances along y count twice.
pub(super) fn stretched(way: Way, ranges: &[Range], area: Option<Area>) -> Told {
    let ranges: Vec<Range> = ranges
        .iter()
        .map(|range| Range { anchor: Point::new(range.anchor.x_m, 2.0 * range.anchor.y_m), ..*range })
        .collect();
    let halved = |place: Point| Point::new(place.x_m, place.y_m / 2.0);
    let told = way(&ranges, area)?;
    Ok(WayResult { best: halved(told.best), other: told.other.map(halved) })
}

/// Of two positions only the better one is told.
pub(super) fn better_alone(way: Way, ranges: &[Range], area: Option<Area>) -> Told {
    way(ranges, area).map(|told| WayResult { other: None, ..told })
}

/// A position that is asked for within a rectangle is anywhere.
pub(super) fn anywhere(way: Way, ranges: &[Range], _: Option<Area>) -> Told {
    way(ranges, None)
}

/// A distance that is no number counts as 1 m.
pub(super) fn lenient(way: Way, ranges: &[Range], area: Option<Area>) -> Told {
    let number = |metres: f64| if metres.is_nan() { 1.0 } else { metres };
    let ranges: Vec<Range> =
        ranges.iter().map(|range| Range { distance_m: number(range.distance_m), ..*range }).collect();
    way(&ranges, area)
}

/// A third anchor is made up where there are two.
pub(super) fn made_up(way: Way, ranges: &[Range], area: Option<Area>) -> Told {
    let &[first, second] = ranges else { return way(ranges, area) };
    let beside = Point::new(first.anchor.x_m + 1.0, first.anchor.y_m + 1.0);
    way(&[first, second, Range::new(beside, first.distance_m)], area)
}

/// Equations (5) to (8) without a look at what they divide by.
pub(super) fn unchecked(ranges: &[Range], area: Option<Area>) -> Told {
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

//! The closed form of Rajesh et al. 2024, equations (5) to (8), as it is printed.

use super::range::{check, count};
use super::{Layout, Point, Range, Refusal};

/// The position by equations (5) to (8), in the order in which they are printed: `ranges` are those of A, B and C.
///
/// The equations are right, but (8) divides by x_c − x_b, which may be 0 for anchors that stand well.
///
/// # Errors
/// [`Refusal`] if there are not three anchors at three places, if they are on one line,
/// so that (7) divides by 0, or if (8) does.
pub fn closed_form(ranges: &[Range]) -> Result<Point, Refusal> {
    check(ranges)?;
    if Layout::of(ranges).is_line(count(ranges)) {
        return Err(Refusal::Collinear);
    }
    let &[a, b, c] = ranges else { return Err(Refusal::Anchors(ranges.len())) };
    let (d_a, d_b, d_c) = (a.distance_m, b.distance_m, c.distance_m);
    let (a, b, c) = (a.anchor, b.anchor, c.anchor);
    // (5) and (6)
    let v_a =
        ((d_b * d_b - d_c * d_c) - (b.x_m * b.x_m - c.x_m * c.x_m) - (b.y_m * b.y_m - c.y_m * c.y_m)) / 2.0;
    let v_b =
        ((d_b * d_b - d_a * d_a) - (b.x_m * b.x_m - a.x_m * a.x_m) - (b.y_m * b.y_m - a.y_m * a.y_m)) / 2.0;
    // (7)
    let (one, other) = ((a.y_m - b.y_m) * (c.x_m - b.x_m), (c.y_m - b.y_m) * (a.x_m - b.x_m));
    let y_m = (v_b * (c.x_m - b.x_m) - v_a * (a.x_m - b.x_m)) / (one - other);
    // (8)
    let x_m = (v_a - y_m * (c.y_m - b.y_m)) / (c.x_m - b.x_m);
    let found = Point { x_m, y_m };
    if found.is_finite() { Ok(found) } else { Err(Refusal::Division) }
}

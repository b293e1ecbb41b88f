//! Linear least squares for any number of anchors: the circles' equations (2) to (4) of Rajesh et al. 2024 less their
//! mean, in the frame in which the anchors' places are uncorrelated. One Jacobi rotation finds it, so that no matrix is
//! inverted and none is squared.

use super::range::{check, count};
use super::{Point, Range, Refusal};

/// How anchors stand: their centre, the line along which they are spread most, and how much along and across it.
#[derive(Clone, Copy, PartialEq, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Layout {
    /// The mean of their places.
    pub centre: Point,
    /// The direction of the line, of length 1.
    pub along: Point,
    /// The singular values of their places about the centre, in metres: the greater and the lesser one.
    pub spread_m: [f64; 2],
}

impl Layout {
    /// That of the anchors of `ranges`, of which there is at least one.
    pub fn of(ranges: &[Range]) -> Self {
        let count = count(ranges);
        let places = || ranges.iter().map(|range| range.anchor);
        // Far from the origin sums of whole coordinates would be off by more than anchors are from their line.
        let first = places().next().unwrap_or(Point::new(0.0, 0.0));
        let (x, y) = places()
            .fold((0.0, 0.0), |(x, y), place| (x + (place.x_m - first.x_m), y + (place.y_m - first.y_m)));
        let centre = Point::new(first.x_m + x / count, first.y_m + y / count);
        let (mut xx, mut xy, mut yy) = (0.0, 0.0, 0.0);
        for place in places() {
            let (x, y) = (place.x_m - centre.x_m, place.y_m - centre.y_m);
            (xx, xy, yy) = (xx + x * x, xy + x * y, yy + y * y);
        }
        let (cosine, sine) = rotation(xx, xy, yy);
        let mut layout = Self { centre, along: Point::new(cosine, sine), spread_m: [0.0; 2] };
        let squares = places().fold([0.0, 0.0], |[along, across], place| {
            let (u, v) = layout.about_centre(place);
            [along + u * u, across + v * v]
        });
        layout.spread_m = squares.map(libm::sqrt);
        if layout.spread_m[0] < layout.spread_m[1] {
            layout.spread_m.reverse();
            layout.along = Point::new(-sine, cosine);
        }
        layout
    }

    /// Where `place` is, along and across the line.
    pub(super) fn about_centre(&self, place: Point) -> (f64, f64) {
        let (x, y) = (place.x_m - self.centre.x_m, place.y_m - self.centre.y_m);
        (self.along.x_m * x + self.along.y_m * y, self.along.x_m * y - self.along.y_m * x)
    }

    /// The place that is so far along and across the line.
    pub(super) fn place(&self, along_m: f64, across_m: f64) -> Point {
        Point {
            x_m: self.centre.x_m + self.along.x_m * along_m - self.along.y_m * across_m,
            y_m: self.centre.y_m + self.along.y_m * along_m + self.along.x_m * across_m,
        }
    }

    /// Whether so many anchors are on one line, to the precision of their coordinates.
    pub(super) fn is_line(&self, anchors: f64) -> bool {
        let scale_m = self.spread_m[0] + self.centre.x_m.abs() + self.centre.y_m.abs();
        self.spread_m[1] <= 4.0 * f64::EPSILON * libm::sqrt(anchors) * scale_m
    }

    /// How far along and across the line the linear equations say that the robot is. Across it, that is no number or
    /// not finite if the anchors are on the line.
    pub(super) fn solve(&self, ranges: &[Range]) -> (f64, f64) {
        let right = |range: &Range| {
            let (u, v) = self.about_centre(range.anchor);
            u * u + v * v - range.distance_m * range.distance_m
        };
        let mean = ranges.iter().map(right).sum::<f64>() / count(ranges);
        let (along, across) = ranges.iter().fold((0.0, 0.0), |(along, across), range| {
            let (u, v) = self.about_centre(range.anchor);
            let right = right(range) - mean;
            (along + u * right, across + v * right)
        });
        let [along_m, across_m] = self.spread_m;
        (along / (2.0 * along_m * along_m), across / (2.0 * across_m * across_m))
    }
}

/// The cosine and the sine of the angle by which a Jacobi rotation makes the matrix diagonal.
fn rotation(xx: f64, xy: f64, yy: f64) -> (f64, f64) {
    if xy == 0.0 {
        return (1.0, 0.0);
    }
    // The smaller of the two angles: its tangent is at most 1.
    let ratio = (xx - yy) / (2.0 * xy);
    let root = libm::sqrt(1.0 + ratio * ratio);
    let tangent = if ratio < 0.0 { 1.0 / (ratio - root) } else { 1.0 / (ratio + root) };
    let cosine = 1.0 / libm::sqrt(1.0 + tangent * tangent);
    (cosine, tangent * cosine)
}

/// The position by linear least squares. For three anchors it is that of the closed form.
///
/// # Errors
/// [`Refusal`] if the anchors are fewer than three, at fewer than three places or on one
/// line, or if a distance is no number from 0.
pub fn linear(ranges: &[Range]) -> Result<Point, Refusal> {
    check(ranges)?;
    let layout = Layout::of(ranges);
    if layout.is_line(count(ranges)) {
        return Err(Refusal::Collinear);
    }
    let (along_m, across_m) = layout.solve(ranges);
    Ok(layout.place(along_m, across_m))
}

//! Places in the plane, and symmetric matrices of two rows: all that two unknowns need.

/// A place, in metres.
#[derive(Clone, Copy, PartialEq, Default, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Point {
    /// Along +x.
    pub x_m: f64,
    /// Along +y.
    pub y_m: f64,
}

impl Point {
    /// The place with these coordinates, in metres.
    pub const fn new(x_m: f64, y_m: f64) -> Self {
        Self { x_m, y_m }
    }

    /// How far `other` is, in metres.
    pub fn distance_m(self, other: Self) -> f64 {
        libm::sqrt(self.squared_distance(other))
    }

    /// The square of that.
    pub(super) fn squared_distance(self, other: Self) -> f64 {
        let (x, y) = (self.x_m - other.x_m, self.y_m - other.y_m);
        x * x + y * y
    }

    /// Whether both coordinates are numbers.
    pub const fn is_finite(self) -> bool {
        self.x_m.is_finite() && self.y_m.is_finite()
    }
}

/// A rectangle, its rim included.
#[derive(Clone, Copy, PartialEq, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Area {
    least: Point,
    greatest: Point,
}

impl Area {
    /// The rectangle between two corners; `None` if a coordinate of `least` is not below that of `greatest`, or is no
    /// number.
    pub fn new(least: Point, greatest: Point) -> Option<Self> {
        let is_rectangle = least.x_m < greatest.x_m && least.y_m < greatest.y_m;
        (is_rectangle && least.is_finite() && greatest.is_finite()).then_some(Self { least, greatest })
    }

    /// The corner with the least coordinates.
    pub const fn least(self) -> Point {
        self.least
    }

    /// The corner with the greatest coordinates.
    pub const fn greatest(self) -> Point {
        self.greatest
    }

    /// The place of the rectangle that is nearest to `point`.
    pub fn nearest(self, point: Point) -> Point {
        let Self { least, greatest } = self;
        Point::new(point.x_m.clamp(least.x_m, greatest.x_m), point.y_m.clamp(least.y_m, greatest.y_m))
    }
}

/// A symmetric matrix of two rows: a covariance in m², or the normal matrix of a step.
#[derive(Clone, Copy, PartialEq, Default, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct SymmetricMatrix {
    /// Above, left.
    pub xx: f64,
    /// Beside the diagonal.
    pub xy: f64,
    /// Below, right.
    pub yy: f64,
}

impl SymmetricMatrix {
    /// This matrix with `weight` times the outer product of (x, y) added.
    pub(super) const fn plus(self, weight: f64, x: f64, y: f64) -> Self {
        Self { xx: self.xx + weight * x * x, xy: self.xy + weight * x * y, yy: self.yy + weight * y * y }
    }

    /// The sum of both.
    pub(super) const fn and(self, other: Self) -> Self {
        Self { xx: self.xx + other.xx, xy: self.xy + other.xy, yy: self.yy + other.yy }
    }

    /// This matrix with `damping` times its trace added to its diagonal.
    pub(super) const fn damped(self, damping: f64) -> Self {
        let more = damping * self.trace();
        Self { xx: self.xx + more, xy: self.xy, yy: self.yy + more }
    }

    /// The sum of the diagonal.
    pub const fn trace(self) -> f64 {
        self.xx + self.yy
    }

    const fn determinant(self) -> f64 {
        self.xx * self.yy - self.xy * self.xy
    }

    /// Whether it is positive definite to the precision of the numbers, if its diagonal is positive.
    pub(super) const fn is_regular(self) -> bool {
        self.determinant() > 4.0 * f64::EPSILON * self.xx * self.yy
    }

    /// Its inverse; `None` if it is singular to the precision of the numbers, or has a number that is not finite.
    pub(super) fn inverse(self) -> Option<Self> {
        let inverse = Self { xx: self.yy, xy: -self.xy, yy: self.xx }.times(1.0 / self.determinant());
        (self.is_regular() && inverse.is_finite()).then_some(inverse)
    }

    /// Its inverse times (x, y); `None` as for the inverse.
    pub(super) fn solve(self, (x, y): (f64, f64)) -> Option<(f64, f64)> {
        let factor = 1.0 / self.determinant();
        let (x, y) = ((self.yy * x - self.xy * y) * factor, (self.xx * y - self.xy * x) * factor);
        (self.is_regular() && (x.abs() + y.abs()).is_finite()).then_some((x, y))
    }

    /// Whether all of it are numbers, and not too large for their sum.
    pub(super) fn is_finite(self) -> bool {
        (self.trace().abs() + self.xy.abs()).is_finite()
    }

    /// This matrix times `factor`.
    pub(super) const fn times(self, factor: f64) -> Self {
        Self { xx: self.xx * factor, xy: self.xy * factor, yy: self.yy * factor }
    }
}

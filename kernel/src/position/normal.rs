//! The normal equations of a position: how well it fits, and which step fits better.

use super::range::LEAST_M;
use super::{Point, Range, Residual, Symmetric};

/// At one position: the sum of the squared residuals, the normal matrix JᵀJ, and Jᵀr, which leads downhill. Residuals in decibels
/// are in units of [`Signal::decibels`](super::Signal::decibels).
#[derive(Clone, Copy, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub(super) struct Normal {
    pub(super) cost: f64,
    pub(super) matrix: Symmetric,
    pub(super) curvature: Symmetric,
    pub(super) downhill: (f64, f64),
}

impl Normal {
    /// Those of `at`.
    #[inline]
    pub(super) fn at(ranges: &[Range], residual: Residual, at: Point) -> Self {
        match residual {
            Residual::Metres => Self::sum(ranges, at, |range, squared_m| {
                let distance_m = libm::sqrt(squared_m);
                let residual = range.distance_m - distance_m;
                let factor = 1.0 / distance_m;
                Term { residual, factor, round: -residual * factor, outward: residual * factor }
            }),
            Residual::Decibels => Self::sum(ranges, at, |range, squared_m| {
                let times = range.distance_m * range.distance_m / squared_m;
                let residual = 0.5 * libm::log(times);
                let factor = 1.0 / squared_m;
                Term { residual, factor, round: -residual * factor, outward: 2.0 * residual }
            }),
        }
    }

    #[inline]
    fn sum(ranges: &[Range], at: Point, term: impl Fn(&Range, f64) -> Term) -> Self {
        let mut normal = Self {
            cost: 0.0,
            matrix: Symmetric::default(),
            curvature: Symmetric::default(),
            downhill: (0.0, 0.0),
        };
        for range in ranges {
            let (x, y) = (at.x_m - range.anchor.x_m, at.y_m - range.anchor.y_m);
            let Term { residual, factor, round, outward } =
                term(range, (x * x + y * y).max(LEAST_M * LEAST_M));
            let (x, y) = (x * factor, y * factor);
            normal.cost += residual * residual;
            normal.matrix = normal.matrix.plus(1.0, x, y);
            normal.curvature = normal.curvature.plus(outward, x, y);
            normal.curvature.xx += round;
            normal.curvature.yy += round;
            normal.downhill = (normal.downhill.0 + x * residual, normal.downhill.1 + y * residual);
        }
        normal
    }

    /// The inverse of the matrix by which a step goes downhill. It is that of all second derivatives where the sum of the squares is
    /// convex, so that the last steps are few; elsewhere it is Gauss and Newton's JᵀJ, which always leads downhill. `damping`
    /// times its trace is added to its diagonal; where one direction is not told, so much that the step stays finite.
    #[inline]
    pub(super) fn inverse(&self, damping: f64) -> Symmetric {
        let whole = self.matrix.and(self.curvature);
        if whole.xx > 0.0
            && let Some(inverse) = whole.damped(damping).inverse()
            && (damping == 0.0 || whole.inverse().is_some())
        {
            return inverse;
        }
        let inverse = self.matrix.damped(damping).inverse();
        inverse.or_else(|| self.matrix.damped(LEAST_DAMPING).inverse()).unwrap_or_default()
    }

    /// About how small the sum becomes with the next step.
    #[inline]
    pub(super) fn promise(&self) -> f64 {
        let (inverse, (x, y)) = (self.matrix.inverse().unwrap_or_default(), self.downhill);
        self.cost - (inverse.xx * x * x + 2.0 * inverse.xy * x * y + inverse.yy * y * y)
    }
}

/// The damping of a matrix that has no inverse.
const LEAST_DAMPING: f64 = 1e-9;

/// What a range adds. The second derivatives of its squared residual, halved, are the outer product of the gradient times 1 +
/// `outward`, plus `round` times the identity.
struct Term {
    residual: f64,
    /// The length of the gradient over the distance.
    factor: f64,
    round: f64,
    outward: f64,
}

/// JᵀJ at `at`, each range weighed by `weight` of the square of its distance, with directions of length 1.
pub(super) fn information(
    anchors: impl Iterator<Item = Point>,
    at: Point,
    weight: impl Fn(f64) -> f64,
) -> Symmetric {
    anchors.fold(Symmetric::default(), |matrix, anchor| {
        let (x, y) = (at.x_m - anchor.x_m, at.y_m - anchor.y_m);
        let squared_m = (x * x + y * y).max(LEAST_M * LEAST_M);
        matrix.plus(weight(squared_m) / squared_m, x, y)
    })
}

//! The normal equations of a position: how well it fits, and which step fits better.

use super::range::LEAST_M;
use super::{Point, Range, Residual, SymmetricMatrix};

/// At one position: the sum of the squared residuals, the normal matrix JᵀJ, half of the sum's second derivatives, and
/// Jᵀr, which leads downhill. Residuals in decibels are in units of [`Signal::decibels`](super::Signal::decibels).
#[derive(Clone, Copy, Debug)]
pub(super) struct Normal {
    pub(super) cost: f64,
    pub(super) matrix: SymmetricMatrix,
    pub(super) curvature: SymmetricMatrix,
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
                let bend = residual * factor;
                Term { residual, factor, round: -bend, outward: bend }
            }),
            Residual::Decibels => Self::sum(ranges, at, |range, squared_m| {
                let factor = 1.0 / squared_m;
                let residual = 0.5 * libm::log(range.distance_m * range.distance_m * factor);
                Term { residual, factor, round: -residual * factor, outward: 2.0 * residual }
            }),
        }
    }

    #[inline]
    fn sum(ranges: &[Range], at: Point, term: impl Fn(&Range, f64) -> Term) -> Self {
        let (mut cost, mut downhill, mut round) = (0.0, (0.0, 0.0), 0.0);
        let (mut matrix, mut curvature) = (SymmetricMatrix::default(), SymmetricMatrix::default());
        for range in ranges {
            let (x, y) = (at.x_m - range.anchor.x_m, at.y_m - range.anchor.y_m);
            let term = term(range, not_less(x * x + y * y, LEAST_M * LEAST_M));
            let (x, y) = (x * term.factor, y * term.factor);
            let outer = SymmetricMatrix { xx: x * x, xy: x * y, yy: y * y };
            cost += term.residual * term.residual;
            matrix = matrix.and(outer);
            curvature = curvature.and(outer.times(1.0 + term.outward));
            round += term.round;
            downhill = (downhill.0 + x * term.residual, downhill.1 + y * term.residual);
        }
        curvature.xx += round;
        curvature.yy += round;
        Self { cost, matrix, curvature, downhill }
    }

    /// The step downhill: along x and along y. It is Newton's, by the second derivatives, where the sum of the squares
    /// is convex, so that the last steps are few; elsewhere it is Gauss and Newton's, by JᵀJ, which always leads
    /// downhill. `damping` times its trace is added to the diagonal; where one direction is not told, so much that the
    /// step stays finite.
    #[inline]
    pub(super) fn step(&self, damping: f64) -> (f64, f64) {
        let by = |matrix: SymmetricMatrix, damping| matrix.damped(damping).solve(self.downhill);
        let is_convex = self.curvature.xx > 0.0 && (damping == 0.0 || self.curvature.is_regular());
        let newton = if is_convex { by(self.curvature, damping) } else { None };
        let step = newton.or_else(|| by(self.matrix, damping));
        step.or_else(|| by(self.matrix, LEAST_DAMPING)).unwrap_or_default()
    }

    /// The step along x alone, as for a step in both directions, and that along y alone.
    pub(super) fn steps_alone(&self, damping: f64) -> (f64, f64) {
        let Self { matrix, curvature, downhill: (x, y), .. } = *self;
        (along(x, curvature.xx, matrix.xx, damping), along(y, curvature.yy, matrix.yy, damping))
    }

    /// About how small the sum becomes with the next step.
    #[inline]
    pub(super) fn promise(&self) -> f64 {
        let (x, y) = self.matrix.solve(self.downhill).unwrap_or_default();
        self.cost - (x * self.downhill.0 + y * self.downhill.1)
    }
}

/// The step in one direction: Newton's where the sum is convex along it, and elsewhere Gauss and Newton's.
fn along(downhill: f64, curvature: f64, square: f64, damping: f64) -> f64 {
    let by = if curvature > 0.0 { curvature } else { square };
    if by > 0.0 { downhill / (by * (1.0 + damping)) } else { 0.0 }
}

/// The greater one of two numbers. That of `f64` also looks for what is no number.
#[inline]
fn not_less(number: f64, least: f64) -> f64 {
    if number < least { least } else { number }
}

/// The damping of a matrix that has no inverse.
const LEAST_DAMPING: f64 = 1e-9;

/// The contribution of a range. The second derivatives of its squared residual, halved, are the outer product of the
/// gradient times 1 + `outward`, plus `round` times the identity.
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
) -> SymmetricMatrix {
    anchors.fold(SymmetricMatrix::default(), |matrix, anchor| {
        let (x, y) = (at.x_m - anchor.x_m, at.y_m - anchor.y_m);
        let squared_m = not_less(x * x + y * y, LEAST_M * LEAST_M);
        matrix.plus(weight(squared_m) / squared_m, x, y)
    })
}

#[cfg(test)]
mod tests {
    use super::along;

    #[test]
    fn a_step_in_one_direction_is_newton_s_where_the_sum_is_convex_and_none_where_nothing_tells_the_direction()
     {
        let steps =
            |curvature, square, metres: f64| (along(6.0, curvature, square, 0.5) - metres).abs() < 1e-12;
        assert!(steps(2.0, 4.0, 2.0));
        for curvature in [0.0, -1.0] {
            assert!(steps(curvature, 4.0, 1.0) && steps(curvature, 0.0, 0.0), "curvature {curvature}");
        }
    }
}

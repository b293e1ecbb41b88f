//! The analyses of positions, by nalgebra. The kernel says the same of two unknowns without matrices, and is compared
//! with this.

use nalgebra::{DMatrix, Matrix2, Vector2};
use schemars::JsonSchema;
use serde::Serialize;
use tautline_kernel::position::{Point, Signal, SymmetricMatrix};

use crate::stats::decimals;

/// Numbers are told to a hundredth of a millimetre.
pub(super) const PARTS: f64 = 1e5;

/// The least and the greatest of some numbers.
pub(super) fn span(numbers: impl Iterator<Item = f64>) -> [f64; 2] {
    let far = [f64::INFINITY, f64::NEG_INFINITY];
    numbers.fold(far, |[least, most], number| [least.min(number), most.max(number)])
}

/// An ellipse about a place.
#[derive(Clone, Copy, PartialEq, Debug, JsonSchema, Serialize)]
pub struct Ellipse {
    /// Its middle, x and y in metres.
    pub middle_m: [f64; 2],
    /// Its half axes in metres, the longer one first.
    pub half_axes_m: [f64; 2],
    /// The direction of the longer one, in degrees from +x towards +y.
    pub degrees: f64,
}

impl Ellipse {
    /// This ellipse, rounded to a hundredth of a millimetre and of a degree.
    #[must_use]
    pub(super) fn rounded(self) -> Self {
        let metres = |pair: [f64; 2]| pair.map(|metres| decimals(metres, PARTS));
        Self {
            middle_m: metres(self.middle_m),
            half_axes_m: metres(self.half_axes_m),
            degrees: decimals(self.degrees, 1e2),
        }
    }
}

/// The 95 % quantile of χ² with two degrees of freedom.
const WITHIN: f64 = 5.991_464_547_107_979;

/// The ellipse in which 95 % of normally distributed places with this covariance lie.
pub fn ellipse(middle: Point, covariance: &Matrix2<f64>) -> Ellipse {
    let parts = covariance.symmetric_eigen();
    let (long, short) = if parts.eigenvalues[0] < parts.eigenvalues[1] { (1, 0) } else { (0, 1) };
    let half = |axis: usize| libm::sqrt(WITHIN * parts.eigenvalues[axis].max(0.0));
    let along = parts.eigenvectors.column(long);
    // An axis has two directions: the one from −90° to 90° is told.
    let turned = if along[0] < 0.0 { -1.0 } else { 1.0 };
    Ellipse {
        middle_m: [middle.x_m, middle.y_m],
        half_axes_m: [half(long), half(short)],
        degrees: libm::atan2(turned * along[1], turned * along[0]).to_degrees(),
    }
}

/// A covariance of the kernel as a matrix.
pub const fn matrix(covariance: &SymmetricMatrix) -> Matrix2<f64> {
    Matrix2::new(covariance.xx, covariance.xy, covariance.xy, covariance.yy)
}

/// The mean and the covariance of places; `None` if there are fewer than two.
pub fn scatter(places: &[Point]) -> Option<(Point, Matrix2<f64>)> {
    let count = f64::from(u32::try_from(places.len()).ok().filter(|&count| count > 1)?);
    let vectors = || places.iter().map(|place| Vector2::new(place.x_m, place.y_m));
    let mean = vectors().sum::<Vector2<f64>>() / count;
    let squares = vectors().map(|place| (place - mean) * (place - mean).transpose()).sum::<Matrix2<f64>>();
    Some((Point::new(mean.x, mean.y), squares / (count - 1.0)))
}

/// The singular values of the anchors' places about their mean, in metres, the greater one first.
pub fn spread_m(anchors: &[Point]) -> [f64; 2] {
    if anchors.len() < 2 {
        return [0.0; 2];
    }
    let coordinates = |place: Point| [place.x_m, place.y_m];
    let places = DMatrix::from_fn(anchors.len(), 2, |row, column| coordinates(anchors[row])[column]);
    let centred = DMatrix::from_fn(anchors.len(), 2, |row, column| {
        places[(row, column)] - places.column(column).mean()
    });
    let values = centred.singular_values();
    [values[0], values[1]]
}

/// How exact the levels of anchors can tell a place, at best.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Bound {
    /// The Cramér–Rao bound: the smallest covariance of an unbiased position, in m².
    pub covariance: Matrix2<f64>,
    /// The dilution of precision: the root mean square error over that of the distances, if all are alike.
    pub dilution: f64,
}

/// The bound of a robot at `at`; `None` if the anchors tell nothing about one direction.
pub fn bound(anchors: &[Point], at: Point, signal: &Signal) -> Option<Bound> {
    let (mut directions, mut information) = (Matrix2::zeros(), Matrix2::zeros());
    for &anchor in anchors {
        let to = Vector2::new(at.x_m - anchor.x_m, at.y_m - anchor.y_m);
        let direction = to.normalize();
        let gradient = direction / to.norm();
        directions += direction * direction.transpose();
        information += gradient * gradient.transpose();
    }
    let dilution = libm::sqrt(directions.try_inverse()?.trace());
    // The gradients are those of a relative error of 1: without noise the bound is 0.
    let covariance = information.try_inverse()? * signal.relative_error().powi(2);
    Some(Bound { covariance, dilution }).filter(|bound| bound.dilution.is_finite())
}

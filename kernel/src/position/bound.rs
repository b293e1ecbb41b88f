//! How far a position can be trusted: the Cramér–Rao bound, the covariance of an
//! estimate, and the dilution of precision.

use super::normal::information;
use super::{Point, Range, Residual, Signal, SymmetricMatrix};

/// How exact a position is.
#[derive(Clone, Copy, PartialEq, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Precision {
    /// The covariance of the position, in m².
    pub covariance: SymmetricMatrix,
    /// The dilution of precision: the root mean square error over that of the distances, if all are alike.
    pub dilution: f64,
}

impl Precision {
    /// The root mean square error that the covariance stands for, in metres.
    pub fn rms_m(&self) -> f64 {
        libm::sqrt(self.covariance.trace())
    }

    /// This, unless it is too large for a number: then one direction is not told.
    fn told(self) -> Option<Self> {
        self.covariance.is_finite().then_some(self)
    }
}

/// The Cramér–Rao bound of a robot at `at`: no unbiased way to find it from the levels of these anchors has a smaller
/// covariance. `None` where they tell nothing about one direction.
///
/// The bound looks at the surroundings of `at` alone: it does not see that a mirror image fits as well.
pub fn bound(anchors: impl Iterator<Item = Point> + Clone, at: Point, signal: &Signal) -> Option<Precision> {
    let error = signal.relative_error();
    let covariance =
        information(anchors.clone(), at, |squared_m| 1.0 / squared_m).inverse()?.times(error * error);
    let dilution = libm::sqrt(information(anchors, at, |_| 1.0).inverse()?.trace());
    Precision { covariance, dilution }.told()
}

/// The three of `anchors` by which a robot at `at` is told best: those with the least bound, since errors grow with
/// distances. The dilution of precision alone counts all distances alike. `None` if no three tell both directions.
///
/// Rajesh et al. 2024, 4, “selects the best three anchors”; the measure is ours. All triples are compared.
pub fn best_three(anchors: &[Point], at: Point) -> Option<[Point; 3]> {
    let mut best: Option<(f64, [Point; 3])> = None;
    for (third, &c) in anchors.iter().enumerate() {
        for (second, &b) in anchors.iter().enumerate().take(third) {
            for &a in anchors.iter().take(second) {
                let three = [a, b, c];
                let information = information(three.into_iter(), at, |squared_m| 1.0 / squared_m);
                let Some(covariance) = information.inverse() else { continue };
                if best.is_none_or(|(least, _)| covariance.trace() < least) {
                    best = Some((covariance.trace(), three));
                }
            }
        }
    }
    best.map(|(_, three)| three)
}

/// The precision of the minimum of the squared residuals, if it is at `at`. Distances are wrong in proportion, so that
/// those in metres, all weighed alike, are less exact than the bound.
pub(super) fn precision(
    ranges: &[Range],
    residual: Residual,
    signal: &Signal,
    at: Point,
) -> Option<Precision> {
    let anchors = ranges.iter().map(|range| range.anchor);
    match residual {
        Residual::Decibels => bound(anchors, at, signal),
        Residual::Metres => {
            let inverse = information(anchors.clone(), at, |_| 1.0).inverse()?;
            let error = signal.relative_error();
            // The outer products of what each distance moves, so that no rounding makes a variance negative.
            let covariance = anchors.fold(SymmetricMatrix::default(), |sum, anchor| {
                let (x, y) = (at.x_m - anchor.x_m, at.y_m - anchor.y_m);
                sum.plus(error * error, inverse.xx * x + inverse.xy * y, inverse.xy * x + inverse.yy * y)
            });
            Precision { covariance, dilution: libm::sqrt(inverse.trace()) }.told()
        }
    }
}

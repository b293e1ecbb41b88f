//! A belief after wheels and a fix (POSITION-7): here the weighted mean and its covariance are written down for two
//! coordinates, by the inverse of one matrix.

use tautline_kernel::choice::Oracle;
use tautline_kernel::position::{Belief, Correction, Gate, Odometry, Point, SymmetricMatrix};

use crate::engine::{Outcome, assume, require};

/// How a belief takes a fix with its covariance.
pub(super) type Takes = fn(&mut Belief, Point, SymmetricMatrix) -> Correction;

/// As the kernel does it.
pub(super) fn fused(belief: &mut Belief, fix: Point, covariance: SymmetricMatrix) -> Correction {
    belief.corrected(fix, covariance, Gate::Closed)
}

/// Outliers count, too.
pub(super) fn ungated(belief: &mut Belief, fix: Point, covariance: SymmetricMatrix) -> Correction {
    belief.corrected(fix, covariance, Gate::Open)
}

/// A fix is believed without its covariance.
pub(super) fn believed(belief: &mut Belief, fix: Point, _: SymmetricMatrix) -> Correction {
    *belief = Belief::known(fix, belief.heading_rad());
    Correction::Taken
}

/// No fix counts.
pub(super) fn by_wheels_alone(_: &mut Belief, _: Point, _: SymmetricMatrix) -> Correction {
    Correction::Nothing
}

/// Covariances of fixes, in hundredths of a square metre.
const FIXES: [(f64, f64, f64); 3] = [(1.0, 0.0, 1.0), (4.0, 1.0, 2.0), (0.5, -0.4, 9.0)];

/// The bound of [`is_mean`], in words.
pub(super) fn drives() -> String {
    "two drives with a turn between them by eighths of a circle, two kinds of wheels, fixes within \
     0.6 m on a lattice of 0.2 m, 3 covariances"
        .to_owned()
}

/// The 99.9 % quantile of χ² with two degrees of freedom: 2 ln 1000.
const OUTLIER: f64 = 13.815_510_557_964_274;

/// POSITION-7: a belief before a fix and after it.
///
/// # Errors
/// [`Stop`](crate::engine::Stop) if the clause is broken.
pub(super) fn is_mean(takes: &Takes, oracle: &mut dyn Oracle) -> Outcome {
    let odometry = if oracle.pick(2) == 0 { Odometry::USUAL } else { Odometry::EXACT };
    let wheels = Odometry::new(0.1, 5.0).filter(|_| odometry == Odometry::EXACT).unwrap_or(odometry);
    let mut belief = Belief::known(Point::new(0.0, 0.0), 0.25);
    belief.driven(f64::from(1 + oracle.pick(2)), &wheels);
    belief.turned(f64::from(oracle.pick(8)) * core::f64::consts::FRAC_PI_4, &wheels);
    belief.driven(f64::from(1 + oracle.pick(2)), &wheels);
    let (xx, xy, yy) = FIXES.get(oracle.pick(FIXES.len() as u32) as usize).copied().unwrap_or_default();
    let covariance = SymmetricMatrix { xx: xx / 100.0, xy: xy / 100.0, yy: yy / 100.0 };
    let mut off = || 0.2 * (f64::from(oracle.pick(7)) - 3.0);
    let (x, y) = (off(), off());
    let fix = Point::new(belief.at().x_m + x, belief.at().y_m + y);
    let before = belief;
    takes(&mut belief, fix, covariance);

    let prior = before.covariance();
    let sum = [prior.xx + covariance.xx, prior.xy + covariance.xy, prior.yy + covariance.yy];
    let determinant = sum[0] * sum[2] - sum[1] * sum[1];
    let inverse =
        |a: f64, b: f64| ((sum[2] * a - sum[1] * b) / determinant, (sum[0] * b - sum[1] * a) / determinant);
    let weighed = inverse(x, y);
    let surprise = x * weighed.0 + y * weighed.1;
    assume((surprise - OUTLIER).abs() > 1e-6)?;
    if surprise > OUTLIER {
        require(belief == before, "an outlier changes nothing")?;
        return Ok("an outlier");
    }
    let mean = (
        before.at().x_m + prior.xx * weighed.0 + prior.xy * weighed.1,
        before.at().y_m + prior.xy * weighed.0 + prior.yy * weighed.1,
    );
    let is_near = |one: f64, other: f64| (one - other).abs() < 1e-9;
    let at = belief.at();
    require(is_near(at.x_m, mean.0) && is_near(at.y_m, mean.1), "it is the mean, weighed by covariances")?;
    // P (P + R)⁻¹ R
    let of_x = inverse(covariance.xx, covariance.xy);
    let of_y = inverse(covariance.xy, covariance.yy);
    let both = [
        prior.xx * of_x.0 + prior.xy * of_x.1,
        prior.xx * of_y.0 + prior.xy * of_y.1,
        prior.xy * of_y.0 + prior.yy * of_y.1,
    ];
    let after = belief.covariance();
    let is_both =
        [after.xx, after.xy, after.yy].into_iter().zip(both).all(|(one, other)| is_near(one, other));
    require(is_both, "its covariance is that of both together")?;
    Ok("a fix that counts")
}

//! The kernel's positions against nalgebra's matrices, which the analyses of this crate are made of.

use nalgebra::{DMatrix, DVector, Matrix2};
use proptest::prelude::*;
use tautline_field::position::analysis;
use tautline_kernel::net::Propagation;
use tautline_kernel::position::{Fix, Layout, Point, Range, Residual, Signal, bound, linear, locate};

fn signal() -> Signal {
    Signal::new(Propagation::new(2.7).expect("an exponent"), 1.5).expect("a noise")
}

/// Anchors, and distances that need not fit each other.
fn ranges() -> impl Strategy<Value = Vec<Range>> {
    let range = (-30.0..30.0_f64, -30.0..30.0_f64, 0.5..40.0_f64);
    prop::collection::vec(range, 3..9)
        .prop_map(|all| all.into_iter().map(|(x, y, far)| Range::new(Point::new(x, y), far)).collect())
}

fn anchors(ranges: &[Range]) -> Vec<Point> {
    ranges.iter().map(|range| range.anchor).collect()
}

fn is_near(one: f64, other: f64, part: f64) -> bool {
    (one - other).abs() <= part * one.abs().max(other.abs()).max(1.0)
}

/// Whether two inverses are one, as far as they can be told apart: the worse the condition, the more of what rounding
/// has lost comes out in either. Anchors nearly in a line, one of them half a metre away, have 8.8 million; exact
/// arithmetic finds ours off by 3e-10 then, and that of matrices by 7e-10.
fn are_near(one: &Matrix2<f64>, other: &Matrix2<f64>) -> bool {
    let condition = other.norm_squared() / other.determinant().abs();
    (one - other).norm() <= (1e-15 * condition).max(1e-9) * one.norm().max(1e-12)
}

proptest! {
    #[test]
    fn one_jacobi_rotation_gives_the_singular_values(ranges in ranges()) {
        let ours = Layout::of(&ranges).spread_m;
        let theirs = analysis::spread_m(&anchors(&ranges));
        let is_alike = ours.iter().zip(theirs).all(|(&ours, theirs)| is_near(ours, theirs, 1e-13));
        prop_assert!(is_alike, "{:?} {:?}", ours, theirs);
    }

    #[test]
    fn linear_least_squares_are_those_of_a_singular_value_decomposition(ranges in ranges()) {
        // The equations less their mean have the same solution as those less the first only without error: so the mean
        // it is.
        let count = f64::from(u32::try_from(ranges.len()).expect("a few"));
        let mean = |of: &dyn Fn(&Range) -> f64| ranges.iter().map(of).sum::<f64>() / count;
        let right = |range: &Range| {
            range.anchor.x_m.powi(2) + range.anchor.y_m.powi(2) - range.distance_m.powi(2)
        };
        let (x, y, of) = (mean(&|range| range.anchor.x_m), mean(&|range| range.anchor.y_m), mean(&right));
        let matrix = DMatrix::from_fn(ranges.len(), 2, |row, column| {
            2.0 * if column == 0 { ranges[row].anchor.x_m - x } else { ranges[row].anchor.y_m - y }
        });
        let vector = DVector::from_fn(ranges.len(), |row, _| right(&ranges[row]) - of);
        let [_, across_m] = Layout::of(&ranges).spread_m;
        prop_assume!(across_m > 0.1);
        let theirs = matrix.svd(true, true).solve(&vector, 1e-14).expect("a solution");
        let ours = linear(&ranges).expect("a position");
        let is_alike = is_near(ours.x_m, theirs[0], 1e-8) && is_near(ours.y_m, theirs[1], 1e-8);
        prop_assert!(is_alike, "{:?} {:?}", ours, theirs);
    }

    #[test]
    fn the_bound_and_the_dilution_are_those_of_matrices(
        ranges in ranges(), x in -30.0..30.0_f64, y in -30.0..30.0_f64,
    ) {
        let (anchors, at) = (anchors(&ranges), Point::new(x, y));
        prop_assume!(anchors.iter().all(|anchor| anchor.distance_m(at) > 1e-3));
        let ours = bound(anchors.iter().copied(), at, &signal());
        let theirs = analysis::bound(&anchors, at, &signal());
        if let (Some(ours), Some(theirs)) = (ours, theirs) {
            prop_assume!(ours.dilution < 1e3);
            prop_assert!(are_near(&analysis::matrix(&ours.covariance), &theirs.covariance));
            prop_assert!(is_near(ours.dilution, theirs.dilution, 1e-9));
        }
    }

    #[test]
    fn the_covariance_of_an_estimate_is_that_of_matrices(ranges in ranges(), is_in_metres in any::<bool>()) {
        let residual = if is_in_metres { Residual::Metres } else { Residual::Decibels };
        let fix = locate(&ranges, residual, &signal(), None).expect("a fix");
        let (Fix::One(estimate) | Fix::Two(estimate, _)) = fix;
        prop_assume!(estimate.precision.is_some_and(|precision| precision.dilution < 1e3));
        let precision = estimate.precision.expect("it was looked at");
        let anchors = anchors(&ranges);
        prop_assume!(anchors.iter().all(|anchor| anchor.distance_m(estimate.at) > 1e-3));
        let row = |anchor: &Point| {
            let far = estimate.at.distance_m(*anchor);
            [(estimate.at.x_m - anchor.x_m) / far, (estimate.at.y_m - anchor.y_m) / far]
        };
        let jacobian = DMatrix::from_fn(anchors.len(), 2, |number, column| row(&anchors[number])[column]);
        let error = signal().relative_error();
        let noise = DMatrix::from_diagonal(&DVector::from_fn(anchors.len(), |number, _| {
            (error * estimate.at.distance_m(anchors[number])).powi(2)
        }));
        let covariance = match residual {
            Residual::Metres => {
                let inverse = (jacobian.transpose() * &jacobian).try_inverse().expect("regular");
                &inverse * jacobian.transpose() * noise * jacobian * &inverse
            }
            Residual::Decibels => {
                let weights = noise.try_inverse().expect("regular");
                (jacobian.transpose() * weights * jacobian).try_inverse().expect("regular")
            }
        };
        let theirs = Matrix2::new(covariance[(0, 0)], covariance[(0, 1)], covariance[(1, 0)], covariance[(1, 1)]);
        prop_assert!(are_near(&analysis::matrix(&precision.covariance), &theirs));
    }
}

#[test]
fn an_error_ellipse_has_the_axes_of_its_covariance() {
    let turned = |degrees: f64, long: f64, short: f64| {
        let (sine, cosine) = degrees.to_radians().sin_cos();
        let turn = Matrix2::new(cosine, -sine, sine, cosine);
        turn * Matrix2::new(long * long, 0.0, 0.0, short * short) * turn.transpose()
    };
    for degrees in [-80.0, -30.0, 0.0, 45.0, 89.0] {
        let ellipse = analysis::ellipse(Point::new(1.0, 2.0), &turned(degrees, 3.0, 0.5));
        let [long, short] = ellipse.half_axes_m.map(|half_m| half_m / 5.991_464_547_f64.sqrt());
        assert!(
            (ellipse.degrees - degrees).abs() < 1e-9
                && (long - 3.0).abs() < 1e-9
                && (short - 0.5).abs() < 1e-9,
            "{ellipse:?}"
        );
    }
    let (mean, covariance) =
        analysis::scatter(&[Point::new(0.0, 1.0), Point::new(2.0, 1.0)]).expect("two places");
    assert_eq!((mean, covariance), (Point::new(1.0, 1.0), Matrix2::new(2.0, 0.0, 0.0, 0.0)));
    assert_eq!(analysis::scatter(&[mean]), None);
}

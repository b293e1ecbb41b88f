//! The kernel's belief against nalgebra's matrices, and its consistency: by how much errors differ from what the
//! covariance says (NEES, the normalised estimation error squared).

use nalgebra::{Matrix2, Matrix2x3, Matrix3, Vector2, Vector3};
use proptest::collection::vec;
use proptest::prelude::*;
use tautline_kernel::choice::Oracle;
use tautline_kernel::net::Propagation;
use tautline_kernel::position::{Belief, Correction, Gate, Odometry, Point, Range, Signal, SymmetricMatrix};
use tautline_proofs::engine::SeededOracle;

/// A belief in matrices.
#[derive(Clone, Debug)]
struct Filter {
    state: Vector3<f64>,
    covariance: Matrix3<f64>,
}

impl Filter {
    fn of(belief: &Belief) -> Self {
        let SymmetricMatrix { xx, xy, yy } = belief.covariance();
        let [xh, yh, hh] = belief.heading_covariance();
        Self {
            state: Vector3::new(belief.at().x_m, belief.at().y_m, belief.heading_rad()),
            covariance: Matrix3::new(xx, xy, xh, xy, yy, yh, xh, yh, hh),
        }
    }

    fn turned(&mut self, turn: f64, odometry: &Odometry) {
        self.state[2] += turn;
        self.covariance[(2, 2)] += odometry.turn_rad().powi(2);
    }

    fn driven(&mut self, way: f64, odometry: &Odometry) {
        let (sine, cosine) = self.state[2].sin_cos();
        let step = Matrix3::new(1.0, 0.0, -way * sine, 0.0, 1.0, way * cosine, 0.0, 0.0, 1.0);
        let slip = Vector3::new(cosine, sine, 0.0) * odometry.share() * way;
        self.state += Vector3::new(cosine, sine, 0.0) * way;
        self.covariance = step * self.covariance * step.transpose() + slip * slip.transpose();
    }

    fn corrected(&mut self, fix: Point, noise: Matrix2<f64>) {
        let seen = Matrix2x3::new(1.0, 0.0, 0.0, 0.0, 1.0, 0.0);
        let off = Vector2::new(fix.x_m, fix.y_m) - seen * self.state;
        let whole = seen * self.covariance * seen.transpose() + noise;
        let gain = self.covariance * seen.transpose() * whole.try_inverse().expect("it is regular");
        self.state += gain * off;
        self.covariance = (Matrix3::identity() - gain * seen) * self.covariance;
    }

    fn is_near(&self, other: &Self) -> bool {
        let mut off = self.state - other.state;
        off[2] = (off[2] + std::f64::consts::PI).rem_euclid(std::f64::consts::TAU) - std::f64::consts::PI;
        off.norm() < 1e-9 && (self.covariance - other.covariance).norm() < 1e-9
    }
}

proptest! {
    #[test]
    fn a_belief_is_that_of_a_kalman_filter_in_matrices(
        moves in vec((-3.0..3.0_f64, 0.0..2.0_f64, -0.5..0.5_f64, -0.5..0.5_f64, 0.01..1.0_f64), 1..30)
    ) {
        let odometry = Odometry::new(0.05, 3.0).expect("errors");
        let mut belief = Belief::known(Point::new(1.0, 1.0), 0.5);
        let mut filter = Filter::of(&belief);
        for (turn, way, x, y, variance) in moves {
            belief.turned(turn, &odometry);
            belief.driven(way, &odometry);
            filter.turned(turn, &odometry);
            filter.driven(way, &odometry);
            let fix = Point::new(belief.at().x_m + x, belief.at().y_m + y);
            let noise = SymmetricMatrix { xx: variance, xy: 0.3 * variance, yy: 0.5 * variance };
            let taken = belief.corrected(fix, noise, Gate::Open);
            prop_assert_eq!(taken, Correction::Taken);
            filter.corrected(fix, Matrix2::new(noise.xx, noise.xy, noise.xy, noise.yy));
            prop_assert!(filter.is_near(&Filter::of(&belief)), "{:?} {:?}", belief, filter);
            let eigenvalues = Filter::of(&belief).covariance.symmetric_eigenvalues();
            prop_assert!(eigenvalues.min() > -1e-12, "{:?}", eigenvalues);
        }
    }
}

const ANCHORS: [Point; 3] = [Point::new(0.0, 0.0), Point::new(12.0, 0.0), Point::new(0.0, 14.0)];

/// A number near to a normal one: the sum of twelve uniform numbers, whose variance is 1.
fn normal(oracle: &mut SeededOracle) -> f64 {
    (0..12).map(|_| f64::from(oracle.pick(1 << 20)) / f64::from(1 << 20) - 0.5).sum()
}

/// Moves of one run: enough that fixes and wheels have come to their balance.
const MOVES: u32 = 40;

/// The mean NEES of so many runs of one robot: three unknowns, so that it is to be 3. It hears so many beacons of each
/// anchor at each stop, with noise of 1 dB.
fn mean_nees(runs: u32, beacons: u32) -> f64 {
    let signal = |deviation_db| Signal::new(Propagation::FREE_SPACE, deviation_db).expect("a noise");
    let (one, averaged) = (signal(1.0), signal(1.0 / f64::from(beacons).sqrt()));
    let odometry = Odometry::USUAL;
    let run = |number: u32| {
        let mut oracle = SeededOracle::new(7, number.into());
        let start = Point::new(6.0, 7.0);
        let (mut at, mut heading) = (start, 0.0);
        let mut belief = Belief::known(start, heading);
        for _ in 0..MOVES {
            let aim = Point::new(f64::from(oracle.pick(11)) + 0.5, f64::from(oracle.pick(13)) + 0.5);
            let (turn, way) = belief.towards(aim);
            let way = way.min(1.0);
            heading += turn + odometry.turn_rad() * normal(&mut oracle);
            let really = way * (1.0 + odometry.share() * normal(&mut oracle));
            at = Point::new(at.x_m + really * heading.cos(), at.y_m + really * heading.sin());
            belief.turned(turn, &odometry);
            belief.driven(way, &odometry);
            let ranges = ANCHORS.map(|anchor| {
                let deviations = (0..beacons).map(|_| one.noise_db() * normal(&mut oracle));
                let mean = deviations.sum::<f64>() / f64::from(beacons);
                Range::new(anchor, one.distance_m(one.level_db(at.distance_m(anchor)) + mean))
            });
            belief.located(&ranges, &averaged, Gate::Open).expect("a fix");
        }
        let filter = Filter::of(&belief);
        let mut off = Vector3::new(at.x_m, at.y_m, heading) - filter.state;
        off[2] = (off[2] + std::f64::consts::PI).rem_euclid(std::f64::consts::TAU) - std::f64::consts::PI;
        (off.transpose() * filter.covariance.try_inverse().expect("it is regular") * off)[0]
    };
    (0..runs).map(run).sum::<f64>() / f64::from(runs)
}

/// The half width of the 95 % band of the mean of so many NEES: each has a variance of 6.
fn band(runs: u32) -> f64 {
    1.96 * (6.0 / f64::from(runs)).sqrt()
}

#[test]
fn errors_are_as_great_as_a_belief_says() {
    let nees = mean_nees(400, 20);
    assert!((nees - 3.0).abs() < band(400), "{nees}");
}

#[test]
#[ignore = "takes a minute: cargo test --release -p tautline-field --test all whole_runs -- --ignored --nocapture"]
fn errors_of_whole_runs_are_as_great_as_a_belief_says() {
    for beacons in [1, 5, 20, 100] {
        let nees = mean_nees(10_000, beacons);
        println!("{beacons} beacons: NEES {nees:.3}, band 3 ± {:.3}", band(10_000));
        assert!((nees - 3.0).abs() < band(10_000), "{beacons} beacons: {nees}");
    }
}

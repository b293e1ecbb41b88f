//! Positions are the same bits at every level of optimisation and on every machine. A test program of its own: the
//! checks build it at every level, see `.ci/run`.

#[path = "support/numbers.rs"]
mod numbers;
#[path = "support/ranges.rs"]
mod ranges;

use tautline_kernel::choice::Oracle;
use tautline_kernel::net::Propagation;
use tautline_kernel::position::{
    Area, Belief, Estimate, Gate, Odometry, Order, Parameters, Point, Range, Residual, Signal,
    SymmetricMatrix, closed_form, linear, locate,
};

use numbers::Congruence;
use ranges::{SQUARE, swarm, wrong};

/// FNV-1a over the bits of numbers.
#[derive(PartialEq, Eq, Debug)]
struct Digest(u64);

impl Digest {
    const EMPTY: Self = Self(0xCBF2_9CE4_8422_2325);

    fn add(&mut self, number: f64) {
        for byte in number.to_bits().to_le_bytes() {
            self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(0x0100_0000_01B3);
        }
    }
}

#[test]
fn positions_from_ranges_are_the_same_bits() {
    let mut digest = Digest::EMPTY;
    let mut drawn = Congruence(1);
    let area = Area::new(SQUARE[0], Point::new(20.0, 20.0));
    for round in 0..200 {
        let ranges = wrong(&mut drawn);
        let signal = Signal::new(Propagation::new(2.0 + 0.01 * f64::from(round)).expect("an exponent"), 1.5);
        let signal = signal.expect("a noise");
        let mut points =
            vec![closed_form(&ranges).expect("a triangle"), linear(&ranges).expect("a triangle")];
        for order in [Order::Published, Order::Corrected] {
            points.push(swarm(&ranges, Parameters { order, ..Parameters::FALLING }, &mut drawn));
        }
        for residual in [Residual::Metres, Residual::Decibels] {
            for area in [None, area] {
                let fix = locate(&ranges, residual, &signal, area).expect("a fix");
                let Estimate { at, cost, precision, .. } = *fix.best();
                points.push(at);
                digest.add(cost);
                digest.add(precision.expect("a triangle").rms_m());
            }
        }
        for point in points {
            digest.add(point.x_m);
            digest.add(point.y_m);
        }
        digest.add(signal.distance_m(signal.level_db(ranges[0].distance_m + 0.1)));
    }
    assert_eq!(digest, Digest(9_139_611_484_346_231_528));
}

#[test]
fn positions_by_wheels_and_fixes_are_the_same_bits() {
    let anchors = [Point::new(-9.0, 0.0), Point::new(9.0, 1.0), Point::new(0.0, 90.0)];
    let covariance = SymmetricMatrix { xx: 0.04, xy: 0.01, yy: 0.09 };
    let mut digest = Digest::EMPTY;
    let mut drawn = Congruence(2);
    let signal = Signal::new(Propagation::FREE_SPACE, 1.0).expect("a noise");
    let mut belief = Belief::known(Point::new(0.0, 0.0), 0.0);
    for _ in 0..2000 {
        let mut part = || f64::from(drawn.pick(1 << 20)) / f64::from(1 << 20) - 0.5;
        belief.turned(6.0 * part(), &Odometry::USUAL);
        belief.driven(1.0 + part(), &Odometry::USUAL);
        let fix = Point::new(belief.at().x_m + 0.4 * part(), belief.at().y_m + 0.4 * part());
        belief.corrected(fix, covariance, Gate::Closed);
        let ranges = anchors.map(|anchor| Range::new(anchor, (1.1 + 0.2 * part()) * fix.distance_m(anchor)));
        belief.located(&ranges, &signal, Gate::Closed).expect("ranges");
        let SymmetricMatrix { xx, xy, yy } = belief.covariance();
        let place = [belief.at().x_m, belief.at().y_m, belief.heading_rad(), xx, xy, yy];
        place.into_iter().chain(belief.heading_covariance()).for_each(|number| digest.add(number));
    }
    assert_eq!(digest, Digest(18_213_013_160_684_640_332));
}

//! Positions of any ranges: refused, or told in numbers, also when everything is turned or mirrored; and a belief that
//! they correct.

use tautline_kernel::choice::Oracle;
use tautline_kernel::net::Propagation;
use tautline_kernel::position::{
    Belief, Gate, Odometry, Parameters, Particle, Point, Range, Residual, Signal, Swarm, closed_form, linear,
    locate,
};
use tautline_proofs::engine::Tape;

use super::parts::numbers;

/// A coordinate or a distance: small, large, or none.
fn metres(bytes: &mut Tape<'_>) -> f64 {
    let small = f64::from(bytes.pick(256)) + f64::from(bytes.pick(256)) / 256.0;
    match bytes.pick(16) {
        0 => -small,
        1 => small * 1e-7,
        2 => small * 1e7,
        3 if small > 255.0 => f64::NAN,
        4 if small > 255.0 => f64::INFINITY,
        _ => small,
    }
}

/// No way panics, and whatever is told is a number; least squares refuse the same ranges where the axes are exchanged,
/// or a sign is.
pub fn position(bytes: &[u8]) {
    let numbers = numbers(bytes);
    let mut bytes = Tape(&numbers);
    let signal = Propagation::new(2.0 + f64::from(bytes.pick(4))).and_then(|propagation| {
        let noise_db = f64::from(bytes.pick(40)) / 4.0;
        Signal::new(propagation, noise_db)
    });
    let signal = signal.expect("an exponent from 2 to 5, a noise below 100 dB");
    let ranges: Vec<Range> = (0..2 + bytes.pick(5))
        .map(|_| {
            let anchor = Point::new(metres(&mut bytes), metres(&mut bytes));
            Range::new(anchor, metres(&mut bytes))
        })
        .collect();
    for told in [closed_form(&ranges), linear(&ranges)] {
        assert!(told.is_err() || told.is_ok_and(Point::is_finite), "{ranges:?}: {told:?}");
    }
    let around = linear(&ranges).unwrap_or_default();
    let mut particles = [Particle::UNUSED; 5];
    if let Ok(swarm) = Swarm::start(&ranges, around, Parameters::CONTRACTING, &mut particles, &mut bytes) {
        let at = swarm.run(&mut bytes);
        assert!(at.is_finite(), "{ranges:?}: {at:?}");
    }
    let turned = |turn: fn(Point) -> Point| -> Vec<Range> {
        ranges.iter().map(|range| Range::new(turn(range.anchor), range.distance_m)).collect()
    };
    for residual in [Residual::Metres, Residual::Decibels] {
        let told = locate(&ranges, residual, &signal, None);
        for turn in [|at: Point| Point::new(at.y_m, at.x_m), |at: Point| Point::new(-at.x_m, at.y_m)] {
            let again = locate(&turned(turn), residual, &signal, None);
            assert_eq!(told.is_ok(), again.is_ok(), "{ranges:?}");
        }
        if let Ok(fix) = told {
            let best = fix.best();
            assert!(best.at.is_finite() && best.cost >= 0.0, "{ranges:?}: {best:?}");
        }
    }
    let mut belief = Belief::known(Point::default(), 0.0);
    for _ in 0..4 {
        belief.turned(f64::from(bytes.pick(256)) / 32.0, &Odometry::USUAL);
        belief.driven(f64::from(bytes.pick(256)) / 64.0, &Odometry::USUAL);
        let gate = if bytes.pick(2) == 0 { Gate::Closed } else { Gate::Open };
        // Ranges that make no position are refused, and leave it as it is.
        let _ = belief.located(&ranges, &signal, gate);
        let place = belief.covariance();
        let variances = [place.xx, place.yy, belief.heading_covariance()[2]];
        assert!(belief.at().is_finite() && variances.iter().all(|&one| one >= 0.0), "{ranges:?}: {belief:?}");
    }
}

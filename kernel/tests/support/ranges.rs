//! Ranges with errors, and a swarm that makes a place of them.

#![allow(missing_docs, unreachable_pub, reason = "several tests use it")]

use tautline_kernel::choice::Oracle;
use tautline_kernel::position::{Parameters, Particle, Point, Range, Swarm, closed_form};

use crate::numbers::Congruence;

pub const SQUARE: [Point; 3] = [Point::new(0.0, 0.0), Point::new(20.0, 0.0), Point::new(0.0, 20.0)];

/// Ranges from a place in the square, each wrong by at most a third.
pub fn wrong(drawn: &mut Congruence) -> Vec<Range> {
    let mut part = || f64::from(drawn.pick(1 << 20)) / f64::from(1 << 20);
    let at = Point::new(20.0 * part(), 20.0 * part());
    let anchors =
        SQUARE.iter().map(|&anchor| Range::new(anchor, anchor.distance_m(at) * (1.0 + (part() - 0.5) / 1.5)));
    anchors.collect()
}

/// Where a swarm ends that starts around the closed form.
pub fn swarm(ranges: &[Range], parameters: Parameters, oracle: &mut Congruence) -> Point {
    let around = closed_form(ranges).expect("anchors that stand well");
    let mut particles = [Particle::UNUSED; 30];
    Swarm::start(ranges, around, parameters, &mut particles, oracle).expect("ranges").run(oracle)
}

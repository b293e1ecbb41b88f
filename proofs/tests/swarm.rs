//! The zone of a swarm's particles, of which Rajesh and others 2024 say that each iteration narrows it (row 109 of the
//! readings).

use tautline_kernel::choice::Oracle;
use tautline_kernel::position::{Order, Parameters, Particle, Point, Range, Swarm};
use tautline_proofs::engine::{Outcome, Stop, Tally, assume, exhaust, require};

/// Draws of a quarter or three quarters, so that no velocity at the start is 0.
struct Quarters<'a>(&'a mut dyn Oracle);

impl Oracle for Quarters<'_> {
    fn pick(&mut self, below: u32) -> u32 {
        below / 4 * (1 + 2 * self.0.pick(2))
    }
}

/// One iteration of so many particles, at most two: of two, the zone is half of their distance.
fn narrows(order: Order, count: usize, oracle: &mut dyn Oracle) -> Outcome {
    let anchors = [(0.0, 0.0, 2.0), (4.0, 0.0, 3.0), (0.0, 3.0, 2.5)];
    let ranges = anchors.map(|(x_m, y_m, distance_m)| Range::new(Point::new(x_m, y_m), distance_m));
    let parameters = Parameters { iterations: 1, order, ..Parameters::CONTRACTING };
    let (mut particles, draws) = (vec![Particle::UNUSED; count], &mut Quarters(oracle));
    let mut swarm = Swarm::start(&ranges, Point::new(1.0, 1.0), parameters, &mut particles, draws)
        .map_err(|_| Stop::Assumed)?;
    let zone_m = |swarm: &Swarm<'_>| {
        let places: Vec<Point> = swarm.places().collect();
        places[0].distance_m(places[count - 1]) / 2.0
    };
    let before_m = zone_m(&swarm);
    assume(before_m > 0.0)?;
    swarm.step(draws);
    require(zone_m(&swarm) <= before_m, "the zone is no wider")?;
    Ok("it is no wider")
}

/// One iteration of two particles is the least that has a zone, and makes a wider one in both orders.
#[test]
fn the_first_iteration_of_two_particles_may_widen_their_zone() {
    // The choices are two places, two velocities, and the draws of the iteration.
    for (order, widens) in [
        (Order::Published, vec![0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0]),
        (Order::Corrected, vec![0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 0, 0]),
    ] {
        assert_eq!(exhaust(|oracle| narrows(order, 1, oracle)), Tally::default());
        let violation = exhaust(|oracle| narrows(order, 2, oracle)).violation;
        assert_eq!(violation, Some((widens, "the zone is no wider")));
    }
}

//! A swarm's best position (POSITION-5): with few particles and coarse draws in every way, and with many at random.

use tautline_kernel::choice::Oracle;
use tautline_kernel::position::{Order, Parameters, Particle, Point, Range, Swarm};

use super::minima::cost;
use crate::engine::{Outcome, Stop, require};
use crate::plural::counted;

/// How a swarm is moved, and what of it counts as its best position.
#[derive(Clone, Copy, Debug)]
pub(super) struct Conduct {
    /// Which velocity moves a particle.
    pub(super) order: Order,
    /// The best position by this reading.
    pub(super) best: Best,
}

/// A reading of the best position of a swarm.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Best {
    /// The best so far.
    Ever,
    /// The best of the present positions.
    Now,
    /// Where the first particle is.
    First,
}

impl Conduct {
    /// Equation (10) as it is printed.
    pub(super) const PUBLISHED: Self = Self { order: Order::Published, best: Best::Ever };
    /// The updates in the order of the algorithm.
    pub(super) const REPAIRED: Self = Self { order: Order::Corrected, best: Best::Ever };

    fn best(self, swarm: &Swarm<'_>, ranges: &[Range]) -> Point {
        match self.best {
            Best::Ever => swarm.best(),
            Best::Now => {
                let cost = |place: &Point| cost(ranges, *place);
                let best = swarm.places().min_by(|one, other| cost(one).total_cmp(&cost(other)));
                best.unwrap_or_default()
            }
            Best::First => swarm.places().next().unwrap_or_default(),
        }
    }
}

/// Anchors, in metres.
const ANCHORS: [Point; 3] = [Point::new(0.0, 0.0), Point::new(4.0, 0.0), Point::new(0.0, 3.0)];

/// Draws with few outcomes.
struct Coarse<'a>(&'a mut dyn Oracle);

/// Outcomes of a coarse draw.
const COARSE: u32 = 3;

impl Oracle for Coarse<'_> {
    fn pick(&mut self, below: u32) -> u32 {
        let outcomes = COARSE.min(below);
        self.0.pick(outcomes) * (below / outcomes)
    }
}

/// Iterations and particles that are looked at in every way: the fewest that go on, and the fewest that differ.
const FEW: [(u32, usize); 2] = [(2, 1), (1, 2)];

/// Iterations and particles of swarms that are drawn at random.
const MANY: (u32, usize) = (20, 5);

/// The bound of [`never_worsens`], in words.
pub(super) fn coarse_draws() -> String {
    let swarm = |(iterations, particles): (u32, usize)| {
        format!("{} of {}", counted(iterations, "iteration"), counted(particles, "particle"))
    };
    format!("{}, each draw one of {COARSE} numbers", FEW.map(swarm).join(" or "))
}

/// The swarms that [`never_worsens_at_random`] draws, in words.
pub(super) fn random_swarms() -> String {
    let (iterations, particles) = MANY;
    format!("swarms of {particles} particles, {iterations} iterations")
}

/// POSITION-5: every way of coarse draws.
///
/// # Errors
/// [`Stop`] if the clause is broken.
pub(super) fn never_worsens(conduct: &Conduct, oracle: &mut dyn Oracle) -> Outcome {
    let distances_m = [2.0, 3.0, 2.5];
    let few = FEW[oracle.pick(FEW.len() as u32) as usize];
    flies(*conduct, distances_m, few, &mut Coarse(oracle))
}

/// POSITION-5: at random.
///
/// # Errors
/// [`Stop`] if the clause is broken.
pub(super) fn never_worsens_at_random(conduct: &Conduct, oracle: &mut dyn Oracle) -> Outcome {
    let mut distance = || f64::from(oracle.pick(1 << 16)) / 8192.0;
    let distances_m = [distance(), distance(), distance()];
    flies(*conduct, distances_m, MANY, oracle)
}

fn flies(
    conduct: Conduct,
    distances_m: [f64; 3],
    (iterations, particles): (u32, usize),
    oracle: &mut dyn Oracle,
) -> Outcome {
    let mut distances = distances_m.into_iter();
    let ranges = ANCHORS.map(|anchor| Range::new(anchor, distances.next().unwrap_or(0.0)));
    let parameters = Parameters { iterations, order: conduct.order, ..Parameters::CONTRACTING };
    let mut particles = vec![Particle::UNUSED; particles];
    let started = Swarm::start(&ranges, Point::new(1.0, 1.0), parameters, &mut particles, oracle);
    let mut swarm = started.map_err(|_| Stop::Assumed)?;
    let first = cost(&ranges, conduct.best(&swarm, &ranges));
    let mut before = first;
    for _ in 0..iterations {
        swarm.step(oracle);
        let now = cost(&ranges, conduct.best(&swarm, &ranges));
        require(now <= before, "the best position fits no worse than before")?;
        let present = swarm.places().map(|place| cost(&ranges, place)).fold(f64::INFINITY, f64::min);
        require(now <= present, "no particle is at a place that fits better")?;
        before = now;
    }
    Ok(if before < first { "it improves" } else { "it does not improve" })
}

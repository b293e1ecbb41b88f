//! The cost of a position: a swarm and damped Gauss–Newton, beside the crates argmin and levenberg-marquardt on the
//! same distances. Criterion follows each figure over time; the table at the end relates them to one another.
//! Gauss–Newton here also looks for a second minimum and tells the covariance, which levenberg-marquardt does not; one
//! minimum alone, from the linear solution as for levenberg-marquardt, has a row of its own.

#![expect(clippy::disallowed_methods, reason = "a benchmark compares no bits")]

use std::hint::black_box;

use argmin::core::{CostFunction, Error, Executor};
use argmin::solver::particleswarm::ParticleSwarm;
use criterion::{BenchmarkId, Criterion};
use levenberg_marquardt::{LeastSquaresProblem, LevenbergMarquardt};
use nalgebra_of_levenberg_marquardt::{Matrix3x2, Owned, U2, U3, Vector2, Vector3};
use tautline_benches::{Work, group, measure};
use tautline_kernel::choice::Oracle;
use tautline_kernel::net::Propagation;
use tautline_kernel::position::{
    Belief, Gate, Odometry, Parameters, Particle, Point, Range, Residual, Signal, Swarm, SymmetricMatrix,
    closed_form, linear, locate, locate_from,
};
use tautline_proofs::engine::SeededOracle;

const ANCHORS: [Point; 3] = [Point::new(0.0, 0.0), Point::new(20.0, 0.0), Point::new(0.0, 20.0)];
const PARTICLES: usize = 30;
const NOISE_DB: f64 = 1.0;

/// Positions of one sample.
const POSITIONS: u32 = 200;

struct FixWork;

impl Work for FixWork {
    fn parts(&self) -> u32 {
        POSITIONS
    }
}

/// The distances that robots at random places measure.
fn measured(signal: &Signal) -> Vec<[Range; 3]> {
    let robot = |number: u32| {
        let mut oracle = SeededOracle::new(0, number.into());
        let mut part = || f64::from(oracle.pick(1 << 31)) / f64::from(1_u32 << 31);
        let at = Point::new(20.0 * part(), 20.0 * part());
        ANCHORS.map(|anchor| {
            let deviation = (0..12).map(|_| part()).sum::<f64>() - 6.0;
            let level_db = signal.level_db(anchor.distance_m(at)) + NOISE_DB * deviation;
            Range::new(anchor, signal.distance_m(level_db))
        })
    };
    (0..POSITIONS).map(robot).collect()
}

/// The least squares of what distances or levels miss, as the other crates want them.
#[derive(Clone)]
struct Problem {
    ranges: [Range; 3],
    residual: Residual,
    at: Vector2<f64>,
}

impl LeastSquaresProblem<f64, U3, U2> for Problem {
    type ResidualStorage = Owned<f64, U3>;
    type JacobianStorage = Owned<f64, U3, U2>;
    type ParameterStorage = Owned<f64, U2>;

    fn set_params(&mut self, at: &Vector2<f64>) {
        self.at = *at;
    }

    fn params(&self) -> Vector2<f64> {
        self.at
    }

    fn residuals(&self) -> Option<Vector3<f64>> {
        let residuals = self.ranges.map(|range| {
            let far = Point::new(self.at.x, self.at.y).distance_m(range.anchor);
            match self.residual {
                Residual::Metres => far - range.distance_m,
                Residual::Decibels => (far / range.distance_m).ln(),
            }
        });
        Some(Vector3::from(residuals))
    }

    fn jacobian(&self) -> Option<Matrix3x2<f64>> {
        let row = |range: Range| {
            let (x, y) = (self.at.x - range.anchor.x_m, self.at.y - range.anchor.y_m);
            let far = x.hypot(y);
            let scale = match self.residual {
                Residual::Metres => far,
                Residual::Decibels => far * far,
            };
            [x / scale, y / scale]
        };
        let [one, other, third] = self.ranges.map(row);
        Some(Matrix3x2::new(one[0], one[1], other[0], other[1], third[0], third[1]))
    }
}

impl CostFunction for Problem {
    type Param = Vec<f64>;
    type Output = f64;

    fn cost(&self, at: &Vec<f64>) -> Result<f64, Error> {
        let misses =
            |range: &Range| (Point::new(at[0], at[1]).distance_m(range.anchor) - range.distance_m).powi(2);
        Ok(self.ranges.iter().map(misses).sum())
    }
}

fn main() {
    let mut criterion = Criterion::default().configure_from_args();
    let signal = Signal::new(Propagation::FREE_SPACE, NOISE_DB).expect("a noise");
    let robots = measured(&signal);
    let starts: Vec<Point> = robots.iter().map(|ranges| closed_form(ranges).expect("a triangle")).collect();
    let mut rows = Vec::new();

    let mut swarms = group(&mut criterion, "swarm of 30 particles, 20 iterations");
    let ours = measure(&mut swarms, BenchmarkId::from_parameter("tautline"), || {
        let mut oracle = SeededOracle::new(1, 0);
        for (ranges, &around) in robots.iter().zip(&starts) {
            let mut particles = [Particle::UNUSED; PARTICLES];
            let swarm = Swarm::start(ranges, around, Parameters::CONTRACTING, &mut particles, &mut oracle);
            black_box(swarm.expect("ranges").run(&mut oracle));
        }
        FixWork
    });
    let theirs = measure(&mut swarms, BenchmarkId::from_parameter("argmin"), || {
        for (ranges, around) in robots.iter().zip(&starts) {
            let bounds = |by: f64| vec![around.x_m + by, around.y_m + by];
            let solver: ParticleSwarm<_, f64, _> = ParticleSwarm::new((bounds(-1.0), bounds(1.0)), PARTICLES)
                .with_inertia_factor(0.7298)
                .and_then(|solver| solver.with_cognitive_factor(1.496_18))
                .and_then(|solver| solver.with_social_factor(1.496_18))
                .expect("factors of a swarm");
            let problem = Problem { ranges: *ranges, residual: Residual::Metres, at: Vector2::zeros() };
            let run =
                Executor::new(problem, solver).configure(|state| state.max_iters(20)).run().expect("a run");
            black_box(run.state().get_best_cost());
        }
        FixWork
    });
    swarms.finish();
    rows.push(("swarm, 30 particles, 20 iterations", ours, "argmin", theirs.micros));

    for (name, alone, residual) in [
        ("least squares in metres", "one minimum in metres", Residual::Metres),
        ("least squares in decibels", "one minimum in decibels", Residual::Decibels),
    ] {
        let mut least = group(&mut criterion, name);
        let ours = measure(&mut least, BenchmarkId::from_parameter("tautline"), || {
            for ranges in &robots {
                black_box(locate(ranges, residual, &signal, None).expect("ranges").best().at);
            }
            FixWork
        });
        let theirs = measure(&mut least, BenchmarkId::from_parameter("levenberg-marquardt"), || {
            for ranges in &robots {
                let start = linear(ranges).expect("a triangle");
                let problem = Problem { ranges: *ranges, residual, at: Vector2::new(start.x_m, start.y_m) };
                black_box(LevenbergMarquardt::new().minimize(problem).0.at);
            }
            FixWork
        });
        let one = measure(&mut least, BenchmarkId::from_parameter("tautline, one minimum"), || {
            for ranges in &robots {
                let start = linear(ranges).expect("a triangle");
                black_box(locate_from(start, ranges, residual, &signal, None).expect("ranges").at);
            }
            FixWork
        });
        least.finish();
        rows.push((name, ours, "levenberg-marquardt", theirs.micros));
        rows.push((alone, one, "levenberg-marquardt", theirs.micros));
    }

    // A robot's step: a turn, a drive, a fix of known covariance; and the same with the position computed of ranges.
    let near = SymmetricMatrix { xx: 0.04, xy: 0.01, yy: 0.09 };
    let mut beliefs = group(&mut criterion, "belief");
    let mut step = |name: &str, fix: &dyn Fn(&mut Belief, &[Range; 3])| {
        measure(&mut beliefs, BenchmarkId::from_parameter(name), || {
            let mut belief = Belief::known(Point::new(10.0, 10.0), 0.0);
            for ranges in &robots {
                belief.turned(black_box(0.3), &Odometry::USUAL);
                belief.driven(black_box(1.0), &Odometry::USUAL);
                fix(&mut belief, ranges);
            }
            black_box(belief);
            FixWork
        })
        .micros
    };
    let fused = step("turn, drive, fix", &|belief, _| {
        let at = belief.at();
        black_box(belief.corrected(Point::new(at.x_m + 0.1, at.y_m - 0.1), near, Gate::Closed));
    });
    let heard = step("turn, drive, ranges", &|belief, ranges| {
        black_box(belief.located(ranges, &signal, Gate::Open).expect("ranges"));
    });
    beliefs.finish();

    criterion.final_summary();

    println!("\nMicroseconds for a position, the fastest of the samples");
    for (name, ours, crate_name, theirs) in rows {
        let (micros, of) = (ours.micros, Work::parts(&ours.work));
        println!(
            "  {name:36} of {of}: tautline {micros:>6.2}   {crate_name} {theirs:>6.2}   {:>5.1} times",
            theirs / micros
        );
    }
    println!(
        "  a step of a belief: turn, drive and fix {fused:.2}, with the position of three ranges {heard:.2}"
    );
}

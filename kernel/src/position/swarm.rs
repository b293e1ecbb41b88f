//! Particle swarm optimisation of a position (Rajesh et al. 2024, equations (9)
//! and (10), and the algorithm of section 5).
//!
//! Left open by the paper, and chosen here: a particle starts within 1 m of the closed form along each axis, with a
//! velocity of 0 to v_max along each; the fitness is the sum of the squared residuals of the distances; `rand()` is one
//! number for each term and particle, or one for each axis besides ([`Draws`]); v_max is 1 m along each axis. The steps
//! bound the first velocities by it alone; whether it bounds later ones, too, is a parameter. Equation (10) adds the
//! velocity of time t, the algorithm updates the velocity first: [`Order`].

use super::range::check;
use super::{Point, Range, Refusal};
use crate::choice::Oracle;

/// Which velocity moves a particle.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Order {
    /// x(t+1) = x(t) + v(t): equation (10) as it is printed.
    Published,
    /// x(t+1) = x(t) + v(t+1): the order of the algorithm.
    Corrected,
}

/// The scope of one draw of `rand()` in equation (9).
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Draws {
    /// Each term and particle: a velocity stays in the plane of what draws it.
    Particle,
    /// Each term, particle and axis.
    Axis,
}

/// w, by which a velocity is kept.
#[derive(Clone, Copy, PartialEq, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Inertia {
    /// One value at every iteration.
    Constant(f64),
    /// It falls evenly from the first iteration to the last.
    Falling {
        /// At the first.
        from: f64,
        /// At the last.
        to: f64,
    },
}

/// The constants of a swarm.
#[derive(Clone, Copy, PartialEq, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Parameters {
    /// w.
    pub inertia: Inertia,
    /// c1: how strongly a particle's own best position draws it.
    pub own: f64,
    /// c2: how strongly the best position of all draws it.
    pub team: f64,
    /// How far from the start a particle begins along each axis, at most, in metres.
    pub spread_m: f64,
    /// v_max: how far a particle moves along each axis in the first iteration, at most, in metres.
    pub first_speed_m: f64,
    /// How far it moves in each later one, at most: v_max, or infinity where that bounds the first velocity alone.
    pub most_speed_m: f64,
    /// How many times the particles move: t_max.
    pub iterations: u32,
    /// Which velocity moves a particle.
    pub order: Order,
    /// The scope of one random number.
    pub draws: Draws,
}

impl Parameters {
    /// The constants of Clerc and Kennedy, with which a swarm contracts: w = 0.7298, c1 = c2 = 1.49618.
    pub const CONTRACTING: Self = Self {
        inertia: Inertia::Constant(0.7298),
        own: 1.496_18,
        team: 1.496_18,
        spread_m: 1.0,
        first_speed_m: 1.0,
        most_speed_m: 1.0,
        iterations: 20,
        order: Order::Corrected,
        draws: Draws::Particle,
    };

    /// Those of Shi and Eberhart: w from 0.9 to 0.4, c1 = c2 = 2.
    pub const FALLING: Self =
        Self { inertia: Inertia::Falling { from: 0.9, to: 0.4 }, own: 2.0, team: 2.0, ..Self::CONTRACTING };

    /// w at the iteration of this number, from 0.
    fn inertia(&self, iteration: u32) -> f64 {
        match self.inertia {
            Inertia::Constant(inertia) => inertia,
            Inertia::Falling { from, to } => {
                let last = f64::from(self.iterations.saturating_sub(1).max(1));
                from + (to - from) * (f64::from(iteration) / last).min(1.0)
            }
        }
    }
}

/// A particle: what [`Swarm::start`] wants a buffer of.
#[derive(Clone, Copy, PartialEq, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Particle {
    at: Point,
    velocity: Point,
    best: Point,
    best_cost: f64,
}

impl Particle {
    /// The filling of a new buffer.
    pub const UNUSED: Self = {
        let origin = Point::new(0.0, 0.0);
        Self { at: origin, velocity: origin, best: origin, best_cost: f64::INFINITY }
    };
}

/// Particles on their way: a lent buffer, and the best position so far.
#[derive(Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Swarm<'a> {
    ranges: &'a [Range],
    parameters: Parameters,
    particles: &'a mut [Particle],
    best: Point,
    best_cost: f64,
    iteration: u32,
}

/// Steps in which a random number between 0 and 1 is drawn.
const DRAWS: u32 = 1 << 31;

/// A number from 0 to below 1.
fn draw(oracle: &mut (impl Oracle + ?Sized)) -> f64 {
    f64::from(oracle.pick(DRAWS)) / f64::from(DRAWS)
}

/// The fitness of a position: the sum of the squared residuals of the distances, in m².
fn cost(ranges: &[Range], at: Point) -> f64 {
    ranges.iter().fold(0.0, |sum, range| {
        let residual_m = range.distance_m - at.distance_m(range.anchor);
        sum + residual_m * residual_m
    })
}

impl<'a> Swarm<'a> {
    /// As many particles as `particles` has room for, about `around`: step 1 of the algorithm, 2a and 2b.
    ///
    /// # Errors
    /// [`Refusal`] if the ranges cannot give a position, if there is no particle, or if `around` is infinite or no
    /// number.
    pub fn start(
        ranges: &'a [Range],
        around: Point,
        parameters: Parameters,
        particles: &'a mut [Particle],
        oracle: &mut (impl Oracle + ?Sized),
    ) -> Result<Self, Refusal> {
        check(ranges)?;
        if particles.is_empty() {
            return Err(Refusal::NoParticle);
        }
        if !around.is_finite() {
            return Err(Refusal::NoPlace);
        }
        let mut swarm =
            Self { ranges, parameters, particles, best: around, best_cost: f64::INFINITY, iteration: 0 };
        let Parameters { spread_m, first_speed_m, .. } = parameters;
        let mut about = |middle: f64| middle + spread_m * (2.0 * draw(oracle) - 1.0);
        for particle in &mut *swarm.particles {
            let at = Point::new(about(around.x_m), about(around.y_m));
            *particle = Particle { at, best: at, ..Particle::UNUSED };
        }
        for particle in &mut *swarm.particles {
            particle.velocity = Point::new(first_speed_m * draw(oracle), first_speed_m * draw(oracle));
        }
        swarm.remember();
        Ok(swarm)
    }

    /// Steps 2a and 2b: the best positions, of each particle and of all.
    fn remember(&mut self) {
        for particle in &mut *self.particles {
            let cost = cost(self.ranges, particle.at);
            if cost < particle.best_cost {
                (particle.best, particle.best_cost) = (particle.at, cost);
            }
            if cost < self.best_cost {
                (self.best, self.best_cost) = (particle.at, cost);
            }
        }
    }

    /// One iteration: equations (9) and (10) for every particle, then the best positions.
    pub fn step(&mut self, oracle: &mut (impl Oracle + ?Sized)) {
        let Parameters { own, team, most_speed_m, order, draws, .. } = self.parameters;
        let (inertia, best) = (self.parameters.inertia(self.iteration), self.best);
        for particle in &mut *self.particles {
            let mut pulls = || (own * draw(oracle), team * draw(oracle));
            let along_x = pulls();
            let along_y = if draws == Draws::Axis { pulls() } else { along_x };
            let faster = |(own, team): (f64, f64), velocity: f64, at: f64, mine: f64, best: f64| {
                let velocity = inertia * velocity + own * (mine - at) + team * (best - at);
                velocity.min(most_speed_m).max(-most_speed_m)
            };
            let before = particle.velocity;
            particle.velocity = Point {
                x_m: faster(along_x, before.x_m, particle.at.x_m, particle.best.x_m, best.x_m),
                y_m: faster(along_y, before.y_m, particle.at.y_m, particle.best.y_m, best.y_m),
            };
            let by = match order {
                Order::Published => before,
                Order::Corrected => particle.velocity,
            };
            particle.at = Point::new(particle.at.x_m + by.x_m, particle.at.y_m + by.y_m);
        }
        self.iteration += 1;
        self.remember();
    }

    /// Every iteration that is left, and the best position then.
    pub fn run(mut self, oracle: &mut (impl Oracle + ?Sized)) -> Point {
        while self.iteration < self.parameters.iterations {
            self.step(oracle);
        }
        self.best
    }

    /// Where the particles are.
    pub fn places(&self) -> impl Iterator<Item = Point> {
        self.particles.iter().map(|particle| particle.at)
    }

    /// The best position so far.
    pub const fn best(&self) -> Point {
        self.best
    }

    /// Its fitness, in m².
    pub const fn best_cost(&self) -> f64 {
        self.best_cost
    }
}

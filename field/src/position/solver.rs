//! The ways to a position, by name.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use tautline_kernel::choice::Oracle;
use tautline_kernel::position::{
    Area, Fix, Order, Parameters, Particle, Point, Range, Refusal, Residual, Signal, Swarm, closed_form,
    linear, locate,
};

use tautline_io::named_values::NamedValues;
use tautline_sim::explore::RuleName;

/// A way from distances to a position.
#[derive(Clone, Copy, PartialEq, Eq, Debug, JsonSchema, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Solver {
    /// Equations (5) to (8).
    ClosedForm,
    /// Particles about it.
    Pso,
    /// Damped Gauss–Newton on distances.
    LeastSquares,
    /// Damped Gauss–Newton in decibels.
    Decibel,
}

impl NamedValues for Solver {
    const WORDS: &'static [(Self, &'static str, &'static str)] = &[
        (
            Self::ClosedForm,
            "closed-form",
            "Where the circles about three anchors meet, in closed form, as in the paper",
        ),
        (Self::Pso, "pso", "Particle swarm optimisation, begun about the closed form, as in the paper"),
        (
            Self::LeastSquares,
            "least-squares",
            "Where the squares of the errors of distances have the least sum, by damped Gauss-Newton",
        ),
        (
            Self::Decibel,
            "decibel",
            "Where the squares of the errors of levels have the least sum: the most likely position",
        ),
    ];
}

/// Particles of a swarm.
pub const PARTICLES: usize = 30;

/// A position, and another one that fits as well.
pub type Solution = (Point, Option<Fix>);

impl Solver {
    /// The position that the distances tell. The closed form alone is restricted to three anchors; a swarm begins about
    /// the linear solution where there are more, or where the closed form divides by 0.
    ///
    /// # Errors
    /// [`Refusal`] if the distances tell none.
    pub fn solve(
        self,
        rule: RuleName,
        ranges: &[Range],
        signal: &Signal,
        area: Option<Area>,
        oracle: &mut impl Oracle,
    ) -> Result<Solution, Refusal> {
        match self {
            Self::ClosedForm => Ok((closed_form(ranges)?, None)),
            Self::Pso => {
                let around = closed_form(ranges).or_else(|_| linear(ranges))?;
                let mut particles = [Particle::UNUSED; PARTICLES];
                let swarm = Swarm::start(ranges, around, parameters(rule), &mut particles, oracle)?;
                Ok((swarm.run(oracle), None))
            }
            Self::LeastSquares => locate(ranges, Residual::Metres, signal, area).map(fixed),
            Self::Decibel => locate(ranges, Residual::Decibels, signal, area).map(fixed),
        }
    }

    /// Whether it can keep a position within a rectangle.
    pub const fn has_area(self) -> bool {
        matches!(self, Self::LeastSquares | Self::Decibel)
    }
}

const fn fixed(fix: Fix) -> Solution {
    (fix.best().at, Some(fix))
}

/// The constants of the paper's swarm, with the updates in the printed order or in the corrected one.
const fn parameters(rule: RuleName) -> Parameters {
    let order = match rule {
        RuleName::Published => Order::Published,
        RuleName::Repaired => Order::Corrected,
    };
    Parameters { order, ..Parameters::CONTRACTING }
}

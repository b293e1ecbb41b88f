//! What the repairs of the chain cost: team moves to 50 % and to 75 % of the cells and of whole runs, as published and
//! repaired, on the same random layouts; and what they give: how many cells are explored, and in how many runs each
//! rule breaks a clause. Sums are whole numbers, so that the result is
//! the same on any number of threads.

use rayon::prelude::*;
use serde::Serialize;
use tautline_proofs::chain::breach::Breach;

use super::interval::{Estimate, Moments, hundredths};
use crate::explore::chain::CHAIN;
use crate::explore::{Milestone, Report, RuleName, Setup, explore};
use crate::fault::{Fault, Halt, Watch};
use crate::layout::Generator;

/// The team of the paper.
pub const ROBOTS: u16 = 8;

/// The probabilities of a wall.
pub const DENSITIES: [&str; 7] = ["0.01", "0.05", "0.1", "0.15", "0.2", "0.3", "0.4"];

/// The milestones that are compared.
pub const MILESTONES: [Milestone; 2] = [Milestone::Half, Milestone::ThreeQuarters];

/// The same layouts under both rules.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Line {
    /// The probability of a wall.
    pub density: &'static str,
    /// How many layouts: those of the seeds from the first one on.
    pub layouts: u32,
    /// For each of [`MILESTONES`].
    pub milestones: [Reached; MILESTONES.len()],
    /// Team moves of whole runs.
    pub moves: Comparison,
    /// Cells explored when a run ends.
    pub explored: Comparison,
    /// For each of [`Breach::CHAIN`]: runs that break it.
    pub violations: [Violations; Breach::CHAIN.len()],
}

/// Team moves to a milestone, where both rules reach it.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Reached {
    /// The milestone.
    pub percent: u32,
    /// The team moves.
    #[serde(flatten)]
    pub moves: Comparison,
}

/// One number of both rules.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Comparison {
    /// Layouts in which there is one under both.
    pub pairs: u32,
    /// Layouts in which there is not.
    pub left_out: u32,
    /// The mean as published, over the pairs.
    pub published: f64,
    /// The mean repaired, over the pairs.
    pub repaired: f64,
    /// The mean of repaired less published.
    pub difference: f64,
    /// Half the width of its 95 % interval.
    pub margin: f64,
}

/// Runs that break a clause.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize)]
pub struct Violations {
    /// Its id.
    pub clause: &'static str,
    /// As published.
    pub published: u32,
    /// Repaired.
    pub repaired: u32,
}

/// Sums over layouts.
#[derive(Clone, Copy, Default)]
struct Sums {
    milestones: [Paired; MILESTONES.len()],
    moves: Paired,
    explored: Paired,
    violations: [[u32; Breach::CHAIN.len()]; RuleName::ALL.len()],
}

#[derive(Clone, Copy, Default)]
struct Paired {
    published: Moments,
    repaired: Moments,
    difference: Moments,
}

/// Compares the rules at every density in the layouts of `layouts` seeds from `seed` on. `watch` is called after each
/// layout.
///
/// # Errors
/// [`Halt`], as `watch` returned it.
pub fn compare(layouts: u32, seed: u64, watch: &Watch<'_>) -> Result<Vec<Line>, Halt> {
    let compare_at = |density: &'static str| {
        let description = format!("walls:15x15:{density}");
        let generator: Generator = description
            .parse()
            .map_err(|problem: crate::layout::Problem| Fault::usage(&problem, problem.remedy()))?;
        let sums = (0..u64::from(layouts)).into_par_iter().map(|index| {
            let sums = Sums::of(&generator, seed.wrapping_add(index))?;
            watch()?;
            Ok(sums)
        });
        let sums = sums.try_reduce(Sums::default, |one, other| Ok::<_, Halt>(one.and(other)))?;
        Ok(sums.line(density, layouts))
    };
    DENSITIES.into_iter().map(compare_at).collect()
}

impl Sums {
    fn of(generator: &Generator, seed: u64) -> Result<Self, Halt> {
        let mut layout =
            generator.generate(seed).map_err(|problem| Fault::usage(&problem, problem.remedy()))?;
        let base = Setup::choose_base(&mut layout, None)
            .map_err(|problem| Fault::usage(&problem, problem.remedy()))?;
        let run = |rule| {
            let layout = layout.clone();
            let setup = Setup { seed, ..Setup::new(&CHAIN, rule, ROBOTS, layout, base) };
            explore(&setup, &mut |_| Ok(()))
        };
        let (published, repaired) = (run(RuleName::Published)?, run(RuleName::Repaired)?);
        let breaks = |report: &Report| {
            Breach::CHAIN
                .map(|breach| u32::from(report.violations.iter().any(|violation| violation.clause == breach)))
        };
        Ok(Self {
            milestones: MILESTONES.map(|milestone| {
                match (published.reached(milestone), repaired.reached(milestone)) {
                    (Some(published), Some(repaired)) => Paired::of(published, repaired),
                    (Some(_) | None, _) => Paired::default(),
                }
            }),
            moves: Paired::of(published.steps, repaired.steps),
            explored: Paired::of(published.explored, repaired.explored),
            violations: [breaks(&published), breaks(&repaired)],
        })
    }

    fn and(self, other: Self) -> Self {
        Self {
            milestones: std::array::from_fn(|place| self.milestones[place].and(other.milestones[place])),
            moves: self.moves.and(other.moves),
            explored: self.explored.and(other.explored),
            violations: std::array::from_fn(|rule| {
                std::array::from_fn(|breach| self.violations[rule][breach] + other.violations[rule][breach])
            }),
        }
    }

    fn line(&self, density: &'static str, layouts: u32) -> Line {
        Line {
            density,
            layouts,
            milestones: std::array::from_fn(|place| Reached {
                percent: MILESTONES[place].percent(),
                moves: self.milestones[place].comparison(layouts),
            }),
            moves: self.moves.comparison(layouts),
            explored: self.explored.comparison(layouts),
            violations: std::array::from_fn(|breach| Violations {
                clause: Breach::CHAIN[breach].clause(),
                published: self.violations[RuleName::Published as usize][breach],
                repaired: self.violations[RuleName::Repaired as usize][breach],
            }),
        }
    }
}

impl Paired {
    fn of(published: u32, repaired: u32) -> Self {
        let (published, repaired) = (i64::from(published), i64::from(repaired));
        Self {
            published: Moments::of(published),
            repaired: Moments::of(repaired),
            difference: Moments::of(repaired - published),
        }
    }

    const fn and(self, other: Self) -> Self {
        Self {
            published: self.published.and(other.published),
            repaired: self.repaired.and(other.repaired),
            difference: self.difference.and(other.difference),
        }
    }

    /// Without pairs everything is 0, and of one pair the margin.
    fn comparison(self, layouts: u32) -> Comparison {
        let mean = |moments: Moments| hundredths(moments.estimate().map_or(0.0, |estimate| estimate.mean));
        let margin = self.difference.estimate().and_then(Estimate::margin);
        Comparison {
            pairs: self.difference.count(),
            left_out: layouts - self.difference.count(),
            published: mean(self.published),
            repaired: mean(self.repaired),
            difference: mean(self.difference),
            margin: hundredths(margin.unwrap_or(0.0)),
        }
    }
}

//! The chain against its rivals [Kovács 2011, E]: Table I and Fig. 3, measured again. A run that does not get there is
//! a result as well: beside every figure stands how many of the runs got there, and no mean is taken over those alone.
//! Where not all did, the median counts the others as later than any.

mod claims;
mod fig3;
mod parameters;
mod table1;

use std::num::NonZeroU32;

use self::parameters::{ROBOTS, RivalSettings};
use super::prelude::*;
use crate::rivals::rival;
use crate::rivals::{Cells, Links, Search};
use tautline_field::stats::quantile;
use tautline_sim::explore::chain::{CHAIN, REEL};
use tautline_sim::explore::{Limits, Milestone, Report, RuleId, RuleName, Setup, StopReason, explore, run};

pub use fig3::ChainFig3;
pub use table1::ChainTable1;

/// Its area without walls, (2N−1)² cells.
const OPEN: &str = "open:15x15";

/// Its buildings; the paper's are in a figure that we have not.
const ROOMS: [&str; 2] = ["rooms-a", "rooms-b"];

/// The paper's MAX_MOVES: a run stops when a robot has entered so many cells.
const MAX_MOVES: u32 = 400;

/// Who explores.
#[derive(Clone, Copy, PartialEq, Eq, Debug, JsonSchema, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Contender {
    /// A chain of this rule.
    Chain(RuleName),
    /// The reel.
    Reel,
    /// A rival.
    Rival {
        /// How it chooses.
        search: Search,
        /// The kind of its links.
        links: Links,
        /// Whether robots share cells.
        cells: Cells,
    },
}

impl Contender {
    /// Full search with links of this kind.
    const fn full(links: Links) -> Self {
        Self::Rival { search: Search::Full, links, cells: Cells::Distinct }
    }

    /// The best of a pool, with links of this kind.
    const fn pool(pool: u32, links: Links) -> Self {
        Self::Rival { search: Search::Pool(pool), links, cells: Cells::Distinct }
    }

    /// Our own teams: the chain of both rules, and the reel.
    const OURS: [Self; 3] = [Self::Chain(RuleName::Published), Self::Chain(RuleName::Repaired), Self::Reel];

    /// Our own teams, and both rivals under both rules of links.
    const fn all(pool: u32) -> [Self; 7] {
        let [published, repaired, reel] = Self::OURS;
        [
            published,
            repaired,
            reel,
            Self::full(Links::Safe),
            Self::full(Links::Covered),
            Self::pool(pool, Links::Safe),
            Self::pool(pool, Links::Covered),
        ]
    }

    /// Whether a run has anything that is left to chance besides its layout.
    const fn is_chancy(self) -> bool {
        match self {
            Self::Chain(_) | Self::Reel => false,
            Self::Rival { .. } => true,
        }
    }

    fn name(self) -> String {
        match self {
            Self::Chain(rule) => format!("chain, {rule}"),
            Self::Reel => REEL.to_string(),
            Self::Rival { search, links, cells } => {
                let search = match search {
                    Search::Full => "Full search".to_owned(),
                    Search::Pool(pool) => format!("pool of {pool}"),
                };
                let cells = match cells {
                    Cells::Distinct => "",
                    Cells::Shared => ", shared cells",
                };
                format!("{search}, {}{cells}", links.symbol())
            }
        }
    }

    /// A run in `layout`, the base in its middle.
    fn run(self, told: &RivalSettings, layout: &Layout, seed: u64, limits: Limits) -> Result<Outcome, Halt> {
        let (layout, base) = based(layout.clone())?;
        let chain = |rule: RuleId, layout| {
            let setup = Setup { seed, limits, ..Setup::new(&CHAIN, rule, ROBOTS, layout, base) };
            explore(&setup, &mut |_| Ok(()))
        };
        let report = match self {
            Self::Chain(rule) => chain(rule.into(), layout)?,
            Self::Reel => chain(REEL, layout)?,
            Self::Rival { search, links, cells } => {
                let mut team = rival(told.parameters(search, links, cells), ROBOTS, &layout, base, seed)?;
                run(&mut *team, &layout, limits, &mut |_| Ok(()))?
            }
        };
        Ok(Outcome::of(&report))
    }
}

/// The outcome of a run.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, JsonSchema, Serialize, Deserialize)]
pub struct Outcome {
    /// The team moves to each milestone that it reached.
    milestones: [Option<u32>; Milestone::ALL.len()],
    explored: u32,
    cells: u32,
    /// Whether it was stopped since a robot had entered as many cells as it may.
    is_stopped: bool,
}

impl Outcome {
    const fn of(report: &Report) -> Self {
        let &Report { milestones, explored, cells, stopped, .. } = report;
        Self { milestones, explored, cells, is_stopped: matches!(stopped, StopReason::MaxMoves) }
    }

    const fn reached(&self, milestone: Milestone) -> Option<u32> {
        self.milestones[milestone as usize]
    }

    /// In percent of the cells.
    fn explored(&self) -> f64 {
        100.0 * f64::from(self.explored) / f64::from(self.cells)
    }
}

/// Team moves of some runs to a milestone.
#[derive(Clone, Copy, PartialEq, Debug, JsonSchema, Serialize)]
struct Times {
    runs: u32,
    /// Runs that get there.
    reached: u32,
    /// Their mean, if all runs get there.
    mean: Option<Estimate>,
    /// The median of all runs, one that never gets there being later than any; none if most do not.
    median: Option<u32>,
    /// Its 95 % interval, where there are runs enough; an end that is none is never.
    median_interval: Option<[Option<u32>; 2]>,
}

impl Times {
    fn of(outcomes: &[&Outcome], milestone: Milestone) -> Self {
        let reached = outcomes.iter().map(|outcome| outcome.reached(milestone));
        let mut moves: Vec<f64> = reached.map(|moves| moves.map_or(f64::INFINITY, f64::from)).collect();
        moves.sort_by(f64::total_cmp);
        let reached = count(&moves, |moves| moves.is_finite());
        let runs = moves.len() as u32;
        let (median, interval) = quantile(&moves, 0.5);
        let ever = |moves: f64| moves.is_finite().then_some(moves as u32);
        Self {
            runs,
            reached,
            mean: mean(moves).filter(|_| reached == runs).map(|mean| rounded(mean, 100.0)),
            median: ever(median),
            median_interval: interval.map(|ends| ends.map(ever)),
        }
    }

    /// The mean of all, or the median, or nothing; and how many get there.
    fn text(&self) -> String {
        let Self { runs, reached, .. } = self;
        let end = |moves: Option<u32>| moves.map_or("-".to_owned(), |moves| moves.to_string());
        let moves = match (self.mean, self.median) {
            (Some(mean), _) => mean.text(1),
            (None, Some(median)) => match self.median_interval {
                Some([least, most]) => format!("median {median} [{}, {}]", end(least), end(most)),
                None => format!("median {median}"),
            },
            (None, None) => "-".to_owned(),
        };
        format!("{moves} ({reached}/{runs})")
    }

    /// The 95 % interval of the mean if all get there, else that of the median.
    fn ends(&self) -> Option<[f64; 2]> {
        let of_median = || Some(self.median_interval?.map(|end| end.map_or(f64::INFINITY, f64::from)));
        self.mean.map_or_else(of_median, |mean| mean.interval)
    }

    /// The mean if all get there, else the median.
    fn middle(&self) -> Option<f64> {
        self.mean.map(|mean| mean.mean).or(self.median.map(f64::from))
    }
}

/// Runs that stop when a robot has entered so many cells.
fn stopping(max_moves: u32) -> Limits {
    Limits { max_moves: NonZeroU32::new(max_moves), ..Limits::default() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_run_that_never_gets_there_is_later_than_any_and_leaves_no_mean() {
        let times = |moves: &[Option<u32>]| {
            let outcome =
                |&half: &Option<u32>| Outcome { milestones: [half, None, None], ..Outcome::default() };
            let outcomes: Vec<Outcome> = moves.iter().map(outcome).collect();
            let times = Times::of(&outcomes.iter().collect::<Vec<_>>(), Milestone::Half);
            assert_eq!(times.median_interval.is_some(), moves.len() > 5);
            (times.reached, times.mean.map(|mean| mean.mean), times.median)
        };
        assert_eq!(times(&[Some(30), Some(10), Some(21)]), (3, Some(20.33), Some(21)));
        assert_eq!(times(&[Some(30), None, Some(10), None, Some(20)]), (3, None, Some(30)));
        assert_eq!(times(&[Some(30), None, Some(10), None, None]), (2, None, None));
        assert_eq!(times(&[None; 6]), (0, None, None));
    }
}

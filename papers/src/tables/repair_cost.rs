//! The cost of the chain's repairs: team moves to 50 % and to 75 % of the cells and of whole runs, as published and
//! repaired, on the same random layouts; and their gain: how many cells are explored, and in how many runs each rule
//! breaks a clause. Sums are whole numbers, so that the result is the same on any number of threads.

use tautline_proofs::chain::breach::Breach;

use super::prelude::*;
use tautline_field::stats::Moments;
use tautline_sim::explore::chain::CHAIN;
use tautline_sim::explore::{Milestone, Report, RuleName, Setup, explore};

/// The team of the paper.
pub const ROBOTS: u16 = 8;

/// The probabilities of a wall.
pub const DENSITIES: [&str; 7] = ["0.01", "0.05", "0.1", "0.15", "0.2", "0.3", "0.4"];

/// The milestones that are compared.
pub const MILESTONES: [Milestone; 2] = [Milestone::Half, Milestone::ThreeQuarters];

/// The most jobs at a density: so many that all threads end at about the same time, and so few that their results take
/// little room.
const MOST_JOBS: u32 = 1000;

/// The cost of the chain's repairs.
#[derive(Clone, Copy, Debug)]
pub struct RepairCost;

settings! {
    /// How much is measured.
    #[derive(Copy, Eq)]
    pub struct Settings {
        /// Random layouts at each density
        pub layouts: u32 = 300, one("runs", "COUNT", from_to(1..=1_000_000));
        /// The seed of the first layout; the others have the seeds after it
        pub seed: u64 = 0, one("seed", "SEED", number);
    }
}

/// Layouts of one density that follow each other.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize)]
pub struct Job {
    /// The place in [`DENSITIES`].
    density: usize,
    /// The seed of the first layout.
    seed: u64,
    layouts: u32,
}

/// The whole table.
#[derive(Clone, PartialEq, Debug, JsonSchema, Serialize)]
pub struct Summary {
    robots: u16,
    seed: u64,
    /// For each of [`DENSITIES`].
    pub densities: Vec<Line>,
}

/// One set of layouts under both rules.
#[derive(Clone, PartialEq, Debug, JsonSchema, Serialize)]
pub struct Line {
    /// The probability of a wall.
    pub density: &'static str,
    /// How many layouts: those of the seeds from the first one on.
    pub layouts: u32,
    /// For each of [`MILESTONES`].
    pub milestones: [MilestoneMoves; MILESTONES.len()],
    /// Team moves of whole runs.
    pub moves: Comparison,
    /// Cells explored when a run ends.
    pub explored: Comparison,
    /// For each of [`Breach::CHAIN`]: runs that break it.
    pub violations: [Violations; Breach::CHAIN.len()],
}

/// Team moves to a milestone, where both rules reach it.
#[derive(Clone, PartialEq, Debug, JsonSchema, Serialize)]
pub struct MilestoneMoves {
    /// The milestone.
    pub percent: u32,
    /// The team moves.
    #[serde(flatten)]
    pub moves: Comparison,
}

/// One number of both rules.
#[derive(Clone, PartialEq, Debug, JsonSchema, Serialize)]
pub struct Comparison {
    /// Layouts in which there is one under both.
    pub pairs: u32,
    /// Layouts in which there is not.
    pub left_out: u32,
    /// The mean as published, over the pairs; without pairs there is none.
    pub published: Option<f64>,
    /// The mean repaired, over the pairs.
    pub repaired: Option<f64>,
    /// The mean of repaired less published.
    pub difference: Option<f64>,
    /// Half the width of its 95 % interval; one pair gives none.
    pub margin: Option<f64>,
}

/// Runs that break a clause.
#[derive(Clone, Copy, PartialEq, Eq, Debug, JsonSchema, Serialize)]
pub struct Violations {
    /// Its id.
    pub clause: &'static str,
    /// As published.
    pub published: u32,
    /// Repaired.
    pub repaired: u32,
}

/// Sums over layouts.
#[derive(Clone, Copy, Default, Debug, Serialize, Deserialize)]
pub struct Sums {
    milestones: [PairMoments; MILESTONES.len()],
    moves: PairMoments,
    explored: PairMoments,
    violations: [[u32; Breach::CHAIN.len()]; RuleName::ALL.len()],
}

#[derive(Clone, Copy, Default, Debug, JsonSchema, Serialize, Deserialize)]
struct PairMoments {
    published: Moments,
    repaired: Moments,
    difference: Moments,
}

impl Table for RepairCost {
    type Settings = Settings;
    type Job = Job;
    type Sample = Sums;
    type Summary = Summary;

    fn about(&self) -> Description {
        Description {
            id: "repair-cost",
            shows: "the chain as published against the chain repaired on the same random layouts: mean team moves to \
                    50 % and 75 %, and runs that break a clause",
            help: "What the chain's repairs cost in team moves, and what they prevent",
            examples: &["repair-cost", "repair-cost --runs 10000 --format json"],
            doing: "comparing",
            takes: "some seconds",
            ..Description::NOTHING
        }
    }

    fn jobs(&self, settings: &Settings) -> Result<Vec<Job>, Halt> {
        let Settings { layouts, seed } = *settings;
        let of_one = layouts.div_ceil(MOST_JOBS);
        let batches = |density| {
            let batch = move |first: u32| Job {
                density,
                seed: seed.wrapping_add(first.into()),
                layouts: of_one.min(layouts - first),
            };
            (0..layouts).step_by(of_one.max(1) as usize).map(batch)
        };
        Ok((0..DENSITIES.len()).flat_map(batches).collect())
    }

    fn parts(&self, job: &Job) -> u64 {
        job.layouts.into()
    }

    fn measure(&self, _: &Settings, job: &Job, _: &dyn Observer) -> Result<Sums, Halt> {
        let density = DENSITIES.get(job.density).copied().unwrap_or_default();
        let seeds = (0..job.layouts).map(|index| job.seed.wrapping_add(index.into()));
        seeds.map(|seed| Sums::of(density, seed)).try_fold(Sums::default(), |sums, one| Ok(sums.and(one?)))
    }

    fn merge(&self, settings: &Settings, results: Vec<(Job, Sums)>) -> Result<Summary, Halt> {
        if let Some(job) = results.iter().position(|(job, sums)| !sums.is_of_at_most(job.layouts)) {
            let what = format_args!("the result of job {job} is none of its layouts");
            return Err(Diagnostic::usage(what, "run its shard again").into());
        }
        let line = |density: usize| {
            let batches = results.iter().filter(|(job, _)| job.density == density);
            let sums = batches.fold(Sums::default(), |sums, &(_, batch)| sums.and(batch));
            sums.line(DENSITIES[density], settings.layouts)
        };
        let densities = (0..DENSITIES.len()).map(line).collect();
        Ok(Summary { robots: ROBOTS, seed: settings.seed, densities })
    }

    fn text(&self, settings: &Settings, merged: &Summary) -> Result<String, Halt> {
        let lines = &merged.densities;
        let mut text = format!(
            "{ROBOTS} robots in walls:15x15:DENSITY, {} at each density, seeds from {}\n",
            counted(settings.layouts, "layout"),
            settings.seed
        );
        for (place, milestone) in MILESTONES.iter().enumerate() {
            let title = format!("Mean team moves to {} %, where both reach it", milestone.percent());
            text.push_str(&compared(&title, lines, |line| &line.milestones[place].moves));
        }
        text.push_str(&compared("Mean team moves of whole runs", lines, |line| &line.moves));
        text.push_str(&compared("Mean cells explored when a run ends", lines, |line| &line.explored));
        let mut clauses = Columns::of(lines)
            .title("Runs that break a clause, published / repaired")
            .left("density", |line| line.density);
        for (place, breach) in Breach::CHAIN.into_iter().enumerate() {
            clauses = clauses.right(breach.clause(), move |line| {
                let runs = line.violations[place];
                format!("{} / {}", runs.published, runs.repaired)
            });
        }
        Ok(text + &clauses.text())
    }

    fn is_broken(&self, merged: &Summary) -> bool {
        merged.densities.iter().any(|line| line.violations.iter().any(|runs| runs.repaired > 0))
    }
}

/// A table of one number of both rules.
fn compared(title: &str, lines: &[Line], number: impl Fn(&Line) -> &Comparison) -> String {
    Columns::of(lines.iter().map(|line| (line.density, number(line))))
        .title(format!("{title}; the difference with its 95 % interval"))
        .left("density", |(density, _)| density)
        .number("published", 2, |(_, both)| both.published)
        .number("repaired", 2, |(_, both)| both.repaired)
        .right("difference", |(_, both)| {
            let margin = both.margin.map_or_else(String::new, |margin| format!(" ± {margin:.2}"));
            both.difference.map_or("-".to_owned(), |difference| format!("{difference:+.2}{margin}"))
        })
        .right("layouts", |(_, both)| both.pairs)
        .right("left out", |(_, both)| both.left_out)
        .text()
}

impl Sums {
    fn of(density: &str, seed: u64) -> Result<Self, Halt> {
        let (layout, base) = based(generated(&format!("walls:15x15:{density}"), seed)?)?;
        let run = |rule| {
            let layout = layout.clone();
            let setup = Setup { seed, ..Setup::new(&CHAIN, rule, ROBOTS, layout, base) };
            explore(&setup, &mut |_| Ok(()))
        };
        let (published, repaired) = (run(RuleName::Published)?, run(RuleName::Repaired)?);
        let breaks = |report: &Report| {
            Breach::CHAIN.map(|breach| {
                u32::from(report.violations.iter().any(|violation| violation.clause == breach.into()))
            })
        };
        Ok(Self {
            milestones: MILESTONES.map(|milestone| {
                match (published.reached(milestone), repaired.reached(milestone)) {
                    (Some(published), Some(repaired)) => PairMoments::of(published, repaired),
                    (Some(_) | None, _) => PairMoments::default(),
                }
            }),
            moves: PairMoments::of(published.steps, repaired.steps),
            explored: PairMoments::of(published.explored, repaired.explored),
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

    /// Whether at most so many layouts can have these sums.
    fn is_of_at_most(&self, layouts: u32) -> bool {
        let pairs = self.milestones.iter().chain([&self.moves, &self.explored]);
        let mut moments = pairs.flat_map(|pair| [pair.published, pair.repaired, pair.difference]);
        moments.all(|moments| moments.is_of_at_most(layouts))
            && self.violations.iter().flatten().all(|&runs| runs <= layouts)
    }

    fn line(&self, density: &'static str, layouts: u32) -> Line {
        Line {
            density,
            layouts,
            milestones: std::array::from_fn(|place| MilestoneMoves {
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

impl PairMoments {
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

    /// Without pairs there are no means.
    fn comparison(self, layouts: u32) -> Comparison {
        let mean = |moments: Moments| moments.estimate().map(|estimate| hundredths(estimate.mean));
        Comparison {
            pairs: self.difference.count(),
            left_out: layouts - self.difference.count(),
            published: mean(self.published),
            repaired: mean(self.repaired),
            difference: mean(self.difference),
            margin: self.difference.estimate().and_then(Estimate::margin).map(hundredths),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn without_layouts_there_are_no_means() {
        let none = PairMoments::default().comparison(1);
        assert_eq!((none.pairs, none.left_out), (0, 1));
        assert_eq!([none.published, none.repaired, none.difference, none.margin], [None; 4]);
        let one = PairMoments::of(7, 5).comparison(1);
        assert_eq!([one.published, one.repaired, one.difference], [Some(7.0), Some(5.0), Some(-2.0)]);
    }
}

//! The reel against the repaired chain, with and without *Hold*, on the same layouts: team moves to 50 % and 75 % of
//! the cells, to everything within reach, and of whole runs, and how many cells they explore. Sums are whole numbers,
//! so that the result is the same on any number of threads.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use tautline_kernel::ground::Cell;
use tautline_proofs::chain::links::within_reach;
use tautline_proofs::plural::counted;

use super::parameter::{Parameter, put, shown};
use super::{About, Observer, Table, unfit};
use tautline_field::stats::{Estimate, Moments, hundredths};
use tautline_sim::diagnostic::{Diagnostic, Halt};
use tautline_sim::explore::chain::{CHAIN, REEL, UNHELD};
use tautline_sim::explore::{Milestone, Report, RuleId, Setup, explore};
use tautline_sim::layout::Generator;
use tautline_sim::text_table::{Column, TextTable, Width};
use tautline_sim::value_parser::{number, within};

/// The team of the paper.
const ROBOTS: u16 = 8;

/// The rules; the first is what the others are compared with.
const RULES: [RuleId; 3] = [RuleId::REPAIRED, REEL, UNHELD];

/// The grounds, as generators of layouts. The two buildings are one layout each.
const GROUNDS: [&str; 10] = [
    "open:15x15",
    "walls:15x15:0.01",
    "walls:15x15:0.02",
    "walls:15x15:0.05",
    "walls:15x15:0.1",
    "walls:15x15:0.15",
    "walls:15x15:0.2",
    "walls:15x15:0.3",
    "rooms-a",
    "rooms-b",
];

/// What is counted.
const GOALS: [&str; 4] = ["50 %", "75 %", "everything within reach", "the end of the run"];

/// The reel against the repaired chain.
#[derive(Clone, Copy, Debug)]
pub struct Reel;

/// How much is measured.
#[derive(Clone, PartialEq, Eq, Debug, JsonSchema, Serialize, Deserialize)]
pub struct Settings {
    /// Layouts at each density.
    pub layouts: u32,
    /// The seed of the first one; the others have the seeds after it.
    pub seed: u64,
}

impl Default for Settings {
    fn default() -> Self {
        Self { layouts: 100, seed: 0 }
    }
}

/// One layout.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize)]
pub struct Job {
    /// The place in [`GROUNDS`].
    ground: usize,
    seed: u64,
}

/// What came of one run.
#[derive(Clone, Copy, PartialEq, Eq, Default, Debug, Serialize, Deserialize)]
pub struct Outcome {
    /// By goal: the team moves.
    moves: [Option<u32>; GOALS.len()],
    /// Cells that it has explored at its end.
    explored: u32,
}

/// The whole table.
#[derive(Clone, PartialEq, Debug, JsonSchema, Serialize)]
pub struct Merged {
    robots: u16,
    seed: u64,
    /// For each goal and ground.
    pub lines: Vec<Line>,
    /// For each ground.
    pub cells: Vec<Cells>,
}

/// One goal on one ground.
#[derive(Clone, PartialEq, Debug, JsonSchema, Serialize)]
pub struct Line {
    /// What is counted.
    pub goal: &'static str,
    /// The generator of the layouts.
    pub ground: &'static str,
    /// How many layouts there are.
    pub runs: u32,
    /// For each rule.
    pub rules: Vec<OfRule>,
}

/// Team moves by one rule.
#[derive(Clone, PartialEq, Debug, JsonSchema, Serialize)]
pub struct OfRule {
    /// Its name.
    pub rule: &'static str,
    /// Runs that reach the goal.
    pub reached: u32,
    /// The mean, over the layouts in which this rule and the repaired one reach it.
    pub mean: Option<f64>,
    /// By how many times the repaired rule's mean it is, over the same layouts.
    pub ratio: Option<f64>,
    /// The 95 % interval of that ratio.
    pub interval: Option<[f64; 2]>,
    /// Layouts in which it takes more team moves than the repaired rule.
    pub slower: u32,
}

/// The cells that runs on one ground explore.
#[derive(Clone, PartialEq, Debug, JsonSchema, Serialize)]
pub struct Cells {
    /// The generator of the layouts.
    pub ground: &'static str,
    /// For each rule.
    pub rules: Vec<Explored>,
}

/// The cells that runs by one rule explore.
#[derive(Clone, PartialEq, Debug, JsonSchema, Serialize)]
pub struct Explored {
    /// Its name.
    pub rule: &'static str,
    /// The mean.
    pub mean: Option<f64>,
    /// So many of the cells that the repaired rule explores, in percent.
    pub percent: Option<Estimate>,
    /// Layouts in which it explores fewer cells than the repaired rule.
    pub fewer: u32,
    /// Layouts in which it explores more.
    pub more: u32,
}

impl Table for Reel {
    type Settings = Settings;
    type Job = Job;
    type Measured = [Outcome; RULES.len()];
    type Merged = Merged;

    fn about(&self) -> About {
        About {
            id: "reel",
            shows: "the reel against the repaired chain on the same layouts: mean team moves to 50 %, to 75 %, and to \
                    everything within reach, and the cells that it explores",
            help: "How many team moves the reel saves, and what holding contact costs",
            more: "",
            examples: &["reel", "reel --layouts 1000 --format json"],
            doing: "comparing",
        }
    }

    fn parameters(&self) -> Vec<Parameter<Settings>> {
        vec![
            Parameter::one(
                "layouts",
                "COUNT",
                "Random layouts at each density",
                |all| shown(&all.layouts),
                |all, texts| put(&mut all.layouts, texts, |text| within(text, &(1..=1_000_000_i64))),
            ),
            Parameter::one(
                "seed",
                "SEED",
                "The seed of the first layout; the others have the seeds after it",
                |all| shown(&all.seed),
                |all, texts| put(&mut all.seed, texts, number),
            ),
        ]
    }

    fn jobs(&self, settings: &Settings) -> Result<Vec<Job>, Halt> {
        let seeds = |ground: usize| {
            let is_random = GROUNDS[ground].starts_with("walls");
            let count = if is_random { settings.layouts } else { 1 };
            (0..count).map(move |index| Job { ground, seed: settings.seed.wrapping_add(index.into()) })
        };
        Ok((0..GROUNDS.len()).flat_map(seeds).collect())
    }

    fn measure(&self, _: &Settings, job: &Job, _: &dyn Observer) -> Result<Self::Measured, Halt> {
        let ground = GROUNDS.get(job.ground).copied().unwrap_or_default();
        let generator: Generator = ground.parse().map_err(|problem| unfit(&problem))?;
        let mut layout = generator.generate(job.seed).map_err(|problem| unfit(&problem))?;
        let base = Setup::choose_base(&mut layout, None).map_err(|problem| unfit(&problem))?;
        let mut outcomes = Self::Measured::default();
        for (outcome, rule) in outcomes.iter_mut().zip(RULES) {
            let setup = Setup { seed: job.seed, ..Setup::new(&CHAIN, rule, ROBOTS, layout.clone(), base) };
            let report = explore(&setup, &mut |_| Ok(()))?;
            if let Some(violation) = report.violations.first() {
                let broken = format_args!("the rule {rule} breaks {} in {ground}", violation.clause);
                let remedy =
                    format!("look at it with `tautline explore {ground} --rule {rule} --seed {}`", job.seed);
                return Err(Diagnostic::of_field("reel", broken, remedy).into());
            }
            let due = within_reach(report.chart.area(), base, ROBOTS.into(), |edge| layout.is_open(edge));
            *outcome = Outcome { moves: reached(&report, &due), explored: report.explored };
        }
        Ok(outcomes)
    }

    fn merge(&self, settings: &Settings, results: Vec<(Job, Self::Measured)>) -> Result<Merged, Halt> {
        let of_ground = |ground: usize| {
            let of_ground = results.iter().filter(move |(job, _)| job.ground == ground);
            of_ground.map(|(_, outcomes)| outcomes)
        };
        let line = |goal: usize, ground: usize| {
            let moves: Vec<[Option<u32>; RULES.len()]> =
                of_ground(ground).map(|outcomes| outcomes.map(|outcome| outcome.moves[goal])).collect();
            let rules = (0..RULES.len()).map(|rule| OfRule::of(rule, &moves)).collect();
            Line { goal: GOALS[goal], ground: GROUNDS[ground], runs: moves.len() as u32, rules }
        };
        let places = (0..GOALS.len()).flat_map(|goal| (0..GROUNDS.len()).map(move |ground| (goal, ground)));
        let lines = places.map(|(goal, ground)| line(goal, ground)).collect();
        let cells = (0..GROUNDS.len()).map(|ground| {
            let explored: Vec<[u32; RULES.len()]> =
                of_ground(ground).map(|outcomes| outcomes.map(|outcome| outcome.explored)).collect();
            let rules = (0..RULES.len()).map(|rule| Explored::of(rule, &explored)).collect();
            Cells { ground: GROUNDS[ground], rules }
        });
        Ok(Merged { robots: ROBOTS, seed: settings.seed, lines, cells: cells.collect() })
    }

    fn text(&self, settings: &Settings, merged: &Merged) -> Result<String, Halt> {
        let mut text = format!(
            "{ROBOTS} robots, {} at each density, seeds from {}\n",
            counted(settings.layouts, "layout"),
            settings.seed
        );
        for goal in GOALS {
            let numbers = [9, 9, 15, 7, 9, 15, 7, 15].map(|width| Column::right(Width::Of(width)));
            let mut columns = TextTable::new([Column::left(Width::Of(17))].into_iter().chain(numbers));
            columns.title(format!(
                "Mean team moves to {goal}; ratios to the repaired rule with their 95 % intervals; layouts in which \
                 a rule is slower"
            ));
            columns.row([
                "layouts",
                "repaired",
                "reel",
                "ratio",
                "slower",
                "unheld",
                "ratio",
                "slower",
                "reached/runs",
            ]);
            for line in merged.lines.iter().filter(|line| line.goal == goal) {
                let reached: Vec<String> = line.rules.iter().map(|rule| rule.reached.to_string()).collect();
                let mut cells = vec![line.ground.to_owned(), mean(&line.rules[0])];
                for rule in &line.rules[1..] {
                    cells.extend([mean(rule), ratio(rule), rule.slower.to_string()]);
                }
                cells.push(format!("{} of {}", reached.join(", "), line.runs));
                columns.row(cells);
            }
            text.push_str(&columns.text());
        }
        text.push_str(&cells(&merged.cells));
        Ok(text)
    }
}

/// The cells that runs explore, for people.
fn cells(cells: &[Cells]) -> String {
    let numbers = [9, 9, 16, 7, 6, 9, 16, 7, 6].map(|width| Column::right(Width::Of(width)));
    let mut columns = TextTable::new([Column::left(Width::Of(17))].into_iter().chain(numbers));
    columns.title(
        "Mean cells explored; in % of those of the repaired rule with their 95 % intervals; layouts in which a rule explores \
         fewer cells, and more"
            .to_owned(),
    );
    let heads = ["layouts", "repaired", "reel", "in %", "fewer", "more", "unheld", "in %", "fewer", "more"];
    columns.row(heads.map(str::to_owned));
    for Cells { ground, rules } in cells {
        let mean = |rule: &Explored| rule.mean.map_or("-".to_owned(), |mean| format!("{mean:.1}"));
        let mut row = vec![(*ground).to_owned(), mean(&rules[0])];
        for rule in &rules[1..] {
            let percent = Estimate::text_or_dash(rule.percent, 2);
            row.extend([mean(rule), percent, rule.fewer.to_string(), rule.more.to_string()]);
        }
        columns.row(row);
    }
    columns.text()
}

/// The team moves to each of [`GOALS`], if it is reached.
fn reached(report: &Report, due: &[Cell]) -> [Option<u32>; GOALS.len()] {
    let last =
        due.iter().map(|&cell| report.chart.step(cell)).try_fold(0, |last, step| Some(last.max(step?)));
    [report.reached(Milestone::Half), report.reached(Milestone::ThreeQuarters), last, Some(report.steps)]
}

impl OfRule {
    fn of(rule: usize, moves: &[[Option<u32>; RULES.len()]]) -> Self {
        let reached = moves.iter().filter(|moves| moves[rule].is_some()).count() as u32;
        let pairs: Vec<(u32, u32)> = moves.iter().filter_map(|moves| moves[rule].zip(moves[0])).collect();
        let sums = pairs.iter().fold(Moments::default(), |sums, &(own, _)| sums.and(Moments::of(own.into())));
        let real: Vec<(f64, f64)> = pairs.iter().map(|&(own, other)| (own.into(), other.into())).collect();
        let ratio = Estimate::of_ratio(&real);
        Self {
            rule: RULES[rule].as_str(),
            reached,
            mean: sums.estimate().map(|estimate| hundredths(estimate.mean)),
            ratio: ratio.map(|ratio| hundredths(ratio.mean)),
            interval: ratio.and_then(|ratio| ratio.interval).map(|interval| interval.map(hundredths)),
            slower: pairs.iter().filter(|(own, other)| own > other).count() as u32,
        }
    }
}

impl Explored {
    fn of(rule: usize, explored: &[[u32; RULES.len()]]) -> Self {
        let pairs: Vec<(f64, f64)> =
            explored.iter().map(|explored| (explored[rule].into(), explored[0].into())).collect();
        let own = pairs.iter().map(|&(own, _)| own).collect::<Vec<_>>();
        Self {
            rule: RULES[rule].as_str(),
            mean: Estimate::of_values(&own).map(|estimate| hundredths(estimate.mean)),
            percent: Estimate::of_ratio(&pairs).map(|ratio| ratio.times(100.0)),
            fewer: pairs.iter().filter(|(own, other)| own < other).count() as u32,
            more: pairs.iter().filter(|(own, other)| own > other).count() as u32,
        }
    }
}

fn mean(rule: &OfRule) -> String {
    rule.mean.map_or("-".to_owned(), |mean| format!("{mean:.1}"))
}

fn ratio(rule: &OfRule) -> String {
    match (rule.ratio, rule.interval) {
        (Some(ratio), Some([_, high])) => format!("{ratio:.2} ± {:.2}", high - ratio),
        (Some(ratio), None) => format!("{ratio:.2}"),
        (None, _) => "-".to_owned(),
    }
}

//! The reel against the repaired chain, with and without *Hold*, and with robots that keep apart, on the same layouts:
//! team moves to 50 % and 75 % of the cells, to everything within reach, and of whole runs, and how many cells they
//! explore. Sums are whole numbers, so that the result is the same on any number of threads.

use tautline_kernel::ground::Cell;
use tautline_proofs::chain::links::within_reach;

use super::prelude::*;
use tautline_sim::explore::chain::{APART, CHAIN, REEL, UNHELD};
use tautline_sim::explore::{Milestone, Report, RuleId, Setup, explore};

/// The team of the paper.
const ROBOTS: u16 = 8;

/// The rules; the first is what the others are compared with.
const RULES: [RuleId; 4] = [RuleId::REPAIRED, REEL, UNHELD, APART];

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

/// The milestones that are counted.
const GOALS: [&str; 4] = ["50 %", "75 %", "everything within reach", "the end of the run"];

/// The reel against the repaired chain.
#[derive(Clone, Copy, Debug)]
pub struct Reel;

settings! {
    /// How much is measured.
    #[derive(Copy, Eq)]
    pub struct Settings {
        /// Random layouts at each density
        pub layouts: u32 = 100, one("runs", "COUNT", from_to(1..=1_000_000));
        /// The seed of the first layout; the others have the seeds after it
        pub seed: u64 = 0, one("seed", "SEED", number);
    }
}

/// A run of every rule in one layout of a ground, by its place in [`GROUNDS`].
type Job = Run<usize>;

/// The outcome of one run.
#[derive(Clone, Copy, PartialEq, Eq, Default, Debug, Serialize, Deserialize)]
pub struct Outcome {
    /// By goal: the team moves.
    moves: [Option<u32>; GOALS.len()],
    /// Cells that it has explored at its end.
    explored: u32,
}

/// The whole table.
#[derive(Clone, PartialEq, Debug, JsonSchema, Serialize)]
pub struct Summary {
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
    /// The milestone.
    pub goal: &'static str,
    /// The generator of the layouts.
    pub ground: &'static str,
    /// How many layouts there are.
    pub runs: u32,
    /// For each rule.
    pub rules: Vec<RuleLine>,
}

/// Team moves by one rule.
#[derive(Clone, PartialEq, Debug, JsonSchema, Serialize)]
pub struct RuleLine {
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
    pub rules: Vec<Exploration>,
}

/// The cells that runs by one rule explore.
#[derive(Clone, PartialEq, Debug, JsonSchema, Serialize)]
pub struct Exploration {
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
    type Sample = [Outcome; RULES.len()];
    type Summary = Summary;

    fn about(&self) -> Description {
        Description {
            id: "reel",
            shows: "the reel against the repaired chain on the same layouts: mean team moves to 50 %, to 75 %, and to \
                    everything within reach, and the cells that it explores",
            help: "How many team moves the reel saves, and what holding and keeping apart cost",
            examples: &["reel", "reel --runs 1000 --format json"],
            doing: "comparing",
            takes: "some seconds",
            ..Description::NOTHING
        }
    }

    fn jobs(&self, settings: &Settings) -> Result<Vec<Job>, Halt> {
        let is_random = |ground: usize| GROUNDS[ground].starts_with("walls");
        Ok(runs(0..GROUNDS.len(), |ground| if is_random(ground) { settings.layouts } else { 1 }))
    }

    fn measure(&self, settings: &Settings, run: &Job, _: &dyn Observer) -> Result<Self::Sample, Halt> {
        let ground = GROUNDS.get(run.at).copied().unwrap_or_default();
        let seed = run.seed(settings.seed);
        let (layout, base) = based(generated(ground, seed)?)?;
        let mut outcomes = Self::Sample::default();
        for (outcome, rule) in outcomes.iter_mut().zip(RULES) {
            let setup = Setup { seed, ..Setup::new(&CHAIN, rule, ROBOTS, layout.clone(), base) };
            let report = explore(&setup, &mut |_| Ok(()))?;
            if let Some(violation) = report.violations.first() {
                let broken = format_args!("the rule {rule} breaks {} in {ground}", violation.clause);
                let remedy =
                    format!("look at it with `tautline explore {ground} --rule {rule} --seed {seed}`");
                return Err(Diagnostic::of_field("reel", broken, remedy).into());
            }
            let due = within_reach(report.chart.area(), base, ROBOTS.into(), |edge| layout.is_open(edge));
            *outcome = Outcome { moves: reached(&report, &due), explored: report.explored };
        }
        Ok(outcomes)
    }

    fn merge(&self, settings: &Settings, results: Results<Self>) -> Result<Summary, Halt> {
        let grounds: Vec<[Vec<&Outcome>; RULES.len()]> =
            (0..GROUNDS.len()).map(|ground| of_teams(&results, ground)).collect();
        let mut lines = Vec::new();
        for (place, goal) in GOALS.into_iter().enumerate() {
            for (ground, outcomes) in GROUNDS.into_iter().zip(&grounds) {
                let rules = RULES.iter().zip(outcomes);
                let rules = rules.map(|(rule, own)| RuleLine::of(*rule, place, own, &outcomes[0])).collect();
                lines.push(Line { goal, ground, runs: outcomes[0].len() as u32, rules });
            }
        }
        let cells = GROUNDS.into_iter().zip(&grounds).map(|(ground, outcomes)| {
            let rules = RULES.iter().zip(outcomes);
            let rules = rules.map(|(rule, own)| Exploration::of(*rule, own, &outcomes[0])).collect();
            Cells { ground, rules }
        });
        Ok(Summary { robots: ROBOTS, seed: settings.seed, lines, cells: cells.collect() })
    }

    fn text(&self, settings: &Settings, merged: &Summary) -> Result<String, Halt> {
        let mut text = format!(
            "{ROBOTS} robots, {} at each density, seeds from {}\n",
            counted(settings.layouts, "layout"),
            settings.seed
        );
        for goal in GOALS {
            let lines = merged.lines.iter().filter(|line| line.goal == goal);
            text += &moves(goal, lines);
        }
        Ok(text + &cells(&merged.cells))
    }
}

/// The team moves to a goal, for people.
fn moves<'a>(goal: &str, lines: impl Iterator<Item = &'a Line>) -> String {
    let reached = |line: &Line| -> String {
        let reached: Vec<String> = line.rules.iter().map(|rule| rule.reached.to_string()).collect();
        format!("{} of {}", reached.join(", "), line.runs)
    };
    let mut columns = Columns::of(lines)
        .title(format!(
            "Mean team moves to {goal}; ratios to the repaired rule with their 95 % intervals; layouts in which a rule \
             is slower"
        ))
        .left("layouts", |line| line.ground)
        .number("repaired", 1, |line| line.rules[0].mean);
    for (place, rule) in RULES.iter().enumerate().skip(1) {
        columns = columns
            .number(rule.as_str(), 1, move |line| line.rules[place].mean)
            .right("ratio", move |line| line.rules[place].ratio())
            .right("slower", move |line| line.rules[place].slower);
    }
    columns.right("reached/runs", reached).text()
}

/// The cells that runs explore, for people.
fn cells(cells: &[Cells]) -> String {
    let mut columns = Columns::of(cells)
        .title(
            "Mean cells explored; in % of those of the repaired rule with their 95 % intervals; layouts in \
             which a rule explores fewer cells, and more",
        )
        .left("layouts", |line| line.ground)
        .number("repaired", 1, |line| line.rules[0].mean);
    for (place, rule) in RULES.iter().enumerate().skip(1) {
        columns = columns
            .number(rule.as_str(), 1, move |line| line.rules[place].mean)
            .estimate("in %", 2, move |line| line.rules[place].percent)
            .right("fewer", move |line| line.rules[place].fewer)
            .right("more", move |line| line.rules[place].more);
    }
    columns.text()
}

/// The team moves to each of [`GOALS`], if it is reached.
fn reached(report: &Report, due: &[Cell]) -> [Option<u32>; GOALS.len()] {
    let last =
        due.iter().map(|&cell| report.chart.step(cell)).try_fold(0, |last, step| Some(last.max(step?)));
    [report.reached(Milestone::Half), report.reached(Milestone::ThreeQuarters), last, Some(report.steps)]
}

impl RuleLine {
    /// The team moves of runs to a goal, against those of the repaired rule.
    fn of(rule: RuleId, goal: usize, own: &[&Outcome], repaired: &[&Outcome]) -> Self {
        let both = own.iter().zip(repaired).filter_map(|(own, other)| own.moves[goal].zip(other.moves[goal]));
        let pairs: Vec<(f64, f64)> = both.map(|(own, other)| (own.into(), other.into())).collect();
        let ratio = Estimate::of_ratio(&pairs);
        Self {
            rule: rule.as_str(),
            reached: count(own, |own| own.moves[goal].is_some()),
            mean: mean(pairs.iter().map(|&(own, _)| own)).map(|mean| hundredths(mean.mean)),
            ratio: ratio.map(|ratio| hundredths(ratio.mean)),
            interval: ends(ratio).map(|interval| interval.map(hundredths)),
            slower: count(&pairs, |(own, other)| own > other),
        }
    }

    fn ratio(&self) -> String {
        match (self.ratio, self.interval) {
            (Some(ratio), Some([_, high])) => format!("{ratio:.2} ± {:.2}", high - ratio),
            (Some(ratio), None) => format!("{ratio:.2}"),
            (None, _) => "-".to_owned(),
        }
    }
}

impl Exploration {
    /// The cells that runs explore, against those of the repaired rule.
    fn of(rule: RuleId, own: &[&Outcome], repaired: &[&Outcome]) -> Self {
        let both = own.iter().zip(repaired);
        let pairs: Vec<(f64, f64)> =
            both.map(|(own, other)| (own.explored.into(), other.explored.into())).collect();
        Self {
            rule: rule.as_str(),
            mean: mean(pairs.iter().map(|&(own, _)| own)).map(|mean| hundredths(mean.mean)),
            percent: Estimate::of_ratio(&pairs).map(|ratio| ratio.times(100.0)),
            fewer: count(&pairs, |(own, other)| own < other),
            more: count(&pairs, |(own, other)| own > other),
        }
    }
}

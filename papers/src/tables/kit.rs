//! KIT [Peiris, 6] on random lattices: how long one robot and two take to find the nodes (Fig. 9), and what is driven
//! by both when 23 of 26 paths are explored (Fig. 14).
//!
//! The paper gives neither its map nor its speeds. From its 88 % and 78 % follow 26 paths, of which 23 are explored and
//! 5 driven by both. So every layout here has 26 paths, all within reach of a node that is drawn as the start, and
//! there are four families of them: compact, long and branching ones. As published both robots start there, one after
//! the other; repaired the second one starts beside. Robots drive at 0.3 m/s, unless it is asked for something else,
//! and each drive is up to a tenth faster or slower; with equal speeds, robots as published may drive to and fro for
//! ever.

mod drawn;
mod lattice;
mod printed;

use std::num::NonZeroU32;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use tautline_kernel::ground::Cell;
use tautline_kernel::kit::Rule;

use self::lattice::FAMILIES;
use super::parameter::{Parameter, put, shown};
use super::{About, Chart, Observer, Table, unfit};
use tautline_field::stats::Estimate;
use tautline_sim::diagnostic::Halt;
use tautline_sim::explore::RuleName;
use tautline_sim::kit::{self, Pace, REACH_MILLIMETRES};
use tautline_sim::layout::Layout;
use tautline_sim::value_parser::{number, within};

/// Paths of every layout, and how many of them are explored at the paper's 88 %.
pub const PATHS: usize = 26;
/// 88 % of them.
pub const EXPLORED: usize = 23;

/// Robots under one rule.
#[derive(Clone, Copy, PartialEq, Eq, Debug, JsonSchema, Serialize)]
pub struct Team {
    /// The rule.
    pub rule: RuleName,
    /// How many.
    pub robots: usize,
}

/// The teams that are compared.
pub const TEAMS: [Team; 5] = [
    Team { rule: RuleName::Published, robots: 1 },
    Team { rule: RuleName::Published, robots: 2 },
    Team { rule: RuleName::Repaired, robots: 1 },
    Team { rule: RuleName::Repaired, robots: 2 },
    Team { rule: RuleName::Repaired, robots: 3 },
];

/// One robot and two as published, which the paper compares.
const ONE: usize = 0;
const TWO: usize = 1;

/// Drives without a new path after which a run is ended.
const PATIENCE: usize = 1000 * PATHS;

/// How long it takes to find the nodes.
pub const KIT_FIG9: Kit = Kit {
    figure: Figure::Time,
    id: "kit-fig9",
    shows: "KIT: how long one robot and two take to find the nodes of random lattices",
    help: "How long robots that keep in touch take to find the nodes",
};

/// What is driven by both.
pub const KIT_FIG14: Kit = Kit {
    figure: Figure::Overlap,
    id: "kit-fig14",
    shows: "KIT: how many of the explored paths are driven by both robots when 88 % are explored, and how long all take",
    help: "How much robots that keep in touch overlap",
};

/// Robots that keep in touch on random lattices.
#[derive(Clone, Copy, Debug)]
pub struct Kit {
    figure: Figure,
    id: &'static str,
    shows: &'static str,
    help: &'static str,
}

#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Figure {
    Time,
    Overlap,
}

/// How much is measured.
#[derive(Clone, Copy, PartialEq, Eq, Debug, JsonSchema, Serialize, Deserialize)]
pub struct Settings {
    /// Layouts of each family.
    pub layouts: u32,
    /// The seed of the first one.
    pub seed: u64,
    /// Millimetres a second.
    pub speed: NonZeroU32,
    /// How much faster or slower a drive may be, in thousandths.
    pub spread: u32,
}

impl Default for Settings {
    fn default() -> Self {
        Self { layouts: 1000, seed: 0, speed: Pace::STEADY.speed, spread: 100 }
    }
}

/// One layout, for every team.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize)]
pub struct Job {
    family: usize,
    seed: u64,
}

/// What came of one run.
#[derive(Clone, PartialEq, Eq, Debug, JsonSchema, Serialize, Deserialize)]
pub struct Outcome {
    /// Milliseconds until each path is driven, in the order in which they are; as many as are.
    paths: Vec<u64>,
    /// Of so many paths, those that are driven by more than one robot, when as many are explored.
    overlaps: Vec<u16>,
    /// Milliseconds until each node is found.
    nodes: Vec<u64>,
    /// Whether a robot was out of contact.
    is_cut: bool,
}

/// The whole figure.
#[derive(Clone, PartialEq, Debug, JsonSchema, Serialize)]
pub struct Merged {
    #[serde(flatten)]
    settings: Settings,
    /// Family by family, each of all teams.
    pub lines: Vec<Line>,
    /// Two robots against one, as published, for each family.
    pub races: Vec<Race>,
    paper: Vec<printed::Printed>,
}

/// A team in a family.
#[derive(Clone, PartialEq, Debug, JsonSchema, Serialize)]
pub struct Line {
    /// The family.
    pub family: &'static str,
    /// The team.
    #[serde(flatten)]
    pub team: Team,
    /// Of the paths explored at 88 %, those driven by one robot alone, in percent; of one robot there is none.
    pub efficiency: Option<Estimate>,
    /// Seconds until 88 % of the paths are explored.
    pub most: Option<Estimate>,
    /// Seconds until all are.
    pub all: Option<Estimate>,
    /// Runs in which a robot was out of contact, in percent.
    pub cut: Option<Estimate>,
    /// Runs that were ended before all paths were driven.
    pub ended: u32,
    /// Seconds until each node is found, over the runs that find all.
    pub nodes: Vec<Estimate>,
    /// The efficiency when so many paths are explored, from 1 on.
    pub efficiencies: Vec<Estimate>,
}

/// Two robots against one.
#[derive(Clone, PartialEq, Debug, JsonSchema, Serialize)]
pub struct Race {
    /// The family.
    pub family: &'static str,
    /// Seconds by which two find all nodes sooner, over the layouts in which both do.
    pub gain: Option<Estimate>,
    /// Layouts in which they are sooner, in percent.
    pub sooner: Option<Estimate>,
}

impl Table for Kit {
    type Settings = Settings;
    type Job = Job;
    type Measured = [Outcome; TEAMS.len()];
    type Merged = Merged;

    fn about(&self) -> About {
        About {
            id: self.id,
            shows: self.shows,
            help: self.help,
            more: "",
            examples: &["kit-fig14 --svg overlap.svg", "kit-fig9 --layouts 100 --format json"],
            doing: "driving",
        }
    }

    fn parameters(&self) -> Vec<Parameter<Settings>> {
        vec![
            Parameter::one(
                "layouts",
                "COUNT",
                "Random layouts of each family",
                |all| shown(&all.layouts),
                |all, texts| put(&mut all.layouts, texts, |text| within(text, &(1..=100_000_i64))),
            ),
            Parameter::one(
                "seed",
                "SEED",
                "The seed of the first layout and its runs; the others have the seeds after it",
                |all| shown(&all.seed),
                |all, texts| put(&mut all.seed, texts, number),
            ),
            Parameter::one(
                "speed",
                "MM/S",
                "How fast robots drive, in millimetres a second",
                |all| shown(&all.speed),
                |all, texts| {
                    put(&mut all.speed, texts, |text| {
                        let speed: u32 = within(text, &(1..=100_000_i64))?;
                        NonZeroU32::new(speed)
                            .ok_or_else(|| "a robot that stands still finds nothing".to_owned())
                    })
                },
            ),
            Parameter::one(
                "spread",
                "THOUSANDTHS",
                "How much faster or slower a drive may be, in thousandths",
                |all| shown(&all.spread),
                |all, texts| put(&mut all.spread, texts, |text| within(text, &(0..=900_i64))),
            ),
        ]
    }

    fn charts(&self) -> Vec<Chart<Self>> {
        let draw =
            |kit: &Self, _: &Settings, merged: &Merged| Ok(drawn::chart(kit.figure, &merged.lines).svg());
        vec![Chart { name: "svg", about: "Store a chart", draw }]
    }

    fn jobs(&self, settings: &Settings) -> Result<Vec<Job>, Halt> {
        let Settings { layouts, seed, .. } = *settings;
        let of =
            |family| (0..u64::from(layouts)).map(move |index| Job { family, seed: seed.wrapping_add(index) });
        Ok((0..FAMILIES.len()).flat_map(of).collect())
    }

    fn parts(&self, _: &Job) -> u64 {
        TEAMS.len() as u64
    }

    fn measure(&self, settings: &Settings, job: &Job, _: &dyn Observer) -> Result<Self::Measured, Halt> {
        let family = FAMILIES.get(job.family).copied().unwrap_or(FAMILIES[0]);
        let (layout, start) = family.layout(job.seed).map_err(|problem| unfit(&problem))?;
        let pace = Pace { speed: settings.speed, spread: settings.spread };
        Ok(TEAMS.map(|team| follow(team, &layout, start, pace, job.seed)))
    }

    fn merge(&self, settings: &Settings, results: Vec<(Job, Self::Measured)>) -> Result<Merged, Halt> {
        let of = |family: usize| results.iter().filter(move |(job, _)| job.family == family);
        let lines = (0..FAMILIES.len()).flat_map(|family| {
            (0..TEAMS.len()).map(move |team| {
                let outcomes: Vec<&Outcome> = of(family).map(|(_, outcomes)| &outcomes[team]).collect();
                Line::of(FAMILIES[family].name, TEAMS[team], &outcomes)
            })
        });
        let lines: Vec<Line> = lines.collect();
        let race = |family: usize| {
            let pairs = of(family).map(|(_, outcomes)| (&outcomes[ONE], &outcomes[TWO]));
            Race::of(FAMILIES[family].name, &pairs.collect::<Vec<_>>())
        };
        let races: Vec<Race> = (0..FAMILIES.len()).map(race).collect();
        let paper = printed::of(self.figure, &lines, &races);
        Ok(Merged { settings: *settings, lines, races, paper })
    }

    fn text(&self, settings: &Settings, merged: &Merged) -> Result<String, Halt> {
        Ok(printed::text(self.figure, settings, merged))
    }

    /// A repaired team always keeps in touch, and one or two of its robots drive every path.
    fn is_broken(&self, merged: &Merged) -> bool {
        let is_broken = |line: &&Line| {
            line.ended > 0 && line.team.robots < 3 || line.cut.is_some_and(|cut| cut.mean > 0.0)
        };
        let mut repaired = merged.lines.iter().filter(|line| line.team.rule == RuleName::Repaired);
        repaired.any(|line| is_broken(&line))
    }
}

fn follow(team: Team, layout: &Layout, start: Cell, pace: Pace, seed: u64) -> Outcome {
    let (rule, starts) = match team.rule {
        RuleName::Published => (Rule::PUBLISHED, vec![start; team.robots]),
        RuleName::Repaired => (Rule::REPAIRED, kit::starts(layout, start, team.robots)),
    };
    let mut outcome = Outcome { paths: Vec::new(), overlaps: Vec::new(), nodes: vec![0], is_cut: false };
    let Ok(mut course) = kit::course(rule, layout, &starts, pace, seed) else { return outcome };
    let mut found = starts;
    found.sort_unstable();
    found.dedup();
    outcome.nodes = vec![0; found.len()];
    let mut idle = 0;
    while outcome.paths.len() < PATHS
        && idle < PATIENCE
        && let Some(drive) = course.drive()
    {
        idle = if drive.is_new { 0 } else { idle + 1 };
        let [_, end] = drive.time;
        if drive.is_new {
            outcome.paths.push(end);
            let shared = course.driven().values().filter(|robots| robots.count_ones() > 1).count();
            outcome.overlaps.push(shared as u16);
        }
        if !found.contains(&drive.to) {
            found.push(drive.to);
            outcome.nodes.push(end);
        }
    }
    outcome.paths.sort_unstable();
    outcome.nodes.sort_unstable();
    outcome.is_cut = course.apart() > REACH_MILLIMETRES * REACH_MILLIMETRES;
    outcome
}

/// Seconds.
#[expect(clippy::cast_precision_loss, reason = "no run takes 2⁵³ milliseconds")]
const fn seconds(milliseconds: u64) -> f64 {
    milliseconds as f64 / 1000.0
}

/// The mean of those that are there.
fn mean(values: impl Iterator<Item = f64>) -> Option<Estimate> {
    Estimate::of_values(&values.collect::<Vec<_>>())
}

impl Outcome {
    fn is_whole(&self) -> bool {
        self.paths.len() == PATHS
    }

    /// Of so many explored paths, those driven by one robot alone, in percent.
    fn efficiency(&self, explored: usize) -> Option<f64> {
        let shared = f64::from(*self.overlaps.get(explored.checked_sub(1)?)?);
        let explored = explored as u32;
        Some(100.0 * (1.0 - shared / f64::from(explored)))
    }
}

impl Line {
    fn of(family: &'static str, team: Team, outcomes: &[&Outcome]) -> Self {
        let path = |number: usize| {
            mean(outcomes.iter().filter_map(|outcome| outcome.paths.get(number - 1)).map(|&end| seconds(end)))
        };
        let is_team = team.robots > 1;
        let efficiency = |explored| mean(outcomes.iter().filter_map(|outcome| outcome.efficiency(explored)));
        let whole = || outcomes.iter().filter(|outcome| outcome.is_whole());
        let nodes = outcomes.iter().map(|outcome| outcome.nodes.len()).max().unwrap_or(0);
        let node = |number: usize| {
            mean(whole().filter_map(|outcome| outcome.nodes.get(number)).map(|&end| seconds(end)))
        };
        let count = outcomes.len() as u32;
        let cut = outcomes.iter().filter(|outcome| outcome.is_cut).count() as u32;
        Self {
            family,
            team,
            efficiency: efficiency(EXPLORED).filter(|_| is_team),
            most: path(EXPLORED),
            all: path(PATHS),
            cut: Estimate::share(cut, count).map(|share| share.times(100.0)).filter(|_| is_team),
            ended: count - whole().count() as u32,
            nodes: (0..nodes).filter_map(node).collect(),
            efficiencies: if is_team { (1..=PATHS).filter_map(efficiency).collect() } else { Vec::new() },
        }
    }
}

impl Race {
    fn of(family: &'static str, pairs: &[(&Outcome, &Outcome)]) -> Self {
        let whole = || pairs.iter().filter(|(one, two)| one.is_whole() && two.is_whole());
        let last = |outcome: &Outcome| outcome.nodes.last().copied().unwrap_or(0);
        let gain = |&(one, two): &(&Outcome, &Outcome)| seconds(last(one)) - seconds(last(two));
        let sooner = whole().filter(|(one, two)| last(two) < last(one)).count() as u32;
        let count = whole().count() as u32;
        Self {
            family,
            gain: mean(whole().map(gain)),
            sooner: Estimate::share(sooner, count).map(|share| share.times(100.0)),
        }
    }
}

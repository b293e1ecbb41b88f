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

use tautline_kernel::ground::Cell;
use tautline_kernel::kit::Rule;

use self::lattice::FAMILIES;
use super::prelude::*;
use tautline_sim::explore::RuleName;
use tautline_sim::kit::{self, Pace, REACH_MILLIMETRES};
use tautline_sim::layout::Layout;

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
pub const KIT_FIG9: Kit = Kit::of(
    Figure::Time,
    "kit-fig9",
    "KIT: how long one robot and two take to find the nodes of random lattices",
    "How long robots that keep in touch take to find the nodes",
);

/// Figure 14: how much both robots drive.
pub const KIT_FIG14: Kit = Kit::of(
    Figure::Overlap,
    "kit-fig14",
    "KIT: how many of the explored paths are driven by both robots when 88 % are explored, and how long all take",
    "How much robots that keep in touch overlap",
);

/// Robots that keep in touch on random lattices.
#[derive(Clone, Copy, Debug)]
pub struct Kit {
    figure: Figure,
    about: Description,
}

impl Kit {
    const fn of(figure: Figure, id: &'static str, shows: &'static str, help: &'static str) -> Self {
        let examples = &["kit-fig14 --svg overlap.svg", "kit-fig9 --layouts 100 --format json"];
        let pictures = &[("svg", "Store a chart")];
        Self {
            figure,
            about: Description {
                id,
                shows,
                help,
                examples,
                doing: "driving",
                pictures,
                ..Description::NOTHING
            },
        }
    }
}

#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Figure {
    Time,
    Overlap,
}

settings! {
    /// How much is measured.
    #[derive(Copy, Eq)]
    pub struct Settings {
        /// Random layouts of each family
        pub layouts: u32 = 1000, one("layouts", "COUNT", from_to(1..=100_000));
        /// The seed of the first layout and its runs; the others have the seeds after it
        pub seed: u64 = 0, one("seed", "SEED", number);
        /// How fast robots drive, in millimetres a second
        pub speed: NonZeroU32 = Pace::STEADY.speed, one("speed", "MM/S", speed);
        /// How much faster or slower a drive may be, in thousandths
        pub spread: u32 = 100, one("spread", "THOUSANDTHS", from_to(0..=900));
    }
}

fn speed(text: &str) -> Result<NonZeroU32, String> {
    let speed = from_to(1..=100_000)(text)?;
    NonZeroU32::new(speed).ok_or_else(|| "a robot that stands still finds nothing".to_owned())
}

/// A run of every team in one layout of a family.
type Job = Run<usize>;

/// The outcome of one run.
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
pub struct Summary {
    #[serde(flatten)]
    settings: Settings,
    /// Family by family, each of all teams.
    pub lines: Vec<Line>,
    /// Two robots against one, as published, for each family.
    pub races: Vec<Race>,
    paper: Vec<PrintedFigure>,
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
    type Sample = [Outcome; TEAMS.len()];
    type Summary = Summary;

    fn about(&self) -> Description {
        self.about
    }

    fn jobs(&self, settings: &Settings) -> Result<Vec<Job>, Halt> {
        Ok(runs(0..FAMILIES.len(), |_| settings.layouts))
    }

    fn parts(&self, _: &Job) -> u64 {
        TEAMS.len() as u64
    }

    fn measure(&self, settings: &Settings, run: &Job, _: &dyn Observer) -> Result<Self::Sample, Halt> {
        let family = FAMILIES.get(run.at).copied().unwrap_or(FAMILIES[0]);
        let seed = run.seed(settings.seed);
        let (layout, start) = family.layout(seed)?;
        let pace = Pace { speed: settings.speed, spread: settings.spread };
        Ok(TEAMS.map(|team| follow(team, &layout, start, pace, seed)))
    }

    fn merge(&self, settings: &Settings, results: Results<Self>) -> Result<Summary, Halt> {
        let (mut lines, mut races) = (Vec::new(), Vec::new());
        for (place, family) in FAMILIES.into_iter().enumerate() {
            let teams = of_teams(&results, place);
            lines.extend(TEAMS.into_iter().zip(&teams).map(|(team, all)| Line::of(family.name, team, all)));
            races.push(Race::of(family.name, &teams[ONE], &teams[TWO]));
        }
        let paper = printed::of(self.figure, &lines, &races);
        Ok(Summary { settings: *settings, lines, races, paper })
    }

    fn text(&self, settings: &Settings, merged: &Summary) -> Result<String, Halt> {
        Ok(printed::text(self.figure, settings, merged))
    }

    fn draw(&self, _: usize, _: &Settings, merged: &Summary) -> Result<String, Halt> {
        Ok(drawn::chart(self.figure, &merged.lines).svg())
    }

    /// A repaired team always keeps in touch, and one or two of its robots drive every path.
    fn is_broken(&self, merged: &Summary) -> bool {
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
        let cut = share(outcomes, |outcome| outcome.is_cut).filter(|_| is_team);
        Self {
            family,
            team,
            efficiency: efficiency(EXPLORED).filter(|_| is_team),
            most: path(EXPLORED),
            all: path(PATHS),
            cut: cut.map(|share| share.times(100.0)),
            ended: count(outcomes, |outcome| !outcome.is_whole()),
            nodes: (0..nodes).filter_map(node).collect(),
            efficiencies: if is_team { (1..=PATHS).filter_map(efficiency).collect() } else { Vec::new() },
        }
    }
}

impl Race {
    fn of(family: &'static str, one: &[&Outcome], two: &[&Outcome]) -> Self {
        let last = |outcome: &Outcome| outcome.nodes.last().copied().unwrap_or(0);
        let whole = one.iter().zip(two).filter(|(one, two)| one.is_whole() && two.is_whole());
        let lasts: Vec<(u64, u64)> = whole.map(|(one, two)| (last(one), last(two))).collect();
        Self {
            family,
            gain: mean(lasts.iter().map(|&(one, two)| seconds(one) - seconds(two))),
            sooner: share(&lasts, |(one, two)| two < one).map(|share| share.times(100.0)),
        }
    }
}

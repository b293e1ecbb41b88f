//! KIT [Peiris, 6] on random lattices: how long one robot and two take to find the nodes (Fig. 9), and what is driven
//! by both when 23 of 26 paths are explored (Fig. 14).
//!
//! The paper gives neither its map nor its speeds. From its 88 % and 78 % follow 26 paths, of which 23 are
//! explored and 5 driven by both. So every layout here has 26 paths, all within reach of a node that is drawn as
//! the start, and there are four families of them: compact, long and branching ones. As published both robots
//! start there, one after the other, and run KIT at every node, our main reading, or only where the way ahead is
//! blocked, as the words of section 3 have it; repaired the second one starts beside. Robots drive at 0.3 m/s,
//! unless it is asked for something else, and each drive is up to a tenth faster or slower; with equal speeds,
//! robots as published may drive to and fro for ever.

mod charts;
mod lattice;
mod range;
mod text;

use std::num::NonZeroU32;

use tautline_kernel::ground::Cell;
use tautline_kernel::kit::Rule;

use self::lattice::{FAMILIES, Family};
pub use self::range::KitRange;
use super::paper;
use super::prelude::*;
use tautline_grids::layout::Layout;
use tautline_sim::kit::{self, Pace};

/// Paths of every layout, and how many of them are explored at the paper's 88 %.
pub const PATHS: usize = 26;
/// 88 % of them.
pub const EXPLORED: usize = 23;

/// The rule of a team.
#[derive(Clone, Copy, PartialEq, Eq, Debug, JsonSchema, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum TeamRule {
    /// As published, KIT at every node.
    Published,
    /// As published, KIT only where the way ahead is blocked.
    Ahead,
    /// With the repairs of its refuted claims.
    Repaired,
}

/// Robots under one rule.
#[derive(Clone, Copy, PartialEq, Eq, Debug, JsonSchema, Serialize)]
pub struct Team {
    /// The rule.
    pub rule: TeamRule,
    /// How many.
    pub robots: usize,
}

/// The teams that are compared.
pub const TEAMS: [Team; 7] = [
    Team { rule: TeamRule::Published, robots: 1 },
    Team { rule: TeamRule::Published, robots: 2 },
    Team { rule: TeamRule::Ahead, robots: 1 },
    Team { rule: TeamRule::Ahead, robots: 2 },
    Team { rule: TeamRule::Repaired, robots: 1 },
    Team { rule: TeamRule::Repaired, robots: 2 },
    Team { rule: TeamRule::Repaired, robots: 3 },
];

/// Places in [`TEAMS`] of a team and the one that is to be sooner: two robots against one by each rule, as the paper
/// compares them, and two repaired robots against two by each reading.
const RACES: [[usize; 2]; 5] = [[0, 1], [2, 3], [4, 5], [1, 5], [3, 5]];

/// Drives without a new path after which a run is ended.
const PATIENCE: usize = 1000 * PATHS;

/// The description that both figures share.
const ABOUT: Description = Description {
    examples: &["kit-fig14 --svg overlap.svg", "kit-fig9 --runs 100 --format json"],
    doing: "driving",
    pictures: &[("svg", "Store a chart")],
    ..Description::NOTHING
};

/// How long it takes to find the nodes.
pub const KIT_FIG9: Kit = Kit {
    figure: Figure::Time,
    about: Description {
        id: "kit-fig9",
        shows: "KIT: how long one robot and two take to find the nodes of random lattices",
        help: "How long robots that keep in touch take to find the nodes",
        takes: "some seconds",
        ..ABOUT
    },
};

/// Figure 14: how much both robots drive.
pub const KIT_FIG14: Kit = Kit {
    figure: Figure::Overlap,
    about: Description {
        id: "kit-fig14",
        shows: "KIT: how many of the explored paths are driven by both robots when 88 % are explored, and \
            how long all take",
        help: "How much robots that keep in touch overlap",
        takes: "some seconds",
        ..ABOUT
    },
};

/// Robots that keep in touch on random lattices.
#[derive(Clone, Copy, Debug)]
pub struct Kit {
    figure: Figure,
    about: Description,
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
        pub layouts: u32 = 1000, one("runs", "COUNT", from_to(1..=100_000));
        /// The seed of the first layout and its runs; the others have the seeds after it
        pub seed: u64 = 0, one("seed", "SEED", number);
        /// How fast robots drive, in metres a second
        pub speed: NonZeroU32 = Pace::STEADY.speed, thousandths("speed", "METRES", 1..=100_000);
        /// By which share a drive may be faster or slower
        pub spread: u32 = 100, thousandths("spread", "SHARE", 0..=900);
    }
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
    /// Two robots against one, and repaired against published, for each family.
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
    /// Runs that reach 88 %, in percent.
    pub reached: Option<Estimate>,
    /// Paths explored when the run ends, in percent.
    pub explored: Option<Estimate>,
    /// Runs that were ended before all paths were driven, in percent.
    pub ended: Option<Estimate>,
    /// Runs that were ended before all nodes were found, in percent.
    pub lost: Option<Estimate>,
    /// Seconds until each node is found, over the runs that find all.
    pub nodes: Vec<Estimate>,
    /// Directions explored at nodes by then, two for each path that is driven.
    pub directions: Option<Estimate>,
    /// The efficiency when so many paths are explored, from 1 on.
    pub efficiencies: Vec<Estimate>,
}

/// A team against another one.
#[derive(Clone, PartialEq, Debug, JsonSchema, Serialize)]
pub struct Race {
    /// The family.
    pub family: &'static str,
    /// The other one.
    pub other: Team,
    /// The team that is to be sooner.
    pub team: Team,
    /// Seconds by which it finds all nodes sooner, over the layouts in which both do.
    pub gain: Option<Estimate>,
    /// Of these layouts, those in which it is sooner, in percent.
    pub sooner: Option<Estimate>,
    /// Of all layouts, those in which both find all nodes, in percent.
    pub both: Option<Estimate>,
    /// Of all layouts, those in which it finds all nodes sooner, or the other one never does, in percent.
    pub ahead: Option<Estimate>,
    /// Of all layouts, those in which it is the other way round, in percent.
    pub behind: Option<Estimate>,
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
            lines.extend(TEAMS.into_iter().zip(&teams).map(|(team, all)| Line::of(family, team, all)));
            races.extend(RACES.map(|places| Race::of(family, places, places.map(|place| &teams[place][..]))));
        }
        let paper = text::of(self.figure, &lines, &races);
        Ok(Summary { settings: *settings, lines, races, paper })
    }

    fn text(&self, settings: &Settings, merged: &Summary) -> Result<String, Halt> {
        Ok(text::told(self.figure, settings, merged))
    }

    fn sentences(&self, merged: &Summary) -> Vec<Judgement> {
        let mut judged = paper::judged(&merged.paper);
        if self.figure == Figure::Time {
            judged.extend(text::sooner(&merged.races));
            judged.extend(text::directions(&merged.lines));
        }
        judged
    }

    fn draw(&self, _: usize, _: &Settings, merged: &Summary) -> Result<String, Halt> {
        Ok(charts::chart(self.figure, &merged.lines).svg())
    }

    /// A repaired team always keeps in touch, and one or two of its robots drive every path.
    fn is_broken(&self, merged: &Summary) -> bool {
        let is_broken = |line: &&Line| is_any(line.ended) && line.team.robots < 3 || is_any(line.cut);
        let mut repaired = merged.lines.iter().filter(|line| line.team.rule == TeamRule::Repaired);
        repaired.any(|line| is_broken(&line))
    }
}

fn follow(team: Team, layout: &Layout, start: Cell, pace: Pace, seed: u64) -> Outcome {
    let (rule, starts) = match team.rule {
        TeamRule::Published => (Rule::PUBLISHED, vec![start; team.robots]),
        TeamRule::Ahead => (Rule::AHEAD, vec![start; team.robots]),
        TeamRule::Repaired => (Rule::REPAIRED, kit::starts(layout, start, team.robots)),
    };
    driven(rule, layout, starts, pace, seed)
}

/// The run of robots from `starts` until all paths are driven, or no new one has been for long.
fn driven(rule: Rule, layout: &Layout, starts: Vec<Cell>, pace: Pace, seed: u64) -> Outcome {
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
    outcome.is_cut = course.apart() > kit::reach_millimetres(rule.reach).pow(2);
    outcome
}

impl Outcome {
    fn is_whole(&self) -> bool {
        self.paths.len() == PATHS
    }

    /// When so many nodes, which are all, were found, in milliseconds; `None` if they were not.
    fn found(&self, nodes: usize) -> Option<u64> {
        self.nodes.get(nodes.checked_sub(1)?).copied()
    }

    /// The directions that are explored at nodes when all of so many nodes are found, two for each path.
    fn directions(&self, nodes: usize) -> Option<f64> {
        Some(self.directions_by(self.found(nodes)?))
    }

    /// The directions that are explored at nodes by this time, in milliseconds.
    fn directions_by(&self, end: u64) -> f64 {
        2.0 * f64::from(self.paths.iter().filter(|&&driven| driven <= end).count() as u32)
    }

    /// Of so many explored paths, those driven by one robot alone, in percent.
    fn efficiency(&self, explored: usize) -> Option<f64> {
        let shared = f64::from(*self.overlaps.get(explored.checked_sub(1)?)?);
        let explored = explored as u32;
        Some(100.0 * (1.0 - shared / f64::from(explored)))
    }

    /// The paths that were explored when the run ended, in percent.
    fn explored(&self) -> f64 {
        100.0 * f64::from(self.paths.len() as u32) / f64::from(PATHS as u32)
    }
}

impl Line {
    fn of(family: Family, team: Team, outcomes: &[&Outcome]) -> Self {
        let is_team = team.robots > 1;
        let efficiency = |explored| mean(outcomes.iter().filter_map(|outcome| outcome.efficiency(explored)));
        let node = |number: usize| {
            let found = outcomes.iter().filter(|outcome| outcome.found(family.nodes()).is_some());
            mean(found.filter_map(|outcome| outcome.nodes.get(number)).map(|&end| seconds(end)))
        };
        Self {
            family: family.name,
            team,
            efficiency: efficiency(EXPLORED).filter(|_| is_team),
            most: until(EXPLORED, outcomes),
            all: until(PATHS, outcomes),
            cut: in_percent(outcomes, |outcome| outcome.is_cut).filter(|_| is_team),
            reached: in_percent(outcomes, |outcome| outcome.paths.len() >= EXPLORED),
            explored: mean(outcomes.iter().map(|outcome| outcome.explored())),
            ended: in_percent(outcomes, |outcome| !outcome.is_whole()),
            lost: in_percent(outcomes, |outcome| outcome.found(family.nodes()).is_none()),
            nodes: (0..family.nodes()).filter_map(node).collect(),
            directions: mean(outcomes.iter().filter_map(|outcome| outcome.directions(family.nodes()))),
            efficiencies: if is_team { (1..=PATHS).filter_map(efficiency).collect() } else { Vec::new() },
        }
    }
}

impl Race {
    fn of(family: Family, places: [usize; 2], [other, team]: [&[&Outcome]; 2]) -> Self {
        let found = |outcome: &Outcome| outcome.found(family.nodes());
        let all: Vec<[Option<u64>; 2]> =
            other.iter().zip(team).map(|(other, team)| [found(other), found(team)]).collect();
        let both: Vec<[u64; 2]> = all.iter().filter_map(|&[other, team]| Some([other?, team?])).collect();
        let is_sooner = |one: Option<u64>, other: Option<u64>| {
            one.is_some_and(|one| other.is_none_or(|other| one < other))
        };
        let [first, second] = places.map(|place| TEAMS[place]);
        Self {
            family: family.name,
            other: first,
            team: second,
            gain: mean(both.iter().map(|&[other, team]| seconds(other) - seconds(team))),
            sooner: in_percent(&both, |[other, team]| team < other),
            both: in_percent(&all, |times| times.iter().all(Option::is_some)),
            ahead: in_percent(&all, |&[other, team]| is_sooner(team, other)),
            behind: in_percent(&all, |&[other, team]| is_sooner(other, team)),
        }
    }
}

/// Seconds until so many paths are explored, over the runs in which they are.
fn until(paths: usize, outcomes: &[&Outcome]) -> Option<Estimate> {
    mean(outcomes.iter().filter_map(|outcome| outcome.paths.get(paths - 1)).map(|&end| seconds(end)))
}

/// Whether some of the runs are such.
fn is_any(share: Option<Estimate>) -> bool {
    share.is_some_and(|share| share.mean > 0.0)
}

/// The share of those that are such, in percent.
fn in_percent<T>(all: &[T], is_such: impl Fn(&T) -> bool) -> Option<Estimate> {
    share(all, is_such).map(|share| share.times(100.0))
}

//! How many directions two and three repaired robots have explored at nodes, by how far they hear
//! each other. The paper's future work [Peiris, 7] is three robots with a higher communication
//! range. The lattices are those of `kit-fig14`.

use tautline_kernel::kit::{Reach, Rule};

use super::super::prelude::*;
use super::drive::{EXPLORED, Outcome, driven, in_percent, is_any, until};
use super::figure::Settings;
use super::lattice::{FAMILIES, PATHS};
use tautline_sim::kit::{Pace, starts};

/// Ranges in paths, of 3 m each; `None` is the paper's 10 m.
const RANGES: [Option<u16>; 5] = [Some(2), Some(3), None, Some(4), Some(5)];

/// The sizes of the teams.
const ROBOTS: [usize; 2] = [2, 3];

/// Seconds after which the directions are counted that are explored by then.
const AFTER: [u32; 2] = [60, 120];

/// A team: so many robots, and their range in paths.
type Team = (usize, Option<u16>);

fn teams() -> impl Iterator<Item = Team> {
    ROBOTS.into_iter().flat_map(|robots| RANGES.map(|paths| (robots, paths)))
}

/// The table of ranges.
#[derive(Clone, Copy, Debug)]
pub struct KitRange;

/// The whole table.
#[derive(Clone, PartialEq, Debug, JsonSchema, Serialize)]
pub struct Summary {
    #[serde(flatten)]
    settings: Settings,
    /// Family by family, each of all teams.
    pub lines: Vec<Line>,
}

/// A team in a family.
#[derive(Clone, PartialEq, Debug, JsonSchema, Serialize)]
pub struct Line {
    /// The family.
    pub family: &'static str,
    /// Robots.
    pub robots: usize,
    /// How far they hear each other, in metres.
    pub range_m: u16,
    /// Directions explored at nodes after 60 s and after 120 s, two for each path that is driven, of 52.
    pub directions: Vec<Estimate>,
    /// Seconds until 88 % of the paths are explored.
    pub most: Option<Estimate>,
    /// Seconds until all are.
    pub all: Option<Estimate>,
    /// Runs in which a robot was out of contact, in percent.
    pub cut: Option<Estimate>,
    /// Runs that were ended before all paths were driven, in percent.
    pub ended: Option<Estimate>,
}

impl Table for KitRange {
    type Settings = Settings;
    type Job = Run<usize>;
    type Sample = Vec<Outcome>;
    type Summary = Summary;

    fn about(&self) -> Description {
        Description {
            id: "kit-range",
            shows: "KIT: directions that two and three repaired robots explore \
                    at nodes, by how far they hear each other",
            help: "How many directions robots that keep in touch explore, by their range",
            examples: &["kit-range", "kit-range --runs 100 --format json"],
            doing: "driving",
            takes: "some seconds",
            ..Description::NOTHING
        }
    }

    fn jobs(&self, settings: &Settings) -> Result<Vec<Run<usize>>, Halt> {
        Ok(runs(0..FAMILIES.len(), |_| settings.layouts))
    }

    fn measure(&self, settings: &Settings, run: &Run<usize>, _: &dyn Observer) -> Result<Vec<Outcome>, Halt> {
        let seed = run.seed(settings.seed);
        let (layout, start) = FAMILIES[run.at].layout(seed)?;
        let pace = Pace { speed: settings.speed, spread: settings.spread };
        let drive = |(robots, paths): Team| {
            let reach = paths.and_then(Reach::of_paths).unwrap_or(Reach::PAPER);
            driven(Rule { reach, ..Rule::REPAIRED }, &layout, &starts(&layout, start, robots), pace, seed).0
        };
        Ok(teams().map(drive).collect())
    }

    fn merge(&self, settings: &Settings, results: Results<Self>) -> Result<Summary, Halt> {
        let mut lines = Vec::new();
        for (place, family) in FAMILIES.into_iter().enumerate() {
            let here = at(&results, place);
            for (number, team) in teams().enumerate() {
                let outcomes: Vec<&Outcome> = here.iter().filter_map(|all| all.get(number)).collect();
                lines.push(Line::of(family.name, team, &outcomes));
            }
        }
        Ok(Summary { settings: *settings, lines })
    }

    fn text(&self, settings: &Settings, merged: &Summary) -> Result<String, Halt> {
        let [first, second] = AFTER;
        let title = format!(
            "Directions explored at nodes, of {}, after {first} s and {second} s; seconds \
             until 88 % of the paths are explored, and all",
            2 * PATHS
        );
        let body = Columns::of(&merged.lines)
            .title(title)
            .left("family", |line| line.family)
            .right("robots", |line| line.robots)
            .right("range m", |line| line.range_m)
            .estimate(format!("after {first} s"), 1, |line| line.directions.first().copied())
            .estimate(format!("after {second} s"), 1, |line| line.directions.get(1).copied())
            .estimate("s to 88 %", 1, |line| line.most)
            .estimate("s to all", 1, |line| line.all)
            .text();
        Ok(super::text::head(settings) + &body)
    }

    /// A repaired team always keeps within its range, and drives every path.
    fn is_broken(&self, merged: &Summary) -> bool {
        merged.lines.iter().any(|line| is_any(line.cut) || is_any(line.ended))
    }
}

impl Line {
    fn of(family: &'static str, (robots, paths): Team, outcomes: &[&Outcome]) -> Self {
        let directions =
            |after: u32| mean(outcomes.iter().map(|outcome| outcome.directions_by(u64::from(after) * 1000)));
        Self {
            family,
            robots,
            range_m: paths.map_or(10, |paths| 3 * paths),
            directions: AFTER.into_iter().filter_map(directions).collect(),
            most: until(EXPLORED, outcomes),
            all: until(PATHS, outcomes),
            cut: in_percent(outcomes, |outcome| outcome.is_cut),
            ended: in_percent(outcomes, |outcome| !outcome.is_whole()),
        }
    }
}

//! Figure 8 of [Jiang 2011]: three robots come to three WFRs. The paper draws the ways in one network, and says that
//! robots reach the WFRs “for all simulated scenarios” (4.3) and that each WFR gets “one nearby” robot (1). Ours: how
//! often that is so in many networks, under MRC as published and repaired, without any fault, and how much farther the
//! robots have to go than under the best of all assignments. Both rules have the same networks.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use tautline_proofs::plural::counted;

use super::notice_fig5::{RANGE_M, SIDE_M};
use super::parameter::{Parameter, Senders, put, shown};
use super::{About, Chart, Observer, Table};
use tautline_field::draw::field::picture;
use tautline_field::draw::rescue::map;
use tautline_field::radio::{ChannelName, FREE_SPACE, Point};
use tautline_field::rescue::{CallTimes, Fate, Problem, Report, SchemeName, rescue};
use tautline_field::stats::{Estimate, decimals, rounded};
use tautline_field::tan::shortest_m;
use tautline_sim::diagnostic::{Diagnostic, Halt};
use tautline_sim::explore::RuleName;
use tautline_sim::text_table::Figures;
use tautline_sim::value_parser::{number, whole, within};

/// The robots of the figure.
const ROBOTS: usize = 3;

/// The WFRs of the figure.
const WFRS: usize = 3;

/// Nodes, which the paper does not tell: the middle of its range.
const NODES: usize = 700;

/// The most robots and WFRs: all assignments are tried.
const MOST: u64 = 6;

/// What the paper has, as a share of the topologies: all are served, each by a robot of its own.
const PAPER: f64 = 1.0;

/// Figure 8.
#[derive(Clone, Copy, Debug)]
pub struct RescueFig8;

/// What is measured.
#[derive(Clone, PartialEq, Eq, Debug, JsonSchema, Serialize, Deserialize)]
pub struct Settings {
    /// Nodes.
    pub nodes: usize,
    /// Robots.
    pub robots: usize,
    /// WFRs.
    pub wfrs: usize,
    /// The k of k-FNF.
    pub k: Senders,
    /// Topologies.
    pub topologies: u32,
    /// The seed of the first; the others follow.
    pub seed: u64,
}

impl Default for Settings {
    fn default() -> Self {
        Self { nodes: NODES, robots: ROBOTS, wfrs: WFRS, k: Senders::ONE, topologies: 200, seed: 0 }
    }
}

/// One topology under one rule.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize)]
pub struct Job {
    rule: RuleName,
    seed: u64,
}

/// The whole figure.
#[derive(Clone, PartialEq, Debug, JsonSchema, Serialize)]
pub struct Merged {
    #[serde(flatten)]
    settings: Settings,
    /// Rule by rule.
    pub rules: Vec<Line>,
}

/// One rule.
#[derive(Clone, PartialEq, Debug, JsonSchema, Serialize)]
pub struct Line {
    /// MRC as published, or repaired.
    pub rule: RuleName,
    /// The share of the topologies in which each WFR was served once.
    pub served: Compared,
    /// The share of the topologies in which each was served by a robot of its own.
    pub own: Compared,
    /// RD: the distances moved over the shortest, of all who came.
    pub distance_ratio: Option<Estimate>,
    /// The shortest distances of the robots to the WFRs that they served, over those of the best assignment; of the
    /// topologies in which each WFR has a robot of its own.
    pub over_best: Option<Estimate>,
    /// The share of these in which the assignment is the best.
    pub best: Option<Estimate>,
    /// Seconds until the last WFR was served, where all were.
    pub last_s: Option<Estimate>,
}

/// A share beside the paper's.
#[derive(Clone, Copy, PartialEq, Debug, JsonSchema, Serialize)]
pub struct Compared {
    /// The paper's.
    pub paper: f64,
    /// Ours.
    pub ours: Estimate,
    /// Ours less the paper's.
    pub difference: f64,
}

impl Compared {
    fn of(hits: usize, count: usize) -> Self {
        let share = Estimate::share(hits as u32, count as u32).unwrap_or(Estimate::NOTHING);
        let ours = rounded(share, 1e4);
        Self { paper: PAPER, ours, difference: decimals(ours.mean - PAPER, 1e4) }
    }
}

/// What is kept of a topology.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct Sample {
    is_served: bool,
    /// The distances moved, and the shortest.
    way_m: (f64, f64),
    /// The shortest distances of the assignment and of the best one, if each WFR has a robot of its own.
    assigned_m: Option<(f64, f64)>,
    last_s: Option<f64>,
}

impl Settings {
    fn rescue(&self, rule: RuleName, seed: u64) -> Result<Report, Problem> {
        let setting = tautline_field::rescue::Setting {
            rule,
            scheme: SchemeName::KFnf,
            k: self.k.0.get(),
            nodes: self.nodes,
            area_m: [SIDE_M, SIDE_M],
            range_m: RANGE_M,
            obstacles_m: Vec::new(),
            wfrs: self.wfrs,
            wfrs_at: Vec::new(),
            robots: self.robots,
            robots_at_m: Vec::new(),
            events_per_wfr: 1,
            calls: CallTimes::Together,
            channel: ChannelName::Ideal,
            loss: 0.0,
            shadowing_db: 0.0,
            exponent: FREE_SPACE,
            noise_db: 0.0,
            failing: 0,
            failing_nodes: 0,
        };
        rescue(&setting, seed)
    }

    fn seeds(&self) -> impl Iterator<Item = u64> {
        let first = self.seed;
        (0..u64::from(self.topologies)).map(move |topology| first.wrapping_add(topology))
    }

    /// The ways in the first topology in which each WFR has a robot of its own, or else in the first of all, under the
    /// repaired rule.
    fn picture(&self) -> Result<String, Halt> {
        let mut drawn = None;
        for seed in self.seeds() {
            let report = self.rescue(RuleName::Repaired, seed).map_err(Diagnostic::from)?;
            let is_fit = Sample::of(&report).assigned_m.is_some();
            if is_fit || drawn.is_none() {
                drawn = Some((seed, report));
            }
            if is_fit {
                break;
            }
        }
        let Some((seed, report)) = drawn else { return Ok(picture("", &[])) };
        let team = counted(self.robots, "robot");
        let title = format!("{team} for {}, seed {seed}", counted(self.wfrs, "WFR"));
        Ok(picture(&title, &[map(String::new(), &report)]))
    }
}

impl Table for RescueFig8 {
    type Settings = Settings;
    type Job = Job;
    type Measured = Sample;
    type Merged = Merged;

    fn about(&self) -> About {
        About {
            id: "rescue-fig8",
            shows: "three robots for three that wait for rescue, MRC as published and repaired: how often each gets a robot, \
                    and one of its own, how far they go, and how far from the best assignment that is",
            help: "Which robot comes to whom, and how far it goes, where several call at once",
            more: "Nodes, robots and those who wait for rescue (WFRs) at random in a square, without any fault, under MRC \
                   as published and repaired. The paper draws one case of it.",
            examples: &[
                "rescue-fig8 --svg ways.svg",
                "rescue-fig8 --nodes 1100 --topologies 1000 --format json",
                "rescue-fig8 --robots 2 --wfr 4",
            ],
            doing: "rescuing",
        }
    }

    fn parameters(&self) -> Vec<Parameter<Settings>> {
        vec![
            Parameter::one(
                "nodes",
                "N",
                "Nodes",
                |all| shown(&all.nodes),
                |all, texts| put(&mut all.nodes, texts, whole),
            ),
            Parameter::one(
                "robots",
                "N",
                "Robots",
                |all| shown(&all.robots),
                |all, texts| put(&mut all.robots, texts, |text| within(text, &(1..=MOST))),
            ),
            Parameter::one(
                "wfr",
                "N",
                "WFRs",
                |all| shown(&all.wfrs),
                |all, texts| put(&mut all.wfrs, texts, |text| within(text, &(1..=MOST))),
            ),
            Parameter::one(
                "k",
                "K",
                "The k of k-FNF",
                |all| shown(&all.k.0.get()),
                |all, texts| put(&mut all.k, texts, Senders::read),
            ),
            Parameter::one(
                "topologies",
                "COUNT",
                "Topologies",
                |all| shown(&all.topologies),
                |all, texts| put(&mut all.topologies, texts, |text| within(text, &(1..=100_000_i64))),
            ),
            Parameter::one(
                "seed",
                "SEED",
                "The seed of the first topology; the others follow",
                |all| shown(&all.seed),
                |all, texts| put(&mut all.seed, texts, number),
            ),
        ]
    }

    fn charts(&self) -> Vec<Chart<Self>> {
        let about =
            "Store the ways of the first topology in which each WFR has a robot of its own as a picture";
        vec![Chart { name: "svg", about, draw: |_, settings, _| settings.picture() }]
    }

    fn jobs(&self, settings: &Settings) -> Result<Vec<Job>, Halt> {
        settings.rescue(RuleName::Published, settings.seed).map_err(Diagnostic::from)?;
        let seeds = |rule| settings.seeds().map(move |seed| Job { rule, seed });
        Ok(RuleName::ALL.into_iter().flat_map(seeds).collect())
    }

    fn measure(&self, settings: &Settings, job: &Job, _: &dyn Observer) -> Result<Sample, Halt> {
        Ok(Sample::of(&settings.rescue(job.rule, job.seed).map_err(Diagnostic::from)?))
    }

    fn merge(&self, settings: &Settings, results: Vec<(Job, Sample)>) -> Result<Merged, Halt> {
        let line = |rule: RuleName| {
            let samples = results.iter().filter(|(job, _)| job.rule == rule);
            Line::of(rule, &samples.map(|(_, sample)| sample).collect::<Vec<_>>())
        };
        Ok(Merged { settings: settings.clone(), rules: RuleName::ALL.map(line).into() })
    }

    fn text(&self, settings: &Settings, merged: &Merged) -> Result<String, Halt> {
        let Settings { nodes, robots, wfrs, k, topologies, seed } = settings;
        let heading = format!(
            "{}, {}, {nodes} nodes in 300×300 m, range 25 m, k = {}, {}, seed {seed}",
            counted(*robots, "robot"),
            counted(*wfrs, "WFR"),
            k.0.get(),
            counted(*topologies, "topology")
        );
        let percent = |share: f64| format!("{:.2}", 100.0 * share);
        let mut table = Figures::new(heading, &merged.rules);
        table.row("MRC", |line| line.rule.to_string());
        table.row("served, %", |line| line.served.ours.times(100.0).text(2));
        table.row("  paper", |line| percent(line.served.paper));
        table.row("  difference", |line| percent(line.served.difference));
        table.row("a robot each, %", |line| line.own.ours.times(100.0).text(2));
        table.row("  paper", |line| percent(line.own.paper));
        table.row("  difference", |line| percent(line.own.difference));
        table.row("RD", |line| Estimate::text_or_dash(line.distance_ratio, 3));
        table.row("over the best assignment", |line| Estimate::text_or_dash(line.over_best, 3));
        table.row("the best assignment, %", |line| {
            Estimate::text_or_dash(line.best.map(|share| share.times(100.0)), 2)
        });
        table.row("seconds to the last", |line| Estimate::text_or_dash(line.last_s, 1));
        Ok(table.with_notes(
            "served: % of the topologies in which one robot comes to each WFR, and one only · a robot each: a different one \
             to each ·\npaper: a picture of one topology in which it is so, and “for all simulated scenarios” · RD: metres \
             walked for each metre\nof the shortest ways · over the best assignment: how many times as far the robots are \
             off the WFRs that they come to as\nunder the best of all assignments, where each WFR has a robot of its own · \
             the best assignment: % of these in which it is\nthat one · ±, […]: the 95 % interval",
        ))
    }
}

impl Sample {
    fn of(report: &Report) -> Self {
        let is_once = |fate: &Fate| matches!(fate, Fate::Served { visits: 1, .. });
        let is_served = report.fates.iter().all(is_once);
        let ways = report.journeys.iter().filter_map(|journey| Some((journey.moved_m, journey.shortest_m?)));
        let servants: Vec<usize> = report
            .fates
            .iter()
            .filter_map(|fate| match *fate {
                Fate::Served { by, .. } => Some(by),
                Fate::CutOff | Fate::Unheard | Fate::Abandoned | Fate::StillToCome => None,
            })
            .collect();
        let is_own = is_served && (1..servants.len()).all(|wfr| !servants[..wfr].contains(&servants[wfr]));
        let distance_m = |robot: usize, wfr: usize| {
            let start: Point = report.paths[robot].first()?.at;
            shortest_m(&report.field, start, report.wfrs[wfr])
        };
        let assigned_m = is_own.then(|| {
            let ours: Option<f64> =
                servants.iter().enumerate().map(|(wfr, &robot)| distance_m(robot, wfr)).sum();
            let robots: Vec<usize> = (0..report.paths.len()).collect();
            Some((ours?, best_m(report.wfrs.len(), &robots, &distance_m)?))
        });
        let last_ns = report.journeys.iter().map(|journey| journey.waited_ns).max();
        Self {
            is_served,
            way_m: ways.fold((0.0, 0.0), |sums, way| (sums.0 + way.0, sums.1 + way.1)),
            assigned_m: assigned_m.flatten(),
            last_s: last_ns.filter(|_| is_served).map(tautline_field::rescue::seconds),
        }
    }
}

/// The least sum of distances when each of the first `wfrs` WFRs gets one of `robots`; `None` if they are too few, or
/// there is no way.
fn best_m(wfrs: usize, robots: &[usize], distance_m: &impl Fn(usize, usize) -> Option<f64>) -> Option<f64> {
    let Some(wfr) = wfrs.checked_sub(1) else { return Some(0.0) };
    let with = |&robot: &usize| {
        let others: Vec<usize> = robots.iter().copied().filter(|&other| other != robot).collect();
        Some(distance_m(robot, wfr)? + best_m(wfr, &others, distance_m)?)
    };
    robots.iter().filter_map(with).min_by(f64::total_cmp)
}

/// Sums that differ by no more are the same.
const SAME_M: f64 = 1e-6;

impl Line {
    fn of(rule: RuleName, samples: &[&Sample]) -> Self {
        let own: Vec<(f64, f64)> = samples.iter().filter_map(|sample| sample.assigned_m).collect();
        let ways: Vec<(f64, f64)> =
            samples.iter().map(|sample| sample.way_m).filter(|&(_, shortest_m)| shortest_m > 0.0).collect();
        let lasts: Vec<f64> = samples.iter().filter_map(|sample| sample.last_s).collect();
        let best = own.iter().filter(|&&(ours_m, best_m)| ours_m - best_m <= SAME_M).count();
        let ratio = |pairs: &[(f64, f64)]| Estimate::of_ratio(pairs).map(|ratio| rounded(ratio, 1e4));
        Self {
            rule,
            served: Compared::of(samples.iter().filter(|sample| sample.is_served).count(), samples.len()),
            own: Compared::of(own.len(), samples.len()),
            distance_ratio: ratio(&ways),
            over_best: ratio(&own),
            best: Estimate::share(best as u32, own.len() as u32).map(|share| rounded(share, 1e4)),
            last_s: Estimate::of_values(&lasts).map(|last| rounded(last, 1e2)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::measure;
    use super::*;

    #[test]
    fn the_best_assignment_is_the_least_of_all() {
        let table = [[4.0, 1.0, 3.0], [2.0, 0.0, 5.0], [3.0, 2.0, 2.0]];
        let distance_m = |robot: usize, wfr: usize| Some(table[robot][wfr]);
        assert_eq!(best_m(3, &[0, 1, 2], &distance_m), Some(5.0), "1 + 2 + 2");
        assert_eq!(best_m(2, &[0, 1, 2], &distance_m), Some(3.0), "1 + 2, the third robot stays");
        assert_eq!(best_m(3, &[0, 1], &distance_m), None);
    }

    #[test]
    fn greedy_assignments_are_never_better_than_the_best() {
        let settings = Settings { topologies: 20, ..Settings::default() };
        let lines = measure(&RescueFig8, &settings, &()).expect("rescues").rules;
        for line in &lines {
            assert!(line.over_best.is_some_and(|ratio| ratio.mean >= 1.0), "{line:?}");
        }
        assert!(lines[1].served.difference.abs() < 1e-9, "repaired all are served once");
    }
}

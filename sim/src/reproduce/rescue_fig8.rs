//! Figure 8 of paper 003: three robots come to three WFRs. The paper draws the ways in one network, and says that robots
//! reach the WFRs “for all simulated scenarios” (4.3) and that each WFR gets “one nearby” robot (1). Ours: how often that is so
//! in many networks, under MRC as published and repaired, without any fault, and how much farther the robots have to go
//! than under the best of all assignments. Both rules have the same networks.

use rayon::prelude::*;
use serde::Serialize;
use tautline_proofs::words::counted;

use super::interval::{Estimate, decimals, rounded};
use super::notice_fig5::{RANGE_M, SIDE_M};
use crate::draw::field::picture;
use crate::draw::rescue::map;
use crate::explore::RuleName;
use crate::fault::{Fault, Halt, Watch};
use crate::radio::{ChannelName, FREE_SPACE, Point};
use crate::rescue::{CallTimes, Fate, Problem, Report, SchemeName, rescue};
use crate::tan::shortest_m;

/// The robots of the figure.
pub const ROBOTS: usize = 3;

/// The WFRs of the figure.
pub const WFRS: usize = 3;

/// Nodes, which the paper does not tell: the middle of its range.
pub const NODES: usize = 700;

/// The most robots and WFRs: all assignments are tried.
pub const MOST: usize = 6;

/// What the paper has, as a share of the topologies: all are served, each by a robot of its own.
const PAPER: f64 = 1.0;

/// What is measured.
#[derive(Clone, PartialEq, Debug)]
pub struct Setting {
    /// Nodes.
    pub nodes: usize,
    /// Robots.
    pub robots: usize,
    /// WFRs.
    pub wfrs: usize,
    /// The k of k-FNF.
    pub k: u8,
    /// Topologies.
    pub topologies: u32,
    /// The seed of the first; the others follow.
    pub seed: u64,
}

/// One rule.
#[derive(Clone, PartialEq, Debug, Serialize)]
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
#[derive(Clone, Copy, PartialEq, Debug, Serialize)]
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
struct Sample {
    is_served: bool,
    /// The distances moved, and the shortest.
    way_m: (f64, f64),
    /// The shortest distances of the assignment and of the best one, if each WFR has a robot of its own.
    assigned_m: Option<(f64, f64)>,
    last_s: Option<f64>,
}

impl Setting {
    fn rescue(&self, rule: RuleName, seed: u64) -> Result<Report, Problem> {
        let setting = crate::rescue::Setting {
            rule,
            scheme: SchemeName::KFnf,
            k: self.k,
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

    /// Measures both rules. `watch` is called after each topology of each rule. The result is the same on any
    /// number of threads.
    ///
    /// # Errors
    /// [`Halt`], as `watch` returned it, or if the setting makes no rescue.
    pub fn measure(&self, watch: &Watch<'_>) -> Result<Vec<Line>, Halt> {
        self.rescue(RuleName::Published, self.seed).map_err(Fault::from)?;
        let line = |rule: RuleName| {
            let topologies = (0..u64::from(self.topologies)).into_par_iter();
            let samples = topologies.map(|topology| {
                let report = self.rescue(rule, self.seed.wrapping_add(topology)).map_err(Fault::from)?;
                watch()?;
                Ok(Sample::of(&report))
            });
            let samples: Vec<Sample> = samples.collect::<Result<_, Halt>>()?;
            Ok(Line::of(rule, &samples))
        };
        [RuleName::Published, RuleName::Repaired].into_iter().map(line).collect()
    }

    /// The ways in the first topology in which each WFR has a robot of its own, or else in the first of all, under the
    /// repaired rule.
    ///
    /// # Errors
    /// [`Halt`] if the setting makes no rescue.
    pub fn picture(&self) -> Result<String, Halt> {
        let seeds = (0..u64::from(self.topologies)).map(|topology| self.seed.wrapping_add(topology));
        let mut drawn = None;
        for seed in seeds {
            let report = self.rescue(RuleName::Repaired, seed).map_err(Fault::from)?;
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
            last_s: last_ns.filter(|_| is_served).map(crate::rescue::seconds),
        }
    }
}

/// The least sum of distances when each of the first `wfrs` WFRs gets one of `robots`; `None` if they are too few, or there
/// is no way.
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
    fn of(rule: RuleName, samples: &[Sample]) -> Self {
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
        let setting = Setting { nodes: NODES, robots: ROBOTS, wfrs: WFRS, k: 1, topologies: 20, seed: 0 };
        let lines = setting.measure(&|| Ok(())).expect("rescues");
        for line in &lines {
            assert!(line.over_best.is_some_and(|ratio| ratio.mean >= 1.0), "{line:?}");
        }
        assert!(lines[1].served.difference.abs() < 1e-9, "repaired all are served once");
    }
}

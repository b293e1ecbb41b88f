//! The drive of one team through a lattice, and its outcome.

use std::collections::BTreeMap;

use tautline_kernel::ground::Cell;
use tautline_kernel::kit::Rule;

use super::super::prelude::*;
use super::lattice::PATHS;
use tautline_sim::kit::{self, Pace};

/// The paths that are explored at the paper's 88 %.
pub const EXPLORED: usize = 23;

/// Drives without a new path after which a run is ended.
const PATIENCE: usize = 1000 * PATHS;

/// The outcome of one run.
#[derive(Clone, PartialEq, Eq, Debug, JsonSchema, Serialize, Deserialize)]
pub struct Outcome {
    /// Milliseconds until each path is driven, in the order in which they are; as many as are.
    pub(super) paths: Vec<u64>,
    /// Of so many paths, those that are driven by more than one robot, when as many are explored.
    overlaps: Vec<u16>,
    /// Milliseconds until each node is found.
    pub(super) nodes: Vec<u64>,
    /// Whether a robot was out of contact.
    pub(super) is_cut: bool,
}

/// The run of robots from `starts` until all paths are driven, or no new one has been for long.
pub(super) fn driven(rule: Rule, layout: &Layout, starts: Vec<Cell>, pace: Pace, seed: u64) -> Outcome {
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

/// The runs of two robots that start at one node, as [`driven`], and never talk: what one has found, both have.
pub(super) fn silent(rule: Rule, layout: &Layout, start: Cell, pace: Pace, seeds: [u64; 2]) -> Outcome {
    let (mut paths, mut nodes) = (BTreeMap::new(), BTreeMap::from([(start, 0)]));
    for seed in seeds {
        let Ok(mut course) = kit::course(rule, layout, &[start], pace, seed) else { continue };
        let (mut driven, mut idle) = (0, 0);
        while driven < PATHS
            && idle < PATIENCE
            && let Some(drive) = course.drive()
        {
            // No node is found on a path that was driven before.
            if !drive.is_new {
                idle += 1;
                continue;
            }
            (driven, idle) = (driven + 1, 0);
            let [_, end] = drive.time;
            let path = [drive.from.min(drive.to), drive.from.max(drive.to)];
            paths.entry(path).and_modify(|first: &mut u64| *first = end.min(*first)).or_insert(end);
            nodes.entry(drive.to).and_modify(|first: &mut u64| *first = end.min(*first)).or_insert(end);
        }
    }
    let sorted = |mut times: Vec<u64>| {
        times.sort_unstable();
        times
    };
    let (paths, nodes) = (sorted(paths.into_values().collect()), sorted(nodes.into_values().collect()));
    Outcome { paths, overlaps: Vec::new(), nodes, is_cut: false }
}

impl Outcome {
    pub(super) fn is_whole(&self) -> bool {
        self.paths.len() == PATHS
    }

    /// When so many nodes, which are all, were found, in milliseconds; `None` if they were not.
    pub(super) fn found(&self, nodes: usize) -> Option<u64> {
        self.nodes.get(nodes.checked_sub(1)?).copied()
    }

    /// The directions that are explored at nodes by this time, in milliseconds: two for each path.
    pub(super) fn directions_by(&self, end: u64) -> f64 {
        2.0 * f64::from(self.paths.iter().filter(|&&driven| driven <= end).count() as u32)
    }

    /// Of so many explored paths, those driven by one robot alone, in percent.
    pub(super) fn efficiency(&self, explored: usize) -> Option<f64> {
        let shared = f64::from(*self.overlaps.get(explored.checked_sub(1)?)?);
        let explored = explored as u32;
        Some(100.0 * (1.0 - shared / f64::from(explored)))
    }
}

/// Seconds until so many paths are explored, over the runs in which they are.
pub(super) fn until(paths: usize, outcomes: &[&Outcome]) -> Option<Estimate> {
    mean(outcomes.iter().filter_map(|outcome| outcome.paths.get(paths - 1)).map(|&end| seconds(end)))
}

/// Whether some of the runs are such.
pub(super) fn is_any(share: Option<Estimate>) -> bool {
    share.is_some_and(|share| share.mean > 0.0)
}

/// The share of those that are such, in percent.
pub(super) fn in_percent<T>(all: &[T], is_such: impl Fn(&T) -> bool) -> Option<Estimate> {
    share(all, is_such).map(|share| share.times(100.0))
}

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
#[derive(Clone, PartialEq, Eq, Debug, Default, JsonSchema, Serialize, Deserialize)]
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

/// The finds of a run: when each path was driven first, and each node reached.
#[derive(Default)]
pub(super) struct Finds {
    paths: BTreeMap<[Cell; 2], u64>,
    nodes: BTreeMap<Cell, u64>,
}

/// The run of robots from `starts` until all paths are driven, or no new one has been for long.
pub(super) fn driven(
    rule: Rule,
    layout: &Layout,
    starts: &[Cell],
    pace: Pace,
    seed: u64,
) -> (Outcome, Finds) {
    let mut finds = Finds::default();
    let Ok(mut course) = kit::course(rule, layout, starts, pace, seed) else {
        return (Outcome { nodes: vec![0], ..Outcome::default() }, finds);
    };
    finds.nodes.extend(starts.iter().map(|&start| (start, 0)));
    let (mut overlaps, mut idle) = (Vec::new(), 0);
    while finds.paths.len() < PATHS
        && idle < PATIENCE
        && let Some(drive) = course.drive()
    {
        idle = if drive.is_new { 0 } else { idle + 1 };
        let [_, end] = drive.time;
        if drive.is_new {
            finds.paths.insert([drive.from.min(drive.to), drive.from.max(drive.to)], end);
            let shared = course.driven().values().filter(|robots| robots.count_ones() > 1).count();
            overlaps.push(shared as u16);
        }
        finds.nodes.entry(drive.to).or_insert(end);
    }
    let is_cut = course.apart() > kit::reach_millimetres(rule.reach).pow(2);
    (Outcome { overlaps, is_cut, ..finds.outcome() }, finds)
}

impl Finds {
    /// These and those of another robot, which it does not hear of.
    pub(super) fn with(mut self, other: Self) -> Self {
        for (path, end) in other.paths {
            self.paths.entry(path).and_modify(|first| *first = end.min(*first)).or_insert(end);
        }
        for (node, end) in other.nodes {
            self.nodes.entry(node).and_modify(|first| *first = end.min(*first)).or_insert(end);
        }
        self
    }

    /// The outcome of a run in which nothing else counts.
    pub(super) fn outcome(&self) -> Outcome {
        let sorted = |times: &mut dyn Iterator<Item = u64>| {
            let mut times: Vec<u64> = times.collect();
            times.sort_unstable();
            times
        };
        let (paths, nodes) =
            (sorted(&mut self.paths.values().copied()), sorted(&mut self.nodes.values().copied()));
        Outcome { paths, nodes, ..Outcome::default() }
    }
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

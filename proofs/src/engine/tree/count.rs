//! The counts of a search, and the smallest run that breaks each demand.

use serde::{Deserialize, Serialize};

use super::share::Share;

/// More than any search lives to count, with room for more.
const COUNTABLE: u128 = 1 << 63;

/// The runs that meet one number of walls.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Level {
    /// Leaves of the tree.
    pub runs: u64,
    /// Edges of the tree that have so many walls on the way to their end.
    pub moves: u64,
}

/// A run that breaks something: its answers.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Violation {
    pub(super) mishaps: u32,
    pub(super) steps: u32,
    pub(super) answers: Vec<u32>,
}

/// The runs that break an invariant, and the smallest of them.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct DemandRuns<D> {
    /// The demand that it breaks.
    #[serde(rename = "invariant")]
    pub(super) demand: D,
    pub(super) runs: u64,
    pub(super) smallest: Violation,
}

/// The counts of a search.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Count<D> {
    pub(super) runs: u64,
    /// Edges of the tree, each once.
    pub(super) moves: u64,
    pub(super) longest: u32,
    pub(super) broken: Vec<DemandRuns<D>>,
    /// Runs that grew too long.
    #[serde(default, skip_serializing_if = "is_nothing")]
    pub(super) given_up: u64,
    /// The situations that occurred, a bit for each.
    #[serde(default, skip_serializing_if = "is_nothing")]
    pub(super) covered: u64,
    /// The share of the tree that was searched, that of each level counted by itself.
    #[serde(default)]
    pub(super) searched: Share,
    /// Team moves made, those included that an earlier level has counted.
    #[serde(skip)]
    pub(super) made: u64,
}

impl<D> Default for Count<D> {
    fn default() -> Self {
        Self {
            runs: 0,
            moves: 0,
            longest: 0,
            broken: Vec::new(),
            given_up: 0,
            covered: 0,
            searched: Share::NONE,
            made: 0,
        }
    }
}

impl<D: PartialEq> Count<D> {
    pub(super) fn add_broken(&mut self, new: DemandRuns<D>) {
        match self.broken.iter_mut().find(|known| known.demand == new.demand) {
            Some(known) => {
                known.runs += new.runs;
                if new.smallest < known.smallest {
                    known.smallest = new.smallest;
                }
            }
            None => self.broken.push(new),
        }
    }

    /// Whether a search that has these levels behind it, and so many lanes left, can have counted so. A run that breaks
    /// a demand is counted when it does, and as a leaf when it is over: until then some lane is on it.
    pub(super) fn follows(&self, levels: &[Level], lanes: usize) -> bool {
        let runs: u128 = levels.iter().map(|level| u128::from(level.runs)).sum();
        let moves: u128 = levels.iter().map(|level| u128::from(level.moves)).sum();
        let (all_runs, all_moves) = (u128::from(self.runs), u128::from(self.moves));
        let is_countable = |broken: &DemandRuns<D>| u128::from(broken.runs) <= all_runs + lanes as u128;
        runs <= all_runs
            && moves <= all_moves
            && self.broken.iter().all(is_countable)
            && all_runs.max(all_moves) < COUNTABLE
    }

    pub(super) fn add(&mut self, other: Self) {
        self.runs += other.runs;
        self.moves += other.moves;
        self.longest = self.longest.max(other.longest);
        self.given_up += other.given_up;
        self.covered |= other.covered;
        self.searched = self.searched.and(other.searched);
        self.made += other.made;
        other.broken.into_iter().for_each(|broken| self.add_broken(broken));
    }
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "so serde calls it")]
const fn is_nothing(count: &u64) -> bool {
    *count == 0
}

//! The search over all layouts. Walls are not drawn in advance: the world decides an edge when a robot first tries it,
//! both ways, so one tree of runs covers every layout. A run is a leaf; it ends by itself, or when it has broken
//! everything that is wanted: each demand is decided as if it stood alone, so a run goes on for the demands that it has
//! not broken yet. A team move is an edge of the tree and is counted once. States never merge, since branches differ
//! for ever in a revealed edge.
//!
//! The tree is searched by levels: first the runs that meet no wall, then those that meet one, and so on, so that the
//! first counterexample has the fewest walls. On the way to its runs a level goes the ways of the levels before it
//! again, which costs a few per cent and saves the memory that a list of all the places left for later would take. A
//! level is shared out among *lanes*, each a depth-first search that knows only the answers on its way. They are
//! searched in waves. Before each wave the lanes with most left are split, and dealt out in *shares* that may all make
//! the same number of team moves: fewer where a level begins or ends, so that hardly a share runs out before the
//! others. All this hangs on nothing but where the lanes are: so a search comes out the same on any number of threads,
//! and its [`Position`], a list of answer prefixes, is small.
//!
//! Whoever implements [`Game`] has all of this: levels, threads, resuming, replaying. What is here knows no scheme.

mod certificate;
mod count;
mod deal;
mod forecast;
mod lane;
mod search;
mod share;
mod waves;

use std::cmp::Reverse;
use std::collections::BinaryHeap;
use std::fmt;
use std::ops::ControlFlow;

pub use self::certificate::AllRuns;
pub use self::count::Level;
pub use self::deal::Deal;
pub use self::search::{Position, Tree};
pub use self::waves::{Waves, search};
use super::Until;
use super::world::{Turn, World};
use crate::plural::counted;

/// A team that moves in a world that answers when it is asked: what is searched. Its state is copied where the world
/// has more than one answer.
pub trait Game:
    World<State: Send + Sync, Plan: Clone + Send + Sync, Demand: Send + Sync> + Send + Sync
{
    /// A team move as a person sees it.
    type Frame;

    /// The state before the first team move.
    fn start(&self) -> Self::State;

    /// A team move as a person sees it.
    fn frame(&self, turn: &Turn<'_, Self>) -> Self::Frame;

    /// The demands that are looked for, each as if it stood alone: a run that has broken all of them is over.
    fn wanted(&self) -> &[Self::Demand];

    /// In words what is not so where `demand` is broken, by this team move if it is not by ending or going on for ever.
    fn words(&self, demand: Self::Demand, turn: Option<&Turn<'_, Self>>) -> &'static str;

    /// Whether a run goes on for ever, and everything that it breaks by that: it was in the state `then` when the log
    /// had `sent` bytes, and is in `now` without an answer in between. A run that breaks nothing by coming back is
    /// over.
    fn recurs(
        &self,
        then: &Self::State,
        sent: usize,
        now: &Self::State,
        log: &[u8],
    ) -> ControlFlow<Vec<Self::Demand>>;

    /// How many mishaps there can be: a run asks for no more answers than this.
    fn edges(&self) -> u32;

    /// Team moves after which a run is given up: one that neither ends nor comes back to a state needs such a budget.
    /// That a run comes back is noticed some 32 team moves and its period later: let there be more.
    fn longest_run(&self) -> u32 {
        u32::MAX
    }
}

/// How far to search.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Limits {
    /// Most walls that are met in one run; the border is not counted.
    pub max_walls: u32,
    /// The search stops when it has made so many team moves since it was begun or taken up.
    pub budget_moves: Option<u64>,
    /// When to stop: any violation is one of what is [wanted](Game::wanted).
    pub until: Until,
}

/// The findings of a search.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Findings<D, F> {
    /// Leaves of the tree.
    pub runs: u64,
    /// Edges of the tree, backtracks included.
    pub moves: u64,
    /// Team moves of the longest run.
    pub longest: u32,
    /// Runs that were given up, since they grew too long. They are among the leaves.
    pub given_up: u64,
    /// The situations that occurred, in the order of [`World::covers`].
    pub covered: Vec<&'static str>,
    /// For each number of walls, from none on, the runs that meet so many and were all covered.
    pub levels: Vec<Level>,
    /// Whether the whole tree was covered.
    pub complete: bool,
    /// The smallest for each demand broken, by demand.
    pub counterexamples: Vec<Counterexample<D, F>>,
}

/// A run that breaks a demand in its last move, or by having ended, or by never ending. It may have broken others
/// before.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Counterexample<D, F> {
    /// The demand that it breaks.
    pub broken: D,
    /// How many runs break it.
    pub runs: u64,
    /// The demand, in words.
    pub demand: &'static str,
    /// The team moves.
    pub frames: Vec<F>,
    /// The world's answers: 1 for a wall.
    pub answers: Vec<u32>,
}

/// How far a search is.
#[derive(Clone, Copy, Debug)]
pub struct Progress<'a> {
    /// Leaves so far; none of a search over states.
    pub runs: u64,
    /// Team moves so far, or states that were looked at.
    pub moves: u64,
    /// The numbers of walls that are done.
    pub levels: &'a [Level],
    /// The number of walls that the search goes to.
    pub max_walls: u32,
    /// Edges that can be walls.
    pub edges: u32,
    /// Team moves that each share of the last wave made, those included that an earlier level has counted.
    pub wave: &'a [u64],
}

impl Progress<'_> {
    /// That of a search over states, so many of which were looked at.
    pub(crate) const fn of_states(looked_at: u64) -> Self {
        Self { runs: 0, moves: looked_at, levels: &[], max_walls: 0, edges: 0, wave: &[] }
    }

    /// How long the last wave takes so many workers, in team moves: who is done with a share takes the next one.
    pub fn span(&self, workers: usize) -> u64 {
        let mut busy_until: BinaryHeap<Reverse<u64>> = (0..workers).map(|_| Reverse(0)).collect();
        let mut span = 0;
        for made in self.wave {
            let Some(mut first) = busy_until.peek_mut() else { break };
            first.0 += made;
            span = span.max(first.0);
        }
        span
    }

    /// Team moves in all, if the numbers of walls grow on as they have so far.
    #[expect(clippy::cast_precision_loss, reason = "an estimate")]
    pub fn expected_moves(&self) -> Option<f64> {
        forecast::next(self.levels, self.edges)?;
        let levels = forecast::levels(self.levels, self.edges, self.max_walls);
        Some(levels.iter().map(|level| level.moves as f64).sum())
    }
}

/// Hears between two waves, or every thousand states, how far a search is, and may end it there.
pub type Watch<'a> = &'a mut dyn FnMut(&Progress<'_>) -> ControlFlow<()>;

/// A watch that lets every search go on.
pub const fn unwatched(_: &Progress<'_>) -> ControlFlow<()> {
    ControlFlow::Continue(())
}

/// Why there is no search.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Unsearchable {
    /// There are not so many edges that could be walls.
    TooManyWalls {
        /// Walls asked for.
        max_walls: u32,
        /// Edges there are.
        edges: u32,
    },
    /// The search would need more memory than it may have.
    TooLarge {
        /// The memory that it may need.
        bytes: u64,
        /// The memory that it may have.
        most: u64,
    },
    /// A position with more walls than are asked for now.
    Beyond {
        /// Numbers of walls that are done.
        walls: u32,
    },
    /// A position that the runs of this rule do not get to.
    Foreign,
    /// A position of a search, or of a shard, in which what was searched and what is left are not all that it has to
    /// search, each part once.
    Short,
}

impl fmt::Display for Unsearchable {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::TooManyWalls { max_walls, edges } => {
                write!(f, "there are more walls ({max_walls}) than edges that can be walls ({edges})")
            }
            Self::TooLarge { bytes, most } => {
                write!(
                    f,
                    "the search may need {} MiB of memory, and {} MiB is the most",
                    bytes >> 20,
                    most >> 20
                )
            }
            Self::Beyond { walls } => {
                write!(f, "this search has already gone on to {}", counted(*walls, "wall"))
            }
            Self::Foreign => {
                f.write_str("the runs of this rule do not get to where this search is said to be")
            }
            Self::Short => {
                f.write_str("what this search has done and what it has left are not the whole of it")
            }
        }
    }
}

impl std::error::Error for Unsearchable {}

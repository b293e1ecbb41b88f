//! The search over all layouts. Walls are not drawn in advance: the world decides an edge when a robot first tries
//! it, both ways, so one tree of runs covers every layout. A run is a leaf; it ends by itself or at its first
//! violation. A team move is an edge of the tree and is counted once. States never merge, since branches differ
//! for ever in a revealed edge.
//!
//! The tree is searched by levels: first the runs that meet no wall, then those that meet one, and so on, so that the
//! first counterexample has the fewest walls. On the way to its runs a level goes the ways of the levels before it
//! again, which costs a few per cent and saves the memory that a list of all the places left for later would take.
//! A level is shared out among *lanes*, each a depth-first search that knows only the answers on its way. The lanes
//! are searched in waves of a fixed number of team moves and then share their work anew, in their order: so a search
//! comes out the same on any number of threads, and its [`Position`], a list of answer prefixes, is small.

mod chain;
mod game;
mod lane;

use std::fmt;
use std::ops::ControlFlow;

use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use tautline_kernel::chain::{Refused, area};
use tautline_kernel::ground::{Area, Cell, CompactGrid, Edge, LargeGrid, MediumGrid, SmallGrid, TinyGrid};

use self::chain::ChainGame;
use self::game::{Demand, Game};
use self::lane::{Lane, Place};
use crate::clause::Subject;
use crate::evidence::{Choices, Unfit};
use crate::invariant::Invariant;
use crate::run::Frame;
use crate::whole;
use crate::words::counted;

/// What to search for, and how far.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Bounds {
    /// The rule, perhaps sabotaged.
    pub subject: Subject,
    /// Robots, base included: at most 64.
    pub robots: usize,
    /// The cells that the layouts have in common; the chain's range cuts them to size.
    pub area: Area,
    /// The base.
    pub base: Cell,
    /// Most walls that are met in one run; the border is not counted.
    pub max_walls: u32,
    /// The search stops when it has made about as many team moves as this, at the next answer.
    pub budget_moves: Option<u64>,
    /// What is looked for. A run without end is always found, since it would never be left.
    pub invariants: Vec<Invariant>,
    /// When to stop.
    pub until: Until,
}

impl Bounds {
    /// The area of the paper for `robots`: (2N−1)² cells, the base in the middle, everything looked for that a run of
    /// its own can break.
    pub fn new(subject: Subject, robots: usize, max_walls: u32) -> Self {
        let (area, base) = whole::area(robots);
        Self {
            subject,
            robots,
            area,
            base,
            max_walls,
            budget_moves: None,
            invariants: Invariant::OF_RUNS.to_vec(),
            until: Until::Exhausted,
        }
    }

    /// The area as the chain's range cuts it.
    ///
    /// # Errors
    /// [`Refused`] if the base is outside.
    pub fn reach(&self) -> Result<Area, Refused> {
        let base = self.base;
        area(self.area, base, self.robots).ok_or(Refused::BaseOutside { base })
    }

    /// How many edges can be walls.
    ///
    /// # Errors
    /// [`Refused`] if the base is outside.
    pub fn edges(&self) -> Result<u32, Refused> {
        Ok(self.reach()?.edges().count() as u32)
    }
}

/// When a search stops.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Until {
    /// When every layout within the bound is covered, or the budget is spent.
    Exhausted,
    /// At any violation: enough to reject a mutant.
    Violation,
}

/// What a search found.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Found {
    /// Leaves of the tree.
    pub runs: u64,
    /// Edges of the tree, backtracks included.
    pub moves: u64,
    /// Team moves of the longest run.
    pub longest: u32,
    /// For each number of walls, from none on, the runs that meet so many and were all covered.
    pub levels: Vec<Level>,
    /// Whether the whole tree was covered.
    pub complete: bool,
    /// The smallest for each clause broken, by clause.
    pub counterexamples: Vec<Counterexample>,
}

/// The runs that meet one number of walls.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Level {
    /// Leaves of the tree.
    pub runs: u64,
    /// Edges of the tree that have so many walls on the way to their end.
    pub moves: u64,
}

/// A run that breaks a clause in its last move, or by having ended, or by never ending.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Counterexample {
    /// What is broken.
    pub invariant: Invariant,
    /// How many runs break it.
    pub runs: u64,
    /// The demand that was not met.
    pub demand: &'static str,
    /// The walls that the team met.
    pub walls: Vec<Edge>,
    /// The team moves.
    pub frames: Vec<Frame>,
    /// What the world answered: 1 for a wall.
    pub answers: Vec<u32>,
}

impl Counterexample {
    fn new(((invariant, demand), frames): (Demand, Vec<Frame>), runs: u64, answers: Vec<u32>) -> Self {
        let mut walls: Vec<Edge> = frames.iter().flat_map(Frame::bumps).collect();
        walls.sort_unstable();
        walls.dedup();
        Self { invariant, runs, demand, walls, frames, answers }
    }
}

/// How far a search is.
#[derive(Clone, Copy, Debug)]
pub struct Progress<'a> {
    /// Leaves so far.
    pub runs: u64,
    /// Team moves so far.
    pub moves: u64,
    /// The numbers of walls that are done.
    pub levels: &'a [Level],
    /// The number of walls that the search goes to.
    pub max_walls: u32,
    /// Edges that can be walls.
    pub edges: u32,
}

impl Progress<'_> {
    /// Team moves in all, if the numbers of walls grow on as they have so far. The runs that meet *k* walls are
    /// about as many as sets of *k* edges, so their growth falls as that of the sets does.
    #[expect(clippy::cast_precision_loss, reason = "an estimate")]
    pub fn expected_moves(&self) -> Option<f64> {
        let [.., before, last] = self.levels else { return None };
        let growth_of_sets = |walls: f64| (f64::from(self.edges) - walls + 1.0) / walls;
        let done = self.levels.len() as f64 - 1.0;
        let excess = last.moves as f64 / before.moves as f64 / growth_of_sets(done);
        let mut level = last.moves as f64;
        let mut sum = self.levels.iter().map(|level| level.moves as f64).sum::<f64>();
        for walls in self.levels.len()..=self.max_walls as usize {
            level *= excess * growth_of_sets(walls as f64);
            sum += level;
        }
        Some(sum)
    }
}

/// Hears between two waves how far a search is, and may end it there.
pub type Watch<'a> = &'a mut dyn FnMut(&Progress<'_>) -> ControlFlow<()>;

/// A watch that lets every search go on.
pub const fn unwatched(_: &Progress<'_>) -> ControlFlow<()> {
    ControlFlow::Continue(())
}

/// Where a search is. Read back, it goes on from here and comes out as if it had never been interrupted.
#[derive(Clone, PartialEq, Eq, Debug, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Position {
    levels: Vec<Level>,
    count: Count,
    lanes: Vec<Place>,
}

/// Why there is no search.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Unsearchable {
    /// The team cannot be set up.
    Team(Refused),
    /// There are not so many edges that could be walls.
    TooManyWalls {
        /// Walls asked for.
        max_walls: u32,
        /// Edges there are.
        edges: u32,
    },
    /// The search would need more memory than it may have.
    TooLarge {
        /// What it may need.
        bytes: u64,
        /// What it may have.
        most: u64,
    },
    /// A position with more walls than are asked for now.
    Beyond {
        /// Numbers of walls that are done.
        walls: u32,
    },
    /// A position that the runs of this rule do not get to.
    Foreign,
}

impl fmt::Display for Unsearchable {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Team(refused) => refused.fmt(f),
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
        }
    }
}

impl std::error::Error for Unsearchable {}

impl From<Refused> for Unsearchable {
    fn from(refused: Refused) -> Self {
        Self::Team(refused)
    }
}

/// Searches all layouts within `bounds`. The result is the same on any number of threads, unless `watch` ends the
/// search.
///
/// # Errors
/// [`Unsearchable`] if the bounds are beyond what can be searched.
pub fn search(bounds: &Bounds, watch: Watch<'_>) -> Result<Found, Unsearchable> {
    let mut search = Search::new(bounds)?;
    while search.wave() && watch(&search.progress()).is_continue() {}
    Ok(search.found())
}

/// Plays a run that breaks `invariant` again, whose choices are the answers of the world. It is one run, whatever
/// number of runs break it.
pub(crate) fn replay(
    bounds: &Bounds,
    invariant: Invariant,
    choices: &Choices,
) -> Result<Counterexample, Unfit> {
    let search = Search::new(bounds).map_err(|_| Unfit::Unbroken)?;
    if !choices.again.is_empty() {
        return Err(Unfit::Over { at: choices.once.len() });
    }
    search.0.replay(invariant, &choices.once)
}

/// A search that is made wave by wave, and can be left and taken up again between two of them.
pub struct Search(Box<dyn Waves>);

impl Search {
    /// The search within `bounds`, at its start.
    ///
    /// # Errors
    /// [`Unsearchable`] if the bounds are beyond what can be searched.
    pub fn new(bounds: &Bounds) -> Result<Self, Unsearchable> {
        Ok(match bounds.robots {
            0..=4 => Self(Box::new(Tree::new(ChainGame::<_, 4>::new(bounds, TinyGrid::new)?, bounds)?)),
            5..=6 => Self(Box::new(Tree::new(ChainGame::<_, 6>::new(bounds, CompactGrid::new)?, bounds)?)),
            7..=8 => Self(Box::new(Tree::new(ChainGame::<_, 8>::new(bounds, SmallGrid::new)?, bounds)?)),
            9..=32 => Self(Box::new(Tree::new(ChainGame::<_, 32>::new(bounds, MediumGrid::new)?, bounds)?)),
            _ => Self(Box::new(Tree::new(ChainGame::<_, 64>::new(bounds, LargeGrid::new)?, bounds)?)),
        })
    }

    /// The search within `bounds` at `position`, where a search with the same bounds was; more walls may be asked for
    /// than then.
    ///
    /// # Errors
    /// [`Unsearchable`] if the bounds are beyond what can be searched, or the position is none of this search.
    pub fn at(bounds: &Bounds, position: &Position) -> Result<Self, Unsearchable> {
        let again = position.levels.len().min(COUNTED_AGAIN) as u32;
        if let Some(max_walls) = again.checked_sub(1) {
            let bounds = Bounds { max_walls, budget_moves: None, until: Until::Exhausted, ..bounds.clone() };
            if !position.levels.starts_with(&search(&bounds, &mut unwatched)?.levels) {
                return Err(Unsearchable::Foreign);
            }
        }
        let mut search = Self::new(bounds)?;
        search.0.go_to(position)?;
        Ok(search)
    }

    /// Searches a little further. Returns whether there is more to do, and to spend.
    pub fn wave(&mut self) -> bool {
        self.0.wave()
    }

    /// How far it is.
    pub fn progress(&self) -> Progress<'_> {
        self.0.progress()
    }

    /// Where it is: enough to go on from here.
    pub fn position(&self) -> Position {
        self.0.position()
    }

    /// What it has found so far.
    pub fn found(&self) -> Found {
        self.0.found()
    }
}

impl fmt::Debug for Search {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("Search").field(&self.progress()).finish()
    }
}

/// Lanes of a search, if they have room: many more than threads, so that none is idle for long.
const LANES: u64 = 64;

/// Team moves of a lane in one wave.
const WAVE: u64 = 1 << 14;

/// Where the budget leaves less than so many team moves to each lane, they are left to the first one.
const SHARE: u64 = 1 << 8;

/// Bytes that the lanes may need.
const MEMORY: u64 = 1 << 30;

/// Numbers of walls, from none on, whose runs a resumed search counts again, to see that it is of the same rule.
const COUNTED_AGAIN: usize = 2;

/// More than any search lives to count, with room for more.
const COUNTABLE: u128 = 1 << 63;

/// A run that breaks something: its answers.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Violation {
    mishaps: u32,
    steps: u32,
    answers: Vec<u32>,
}

/// The runs that break an invariant, and the smallest of them.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Broken {
    invariant: Invariant,
    runs: u64,
    smallest: Violation,
}

#[derive(Clone, PartialEq, Eq, Debug, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Count {
    runs: u64,
    /// Edges of the tree, each once.
    moves: u64,
    longest: u32,
    broken: Vec<Broken>,
    /// Team moves made, those included that an earlier level has counted.
    #[serde(skip)]
    made: u64,
}

impl Count {
    fn add_broken(&mut self, new: Broken) {
        match self.broken.iter_mut().find(|known| known.invariant == new.invariant) {
            Some(known) => {
                known.runs += new.runs;
                if new.smallest < known.smallest {
                    known.smallest = new.smallest;
                }
            }
            None => self.broken.push(new),
        }
    }

    /// Whether a search that has these levels behind it can have counted so.
    fn follows(&self, levels: &[Level]) -> bool {
        let runs: u128 = levels.iter().map(|level| u128::from(level.runs)).sum();
        let moves: u128 = levels.iter().map(|level| u128::from(level.moves)).sum();
        let broken: u128 = self.broken.iter().map(|broken| u128::from(broken.runs)).sum();
        let (all_runs, all_moves) = (u128::from(self.runs), u128::from(self.moves));
        runs.max(broken) <= all_runs && moves <= all_moves && all_runs.max(all_moves) < COUNTABLE
    }

    fn add(&mut self, other: Self) {
        self.runs += other.runs;
        self.moves += other.moves;
        self.longest = self.longest.max(other.longest);
        self.made += other.made;
        other.broken.into_iter().for_each(|broken| self.add_broken(broken));
    }
}

trait Waves {
    fn go_to(&mut self, position: &Position) -> Result<(), Unsearchable>;
    fn wave(&mut self) -> bool;
    fn progress(&self) -> Progress<'_>;
    fn position(&self) -> Position;
    fn found(&self) -> Found;
    fn replay(&self, invariant: Invariant, answers: &[u32]) -> Result<Counterexample, Unfit>;
}

/// The tree of runs of a game.
struct Tree<G: Game> {
    game: G,
    max_walls: u32,
    budget_moves: u64,
    until: Until,
    invariants: Vec<Invariant>,
    edges: u32,
    most_lanes: usize,
    /// The levels that are done.
    levels: Vec<Level>,
    count: Count,
    /// What is left of this level.
    lanes: Vec<Lane<G>>,
}

impl<G: Game> Tree<G> {
    fn new(game: G, bounds: &Bounds) -> Result<Self, Unsearchable> {
        let (edges, max_walls) = (bounds.edges()?, bounds.max_walls);
        if max_walls > edges {
            return Err(Unsearchable::TooManyWalls { max_walls, edges });
        }
        // Every fork of a run reveals an edge.
        let bytes = u64::from(edges.max(1)) * Lane::<G>::FORK_BYTES as u64;
        if bytes > MEMORY {
            return Err(Unsearchable::TooLarge { bytes, most: MEMORY });
        }
        let lanes = vec![Lane::whole(&game, 0)];
        Ok(Self {
            game,
            max_walls,
            budget_moves: bounds.budget_moves.unwrap_or(u64::MAX),
            until: bounds.until,
            invariants: bounds.invariants.clone(),
            edges,
            most_lanes: (MEMORY / bytes).min(LANES) as usize,
            levels: Vec::new(),
            count: Count::default(),
            lanes,
        })
    }

    /// Begins the next level, if there is one.
    fn begin(&mut self) {
        let walls = self.levels.len() as u32;
        if walls <= self.max_walls {
            self.lanes.push(Lane::whole(&self.game, walls));
        }
    }

    fn is_over(&self) -> bool {
        let is_looked_for = |broken: &Broken| self.invariants.contains(&broken.invariant);
        let is_settled = self.until == Until::Violation && self.count.broken.iter().any(is_looked_for);
        is_settled || self.lanes.is_empty() || self.count.moves >= self.budget_moves
    }

    /// Searches all lanes a little further, forgets those that are done, and splits others.
    fn search(&mut self) {
        let left = self.budget_moves - self.count.moves;
        let share = left / self.lanes.len() as u64;
        let is_scarce = share < SHARE;
        let (active, most) = if is_scarce { (1, left) } else { (self.lanes.len(), share) };
        let game = &self.game;
        let counts: Vec<(Count, bool)> = self.lanes[..active]
            .par_iter_mut()
            .with_max_len(1)
            .map(|lane| {
                let mut count = Count::default();
                let is_left = lane.search(game, most, &mut count);
                (count, is_left)
            })
            .collect();
        let mut is_left = counts.iter().map(|&(_, is_left)| is_left).collect::<Vec<_>>().into_iter();
        self.lanes.retain(|_| is_left.next().unwrap_or(true));
        for (count, _) in counts {
            self.count.add(count);
        }
        if !is_scarce {
            self.split();
        }
    }

    /// Splits the lanes with most left, those that have it nearest to the root, until there are as many as there may be.
    fn split(&mut self) {
        while self.lanes.len() < self.most_lanes {
            let largest =
                self.lanes.iter_mut().filter(|lane| lane.depth().is_some()).min_by_key(|lane| lane.depth());
            let Some(part) = largest.and_then(Lane::split) else { return };
            self.lanes.push(part);
        }
    }

    /// The smallest run that breaks an invariant again; `None` if it does not.
    fn record(&self, broken: &Broken) -> Option<Counterexample> {
        let Violation { mishaps, steps, answers } = &broken.smallest;
        let recorded = lane::record(&self.game, *mishaps, *steps, answers)?;
        Some(Counterexample::new(recorded, broken.runs, answers.clone()))
    }
}

impl<G: Game> Waves for Tree<G> {
    fn go_to(&mut self, position: &Position) -> Result<(), Unsearchable> {
        let walls = position.levels.len() as u32;
        let is_done = position.lanes.is_empty();
        let last = if is_done { walls.saturating_sub(1) } else { walls };
        if last > self.max_walls {
            return Err(Unsearchable::Beyond { walls: last });
        }
        let lane = |place| Lane::at(&self.game, walls, place).ok_or(Unsearchable::Foreign);
        let lanes = position.lanes.iter().map(lane).collect::<Result<_, _>>()?;
        let is_recorded =
            |broken: &Broken| self.record(broken).is_some_and(|found| found.invariant == broken.invariant);
        if !position.count.follows(&position.levels) || !position.count.broken.iter().all(is_recorded) {
            return Err(Unsearchable::Foreign);
        }
        self.levels.clone_from(&position.levels);
        self.count = position.count.clone();
        self.lanes = lanes;
        if is_done {
            self.begin();
        }
        Ok(())
    }

    fn wave(&mut self) -> bool {
        if self.is_over() {
            return false;
        }
        self.search();
        if self.lanes.is_empty() {
            let done = |of: fn(&Level) -> u64| self.levels.iter().map(of).sum::<u64>();
            self.levels.push(Level {
                runs: self.count.runs - done(|level| level.runs),
                moves: self.count.moves - done(|level| level.moves),
            });
            self.begin();
        }
        !self.is_over()
    }

    fn progress(&self) -> Progress<'_> {
        Progress {
            runs: self.count.runs,
            moves: self.count.moves,
            levels: &self.levels,
            max_walls: self.max_walls,
            edges: self.edges,
        }
    }

    fn position(&self) -> Position {
        Position {
            levels: self.levels.clone(),
            count: self.count.clone(),
            lanes: self.lanes.iter().map(Lane::place).collect(),
        }
    }

    fn found(&self) -> Found {
        let Count { runs, moves, longest, ref broken, made: _ } = self.count;
        let mut broken = broken.clone();
        broken.sort_unstable();
        let counterexamples = broken.iter().filter_map(|broken| self.record(broken)).collect();
        let complete = self.lanes.is_empty();
        Found { runs, moves, longest, levels: self.levels.clone(), complete, counterexamples }
    }

    fn replay(&self, invariant: Invariant, answers: &[u32]) -> Result<Counterexample, Unfit> {
        let recorded = lane::replay(&self.game, self.max_walls, answers)?;
        if recorded.0.0 != invariant {
            return Err(Unfit::Unbroken);
        }
        Ok(Counterexample::new(recorded, 1, answers.to_vec()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn on_threads<T: Send>(threads: usize, work: impl FnOnce() -> T + Send) -> T {
        rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads").install(work)
    }

    fn found(bounds: &Bounds) -> Found {
        search(bounds, &mut unwatched).expect("four robots fit")
    }

    #[test]
    fn a_search_comes_out_the_same_on_any_number_of_threads() {
        let bounds = Bounds::new(Subject::PUBLISHED, 4, 3);
        let whole = found(&bounds);
        assert!(whole.complete);
        assert_eq!(whole.levels.len(), 4);
        assert_eq!(whole.levels.iter().map(|level| level.moves).sum::<u64>(), whole.moves);
        for threads in [1, 2, 3, 7] {
            assert_eq!(on_threads(threads, || found(&bounds)), whole, "{threads} threads");
        }
    }

    #[test]
    fn a_budget_cuts_the_same_runs_off_on_any_number_of_threads() {
        let bounds = |budget_moves| Bounds { budget_moves, ..Bounds::new(Subject::PUBLISHED, 4, 3) };
        let whole = found(&bounds(None));
        for budget in [0, 1, 100, 20_000, whole.moves - 1000] {
            let cut = on_threads(1, || found(&bounds(Some(budget))));
            assert!(!cut.complete && cut.moves < budget + 300, "{budget}: {} moves", cut.moves);
            assert_eq!(cut, on_threads(3, || found(&bounds(Some(budget)))), "{budget}");
        }
        assert_eq!(found(&bounds(Some(whole.moves + 1))), whole);
    }

    #[test]
    fn a_search_left_anywhere_and_taken_up_again_comes_out_the_same() {
        let bounds = Bounds::new(Subject::PUBLISHED, 4, 3);
        let whole = found(&bounds);
        let mut positions = Vec::new();
        let mut undisturbed = Search::new(&bounds).expect("four robots fit");
        positions.push(undisturbed.position());
        while undisturbed.wave() {
            positions.push(undisturbed.position());
        }
        positions.push(undisturbed.position());
        assert!(positions.len() > 4, "{} waves", positions.len());
        for position in positions.iter().step_by(7).chain(positions.last()) {
            let mut again = Search::at(&bounds, position).expect("a position of its own");
            assert_eq!(again.position(), *position);
            while again.wave() {}
            assert_eq!(again.found(), whole);
        }
    }

    #[test]
    fn a_finished_search_goes_on_with_more_walls() {
        let (few, more) = (Bounds::new(Subject::REPAIRED, 3, 2), Bounds::new(Subject::REPAIRED, 3, 4));
        let mut search = Search::new(&few).expect("three robots fit");
        while search.wave() {}
        let position = search.position();
        let mut again = Search::at(&more, &position).expect("more walls");
        while again.wave() {}
        assert_eq!(again.found(), found(&more));
        let fewer = Search::at(&Bounds::new(Subject::REPAIRED, 3, 1), &position);
        assert_eq!(fewer.err(), Some(Unsearchable::Beyond { walls: 2 }));
    }

    #[test]
    fn a_position_of_another_search_is_refused() {
        let bounds = Bounds::new(Subject::PUBLISHED, 4, 2);
        let mut search = Search::new(&bounds).expect("four robots fit");
        while search.position().lanes.len() < 3 {
            assert!(search.wave(), "a search has many lanes somewhere");
        }
        let position = search.position();
        let foreign = |bounds: &Bounds, position: &Position| {
            matches!(Search::at(bounds, position), Err(Unsearchable::Foreign))
        };
        assert!(foreign(&Bounds::new(Subject::PUBLISHED, 5, 2), &position));
        let mut damaged = position.clone();
        damaged.lanes[0] = Place::default();
        assert!(!foreign(&bounds, &damaged), "the start is a place in every tree");
        for place in 0..position.lanes.len() {
            let mut damaged = position.clone();
            damaged.lanes[place].lengthen(7);
            assert!(foreign(&bounds, &damaged), "lane {place}");
        }
    }

    #[test]
    fn bounds_that_cannot_be_searched_are_refused() {
        let refused =
            |robots, max_walls| Search::new(&Bounds::new(Subject::REPAIRED, robots, max_walls)).err();
        assert_eq!(refused(2, 13), Some(Unsearchable::TooManyWalls { max_walls: 13, edges: 12 }));
        assert_eq!(refused(2, 12), None);
        assert!(matches!(refused(1, 0), Some(Unsearchable::Team(Refused::TooFewRobots { robots: 1 }))));
        assert!(matches!(refused(65, 0), Some(Unsearchable::Team(Refused::TooManyRobots { .. }))));
    }
}

//! The search over all layouts. Walls are not drawn in advance: the world decides an edge when a robot first tries
//! it, both ways, so one tree of runs covers every layout. A run is a leaf; it ends by itself or at its first
//! violation. A team move is an edge of the tree and is counted once. States never merge, since branches differ
//! for ever in a revealed edge.

use std::collections::VecDeque;
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

use rayon::prelude::*;
use tautline_kernel::chain::{Chain, End, Intent, Plan, Refused, Settled};
use tautline_kernel::grid::{Area, EdgeMark, Grid, LargeGrid, MediumGrid, SmallGrid};
use tautline_kernel::lattice::{Cell, Edge, Step};

use crate::clause::{Sabotage, Subject};
use crate::engine::Stop;
use crate::invariant::{Invariant, Moment};
use crate::run::Frame;

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
    /// The search stops as soon as it has made more team moves than this.
    pub budget_moves: Option<u64>,
    /// What is looked for.
    pub invariants: Vec<Invariant>,
    /// When to stop.
    pub until: Until,
}

impl Bounds {
    /// The area of the paper for `robots`: (2N−1)² cells, the base in the middle, everything looked for.
    pub fn new(subject: Subject, robots: usize, max_walls: u32) -> Self {
        let range = i16::try_from(robots.saturating_sub(1)).unwrap_or(i16::MAX / 2);
        let base = Cell::new(range, range);
        let area = Area::new(Cell::new(0, 0), Cell::new(2 * range, 2 * range)).unwrap_or(Area::of(base));
        Self {
            subject,
            robots,
            area,
            base,
            max_walls,
            budget_moves: None,
            invariants: Invariant::SAFETY.to_vec(),
            until: Until::Exhausted,
        }
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
    /// Whether the whole tree was covered.
    pub complete: bool,
    /// The smallest for each clause broken, by clause.
    pub counterexamples: Vec<Counterexample>,
}

/// A run that breaks a clause in its last move.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Counterexample {
    /// What is broken.
    pub invariant: Invariant,
    /// The demand that was not met.
    pub demand: &'static str,
    /// The walls that the team met.
    pub walls: Vec<Edge>,
    /// The team moves.
    pub frames: Vec<Frame>,
}

/// How far a search is.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Progress {
    /// Leaves so far.
    pub runs: u64,
    /// Team moves so far.
    pub moves: u64,
    /// Subtrees that are done.
    pub done: u64,
    /// Subtrees in all.
    pub of: u64,
}

/// Hears now and then, from any thread, how far a search is, and may end it there.
pub type Watch<'a> = &'a (dyn Fn(Progress) -> ControlFlow<()> + Sync);

/// A watch that lets every search go on.
pub const UNWATCHED: Watch<'static> = &|_| ControlFlow::Continue(());

/// Searches all layouts within `bounds`. The result is the same on any number of threads, unless `watch` ends the
/// search.
///
/// # Errors
/// [`Refused`] if the robots or the base do not fit.
pub fn search(bounds: &Bounds, watch: Watch<'_>) -> Result<Found, Refused> {
    match bounds.robots {
        0..=8 => Ok(Tree::<SmallGrid, 8>::new(bounds, SmallGrid::new)?.search(watch)),
        9..=32 => Ok(Tree::<MediumGrid, 32>::new(bounds, MediumGrid::new)?.search(watch)),
        _ => Ok(Tree::<LargeGrid, 64>::new(bounds, LargeGrid::new)?.search(watch)),
    }
}

/// Subtrees that are handed to the threads: many more than threads, so that none is idle for long.
const SUBTREES: usize = 1024;

/// Subtrees between two looks at the budget.
const WAVE: usize = 64;

/// Team moves of a subtree between two calls of the watch.
const PATIENCE: u64 = 1 << 16;

/// What the threads of a search know of each other.
struct Watched<'a> {
    watch: Watch<'a>,
    runs: AtomicU64,
    moves: AtomicU64,
    done: AtomicU64,
    of: u64,
    is_over: AtomicBool,
}

impl Watched<'_> {
    /// Tells the watch of so much more, and remembers if it ends the search.
    fn tell(&self, runs: u64, moves: u64, done: u64) {
        let add = |sum: &AtomicU64, more| sum.fetch_add(more, Ordering::Relaxed) + more;
        let progress = Progress {
            runs: add(&self.runs, runs),
            moves: add(&self.moves, moves),
            done: add(&self.done, done),
            of: self.of,
        };
        if (self.watch)(progress).is_break() {
            self.is_over.store(true, Ordering::Relaxed);
        }
    }

    fn is_over(&self) -> bool {
        self.is_over.load(Ordering::Relaxed)
    }
}

struct Tree<'a, G, const ROBOTS: usize> {
    bounds: &'a Bounds,
    start: Chain<G, ROBOTS>,
}

/// A run up to some team move.
#[derive(Clone)]
struct Branch<G, const ROBOTS: usize> {
    chain: Chain<G, ROBOTS>,
    walls: u32,
    log: Vec<u8>,
    /// Whether each edge asked for was a wall.
    answers: Vec<bool>,
}

/// A branch that shares its log and answers with the branch it grew from.
struct Shoot<G, const ROBOTS: usize> {
    chain: Chain<G, ROBOTS>,
    walls: u32,
    settled: Settled<ROBOTS>,
    /// One bit for each edge asked for in the last move, and their number.
    answers: u64,
    asked: u32,
    /// Length of log and answers before the last move.
    log: usize,
    answered: usize,
}

/// The smallest violation of one invariant so far.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord)]
struct Violation {
    invariant: Invariant,
    walls: u32,
    steps: usize,
    answers: Vec<bool>,
    demand: &'static str,
}

#[derive(Default)]
struct Count {
    runs: u64,
    moves: u64,
    violations: Vec<Violation>,
}

impl Count {
    fn violate(&mut self, new: Violation) {
        match self.violations.iter_mut().find(|known| known.invariant == new.invariant) {
            Some(known) => *known = new.min(known.clone()),
            None => self.violations.push(new),
        }
    }

    fn add(&mut self, other: Self) {
        self.runs += other.runs;
        self.moves += other.moves;
        other.violations.into_iter().for_each(|violation| self.violate(violation));
    }
}

impl<'a, G, const ROBOTS: usize> Tree<'a, G, ROBOTS>
where
    G: Grid + Copy + Eq + Send + Sync,
{
    fn new(bounds: &'a Bounds, grid: impl Fn(Area) -> Option<G>) -> Result<Self, Refused> {
        let Bounds { robots, base, .. } = *bounds;
        let area =
            Chain::<G, ROBOTS>::area(bounds.area, base, robots).ok_or(Refused::BaseOutside { base })?;
        let grid = grid(area).ok_or(Refused::TooManyRobots { robots, most: ROBOTS })?;
        Ok(Self { bounds, start: Chain::new(bounds.subject.rule, robots, base, grid)? })
    }

    fn search(&self, watch: Watch<'_>) -> Found {
        let mut count = Count::default();
        let mut complete = true;
        let budget = self.bounds.budget_moves.unwrap_or(u64::MAX);
        let branches = self.subtrees(&mut count, budget);
        let watched = Watched {
            watch,
            runs: AtomicU64::new(count.runs),
            moves: AtomicU64::new(count.moves),
            done: AtomicU64::new(0),
            of: branches.len() as u64,
            is_over: AtomicBool::new(false),
        };
        'waves: for wave in branches.chunks(WAVE) {
            if count.moves > budget {
                complete = false;
                break;
            }
            let left = budget - count.moves;
            let counts: Vec<(Count, bool)> = wave
                .par_iter()
                .with_max_len(1)
                .map(|branch| {
                    let found = self.explore(branch, left, &watched);
                    watched.tell(0, 0, 1);
                    found
                })
                .collect();
            // The budget is spent in the order of the branches, whoever was faster.
            for (branch, (found, is_whole)) in wave.iter().zip(counts) {
                let left = budget.saturating_sub(count.moves);
                let is_within = found.moves <= left;
                count.add(if is_within { found } else { self.explore(branch, left, &watched).0 });
                if !(is_whole && is_within) {
                    complete = false;
                    break 'waves;
                }
            }
        }
        count.violations.sort_unstable();
        let counterexamples = count.violations.iter().map(|violation| self.record(violation)).collect();
        Found { runs: count.runs, moves: count.moves, complete, counterexamples }
    }

    /// Whether a violation ends the search.
    fn is_settled(&self, count: &Count) -> bool {
        self.bounds.until == Until::Violation && !count.violations.is_empty()
    }

    /// The branches from which the threads go on: the tree cut where it is wide enough, breadth first.
    fn subtrees(&self, count: &mut Count, budget: u64) -> Vec<Branch<G, ROBOTS>> {
        let start = Branch { chain: self.start, walls: 0, log: Vec::new(), answers: Vec::new() };
        let mut branches = VecDeque::from([start]);
        while branches.len() < SUBTREES && count.moves <= budget {
            let Some(mut branch) = branches.pop_front() else { break };
            let mut shoots = Vec::new();
            self.grow(&mut branch, count, &mut shoots);
            branches.extend(shoots.into_iter().map(|shoot| branch.clone().grown(shoot)));
        }
        branches.into()
    }

    /// The subtree of `branch`, depth first, as far as `budget` moves go; whether it was covered.
    fn explore(&self, branch: &Branch<G, ROBOTS>, budget: u64, watched: &Watched<'_>) -> (Count, bool) {
        let mut count = Count::default();
        let mut told = (0, 0);
        let mut branch = branch.clone();
        let mut shoots = Vec::new();
        self.grow(&mut branch, &mut count, &mut shoots);
        while let Some(shoot) = shoots.pop() {
            if count.moves > budget || self.is_settled(&count) || watched.is_over() {
                return (count, false);
            }
            if count.moves - told.1 >= PATIENCE {
                watched.tell(count.runs - told.0, count.moves - told.1, 0);
                told = (count.runs, count.moves);
            }
            branch = branch.grown(shoot);
            self.grow(&mut branch, &mut count, &mut shoots);
        }
        watched.tell(count.runs - told.0, count.moves - told.1, 0);
        (count, true)
    }

    /// One team move of `branch`, with every answer that the walls left allow. What goes on is pushed on
    /// `shoots`.
    fn grow(&self, branch: &mut Branch<G, ROBOTS>, count: &mut Count, shoots: &mut Vec<Shoot<G, ROBOTS>>) {
        let before = branch.chain;
        let plan = match branch.chain.plan(&branch.log) {
            Ok(Intent::Go(plan)) => plan,
            Ok(Intent::Done(End::Explored | End::Exhausted)) | Err(_) => {
                count.runs += 1;
                return;
            }
        };
        let planned = branch.chain;
        let asked = unknown_edges(&planned, &plan).count() as u32;
        for answers in subsets(asked, self.bounds.max_walls - branch.walls) {
            let mut after = planned;
            let mut question = 0;
            let settled = after.settle(&plan, |_| {
                question += 1;
                answers >> (question - 1) & 1 == 0
            });
            count.moves += 1;
            let shoot = Shoot {
                chain: after,
                walls: branch.walls + answers.count_ones(),
                settled,
                answers,
                asked,
                log: branch.log.len(),
                answered: branch.answers.len(),
            };
            match self.violated([&before, &planned, &after], &plan, &settled) {
                None => shoots.push(shoot),
                Some((invariant, demand)) => {
                    count.runs += 1;
                    let steps = branch.log.len() / (self.bounds.robots - 1) + 1;
                    let walls = shoot.walls;
                    let mut all = branch.answers.clone();
                    all.extend(shoot.bits());
                    count.violate(Violation { invariant, walls, steps, answers: all, demand });
                }
            }
        }
    }

    fn violated(
        &self,
        [before, planned, after]: [&Chain<G, ROBOTS>; 3],
        plan: &Plan<ROBOTS>,
        settled: &Settled<ROBOTS>,
    ) -> Option<(Invariant, &'static str)> {
        let sabotage = self.bounds.subject.sabotage;
        let mut steps = [Step::Stay; ROBOTS];
        let steps = &mut steps[..self.bounds.robots];
        steps.copy_from_slice(plan.steps());
        if sabotage == Sabotage::BaseFollows {
            steps[0] = steps[1];
        }
        let mut messages = [0; ROBOTS];
        let messages = &mut messages[..self.bounds.robots - 1];
        messages.iter_mut().zip(settled.messages()).for_each(|(heard, &sent)| *heard = sabotage.carry(sent));
        let subject = &self.bounds.subject;
        let moment = Moment { subject, before, planned, after, kind: plan.kind, steps, messages };
        self.bounds.invariants.iter().find_map(|&invariant| match invariant.check(&moment) {
            Err(Stop::Violated(demand)) => Some((invariant, demand)),
            Err(Stop::Assumed) | Ok(()) => None,
        })
    }

    /// The run of a violation again, move by move.
    fn record(&self, violation: &Violation) -> Counterexample {
        let mut chain = self.start;
        let (mut walls, mut frames, mut log) = (Vec::new(), Vec::new(), Vec::new());
        let mut answers = violation.answers.iter();
        while frames.len() < violation.steps {
            let Ok(Intent::Go(plan)) = chain.plan(&log) else { break };
            let settled = chain.settle(&plan, |edge| {
                let is_wall = answers.next().is_some_and(|&is_wall| is_wall);
                walls.extend(is_wall.then_some(edge));
                !is_wall
            });
            log.extend_from_slice(settled.messages());
            frames.push(Frame::new(plan.kind, &settled, chain.cells()));
        }
        walls.sort_unstable();
        Counterexample { invariant: violation.invariant, demand: violation.demand, walls, frames }
    }
}

impl<G, const ROBOTS: usize> Shoot<G, ROBOTS> {
    fn bits(&self) -> impl Iterator<Item = bool> + use<G, ROBOTS> {
        let answers = self.answers;
        (0..self.asked).map(move |question| answers >> question & 1 == 1)
    }
}

impl<G, const ROBOTS: usize> Branch<G, ROBOTS> {
    /// This branch, cut back to where `shoot` grew, and grown by it.
    fn grown(mut self, shoot: Shoot<G, ROBOTS>) -> Self {
        self.log.truncate(shoot.log);
        self.log.extend_from_slice(shoot.settled.messages());
        self.answers.truncate(shoot.answered);
        self.answers.extend(shoot.bits());
        Self { chain: shoot.chain, walls: shoot.walls, ..self }
    }
}

/// The edges that `plan` would cross without knowing them, once each, in the order of the robots.
fn unknown_edges<G: Grid, const ROBOTS: usize>(
    chain: &Chain<G, ROBOTS>,
    plan: &Plan<ROBOTS>,
) -> impl Iterator<Item = Edge> {
    let crossed = |robot: usize| match plan.steps()[robot] {
        Step::Cross(side) => Some(Edge::new(chain.cells()[robot], side)),
        Step::Stay => None,
    };
    let is_known =
        |edge| chain.grid().edge_has(EdgeMark::Open, edge) || chain.grid().edge_has(EdgeMark::Wall, edge);
    (1..chain.cells().len())
        .filter_map(move |robot| crossed(robot).map(|edge| (robot, edge)))
        .filter(move |&(robot, edge)| {
            !is_known(edge) && (1..robot).all(|earlier| crossed(earlier) != Some(edge))
        })
        .map(|(_, edge)| edge)
}

/// The sets of at most `most` of `items` things, one bit each; the empty set first.
fn subsets(items: u32, most: u32) -> Vec<u64> {
    let mut sets = vec![0_u64];
    for item in 0..items {
        for index in 0..sets.len() {
            if sets[index].count_ones() < most {
                sets.push(sets[index] | 1 << item);
            }
        }
    }
    sets
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn subsets_are_all_and_once() {
        assert_eq!(subsets(3, 1), [0, 1, 2, 4]);
        assert_eq!(subsets(3, 3).len(), 8);
        assert_eq!(subsets(40, 2).len(), 1 + 40 + 40 * 39 / 2);
        assert_eq!(subsets(0, 4), [0]);
    }

    #[test]
    fn a_budget_cuts_the_same_runs_off_on_any_number_of_threads() {
        let bounds = |budget_moves| Bounds { budget_moves, ..Bounds::new(Subject::PUBLISHED, 4, 3) };
        let whole = search(&bounds(None), UNWATCHED).expect("four robots fit");
        assert!(whole.complete);
        for budget in [0, 1, 100, 20_000, whole.moves - 1] {
            let run = |threads| {
                let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
                pool.install(|| search(&bounds(Some(budget)), UNWATCHED)).expect("four robots fit")
            };
            let found = run(1);
            assert!(!found.complete && found.moves <= budget + 16, "{budget}: {found:?}");
            assert_eq!(found, run(3), "{budget}");
        }
        assert_eq!(search(&bounds(Some(whole.moves)), UNWATCHED).expect("four robots fit"), whole);
    }
}

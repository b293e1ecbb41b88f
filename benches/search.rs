//! What a team move of the search over all layouts costs: against a search as one would first write it, by the number
//! of robots, and on two threads. Criterion follows the shorter searches over time; the tables at the end relate them
//! to one another.

mod common;

use std::time::Instant;

use criterion::{BenchmarkId, Criterion};
use rayon::{ThreadPool, ThreadPoolBuilder};
use tautline_kernel::chain::Rule;
use tautline_kernel::ground::{Edge, Step};
use tautline_proofs::chain::Observed;
use tautline_proofs::chain::breach::Breach;
use tautline_proofs::chain::invariant::Invariant;
use tautline_proofs::chain::plain::{PlainChain, PlainIntent};
use tautline_proofs::chain::search::{Bounds, search};
use tautline_proofs::engine::tree::unwatched;

use self::common::{Cost, Work, group, measure};

/// What both searches look for after every team move. Neither looks at how a run ends.
const BREACHES: [Breach; 3] = [Breach::Contact, Breach::Crowding, Breach::Coverage];

/// What was searched.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
struct Searched {
    runs: u64,
    moves: u64,
}

impl Work for Searched {
    fn parts(&self) -> u32 {
        u32::try_from(self.moves).expect("not so many moves")
    }
}

/// The published rule in the paper's area, with the breaches of [`BREACHES`] looked for.
fn bounds(robots: usize, max_walls: u32) -> Bounds {
    let invariants = BREACHES.map(Invariant::Without).to_vec();
    Bounds { invariants, ..Bounds::new(Observed::PUBLISHED, robots, max_walls) }
}

fn search_within(bounds: &Bounds, threads: &ThreadPool) -> Searched {
    let found = threads.install(|| search(bounds, &mut unwatched)).expect("bounds that can be searched");
    assert!(found.complete);
    Searched { runs: found.runs, moves: found.moves }
}

fn threads(count: usize) -> ThreadPool {
    ThreadPoolBuilder::new().num_threads(count).build().expect("threads")
}

/// The same runs, depth first over plain chains: each team move copies the chain, with all its vectors, for every way in
/// which some of the edges that nobody knows are walls.
fn search_naively(bounds: &Bounds) -> Searched {
    let chain = PlainChain::new(Rule::PUBLISHED, bounds.robots, bounds.base, bounds.area);
    let mut searched = Searched::default();
    follow(chain, bounds.max_walls, &mut searched);
    searched
}

fn follow(mut chain: PlainChain, walls: u32, searched: &mut Searched) {
    let (intent, _) = chain.plan(u64::MAX).expect("no limit");
    if matches!(intent, PlainIntent::Explored | PlainIntent::Exhausted) {
        searched.runs += 1;
        return;
    }
    let tried = tried(&chain, &intent);
    for blocked in (0_u32..1 << tried.len()).filter(|blocked| blocked.count_ones() <= walls) {
        let mut next = chain.clone();
        let is_open =
            |edge| tried.iter().position(|&one| one == edge).is_none_or(|place| blocked >> place & 1 == 0);
        if settle(&mut next, &intent, is_open, searched) {
            follow(next, walls - blocked.count_ones(), searched);
        }
    }
}

/// The edges that are crossed without being known.
fn tried(chain: &PlainChain, intent: &PlainIntent) -> Vec<Edge> {
    let mut edges = Vec::new();
    if let PlainIntent::Advance(steps) = intent {
        for (&cell, &step) in chain.cells().iter().zip(steps) {
            if let Step::Cross(side) = step {
                let edge = Edge::new(cell, side);
                if !chain.is_known(edge) && !edges.contains(&edge) {
                    edges.push(edge);
                }
            }
        }
    }
    edges
}

/// Makes a team move; whether the run goes on after it.
fn settle(
    chain: &mut PlainChain,
    intent: &PlainIntent,
    is_open: impl FnMut(Edge) -> bool,
    searched: &mut Searched,
) -> bool {
    let before = chain.cells().to_vec();
    chain.settle(intent, is_open);
    searched.moves += 1;
    let is_broken = BREACHES.iter().any(|breach| breach.is_in(&before, chain.cells()));
    searched.runs += u64::from(is_broken);
    !is_broken
}

/// The fastest of a few runs, too long for Criterion's many.
fn fastest(run: impl Fn() -> Searched) -> Cost<Searched> {
    let costs = (0..3).map(|_| {
        let start = Instant::now();
        let work = run();
        Cost::new(work, start.elapsed().as_secs_f64())
    });
    costs.min_by(|one, other| one.micros.total_cmp(&other.micros)).expect("a run")
}

/// Ours and the naive search, four robots with at most 2 and 3 walls.
fn against_a_naive_search(criterion: &mut Criterion, thread: &ThreadPool) -> [(u32, [Cost<Searched>; 2]); 2] {
    let mut group = group(criterion, "against a naive search");
    let few = bounds(4, 2);
    let id = BenchmarkId::from_parameter;
    let few_costs = [
        measure(&mut group, id("search"), || search_within(&few, thread)),
        measure(&mut group, id("naive search"), || search_naively(&few)),
    ];
    let more = bounds(4, 3);
    let more_costs = [fastest(|| search_within(&more, thread)), fastest(|| search_naively(&more))];
    for [ours, naive] in [&few_costs, &more_costs] {
        assert_eq!(ours.work, naive.work, "they search the same tree");
    }
    [(2, few_costs), (3, more_costs)]
}

/// Everything looked for that a hunt looks for, by the number of robots and the most walls.
fn hunts(criterion: &mut Criterion, thread: &ThreadPool) -> [(usize, u32, Cost<Searched>); 7] {
    let mut group = group(criterion, "hunt");
    [(2, 12), (3, 4), (4, 3), (5, 2), (6, 2), (7, 1), (8, 1)].map(|(robots, max_walls)| {
        let bounds = Bounds::new(Observed::PUBLISHED, robots, max_walls);
        let id = BenchmarkId::new(robots.to_string(), max_walls);
        (robots, max_walls, measure(&mut group, id, || search_within(&bounds, thread)))
    })
}

/// Four robots and at most 4 walls, on one thread and on two.
fn on_more_threads() -> [(usize, Cost<Searched>); 2] {
    let bounds = Bounds::new(Observed::PUBLISHED, 4, 4);
    let costs = [1, 2].map(|count| {
        let threads = threads(count);
        (count, fastest(|| search_within(&bounds, &threads)))
    });
    assert_eq!(costs[0].1.work, costs[1].1.work, "threads change nothing");
    costs
}

fn main() {
    let mut criterion = Criterion::default().configure_from_args();
    let thread = threads(1);
    let naive = against_a_naive_search(&mut criterion, &thread);
    let hunts = hunts(&mut criterion, &thread);
    let threads = on_more_threads();
    criterion.final_summary();

    println!("\nMillion team moves per second of one thread, N = 4, published");
    println!("  walls     runs      moves  search  naive  ratio (at least 10 is asked for)");
    for (max_walls, [ours, naive]) in naive {
        let Searched { runs, moves } = ours.work;
        let (ours, naive) = (1.0 / ours.micros, 1.0 / naive.micros);
        println!("  {max_walls:>5} {runs:>8} {moves:>10} {ours:>7.2} {naive:>6.3} {:>6.1}", ours / naive);
    }

    println!("\nMillion team moves per second of one thread, with the ends of the runs looked at");
    println!("    N  walls     runs      moves   rate");
    for (robots, max_walls, cost) in hunts {
        let Searched { runs, moves } = cost.work;
        println!("  {robots:>3} {max_walls:>6} {runs:>8} {moves:>10} {:>6.2}", 1.0 / cost.micros);
    }

    println!("\nThe same on more threads, N = 4, 4 walls");
    println!("  threads     runs      moves   rate");
    for (threads, cost) in threads {
        let Searched { runs, moves } = cost.work;
        println!("  {threads:>7} {runs:>8} {moves:>10} {:>6.2}", 1.0 / cost.micros);
    }
}

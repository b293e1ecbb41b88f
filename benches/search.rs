//! The cost of a team move of the search over all layouts: against two searches as one would first write them, by the
//! number of robots and the rule, and on two threads. Criterion follows the shorter searches over time; the tables at
//! the end relate them to one another.

use std::time::Instant;

use criterion::{BenchmarkId, Criterion};
use rayon::{ThreadPool, ThreadPoolBuilder};
use tautline_benches::{Cost, Work, group, measure};
use tautline_kernel::chain::Rule;
use tautline_kernel::ground::{Edge, Step};
use tautline_proofs::chain::Subject;
use tautline_proofs::chain::breach::Breach;
use tautline_proofs::chain::invariant::Invariant;
use tautline_proofs::chain::plain::{PlainChain, PlainIntent};
use tautline_proofs::chain::search::{Bounds, search};
use tautline_proofs::engine::tree::unwatched;

/// The violations that all searches look for after every team move. None of them looks at how a run ends.
const BREACHES: [Breach; 3] = [Breach::Contact, Breach::Crowding, Breach::Coverage];

/// The work of a search.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
struct SearchWork {
    runs: u64,
    moves: u64,
}

impl Work for SearchWork {
    fn parts(&self) -> u32 {
        u32::try_from(self.moves).expect("not so many moves")
    }
}

/// The published rule in the paper's area, with the breaches of [`BREACHES`] looked for.
fn bounds(robots: usize, max_walls: u32) -> Bounds {
    let invariants = BREACHES.map(Invariant::Without).to_vec();
    Bounds { invariants, ..Bounds::new(Subject::PUBLISHED, robots, max_walls) }
}

fn search_within(bounds: &Bounds, threads: &ThreadPool) -> SearchWork {
    let found = threads.install(|| search(bounds, &mut unwatched)).expect("bounds that can be searched");
    assert!(found.complete);
    SearchWork { runs: found.runs, moves: found.moves }
}

fn threads(count: usize) -> ThreadPool {
    ThreadPoolBuilder::new().num_threads(count).build().expect("threads")
}

/// When a naive search copies its chain.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Copies {
    /// For every outcome of every team move.
    Always,
    /// Where a team move can come out in several ways, for each of them but the last.
    AtForks,
}

/// The runs of [`search_within`], depth first over plain chains: each team move is made for every way in which some of
/// the edges that nobody knows are walls.
fn search_naively(bounds: &Bounds, copies: Copies) -> SearchWork {
    let chain = PlainChain::new(Rule::PUBLISHED, bounds.robots, bounds.base, bounds.area);
    let mut searched = SearchWork::default();
    follow(chain, bounds.max_walls, copies, &mut searched);
    searched
}

fn follow(mut chain: PlainChain, mut walls: u32, copies: Copies, searched: &mut SearchWork) {
    loop {
        let (intent, _) = chain.plan(u64::MAX).expect("no limit");
        if matches!(intent, PlainIntent::Explored | PlainIntent::Exhausted) {
            searched.runs += 1;
            return;
        }
        let tried = tried(&chain, &intent);
        let is_open = |blocked: u32| {
            let tried = &tried;
            move |edge| {
                tried.iter().position(|&one| one == edge).is_none_or(|place| blocked >> place & 1 == 0)
            }
        };
        let mut outcomes =
            (0_u32..1 << tried.len()).filter(|blocked| blocked.count_ones() <= walls).peekable();
        let mut last = None;
        while let Some(blocked) = outcomes.next() {
            if copies == Copies::AtForks && outcomes.peek().is_none() {
                last = Some(blocked);
                break;
            }
            let mut next = chain.clone();
            if settle(&mut next, &intent, is_open(blocked), searched) {
                follow(next, walls - blocked.count_ones(), copies, searched);
            }
        }
        let Some(blocked) = last else { return };
        if !settle(&mut chain, &intent, is_open(blocked), searched) {
            return;
        }
        walls -= blocked.count_ones();
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
    searched: &mut SearchWork,
) -> bool {
    let before = chain.cells().to_vec();
    chain.settle(intent, is_open);
    searched.moves += 1;
    let is_broken = BREACHES.iter().any(|breach| breach.is_in(&before, chain.cells()));
    searched.runs += u64::from(is_broken);
    !is_broken
}

/// The fastest of `times` runs, too long for Criterion's many.
fn fastest(times: u32, run: impl Fn() -> SearchWork) -> Cost<SearchWork> {
    let costs = (0..times).map(|_| {
        let start = Instant::now();
        let work = run();
        Cost::new(work, start.elapsed().as_secs_f64())
    });
    costs.min_by(|one, other| one.micros.total_cmp(&other.micros)).expect("a run")
}

/// Ours and the naive searches, four robots with at most 2, 3 and 4 walls. Each of the longer ones is measured between
/// two of the others, so that all meet the same machine.
fn against_naive_searches(
    criterion: &mut Criterion,
    thread: &ThreadPool,
) -> [(u32, [Cost<SearchWork>; 3]); 3] {
    let mut group = group(criterion, "against naive searches");
    let few = bounds(4, 2);
    let id = BenchmarkId::from_parameter;
    let few_costs = [
        measure(&mut group, id("search"), || search_within(&few, thread)),
        measure(&mut group, id("naive search"), || search_naively(&few, Copies::Always)),
        measure(&mut group, id("naive search, copies at forks"), || search_naively(&few, Copies::AtForks)),
    ];
    let [more_costs, most_costs] = [(3, 3), (4, 1)].map(|(max_walls, times)| {
        let bounds = bounds(4, max_walls);
        let rounds = (0..times).map(|_| {
            [
                fastest(3, || search_within(&bounds, thread)),
                fastest(1, || search_naively(&bounds, Copies::Always)),
                fastest(1, || search_naively(&bounds, Copies::AtForks)),
            ]
        });
        let best = |best: [Cost<SearchWork>; 3], round: [Cost<SearchWork>; 3]| {
            let mut round = round.into_iter();
            best.map(|best| round.next().filter(|cost| cost.micros < best.micros).unwrap_or(best))
        };
        rounds.reduce(best).expect("a round")
    });
    let all = [(2, few_costs), (3, more_costs), (4, most_costs)];
    for (_, [ours, naive, leaner]) in &all {
        assert!(ours.work == naive.work && ours.work == leaner.work, "they search the same tree");
    }
    all
}

/// Everything looked for that a hunt looks for, by the number of robots and the most walls: under the published rule
/// and the repaired one.
fn hunts(criterion: &mut Criterion, thread: &ThreadPool) -> [(u32, u32, [Cost<SearchWork>; 2]); 7] {
    let mut group = group(criterion, "hunt");
    [(2, 12), (3, 4), (4, 3), (5, 2), (6, 2), (7, 1), (8, 1)].map(|(robots, max_walls)| {
        let rules = [("published", Subject::PUBLISHED), ("repaired", Subject::REPAIRED)];
        let costs = rules.map(|(rule, observed)| {
            let bounds = Bounds::new(observed, robots as usize, max_walls);
            let id = BenchmarkId::new(format!("{rule}, {robots}"), max_walls);
            measure(&mut group, id, || search_within(&bounds, thread))
        });
        (robots, max_walls, costs)
    })
}

/// Four robots and at most 4 walls, on one thread and on two.
fn on_more_threads() -> [(usize, Cost<SearchWork>); 2] {
    let bounds = Bounds::new(Subject::PUBLISHED, 4, 4);
    let costs = [1, 2].map(|count| {
        let threads = threads(count);
        (count, fastest(3, || search_within(&bounds, &threads)))
    });
    assert_eq!(costs[0].1.work, costs[1].1.work, "threads change nothing");
    costs
}

fn main() {
    let mut criterion = Criterion::default().configure_from_args();
    let thread = threads(1);
    let naive = against_naive_searches(&mut criterion, &thread);
    let hunts = hunts(&mut criterion, &thread);
    let threads = on_more_threads();
    criterion.final_summary();

    println!("\nMillion team moves per second of one thread, N = 4, published");
    println!("                                      naive, copies         ratio to the leaner");
    println!("  walls     runs      moves  search  always  at forks  (at least 10 is asked for)");
    for (max_walls, [ours, naive, leaner]) in naive {
        let SearchWork { runs, moves } = ours.work;
        let ratio = naive.micros.min(leaner.micros) / ours.micros;
        let [ours, naive, leaner] = [ours, naive, leaner].map(|cost| 1.0 / cost.micros);
        println!(
            "  {max_walls:>5} {runs:>8} {moves:>10} {ours:>7.2} {naive:>7.3} {leaner:>9.3} {ratio:>7.1}"
        );
    }

    println!(
        "\nThe same with the ends of the runs looked at, by rule: team moves, the rate, and the rate times N"
    );
    println!("    N  walls    published  rate   × N     repaired  rate   × N");
    for (robots, max_walls, costs) in hunts {
        let [published, repaired] = costs.map(|cost| {
            let rate = 1.0 / cost.micros;
            format!("{:>12} {rate:>5.2} {:>5.1}", cost.work.moves, rate * f64::from(robots))
        });
        println!("  {robots:>3} {max_walls:>6} {published} {repaired}");
    }

    println!("\nThe same on more threads, N = 4, 4 walls");
    println!("  threads     runs      moves   rate");
    for (threads, cost) in threads {
        let SearchWork { runs, moves } = cost.work;
        println!("  {threads:>7} {runs:>8} {moves:>10} {:>6.2}", 1.0 / cost.micros);
    }
}

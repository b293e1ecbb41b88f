//! The cost of a team move of the chain: against the plain recursion, in open areas of every size, and among random
//! walls. Criterion follows each figure over time; the tables at the end relate them to one another.

use criterion::{BenchmarkId, Criterion};
use tautline_benches::{Cost, group, measure};
use tautline_grids::heap_grid::HeapGrid;
use tautline_grids::layout::{Generator, Layout};
use tautline_kernel::chain::{Chain, Intent, Rule};
use tautline_kernel::ground::{Area, Cell, Grid, MediumGrid, SmallGrid};
use tautline_proofs::chain::plain::{PlainChain, PlainIntent};

/// The work of a run, or of several.
#[derive(Clone, Copy, Default)]
struct Work {
    team_moves: u32,
    /// The most candidates of followers that one plan looked at.
    most_looked_at: u32,
}

impl tautline_benches::Work for Work {
    fn parts(&self) -> u32 {
        self.team_moves
    }
}

/// A repaired chain of `ROBOTS` in a layout of its own size, followed for `most` team moves.
fn run<G: Grid, const ROBOTS: usize>(layout: &Layout, grid: fn(Area) -> G, most: u32) -> Work {
    run_by::<G, ROBOTS>(Rule::REPAIRED, layout, grid, most)
}

/// A reel of `ROBOTS` in a layout of its own size, followed for `most` team moves.
fn run_reel<G: Grid, const ROBOTS: usize>(layout: &Layout, grid: fn(Area) -> G, most: u32) -> Work {
    run_by::<G, ROBOTS>(Rule::REEL, layout, grid, most)
}

fn run_by<G: Grid, const ROBOTS: usize>(rule: Rule, layout: &Layout, grid: fn(Area) -> G, most: u32) -> Work {
    let (area, base) = area_of(layout);
    let mut chain = Chain::<G, ROBOTS>::new(rule, ROBOTS, base, grid(area)).expect("a chain");
    let mut log = Vec::new();
    let mut work = Work::default();
    while work.team_moves < most {
        let Intent::Go(plan) = chain.plan(&log).expect("messages of the chain") else { break };
        work.most_looked_at = work.most_looked_at.max(chain.looked_at());
        work.team_moves += 1;
        log.extend_from_slice(chain.settle(&plan, |edge| layout.is_open(edge)).messages());
    }
    work
}

/// As [`run`], by the plain recursion, with a flood fill for every candidate.
fn run_plain(layout: &Layout, robots: usize) -> Work {
    let (area, base) = area_of(layout);
    let mut chain = PlainChain::new(Rule::REPAIRED, robots, base, area);
    let mut work = Work::default();
    loop {
        let (intent, looked_at) = chain.plan(u64::MAX).expect("no limit");
        if matches!(intent, PlainIntent::Explored | PlainIntent::Exhausted) {
            return work;
        }
        work.most_looked_at = work.most_looked_at.max(looked_at as u32);
        work.team_moves += 1;
        chain.settle(&intent, |edge| layout.is_open(edge));
    }
}

fn area_of(layout: &Layout) -> (Area, Cell) {
    (layout.size().area(), layout.default_base().expect("a free cell"))
}

fn small(area: Area) -> SmallGrid {
    SmallGrid::new(area).expect("at most 16 cells wide")
}

fn medium(area: Area) -> MediumGrid {
    MediumGrid::new(area).expect("at most 64 cells wide")
}

/// Layouts for a chain of `robots`, each cell side a wall with the probability `walls`.
fn random_layouts(robots: usize, walls: f64, count: u64) -> Vec<Layout> {
    let side = 2 * robots - 1;
    let generator: Generator = format!("walls:{side}x{side}:{walls}").parse().expect("a generator");
    (0..count).map(|seed| generator.generate(seed).expect("free cells")).collect()
}

/// Does `run` in every layout, and adds up.
fn in_all(layouts: &[Layout], run: impl Fn(&Layout) -> Work) -> Work {
    layouts.iter().map(run).fold(Work::default(), |sum, work| Work {
        team_moves: sum.team_moves + work.team_moves,
        most_looked_at: sum.most_looked_at.max(work.most_looked_at),
    })
}

/// The kernel's cost and the plain recursion's: 8 robots in 20 layouts with a tenth of the cell sides walls.
fn against_the_plain_recursion(criterion: &mut Criterion) -> [Cost<Work>; 2] {
    let layouts = random_layouts(8, 0.1, 20);
    let mut group = group(criterion, "against the plain recursion");
    let kernel = measure(&mut group, BenchmarkId::from_parameter("kernel"), || {
        in_all(&layouts, |layout| run::<_, 8>(layout, small, u32::MAX))
    });
    let plain = measure(&mut group, BenchmarkId::from_parameter("plain recursion"), || {
        in_all(&layouts, |layout| run_plain(layout, 8))
    });
    assert_eq!(kernel.work.team_moves, plain.work.team_moves, "they make the same moves");
    [kernel, plain]
}

/// Whole runs without obstacles, by the number of robots.
fn open_areas(criterion: &mut Criterion) -> [(u16, Cost<Work>); 6] {
    let mut group = group(criterion, "open area");
    macro_rules! each {
        ($($robots:literal),*) => {[$({
            let side = 2 * $robots - 1;
            let layout = Layout::open(side, side).expect("a layout");
            let id = BenchmarkId::from_parameter($robots);
            ($robots, measure(&mut group, id, || run::<_, $robots>(&layout, HeapGrid::new, u32::MAX)))
        }),*]};
    }
    each!(8, 16, 32, 64, 128, 256)
}

/// The first team moves in random layouts, by the number of robots and the share of walls.
fn random_walls(criterion: &mut Criterion) -> Vec<(u16, f64, Cost<Work>)> {
    const TEAM_MOVES: u32 = 500;
    let mut group = group(criterion, "random walls");
    let mut costs = Vec::new();
    for walls in [0.05, 0.1, 0.2, 0.3] {
        macro_rules! each {
            ($($robots:literal in $grid:expr),*) => {$(
                let layouts = random_layouts($robots, walls, 3);
                let cost = measure(&mut group, BenchmarkId::new($robots.to_string(), walls), || {
                    in_all(&layouts, |layout| run::<_, $robots>(layout, $grid, TEAM_MOVES))
                });
                costs.push(($robots, walls, cost));
            )*};
        }
        each!(16 in medium, 24 in medium, 32 in medium, 64 in HeapGrid::new);
    }
    costs
}

/// Whole runs of the reel without obstacles, by the number of robots.
fn open_areas_by_reel(criterion: &mut Criterion) -> [(u16, Cost<Work>); 6] {
    let mut group = group(criterion, "open area, reel");
    macro_rules! each {
        ($($robots:literal),*) => {[$({
            let side = 2 * $robots - 1;
            let layout = Layout::open(side, side).expect("a layout");
            let id = BenchmarkId::from_parameter($robots);
            ($robots, measure(&mut group, id, || run_reel::<_, $robots>(&layout, HeapGrid::new, u32::MAX)))
        }),*]};
    }
    each!(8, 16, 32, 64, 128, 256)
}

/// The first team moves of the reel in random layouts, by the number of robots and the share of walls.
fn random_walls_by_reel(criterion: &mut Criterion) -> Vec<(u16, f64, Cost<Work>)> {
    const TEAM_MOVES: u32 = 500;
    let mut group = group(criterion, "random walls, reel");
    let mut costs = Vec::new();
    for walls in [0.05, 0.1, 0.2] {
        macro_rules! each {
            ($($robots:literal in $grid:expr),*) => {$(
                let layouts = random_layouts($robots, walls, 3);
                let cost = measure(&mut group, BenchmarkId::new($robots.to_string(), walls), || {
                    in_all(&layouts, |layout| run_reel::<_, $robots>(layout, $grid, TEAM_MOVES))
                });
                costs.push(($robots, walls, cost));
            )*};
        }
        each!(8 in small, 16 in medium, 32 in medium, 64 in HeapGrid::new);
    }
    costs
}

/// The cost of certifying the plans of a repaired run of 8 robots, and how many they are.
fn certificates(criterion: &mut Criterion) -> Cost<Work> {
    let layout = &random_layouts(8, 0.1, 1)[0];
    let (area, base) = area_of(layout);
    let mut chain = Chain::<_, 8>::new(Rule::REPAIRED, 8, base, small(area)).expect("a chain");
    let (mut log, mut plans) = (Vec::new(), Vec::new());
    while let Intent::Go(plan) = chain.plan(&log).expect("messages of the chain") {
        plans.push((*chain.grid(), chain.cells().to_vec(), plan));
        log.extend_from_slice(chain.settle(&plan, |edge| layout.is_open(edge)).messages());
    }
    let mut group = group(criterion, "certificates");
    measure(&mut group, BenchmarkId::from_parameter(8), || {
        let admitted = plans
            .iter_mut()
            .map(|(grid, team, plan)| Rule::REPAIRED.admits_plan(grid, team, plan.steps()))
            .filter(|&admitted| admitted);
        std::hint::black_box(admitted.count());
        Work { team_moves: plans.len() as u32, most_looked_at: 0 }
    })
}

fn main() {
    let mut criterion = Criterion::default().configure_from_args();
    let [kernel, plain] = against_the_plain_recursion(&mut criterion);
    let open = open_areas(&mut criterion);
    let random = random_walls(&mut criterion);
    let open_by_reel = open_areas_by_reel(&mut criterion);
    let random_by_reel = random_walls_by_reel(&mut criterion);
    let certificates = certificates(&mut criterion);
    criterion.final_summary();

    println!("\nA team move, N = 8, 10 % walls, in {} moves", kernel.work.team_moves);
    println!("  kernel           {:>9.2} µs", kernel.micros);
    println!("  plain recursion  {:>9.2} µs", plain.micros);
    println!("  ratio            {:>9.1}    (at least 10 is asked for)", plain.micros / kernel.micros);

    println!("\nA team move in an open area of (2N−1)² cells");
    println!("    N   moves       µs     µs/N");
    for (robots, Cost { work, micros }) in open {
        println!("  {robots:>3} {:>7} {micros:>8.2} {:>8.4}", work.team_moves, micros / f64::from(robots));
    }

    println!("\nA team move in random layouts, and the candidates its dearest plan looked at");
    println!("    N  walls       µs     µs/N  candidates/N (below 100 is asked for)");
    for (robots, walls, Cost { work, micros }) in random {
        let candidates = f64::from(work.most_looked_at) / f64::from(robots);
        let each = micros / f64::from(robots);
        println!("  {robots:>3} {:>4.0} % {micros:>8.2} {each:>8.4} {candidates:>8.1}", 100.0 * walls);
    }

    println!("\nA team move of the reel in an open area of (2N−1)² cells");
    println!("    N   moves       µs     µs/N");
    for (robots, Cost { work, micros }) in open_by_reel {
        println!("  {robots:>3} {:>7} {micros:>8.2} {:>8.4}", work.team_moves, micros / f64::from(robots));
    }

    println!("\nA team move of the reel in random layouts (below 30 µs is asked for at N = 8)");
    println!("    N  walls       µs     µs/N");
    for (robots, walls, Cost { micros, .. }) in random_by_reel {
        println!("  {robots:>3} {:>4.0} % {micros:>8.2} {:>8.4}", 100.0 * walls, micros / f64::from(robots));
    }

    println!("\nA certificate of a plan, N = 8, {} plans", certificates.work.team_moves);
    println!("  certificate      {:>9.3} µs", certificates.micros);
    println!("  of a team move   {:>9.1} %", 100.0 * certificates.micros / kernel.micros);
}

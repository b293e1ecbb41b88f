//! Decisions of robots that explore cells, by the rule, the size of the area and the number of robots: whole runs, as
//! many elements as there are decisions, one of each robot in a team move.

use std::hint::black_box;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use tautline_grids::layout::{Generator, Layout};
use tautline_kernel::frontier::Rule;
use tautline_kernel::ground::Cell;
use tautline_sim::frontier::Explorers;
use tautline_sim::options::Options;

/// The team moves of a whole run.
fn moves(rule: Rule, layout: &Layout, starts: &[Cell]) -> u64 {
    let mut team = Explorers::new(rule, layout, starts, Options::default(), 0);
    let mut moves = 0;
    while team.advance().is_ok() {
        moves += 1;
    }
    moves
}

fn runs(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("frontier");
    group.sample_size(10);
    for (side, robots) in [(8, 1), (8, 8), (32, 1), (32, 8), (64, 8)] {
        let generator: Generator = format!("cells:{side}x{side}:0.1").parse().expect("a generator");
        let layout = generator.generate(0).expect("a layout");
        let starts: Vec<Cell> = layout.cells().filter(|&cell| layout.is_free(cell)).take(robots).collect();
        for (name, rule) in [("repaired", Rule::REPAIRED), ("plain", Rule::PLAIN)] {
            group.throughput(Throughput::Elements(robots as u64 * moves(rule, &layout, &starts)));
            group.bench_function(BenchmarkId::new(format!("{name}, {robots} robots"), side), |bencher| {
                bencher.iter(|| moves(rule, black_box(&layout), &starts));
            });
        }
    }
    group.finish();
}

criterion_group!(benches, runs);
criterion_main!(benches);

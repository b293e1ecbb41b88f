//! Decisions of robots that keep in touch, by the size of the map and the number of robots: whole runs, as many
//! elements as there are drives.

use std::hint::black_box;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use tautline_grids::layout::{Generator, Layout};
use tautline_kernel::ground::Cell;
use tautline_kernel::kit::Rule;
use tautline_sim::kit::{Pace, course, starts};

/// The drives of a whole run.
fn drives(layout: &Layout, starts: &[Cell]) -> u64 {
    let Ok(mut course) = course(Rule::REPAIRED, layout, starts, Pace::STEADY, 0) else { return 0 };
    let mut drives = 0;
    while course.drive().is_some() {
        drives += 1;
    }
    drives
}

fn runs(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("kit");
    group.sample_size(10);
    for (side, robots) in [(5, 2), (15, 2), (15, 3), (32, 2), (32, 8), (64, 2), (64, 8)] {
        let generator: Generator = format!("walls:{side}x{side}:0.1").parse().expect("a generator");
        let layout = generator.generate(0).expect("a layout");
        let starts = starts(&layout, layout.default_base().expect("a free cell"), robots);
        group.throughput(Throughput::Elements(drives(&layout, &starts)));
        group.bench_function(BenchmarkId::new(format!("{robots} robots"), side), |bencher| {
            bencher.iter(|| drives(black_box(&layout), &starts));
        });
    }
    group.finish();
}

criterion_group!(benches, runs);
criterion_main!(benches);

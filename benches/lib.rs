//! The benchmarks' common parts: how a group of them is sampled, and the cost of one part of the work, such as a team
//! move.

use std::hint::black_box;
use std::time::{Duration, Instant};

use criterion::measurement::WallTime;
use criterion::{BenchmarkGroup, BenchmarkId, Criterion, SamplingMode, Throughput};

/// A group of benchmarks that measure wall time.
pub type Group<'a> = BenchmarkGroup<'a, WallTime>;

/// A group of ten short samples of each benchmark.
pub fn group<'a>(criterion: &'a mut Criterion, name: &str) -> Group<'a> {
    let mut group = criterion.benchmark_group(name);
    group.sampling_mode(SamplingMode::Flat).sample_size(10);
    group.warm_up_time(Duration::from_millis(300)).measurement_time(Duration::from_millis(1500));
    group
}

/// The amount of work done.
pub trait Work {
    /// Of how many parts it was: team moves, receptions.
    fn parts(&self) -> u32;
}

/// The cost of one part.
pub struct Cost<W> {
    /// The work of one run.
    pub work: W,
    /// By the fastest sample; infinite if nothing was measured.
    pub micros: f64,
}

impl<W: Work> Cost<W> {
    /// The cost of a part of `work`, which took so long.
    pub fn new(work: W, seconds: f64) -> Self {
        let micros = 1e6 * seconds / f64::from(work.parts());
        Self { work, micros }
    }
}

/// Samples `run`, and relates its fastest sample to the work that it says it did.
pub fn measure<W: Work>(group: &mut Group<'_>, id: BenchmarkId, mut run: impl FnMut() -> W) -> Cost<W> {
    let work = run();
    let mut fastest_seconds = f64::INFINITY;
    group.throughput(Throughput::Elements(work.parts().into()));
    group.bench_function(id, |bencher| {
        bencher.iter_custom(|times| {
            let start = Instant::now();
            for _ in 0..times {
                black_box(run());
            }
            let taken = start.elapsed();
            fastest_seconds = fastest_seconds.min((taken / times as u32).as_secs_f64());
            taken
        });
    });
    Cost::new(work, fastest_seconds)
}

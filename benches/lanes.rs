//! How evenly a search over all layouts is shared out, counted in team moves and not timed: the moves of the busiest
//! share of a wave over the mean, and how long so many workers wait for one another at the ends of waves.

use tautline_proofs::chain::Subject;
use tautline_proofs::chain::search::{Bounds, Search};

const WORKERS: [usize; 4] = [2, 8, 32, 128];

/// The waves of a search, as they are seen.
#[derive(Default)]
struct WaveCount {
    waves: u64,
    /// Most shares in one wave: parts of the tree that have nothing in common.
    shares: usize,
    /// Team moves made.
    made: u64,
    /// Of each wave but the first of its level, the moves of the busiest share over the mean.
    busiest: Vec<f64>,
    /// How long so many workers take, in team moves.
    spans: [u64; WORKERS.len()],
}

#[expect(clippy::cast_precision_loss, reason = "ratios")]
fn ratio(of: u64, to: u64) -> f64 {
    of as f64 / to as f64
}

fn search(bounds: &Bounds) -> WaveCount {
    let mut search = Search::new(bounds).expect("bounds that can be searched");
    let mut shared = WaveCount::default();
    let mut level_of_last = None;
    let mut has_more = true;
    while has_more {
        let level = search.progress().levels.len();
        has_more = search.wave();
        let progress = search.progress();
        let (made, shares) = (progress.wave.iter().sum::<u64>(), progress.wave.len());
        if level_of_last == Some(level) {
            let busiest = progress.wave.iter().max().copied().unwrap_or_default();
            shared.busiest.push(ratio(busiest * shares as u64, made));
        }
        level_of_last = Some(level);
        shared.waves += 1;
        shared.made += made;
        shared.shares = shared.shares.max(shares);
        for (span, workers) in shared.spans.iter_mut().zip(WORKERS) {
            *span += progress.span(workers);
        }
    }
    shared.busiest.sort_unstable_by(f64::total_cmp);
    shared
}

fn main() {
    println!("The busiest share of a wave over the mean, and how much of their time workers wait");
    println!("    N  walls  waves  shares  moves made  typical  worst   {WORKERS:?} workers wait");
    for (robots, max_walls) in [(4, 3), (4, 4), (5, 3), (3, 6)] {
        let shared = search(&Bounds::new(Subject::REPAIRED, robots, max_walls));
        let WaveCount { waves, shares, made, ref busiest, spans } = shared;
        let (typical, worst) = (busiest[busiest.len() / 2], busiest[busiest.len() - 1]);
        print!(
            "  {robots:>3} {max_walls:>6} {waves:>6} {shares:>7} {made:>11} {typical:>8.3} {worst:>6.2}  "
        );
        for (span, workers) in spans.into_iter().zip(WORKERS) {
            print!(" {:>5.1} %", 100.0 * (1.0 - ratio(made, span * workers as u64)));
        }
        println!();
    }
}

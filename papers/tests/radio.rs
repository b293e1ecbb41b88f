//! Broadcasts over random networks against what an independent program measured.

use tautline_papers::tables::measure;
use tautline_papers::tables::notice_fig5::{NoticeFig5, Settings};
use tautline_papers::tables::parameter::Senders;

/// The normal distribution's 99.5 % quantile.
const NORMAL: f64 = 2.576;

/// Means over 50 topologies of an independent program at k = 1: the reach of all nodes and the rebroadcasts.
const INDEPENDENT: [(f64, f64); 5] =
    [(0.69, 91.0), (0.99, 148.0), (0.997, 152.0), (0.999, 156.0), (1.0, 159.0)];

/// Half the last digit that it prints.
const PRINTED: (f64, f64) = (0.005, 0.5);

#[test]
fn reach_and_rebroadcasts_are_compatible_with_those_of_an_independent_program() {
    let settings = Settings { ks: vec![Senders::ONE], ..Settings::default() };
    let densities = measure(&NoticeFig5, &settings, &()).expect("networks").densities;
    for (density, (reach, rebroadcasts)) in densities.iter().zip(INDEPENDENT) {
        let ours = &density.schemes[0];
        for (ours, theirs, printed) in
            [(ours.reach, reach, PRINTED.0), (ours.rebroadcasts, rebroadcasts, PRINTED.1)]
        {
            // Both have the same spread; theirs is of a quarter as many topologies.
            let margin = ours.margin().expect("an interval") * NORMAL / 1.96;
            let apart = (ours.mean - theirs).abs();
            assert!(apart <= 3.0 * margin + printed, "{} nodes: {} and {theirs}", density.nodes, ours.mean);
        }
    }
}

//! CHAIN-3 in real numbers: what `stays_in_range` decides from four corners holds for robots that move
//! continuously, at any speeds and with any pauses.

use nalgebra::Vector2;
use proptest::prelude::*;
use tautline_kernel::ground::{Cell, Step};
use tautline_proofs::chain::breach::stays_in_range;

/// The share of its way that each of two robots has behind it.
type Progress = Vector2<f64>;

/// Every way of one step between neighbouring cells, and staying.
fn ways_from(cell: Cell) -> impl Iterator<Item = [Cell; 2]> {
    Step::ALL.into_iter().map(move |step| [cell, cell.after(step)])
}

/// The ways of two robots that start at most four columns and rows apart.
fn pairs() -> impl Iterator<Item = ([Cell; 2], [Cell; 2])> {
    let offsets = (-4..=4).flat_map(|x| (-4..=4).map(move |y| Cell::new(x, y)));
    ways_from(Cell::new(0, 0))
        .flat_map(move |one| offsets.clone().flat_map(ways_from).map(move |other| (one, other)))
}

fn position([from, to]: [Cell; 2], share: f64) -> Vector2<f64> {
    let centre = |cell: Cell| Vector2::new(f64::from(cell.x), f64::from(cell.y));
    centre(from).lerp(&centre(to), share)
}

/// Whether the centres are within r_cov = √26/2 of each other. No corner lies nearer to the circle than the
/// tolerance.
fn in_range(one: [Cell; 2], other: [Cell; 2], progress: Progress) -> bool {
    let apart = position(one, progress.x) - position(other, progress.y);
    apart.norm() <= 26_f64.sqrt() / 2.0 + 1e-9
}

/// From start to arrival, in stages: in each both robots move at steady speeds of their own, or pause.
fn journeys() -> impl Strategy<Value = Vec<Progress>> {
    let advance = prop_oneof![Just(0.0), 0.0..1.0_f64];
    let stages = prop::collection::vec((advance.clone(), advance), 1..8);
    stages.prop_map(|stages| {
        let mut reached = vec![Progress::zeros()];
        for (one, other) in stages {
            let before = reached[reached.len() - 1];
            reached.push(before + (Progress::repeat(1.0) - before).component_mul(&Progress::new(one, other)));
        }
        reached.push(Progress::repeat(1.0));
        reached
    })
}

proptest! {
    #[test]
    fn robots_that_stay_in_range_do_so_at_any_speeds(journey in journeys()) {
        for (one, other) in pairs().filter(|&(one, other)| stays_in_range(one, other)) {
            for stage in journey.windows(2) {
                for share in [0.0, 0.25, 0.5, 0.75, 1.0] {
                    let progress = stage[0].lerp(&stage[1], share);
                    prop_assert!(in_range(one, other, progress), "{one:?} {other:?} at {progress:?}");
                }
            }
        }
    }
}

#[test]
fn robots_that_do_not_leave_it_when_one_of_them_goes_first() {
    let corners = [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (1.0, 1.0)];
    let mut both = [0, 0];
    for (one, other) in pairs() {
        let stays = stays_in_range(one, other);
        let all = corners
            .iter()
            .all(|&(share, other_share)| in_range(one, other, Progress::new(share, other_share)));
        assert_eq!(stays, all, "{one:?} {other:?}");
        both[usize::from(stays)] += 1;
    }
    assert!(both.iter().all(|&count| count > 100), "{both:?}");
}

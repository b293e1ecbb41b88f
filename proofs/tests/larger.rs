//! Larger areas than the clauses search.

use tautline_kernel::frontier::Rule;
use tautline_proofs::engine::states::{Limits, search};
use tautline_proofs::frontier::areas::{Size, setting};
use tautline_proofs::frontier::world::Setting;

/// States by robots and lost messages: seconds with optimisation, the last one minutes.
#[test]
#[ignore = "takes minutes: cargo test --release -p tautline-proofs --test all -- --ignored --nocapture larger_areas"]
fn larger_areas_break_nothing_of_robots_that_explore_cells() {
    fn states<const ROBOTS: usize>((columns, rows): Size, max_losses: u8) -> u64 {
        let sizes = (1..=rows).flat_map(|height| (1..=columns).map(move |width| (width, height)));
        let searched = sizes.map(|size| {
            let setting =
                Setting { max_losses, ..setting::<ROBOTS>(Rule::REPAIRED, size).expect("it is small") };
            let found = search(&setting, setting.starts(), Limits::NONE);
            assert!(found.is_whole && found.broken.is_empty(), "{size:?}: {:?}", found.broken);
            found.states
        });
        let states = searched.sum();
        println!("{ROBOTS} robots up to {columns}×{rows} cells, {max_losses} lost: {states} states");
        states
    }
    assert_eq!(states::<1>((4, 4), 0), 306_566);
    assert_eq!(states::<2>((3, 3), 1), 2_226_687);
    assert_eq!(states::<2>((4, 3), 0), 8_030_566);
    assert_eq!(states::<3>((3, 2), 1), 1_903_797);
    assert_eq!(states::<3>((3, 3), 0), 40_173_813);
}

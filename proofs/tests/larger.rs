//! Larger areas than the clauses search.

use tautline_kernel::frontier::{Condition, Rule};
use tautline_proofs::engine::states::{Limits, search};
use tautline_proofs::frontier::areas::{Size, setting};
use tautline_proofs::frontier::world::Setting;

/// States by robots and lost messages, with Keep and without it: seconds with optimisation, the last one minutes.
#[test]
#[ignore = "takes minutes: cargo test --release -p tautline-proofs --test all -- --ignored --nocapture larger_areas"]
fn larger_areas_break_nothing_of_robots_that_explore_cells() {
    fn states<const ROBOTS: usize>((columns, rows): Size, max_losses: u8) -> [u64; 2] {
        let counted = |rule: Rule| {
            let sizes = (1..=rows).flat_map(|height| (1..=columns).map(move |width| (width, height)));
            let searched = sizes.map(|size| {
                let setting = Setting { max_losses, ..setting::<ROBOTS>(rule, size).expect("it is small") };
                let found = search(&setting, setting.starts(), Limits::NONE);
                assert!(found.is_whole && found.broken.is_empty(), "{size:?}: {:?}", found.broken);
                found.states
            });
            searched.sum()
        };
        let states = [Rule::REPAIRED, Rule::REPAIRED.without(Condition::Keep)].map(counted);
        println!("{ROBOTS} robots up to {columns}×{rows} cells, {max_losses} lost: {states:?} states");
        states
    }
    let found = [
        states::<1>((4, 4), 0),
        states::<2>((3, 3), 1),
        states::<2>((4, 3), 0),
        states::<3>((3, 2), 1),
        states::<3>((3, 3), 0),
    ];
    let known = [
        [306_566, 302_543],
        [2_226_687, 1_545_860],
        [8_030_566, 5_268_146],
        [1_903_797, 1_188_479],
        [40_173_813, 18_955_238],
    ];
    assert_eq!(found, known);
}

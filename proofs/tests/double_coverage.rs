//! A cell that two robots explore (FRONTIER-13): the smallest runs, by reading.

use tautline_kernel::frontier::{Basis, Condition, Otherwise, Rule};
use tautline_proofs::engine::states::{Limits, search};
use tautline_proofs::frontier::areas::setting;
use tautline_proofs::frontier::world::{Demand, Setting};

/// By the readings under which robots explore anything: whether they see each other, what one without a
/// candidate does, whether the threshold adapts; whether obstacles are stored plays no part.
#[test]
fn the_smallest_runs_in_which_two_robots_explore_one_cell_are_those_of_the_page() {
    let smallest = |rule: Rule| {
        let sizes = [(2, 1), (3, 1), (4, 1), (2, 2), (5, 1), (3, 2)].into_iter();
        let mut broken = sizes.filter_map(|size| {
            let all =
                Setting { demand: Some(Demand::Once), ..setting::<2>(rule, size).expect("a small area") };
            let found = |setting: &Setting<2>| search(setting, setting.starts(), Limits::NONE).broken;
            found(&all).first()?;
            let open = found(&Setting { max_obstacles: 0, ..all });
            Some((size, open.first().expect("no obstacle is needed").length()))
        });
        broken.next().expect("it is refuted")
    };
    for literal in [false, true] {
        let rule = if literal { Rule::LITERAL } else { Rule::PUBLISHED };
        for basis in [Basis::Given, Basis::Neighbours] {
            let rules =
                [Otherwise::Stops, Otherwise::Wanders].map(|otherwise| Rule { basis, otherwise, ..rule });
            let blind = rules.map(smallest);
            let sees = rules.map(|rule| smallest(rule.with(Condition::Look)));
            assert_eq!(blind, [((3, 1), 4); 2], "{literal} {basis:?}");
            let stops = if basis == Basis::Given { 8 } else { 11 };
            assert_eq!(sees, [((3, 2), stops), ((3, 1), 8)], "{literal} {basis:?}");
        }
    }
}

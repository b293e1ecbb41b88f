//! Equal candidates of the chain in other orders than ours, which the paper leaves open: one order of each class that
//! turning and mirroring the plane leaves apart. And virtual obstacles that are registered later.

use std::collections::BTreeSet;

use tautline_kernel::chain::Rule;
use tautline_kernel::choice::Oracle;
use tautline_kernel::ground::{Cell, Side, Step};
use tautline_proofs::chain::Subject;
use tautline_proofs::chain::areas::smallest_run;
use tautline_proofs::chain::invariant::Invariant;
use tautline_proofs::chain::plain::{PlainChain, PlainIntent, TooMany};
use tautline_proofs::chain::readings::{Reading, Readings};
use tautline_proofs::chain::search::{Bounds, search};
use tautline_proofs::engine::SeededOracle;
use tautline_proofs::engine::smallest::{Class, Most};
use tautline_proofs::engine::tree::unwatched;

use Side::{East, North, South, West};

/// The steps in the order of these sides, and to stay.
const fn order([first, second, third, fourth]: [Side; 4]) -> [Step; 5] {
    [Step::Cross(first), Step::Cross(second), Step::Cross(third), Step::Cross(fourth), Step::Stay]
}

/// As published, each pair of opposite sides together.
const OPPOSITE: Subject = Subject { order: order([East, West, South, North]), ..Subject::PUBLISHED };

/// As published, the sides of the last pair swapped.
const SWAPPED: Subject = Subject { order: order([East, South, North, West]), ..Subject::PUBLISHED };

/// As published, with virtual obstacles for candidates that are examined alone.
const EXAMINED: Subject = Subject { readings: Readings::of(&[Reading::OnceExamined]), ..Subject::PUBLISHED };

/// The subjects that the ledger knows nothing of.
const OTHERS: [Subject; 3] = [OPPOSITE, SWAPPED, EXAMINED];

#[test]
fn the_square_turned_and_mirrored_makes_three_classes_of_the_orders_of_four_sides() {
    let places = || (0..4_u8).flat_map(|one| (0..4).map(move |other| (one, other)));
    let all = places().flat_map(|(one, two)| places().map(move |(three, four)| [one, two, three, four]));
    let orders = all.filter(|order| BTreeSet::from(*order).len() == 4);
    let class = |order: [u8; 4]| {
        let turned = (0..4)
            .flat_map(|turn| [order.map(|side| (side + turn) % 4), order.map(|side| (turn + 4 - side) % 4)]);
        turned.collect::<BTreeSet<_>>()
    };
    let classes: BTreeSet<_> = orders.map(class).collect();
    assert_eq!(classes.iter().map(BTreeSet::len).collect::<Vec<_>>(), [8, 8, 8]);
    let of = |subject: Subject| {
        let sides = [0, 1, 2, 3].map(|place| subject.order[place].place() as u8);
        classes.iter().position(|class| class.contains(&sides))
    };
    assert_eq!(BTreeSet::from([Subject::PUBLISHED, OPPOSITE, SWAPPED].map(of)).len(), 3);
}

/// So it does not matter where to stay stands among equals. The null move of a leader stands where its candidate stood.
#[test]
fn a_follower_that_may_stay_rather_stays_or_rather_goes_whatever_the_order() {
    let ahead = Cell::new(0, 0);
    for at in (-1..=1).flat_map(|x| (-1..=1).map(move |y| Cell::new(x, y))) {
        let is_safe = |cell: Cell| cell.x.abs() <= 1 && cell.y.abs() <= 1;
        let is_high = |cell: Cell| ahead.apart(cell).0 + ahead.apart(cell).1 <= 1;
        let low = Side::ALL.map(|side| at.beyond(side)).into_iter().filter(|&to| is_safe(to) && !is_high(to));
        assert!(is_high(at) || low.count() == 0, "{at}");
    }
}

#[test]
fn each_of_the_others_makes_runs_of_its_own() {
    let runs = |subject| {
        let bounds = Bounds { invariants: vec![Invariant::Ends], ..Bounds::new(subject, 3, 3) };
        search(&bounds, &mut unwatched).expect("bounds that can be searched").runs
    };
    let [opposite, swapped, examined] = OTHERS.map(runs);
    assert_eq!(BTreeSet::from([runs(Subject::PUBLISHED), opposite, swapped, examined]).len(), 4);
}

/// Columns and rows, walls, robots and team moves of the smallest run within `most` that breaks `invariant`.
fn smallest(subject: Subject, invariant: Invariant, most: &Most) -> Option<((i16, i16), u32, usize, usize)> {
    let made = smallest_run(subject, invariant, most, &mut unwatched).expect("so few robots fit");
    assert!(made.is_whole);
    made.smallest.map(|found| {
        let Class { barriers, robots, .. } = found.class;
        (found.class.size(), barriers, robots, found.moves)
    })
}

/// Those of contact and of crowding within `most`.
fn assert_sizes(contact: &Most, crowding: &Most) {
    let kept = ((3, 3), 4, 4, 8);
    let sizes = [((3, 3), 3, 4, 7), kept, kept];
    assert_eq!(OTHERS.map(|other| smallest(other, Invariant::CONTACT, contact)), sizes.map(Some));
    let sizes = [Some(((5, 2), 2, 4, 7)), None, Some(((5, 2), 2, 4, 7))];
    assert_eq!(OTHERS.map(|other| smallest(other, Invariant::CROWDING, crowding)), sizes);
}

/// Those of what remains, within `most`.
fn assert_sizes_of_the_rest(most: &Most) {
    let left_out = Some(((3, 3), 2, 3, 26));
    for other in OTHERS {
        assert_eq!(smallest(other, Invariant::COMPLETENESS, most), left_out);
        assert_eq!(smallest(other, Invariant::Exhausts, most), left_out);
        assert_eq!(smallest(other, Invariant::Meets, most), Some(((4, 1), 1, 3, 6)));
        assert_eq!(smallest(other, Invariant::Exchanges, most), Some(((2, 3), 1, 3, 6)));
    }
}

#[test]
fn what_is_refuted_as_published_is_so_in_other_orders() {
    let few = Most { cells: 10, barriers: 2, robots: 3..=4 };
    assert_sizes(&Most { cells: 9, barriers: 4, robots: 4..=4 }, &few);
    assert_sizes_of_the_rest(&few);
    let twelve = Most { cells: 12, barriers: 3, robots: 4..=4 };
    assert_eq!(smallest(SWAPPED, Invariant::CROWDING, &twelve), Some(((4, 3), 3, 4, 9)));
}

#[test]
#[ignore = "all layouts of ten cells take minutes"]
fn nothing_smaller_breaks_the_published_rule_in_other_orders() {
    let all = |cells| Most { cells, barriers: 13, robots: 2..=5 };
    assert_sizes(&all(10), &all(10));
    assert_sizes_of_the_rest(&all(10));
    assert_eq!(smallest(SWAPPED, Invariant::CROWDING, &all(11)), None);
    let twelve = Most { barriers: 3, ..all(12) };
    assert_eq!(smallest(SWAPPED, Invariant::CROWDING, &twelve), Some(((4, 3), 3, 4, 9)));
}

/// CHAIN-14, 19, 27 and 28.
#[test]
fn what_is_refuted_as_repaired_is_so_in_other_orders() {
    let most = Most { cells: 9, barriers: 3, robots: 3..=4 };
    for other in OTHERS.map(|other| other.following(Rule::REPAIRED)) {
        assert_eq!(smallest(other, Invariant::Exhausts, &most), Some(((3, 3), 3, 3, 32)));
        assert_eq!(smallest(other, Invariant::AnyOrder, &most), Some(((4, 2), 1, 4, 7)));
        assert_eq!(smallest(other, Invariant::Meets, &most), Some(((4, 1), 1, 3, 6)));
        assert_eq!(smallest(other, Invariant::Exchanges, &most), Some(((2, 3), 1, 3, 6)));
    }
}

/// CHAIN-3 and CHAIN-7, CHAIN-15 for three robots, and for the repaired rule also CHAIN-1, 2 and 13.
#[test]
fn what_holds_holds_in_other_orders() {
    let [contact, crowding, coverage, ends] =
        [Invariant::CONTACT, Invariant::CROWDING, Invariant::COVERAGE, Invariant::Ends];
    let published = [(3, 3, vec![contact, crowding, coverage, ends]), (4, 2, vec![coverage, ends])];
    let all = vec![contact, crowding, coverage, ends, Invariant::COMPLETENESS];
    let repaired = [(3, 3, all.clone()), (4, 2, all)];
    let by_rule = [(Rule::PUBLISHED, published), (Rule::REPAIRED, repaired)];
    for (rule, bounds) in by_rule {
        for (robots, walls, invariants) in bounds {
            for other in OTHERS.map(|other| other.following(rule)) {
                let bounds = Bounds { invariants: invariants.clone(), ..Bounds::new(other, robots, walls) };
                let found = search(&bounds, &mut unwatched).expect("bounds that can be searched");
                let is_clean = found.complete && found.given_up == 0 && found.counterexamples.is_empty();
                assert!(is_clean && found.runs > 1000, "{found:?}");
            }
        }
    }
}

/// The chain of so many robots in the paper's area.
fn chain(subject: Subject, robots: usize) -> PlainChain {
    let Bounds { area, base, .. } = Bounds::new(subject, robots, 0);
    PlainChain::of(&subject, robots, base, area).expect("all start in the base").that_floods_once()
}

/// CHAIN-9; and CHAIN-26, since 8 and 12 team moves are enough for these cells, whatever the order.
#[test]
fn an_open_area_takes_as_many_team_moves_in_other_orders() {
    for other in OTHERS {
        for robots in 2..=16 {
            let mut chain = chain(other, robots);
            let mut explored = vec![chain.cells().iter().copied().collect::<BTreeSet<_>>()];
            while let Ok((PlainIntent::Advance(steps), _)) = chain.plan(u64::MAX) {
                chain.settle(&PlainIntent::Advance(steps), |_| true);
                let before = &explored[explored.len() - 1];
                explored.push(before.iter().chain(chain.cells()).copied().collect());
            }
            assert_eq!(explored.len() - 1, 9 * (robots - 1) - 1);
            assert_eq!(explored[explored.len() - 1].len(), (2 * robots - 1).pow(2));
            if robots == 3 {
                let after = |cells| explored.iter().position(|explored| explored.len() >= cells);
                assert_eq!([13, 19].map(after), [Some(9), Some(13)]);
            }
        }
    }
}

/// CHAIN-12, of the plain recursion.
#[test]
fn a_plan_is_dear_in_other_orders() {
    for other in OTHERS {
        let mut chain = chain(other, 24);
        let mut world = SeededOracle::new(0, 0);
        let dear = (0..2000).find_map(|_| match chain.plan(100 * 24) {
            Err(TooMany) => Some(true),
            Ok((intent, _)) if intent.steps().is_none() => Some(false),
            Ok((intent, _)) => {
                chain.settle(&intent, |_| world.pick(100) >= 15);
                None
            }
        });
        assert_eq!(dear, Some(true));
    }
}

//! Robots that keep in touch (KIT) where two ways of theirs are as good, where another one is to go first, and where
//! paths or memory end.

use tautline_kernel::choice::Oracle;
use tautline_kernel::ground::{Area, Cell, Edge, EdgeMark, Grid, Side, Step, TinyGrid};
use tautline_kernel::kit::{Condition, Kit, Next, Rule, Sight};

/// An oracle that picks this one, or the last one.
struct Nth(u32);

impl Oracle for Nth {
    fn pick(&mut self, below: u32) -> u32 {
        self.0.min(below - 1)
    }
}

const fn node(x: i16, y: i16) -> Cell {
    Cell::new(x, y)
}

fn edge((x, y, side): (i16, i16, Side)) -> Edge {
    Edge::new(node(x, y), side)
}

/// So many columns and rows of nodes. Paths begin at these nodes, on these sides: `driven` ones, and those of which
/// nothing is known. All others are blocked.
fn map(width: i16, height: i16, driven: &[(i16, i16, Side)], unknown: &[(i16, i16, Side)]) -> TinyGrid {
    let area = Area::new(node(0, 0), node(width - 1, height - 1)).expect("an area");
    let mut map = TinyGrid::new(area).expect("a small map");
    let [driven, unknown] =
        [driven, unknown].map(|paths| paths.iter().map(|&path| edge(path)).collect::<Vec<_>>());
    for path in area.edges() {
        if driven.contains(&path) {
            map.put_edge(EdgeMark::Open, path);
        } else if !unknown.contains(&path) {
            map.put_edge(EdgeMark::Wall, path);
        }
    }
    map
}

/// The eastern sides of the nodes in these columns of the first row.
fn row<const PATHS: usize>(columns: [i16; PATHS]) -> [(i16, i16, Side); PATHS] {
    columns.map(|x| (x, 0, Side::East))
}

#[test]
fn a_robot_takes_any_of_the_shortest_ways_to_an_uncovered_side() {
    let unknown = [(0, 0, Side::South), (4, 0, Side::South)];
    let map = map(5, 2, &row([0, 1, 2, 3]), &unknown);
    let begins = [0, 1].map(|pick| {
        let mut kit = Kit::<_, 1, 10>::new(Rule::REPAIRED, map, &[node(2, 0)]).expect("a team");
        kit.decide(0, &mut Nth(pick))
    });
    assert_eq!(begins, [Ok(Next::Looks(Side::East)), Ok(Next::Looks(Side::West))]);
}

#[test]
fn a_robot_waits_for_one_that_is_nearer_to_an_uncovered_side_unless_that_one_drives_a_new_path() {
    let unknown = [(0, 0, Side::South), (2, 0, Side::East), (3, 0, Side::South)];
    let map = map(4, 2, &row([0, 1]), &unknown);
    let starts = [node(1, 0), node(2, 0)];
    let mut kit = Kit::<_, 2, 8>::new(Rule::REPAIRED, map, &starts).expect("a team");
    assert_eq!(kit.decide(0, &mut Nth(0)), Ok(Next::Stays), "the second one has the uncovered side");
    assert_eq!(kit.decide(1, &mut Nth(0)), Ok(Next::Looks(Side::East)));
    assert_eq!(kit.looked(1, Sight::Free, &mut Nth(0)), Ok(Next::Drives(node(3, 0))));
    // It could wait for the second one to arrive at an uncovered side, but goes back to one of its own meanwhile.
    assert_eq!(kit.decide(0, &mut Nth(0)), Ok(Next::Looks(Side::West)));
}

#[test]
fn a_robot_waits_for_one_that_drives_an_old_path() {
    let unknown = [(0, 0, Side::South), (3, 0, Side::South)];
    let map = map(4, 2, &row([0, 1, 2]), &unknown);
    let starts = [node(2, 0), node(1, 0)];
    let mut kit = Kit::<_, 2, 8>::new(Rule::REPAIRED, map, &starts).expect("a team");
    assert_eq!(kit.decide(0, &mut Nth(0)), Ok(Next::Looks(Side::East)));
    assert_eq!(kit.looked(0, Sight::Free, &mut Nth(0)), Ok(Next::Drives(node(3, 0))));
    assert_eq!(kit.decide(1, &mut Nth(0)), Ok(Next::Stays), "the first one arrives at an uncovered side");
}

#[test]
fn a_joint_way_is_found_though_robots_may_meet() {
    let map = map(3, 2, &row([0, 1]), &[(2, 0, Side::South)]);
    for rule in [Rule::REPAIRED, Rule::REPAIRED.without(Condition::Apart)] {
        let mut kit = Kit::<_, 2, 6>::new(rule, map, &[node(0, 0), node(1, 0)]).expect("a team");
        assert_eq!(kit.decide(0, &mut Nth(0)), Ok(Next::Stays), "the second one goes on");
        assert_eq!(kit.decide(1, &mut Nth(0)), Ok(Next::Looks(Side::East)));
    }
}

#[test]
fn three_robots_stay_tied_by_paths_and_two_by_radio_alone() {
    // The way round leads over the nodes 0,1, 0,0, 1,0, 2,0, 2,1 and 2,2.
    let round = [
        (0, 0, Side::South),
        (0, 0, Side::East),
        (1, 0, Side::East),
        (2, 0, Side::South),
        (2, 1, Side::South),
    ];
    let map = map(3, 4, &round, &[(2, 2, Side::South)]);
    let south = Step::Cross(Side::South);
    let starts = [node(2, 2), node(0, 1), node(0, 0)];
    let trio = |rule: Rule| Kit::<_, 3, 12>::new(rule, map, &starts).expect("a team");
    assert!(!trio(Rule::REPAIRED).admits(0, south));
    assert!(trio(Rule::REPAIRED.without(Condition::Tether)).admits(0, south));
    let pair = Kit::<_, 2, 12>::new(Rule::REPAIRED, map, &starts[..2]).expect("a team");
    assert!(pair.admits(0, south));
}

#[test]
fn records_of_a_larger_map_are_used_as_far_as_there_is_room() {
    let small = map(4, 1, &row([0, 1, 2]), &[]);
    let kit = Kit::<_, 1, 4>::new(Rule::REPAIRED, small, &[node(0, 0)]).expect("a team");
    let mut kit = kit.with_records(|_| map(6, 1, &row([0, 1, 2, 3]), &[(4, 0, Side::East)]));
    assert_eq!(kit.decide(0, &mut Nth(0)), Ok(Next::Done), "there is no room for the fifth node");
}

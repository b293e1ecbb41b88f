//! Frontier cells (FRONTIER): pairs are those of a program that compares all of them, and decisions turn with the area.

use std::collections::{BTreeMap, BTreeSet, VecDeque};

use proptest::prelude::*;
use tautline_kernel::choice::Oracle;
use tautline_kernel::frontier::{
    Basis, Condition, Map, Next, Other, Place, Robot, Rule, Scratch, Search, SearchCell, Sight, Slot, Stance,
    Status, Ties, TinyMap, View,
};
use tautline_kernel::ground::{Area, Cell, Side};

/// The side of the square area.
const SIDE: i16 = 7;

/// An oracle that always picks this one, or the last one.
struct Nth(u32);

impl Oracle for Nth {
    fn pick(&mut self, below: u32) -> u32 {
        assert!(below > 0, "there is nothing to pick from");
        self.0.min(below - 1)
    }
}

/// A map, and robots in explored cells of it with what they have claimed.
#[derive(Clone, Debug)]
struct Team {
    map: TinyMap,
    robots: Vec<(Cell, Option<Cell>)>,
}

fn area() -> Area {
    Area::new(Cell::new(0, 0), Cell::new(SIDE - 1, SIDE - 1)).expect("an area")
}

fn blank() -> TinyMap {
    TinyMap::new(area()).expect("49 cells")
}

/// Two cells of three are explored, and each eighth is an obstacle.
fn teams() -> impl Strategy<Value = Team> {
    let cells = (SIDE * SIDE) as usize;
    let robots = proptest::collection::vec((0..cells, proptest::option::of(0..cells)), 1..6);
    (proptest::collection::vec(0..24_u8, cells), robots).prop_map(|(statuses, robots)| {
        let cell = |number: usize| Cell::new((number as i16) % SIDE, (number as i16) / SIDE);
        let mut map = blank();
        for (number, status) in statuses.into_iter().enumerate() {
            match status {
                0..16 => map.learn(cell(number), Status::Explored),
                16..19 => map.learn(cell(number), Status::Obstacle),
                19 => map.learn(cell(number), Status::Body),
                _ => {}
            }
        }
        let mut placed: BTreeMap<usize, Option<Cell>> = BTreeMap::new();
        for (number, aim) in robots {
            placed.insert(number, aim.map(cell));
            map.learn(cell(number), Status::Explored);
        }
        Team { map, robots: placed.into_iter().map(|(number, aim)| (cell(number), aim)).collect() }
    })
}

fn next(team: &Team, robot: usize, rule: &Rule, pick: u32) -> Next {
    next_within(team, robot, rule, pick, 36).0
}

/// The next action of a robot that has memory for so many pairs, and how many searches it takes.
fn next_within(team: &Team, robot: usize, rule: &Rule, pick: u32, pairs: usize) -> (Next, u32) {
    let (at, aim) = team.robots[robot];
    let mut own = Robot::new(team.map, at, &[]);
    if let Some(aim) = aim {
        // A robot that goes round a small obstacle keeps what it has claimed.
        own.tries(Side::East, aim);
        own.looked(rule, Sight::Small);
    }
    let other = |&(cell, aim): &(Cell, Option<Cell>)| Other { cell, place: Place::midpoint(cell), aim };
    let others: Vec<Other> = team
        .robots
        .iter()
        .enumerate()
        .filter(|&(number, _)| number != robot)
        .map(|(_, robot)| other(robot))
        .collect();
    let (mut reached, mut queue) = ([SearchCell::NEVER; TinyMap::CELLS], [Cell::new(0, 0); TinyMap::CELLS]);
    let (mut rounds, mut pairs) = (0, vec![None; pairs]);
    let mut scratch = Scratch {
        search: Search { reached: &mut reached, queue: &mut queue, rounds: &mut rounds },
        pairs: &mut pairs,
    };
    own.decided(rule, &others);
    let view = View { others: &others, slot: Slot::Own };
    (own.next(rule, view, &mut scratch, &mut Nth(pick)), rounds)
}

/// An area that is explored but for these cells.
fn explored_but(unexplored: &[(i16, i16)]) -> TinyMap {
    let mut map = blank();
    area()
        .cells()
        .filter(|&cell| !unexplored.contains(&cell.into()))
        .for_each(|cell| map.learn(cell, Status::Explored));
    map
}

/// Robots in these cells, none of which has claimed one.
fn team<const ROBOTS: usize>(map: TinyMap, cells: [(i16, i16); ROBOTS]) -> Team {
    Team { map, robots: cells.map(|cell| (cell.into(), None)).into() }
}

/// The cell to which the first robot goes.
fn aim_of_first(team: &Team, pairs: usize) -> Option<(i16, i16)> {
    match next_within(team, 0, &Rule::REPAIRED, 0, pairs).0 {
        Next::Tries { aim, .. } => Some(aim.into()),
        Next::Waits | Next::Stops | Next::Done => None,
    }
}

#[test]
fn only_robots_that_may_be_as_near_to_its_cell_are_looked_at() {
    let map = explored_but(&[(0, 1), (6, 6)]);
    for (other, searches) in [((0, 6), 1), ((6, 5), 1), ((6, 0), 1), ((0, 2), 2), ((1, 1), 2)] {
        let (next, took) = next_within(&team(map, [(0, 0), other]), 0, &Rule::REPAIRED, 0, 36);
        assert!(matches!(next, Next::Tries { .. }));
        assert_eq!(took, searches, "the other one is in {other:?}");
    }
}

#[test]
fn robots_in_one_cell_count_as_one_of_which_the_first_has_a_say() {
    let map = explored_but(&[(2, 3), (4, 3)]);
    let here = Cell::new(3, 3);
    for (own, others) in [((4, 3), (2, 3)), ((2, 3), (4, 3))] {
        let two = Team { map, robots: vec![(here, Some(own.into())), (here, Some(others.into()))] };
        assert_eq!(aim_of_first(&two, 36), Some(own));
    }
}

#[test]
fn a_robot_to_which_the_others_leave_no_cell_goes_to_the_nearest_or_stands_without_lapse() {
    let team = team(explored_but(&[(3, 3)]), [(0, 3), (4, 3)]);
    let next = |rule: Rule| next(&team, 0, &rule, 0);
    assert!(matches!(next(Rule::REPAIRED), Next::Tries { aim, .. } if aim == (3, 3).into()));
    assert_eq!(next(Rule::REPAIRED.without(Condition::Lapse)), Next::Waits);
    assert_eq!(aim_of_first(&self::team(explored_but(&[]), [(0, 3), (4, 3)]), 36), None);
}

#[test]
fn a_robot_keeps_to_its_claim_and_goes_to_a_nearest_cell_once_it_has_met_another_one() {
    // The other robot is nearer to the near cell.
    let map = explored_but(&[(3, 1), (6, 6)]);
    let (at, near, far) = (Cell::new(3, 4), Cell::new(3, 1), Cell::new(6, 6));
    let goes = |rule: Rule, sight: Option<Sight>| {
        let mut robot = Robot::new(map, at, &[]);
        if let Some(sight) = sight {
            robot.tries(Side::South, near);
            robot.looked(&rule, sight);
        }
        let other = Cell::new(3, 2);
        let others = [Other { cell: other, place: Place::midpoint(other), aim: None }];
        let (mut reached, mut queue) =
            ([SearchCell::NEVER; TinyMap::CELLS], [Cell::new(0, 0); TinyMap::CELLS]);
        let (mut rounds, mut pairs) = (0, [None; 4]);
        let mut scratch = Scratch {
            search: Search { reached: &mut reached, queue: &mut queue, rounds: &mut rounds },
            pairs: &mut pairs,
        };
        let view = View { others: &others, slot: Slot::Own };
        match robot.next(&rule, view, &mut scratch, &mut Nth(0)) {
            Next::Tries { aim, .. } => aim,
            next @ (Next::Waits | Next::Stops | Next::Done) => panic!("{next:?}"),
        }
    };
    let without = Rule::REPAIRED.without(Condition::Keep);
    assert_eq!([goes(Rule::REPAIRED, None), goes(without, None)], [far, far]);
    for sight in [Sight::Small, Sight::Robot] {
        assert_eq!([goes(Rule::REPAIRED, Some(sight)), goes(without, Some(sight))], [near, far], "{sight:?}");
    }
}

#[test]
fn a_robot_goes_round_a_small_obstacle_with_its_claim_and_stores_it_only_without_detour() {
    let (here, east) = (Cell::new(3, 3), Cell::new(4, 3));
    let met = |rule: Rule| {
        let mut robot = Robot::new(blank(), here, &[]);
        for sight in [Sight::Robot, Sight::Small] {
            robot.tries(Side::East, east);
            robot.looked(&rule, sight);
        }
        (robot.stance(), robot.aim(), robot.waits(), robot.map.status(east))
    };
    assert_eq!(met(Rule::REPAIRED), (Stance::Stands, Some(east), false, Status::Unexplored));
    let without = Rule::REPAIRED.without(Condition::Detour);
    assert_eq!(met(without), (Stance::Stands, None, false, Status::Obstacle));
}

#[test]
fn a_robot_that_answers_nothing_closes_its_cell_for_good_and_without_bypass_is_waited_for() {
    let (here, east) = (Cell::new(3, 3), Cell::new(4, 3));
    let met = |rule: Rule, sight: Sight| {
        let mut robot = Robot::new(blank(), here, &[here, east]);
        robot.tries(Side::East, Cell::new(5, 3));
        robot.looked(&rule, sight);
        // Nobody opens it again.
        robot.hears(east, Status::Explored);
        (robot.stance(), robot.aim(), robot.waits(), robot.is_bound(&rule), robot.map.status(east))
    };
    assert_eq!(met(Rule::REPAIRED, Sight::Silent), (Stance::Stands, None, false, false, Status::Body));
    let waits = (Stance::Stands, None, true, true, Status::Explored);
    assert_eq!(met(Rule::REPAIRED, Sight::Robot), waits);
    assert_eq!(met(Rule::REPAIRED.without(Condition::Bypass), Sight::Silent), waits);
    let literal = Rule::REPAIRED.without(Condition::Record);
    assert_eq!(met(literal, Sight::Silent), (Stance::Stands, None, false, true, Status::Explored));
    let sees = Rule::REPAIRED.without(Condition::Bypass).without(Condition::Tell);
    let mut robot = Robot::new(blank(), here, &[]);
    robot.tries(Side::East, east);
    robot.looked(&sees, Sight::Silent);
    assert_eq!(robot.map.status(east), Status::Obstacle, "for whoever sees robots as obstacles it is one");
}

#[test]
fn a_robot_turns_back_from_a_cell_that_it_took_for_unexplored_and_only_from_that() {
    let (here, east, north) = (Cell::new(3, 3), Cell::new(4, 3), Cell::new(3, 2));
    let looked = |rule: Rule, aim: Cell, sight: Sight| {
        let mut robot = Robot::new(blank(), here, &[]);
        robot.tries(Side::East, aim);
        robot.hears(east, Status::Explored);
        robot.looked(&rule, sight);
        (robot.stance(), robot.aim(), robot.waits(), robot.is_bound(&rule))
    };
    let enters = (Stance::Enters(Side::East), Some(east), false, true);
    assert_eq!(looked(Rule::REPAIRED, east, Sight::Open), (Stance::Stands, None, false, false));
    assert_eq!(looked(Rule::REPAIRED.without(Condition::Return), east, Sight::Open), enters);
    // The cell is on the way to another one, or has a robot in it.
    let passes = (Stance::Enters(Side::East), Some(north), false, true);
    assert_eq!(looked(Rule::REPAIRED, north, Sight::Open), passes);
    assert_eq!(looked(Rule::REPAIRED, east, Sight::Robot), (Stance::Stands, None, true, true));
}

#[test]
fn with_less_memory_fewer_cells_are_compared_and_still_all_robots() {
    // The second robot goes to the eastern cell and the third one to the northern, so that the southern one is left.
    let map = explored_but(&[(3, 1), (3, 5), (6, 5)]);
    let three = team(map, [(3, 3), (5, 5), (3, 0)]);
    for pairs in [9, 6] {
        assert_eq!(aim_of_first(&three, pairs), Some((3, 5)), "memory for {pairs} pairs");
    }
    assert_eq!(aim_of_first(&three, 3), Some((3, 1)), "it knows but the cell that comes first");
    assert_eq!(aim_of_first(&three, 2), None, "there is no room for a pair of each");
}

#[test]
fn a_robot_between_obstacles_has_nothing_to_pick_from() {
    let mut map = blank();
    for side in Side::ALL {
        map.learn(Cell::new(3, 3).beyond(side), Status::Obstacle);
    }
    for rule in [Rule::PUBLISHED, Rule::WANDERS] {
        assert_eq!(next(&team(map, [(3, 3)]), 0, &rule, 0), Next::Stops);
    }
}

/// How far the unexplored cells are that are reached through explored ones.
fn ways(map: &TinyMap, from: Cell) -> BTreeMap<Cell, u32> {
    let (mut ways, mut queue) = (BTreeMap::from([(from, 0)]), VecDeque::from([from]));
    while let Some(cell) = queue.pop_front() {
        if map.status(cell) == Status::Unexplored {
            continue;
        }
        for beside in Side::ALL.map(|side| cell.beyond(side)) {
            let is_barred = matches!(map.status(beside), Status::Obstacle | Status::Body);
            if !is_barred && !ways.contains_key(&beside) {
                ways.insert(beside, ways[&cell] + 1);
                queue.push_back(beside);
            }
        }
    }
    ways.retain(|&cell, _| map.status(cell) == Status::Unexplored);
    ways
}

/// The aims of all robots, those with a claim without news, if they keep to it: all pairs of all robots are compared.
fn aims(team: &Team, keep: bool) -> Vec<Option<Cell>> {
    let mut pairs = Vec::new();
    for (robot, &(at, aim)) in team.robots.iter().enumerate() {
        for (cell, distance) in ways(&team.map, at) {
            let beside = Side::ALL.map(|side| team.map.status(cell.beyond(side)));
            let unexplored = beside.into_iter().filter(|&status| status == Status::Unexplored).count();
            let rim = cell.x.min(cell.y).min(SIDE - 1 - cell.x).min(SIDE - 1 - cell.y);
            pairs.push((
                (distance, aim != Some(cell), unexplored, rim, (at.y, at.x), (cell.y, cell.x)),
                robot,
                cell,
            ));
        }
    }
    pairs.sort_unstable();
    let mut aims: Vec<Option<Cell>> = vec![None; team.robots.len()];
    for &(_, robot, cell) in &pairs {
        if aims[robot].is_none() && !aims.contains(&Some(cell)) {
            aims[robot] = Some(cell);
        }
    }
    let nearest = |robot: usize| pairs.iter().find(|pair| pair.1 == robot).map(|&(_, _, cell)| cell);
    let is_kept = |robot: usize, aim: &Cell| {
        let (at, claimed) = team.robots[robot];
        let ways = ways(&team.map, at);
        !keep || claimed.and_then(|claimed| ways.get(&claimed)).is_none_or(|way| ways[aim] <= *way)
    };
    let aims = aims.into_iter().enumerate();
    aims.map(|(robot, aim)| aim.filter(|aim| is_kept(robot, aim)).or_else(|| nearest(robot))).collect()
}

/// The sides through which a robot may go.
fn sides(team: &Team, robot: usize, rule: &Rule) -> BTreeSet<Cell> {
    let told = (0..4).filter_map(|pick| match next(team, robot, rule, pick) {
        Next::Tries { side, .. } => Some(team.robots[robot].0.beyond(side)),
        Next::Waits | Next::Stops | Next::Done => None,
    });
    told.collect()
}

/// The team in the area turned by a quarter, or mirrored.
fn moved(team: &Team, turn: fn(Cell) -> Cell) -> Team {
    let mut map = blank();
    for cell in area().cells() {
        map.learn(turn(cell), team.map.status(cell));
    }
    let robots = team.robots.iter().map(|&(at, aim)| (turn(at), aim.map(turn)));
    Team { map, robots: robots.collect() }
}

const TURNS: [fn(Cell) -> Cell; 3] = [
    |cell| Cell::new(SIDE - 1 - cell.y, cell.x),
    |cell| Cell::new(SIDE - 1 - cell.x, cell.y),
    |cell| Cell::new(cell.y, cell.x),
];

proptest! {
    #[test]
    fn a_robot_finds_the_pair_that_comparing_all_pairs_finds(team in teams()) {
        for (rule, keep) in [(Rule::REPAIRED, true), (Rule::REPAIRED.without(Condition::Keep), false)] {
            for (robot, aim) in aims(&team, keep).into_iter().enumerate() {
                let told = match next(&team, robot, &rule, 0) {
                    Next::Tries { aim, .. } => Some(aim),
                    Next::Waits | Next::Stops | Next::Done => None,
                };
                prop_assert_eq!(told, aim, "robot {} of {:?}", robot, team);
            }
        }
    }

    #[test]
    fn robots_that_decide_alone_go_to_different_cells_while_there_are_enough(team in teams()) {
        let aims = aims(&team, false);
        let cells: BTreeSet<Cell> = team.robots.iter().flat_map(|&(at, _)| ways(&team.map, at).into_keys()).collect();
        let is_apart = aims.iter().flatten().collect::<BTreeSet<_>>().len() == aims.iter().flatten().count();
        let reach_all = team.robots.iter().all(|&(at, _)| ways(&team.map, at).len() == cells.len());
        prop_assert!(is_apart || cells.len() < team.robots.len() || !reach_all, "{:?}", team);
    }

    #[test]
    fn a_plain_robot_may_begin_with_any_shortest_way_to_a_nearest_cell(team in teams()) {
        let at = team.robots[0].0;
        let distance = |cell: Cell| match team.map.status(cell) {
            Status::Obstacle | Status::Body => None,
            Status::Unexplored | Status::Explored => ways(&team.map, cell).into_values().min(),
        };
        let beside = Side::ALL.map(|side| at.beyond(side));
        let least = beside.into_iter().filter_map(distance).min();
        let nearest = beside.into_iter().filter(|&cell| least.is_some() && distance(cell) == least);
        prop_assert_eq!(sides(&team, 0, &Rule::PLAIN), nearest.collect::<BTreeSet<_>>(), "{:?}", team);
    }

    #[test]
    fn plain_and_published_decisions_turn_with_the_area(team in teams()) {
        let any = Rule { ties: Ties::Any, ..Rule::PUBLISHED };
        for rule in [Rule::PLAIN, any] {
            for turn in TURNS {
                let there = moved(&team, turn);
                for robot in 0..team.robots.len() {
                    let turned: BTreeSet<Cell> = sides(&team, robot, &rule).into_iter().map(turn).collect();
                    prop_assert_eq!(&turned, &sides(&there, robot, &rule), "{:?}", team);
                }
            }
        }
    }

    #[test]
    fn a_repaired_robot_that_is_alone_moves_as_a_plain_one_may(team in teams()) {
        let alone = Team { robots: team.robots[..1].to_vec(), ..team };
        let (repaired, plain) = (sides(&alone, 0, &Rule::REPAIRED), sides(&alone, 0, &Rule::PLAIN));
        prop_assert!(repaired.is_subset(&plain) && repaired.is_empty() == plain.is_empty(), "{:?}", alone);
        let bare = Rule::REPAIRED.without(Condition::Corner);
        prop_assert!(sides(&alone, 0, &bare).is_subset(&plain), "{:?}", alone);
    }

    #[test]
    fn a_threshold_by_all_cells_decides_as_a_half_and_one_by_neighbours_admits_a_cell_only_beside_another_robot(
        team in teams()
    ) {
        let any = Rule { ties: Ties::Any, ..Rule::PUBLISHED };
        let due = sides(&team, 0, &any);
        prop_assert_eq!(&sides(&team, 0, &Rule { basis: Basis::Cells, ..any }), &due, "{:?}", team);
        let at = team.robots[0].0;
        let is_beside = |&(cell, _): &(Cell, Option<Cell>)| at.apart(cell) == (0, 1) || at.apart(cell) == (1, 0);
        let has_neighbour = team.robots.iter().any(is_beside);
        let by_neighbours = sides(&team, 0, &Rule { basis: Basis::Neighbours, ..any });
        prop_assert_eq!(by_neighbours, if has_neighbour { due } else { BTreeSet::new() }, "{:?}", team);
    }
}

#[test]
fn a_small_map_counts_the_cells_that_a_search_may_still_find() {
    let mut map = explored_but(&[(0, 0), (3, 3), (6, 6)]);
    assert_eq!(map.frontier(), 3);
    map.learn(Cell::new(3, 3), Status::Obstacle);
    map.learn(Cell::new(1, 1), Status::Obstacle);
    assert_eq!(map.frontier(), 2);
    assert_eq!(blank().frontier(), 49);
}

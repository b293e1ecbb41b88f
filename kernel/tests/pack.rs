//! Which frontier cell a robot of a pack goes to, its way there, and what a team move is, each compared with a second,
//! slower way to say it.

use std::collections::{BTreeMap, BTreeSet, VecDeque};

use tautline_kernel::choice::Oracle;
use tautline_kernel::ground::{Area, Cell, Side, Step};
use tautline_kernel::pack::{
    Condition, MAX_ROBOTS, MoveKind, Past, RangeError, Rule, Scratch, SetupError, Status, Team, is_connected,
};

use crate::floors::{Map, area, free_cell, gain, is_within, obstacles, unknown};
use crate::numbers::Congruence;

/// A pack on a floor, with all that its caller keeps.
struct World {
    obstacles: BTreeSet<Cell>,
    map: Map,
    team: Team,
    past: Moves,
    reached: Vec<u32>,
    queue: Vec<Cell>,
    gains: Vec<u16>,
    rounds: u32,
}

#[derive(Default)]
struct Moves(Vec<Vec<Step>>);

impl Past for Moves {
    fn push(&mut self, steps: &[Step]) {
        self.0.push(steps.to_vec());
    }

    fn pop(&mut self, steps: &mut [Step]) -> bool {
        let last = self.0.pop();
        last.map(|last| steps.copy_from_slice(&last)).is_some()
    }

    fn clear(&mut self) {
        self.0.clear();
    }
}

impl World {
    fn new(rule: Rule, floor: Area, obstacles: BTreeSet<Cell>, starts: &[Cell]) -> Self {
        let cells = floor.width() * floor.height();
        let mut world = Self {
            obstacles,
            map: unknown(floor),
            team: Team::new(rule, starts).expect("a pack"),
            past: Moves::default(),
            reached: vec![0; cells],
            queue: vec![Cell::default(); cells],
            gains: vec![0; cells],
            rounds: 0,
        };
        world.look();
        world
    }

    fn look(&mut self) {
        for &cell in self.team.cells() {
            let is_obstacle = |cell| self.obstacles.contains(&cell);
            self.map.look(self.team.rule().sight(), cell, is_obstacle, |_, _| ());
        }
    }

    /// A team move with its steps, and a look round; `None` at the end.
    fn go(&mut self) -> Option<(MoveKind, Vec<Step>)> {
        let mut steps = [Step::Stay; MAX_ROBOTS];
        let mut memory = Scratch {
            reached: &mut self.reached,
            queue: &mut self.queue,
            gains: &mut self.gains,
            rounds: &mut self.rounds,
        };
        let before = self.team.cells().to_vec();
        let made = self.team.advance(&self.map, &mut self.past, &mut memory, &mut steps).ok()?;
        let (own, others) = steps.split_at(before.len());
        let after: Vec<Cell> = before.iter().zip(own).map(|(cell, &step)| cell.after(step)).collect();
        assert_eq!(self.team.cells(), after, "the steps lead to the cells");
        assert!(others.iter().all(|&step| step == Step::Stay));
        self.look();
        Some((made, own.to_vec()))
    }
}

/// The steps to each cell that can be reached over cells known to be free.
fn distances(map: &Map, from: Cell) -> BTreeMap<Cell, u32> {
    let mut reached = BTreeMap::from([(from, 0)]);
    let mut left = VecDeque::from([from]);
    while let Some(cell) = left.pop_front() {
        let next = reached[&cell] + 1;
        for beyond in Side::ALL.map(|side| cell.beyond(side)) {
            if map.status(beyond) == Status::Free && !reached.contains_key(&beyond) {
                reached.insert(beyond, next);
                left.push_back(beyond);
            }
        }
    }
    reached
}

/// Whether `aim` is what a robot in `from` goes to: of the frontier cells that have a link to a cell in `others`, if
/// there is one, and are at most 2 R_c farther than the nearest of them, none has a greater gain over its distance; and
/// if all gains are 0, none is nearer.
fn is_choice(world: &World, map: &Map, from: Cell, others: &[Cell], aim: Option<Cell>) -> bool {
    let (rule, far) = (world.team.rule(), distances(map, from));
    let may = |&cell: &Cell| {
        map.is_frontier(cell) && (others.is_empty() || others.iter().any(|&other| rule.links(other, cell)))
    };
    let Some(nearest) = far.iter().filter(|(cell, _)| may(cell)).map(|(_, &far)| far).min() else {
        return aim.is_none();
    };
    let Some(aim) = aim.filter(may).filter(|aim| far.contains_key(aim)) else { return false };
    let most = nearest + 2 * u32::from(rule.range_cells());
    let sight_cells = u16::from(rule.sight().radius_cells());
    let gain_of = |cell| gain(map, sight_cells, cell, others).1;
    let (own, own_far) = (gain_of(aim), far[&aim]);
    if own == 0 && own_far > nearest {
        return false;
    }
    far.iter()
        .filter(|&(cell, &far)| far <= most && may(cell))
        .all(|(&cell, &far)| gain_of(cell) * own_far <= own * far)
}

/// How many gains are noted of cells: each is one more than a bound of what the gain is now.
fn bounds(world: &World, map: &Map) -> usize {
    let noted = map.area().cells().zip(&world.gains).filter(|&(_, &noted)| noted > 0);
    noted
        .map(|(cell, &noted)| {
            let (now, _) = gain(map, u16::from(world.team.rule().sight().radius_cells()), cell, &[]);
            assert!(now < u32::from(noted), "{cell}: the gain {now} is noted as {noted}");
        })
        .count()
}

#[test]
fn a_robot_goes_where_the_gain_is_greatest_for_the_way_and_each_step_brings_it_nearer() {
    let (mut drawn, mut noted) = (Congruence(4), 0);
    for (sight_cells, range_cells, density) in
        [(1, 3, 20), (2, 3, 10), (3, 8, 30), (6, 4, 15), (20, 60, 25), (4, 30, 35)]
    {
        let rule = Rule::REPAIRED.within(sight_cells, range_cells).expect("a rule");
        for _ in 0..2 {
            let floor = area((-3, 2), 24, 17);
            let obstacles = obstacles(&mut drawn, floor, density);
            let start = free_cell(&mut drawn, floor, &obstacles);
            let mut world = World::new(rule, floor, obstacles, &[start]);
            let mut aim: Option<Cell> = None;
            loop {
                let (map, from) = (world.map.clone(), world.team.cells()[0]);
                aim = aim.filter(|&aim| map.is_frontier(aim));
                let Some((made, _)) = world.go() else { break };
                assert_eq!(made, MoveKind::Spread, "nobody is in its way");
                let next = world.team.aims().next().flatten();
                if aim.is_some() {
                    assert_eq!(next, aim, "a robot keeps its aim");
                } else {
                    assert!(is_choice(&world, &map, from, &[], next), "from {from} to {next:?}");
                    noted += bounds(&world, &map);
                }
                aim = next;
                let to_aim = distances(&map, aim.expect("it goes somewhere"));
                assert_eq!(to_aim[&world.team.cells()[0]] + 1, to_aim[&from], "it comes nearer");
            }
            let left = distances(&world.map, world.team.cells()[0]);
            assert!(left.keys().all(|&cell| !world.map.is_frontier(cell)), "all is explored");
        }
    }
    assert!(noted > 1000, "{noted} gains were noted");
}

#[test]
fn robots_choose_one_after_the_other_cells_that_have_a_link_and_share_what_is_to_be_seen() {
    let mut drawn = Congruence(5);
    let (mut choices, mut swapped) = (0, 0);
    for (sight_cells, range_cells, density) in
        [(1, 3, 10), (2, 4, 10), (3, 5, 15), (6, 4, 15), (20, 60, 25), (4, 30, 30)]
    {
        let rule = Rule::REPAIRED.within(sight_cells, range_cells).expect("a rule");
        for _ in 0..4 {
            let floor = area((-3, 2), 22, 15);
            let mut obstacles = obstacles(&mut drawn, floor, density);
            let start = Cell::new(5, 7);
            let starts = [start, start.beyond(Side::East)];
            obstacles.retain(|cell| !starts.contains(cell));
            let mut world = World::new(rule, floor, obstacles, &starts);
            let mut has_spread = true;
            loop {
                let (map, from) = (world.map.clone(), world.team.cells().to_vec());
                let kept: Vec<Option<Cell>> = world
                    .team
                    .aims()
                    .map(|aim| aim.filter(|&aim| has_spread && map.is_frontier(aim)))
                    .collect();
                let Some((made, _)) = world.go() else { break };
                has_spread = made == MoveKind::Spread;
                if !has_spread {
                    continue;
                }
                let aims: Vec<Option<Cell>> = world.team.aims().collect();
                // Each knows the aims of those before it, and those that others keep.
                let are_choices = |aims: [Option<Cell>; 2]| {
                    [0, 1].into_iter().all(|robot| {
                        let others = if robot == 0 { kept[1] } else { aims[0] };
                        match kept[robot] {
                            Some(_) => kept[robot] == aims[robot],
                            None => is_choice(&world, &map, from[robot], others.as_slice(), aims[robot]),
                        }
                    })
                };
                let is_straight = are_choices([aims[0], aims[1]]);
                assert!(is_straight || are_choices([aims[1], aims[0]]), "from {from:?} to {aims:?}");
                choices += kept.iter().filter(|aim| aim.is_none()).count();
                swapped += u32::from(!is_straight);
            }
            assert!(is_connected(&rule, world.team.cells()));
        }
    }
    assert!(choices > 300 && swapped > 3, "{choices} choices, {swapped} times aims are changed");
}

#[test]
fn a_way_of_any_length_is_the_shortest_one() {
    // A corridor with a robot in the middle: it goes to one end, and then all the way to the other.
    let (floor, start) = (area((0, 0), 301, 1), Cell::new(150, 0));
    let mut world =
        World::new(Rule::REPAIRED.within(1, 200).expect("a rule"), floor, BTreeSet::new(), &[start]);
    let mut moves = 0;
    while let Some((made, _)) = world.go() {
        assert_eq!(made, MoveKind::Spread, "it goes its own way");
        moves += 1;
    }
    assert_eq!(moves, 149 + 298, "the last cell at each end is seen from the one before it");
}

#[test]
fn memory_that_has_served_a_billion_floods_serves_on() {
    let mut drawn = Congruence(6);
    let floor = area((0, 0), 15, 12);
    let obstacles = obstacles(&mut drawn, floor, 20);
    let start = free_cell(&mut drawn, floor, &obstacles);
    let moves = |rounds: u32| {
        let rule = Rule::REPAIRED.within(2, 5).expect("a rule");
        let mut world = World::new(rule, floor, obstacles.clone(), &[start]);
        world.rounds = rounds;
        let moves: Vec<(MoveKind, Vec<Step>)> = std::iter::from_fn(|| world.go()).collect();
        (moves, world.rounds)
    };
    let (first, floods) = moves(0);
    assert!(first.len() > 20 && (6..first.len() as u32).contains(&floods), "{floods} floods");
    // The number of floods takes 30 bits; then what was noted of cells is forgotten, and the count begins anew.
    let most = u32::MAX >> 2;
    for left in 0..5 {
        let (again, counted) = moves(most - left);
        assert_eq!((again, counted), (first.clone(), floods - left));
    }
}

#[test]
fn a_rule_has_a_sight_of_1_to_31_cells_and_a_range_of_3_or_more() {
    for sight_cells in 0..40 {
        let within = Rule::REPAIRED.within(sight_cells, 3);
        let sight = within.map(|rule| u16::from(rule.sight().radius_cells()));
        assert_eq!(
            sight,
            if (1..=31).contains(&sight_cells) { Ok(sight_cells) } else { Err(RangeError::Sight) }
        );
        let Ok(rule) = within else { continue };
        let far = sight_cells as i16;
        let disc = area((-far, -far), 2 * far + 1, 2 * far + 1);
        let cells = disc.cells().filter(|&cell| is_within(cell, Cell::default(), sight_cells));
        assert_eq!(rule.sight().cells() as usize, cells.count());
    }
    for range_cells in [0, 1, 2, 3, 4, u16::MAX] {
        let range = Rule::REPAIRED.within(1, range_cells).map(|rule| rule.range_cells());
        assert_eq!(range, if range_cells < 3 { Err(RangeError::Range) } else { Ok(range_cells) });
    }
}

#[test]
fn links_join_robots_by_all_four_corners_or_by_midpoints() {
    for range_cells in [3, 4, 7] {
        let repaired = Rule::REPAIRED.within(1, range_cells).expect("a rule");
        let by_midpoints = repaired.without(Condition::Corners);
        let one = Cell::new(2, -3);
        for other in area((-10, -15), 25, 25).cells() {
            let (columns, rows) = one.apart(other);
            let is_near = |columns: f64, rows: f64| columns.hypot(rows) <= f64::from(range_cells);
            let corner = is_near(f64::from(columns) + 0.5, f64::from(rows) + 0.5);
            assert_eq!(repaired.links(one, other), corner, "{one} {other}");
            assert_eq!(by_midpoints.links(one, other), is_near(f64::from(columns), f64::from(rows)));
        }
    }
}

#[test]
fn robots_are_connected_if_links_lead_from_one_to_all() {
    let (mut drawn, mut connected) = (Congruence(7), 0);
    for round in 0..600 {
        let rule = Rule::REPAIRED.within(1, 3 + round % 6).expect("a rule");
        let robots = 1 + drawn.pick(MAX_ROBOTS as u32);
        let side = 1 + drawn.pick(20);
        let cells: BTreeSet<Cell> =
            (0..robots).map(|_| Cell::new(drawn.pick(side) as i16, drawn.pick(side) as i16)).collect();
        let cells: Vec<Cell> = cells.into_iter().collect();
        let mut joined = vec![cells[0]];
        for _ in &cells {
            let more = cells.iter().filter(|cell| !joined.contains(cell));
            let more: Vec<Cell> =
                more.copied().filter(|&cell| joined.iter().any(|&other| rule.links(other, cell))).collect();
            joined.extend(more);
        }
        let is_one = joined.len() == cells.len();
        connected += u32::from(is_one);
        assert_eq!(is_connected(&rule, &cells), is_one, "{cells:?}");
        let refused = Team::new(rule, &cells).err();
        assert_eq!(refused, (!is_one).then_some(SetupError::Apart(joined.len(), cells.len())), "{cells:?}");
        assert!(Team::new(rule.without(Condition::Connect), &cells).is_ok());
    }
    assert!((150..450).contains(&connected), "{connected}");
}

#[test]
fn a_pack_has_1_to_32_robots_each_in_a_cell_of_its_own() {
    let row = |robots: i16| (0..robots).map(|x| Cell::new(x, 0)).collect::<Vec<_>>();
    for robots in [0, 1, 2, 31, 32, 33] {
        let refused = Team::new(Rule::REPAIRED, &row(robots)).err();
        let count = robots as usize;
        assert_eq!(refused, (!(1..=32).contains(&count)).then_some(SetupError::Robots(count)));
    }
    let mut cells = row(5);
    cells[4] = cells[2];
    assert_eq!(Team::new(Rule::REPAIRED, &cells).err(), Some(SetupError::Together(Cell::new(2, 0))));
}

/// Whether cells that share sides lead from one to all.
fn is_one_piece(cells: &[Cell]) -> bool {
    let mut left: BTreeSet<Cell> = cells.iter().copied().collect();
    let mut next: Vec<Cell> = left.pop_first().into_iter().collect();
    while let Some(cell) = next.pop() {
        next.extend(Side::ALL.map(|side| cell.beyond(side)).into_iter().filter(|beyond| left.remove(beyond)));
    }
    left.is_empty()
}

/// Free cells side by side, as many as there are robots.
fn starts(
    drawn: &mut Congruence,
    floor: Area,
    obstacles: &BTreeSet<Cell>,
    robots: usize,
) -> Option<Vec<Cell>> {
    let mut starts = vec![free_cell(drawn, floor, obstacles)];
    while starts.len() < robots {
        let beside = starts.iter().flat_map(|cell| Side::ALL.map(|side| cell.beyond(side)));
        let free: Vec<Cell> = beside
            .filter(|cell| floor.contains(*cell) && !obstacles.contains(cell) && !starts.contains(cell))
            .collect();
        starts.push(*free.get(drawn.pick(free.len().max(1) as u32) as usize)?);
    }
    Some(starts)
}

#[test]
fn each_kind_of_team_move_does_what_its_name_says_and_all_is_explored() {
    let mut drawn = Congruence(8);
    let mut made = BTreeMap::<&str, u32>::new();
    let (mut followed, mut led_again) = (0, 0);
    for round in 0..400 {
        let rule = Rule::REPAIRED.within(1 + round % 3, 3 + round / 3 % 2).expect("a rule");
        let floor = area((-2, 4), 5 + drawn.pick(9) as i16, 3 + drawn.pick(9) as i16);
        let density = 15 + drawn.pick(35);
        let obstacles = obstacles(&mut drawn, floor, density);
        let robots = 2 + drawn.pick(6) as usize;
        // Side by side, or anywhere as long as links join them.
        let starts = if round % 4 == 0 {
            let cells: BTreeSet<Cell> =
                (0..robots).map(|_| free_cell(&mut drawn, floor, &obstacles)).collect();
            Some(cells.into_iter().collect()).filter(|cells: &Vec<Cell>| is_connected(&rule, cells))
        } else {
            starts(&mut drawn, floor, &obstacles, robots)
        };
        let Some(starts) = starts else { continue };
        let robots = starts.len();
        let mut world = World::new(rule, floor, obstacles, &starts);
        // Where the robots were before each team move that could be taken back.
        let mut before: Vec<Vec<Cell>> = Vec::new();
        let (mut has_spread, mut was_back, mut moves) = (true, false, 0);
        loop {
            moves += 1;
            assert!(moves < 1000, "it goes on for ever");
            let (from, map) = (world.team.cells().to_vec(), world.map.clone());
            if is_one_piece(&from) {
                before.clear();
            }
            let aims: Vec<Option<Cell>> =
                world.team.aims().map(|aim| aim.filter(|&aim| map.is_frontier(aim))).collect();
            let Some((kind, steps)) = world.go() else { break };
            let to = world.team.cells();
            assert!(is_connected(&rule, to), "{kind:?} from {from:?} to {to:?}");
            assert_eq!(to.iter().collect::<BTreeSet<_>>().len(), robots, "two robots in one cell: {to:?}");
            assert!(to.iter().all(|&cell| map.status(cell) == Status::Free));
            let moved: Vec<usize> = (0..robots).filter(|&robot| steps[robot] != Step::Stay).collect();
            assert!(!moved.is_empty(), "somebody goes");
            let name = match kind {
                MoveKind::Spread => "spread",
                MoveKind::Led(leader) => {
                    followed += moved.iter().filter(|&&robot| robot != leader).count();
                    led_again += u32::from(was_back && !before.is_empty());
                    // If the robots went their own ways before, that of the leader was the shortest.
                    let goal = world.team.aims().nth(leader).flatten().expect("it leads somewhere");
                    let way = |robot: usize, to: Cell| distances(&map, from[robot]).get(&to).copied();
                    let shortest = (0..robots).filter_map(|robot| way(robot, goal)).min();
                    let own = (0..robots).filter_map(|robot| way(robot, aims[robot]?)).min();
                    assert!(!has_spread || own.is_none() || shortest <= own, "{shortest:?} {own:?}");
                    // The others come nearer to where the leader is now.
                    let far = distances(&map, to[leader]);
                    for &robot in moved.iter().filter(|&&robot| robot != leader) {
                        assert_eq!(far[&to[robot]] + 1, far[&from[robot]], "{robot} follows {leader}");
                    }
                    "led"
                }
                MoveKind::TakenBack => {
                    assert_eq!(before.pop().as_deref(), Some(to), "the last team move is taken back");
                    "taken back"
                }
                MoveKind::Marched => {
                    assert!(is_one_piece(&from) && is_one_piece(to), "{from:?} to {to:?}");
                    // One robot goes ahead, and the others each into a cell that was left.
                    let new: Vec<&Cell> = to.iter().filter(|cell| !from.contains(cell)).collect();
                    let left: Vec<&Cell> = from.iter().filter(|cell| !to.contains(cell)).collect();
                    assert_eq!((new.len(), left.len()), (1, 1), "{from:?} to {to:?}");
                    "marched"
                }
            };
            if kind != MoveKind::TakenBack {
                before.push(from);
            }
            (has_spread, was_back) = (kind == MoveKind::Spread, kind == MoveKind::TakenBack);
            *made.entry(name).or_default() += 1;
        }
        let left = distances(&world.map, world.team.cells()[0]);
        let is_explored = left.keys().all(|&cell| !world.map.is_frontier(cell));
        assert!(is_explored || !is_one_piece(&starts), "all is explored from {starts:?}");
    }
    // Followers come along, and the team leads again before all is taken back.
    assert!(followed > 50 && led_again > 5, "{followed} {led_again}");
    assert!(made.len() == 4 && made.values().all(|&times| times > 5), "{made:?}");
}

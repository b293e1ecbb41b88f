//! The least number of team moves in which a team that knows the layout explores what it is to explore: A* (Hart,
//! Nilsson and Raphael, 1968) over configurations and cells left. It knows nothing of rings: what guides it is computed
//! from the graph of configurations, ground by ground, and [`Guide::Blind`] does without, as a check. In the open it
//! decides CHAIN-10 anew.

use std::cmp::Reverse;
use std::fmt;
use std::ops::RangeInclusive;

use rustc_hash::FxHashMap;
use tautline_kernel::chain::Rule;
use tautline_kernel::choice::Oracle;
use tautline_kernel::ground::Cell;

use super::reach::{CellSet, Followers, Ground, Relation, TooLarge};
use super::subject::Subject;
use super::whole_runs;
use crate::engine::{Outcome, Stop, require};

/// Most configurations of a team that is solved for.
pub const MAX_CONFIGURATIONS: usize = 50_000;

/// A guide tells the search how many team moves are at least left.
///
/// [`Guide::Distances`] takes the largest of three numbers, none of which is ever too large:
///
/// - for every cell left, the team moves from this configuration to the nearest one that has a robot in that cell;
/// - for the cells that the last m robots alone can ever be in, of which k are left: the least such number for any of
///   them, and ⌈(k−m)/m⌉ more, since a team move explores at most m of them;
/// - for the cells that the leader alone can ever be in: the least such number for any of them that is left, and the
///   weight of a smallest spanning tree of those left. The leader has to come to all of them, one after the other;
///   from one to the next it needs at least as many team moves as there are in the graph between any configuration
///   with the leader in the one and any with the leader in the other; and of the ways to come to all, none is shorter
///   than the tree. The tree takes the smaller weight of both directions.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Guide {
    /// Distances in the graph of configurations.
    Distances,
    /// Nothing: plain search by number of team moves.
    Blind,
}

/// A shortest exploration.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Optimum {
    /// Where the robots are, the base first: at the start, and after each team move.
    pub configurations: Vec<Vec<Cell>>,
    /// States that the search went on from.
    pub states: u64,
}

impl Optimum {
    /// Team moves.
    pub const fn moves(&self) -> u32 {
        self.configurations.len() as u32 - 1
    }
}

/// Why there is no answer.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum OptimumError {
    /// The ground is too large.
    TooLarge(TooLarge),
    /// The team has more than [`MAX_CONFIGURATIONS`].
    Configurations,
    /// No robot of the team can reach this cell.
    OutOfReach {
        /// The cell.
        cell: Cell,
    },
    /// Each cell can be reached, but not all of them in one exploration.
    Apart,
    /// The search met more states than it may.
    States {
        /// States that it may meet.
        most: usize,
    },
}

impl fmt::Display for OptimumError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::TooLarge(too_large) => too_large.fmt(f),
            Self::Configurations => {
                write!(
                    f,
                    "the team has too many configurations for the optimum: at most {MAX_CONFIGURATIONS}"
                )
            }
            Self::OutOfReach { cell } => write!(f, "no robot of the team can reach the cell {cell}"),
            Self::Apart => f.write_str("no exploration reaches all the cells, one after the other"),
            Self::States { most } => write!(f, "the optimum takes more than {most} states"),
        }
    }
}

impl std::error::Error for OptimumError {}

/// The fewest team moves in which a team on `ground` explores all `goals` under `rule`, with at most `most_states`.
///
/// # Errors
/// [`OptimumError`].
pub fn explore_all(
    ground: &Ground,
    rule: &Rule,
    goals: &CellSet,
    guide: Guide,
    most_states: usize,
) -> Result<Optimum, OptimumError> {
    let graph = Graph::new(ground, rule)?;
    let cells: Vec<Cell> = ground.area().cells().collect();
    let reached = graph.occupied.iter().fold(0, |reached, &occupied| reached | occupied);
    let reached = CellSet::of_bits(ground.area(), reached);
    if let Some(cell) = goals.iter().find(|&goal| !reached.contains(goal)) {
        return Err(OptimumError::OutOfReach { cell });
    }
    let goals = ground.bits(goals).map_err(OptimumError::TooLarge)?;
    let bound = Bound::new(&graph, cells.len(), guide);
    let search =
        Search { graph: &graph, bound, nodes: Vec::new(), known: FxHashMap::default(), open: Vec::new() };
    let (path, states) = search.run(goals, most_states)?;
    let configurations = path.into_iter().map(|place| graph.team(place, ground.base(), &cells)).collect();
    Ok(Optimum { configurations, states })
}

/// The configurations that can be reached from the start, which is the first, and the team moves between them.
pub(super) struct Graph {
    pub(super) robots: usize,
    places: Vec<(Followers, u8)>,
    /// By configuration: the cells that robots are in.
    pub(super) occupied: Vec<u128>,
    pub(super) next: Vec<Vec<u32>>,
}

impl Graph {
    pub(super) fn new(ground: &Ground, rule: &Rule) -> Result<Self, OptimumError> {
        let relation = Relation::new(ground, rule).map_err(OptimumError::TooLarge)?;
        let mut places = vec![relation.start()];
        let mut known = FxHashMap::from_iter([(places[0], 0)]);
        let (mut occupied, mut next) = (Vec::new(), Vec::new());
        while let Some(&(followers, leader)) = places.get(next.len()) {
            occupied.push(relation.cells(&followers) | 1 << leader);
            let mut after = Vec::new();
            relation.moves(&followers, 1 << leader, &mut |to, leaders| {
                for leader in ones(leaders) {
                    let place = *known.entry((*to, leader)).or_insert_with(|| {
                        places.push((*to, leader));
                        places.len() as u32 - 1
                    });
                    after.push(place);
                }
            });
            next.push(after);
            if places.len() > MAX_CONFIGURATIONS {
                return Err(OptimumError::Configurations);
            }
        }
        Ok(Self { robots: ground.robots(), places, occupied, next })
    }

    /// By cell and configuration: the fewest team moves until a robot is in the cell.
    fn distances(&self, cells: usize) -> Vec<Vec<u16>> {
        let mut before = vec![Vec::new(); self.next.len()];
        for (place, next) in self.next.iter().enumerate() {
            for &after in next {
                before[after as usize].push(place as u32);
            }
        }
        let mut distances = vec![vec![FAR; self.next.len()]; cells];
        for (cell, distances) in distances.iter_mut().enumerate() {
            let there = (0..self.occupied.len()).filter(|&place| self.occupied[place] >> cell & 1 == 1);
            let mut wave: Vec<u32> = there.map(|place| place as u32).collect();
            let mut steps = 0;
            while !wave.is_empty() {
                let mut next = Vec::new();
                for place in wave {
                    let distance = &mut distances[place as usize];
                    if *distance == FAR {
                        *distance = steps;
                        next.extend_from_slice(&before[place as usize]);
                    }
                }
                wave = next;
                steps += 1;
            }
        }
        distances
    }

    /// By number of robots m from 1 on: the cells that the last m robots alone can be in.
    fn last_robots(&self) -> Vec<u128> {
        let movers = self.robots.saturating_sub(1);
        let mut by_robot = vec![0_u128; movers];
        for (followers, leader) in &self.places {
            let team = followers.iter().take(movers.saturating_sub(1)).chain([leader]);
            for (cells, &cell) in by_robot.iter_mut().zip(team) {
                *cells |= 1 << cell;
            }
        }
        let union = |robots: &[u128]| robots.iter().fold(0, |union, &cells| union | cells);
        (1..=movers).map(|last| union(&by_robot) & !union(&by_robot[..movers - last])).collect()
    }

    pub(super) fn team(&self, place: u32, base: Cell, cells: &[Cell]) -> Vec<Cell> {
        let (followers, leader) = self.places[place as usize];
        let mut team = vec![base];
        team.extend(
            followers.iter().take(self.robots.saturating_sub(2)).map(|&cell| cells[usize::from(cell)]),
        );
        team.extend((self.robots > 1).then(|| cells[usize::from(leader)]));
        team
    }
}

/// The places of the ones in `set`.
fn ones(mut set: u128) -> impl Iterator<Item = u8> {
    std::iter::from_fn(move || {
        let place = (set != 0).then(|| set.trailing_zeros() as u8);
        set &= set.wrapping_sub(1);
        place
    })
}

/// No team moves lead there.
const FAR: u16 = u16::MAX;

/// A [`Guide`]'s numbers.
struct Bound {
    guide: Guide,
    /// By cell and configuration: the fewest team moves until a robot is in the cell.
    distances: Vec<Vec<u16>>,
    /// By number of robots m from 1 on: the cells that the last m alone can be in.
    last: Vec<u128>,
    /// By two cells that the leader alone can be in: the fewest team moves from one to the other.
    weights: Vec<Vec<u16>>,
    /// By set of cells: the weight of its smallest spanning tree.
    trees: FxHashMap<u128, u32>,
}

impl Bound {
    fn new(graph: &Graph, cells: usize, guide: Guide) -> Self {
        match guide {
            Guide::Blind => {
                let (distances, last, weights) = (Vec::new(), Vec::new(), Vec::new());
                Self { guide, distances, last, weights, trees: FxHashMap::default() }
            }
            Guide::Distances => {
                let distances = graph.distances(cells);
                let last = graph.last_robots();
                let alone = last.first().copied().unwrap_or(0);
                let mut weights = vec![vec![FAR; cells]; cells];
                for (place, &(_, leader)) in graph.places.iter().enumerate() {
                    let one = usize::from(leader);
                    let others = if alone >> leader & 1 == 1 { alone } else { 0 };
                    for other in ones(others).map(usize::from) {
                        let weight = weights[one][other].min(distances[other][place]);
                        weights[one][other] = weight;
                        weights[other][one] = weight;
                    }
                }
                Self { guide, distances, last, weights, trees: FxHashMap::default() }
            }
        }
    }

    /// Team moves that are at least needed from the configuration `place` to explore the cells `left`; `None` if they
    /// cannot be explored from there any more.
    fn moves(&mut self, place: u32, left: u128) -> Option<u32> {
        if self.guide == Guide::Blind {
            return Some(0);
        }
        let to = |cell: u8| self.distances[usize::from(cell)][place as usize];
        let farthest = ones(left).map(to).max().unwrap_or(0);
        let mut moves = u32::from(farthest);
        for (robots, &cells) in (1..).zip(&self.last) {
            let left = left & cells;
            let Some(nearest) = ones(left).map(to).min() else { continue };
            let more = left.count_ones().saturating_sub(robots).div_ceil(robots);
            let more = match robots {
                1 => more.max(*self.trees.entry(left).or_insert_with(|| tree(&self.weights, left))),
                _ => more,
            };
            moves = moves.max(u32::from(nearest) + more);
        }
        (farthest != FAR).then_some(moves)
    }
}

/// The weight of a smallest spanning tree of `cells`, by Prim.
fn tree(weights: &[Vec<u16>], cells: u128) -> u32 {
    let mut rest: Vec<(u16, u8)> = ones(cells).map(|cell| (FAR, cell)).collect();
    let mut sum = 0;
    let Some((_, mut newest)) = rest.pop() else { return 0 };
    while !rest.is_empty() {
        let mut nearest = 0;
        for index in 0..rest.len() {
            let (weight, cell) = rest[index];
            rest[index].0 = weight.min(weights[usize::from(newest)][usize::from(cell)]);
            if rest[index].0 < rest[nearest].0 {
                nearest = index;
            }
        }
        let (weight, cell) = rest.swap_remove(nearest);
        sum += u32::from(weight);
        newest = cell;
    }
    sum
}

/// A configuration and the cells left.
#[derive(Clone, Copy)]
struct Node {
    place: u32,
    left: u128,
    /// The node before.
    parent: u32,
    /// Team moves made.
    made: u32,
    /// Team moves in all, at least.
    least: u32,
}

struct Search<'a> {
    graph: &'a Graph,
    bound: Bound,
    nodes: Vec<Node>,
    known: FxHashMap<(u32, u128), u32>,
    /// By least number of team moves in all: nodes, with the team moves made when they were put here.
    open: Vec<Vec<(u32, u32)>>,
}

impl Search<'_> {
    /// The configurations of a shortest exploration of `goals`, and how many states the search went on from. Of equals
    /// the one put in last comes first, and a team move's best outcome is put in last.
    fn run(mut self, goals: u128, most_states: usize) -> Result<(Vec<u32>, u64), OptimumError> {
        let left = goals & !self.graph.occupied[0];
        self.add(Node { place: 0, left, parent: 0, made: 0, least: 0 });
        let (mut states, mut least) = (0, 0);
        while let Some(open) = self.open.get_mut(least) {
            let Some((index, made)) = open.pop() else {
                least += 1;
                continue;
            };
            let node = self.nodes[index as usize];
            if node.made != made {
                continue;
            }
            if node.left == 0 {
                return Ok((self.path(index), states));
            }
            states += 1;
            if self.nodes.len() > most_states {
                return Err(OptimumError::States { most: most_states });
            }
            let places = self.graph.next[node.place as usize].iter();
            let mut after: Vec<(u32, u128)> =
                places.map(|&place| (place, node.left & !self.graph.occupied[place as usize])).collect();
            after.sort_by_key(|&(_, left)| Reverse(left.count_ones()));
            for (place, left) in after {
                self.add(Node { place, left, parent: index, made: made + 1, least: node.least });
            }
        }
        Err(OptimumError::Apart)
    }

    fn add(&mut self, node: Node) {
        let Some(more) = self.bound.moves(node.place, node.left) else { return };
        // What is at least needed on the way to the node before, is needed here.
        let least = node.least.max(node.made + more);
        let node = Node { least, ..node };
        let new = self.nodes.len() as u32;
        let index = *self.known.entry((node.place, node.left)).or_insert(new);
        if index == new {
            self.nodes.push(node);
        } else if node.made < self.nodes[index as usize].made {
            self.nodes[index as usize] = node;
        } else {
            return;
        }
        if self.open.len() <= least as usize {
            self.open.resize(least as usize + 1, Vec::new());
        }
        self.open[least as usize].push((index, node.made));
    }

    fn path(&self, last: u32) -> Vec<u32> {
        let mut path = vec![self.nodes[last as usize].place];
        let mut index = last;
        while index != 0 {
            index = self.nodes[index as usize].parent;
            path.push(self.nodes[index as usize].place);
        }
        path.reverse();
        path
    }
}

/// The chains for which [`least_in_the_open`] finds the fewest team moves.
const SOLVED: RangeInclusive<u32> = 2..=6;

/// The bound of [`least_in_the_open`], in words.
pub fn solved() -> String {
    format!("{}, solved by A*", whole_runs::chains(&SOLVED))
}

/// CHAIN-10, without its argument: the fewest team moves for the (2N−1)² cells.
///
/// # Errors
/// [`Stop::Violated`] if they are not 9(N−1)−1.
pub fn least_in_the_open(observed: &Subject, oracle: &mut dyn Oracle) -> Outcome {
    let robots = whole_runs::within(&SOLVED, oracle) as usize;
    let (area, base) = whole_runs::area(robots);
    let ground = Ground::new(area, base, robots, |_| true).ok_or(Stop::Assumed)?;
    let goals = ground.reachable(&observed.rule).map_err(|_| UNSOLVED)?;
    require(goals.len() == area.cells().count(), "all cells can be reached")?;
    let solved = explore_all(&ground, &observed.rule, &goals, Guide::Distances, MOST_STATES);
    let moves = solved.map_err(|_| UNSOLVED)?.moves();
    require(moves as usize == 9 * (robots - 1) - 1, "the fewest team moves are 9(N−1)−1")?;
    Ok("an open area")
}

const MOST_STATES: usize = 100_000;

const UNSOLVED: Stop = Stop::Violated("the fewest team moves are found within the states allowed");

#[cfg(test)]
mod tests {
    use tautline_kernel::chain::{Condition, Move};
    use tautline_kernel::ground::{Area, Edge, Side};

    use super::super::reach::tests::{ground, layouts_of_two_robots, random, team_moves};
    use super::*;
    use crate::engine::SeededOracle;

    const MANY: usize = 20_000_000;

    /// The fewest team moves, after a look at the exploration itself: it is admitted and explores all goals.
    fn solve(ground: &Ground, rule: &Rule, goals: &CellSet, guide: Guide) -> u32 {
        let optimum = explore_all(ground, rule, goals, guide, MANY).expect("a small ground");
        let teams = &optimum.configurations;
        assert_eq!(teams[0], vec![ground.base(); ground.robots()]);
        for pair in teams.windows(2) {
            let admitted = team_moves(ground, rule, &pair[0]);
            let is_it =
                |team: &Vec<Move>| team.iter().map(|planned| planned.to()).eq(pair[1].iter().copied());
            assert!(admitted.iter().any(is_it), "{pair:?} {ground:?}");
        }
        assert!(goals.iter().all(|goal| teams.iter().flatten().any(|&cell| cell == goal)), "{ground:?}");
        optimum.moves()
    }

    fn agrees(ground: &Ground, goals: &CellSet) {
        let rule = &Rule::REPAIRED;
        let guided = solve(ground, rule, goals, Guide::Distances);
        assert_eq!(guided, solve(ground, rule, goals, Guide::Blind), "{goals:?} {ground:?}");
    }

    fn reachable(ground: &Ground) -> CellSet {
        ground.reachable(&Rule::REPAIRED).expect("a small ground")
    }

    #[test]
    fn two_robots_need_what_plain_search_says_in_all_layouts() {
        for ground in layouts_of_two_robots() {
            agrees(&ground, &reachable(&ground));
        }
    }

    #[test]
    fn more_robots_need_what_plain_search_says_in_smaller_areas() {
        let mut oracle = SeededOracle::new(0, 0);
        for (robots, width, height, layouts) in [(3, 5, 3, 10), (3, 4, 3, 20), (4, 4, 3, 5), (5, 3, 3, 5)] {
            let area = Area::new(Cell::new(0, 0), Cell::new(width - 1, height - 1)).expect("cells");
            for _ in 0..layouts {
                let ground = random(robots, area, Cell::new(width / 2, 1), &mut oracle, 20);
                agrees(&ground, &reachable(&ground));
            }
        }
    }

    #[test]
    fn three_robots_need_what_plain_search_says_for_some_of_the_cells() {
        let mut oracle = SeededOracle::new(1, 0);
        let open = ground(3, |_| false);
        for walls_percent in [5, 15, 30] {
            for _ in 0..10 {
                let ground = random(3, open.area(), open.base(), &mut oracle, walls_percent);
                let mut goals = CellSet::new(ground.area());
                for cell in reachable(&ground).iter().filter(|_| oracle.pick(3) == 0) {
                    goals.insert(cell);
                }
                agrees(&ground, &goals);
            }
        }
    }

    #[test]
    fn plain_search_needs_17_team_moves_for_the_outer_ring_of_three_robots_alone() {
        let ground = ground(3, |_| false);
        let mut ring = CellSet::new(ground.area());
        for cell in ground.area().cells().filter(|cell| cell.x % 4 == 0 || cell.y % 4 == 0) {
            ring.insert(cell);
        }
        assert_eq!(ring.len(), 16);
        agrees(&ground, &ring);
        assert_eq!(solve(&ground, &Rule::REPAIRED, &ring, Guide::Blind), 17);
        assert_eq!(solve(&ground, &Rule::REPAIRED, &reachable(&ground), Guide::Distances), 17);
    }

    #[test]
    fn without_e_s_ahead_four_robots_need_fewer_and_three_do_not() {
        let rule = Rule::REPAIRED.without(Condition::SafeAhead);
        for (robots, moves) in [(3, 17), (4, 25)] {
            let ground = ground(robots, |_| false);
            assert_eq!(solve(&ground, &rule, &reachable(&ground), Guide::Distances), moves);
        }
    }

    #[test]
    fn what_cannot_be_solved_is_said() {
        let two = [Edge::new(Cell::new(1, 1), Side::East), Edge::new(Cell::new(1, 1), Side::South)];
        let ground = |robots| ground(robots, |edge| two.contains(&edge));
        let goals = |ground: &Ground, cell| {
            let mut goals = CellSet::new(ground.area());
            goals.insert(cell);
            goals
        };
        let solve = |ground: &Ground, cell, most| {
            explore_all(ground, &Rule::REPAIRED, &goals(ground, cell), Guide::Distances, most)
        };
        let corner = Cell::new(0, 0);
        assert_eq!(solve(&ground(3), corner, MANY), Err(OptimumError::OutOfReach { cell: corner }));
        let outside = goals(&ground(4), Cell::new(6, 6));
        let solved = explore_all(&ground(3), &Rule::REPAIRED, &outside, Guide::Distances, MANY);
        assert_eq!(solved, Err(OptimumError::OutOfReach { cell: Cell::new(6, 6) }));
        assert_eq!(solve(&ground(3), Cell::new(4, 4), 3), Err(OptimumError::States { most: 3 }));
        let too_large = TooLarge::Cells { cells: 169 };
        assert_eq!(solve(&ground(7), corner, MANY), Err(OptimumError::TooLarge(too_large)));
        let row = Area::new(Cell::new(0, 0), Cell::new(4, 4)).expect("cells");
        let crowd = Ground::new(row, Cell::new(2, 2), 8, |_| true).expect("a base inside");
        assert_eq!(solve(&crowd, corner, MANY), Err(OptimumError::Configurations));
    }
}

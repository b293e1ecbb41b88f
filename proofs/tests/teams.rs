//! Whether the chain is optimal among all connected teams in the open (CHAIN-9, CHAIN-10): teams of which links by E_S,
//! or by E_C, join all robots to the base as any tree, against chains.

use std::cmp::Reverse;
use std::collections::{BinaryHeap, HashMap};

use tautline_kernel::chain::Rule;
use tautline_kernel::ground::{Area, Cell, Circle, Step};
use tautline_proofs::chain::optimum::{Guide, explore_all};
use tautline_proofs::chain::reach::Ground;
use tautline_proofs::engine::smallest::areas_of;

/// A team in an open area.
struct Team {
    area: Area,
    base: Cell,
    /// The base not counted.
    movers: usize,
    /// Two robots are linked where one is in this environment of the other.
    links: Circle,
}

impl Team {
    /// Whether links join robots in these cells to the base.
    fn is_connected(&self, cells: &[Cell]) -> bool {
        let (mut joined, mut left) = (vec![self.base], cells.to_vec());
        while let Some(cell) = joined.pop() {
            joined.extend(left.extract_if(.., |other| self.links.covers(cell, *other)));
        }
        left.is_empty()
    }

    /// Where the robots can be after the next team move, in any order of theirs.
    fn next(&self, cells: &[Cell]) -> Vec<Vec<Cell>> {
        let mut teams = vec![Vec::new()];
        for cell in cells {
            let steps = Step::ALL.map(|step| cell.after(step));
            let steps: Vec<Cell> = steps.into_iter().filter(|&to| self.area.contains(to)).collect();
            let with = |team: Vec<Cell>| {
                let free = steps.iter().filter(|to| **to == self.base || !team.contains(to));
                free.map(|&to| [team.as_slice(), &[to]].concat()).collect::<Vec<_>>()
            };
            teams = teams.into_iter().flat_map(with).collect();
        }
        teams.retain(|team| self.is_connected(team));
        for team in &mut teams {
            team.sort_unstable();
        }
        teams.sort_unstable();
        teams.dedup();
        teams
    }

    /// The fewest team moves in which all cells are explored: A*, by the cells left for each robot.
    fn fewest(&self) -> u32 {
        let bit = |cell: Cell| {
            let (column, row) = self.area.locate(cell).expect("a cell of the area");
            1_u32 << (row * self.area.width() + column)
        };
        let mut known = vec![vec![self.base; self.movers]];
        let mut places = HashMap::from([(known[0].clone(), 0)]);
        let mut after: Vec<Option<Vec<usize>>> = vec![None];
        let all = self.area.cells().fold(0, |all, cell| all | bit(cell));
        let least = |left: u32| left.count_ones().div_ceil(self.movers as u32);
        let start = (0, all & !bit(self.base));
        let mut made = HashMap::from([(start, 0)]);
        let mut open = BinaryHeap::from([(Reverse(least(start.1)), 0, start)]);
        while let Some((_, moves, (place, left))) = open.pop() {
            if left == 0 {
                return moves;
            }
            if made[&(place, left)] < moves {
                continue;
            }
            let next = after[place].take().unwrap_or_else(|| {
                let mut next = Vec::new();
                for team in self.next(&known[place]) {
                    next.push(*places.entry(team.clone()).or_insert_with(|| {
                        known.push(team);
                        after.push(None);
                        known.len() - 1
                    }));
                }
                next
            });
            for &to in &next {
                let state = (to, known[to].iter().fold(left, |left, &cell| left & !bit(cell)));
                let best = made.entry(state).or_insert(u32::MAX);
                if moves + 1 < *best {
                    *best = moves + 1;
                    open.push((Reverse(moves + 1 + least(state.1)), moves + 1, state));
                }
            }
            after[place] = Some(next);
        }
        panic!("every cell can be reached")
    }
}

/// The fewest team moves of a chain of so many robots; `None` if some cells are too far for it.
fn of_chain(area: Area, base: Cell, robots: usize) -> Option<u32> {
    let ground = Ground::new(area, base, robots, |_| true)?;
    (ground.area() == area).then_some(())?;
    let goals = ground.reachable(&Rule::PUBLISHED).expect("a small ground");
    let optimum = explore_all(&ground, &Rule::PUBLISHED, &goals, Guide::Distances, 1_000_000);
    Some(optimum.expect("a small ground").moves())
}

/// The paper's area of so many robots, and its base.
fn square(robots: usize) -> (Area, Cell) {
    let ring = robots as i16 - 1;
    let area = Area::new(Cell::new(0, 0), Cell::new(2 * ring, 2 * ring)).expect("cells");
    (area, Cell::new(ring, ring))
}

#[test]
fn a_tree_is_faster_than_a_chain_in_three_cells_in_a_row() {
    let (mut compared, mut faster) = (0, Vec::new());
    for (cells, robots) in (1..=9).flat_map(|cells| [2, 3, 4].map(|robots| (cells, robots))) {
        for area in areas_of(cells) {
            for base in area.cells().filter(|_| cells < 9 || robots < 4) {
                let Some(chain) = of_chain(area, base, robots) else { continue };
                let tree = Team { area, base, movers: robots - 1, links: Circle::SAFE }.fewest();
                assert!(tree <= chain && (robots > 2 || tree == chain), "{area:?} {base} {robots}");
                compared += 1;
                if tree < chain {
                    faster.push((area.width(), area.height(), base, robots, tree, chain));
                }
            }
        }
    }
    assert_eq!((compared, faster.len()), (129, 37));
    assert_eq!(faster.first(), Some(&(3, 1, Cell::new(1, 0), 3, 1, 2)));
}

/// A robot in ring N−1 needs N−1 links to the base, and there are no more. So also of any tree one robot at most is in
/// that ring, which has 8(N−1) cells, and after N−1 team moves at the earliest: none is faster than the chain.
#[test]
fn in_the_papers_area_no_tree_is_faster_than_the_chain() {
    for robots in 2..=4 {
        let (area, base) = square(robots);
        let team = Team { area, base, movers: robots - 1, links: Circle::SAFE };
        let mut teams: Vec<Vec<Cell>> = vec![Vec::new()];
        for _ in 1..robots {
            let with = |team: Vec<Cell>| area.cells().map(move |cell| [team.as_slice(), &[cell]].concat());
            teams = teams.into_iter().flat_map(with).collect();
        }
        teams.retain(|cells| team.is_connected(cells));
        let is_far = |cell: &&Cell| {
            let (columns, rows) = cell.apart(base);
            usize::from(columns.max(rows)) == robots - 1
        };
        assert_eq!(teams.iter().map(|cells| cells.iter().filter(is_far).count()).max(), Some(1));
    }
    let (area, base) = square(2);
    assert_eq!(Team { area, base, movers: 1, links: Circle::SAFE }.fewest(), 8);
}

#[test]
fn a_tree_of_three_robots_that_is_linked_by_e_c_is_faster_in_the_papers_area() {
    let (area, base) = square(3);
    assert_eq!(of_chain(area, base, 3), Some(17));
    assert_eq!(Team { area, base, movers: 2, links: Circle::COVERED }.fewest(), 16);
}

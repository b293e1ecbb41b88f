//! Rivals that assign frontier cells to robots: unexplored cells beside explored ones, each to the robot that goes
//! there.
//!
//! One repository is known to all. A robot goes its shortest way through explored cells, stays where another robot is
//! in its way, and stores an obstacle that it meets. An assignment is kept until its cell is known or its robot is in
//! another one's way, unless the rival assigns anew at every move.

use std::collections::{BTreeMap, BTreeSet, VecDeque};

use pathfinding::directed::bfs::bfs;
use pathfinding::kuhn_munkres::kuhn_munkres_min;
use pathfinding::matrix::Matrix;
use tautline_kernel::frontier::{Map, Status};
use tautline_kernel::ground::{Cell, Side};
use tautline_proofs::run::Frame;

use super::chart::Chart;
use super::{Moves, PATIENCE, TeamEnd};
use tautline_grids::layout::Layout;

/// How frontier cells are assigned.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Assignment {
    /// The nearest pair of a robot and a cell first, and so on.
    Greedy,
    /// So that all ways together are shortest (the Hungarian algorithm).
    Hungarian,
    /// By the Hungarian algorithm, anew at every move.
    HungarianAnew,
    /// Each robot in its order takes the nearest cell that no earlier robot has taken, at every move. Where there is
    /// none left, it stays.
    Earlier,
}

/// The ways of a robot: for each cell that it reaches how many moves it takes.
type Ways = BTreeMap<Cell, u32>;

/// A team whose cells are assigned.
#[derive(Clone, Debug)]
pub struct AssignedTeam {
    assignment: Assignment,
    layout: Layout,
    chart: Chart,
    /// How much the repository knew before the last team move.
    known: usize,
    cells: Vec<Cell>,
    aims: Vec<Option<Cell>>,
    idle: usize,
}

/// The sides of a cell, in the order of the numbers of the cells beyond them.
const BY_NUMBER: [Side; 4] = [Side::North, Side::West, Side::East, Side::South];

impl AssignedTeam {
    /// A team in these starts.
    pub fn new(assignment: Assignment, layout: &Layout, starts: &[Cell]) -> Self {
        let mut chart = Chart::new(layout.size().area());
        for &start in starts {
            chart.learn(start, Status::Explored);
        }
        let (layout, cells, aims) = (layout.clone(), starts.to_vec(), vec![None; starts.len()]);
        Self { assignment, layout, chart, known: 0, cells, aims, idle: 0 }
    }

    /// Where the robots are.
    pub fn cells(&self) -> &[Cell] {
        &self.cells
    }

    /// The obstacles that robots have met in the last team move.
    pub fn met(&self) -> impl Iterator<Item = Cell> {
        let news = self.chart.learned(self.known).iter();
        news.filter(|(_, status)| *status == Status::Obstacle).map(|&(cell, _)| cell)
    }

    /// The robots that go to a frontier cell in the next team move, and to which.
    pub fn aims(&self) -> impl Iterator<Item = (usize, Cell)> {
        let aims = self.assigned(&self.frontier()).into_iter().enumerate();
        aims.filter_map(|(robot, aim)| Some((robot, aim?)))
    }

    /// Makes a team move.
    ///
    /// # Errors
    /// [`TeamEnd`] if there is none.
    pub fn advance(&mut self) -> Result<Frame, TeamEnd> {
        let frontier = self.frontier();
        if frontier.is_empty() {
            return Err(TeamEnd::Known);
        }
        self.aims = self.assigned(&frontier);
        let before = self.chart.len();
        self.known = before;
        let mut moves = Moves::none(self.cells.len());
        let mut entering: Vec<Option<Cell>> = vec![None; self.cells.len()];
        for robot in 0..self.cells.len() {
            let Some(side) = self.aims[robot].and_then(|aim| self.towards(self.cells[robot], aim)) else {
                continue;
            };
            let cell = self.cells[robot].beyond(side);
            let is_there =
                |other: usize| other != robot && (self.cells[other] == cell || entering[other] == Some(cell));
            if !self.layout.is_free(cell) {
                self.chart.learn(cell, Status::Obstacle);
                moves.bumps(robot, side);
            } else if (0..self.cells.len()).any(is_there) {
                self.aims[robot] = None;
            } else {
                moves.goes(robot, side);
                entering[robot] = Some(cell);
            }
        }
        let is_still = entering.iter().all(Option::is_none) && self.chart.len() == before;
        for (robot, cell) in entering.into_iter().enumerate() {
            let Some(cell) = cell else { continue };
            self.cells[robot] = cell;
            self.chart.learn(cell, Status::Explored);
        }
        self.idle = if self.chart.len() == before { self.idle + 1 } else { 0 };
        // Who assigns anew does the same again when nobody has moved.
        let waits = is_still && matches!(self.assignment, Assignment::Earlier | Assignment::HungarianAnew);
        if waits {
            return Err(TeamEnd::Endless);
        }
        if self.idle > PATIENCE * self.layout.size().cells() {
            return Err(TeamEnd::Idle);
        }
        Ok(moves.frame(&self.cells))
    }

    /// The unexplored cells beside explored ones that a robot reaches.
    fn frontier(&self) -> BTreeSet<Cell> {
        let reached = self.cells.iter().flat_map(|&cell| self.ways(cell).into_keys());
        reached.filter(|&cell| self.chart.status(cell) == Status::Unexplored).collect()
    }

    /// How far the cells are that are reached from `from` through explored ones.
    fn ways(&self, from: Cell) -> Ways {
        let (mut ways, mut queue) = (Ways::from([(from, 0)]), VecDeque::from([from]));
        while let Some(cell) = queue.pop_front() {
            if self.chart.status(cell) != Status::Explored {
                continue;
            }
            let distance = ways.get(&cell).copied().unwrap_or(0) + 1;
            for beside in BY_NUMBER.map(|side| cell.beyond(side)) {
                if self.chart.status(beside) != Status::Obstacle && !ways.contains_key(&beside) {
                    ways.insert(beside, distance);
                    queue.push_back(beside);
                }
            }
        }
        ways
    }

    /// The first side of a shortest way to `aim`.
    fn towards(&self, from: Cell, aim: Cell) -> Option<Side> {
        let is_on_way = |cell: &Cell| *cell == from || self.chart.status(*cell) == Status::Explored;
        let beside = |cell: &Cell| BY_NUMBER.map(|side| cell.beyond(side)).into_iter().filter(is_on_way);
        let way_back = bfs(&aim, beside, |&cell| cell == from)?;
        let next = way_back.iter().rev().nth(1);
        Side::ALL.into_iter().find(|&side| next == Some(&from.beyond(side)))
    }

    /// The frontier cell of each robot.
    fn assigned(&self, frontier: &BTreeSet<Cell>) -> Vec<Option<Cell>> {
        let is_kept = matches!(self.assignment, Assignment::Greedy | Assignment::Hungarian);
        let kept = self.aims.iter().map(|aim| aim.filter(|aim| is_kept && frontier.contains(aim)));
        let mut aims: Vec<Option<Cell>> = kept.collect();
        let free: Vec<usize> = (0..self.cells.len()).filter(|&robot| aims[robot].is_none()).collect();
        let left: Vec<Cell> = frontier.iter().copied().filter(|cell| !aims.contains(&Some(*cell))).collect();
        let ways: Vec<Ways> = free.iter().map(|&robot| self.ways(self.cells[robot])).collect();
        let number = |cell: Cell| (cell.y, cell.x);
        match self.assignment {
            Assignment::Earlier => {
                for (&robot, ways) in free.iter().zip(&ways) {
                    let open = left.iter().filter(|&&cell| !aims.contains(&Some(cell)));
                    let near = open.filter_map(|&cell| Some((*ways.get(&cell)?, number(cell), cell)));
                    aims[robot] = near.min().map(|(.., cell)| cell);
                }
            }
            Assignment::Greedy => {
                let pair =
                    |place: usize, cell: Cell| Some((*ways[place].get(&cell)?, place, number(cell), cell));
                let of_robot = |place: usize| left.iter().filter_map(move |&cell| pair(place, cell));
                let pairs: BTreeSet<_> = (0..free.len()).flat_map(of_robot).collect();
                for (_, place, _, cell) in pairs {
                    if aims[free[place]].is_none() && !aims.contains(&Some(cell)) {
                        aims[free[place]] = Some(cell);
                    }
                }
            }
            Assignment::Hungarian | Assignment::HungarianAnew => assign_all(&mut aims, &free, &left, &ways),
        }
        aims
    }
}

/// Assigns so that all ways together are shortest. A pair without a way is longer than all others together.
fn assign_all(aims: &mut [Option<Cell>], free: &[usize], left: &[Cell], ways: &[Ways]) {
    if free.is_empty() || left.is_empty() {
        return;
    }
    let far = 1_i64 << 32;
    let cost = |robot: usize, cell: usize| ways[robot].get(&left[cell]).map_or(far, |&way| i64::from(way));
    let mut weights = Matrix::from_fn(free.len(), left.len(), |(robot, cell)| cost(robot, cell));
    let are_many = free.len() > left.len();
    if are_many {
        weights = weights.transposed();
    }
    for (row, column) in kuhn_munkres_min(&weights).1.into_iter().enumerate() {
        let (robot, cell) = if are_many { (column, row) } else { (row, column) };
        aims[free[robot]] = Some(left[cell]).filter(|_| cost(robot, cell) < far);
    }
}

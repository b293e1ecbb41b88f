//! The judge of PACK: runs by the published rule (PACK-1, PACK-3), and packs that no rule gets away (PACK-5). It
//! knows the sentences of `SPEC.md` alone.

use std::collections::{BTreeMap, BTreeSet, VecDeque};

use super::change::plain;
use super::{Case, Floor, Objection, Place, SIDES, beside, breaks_at_last, must};

/// The metric gain of a frontier cell.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Metric {
    /// The unknown cells in sight, by the steps: as published.
    CellsBySteps,
    /// Their share of all cells in sight, by the steps.
    ShareBySteps,
    /// The unknown cells in sight, by the straight line.
    CellsByLine,
    /// Their share of all cells in sight, by the straight line.
    ShareByLine,
}

impl Metric {
    /// It, or its square where the distance is a root, as a fraction.
    const fn fraction(
        self,
        unknown: usize,
        in_sight: usize,
        steps: usize,
        line_squared: usize,
    ) -> (usize, usize) {
        match self {
            Self::CellsBySteps => (unknown, steps),
            Self::ShareBySteps => (unknown, in_sight * steps),
            Self::CellsByLine => (unknown * unknown, line_squared),
            Self::ShareByLine => (unknown * unknown, in_sight * in_sight * line_squared),
        }
    }
}

/// The cells that are called frontier.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Frontier {
    /// Explored ones beside unexplored ones: as published.
    Explored,
    /// Unexplored ones beside explored ones.
    Unexplored,
}

/// How robots choose where to go.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Choice {
    /// The gain that they compare.
    pub metric: Metric,
    /// The cells among which they choose.
    pub frontier: Frontier,
}

impl Choice {
    /// As published.
    pub const PUBLISHED: Self = Self { metric: Metric::CellsBySteps, frontier: Frontier::Explored };
}

/// A run of a pack.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Run {
    /// The clause that it is said to break.
    pub clause: &'static str,
    /// The cells, and their obstacles.
    pub floor: Floor,
    /// R_s, in cells.
    pub sight: i32,
    /// R_c, in cells.
    pub range: i32,
    /// How robots choose.
    pub choice: Choice,
    /// Where each robot starts.
    pub starts: Vec<Place>,
    /// Where all robots are after each team move.
    pub moves: Vec<Vec<Place>>,
}

plain!(Run { floor, sight, range, starts, moves });

/// Where a robot goes, and the sides through which it gets there, the next one first.
#[derive(Clone, Debug)]
struct Aim {
    cell: Place,
    way: VecDeque<usize>,
}

struct Team {
    cells: Vec<Place>,
    aims: Vec<Option<Aim>>,
    /// The cells that were seen: free (true), or with an obstacle.
    seen: BTreeMap<Place, bool>,
}

impl Team {
    /// A robot's way after the next step.
    fn go_on(&mut self, robot: usize) {
        if let Some(aim) = &mut self.aims[robot] {
            aim.way.pop_front();
        }
    }
}

impl Case for Run {
    fn clause(&self) -> &'static str {
        self.clause
    }

    fn judge(&self) -> Result<(), Objection> {
        let Self { starts, moves, floor, .. } = self;
        must((1..=20).contains(&self.sight) && self.range >= 3, "robots see a cell, and hear three")?;
        let alone: BTreeSet<Place> = starts.iter().copied().collect();
        let are_free = starts.iter().all(|&start| floor.is_free(start));
        must(
            starts.len() > 1 && alone.len() == starts.len() && are_free,
            "robots start in cells of their own",
        )?;
        let side_by_side = joins(starts, |one, other| (0..4).any(|side| beside(one, side) == Some(other)));
        let is_linked = if self.clause == "PACK-5" { self.is_joined(starts) } else { side_by_side };
        must(is_linked, "the robots start otherwise")?;
        let mut team = self.team();
        for (number, made) in (1..).zip(moves) {
            let object = |what| Objection { at: number, what };
            must(self.clause != "PACK-5", "the judge knows packs alone that cannot go").map_err(object)?;
            must(self.advance(&mut team), "the run is over before this team move").map_err(object)?;
            must(team.cells == *made, "the rule goes elsewhere").map_err(object)?;
            self.look(&mut team);
            let breaks = self.clause == "PACK-1" && !self.is_joined(made);
            let is_last = number == moves.len() && self.clause == "PACK-1";
            breaks_at_last(breaks, is_last).map_err(object)?;
        }
        let is_seen = floor.barred.iter().all(|cell| team.seen.contains_key(cell));
        must(is_seen, "an obstacle was never seen")?;
        match self.clause {
            "PACK-1" => Ok(must(!moves.is_empty(), "nothing happens")?),
            "PACK-3" | "PACK-5" => {
                let goes_on = if self.clause == "PACK-5" {
                    self.can_step(&team.cells)
                } else {
                    self.advance(&mut team)
                };
                must(!goes_on, "the run goes on")?;
                let is_left =
                    self.floor.walkable(&self.starts).iter().any(|cell| !team.seen.contains_key(cell));
                Ok(must(is_left, "every cell is explored")?)
            }
            _ => Err("the judge does not know this clause".into()),
        }
    }
}

/// Whether links join all cells.
fn joins(cells: &[Place], links: impl Fn(Place, Place) -> bool) -> bool {
    let (mut left, mut rim) = (cells.to_vec(), Vec::new());
    rim.extend(left.pop());
    while let Some(cell) = rim.pop() {
        let (near, far): (Vec<Place>, Vec<Place>) = left.into_iter().partition(|&other| links(cell, other));
        (left, rim) = (far, [rim, near].concat());
    }
    left.is_empty()
}

/// Columns and rows between two cells.
fn apart(one: Place, other: Place) -> Place {
    ((one.0 - other.0).abs(), (one.1 - other.1).abs())
}

impl Run {
    /// The team moves that the rule makes from the starts, at most so many, and the free cells that a robot could walk
    /// to and that are not seen then.
    pub(crate) fn played(&self, most: usize) -> (Vec<Vec<Place>>, Vec<Place>) {
        let (mut team, mut moves) = (self.team(), Vec::new());
        while moves.len() < most && self.advance(&mut team) {
            self.look(&mut team);
            moves.push(team.cells.clone());
        }
        let walkable = self.floor.walkable(&self.starts).into_iter();
        (moves, walkable.filter(|cell| !team.seen.contains_key(cell)).collect())
    }

    /// The robots where they start, who have looked round.
    fn team(&self) -> Team {
        let (cells, aims) = (self.starts.clone(), vec![None; self.starts.len()]);
        let mut team = Team { cells, aims, seen: BTreeMap::new() };
        self.look(&mut team);
        team
    }

    /// A link by midpoints, as published.
    fn links(&self, one: Place, other: Place) -> bool {
        let (columns, rows) = apart(one, other);
        columns * columns + rows * rows <= self.range * self.range
    }

    /// Whether links by all four corners join all.
    fn is_joined(&self, cells: &[Place]) -> bool {
        joins(cells, |one, other| {
            let (columns, rows) = apart(one, other);
            (2 * columns + 1).pow(2) + (2 * rows + 1).pow(2) <= 4 * self.range * self.range
        })
    }

    /// Whether a robot could take one step into a free cell, by itself, after which links by corners join all.
    fn can_step(&self, cells: &[Place]) -> bool {
        (0..cells.len()).any(|robot| {
            (0..4).filter_map(|side| beside(cells[robot], side)).any(|to| {
                let mut after = cells.to_vec();
                after[robot] = to;
                self.floor.is_free(to) && !cells.contains(&to) && self.is_joined(&after)
            })
        })
    }

    /// All robots look round.
    fn look(&self, team: &mut Team) {
        for &from in &team.cells {
            for to in self.disc(from).filter(|&to| self.floor.has(to)) {
                if sees(from, to, |cell| !self.floor.is_free(cell)) {
                    team.seen.insert(to, self.floor.is_free(to));
                }
            }
        }
    }

    /// The cells within R_s.
    fn disc(&self, (x, y): Place) -> impl Iterator<Item = Place> {
        let sight = self.sight;
        let all = (-sight..=sight).flat_map(move |dx| (-sight..=sight).map(move |dy| (dx, dy)));
        all.filter(move |(dx, dy)| dx * dx + dy * dy <= sight * sight).map(move |(dx, dy)| (x + dx, y + dy))
    }

    /// A team move by the published rule; none if no robot takes a step.
    fn advance(&self, team: &mut Team) -> bool {
        let is_unknown =
            |seen: &BTreeMap<Place, bool>, cell: Place| self.floor.has(cell) && !seen.contains_key(&cell);
        let is_frontier = |seen: &BTreeMap<Place, bool>, cell: Place| {
            let around = (0..4).filter_map(|side| beside(cell, side));
            match self.choice.frontier {
                Frontier::Explored => {
                    is_free(seen, cell) && around.into_iter().any(|cell| is_unknown(seen, cell))
                }
                Frontier::Unexplored => {
                    is_unknown(seen, cell) && around.into_iter().any(|cell| is_free(seen, cell))
                }
            }
        };
        let seen = team.seen.clone();
        for robot in 0..team.cells.len() {
            team.aims[robot] = team.aims[robot].take().filter(|aim| is_frontier(&seen, aim.cell));
        }
        for robot in 0..team.cells.len() {
            if team.aims[robot].is_none() {
                let others: Vec<Place> = team.aims.iter().flatten().map(|aim| aim.cell).collect();
                team.aims[robot] =
                    self.choose(&seen, team.cells[robot], &others, |cell| is_frontier(&seen, cell));
            }
        }
        let before = team.cells.clone();
        for robot in 0..team.cells.len() {
            self.take_step(team, robot);
        }
        team.cells != before
    }

    /// The choice of a robot: of the frontier cells with a link to a cell to which another robot is going, if there
    /// is one, and at most 2 R_c steps farther than the nearest of them, the first with the greatest metric gain, cells
    /// being in the order of a flood fill that looks east, south, west, north; if V is 0 everywhere, the first of
    /// all.
    fn choose(
        &self,
        seen: &BTreeMap<Place, bool>,
        from: Place,
        others: &[Place],
        is_frontier: impl Fn(Place) -> bool,
    ) -> Option<Aim> {
        let mut ways = BTreeMap::from([(from, VecDeque::new())]);
        let mut queue = VecDeque::from([from]);
        let mut first: Option<(usize, Place)> = None;
        let mut best: Option<(usize, usize, Place)> = None;
        while let Some(cell) = queue.pop_front() {
            let way: VecDeque<usize> = ways[&cell].clone();
            for side in 0..SIDES.len() {
                // A way may end in an unexplored cell, and leads through none.
                let goes_there =
                    |&next: &Place| is_free(seen, cell) && (is_free(seen, next) || is_frontier(next));
                let Some(next) = beside(cell, side).filter(goes_there) else { continue };
                ways.entry(next).or_insert_with(|| {
                    queue.push_back(next);
                    way.iter().copied().chain([side]).collect()
                });
            }
            let is_near = others.is_empty() || others.iter().any(|&other| self.links(other, cell));
            if !is_frontier(cell) || !is_near {
                continue;
            }
            let far = way.len();
            let &mut (least, _) = first.get_or_insert((far, cell));
            if far > least + 2 * self.range as usize {
                break;
            }
            let is_taken =
                |unknown: &Place| others.iter().any(|&other| self.disc(other).any(|cell| cell == *unknown));
            let is_obstacle = |cell: Place| seen.get(&cell) == Some(&false) || !self.floor.has(cell);
            let in_sight: Vec<Place> =
                self.disc(cell).filter(|&to| self.floor.has(to) && sees(cell, to, is_obstacle)).collect();
            let unknown = in_sight.iter().filter(|to| !seen.contains_key(to) && !is_taken(to)).count();
            let (columns, rows) = apart(from, cell);
            let line_squared = (columns * columns + rows * rows) as usize;
            let (gain, by) = self.choice.metric.fraction(unknown, in_sight.len(), far, line_squared);
            if gain > 0 && best.is_none_or(|(most, over, _)| gain * over > most * by) {
                best = Some((gain, by, cell));
            }
        }
        let cell = best.map(|(_, _, cell)| cell).or(first.map(|(_, cell)| cell))?;
        Some(Aim { cell, way: ways.remove(&cell)? })
    }

    /// The next step of a robot, if no robot is there and links by midpoints join all after it. Two robots that want
    /// into each other's cells change aims, each as if it had taken the other's step.
    fn take_step(&self, team: &mut Team, robot: usize) {
        let Some(side) = team.aims[robot].as_ref().and_then(|aim| aim.way.front().copied()) else { return };
        let (from, Some(to)) = (team.cells[robot], beside(team.cells[robot], side)) else { return };
        if let Some(other) = team.cells.iter().position(|&cell| cell == to) {
            let wants = team.aims[other].as_ref().and_then(|aim| beside(to, *aim.way.front()?));
            if wants == Some(from) {
                team.aims.swap(robot, other);
                team.go_on(robot);
                team.go_on(other);
            }
            return;
        }
        team.cells[robot] = to;
        if joins(&team.cells, |one, other| self.links(one, other)) {
            team.go_on(robot);
        } else {
            team.cells[robot] = from;
        }
    }
}

/// Whether a cell is known to be free.
fn is_free(seen: &BTreeMap<Place, bool>, cell: Place) -> bool {
    seen.get(&cell) == Some(&true)
}

/// Whether a ray goes straight from the midpoint of a cell to that of another one: no obstacle is in a cell that it
/// crosses before, and it passes no corner between two.
fn sees(from: Place, to: Place, is_obstacle: impl Fn(Place) -> bool) -> bool {
    let (dx, dy) = apart(from, to);
    let (x_step, y_step) = ((to.0 - from.0).signum(), (to.1 - from.1).signum());
    let (mut across, mut down, mut at) = (0, 0, from);
    while at != to {
        // The next line between columns is crossed after (2·across + 1) / (2·dx) of the way.
        let (by_column, by_row) = ((2 * across + 1) * dy, (2 * down + 1) * dx);
        let goes_across = across < dx && (down == dy || by_column <= by_row);
        let goes_down = down < dy && (across == dx || by_row <= by_column);
        if goes_across
            && goes_down
            && is_obstacle((at.0 + x_step, at.1))
            && is_obstacle((at.0, at.1 + y_step))
        {
            return false;
        }
        if goes_across {
            (at.0, across) = (at.0 + x_step, across + 1);
        }
        if goes_down {
            (at.1, down) = (at.1 + y_step, down + 1);
        }
        if at != to && is_obstacle(at) {
            return false;
        }
    }
    true
}

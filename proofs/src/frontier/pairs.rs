//! Which unexplored cell a robot goes to by what it knows and what the others have told it (FRONTIER-9): here all pairs
//! of robots and cells are written down, put in order, and taken one after the other.

use std::collections::VecDeque;

use tautline_kernel::choice::{Oracle, one_of};
use tautline_kernel::frontier::{Map, Next, Other, Place, Robot, Rule, Sight, Slot, Status, TinyMap, View};
use tautline_kernel::ground::{Area, Cell, Side};

use crate::engine::{Outcome, Stop, Tape, require};
use crate::plural::counted;

/// Columns and rows: on each map some cells are farther from the rim across than along it, on the other one the other
/// way.
const SIZES: [(i16, i16); 2] = [(3, 2), (2, 3)];

const CELLS: usize = 6;

/// The most robots.
const ROBOTS: usize = 3;

/// The situations that must occur.
pub(super) const COVERS: [&str; 4] =
    ["a pair of its own", "all cells are the others'", "its own pair is too far", "no cell"];

/// The bound of [`goes`], in words.
pub(super) fn teams() -> String {
    format!(
        "every map of {} cells, all cells and claims of at most {}",
        SIZES.map(|(columns, rows)| format!("{columns}×{rows}")).join(" and "),
        counted(ROBOTS as u64, "robot")
    )
}

/// A robot as another one knows it: its cell, and the cell that it has claimed.
type Sighting = (Cell, Option<Cell>);

/// FRONTIER-9: the first of some robots decides.
///
/// # Errors
/// [`Stop`] if the clause is broken.
pub(super) fn goes(rule: &Rule, oracle: &mut dyn Oracle) -> Outcome {
    let (columns, rows) = one_of(oracle, &SIZES);
    let area = Area::new(Cell::new(0, 0), Cell::new(columns - 1, rows - 1)).ok_or(Stop::Assumed)?;
    let cells: Vec<Cell> = area.cells().collect();
    let robots = 1 + oracle.pick(ROBOTS as u32);
    let places: Vec<Cell> = (0..robots).map(|_| cells[oracle.pick(CELLS as u32) as usize]).collect();
    let mut map = TinyMap::new(area).ok_or(Stop::Assumed)?;
    for &cell in &cells {
        if places.contains(&cell) {
            map.learn(cell, Status::Explored);
            continue;
        }
        match oracle.pick(3) {
            0 => {}
            1 => map.learn(cell, Status::Explored),
            _ => map.learn(cell, Status::Obstacle),
        }
    }
    let left: Vec<Cell> =
        cells.iter().copied().filter(|&cell| map.status(cell) == Status::Unexplored).collect();
    let team: Vec<Sighting> = places
        .into_iter()
        .map(|cell| (cell, left.get(oracle.pick(left.len() as u32 + 1) as usize).copied()))
        .collect();
    let (at, claimed) = team[0];
    let is_known = |cell: &Cell| *cell != at && map.status(*cell) != Status::Unexplored;
    let has_news = (claimed.is_none() || cells.iter().any(is_known)) && oracle.pick(2) == 1;
    let (paired, nearest) = expected(&map, &team);
    let most = claimed.or(nearest).filter(|_| !has_news).and_then(|kept| ways(&map, at, kept));
    let is_too_far = |cell: &Cell| most.is_some_and(|most| ways(&map, at, *cell) > Some(most));
    let (expected, situation) = match paired {
        Some(cell) if is_too_far(&cell) => (nearest, "its own pair is too far"),
        Some(_) => (paired, "a pair of its own"),
        None => (nearest, "all cells are the others'"),
    };
    match (next(rule, map, &team, has_news), expected) {
        (Next::Done, None) => Ok("no cell"),
        (Next::Tries { side, aim }, Some(cell)) => {
            require(aim == cell, "a robot goes to the cell of its own pair, or to the one that comes first")?;
            let is_nearer = ways(&map, at.beyond(side), cell) < ways(&map, at, cell);
            require(is_nearer, "its first move is one of a shortest way")?;
            Ok(situation)
        }
        _ => Err(Stop::Violated("a robot goes as long as it reaches an unexplored cell, and no longer")),
    }
}

/// The next action of the first of the robots, which may have learned what it knows after it has looked last.
fn next(rule: &Rule, map: TinyMap, team: &[Sighting], has_news: bool) -> Next {
    let (at, aim) = team[0];
    let known = if has_news { TinyMap::new(map.area()).unwrap_or(map) } else { map };
    let mut own = Robot::new(known, at, &[]);
    // A robot keeps what it has claimed when it goes round a small obstacle. It has claimed nothing any more when it
    // has met another robot, and nothing yet at its start.
    if aim.is_some() || !has_news {
        own.tries(Side::East, aim.unwrap_or(at));
        own.looked(rule, if aim.is_some() { Sight::Small } else { Sight::Robot });
    }
    own.hears_all(&map);
    let other = |&(cell, aim): &Sighting| Other { cell, place: Place::midpoint(cell), aim };
    let others: Vec<Other> = team.iter().skip(1).map(other).collect();
    super::next::<ROBOTS>(&own, rule, View { others: &others, slot: Slot::Own }, &mut Tape(&[]))
}

/// The cell that the first of the robots is paired with, and the one that comes first for it alone.
fn expected(map: &TinyMap, team: &[Sighting]) -> (Option<Cell>, Option<Cell>) {
    let mut pairs = Vec::new();
    for (robot, &(at, aim)) in team.iter().enumerate() {
        // Robots in one cell count as one, of which the first has a say.
        if team[..robot].iter().any(|&(cell, _)| cell == at) {
            continue;
        }
        for cell in map.area().cells().filter(|&cell| map.status(cell) == Status::Unexplored) {
            let Some(distance) = ways(map, at, cell) else { continue };
            let beside = Side::ALL.map(|side| map.status(cell.beyond(side)));
            let unexplored = beside.into_iter().filter(|&status| status == Status::Unexplored).count();
            let last = map.area().last();
            let to_rim = cell.x.min(cell.y).min(last.x - cell.x).min(last.y - cell.y);
            let order = (distance, aim != Some(cell), unexplored, to_rim, (at.y, at.x), (cell.y, cell.x));
            pairs.push((order, robot, cell));
        }
    }
    pairs.sort_unstable();
    let nearest = pairs.iter().find(|&&(_, robot, _)| robot == 0).map(|&(.., cell)| cell);
    let mut taken: Vec<(usize, Cell)> = Vec::new();
    for (_, robot, cell) in pairs {
        if taken.iter().all(|&(other, known)| other != robot && known != cell) {
            taken.push((robot, cell));
        }
    }
    (taken.into_iter().find(|&(robot, _)| robot == 0).map(|(_, cell)| cell), nearest)
}

/// The fewest moves from a cell through explored ones to another cell; `None` if there is no way.
fn ways(map: &TinyMap, from: Cell, to: Cell) -> Option<u32> {
    let mut left = VecDeque::from([(from, 0)]);
    let mut known = vec![from];
    while let Some((cell, far)) = left.pop_front() {
        if cell == to {
            return Some(far);
        }
        if map.status(cell) != Status::Explored {
            continue;
        }
        for beyond in Side::ALL.map(|side| cell.beyond(side)) {
            if map.area().contains(beyond) && !known.contains(&beyond) {
                known.push(beyond);
                left.push_back((beyond, far + 1));
            }
        }
    }
    None
}

//! Frontier cells (Rajesh, Nagaraja and Suja 2024): the clauses FRONTIER-1 to FRONTIER-13 and what decides them.

pub mod areas;
pub mod clauses;
mod detour;
pub mod drift;
mod fusion;
pub mod local;
mod pairs;
mod place;
mod readings;
pub mod world;

use tautline_kernel::choice::Oracle;
use tautline_kernel::frontier::{Map, Next, Robot, Rule, Scratch, Search, SearchCell, Status, TinyMap, View};
use tautline_kernel::ground::{Cell, Side};

/// Whether a robot in `cell` must think that it could go to an unexplored cell: one is beside the cells to which ways
/// through explored ones lead, as far as `map` has it (FRONTIER-4).
pub fn has_more(map: &impl Map, cell: Cell) -> bool {
    let area = map.area();
    let mut reached = vec![false; area.width() * area.height()];
    let mut rim = vec![cell];
    while let Some(cell) = rim.pop() {
        for next in Side::ALL.map(|side| cell.beyond(side)) {
            match (map.status(next), area.locate(next)) {
                (Status::Unexplored, _) => return true,
                (Status::Explored, Some((column, row))) if !reached[row * area.width() + column] => {
                    reached[row * area.width() + column] = true;
                    rim.push(next);
                }
                (Status::Explored | Status::Obstacle | Status::Body, _) => {}
            }
        }
    }
    false
}

/// The next action of `robot`, one of at most `ROBOTS`, whose search begins with empty memory.
fn next<const ROBOTS: usize>(
    robot: &Robot<TinyMap>,
    rule: &Rule,
    view: View<'_>,
    oracle: &mut dyn Oracle,
) -> Next {
    let (mut reached, mut queue) = ([SearchCell::NEVER; TinyMap::CELLS], [Cell::new(0, 0); TinyMap::CELLS]);
    let (mut rounds, mut pairs) = (0, [[None; ROBOTS]; ROBOTS]);
    let search = Search { reached: &mut reached, queue: &mut queue, rounds: &mut rounds };
    robot.next(rule, view, &mut Scratch { search, pairs: pairs.as_flattened_mut() }, oracle)
}

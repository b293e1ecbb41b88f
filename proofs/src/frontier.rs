//! Frontier cells (Rajesh, Nagaraja and Suja 2024): the clauses FRONTIER-1 to FRONTIER-12 and what decides them.

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
use tautline_kernel::frontier::{Next, Robot, Rule, Scratch, Search, SearchCell, TinyMap, View};
use tautline_kernel::ground::Cell;

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

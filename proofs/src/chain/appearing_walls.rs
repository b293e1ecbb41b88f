//! Walls that appear where a robot has crossed (CHAIN-22). Each unknown side is decided by the oracle when a robot
//! first tries it, and each open one again whenever a robot is to cross it.

use std::collections::BTreeMap;

use tautline_kernel::chain::{Chain, Intent, Walls};
use tautline_kernel::choice::{Oracle, one_of};
use tautline_kernel::ground::{Cell, Edge, SmallGrid, Step};

use super::breach::Breach;
use super::environment::in_covered;
use super::subject::Subject;
use super::whole_runs::{MANY, NO_MESSAGE, is_one_of, key, start};
use crate::engine::{Outcome, Stop, require};
use crate::plural::listed;

/// Robots, most walls, and most walls that appear, of [`in_few_walls`].
const FEW_WALLS: [(usize, u32, u32); 3] = [(3, 2, 2), (4, 1, 1), (5, 0, 2)];

/// Robots, walls in percent, and how many tries of an open side meet no new wall on average, of [`at_random`].
const RANDOM: (usize, [u32; 5], [u32; 3]) = (8, [1, 5, 10, 15, 20], [30, 100, 300]);

/// The bound of [`in_few_walls`], in words.
pub(super) fn few_walls() -> String {
    let robots = listed(FEW_WALLS.map(|(robots, ..)| robots));
    let (walls, appear) =
        (listed(FEW_WALLS.map(|(_, walls, _)| walls)), listed(FEW_WALLS.map(|(.., appear)| appear)));
    format!("all layouts, N = {robots}, at most {walls} walls, and {appear} that appear")
}

/// The layouts that [`at_random`] draws, in words.
pub(super) fn random_layouts() -> String {
    let (robots, walls, tries) = RANDOM;
    let (walls, tries) = (listed(walls), listed(tries));
    format!(
        "random layouts, N = {robots}, walls of {walls} %, a new one in every {tries} tries of an open side"
    )
}

/// A chain among walls that appear, and what it takes them for.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) struct WallsCase {
    pub(super) observed: Subject,
    pub(super) walls: Walls,
    /// The walls that it reckons with while it plans.
    pub(super) plans_among: Walls,
}

/// CHAIN-22 over all layouts with few walls.
///
/// # Errors
/// [`Stop`] if it is no case, or breaks the clause.
pub(super) fn in_few_walls(shut: &WallsCase, oracle: &mut dyn Oracle) -> Outcome {
    let (robots, mut walls, mut appear) = one_of(oracle, &FEW_WALLS);
    runs(shut, robots, &mut |known| match known {
        SideKnowledge::No => is_one_of(&mut walls, oracle),
        SideKnowledge::Open => is_one_of(&mut appear, oracle),
    })
}

/// CHAIN-22 in a random layout.
///
/// # Errors
/// As of [`in_few_walls`].
pub(super) fn at_random(shut: &WallsCase, oracle: &mut dyn Oracle) -> Outcome {
    let (robots, walls, tries) = RANDOM;
    let (percent, tries) = (one_of(oracle, &walls), one_of(oracle, &tries));
    runs(shut, robots, &mut |known| match known {
        SideKnowledge::No => oracle.pick(100) < percent,
        SideKnowledge::Open => oracle.pick(tries) == 0,
    })
}

/// The team's knowledge of a side.
enum SideKnowledge {
    No,
    Open,
}

/// Whether a step from this cell crosses a side that is known to be a wall.
fn meets_wall(walls: &BTreeMap<(i16, i16, u8), bool>, cell: Cell, step: Step) -> bool {
    matches!(step, Step::Cross(side) if walls.get(&key(Edge::new(cell, side))) == Some(&true))
}

fn runs(shut: &WallsCase, robots: usize, is_wall: &mut dyn FnMut(SideKnowledge) -> bool) -> Outcome {
    let mut chain: Chain<SmallGrid, 8> = start(&shut.observed, robots, SmallGrid::new)?.among(shut.walls);
    let (mut log, mut walls) = (Vec::new(), BTreeMap::new());
    let mut situation = "no wall appears";
    for _ in 0..MANY {
        let mut planning = chain.among(shut.plans_among);
        let intent = planning.plan(&log).map_err(|_| NO_MESSAGE)?;
        chain = planning.among(shut.walls);
        let Intent::Go(plan) = intent else { return Ok(situation) };
        require(!chain.is_refused(), "no plan is refused")?;
        let before = chain.cells().to_vec();
        require(
            !before.iter().zip(plan.steps()).any(|(&cell, &step)| meets_wall(&walls, cell, step)),
            "no robot is sent through a wall that the team has met",
        )?;
        for (&cell, &step) in before.iter().zip(plan.steps()) {
            if let Step::Cross(side) = step {
                let key = key(Edge::new(cell, side));
                let is_new = match walls.get(&key) {
                    None => is_wall(SideKnowledge::No),
                    Some(false) => is_wall(SideKnowledge::Open),
                    Some(true) => true,
                };
                if is_new && walls.insert(key, true) == Some(false) {
                    situation = "a wall appears";
                }
                walls.entry(key).or_insert(false);
            }
        }
        let mut heard = chain;
        let settled = chain.settle(&plan, |edge| walls.get(&key(edge)) == Some(&false));
        heard
            .hear(&plan, settled.messages())
            .map_err(|_| Stop::Violated("who hears a team move believes it"))?;
        require(heard == chain, "who hears a team move knows what the team knows")?;
        log.extend_from_slice(settled.messages());
        let is_through = before
            .iter()
            .zip(plan.steps())
            .zip(chain.cells())
            .any(|((&from, &step), &to)| meets_wall(&walls, from, step) && from != to);
        require(!is_through, "no robot is taken to be through a wall")?;
        let is_in_contact = chain.cells().windows(2).all(|pair| in_covered(pair[0], pair[1]));
        require(is_in_contact, "neighbours are in contact when walls have appeared")?;
        require(!Breach::Crowding.is_in(&before, chain.cells()), "no three robots are in one cell")?;
    }
    Err(Stop::Violated("every run ends"))
}

//! Unfolding the chain towards an unexplored cell that a run would else miss (ours: the paper promises that every
//! reachable cell is explored, and leaves some out). From the base, where all robots are, the leader walks to that
//! cell by as few links as there are; the others stop one link apart behind it. Clause CHAIN-13, and CHAIN-7.

use crate::ground::{Cell, Grid, Link, Step, link};

/// Whether a follower goes on along the walk: it is `own` cells along it and stops after `last`, while the robot
/// ahead is planned to be `ahead` cells along it. It follows one cell behind, up to where it stops.
#[inline]
pub const fn goes_on(own: usize, last: usize, ahead: usize) -> bool {
    own < last && own + 2 <= ahead
}

/// The steps of the robots in `team`, base first, that unfold the chain further; `None` if no unexplored cell is
/// within reach, or some robot is not on the walk to the nearest.
pub(super) fn unfold<G: Grid, const ROBOTS: usize>(grid: &mut G, team: &[Cell]) -> Option<[Step; ROBOTS]> {
    let (base, leader) = (*team.first()?, team.len() - 1);
    let mut stops = [base; ROBOTS];
    let links = grid.stops(base, &mut stops[..=leader])?;
    // The cells of the walk one after the other, and for each stop its place among them.
    let mut cells = [[base; 2]; ROBOTS];
    let walk = cells.as_flattened_mut();
    let mut places = [0; ROBOTS];
    for stop in 1..=links {
        let mut place = places[stop - 1] + 1;
        if let Link::Corner(corner) = link(grid, stops[stop - 1], stops[stop])? {
            walk[place] = corner;
            place += 1;
        }
        walk[place] = stops[stop];
        places[stop] = place;
    }
    let mut steps = [Step::Stay; ROBOTS];
    // Where the robot ahead is, and is planned to be.
    let (mut at, mut planned) = (places[links], usize::MAX);
    for (robot, last) in (0..=leader).rev().zip(places[1..=links].iter().rev()) {
        // Those ahead are never behind.
        at = walk[..=at].iter().rposition(|&cell| cell == team[robot])?;
        let goes_on = goes_on(at, *last, planned);
        planned = at + usize::from(goes_on);
        steps[robot] = Step::ALL.into_iter().find(|&step| team[robot].after(step) == walk[planned])?;
    }
    Some(steps)
}

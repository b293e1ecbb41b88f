//! Unfolding the chain towards an unexplored cell that a run would else miss (ours: the paper promises that every
//! reachable cell is explored, and leaves some out). From the base, where all robots are, the leader walks to that
//! cell by as few links as there are; the others stop one link apart behind it. Clause CHAIN-13, and CHAIN-7.

use super::walk::{Lookup, Walk};
use crate::ground::{Cell, Grid, Step};

/// The steps of the robots in `team`, base first, that unfold the chain further; `None` if no unexplored cell is
/// within reach, or some robot is not on the walk to the nearest.
pub(super) fn unfold<G: Grid, const ROBOTS: usize>(grid: &mut G, team: &[Cell]) -> Option<[Step; ROBOTS]> {
    let (base, leader) = (*team.first()?, *team.last()?);
    let mut stops = [base; ROBOTS];
    let links = grid.stops(base, &mut stops[..team.len()])?;
    Walk::between(grid, &stops[..=links], leader)?.let_out(team, Lookup::LastFirst)
}

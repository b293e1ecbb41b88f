//! Links: two cells are one link apart if they share a side that is no wall, or touch at a corner and one of the two
//! ways round it is free of walls. Neighbours in a chain can stand one link apart, so a chain of N reaches the cells
//! at most N−1 links from its base. Clause CHAIN-13.

use super::{Cell, Edge, EdgeMark, Grid, Side};

/// How two cells are linked.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Link {
    /// By a side that is no known wall.
    Side,
    /// Round a corner, over this cell.
    Corner(Cell),
}

/// The pairs of sides that have a corner between them: south-east, south-west, north-west, north-east.
const CORNERS: [(Side, Side); 4] = [
    (Side::East, Side::South),
    (Side::South, Side::West),
    (Side::West, Side::North),
    (Side::East, Side::North),
];

/// The cells linked to `cell`: those beyond its sides first, in direction order, then those beyond its corners, in the
/// order south-east, south-west, north-west, north-east. Of the two ways round a corner the first that is free.
pub fn links(grid: &impl Grid, cell: Cell) -> impl Iterator<Item = (Cell, Link)> {
    let is_open = |cell, side| !grid.edge_has(EdgeMark::Wall, Edge::new(cell, side));
    let beside = Side::ALL
        .into_iter()
        .filter(move |&side| is_open(cell, side))
        .map(move |side| (cell.beyond(side), Link::Side));
    let round = CORNERS.into_iter().filter_map(move |(one, other)| {
        [(one, other), (other, one)]
            .into_iter()
            .find(|&(first, then)| is_open(cell, first) && is_open(cell.beyond(first), then))
            .map(|(first, then)| (cell.beyond(first).beyond(then), Link::Corner(cell.beyond(first))))
    });
    beside.chain(round)
}

/// How `from` is linked to `to`, if it is.
pub fn link(grid: &impl Grid, from: Cell, to: Cell) -> Option<Link> {
    links(grid, from).find(|&(cell, _)| cell == to).map(|(_, link)| link)
}

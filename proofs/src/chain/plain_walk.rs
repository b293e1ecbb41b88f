//! The walk along which a chain unfolds, in plain words: growing layers of linked cells, and the way back from the
//! nearest unexplored one.

use rustc_hash::FxHashSet;
use tautline_kernel::ground::{Area, Cell, Edge, Side};

/// A map: its area, whether an edge is not known to be a wall, and whether a cell is explored.
pub(super) type Map<'a> = (Area, &'a dyn Fn(Edge) -> bool, &'a dyn Fn(Cell) -> bool);

/// A list of cells, and the places of stops among them.
pub(super) type Walk = (Vec<Cell>, Vec<usize>);

/// The walk of fewest links, at most `most`, from `base` to an unexplored cell of the map. Of equally near cells the
/// first in row order; going back from it, stops beyond a side before those beyond a corner, in direction order.
pub(super) fn walk((area, is_open, is_explored): Map<'_>, base: Cell, most: usize) -> Option<Walk> {
    // East, south, west, north, and the corners between them, from east over south round to east again.
    let around = [(1, 0), (0, 1), (-1, 0), (0, -1), (1, 1), (-1, 1), (-1, -1), (1, -1)];
    let way = |from, offset: (i16, i16)| way(is_open, from, offset);
    let mut layers = vec![vec![base]];
    let mut met = FxHashSet::from_iter([base]);
    let target = loop {
        let nearest = layers.last()?;
        if let Some(&target) = nearest.iter().find(|&&cell| !is_explored(cell)) {
            break target;
        }
        if layers.len() > most || nearest.is_empty() {
            return None;
        }
        let mut next = Vec::new();
        for &from in nearest {
            for (dx, dy) in around {
                let cell = Cell::new(from.x - dx, from.y - dy);
                if area.contains(cell) && !met.contains(&cell) && way(cell, (dx, dy)).is_some() {
                    met.insert(cell);
                    next.push(cell);
                }
            }
        }
        next.sort_by_key(|cell| (cell.y, cell.x));
        layers.push(next);
    };
    let mut stops = vec![target];
    for nearer in layers.iter().rev().skip(1) {
        let stop = stops[stops.len() - 1];
        let linked = around.iter().filter(|&&offset| way(stop, offset).is_some());
        let back =
            linked.map(|&(dx, dy)| Cell::new(stop.x + dx, stop.y + dy)).find(|cell| nearer.contains(cell));
        stops.push(back?);
    }
    stops.reverse();
    let (mut cells, mut places) = (vec![base], vec![0]);
    for pair in stops.windows(2) {
        cells.extend(way(pair[0], (pair[1].x - pair[0].x, pair[1].y - pair[0].y))?);
        places.push(cells.len() - 1);
    }
    Some((cells, places))
}

/// The cells from one to another that is this far away, over one side or two in the order of directions, the first left
/// out; none, if no way is open.
pub(super) fn way(is_open: &dyn Fn(Edge) -> bool, from: Cell, (dx, dy): (i16, i16)) -> Option<Vec<Cell>> {
    let horizontal = if dx > 0 { Side::East } else { Side::West };
    let vertical = if dy > 0 { Side::South } else { Side::North };
    let sides =
        [vec![horizontal; dx.unsigned_abs().into()], vec![vertical; dy.unsigned_abs().into()]].concat();
    let mut ways = [sides.clone(), sides.into_iter().rev().collect()];
    ways.sort();
    ways.into_iter().filter(|sides| sides.len() <= 2).find_map(|sides| {
        let mut cell = from;
        let mut cells = Vec::new();
        for side in sides {
            if !is_open(Edge::new(cell, side)) {
                return None;
            }
            cell = cell.beyond(side);
            cells.push(cell);
        }
        Some(cells)
    })
}

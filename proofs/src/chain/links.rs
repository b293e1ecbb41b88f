//! Which cells are within reach of a chain, in the words of `SPEC.md` alone: the cells at most N−1 links from the
//! base. Two cells are one link apart if they share a side without a wall, or meet at a corner and one of the two
//! ways round it has no wall. The chain can be brought there by team moves that every rule admits; the argument is that
//! of CHAIN-13.

use tautline_kernel::ground::{Area, Cell, CellMark, Edge, EdgeMark, Grid, Side};

/// The cells of `area` within reach of a chain of `robots`, nearest first, where `is_open` tells the edges without a
/// wall.
pub fn within_reach(area: Area, base: Cell, robots: usize, is_open: impl Fn(Edge) -> bool) -> Vec<Cell> {
    reach_by_robots(area, base, robots, is_open).0
}

/// The cells of `area` within reach of a chain of `most` robots, nearest first, and how many of them are within that of
/// a chain of one robot, of two, and so on, up to `most` or to the first chain for which one more robot reaches no
/// other cell.
pub fn reach_by_robots(
    area: Area,
    base: Cell,
    most: usize,
    is_open: impl Fn(Edge) -> bool,
) -> (Vec<Cell>, Vec<usize>) {
    let mut is_reached = vec![false; area.width() * area.height()];
    let mut reached = Vec::new();
    let mut reach = |cell: Cell, reached: &mut Vec<Cell>| {
        if let Some((column, row)) = area.locate(cell) {
            let seen = &mut is_reached[row * area.width() + column];
            if !*seen {
                *seen = true;
                reached.push(cell);
            }
        }
    };
    reach(base, &mut reached);
    let (mut first, mut counts) = (0, Vec::new());
    while first < reached.len() {
        let last = reached.len();
        counts.push(last);
        if counts.len() >= most {
            break;
        }
        for place in first..last {
            let cell = reached[place];
            for side in Side::ALL.into_iter().filter(|&side| is_open(Edge::new(cell, side))) {
                let next = cell.beyond(side);
                reach(next, &mut reached);
                for turn in Side::ALL.into_iter().filter(|&turn| turn != side && turn != side.opposite()) {
                    if is_open(Edge::new(next, turn)) {
                        reach(next.beyond(turn), &mut reached);
                    }
                }
            }
        }
        first = last;
    }
    (reached, counts)
}

/// Whether all is explored that is within reach of such a chain by the walls that are known.
pub(super) fn has_explored(grid: &impl Grid, base: Cell, robots: usize) -> bool {
    let is_open = |edge| !grid.edge_has(EdgeMark::Wall, edge);
    within_reach(grid.area(), base, robots, is_open)
        .into_iter()
        .all(|cell| grid.has(CellMark::Explored, cell))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn area() -> Area {
        Area::new(Cell::new(0, 0), Cell::new(4, 4)).expect("five by five cells")
    }

    fn is_within_reach(cell: Cell, walls: &[(Cell, Side)]) -> bool {
        let is_open = |edge: Edge| {
            area().contains(edge.cell().beyond(edge.side()))
                && area().contains(edge.cell())
                && !walls.iter().any(|&(cell, side)| Edge::new(cell, side) == edge)
        };
        within_reach(area(), Cell::new(2, 2), 3, is_open).contains(&cell)
    }

    #[test]
    fn an_open_area_is_within_reach() {
        assert!(area().cells().all(|cell| is_within_reach(cell, &[])));
    }

    #[test]
    fn a_corner_needs_one_way_round_each_corner_on_the_way() {
        let corner = Cell::new(4, 4);
        let inner = [(Cell::new(2, 3), Side::East), (Cell::new(3, 2), Side::South)];
        assert!(is_within_reach(corner, &inner[..1]) && is_within_reach(corner, &inner[1..]));
        assert!(!is_within_reach(corner, &inner));
        let outer = [(Cell::new(3, 4), Side::East), (Cell::new(4, 3), Side::South)];
        assert!(is_within_reach(corner, &outer[..1]));
        assert!(!is_within_reach(corner, &outer));
    }

    #[test]
    fn a_link_goes_round_a_wall_no_farther_than_a_corner() {
        let wall =
            [(Cell::new(2, 2), Side::East), (Cell::new(3, 1), Side::South), (Cell::new(3, 2), Side::South)];
        assert!(is_within_reach(Cell::new(3, 1), &wall));
        assert!(!is_within_reach(Cell::new(3, 2), &wall));
    }
}

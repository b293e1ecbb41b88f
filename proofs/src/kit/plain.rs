//! Which uncovered sides a team could come to, in plain arithmetic: it shares nothing with the rule but cells. Robots
//! stand in contact and drive one at a time over driven paths, until one of them could drive a path that is new. A side
//! counts as open unless it is known to be blocked.

use rustc_hash::FxHashSet;
use tautline_kernel::ground::{Cell, Edge, EdgeMark, Grid, Side, TinyGrid};
use tautline_kernel::kit::Reach;

/// The robots' findings on a lattice.
#[derive(Clone, Copy)]
pub(super) struct Findings<'a, const ROBOTS: usize> {
    /// Paths that were driven ([`EdgeMark::Open`]) and walls that were met.
    pub(super) map: &'a TinyGrid,
    /// Where a robot is besides the node that is told, if it is on a path.
    pub(super) left: [Option<Cell>; ROBOTS],
    /// How far robots hear each other.
    pub(super) reach: Reach,
}

/// Whether robots at these nodes, 3 m apart, are at most 10 m apart, or at most as many paths as they hear.
pub(super) fn hear(reach: Reach, one: Cell, other: Cell) -> bool {
    let metres = |nodes: u16| 3 * u32::from(nodes);
    let (dx, dy) = one.apart(other);
    let most = if reach == Reach::PAPER { 100 } else { 9 * u32::from(reach.squared()) };
    metres(dx).pow(2) + metres(dy).pow(2) <= most
}

impl<const ROBOTS: usize> Findings<'_, ROBOTS> {
    fn is_driven(&self, node: Cell, side: Side) -> bool {
        self.map.edge_has(EdgeMark::Open, Edge::new(node, side))
    }

    /// Whether a robot could drive there once more, or for the first time: no wall, nobody in the way, and all
    /// connected.
    pub(super) fn admits(&self, cells: &[Cell; ROBOTS], robot: usize, side: Side) -> bool {
        let (from, to) = (cells[robot], cells[robot].beyond(side));
        if self.map.edge_has(EdgeMark::Wall, Edge::new(from, side))
            || cells.contains(&to)
            || self.left.contains(&Some(to))
        {
            return false;
        }
        let are_linked = |one: usize, other: usize| {
            let ends = |which: usize| {
                if which == robot {
                    [from, to]
                } else {
                    [cells[which], self.left[which].unwrap_or(cells[which])]
                }
            };
            ends(one).iter().all(|&one| ends(other).iter().all(|&other| hear(self.reach, one, other)))
        };
        // Those that the first one reaches, a bit for each: after as many rounds as there are others, all of them.
        let reached = (1..ROBOTS).fold(1_u32, |reached, _| {
            let has = |one: usize| reached >> one & 1 == 1;
            let is_near = |other: &usize| (0..ROBOTS).any(|one| has(one) && are_linked(one, *other));
            (0..ROBOTS).filter(is_near).fold(reached, |all, other| all | 1 << other)
        });
        reached.count_ones() as usize == ROBOTS
    }

    /// The fewest drives of `movers`, a bit for each, from `cells` until one of them could drive a new path; `None` if
    /// they never can.
    pub(super) fn distance(&self, cells: [Cell; ROBOTS], movers: u8) -> Option<u32> {
        let mut known = FxHashSet::from_iter([cells]);
        let mut now = vec![cells];
        for length in 0.. {
            let mut next = Vec::new();
            for cells in &now {
                for robot in (0..ROBOTS).filter(|robot| movers >> robot & 1 == 1) {
                    for side in Side::ALL.into_iter().filter(|&side| self.admits(cells, robot, side)) {
                        if !self.is_driven(cells[robot], side) {
                            return Some(length);
                        }
                        let mut after = *cells;
                        after[robot] = cells[robot].beyond(side);
                        if known.insert(after) {
                            next.push(after);
                        }
                    }
                }
            }
            if next.is_empty() {
                return None;
            }
            now = next;
        }
        None
    }

    /// Whether a side is neither driven nor known to be blocked that driven paths join to where the robots are. Where
    /// they fill all nodes that they have come to, none can leave.
    pub(super) fn is_left_over(&self, cells: [Cell; ROBOTS]) -> bool {
        let mut reached = cells.to_vec();
        let mut unknown = Vec::new();
        let mut place = 0;
        while let Some(&node) = reached.get(place) {
            for side in Side::ALL {
                let beyond = node.beyond(side);
                if self.is_driven(node, side) {
                    if !reached.contains(&beyond) {
                        reached.push(beyond);
                    }
                } else if !self.map.edge_has(EdgeMark::Wall, Edge::new(node, side)) {
                    unknown.push(beyond);
                }
            }
            place += 1;
        }
        let is_full = reached.len() == ROBOTS && unknown.iter().all(|node| reached.contains(node));
        !unknown.is_empty() && !is_full
    }
}

#[cfg(test)]
mod tests {
    use tautline_kernel::ground::Area;

    use super::*;

    #[test]
    fn two_robots_in_a_row_reach_what_is_ahead_of_either() {
        let area = Area::new(Cell::new(0, 0), Cell::new(5, 0)).expect("an area");
        let mut map = TinyGrid::new(area).expect("a map");
        let found = |map: &TinyGrid, cells: [i16; 2]| {
            Findings { map, left: [None; 2], reach: Reach::PAPER }
                .distance(cells.map(|x| Cell::new(x, 0)), 0b11)
        };
        assert_eq!(found(&map, [0, 1]), Some(0));
        for x in 0..4 {
            map.put_edge(EdgeMark::Open, Edge::new(Cell::new(x, 0), Side::East));
        }
        assert_eq!(found(&map, [0, 1]), Some(5), "three drives ahead, and two of the robot behind");
        map.put_edge(EdgeMark::Wall, Edge::new(Cell::new(4, 0), Side::East));
        assert_eq!(found(&map, [0, 1]), None);
    }
}

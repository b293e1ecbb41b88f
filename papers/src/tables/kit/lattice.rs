//! Random lattices of 26 paths, all within reach of each other.

use tautline_kernel::ground::{Cell, Edge};

use super::super::prelude::*;
use tautline_grids::chance::Dice;

/// Paths of every layout.
pub const PATHS: usize = 26;

/// Lattices of one size.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) struct Family {
    /// Its name.
    pub(super) name: &'static str,
    columns: u64,
    rows: u64,
}

/// The families: the paper's map may have been any of them.
pub(super) const FAMILIES: [Family; 4] = [
    Family { name: "5x4", columns: 5, rows: 4 },
    Family { name: "6x3", columns: 6, rows: 3 },
    Family { name: "10x2", columns: 10, rows: 2 },
    Family { name: "9x3, a tree", columns: 9, rows: 3 },
];

impl Family {
    /// How many nodes its lattices have; paths join all.
    pub(super) const fn nodes(self) -> usize {
        (self.columns * self.rows) as usize
    }

    /// The layout of this seed, and the node where the team starts: paths in an order that is drawn, first those that
    /// connect nodes which are not connected yet, then others until there are 26.
    pub(super) fn layout(self, seed: u64) -> Result<(Layout, Cell), Diagnostic> {
        let mut layout = Layout::open(self.columns, self.rows)?;
        let mut dice = Dice::new(seed, *b"lattice ");
        let mut draw = |below: usize| dice.below(below as u64) as usize;
        let mut paths: Vec<Edge> = layout.edges().collect();
        for place in (1..paths.len()).rev() {
            paths.swap(place, draw(place + 1));
        }
        let nodes: Vec<Cell> = layout.cells().collect();
        let place = |node: Cell| nodes.iter().position(|&other| other == node).unwrap_or(0);
        let mut parts: Vec<usize> = (0..nodes.len()).collect();
        let (mut open, mut spare) = (Vec::new(), Vec::new());
        for path in paths {
            let [one, other] = [path.cell(), path.cell().beyond(path.side())].map(|node| parts[place(node)]);
            if one == other {
                spare.push(path);
            } else {
                parts.iter_mut().filter(|part| **part == other).for_each(|part| *part = one);
                open.push(path);
            }
        }
        let more = PATHS.saturating_sub(open.len()).min(spare.len());
        spare.drain(more..).for_each(|path| layout.build_wall(path));
        let start = nodes[draw(nodes.len())];
        Ok((layout, start))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use tautline_sim::kit::paths;

    #[test]
    fn every_lattice_has_26_paths_within_reach() {
        for family in FAMILIES {
            for seed in 0..20 {
                let (layout, start) = family.layout(seed).expect("a layout");
                assert_eq!(paths(&layout, start).len(), PATHS, "{} {seed}", family.name);
            }
        }
    }
}

//! A floor on the heap: its sensors, and walls between cells.

use std::collections::{BTreeMap, HashSet};

use tautline_kernel::floor::Floor;
use tautline_kernel::ground::{Cell, Edge, Side};

use super::term::{edge, list};

/// Sensors, and walls between cells.
#[derive(Clone)]
pub(super) struct Ground<S> {
    pub(super) sensors: BTreeMap<(i16, i16), S>,
    pub(super) walls: HashSet<Edge>,
}

impl<S> Default for Ground<S> {
    fn default() -> Self {
        Self { sensors: BTreeMap::new(), walls: HashSet::new() }
    }
}

impl<S> Ground<S> {
    /// The walls as a list, column by column.
    pub(super) fn walls(&self) -> String {
        let mut walls: Vec<Edge> = self.walls.iter().copied().collect();
        walls.sort_unstable_by_key(|wall| (wall.cell().x, wall.cell().y, wall.side() == Side::East));
        list(walls.into_iter().map(edge))
    }
}

impl<S: Copy> Ground<S> {
    /// The cell and the eight around it alone.
    pub(super) fn near(&self, here: Cell) -> Self {
        let mut near = self.clone();
        near.sensors.retain(|&(x, y), _| (x - here.x).abs() <= 1 && (y - here.y).abs() <= 1);
        near
    }
}

impl<S: Copy> Floor<S> for Ground<S> {
    fn sensor(&self, cell: Cell) -> Option<S> {
        self.sensors.get(&(cell.x, cell.y)).copied()
    }

    fn put(&mut self, cell: Cell, sensor: S) {
        self.sensors.insert((cell.x, cell.y), sensor);
    }

    fn unpack(&mut self, _: Cell) -> u16 {
        1
    }

    fn is_open(&self, edge: Edge) -> bool {
        !self.walls.contains(&edge)
    }
}

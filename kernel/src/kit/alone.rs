//! The way of one robot over known paths to an uncovered side, the others staying where they go.

use super::stance::Stance;
use super::team::Kit;
use super::tether::Formation;
use crate::ground::{Cell, Grid, Step, Steps};

/// No way.
const FAR: u16 = u16::MAX;

/// A shortest way: how many drives it has, and the sides with which it can begin; none if it has no drive.
#[derive(Clone, Copy)]
pub(super) struct Way {
    pub(super) drives: u16,
    pub(super) sides: Steps,
}

impl<G: Grid, const ROBOTS: usize, const NODES: usize> Kit<G, ROBOTS, NODES> {
    /// The way that `robot` has to drive alone before an uncovered side is admitted for it, if it has less than `below`
    /// drives.
    pub(super) fn alone(&self, robot: usize, formation: &Formation<ROBOTS>, below: u16) -> Option<Way> {
        let bonds = self.bonds(robot, formation);
        let lets = |from: Cell, step: Step| {
            self.lets(&bonds, formation, Stance::Drives { from, to: from.after(step) })
        };
        let is_goal = |node: Cell| self.uncovered_by_all(node).iter().any(|step| lets(node, step));
        self.way(formation.stances[robot].to(), lets, is_goal, below)
    }

    /// The shortest way from a node over known paths that may be driven to a goal, if it has less than `below` drives.
    pub(super) fn way(
        &self,
        from: Cell,
        may_drive: impl Fn(Cell, Step) -> bool,
        is_goal: impl Fn(Cell) -> bool,
        below: u16,
    ) -> Option<Way> {
        let mut drives = [FAR; NODES];
        let mut begins = [Steps::NONE; NODES];
        let mut queue = [0_u16; NODES];
        let start = self.place(from)?;
        (drives[start], queue[0]) = (0, start as u16);
        let (mut first, mut last) = (0, 1);
        let mut found: Option<Way> = None;
        while first < last {
            let place = usize::from(queue[first]);
            first += 1;
            let (node, length, sides) = (self.node(place), drives[place], begins[place]);
            if length >= below || found.is_some_and(|way| way.drives < length) {
                break;
            }
            if is_goal(node) {
                let before = found.map_or(Steps::NONE, |way| way.sides);
                found = Some(Way { drives: length, sides: before.or(sides) });
                continue;
            }
            for step in self.paths(node).iter() {
                let Some(beyond) = self.place(node.after(step)) else { continue };
                if drives[beyond] <= length || !may_drive(node, step) {
                    continue;
                }
                if drives[beyond] == FAR {
                    (drives[beyond], queue[last]) = (length + 1, beyond as u16);
                    last += 1;
                }
                let begun = if length == 0 { Steps::only(step) } else { sides };
                begins[beyond] = begins[beyond].or(begun);
            }
        }
        found
    }

    /// The place of a node in rows.
    pub(super) fn place(&self, node: Cell) -> Option<usize> {
        self.union.area().place(node).filter(|&place| place < NODES)
    }

    /// The node in this place.
    pub(super) fn node(&self, place: usize) -> Cell {
        let area = self.union.area();
        let (column, row) = (place % area.width(), place / area.width());
        area.first().at_offset(column as i16, row as i16)
    }
}

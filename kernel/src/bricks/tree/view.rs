//! An agent's view from a cell, trees included.

use core::cmp::Reverse;

use super::note::{Label, Note, State};
use crate::bricks::agent::most_walled;
use crate::choice::Oracle;
use crate::floor::{COMPASS, Floor, Ring, Scan, Sensor};
use crate::ground::{Cell, Side};

/// One scan: what the sensor underfoot stores, and what was seen around. A sensor that was missed reads as an
/// unexplored cell.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct View {
    /// The sensor of the cell.
    pub here: Note,
    /// The marks around.
    pub scan: Scan,
    /// The notes of the side neighbours' sensors that were seen, with no wall in between, by the place of the side in
    /// [`COMPASS`]; unexplored where none was.
    pub beside: [Note; 4],
    /// The cells around that are known to have sensors, seen or not.
    pub known: Ring,
    /// The cells around that read as unexplored, and have not done so often enough to be believed.
    pub doubted: Ring,
}

impl View {
    /// Scans from `cell`, which has a sensor. Whether a sensor is missed is asked of `world`, once for each that an
    /// agent has been at.
    pub fn new(floor: &impl Floor<Note>, cell: Cell, world: &mut (impl Oracle + ?Sized)) -> Self {
        let sensor = |cell| {
            let sensor = |note: Note| Sensor { mark: note.mark(), ..Sensor::default() };
            floor.sensor(cell).map(sensor)
        };
        let scan = Scan::read(sensor, |edge| floor.is_open(edge), cell, world);
        let seen = scan.explored.or(scan.visited).and(scan.beside);
        let mut beside = [Note::default(); 4];
        for (note, side) in beside.iter_mut().zip(COMPASS) {
            if seen.has(side) {
                *note = floor.sensor(cell.beyond(side)).unwrap_or_default();
            }
        }
        let known = scan.explored.or(scan.visited);
        Self { here: floor.sensor(cell).unwrap_or_default(), scan, beside, known, doubted: Ring::default() }
    }

    /// The side neighbours that were seen.
    pub fn neighbours(&self) -> impl Iterator<Item = (Side, Note)> + Clone + use<> {
        COMPASS.into_iter().zip(self.beside).filter(|(_, note)| note.state != State::Unexplored)
    }

    /// The side neighbours that read as unexplored.
    pub fn unexplored(&self) -> Ring {
        self.scan.unexplored.and(self.scan.beside)
    }

    /// The one to go to among those that are believed: that with the most inaccessible sides.
    pub fn way_on(&self) -> Option<Side> {
        let believed = self.known.or(self.doubted).not();
        most_walled(&Scan { open: self.scan.open.and(believed), ..self.scan })
    }

    /// The side neighbours that belong to trees, with their labels.
    pub fn trees(&self) -> impl Iterator<Item = (Side, Label)> + Clone + use<> {
        self.neighbours().filter_map(|(side, note)| Some((side, note.tree()?)))
    }

    /// The children of the cell.
    pub fn children(&self) -> impl Iterator<Item = (Side, Note)> + Clone + use<> {
        self.neighbours().filter(|&(side, note)| note.is_child_beyond(side))
    }

    /// The note of the sensor underfoot, or, if its children show that it has been placed in the stead of their
    /// parent's, the note of that one as far as is seen around. A parent that is not seen is left as it is.
    pub fn restored(&self) -> Note {
        let here = self.here;
        let Some(own) = here.tree() else { return here };
        let is_older = |note: &Note| note.label > own || note.label == own && note.depth <= here.depth;
        let older = self.children().map(|(_, note)| note).filter(is_older);
        let Some(child) = older.max_by_key(|note| (note.label, Reverse(note.depth))) else { return here };
        let depth = child.depth.saturating_sub(1);
        if depth == 0 {
            return here.of_tree(child.label, None).at_depth(0);
        }
        let others = self.neighbours().filter(|&(side, note)| !note.is_child_beyond(side));
        let above = others.filter(|(_, note)| match note.tree() {
            Some(label) => label > child.label || label == child.label && note.depth < depth,
            None => false,
        });
        let is_parent = |note: &Note| note.label == child.label && note.depth + 1 == depth;
        let parent = above.max_by_key(|(_, note)| (is_parent(note), note.label, Reverse(note.depth)));
        parent.map_or(here, |(side, _)| here.of_tree(child.label, Some(side)).at_depth(depth))
    }
}

//! What an agent sees from a cell, trees included.

use super::note::{Label, Note, Notes, State};
use crate::bricks::agent::most_walled;
use crate::choice::Oracle;
use crate::floor::{COMPASS, Ring, Scan, Sensor};
use crate::ground::{Cell, Side};

/// One scan: what the sensor underfoot stores, and what was seen around. A sensor that was missed reads as an unexplored cell.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct View {
    /// The sensor of the cell.
    pub here: Note,
    /// What the marks around look like.
    pub scan: Scan,
    /// What the side neighbours' sensors store that were seen, with no wall in between, by the place of the side in
    /// [`COMPASS`]; unexplored where none was.
    pub beside: [Note; 4],
    /// The cells around that are known to have sensors, seen or not.
    pub known: Ring,
}

impl View {
    /// Scans from `cell`, which has a sensor. Whether a sensor is missed is asked of `world`, once for each that an agent
    /// has been at.
    pub fn new(floor: &impl Notes, cell: Cell, world: &mut (impl Oracle + ?Sized)) -> Self {
        let sensor = |cell| {
            let sensor = |note: Note| Sensor { mark: note.mark(), ..Sensor::default() };
            floor.note(cell).map(sensor)
        };
        let scan = Scan::read(sensor, |edge| floor.is_open(edge), cell, world);
        let seen = scan.explored.or(scan.visited).and(scan.beside);
        let mut beside = [Note::default(); 4];
        for (note, side) in beside.iter_mut().zip(COMPASS) {
            if seen.has(side) {
                *note = floor.note(cell.beyond(side)).unwrap_or_default();
            }
        }
        let known = scan.explored.or(scan.visited);
        Self { here: floor.note(cell).unwrap_or_default(), scan, beside, known }
    }

    /// The side neighbours that were seen.
    pub fn neighbours(&self) -> impl Iterator<Item = (Side, Note)> + Clone + use<> {
        COMPASS.into_iter().zip(self.beside).filter(|(_, note)| note.state != State::Unexplored)
    }

    /// The same where `known` cells around are known to have sensors.
    pub fn knowing(self, known: Ring) -> Self {
        Self { known: self.known.or(known), ..self }
    }

    /// The side neighbours that read as unexplored.
    pub fn unexplored(&self) -> Ring {
        self.scan.unexplored.and(self.scan.beside)
    }

    /// Those of them that are not known to have sensors.
    pub fn unknown(&self) -> Ring {
        self.unexplored().and(self.known.not())
    }

    /// The one among those to go to: that with the most inaccessible sides.
    pub fn way_on(&self) -> Option<Side> {
        most_walled(&Scan { open: self.scan.open.and(self.known.not()), ..self.scan })
    }

    /// The side neighbours that belong to trees, with their labels.
    pub fn trees(&self) -> impl Iterator<Item = (Side, Label)> + Clone + use<> {
        self.neighbours().filter_map(|(side, note)| Some((side, note.tree()?)))
    }

    /// The children of the cell.
    pub fn children(&self) -> impl Iterator<Item = (Side, Note)> + Clone + use<> {
        self.neighbours().filter(|&(side, note)| note.is_child_beyond(side))
    }
}

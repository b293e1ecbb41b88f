//! The sensor-instrumented floor [Ferranti 2009, I]: cells with a fixed sensor in each that is no wall. An agent reads
//! the sensors of its cell and of the eight cells around, writes what it has to remember into them, and goes to a side
//! neighbour. It has no map and no radio to other agents: the floor is all that they share.

mod ring;
mod scan;
mod sensor;

pub use ring::Ring;
pub use scan::Scan;
pub use sensor::{Claim, Mark, Sensor, SensorFate};

use crate::ground::{Cell, Edge, Side};

/// The sides in the order that settles every tie of [Ferranti 2009]: north, east, south, west.
pub const COMPASS: [Side; 4] = [Side::North, Side::East, Side::South, Side::West];

/// The sensors of an area, each of which stores an `S`, and the walls between them.
pub trait Floor<S = Sensor> {
    /// The data of the sensor in `cell`; `None` if the cell is a wall or outside.
    fn sensor(&self, cell: Cell) -> Option<S>;
    /// Changes what the sensor in `cell` stores; no effect where there is none.
    fn put(&mut self, cell: Cell, sensor: S);
    /// The identifier of a sensor that is about to be placed in `cell`: not 0, and another than that of
    /// any of the 65,534 sensors that have been there last. There are no more, so that a lap during
    /// which the sensors of one cell are replaced more often than that may take the last for the first.
    /// Agents that search in trees do not ask for it.
    fn unpack(&mut self, cell: Cell) -> u16;
    /// Whether no wall stands on `edge`, which is between two cells that have sensors.
    fn is_open(&self, edge: Edge) -> bool;
}

/// The sensor that an agent expects in the cell that it enters.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Entry {
    /// The sensor that it has seen there.
    Known,
    /// None: it has seen no sensor, takes the cell for unexplored and places a new one.
    New {
        /// The new sensor's count before the agent enters.
        crossings: u32,
        /// The fate of an old sensor that was only missed.
        replaced: SensorFate,
    },
}

/// Enters `cell`: its sensor counts an agent more. Where the agent is to find none it places a new one; an old one may
/// have been missed only, and the agents that are in the cell register with the new one.
pub fn enter(floor: &mut impl Floor, cell: Cell, entry: Entry) {
    let there = floor.sensor(cell).unwrap_or_default();
    let entered = match entry {
        Entry::Known => there.entered(),
        Entry::New { crossings, replaced } => {
            let placed =
                Sensor { serial: floor.unpack(cell), agents: there.agents, crossings, ..Sensor::default() };
            placed.entered_beside(there, replaced)
        }
    };
    floor.put(cell, entered);
}

/// Puts agents into the cells where they start: the first in a cell places the sensor there.
pub fn settle(floor: &mut impl Floor, starts: &[Cell]) {
    for &start in starts {
        let entry = match floor.sensor(start).unwrap_or_default().mark {
            Mark::Unexplored => Entry::New { crossings: 0, replaced: SensorFate::Lost },
            Mark::Explored | Mark::Closing | Mark::Visited | Mark::Sealed => Entry::Known,
        };
        enter(floor, start, entry);
    }
}

/// Leaves `cell`, whose sensor counts an agent less.
pub fn leave(floor: &mut impl Floor, cell: Cell) {
    if let Some(sensor) = floor.sensor(cell) {
        floor.put(cell, sensor.left());
    }
}

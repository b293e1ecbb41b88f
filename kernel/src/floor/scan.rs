//! An agent's scan of the cells around it [Ferranti 2009, I: localisation and querying].

use super::ring::AROUND;
use super::{COMPASS, Claim, Entry, Floor, Mark, Ring, Sensor, SensorFate};
use crate::choice::Oracle;
use crate::ground::{Cell, Edge, Side, Step};

/// One scan: the sensor underfoot, which is always found, and what was seen around. A sensor that was missed reads as
/// an unexplored cell, as the paper has it; walls are always seen.
#[derive(Clone, Copy, PartialEq, Eq, Default, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Scan {
    /// The sensor of the cell.
    pub here: Sensor,
    /// Cells that read as unexplored.
    pub unexplored: Ring,
    /// Cells whose sensor was seen and says explored, or closing.
    pub explored: Ring,
    /// Those of them that nobody enters.
    pub closing: Ring,
    /// Cells whose sensor was seen and says visited.
    pub visited: Ring,
    /// Side neighbours with neither a wall nor a shut side in between.
    pub open: Ring,
    /// Edges between each cell and the next with neither a wall nor a sensor that says they are shut.
    pub rims: Ring,
    /// Sensors that were seen around.
    pub detected: u8,
    /// Side neighbours with a sensor, whatever it says, and no wall in between.
    pub beside: Ring,
    /// The counts of the side neighbours' sensors, by the place of the side in [`COMPASS`]; 0 where none was seen.
    pub crossings: [u32; 4],
    /// The claims on the side neighbours, likewise.
    pub claims: [Option<Claim>; 4],
    /// The identifiers of the sensors that were seen around, clockwise from the northern one; 0 where none was.
    pub serials: [u16; 8],
}

impl Scan {
    /// Scans from `cell`, which has a sensor. Whether a sensor is missed is asked of `world`, once for each that an
    /// agent has been at.
    pub fn new(floor: &impl Floor, cell: Cell, world: &mut (impl Oracle + ?Sized)) -> Self {
        Self::read(|cell| floor.sensor(cell), |edge| floor.is_open(edge), cell, world)
    }

    /// Scans from `cell`, `sensor` and `is_open` saying what a [`Floor`] would.
    #[inline]
    pub(crate) fn read(
        sensor: impl Fn(Cell) -> Option<Sensor>,
        is_open: impl Fn(Edge) -> bool,
        cell: Cell,
        world: &mut (impl Oracle + ?Sized),
    ) -> Self {
        let mut scan = Self { here: sensor(cell).unwrap_or_default(), ..Self::default() };
        let mut around = [None; 8];
        for (seen, (columns, rows, _)) in around.iter_mut().zip(AROUND) {
            *seen = sensor(cell.at_offset(columns, rows)).map(|sensor| match sensor.mark {
                Mark::Unexplored => Sensor::default(),
                Mark::Explored | Mark::Closing | Mark::Visited | Mark::Sealed if world.mishap() => {
                    Sensor::default()
                }
                Mark::Explored | Mark::Closing | Mark::Visited | Mark::Sealed => sensor,
            });
        }
        for (place, (columns, rows, onward)) in AROUND.into_iter().enumerate() {
            let Some(sensor) = around[place] else { continue };
            let bit = 1 << place;
            match sensor.mark {
                Mark::Unexplored => scan.unexplored.0 |= bit,
                Mark::Explored => scan.explored.0 |= bit,
                Mark::Closing => {
                    scan.explored.0 |= bit;
                    scan.closing.0 |= bit;
                }
                Mark::Visited => scan.visited.0 |= bit,
                Mark::Sealed => {}
            }
            scan.serials[place] = sensor.serial;
            scan.detected += u8::from(sensor.mark != Mark::Unexplored);
            if let Some(next) = around[(place + 1) % around.len()] {
                let is_shut =
                    sensor.shut.has(Step::Cross(onward)) || next.shut.has(Step::Cross(onward.opposite()));
                if !is_shut && is_open(Edge::new(cell.at_offset(columns, rows), onward)) {
                    scan.rims.0 |= bit;
                }
            }
        }
        for (place, side) in COMPASS.into_iter().enumerate() {
            let Some(sensor) = around[2 * place] else { continue };
            if !is_open(Edge::new(cell, side)) {
                continue;
            }
            scan.beside.0 |= Ring::of(side).0;
            scan.crossings[place] = sensor.crossings;
            scan.claims[place] = sensor.claim;
            let is_shut =
                scan.here.shut.has(Step::Cross(side)) && sensor.shut.has(Step::Cross(side.opposite()));
            if !is_shut {
                scan.open.0 |= Ring::of(side).0;
            }
        }
        scan
    }

    /// The scan as it is read by one who goes through visited cells as through explored ones.
    pub const fn with_visited(self) -> Self {
        Self { explored: self.explored.or(self.visited), ..self }
    }

    /// Cells that read as accessible: unexplored or explored.
    pub const fn accessible(&self) -> Ring {
        self.unexplored.or(self.explored)
    }

    /// The side neighbours that read as accessible, with an open side in between.
    pub const fn reachable(&self) -> Ring {
        self.accessible().and(self.open)
    }

    /// The claim on the neighbour beyond `side`, if one was seen.
    pub fn claim(&self, side: Side) -> Option<Claim> {
        self.claims.into_iter().zip(COMPASS).find_map(|(claim, at)| claim.filter(|_| at == side))
    }

    /// The cells around `cell`, from which this is a scan, that read as unexplored and are not, as `mark` says.
    pub fn misread(&self, mark: impl Fn(Cell) -> Mark, cell: Cell) -> impl Iterator<Item = Cell> {
        let unexplored = self.unexplored;
        let reads = (0..).zip(AROUND).filter(move |(place, _)| unexplored.0 >> place & 1 == 1);
        let is_known = move |&cell: &Cell| mark(cell) != Mark::Unexplored;
        reads.map(move |(_, (columns, rows, _))| cell.at_offset(columns, rows)).filter(is_known)
    }

    /// How the neighbour beyond `side`, which has a sensor, is entered; `replaced`
    /// is the fate of a sensor that was missed.
    pub const fn entry(&self, side: Side, replaced: SensorFate) -> Entry {
        if self.unexplored.has(side) { Entry::New { crossings: 0, replaced } } else { Entry::Known }
    }

    /// As [`Self::entry`]; if a sensor is placed, it counts on from this cell's, and one that was missed is lost.
    pub fn entry_counting_on(&self, side: Side) -> Entry {
        match self.entry(side, SensorFate::Lost) {
            Entry::New { replaced, .. } => {
                Entry::New { crossings: self.here.crossings.saturating_sub(1), replaced }
            }
            Entry::Known => Entry::Known,
        }
    }

    /// Whether the square to the left of the way through `side`, which is reachable, is free all round: the neighbours
    /// beyond `side` and to the left of it, the corner between them, and the edges to it.
    pub fn is_filled_left(&self, side: Side) -> bool {
        self.is_filled(Ring::place(side) + 6)
    }

    /// Whether the square to the right of the way through `side` is free all round, as [`Self::is_filled_left`].
    pub fn is_filled_right(&self, side: Side) -> bool {
        self.is_filled(Ring::place(side))
    }

    /// Whether the square clockwise from the side neighbour in `place` is free all round.
    fn is_filled(&self, place: u32) -> bool {
        let at = |bits: u8| bits.rotate_right(place);
        at(self.reachable().0) & 0b101 == 0b101
            && at(self.accessible().0) & 0b10 != 0
            && at(self.rims.0) & 0b11 == 0b11
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// An oracle that misses every sensor, or none.
    struct Misses(bool);

    impl Oracle for Misses {
        fn pick(&mut self, _: u32) -> u32 {
            self.0.into()
        }
    }

    #[test]
    fn a_sensor_is_detected_if_an_agent_has_been_there_and_it_is_not_missed() {
        let marks = [Mark::Unexplored, Mark::Explored, Mark::Closing, Mark::Visited, Mark::Sealed];
        // North of the agent's cell a wall, south of it cells without a sensor of their own yet.
        let sensor = |cell: Cell| match (cell.x, cell.y) {
            (_, -1) => None,
            (_, 1) => Some(Sensor::default()),
            (x, _) => Some(Sensor { mark: marks[x.rem_euclid(5) as usize], ..Sensor::default() }),
        };
        for (x, detected) in [(0, 2), (1, 1), (2, 2), (3, 2), (4, 1)] {
            let scan = |oracle: &mut Misses| Scan::read(sensor, |_| true, Cell::new(x, 0), oracle);
            assert_eq!(scan(&mut Misses(false)).detected, detected, "from column {x}");
            assert_eq!(scan(&mut Misses(true)).detected, 0, "from column {x}");
        }
    }
}

//! The count of a cell whose sensor an ant has missed (ANTS-3): two cells side by side,
//! and an ant that goes from one to the other.

use tautline_kernel::ants::{Rule, carry_out, decide};
use tautline_kernel::choice::Oracle;
use tautline_kernel::floor::{Floor, Mark, Scan, Sensor, SensorFate};
use tautline_kernel::ground::{Cell, Edge};

use crate::engine::{Choices, Outcome, Replay, Stop, require};
use crate::judge::AnyCase;
use crate::judge::floor::{Count, Replacement};

/// The most crossings that a sensor counts here.
const MOST: u32 = 4;

/// The bound of [`keeps`].
pub(super) fn pairs() -> String {
    format!("two cells, up to {MOST} crossings each, the sensor of one missed or not")
}

/// The sensors of two cells, the ant in the western one.
struct Pair([Sensor; 2]);

impl Floor for Pair {
    fn sensor(&self, cell: Cell) -> Option<Sensor> {
        (cell.y == 0).then(|| self.0.get(usize::try_from(cell.x).ok()?).copied())?
    }

    fn put(&mut self, cell: Cell, sensor: Sensor) {
        if let Some(place) = usize::try_from(cell.x).ok().and_then(|place| self.0.get_mut(place)) {
            *place = sensor;
        }
    }

    fn unpack(&mut self, _: Cell) -> u16 {
        1
    }

    fn is_open(&self, _: Edge) -> bool {
        true
    }
}

/// A move of the ant between the cells.
struct Entry {
    is_missed: bool,
    /// The count of the cell that it leaves.
    from: u32,
    /// The counts of the cell that it enters.
    before: u32,
    after: u32,
}

/// The move that these answers make.
fn entered(rule: Rule, oracle: &mut dyn Oracle) -> Result<Entry, Stop> {
    let [from, before] = [(); 2].map(|()| 1 + oracle.pick(MOST));
    let sensor = |crossings| Sensor { mark: Mark::Explored, crossings, ..Sensor::default() };
    let (home, beyond) = (Cell::new(0, 0), Cell::new(1, 0));
    let mut floor = Pair([sensor(from), sensor(before)]);
    let scan = Scan::new(&floor, home, oracle);
    let is_there = carry_out(&mut floor, home, decide(rule, &scan)) == beyond;
    require(is_there, "an ant goes to its only neighbour")?;
    let after = floor.sensor(beyond).map_or(0, |sensor| sensor.crossings);
    Ok(Entry { is_missed: scan.detected == 0, from, before, after })
}

/// ANTS-3: a cell that an ant enters.
///
/// # Errors
/// [`Stop`] if the clause is broken.
pub(super) fn keeps(rule: &Rule, oracle: &mut dyn Oracle) -> Outcome {
    let Entry { is_missed, before, after, .. } = entered(*rule, oracle)?;
    require(after >= before, "a cell counts no fewer agents after a missed sensor was replaced")?;
    Ok(if is_missed { "a missed sensor" } else { "a sensor that is seen" })
}

/// The replaced sensor that these choices of [`keeps`] make, written down for the judge.
pub(super) fn replacement(rule: &Rule, choices: &Choices) -> Option<Box<dyn AnyCase>> {
    let answers: Vec<u32> = choices.all().collect();
    let mut replay = Replay::new(&answers);
    let Entry { is_missed, from, before, after } = entered(*rule, &mut replay).ok()?;
    let count = match rule {
        Rule::Published(SensorFate::Lost) => Count::FromNothing,
        Rule::Published(SensorFate::Beside) => Count::TheHigher,
        Rule::Published(SensorFate::Counted) => Count::OnFromOld,
        Rule::Repaired => Count::OnFromCell,
    };
    let [from, before, after] = [from, before, after].map(|count| count as i32);
    let written = Replacement { clause: "ANTS-3", count, from, before, after };
    (is_missed && replay.matches()).then(|| Box::new(written) as Box<dyn AnyCase>)
}

//! Robots that explore cells, in any order of their steps, with obstacles and lost messages by the bytes.

use tautline_kernel::choice::Oracle;
use tautline_kernel::frontier::{Map, Rule, Status, TinyMap};
use tautline_kernel::ground::{Area, Cell};
use tautline_proofs::engine::world::play;
use tautline_proofs::engine::{Stop, Tape};
use tautline_proofs::frontier::areas::setting;
use tautline_proofs::frontier::world::{Demand, Setting};

use super::parts::numbers;

/// Steps after which a run is left: the bytes may let one robot act alone for ever.
const MOST_STEPS: u32 = 1_000;

/// Repaired teams break nothing, whoever acts next, whichever cells are blocked and whichever messages are lost; and
/// when nobody has anything left to do, everything in reach is explored and everybody knows it.
pub fn frontier(bytes: &[u8]) {
    let numbers = numbers(bytes);
    let mut bytes = Tape(&numbers);
    match bytes.pick(3) {
        0 => follow::<1>(&mut bytes),
        1 => follow::<2>(&mut bytes),
        _ => follow::<3>(&mut bytes),
    }
}

fn follow<const ROBOTS: usize>(bytes: &mut Tape<'_>) {
    let rule = if bytes.flip() { Rule::PLAIN } else { Rule::REPAIRED };
    let size = (8 - bytes.pick(6) as i16, 8 - bytes.pick(8) as i16);
    let setting = setting::<ROBOTS>(rule, size).expect("at most 64 cells");
    let area = Area::new(Cell::new(0, 0), Cell::new(size.0 - 1, size.1 - 1)).expect("an area");
    // Robots start beside each other in the first row; the lower quarter of the numbers is an obstacle.
    let starts: [Cell; ROBOTS] = std::array::from_fn(|robot| Cell::new(robot as i16, 0));
    let mut given = TinyMap::new(area).expect("at most 64 cells");
    for cell in area.cells().filter(|cell| !starts.contains(cell)) {
        if (192..256).contains(&bytes.pick(256)) {
            given.learn(cell, Status::Obstacle);
        }
    }
    let setting = Setting { given: Some(given), max_losses: bytes.pick(4) as u8, ..setting };
    let start = setting.start(starts).expect("at most 64 cells");
    let outcome = play(&setting, start, MOST_STEPS, bytes, Demand::words);
    assert!(!matches!(outcome, Err(Stop::Violated(_))), "{outcome:?} in {given:?}");
}

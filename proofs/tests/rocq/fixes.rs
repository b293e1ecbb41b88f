//! Which cell a fix is taken for in a row of cells, and what it tells a robot that counts its cell.

use tautline_kernel::frontier::{HALF, Place, SIDE, clamped, taken_for};
use tautline_kernel::ground::{Area, Cell};

use super::term::{definition, list};

/// The cells of the row.
const CELLS: i16 = 3;

pub(super) fn terms() -> String {
    let (first, last) = (Cell::new(0, 0), Cell::new(CELLS - 1, 0));
    let area = Area::new(first, last).expect("an area");
    // From a cell before the row to one behind it.
    let fixes = -3 * HALF..=SIDE * i32::from(CELLS) + HALF;
    let along = |axis: fn(i32) -> Place| fixes.clone().map(axis);
    let rows = Area::new(first, Cell::new(0, CELLS - 1)).expect("an area");
    let taken = along(|fix| Place::new(fix, 0)).map(|fix| taken_for(area, fix).x);
    let taken_down = along(|fix| Place::new(0, fix)).map(|fix| taken_for(rows, fix).y);
    assert!(taken.clone().eq(taken_down), "both axes are alike");
    let middle = Cell::new(1, 1);
    let told = along(|fix| Place::new(fix, fix)).map(|fix| clamped(middle, fix));
    let told = told.inspect(|place| assert_eq!(place.x, place.y, "both axes are alike")).map(|place| place.x);
    definition("half", "Z", &HALF.to_string())
        + &definition("last", "Z", &(CELLS - 1).to_string())
        + &definition("taken", "list Z", &format!("{}%Z", list(taken.map(|cell| cell.to_string()))))
        + &definition("told", "list Z", &format!("{}%Z", list(told.map(|place| place.to_string()))))
}

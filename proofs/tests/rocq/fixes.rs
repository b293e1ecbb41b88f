//! Which cell a fix is taken for in a row of cells, what it tells a robot that counts
//! its cell, and what it makes of a belief.

use tautline_kernel::frontier::{HALF, Place, SIDE, clamped, taken_for};
use tautline_kernel::ground::{Area, Cell};
use tautline_kernel::position::{Belief, Gate, Odometry, Point, SymmetricMatrix};

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
        + &definition("fused", "list (Z * Z * Z * Z * Z)", &format!("{}%Z", list(fused())))
}

/// Robots that have driven to the midpoint of the next cell and take a fix of which one part in so many counts: these
/// parts, where they believe to be, the fix, where they believe to be after it, and how far they drive to the next
/// midpoint, in 64ths of a cell's side. All numbers are exact.
fn fused() -> Vec<String> {
    let wheels = Odometry::new(0.125, 0.0).expect("an error");
    let parts = |length: f64| {
        let parts = 64.0 * length;
        assert!(parts.fract() == 0.0, "{length}");
        format!("({})", parts as i64)
    };
    let answer = |counts: i32, off: i32| {
        let mut belief = Belief::known(Point::new(0.0, 0.0), 0.0);
        belief.driven(1.0, &wheels);
        // The drive has left a variance of 1/64.
        let covariance = SymmetricMatrix { xx: f64::from(counts - 1) / 64.0, xy: 0.0, yy: 1.0 };
        let (before, fix) = (belief.at().x_m, 1.0 + f64::from(off) / 8.0);
        belief.corrected(Point::new(fix, 0.0), covariance, Gate::Open);
        let (_, way) = belief.towards(Point::new(2.0, 0.0));
        let [before, fix, after, way] = [before, fix, belief.at().x_m, way].map(parts);
        format!("({counts},{before},{fix},{after},{way})")
    };
    [1, 2, 4, 8].into_iter().flat_map(|counts| (-7..=7).map(move |off| answer(counts, off))).collect()
}

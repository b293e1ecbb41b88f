//! Floors of packs, and what is seen there, said in a second, slower way.

#![allow(
    dead_code,
    missing_docs,
    unreachable_pub,
    clippy::missing_panics_doc,
    reason = "several tests use it"
)]

use std::collections::BTreeSet;

use tautline_kernel::choice::Oracle;
use tautline_kernel::ground::{Area, Cell};
use tautline_kernel::pack::{Chart, Status};

use crate::numbers::Congruence;

pub type Map = Chart<Vec<[u64; 2]>>;

pub fn unknown(area: Area) -> Map {
    // Whatever is in the words before.
    Chart::new(area, vec![[77, 5]; Map::words(area)]).expect("words enough")
}

pub fn area(first: (i16, i16), width: i16, height: i16) -> Area {
    let first = Cell::from(first);
    Area::new(first, Cell::new(first.x + width - 1, first.y + height - 1)).expect("cells")
}

/// Each cell is an obstacle with a chance of `of_hundred` in a hundred.
pub fn obstacles(drawn: &mut Congruence, area: Area, of_hundred: u32) -> BTreeSet<Cell> {
    area.cells().filter(|_| drawn.pick(100) < of_hundred).collect()
}

pub fn free_cell(drawn: &mut Congruence, area: Area, obstacles: &BTreeSet<Cell>) -> Cell {
    let free: Vec<Cell> = area.cells().filter(|cell| !obstacles.contains(cell)).collect();
    free[drawn.pick(free.len() as u32) as usize]
}

pub fn is_within(one: Cell, other: Cell, cells: u16) -> bool {
    let (columns, rows) = one.apart(other);
    u32::from(columns).pow(2) + u32::from(rows).pow(2) <= u32::from(cells).pow(2)
}

/// Whether the straight way between the midpoints of two cells is free: it crosses no obstacle before the last cell,
/// and passes at no corner between two. A cell is crossed if it has corners on both sides of the line.
pub fn is_clear(from: Cell, to: Cell, is_obstacle: impl Fn(Cell) -> bool) -> bool {
    let (columns, rows) = (i32::from(to.x - from.x), i32::from(to.y - from.y));
    let (east, south) = (columns.signum(), rows.signum());
    let at = |x: i32, y: i32| is_obstacle(Cell::new(from.x + (x * east) as i16, from.y + (y * south) as i16));
    let (columns, rows) = (columns.abs(), rows.abs());
    // Where a corner is, in halves of a cell: left of the line, on it, or right of it.
    let side = |x: i32, y: i32| (columns * y - rows * x).signum();
    (0..=columns).flat_map(|x| (0..=rows).map(move |y| (x, y))).all(|(x, y)| {
        let corners =
            [(-1, -1), (-1, 1), (1, -1), (1, 1)].map(|(across, down)| side(2 * x + across, 2 * y + down));
        let is_crossed = corners.contains(&-1) && corners.contains(&1);
        let is_end = (x, y) == (0, 0) || (x, y) == (columns, rows);
        let is_between = (x, y) != (columns, rows)
            && east * south != 0
            && side(2 * x + 1, 2 * y + 1) == 0
            && at(x + 1, y)
            && at(x, y + 1);
        !is_between && (is_end || !is_crossed || !at(x, y))
    })
}

/// The visibility gain of `cell`: all of it, and without what is within R_s of a cell in `others`.
pub fn gain(map: &Map, sight_cells: u16, cell: Cell, others: &[Cell]) -> (u32, u32) {
    let far = sight_cells as i16;
    let disc = area((cell.x - far, cell.y - far), 2 * far + 1, 2 * far + 1);
    let seen = disc.cells().filter(|&other| {
        map.status(other) == Status::Unknown
            && is_within(cell, other, sight_cells)
            && is_clear(cell, other, |between| map.status(between) == Status::Obstacle)
    });
    let is_own = |&seen: &Cell| !others.iter().any(|&other| is_within(other, seen, sight_cells));
    let (own, taken): (Vec<Cell>, Vec<Cell>) = seen.partition(is_own);
    ((own.len() + taken.len()) as u32, own.len() as u32)
}

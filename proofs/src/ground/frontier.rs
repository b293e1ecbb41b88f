//! LATTICE-2: the distance to the frontier, equation (4) of [Kovács 2011]. The grids flood whole sets of cells at a
//! time, in machine words; here every case is small enough, or straight enough, to be counted cell by cell.

use std::collections::VecDeque;

use tautline_kernel::choice::Oracle;
use tautline_kernel::ground::{Area, Avoid, BitGrid, Cell, CellMark, Edge, EdgeMark, Grid, Plane, Side};

use crate::engine::{Outcome, Stop, require};

/// How a grid floods its cells.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Flooding {
    /// As it does.
    Whole,
    /// A virtual obstacle binds followers, too.
    BindsFollowers,
    /// One row and one column are not flooded.
    SkipsALine,
}

const DISTANCE: &str = "the distance to the frontier is the fewest steps to an unexplored cell";

/// Columns and rows of [`in_six_cells`].
const SIX_CELLS: (i16, i16) = (3, 2);

/// The bound of [`in_six_cells`], in words.
pub(super) fn small_maps() -> String {
    let (width, height) = SIX_CELLS;
    format!("every map of {width}×{height} cells, in one word and in one for each row")
}

/// The bound of [`along_every_line`], in words.
pub(super) fn lines() -> String {
    format!("every row and column of {GRIDS} grids, from 8×8 to 128×128 cells, both ways")
}

/// In 3×2 cells, each edge open, a wall or a virtual obstacle, and each cell explored or not: the distances from all of
/// them, those of a follower and those of the leader.
///
/// # Errors
/// [`Stop::Violated`] if one is not the fewest steps.
pub(super) fn in_six_cells(flooding: &Flooding, oracle: &mut dyn Oracle) -> Outcome {
    let area = area(SIX_CELLS.0, SIX_CELLS.1)?;
    let edges: Vec<(Edge, u32)> = area.edges().map(|edge| (edge, oracle.pick(3))).collect();
    let explored: Vec<Cell> = area.cells().filter(|_| oracle.flip()).collect();
    // One word for all cells, and one for each row.
    let (mut tiny, mut small) = (grid::<u64>(area)?, grid::<[u16; 16]>(area)?);
    mark(&mut tiny, &edges, &explored);
    mark(&mut small, &edges, &explored);
    for avoid in [Avoid::Walls, Avoid::WallsAndVirtual] {
        let is_open = |edge: Edge| {
            let state = edges.iter().find(|&&(other, _)| other == edge).map_or(WALL, |&(_, state)| state);
            state == OPEN || state == VIRTUAL && avoid == Avoid::Walls
        };
        let asked = if *flooding == Flooding::BindsFollowers { Avoid::WallsAndVirtual } else { avoid };
        for from in area.cells() {
            let counted = count(from, is_open, |cell| explored.contains(&cell));
            require([tiny.distance(from, asked), small.distance(from, asked)] == [counted; 2], DISTANCE)?;
        }
    }
    Ok(if explored.len() == area.cells().count() { "no frontier" } else { "a frontier" })
}

const OPEN: u32 = 0;
const WALL: u32 = 1;
const VIRTUAL: u32 = 2;

/// The grids of [`along_every_line`].
const GRIDS: u32 = 5;

/// In the widest area of every grid, open and explored but for one cell at the end of a row or a column: the distance
/// from its other end.
///
/// # Errors
/// [`Stop::Violated`] if it is not the length of the line.
pub(super) fn along_every_line(flooding: &Flooding, oracle: &mut dyn Oracle) -> Outcome {
    match oracle.pick(GRIDS) {
        0 => along_a_line::<u64>(flooding, oracle),
        1 => along_a_line::<u128>(flooding, oracle),
        2 => along_a_line::<[u16; 16]>(flooding, oracle),
        3 => along_a_line::<[u64; 64]>(flooding, oracle),
        _ => along_a_line::<[u128; 128]>(flooding, oracle),
    }
}

fn along_a_line<P: Plane>(flooding: &Flooding, oracle: &mut dyn Oracle) -> Outcome {
    let (columns, rows) = (P::COLUMNS as i16, P::ROWS as i16);
    let (is_column, is_backwards) = (oracle.flip(), oracle.flip());
    let (lines, length) = if is_column { (columns, rows) } else { (rows, columns) };
    let line = oracle.pick(lines as u32) as i16;
    let cell = |place| if is_column { Cell::new(line, place) } else { Cell::new(place, line) };
    let (from, to) = if is_backwards { (cell(length - 1), cell(0)) } else { (cell(0), cell(length - 1)) };
    let mut grid = grid::<P>(area(columns, rows)?)?;
    grid.area().cells().filter(|&cell| cell != to).for_each(|cell| grid.put(CellMark::Explored, cell));
    if *flooding == Flooding::SkipsALine && line == lines / 2 {
        let side = if is_column { Side::South } else { Side::East };
        (0..length).for_each(|place| grid.put_edge(EdgeMark::Wall, Edge::new(cell(place), side)));
    }
    require(grid.distance(from, Avoid::Walls) == Some(length as u32 - 1), DISTANCE)?;
    Ok(if is_column { "a column" } else { "a row" })
}

fn area(width: i16, height: i16) -> Result<Area, Stop> {
    Area::new(Cell::new(0, 0), Cell::new(width - 1, height - 1)).ok_or(Stop::Assumed)
}

fn grid<P: Plane>(area: Area) -> Result<BitGrid<P>, Stop> {
    BitGrid::new(area).ok_or(Stop::Assumed)
}

fn mark(grid: &mut impl Grid, edges: &[(Edge, u32)], explored: &[Cell]) {
    for &(edge, state) in edges {
        match state {
            WALL => grid.put_edge(EdgeMark::Wall, edge),
            VIRTUAL => grid.put_edge(EdgeMark::Virtual, edge),
            _ => {}
        }
    }
    for &cell in explored {
        grid.put(CellMark::Explored, cell);
    }
}

/// Steps from `from` to the nearest cell that is not explored, counted layer by layer.
fn count(from: Cell, is_open: impl Fn(Edge) -> bool, is_explored: impl Fn(Cell) -> bool) -> Option<u32> {
    let (mut seen, mut queue) = (vec![from], VecDeque::from([(from, 0)]));
    while let Some((cell, steps)) = queue.pop_front() {
        if !is_explored(cell) {
            return Some(steps);
        }
        for side in Side::ALL.into_iter().filter(|&side| is_open(Edge::new(cell, side))) {
            let next = cell.beyond(side);
            if !seen.contains(&next) {
                seen.push(next);
                queue.push_back((next, steps + 1));
            }
        }
    }
    None
}

//! Neighbour search: a grid of cells at least half as wide as signals reach, so that whoever can be heard is at most
//! two cells off. The nodes are kept cell by cell, row by row: cells side by side are one stretch.

use std::ops::Range;

use tautline_kernel::net::NodeId;

use super::{Area, Point};

/// Nodes, cell by cell.
pub(crate) struct Grid {
    columns: usize,
    rows: usize,
    cell_width_m: f64,
    cell_height_m: f64,
    /// Where each cell begins among `places`, and where the last one ends.
    first: Vec<u32>,
    /// The nodes with their positions, cell by cell.
    pub(super) places: Vec<Place>,
}

#[derive(Clone, Copy)]
pub(super) struct Place {
    pub(super) node: u32,
    pub(super) point: Point,
}

/// How many cells off one can be heard.
const CELLS_OFF: usize = 2;

/// Cells are a little wider than signals reach, so that rounding puts nobody farther off.
const ROOM: f64 = 1.000_001;

impl Grid {
    /// The nodes at `points`, whose signals reach so far.
    pub(crate) fn new(area: Area, points: &[Point], reach_m: f64) -> Self {
        // More cells than nodes would only be empty.
        let most = f64::from(points.len() as u32).sqrt().ceil();
        let cells =
            |side_m: f64| (f64::from(CELLS_OFF as u32) * side_m / (reach_m * ROOM)).floor().clamp(1.0, most);
        let (columns, rows) = (cells(area.width_m()), cells(area.height_m()));
        let mut grid = Self {
            columns: columns as usize,
            rows: rows as usize,
            cell_width_m: area.width_m() / columns,
            cell_height_m: area.height_m() / rows,
            first: vec![0; columns as usize * rows as usize + 1],
            places: vec![Place { node: 0, point: Point { x_m: 0.0, y_m: 0.0 } }; points.len()],
        };
        let cells: Vec<u32> = points.iter().map(|&point| grid.cell(point) as u32).collect();
        for &cell in &cells {
            grid.first[cell as usize + 1] += 1;
        }
        for cell in 1..grid.first.len() {
            grid.first[cell] += grid.first[cell - 1];
        }
        let mut next = grid.first.clone();
        for ((node, &point), cell) in (0..).zip(points).zip(cells) {
            let place = &mut next[cell as usize];
            grid.places[*place as usize] = Place { node, point };
            *place += 1;
        }
        grid
    }

    fn column_and_row(&self, point: Point) -> (usize, usize) {
        let column = (point.x_m / self.cell_width_m) as usize;
        let row = (point.y_m / self.cell_height_m) as usize;
        (column.min(self.columns - 1), row.min(self.rows - 1))
    }

    fn cell(&self, point: Point) -> usize {
        let (column, row) = self.column_and_row(point);
        row * self.columns + column
    }

    /// The stretches of `places` in which whoever is within reach of `point` is.
    pub(super) fn near(&self, point: Point) -> impl Iterator<Item = Range<usize>> + use<'_> {
        let (column, row) = self.column_and_row(point);
        self.beside(column, row)
    }

    /// Whoever is within reach of `point`, and some who are not, ascending.
    pub(crate) fn nodes_near(&self, point: Point) -> Vec<NodeId> {
        let places = self.near(point).flat_map(|places| &self.places[places]);
        let mut nodes: Vec<NodeId> = places.map(|place| NodeId(place.node)).collect();
        nodes.sort_unstable();
        nodes
    }

    fn beside(&self, column: usize, row: usize) -> impl Iterator<Item = Range<usize>> + use<'_> {
        let (west, east) = (column.saturating_sub(CELLS_OFF), (column + CELLS_OFF).min(self.columns - 1));
        (row.saturating_sub(CELLS_OFF)..=(row + CELLS_OFF).min(self.rows - 1)).map(move |row| {
            let cells = row * self.columns;
            self.first[cells + west] as usize..self.first[cells + east + 1] as usize
        })
    }

    /// How many pairs of nodes will be looked at, each from both sides.
    pub(super) fn pairs(&self) -> u64 {
        let in_cell = |column: usize, row: usize| {
            let cell = row * self.columns + column;
            u64::from(self.first[cell + 1] - self.first[cell])
        };
        let beside = |column, row| self.beside(column, row).map(|places| places.len() as u64).sum::<u64>();
        let cells = (0..self.rows).flat_map(|row| (0..self.columns).map(move |column| (column, row)));
        cells.map(|(column, row)| in_cell(column, row) * beside(column, row)).sum()
    }
}

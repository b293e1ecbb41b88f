//! A layout, or what a team knows of it, as an occupancy grid. Walls stand between cells, so a cell and its sides are
//! points of their own: a layout of 2×1 cells has 5×3 points, two to a metre, where a cell is a metre wide. Rows of
//! points go north, as ROS has them; rows of cells go south.
//!
//! ```text
//!  + - + - +
//!  | a | b |
//!  + - + - +
//! ```

use std::collections::{BTreeMap, BTreeSet};

use tautline_kernel::ground::{Cell, Edge, Side, Step};

use tautline_grids::layout::Layout;
use tautline_sim::explore::{Change, Scene, TeamMove};

/// Nothing is known of a point.
const UNKNOWN: i8 = -1;
const FREE: i8 = 0;
const OCCUPIED: i8 = 100;

/// Changed points are told in parts of the map of so many points to a side, so that robots far from each other do not
/// send what lies between them.
const PART: usize = 8;

/// A rectangle of points: column and row of the first, columns and rows.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) struct Rectangle {
    pub(super) x: usize,
    pub(super) y: usize,
    pub(super) width: usize,
    pub(super) height: usize,
}

/// A value for each point.
#[derive(Clone, Debug)]
pub(super) struct Points {
    pub(super) width: usize,
    pub(super) height: usize,
    values: Vec<i8>,
    /// The points that have another value than when this was last asked.
    changed: BTreeSet<usize>,
}

impl Points {
    /// Nothing is known of `layout`.
    fn unknown(layout: &Layout) -> Self {
        let [width, height] = [layout.width(), layout.height()].map(|side| 2 * side as usize + 1);
        Self { width, height, values: vec![UNKNOWN; width * height], changed: BTreeSet::new() }
    }

    /// Everything is known of `layout`.
    pub(super) fn whole(layout: &Layout) -> Self {
        let mut points = Self::unknown(layout);
        for cell in layout.cells() {
            points.put_cell(cell, if layout.is_free(cell) { FREE } else { OCCUPIED });
            for edge in Side::ALL.map(|side| Edge::new(cell, side)) {
                points.put_side(edge, layout.is_open(edge));
            }
        }
        points
    }

    /// The knowledge of robots that start in these cells of `layout`.
    pub(super) fn at_start(layout: &Layout, starts: &[Cell]) -> Self {
        let mut points = Self::unknown(layout);
        for &cell in starts {
            points.put_cell(cell, FREE);
        }
        points
    }

    /// Takes in what a team move tells: the sides that were tried, the cells that were entered, and what the scheme
    /// says of other sides.
    pub(super) fn take(&mut self, made: &TeamMove<'_>, scene: &Scene) {
        for ((&from, &step), &blocked) in made.before.iter().zip(&made.frame.steps).zip(&made.frame.blocked) {
            if let Step::Cross(side) = step {
                self.put_side(Edge::new(from, side), !blocked);
            }
        }
        for &cell in &made.frame.cells {
            self.put_cell(cell, FREE);
        }
        for change in scene.changes() {
            if let &Change::Know { side, is_open } = change {
                self.put_side(side, is_open);
            }
        }
    }

    /// The place of a point, by its column and row counted as those of cells are, from the north.
    fn place(&self, column: i32, row: i32) -> Option<usize> {
        let (column, row) = (usize::try_from(column).ok()?, usize::try_from(row).ok()?);
        (column < self.width && row < self.height).then(|| (self.height - 1 - row) * self.width + column)
    }

    fn put(&mut self, column: i32, row: i32, value: i8) {
        if let Some(place) = self.place(column, row)
            && self.values[place] != value
        {
            self.values[place] = value;
            self.changed.insert(place);
        }
    }

    fn put_cell(&mut self, cell: Cell, value: i8) {
        self.put(2 * i32::from(cell.x) + 1, 2 * i32::from(cell.y) + 1, value);
    }

    fn put_side(&mut self, edge: Edge, is_open: bool) {
        let (column, row) = (2 * i32::from(edge.cell().x) + 1, 2 * i32::from(edge.cell().y) + 1);
        let [x, y] = match edge.side() {
            Side::East => [1, 0],
            Side::South => [0, 1],
            Side::West => [-1, 0],
            Side::North => [0, -1],
        };
        self.put(column + x, row + y, if is_open { FREE } else { OCCUPIED });
        // The posts at both ends of the side.
        for end in [-1, 1] {
            self.put_post(column + x + end * y, row + y + end * x);
        }
    }

    /// A post is occupied where a wall ends at it, and free where no wall does.
    fn put_post(&mut self, column: i32, row: i32) {
        let of_side = |(x, y)| self.place(column + x, row + y).map(|place| self.values[place]);
        let sides: Vec<i8> = [(1, 0), (0, 1), (-1, 0), (0, -1)].into_iter().filter_map(of_side).collect();
        if sides.contains(&OCCUPIED) {
            self.put(column, row, OCCUPIED);
        } else if !sides.contains(&UNKNOWN) {
            self.put(column, row, FREE);
        }
    }

    /// All values, row by row from the south.
    pub(super) fn values(&self) -> &[i8] {
        &self.values
    }

    /// The values in a rectangle, row by row from the south.
    pub(super) fn within(&self, part: Rectangle) -> Vec<i8> {
        let rows = (part.y..part.y + part.height).map(|row| row * self.width + part.x);
        rows.flat_map(|start| self.values[start..start + part.width].iter().copied()).collect()
    }

    /// Rectangles that have all points which are otherwise than when this was last asked.
    pub(super) fn changed(&mut self) -> Vec<Rectangle> {
        let mut parts = BTreeMap::<(usize, usize), [usize; 4]>::new();
        for place in std::mem::take(&mut self.changed) {
            let (x, y) = (place % self.width, place / self.width);
            let [west, south, east, north] = parts.entry((y / PART, x / PART)).or_insert([x, y, x, y]);
            (*west, *south) = (x.min(*west), y.min(*south));
            (*east, *north) = (x.max(*east), y.max(*north));
        }
        let rectangle =
            |[x, y, east, north]: [usize; 4]| Rectangle { x, y, width: east - x + 1, height: north - y + 1 };
        parts.into_values().map(rectangle).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn drawn(points: &Points) -> String {
        let rows = points.values().chunks(points.width).rev().map(|row| {
            let signs = row.iter().map(|&value| match value {
                UNKNOWN => '?',
                FREE => '.',
                _ => '#',
            });
            signs.chain(['\n']).collect::<String>()
        });
        rows.collect()
    }

    #[test]
    fn cells_sides_and_posts_are_points_of_their_own() {
        let layout: Layout =
            "tautline layout 1\n+--+--+\n|B    |\n+  +--+\n|  |##|\n+--+--+\n".parse().expect("a layout");
        assert_eq!(drawn(&Points::whole(&layout)), "#####\n#...#\n#.###\n#.###\n#####\n");
        let mut known = Points::at_start(&layout, &[Cell::new(0, 0)]);
        assert_eq!(drawn(&known), "?????\n?.???\n?????\n?????\n?????\n");
        known.changed();
        known.put_side(Edge::new(Cell::new(0, 0), Side::East), true);
        known.put_side(Edge::new(Cell::new(1, 0), Side::South), false);
        assert_eq!(drawn(&known), "?????\n?..??\n??###\n?????\n?????\n");
        assert_eq!(known.changed(), [Rectangle { x: 2, y: 2, width: 3, height: 2 }]);
        assert!(known.changed().is_empty());
    }

    #[test]
    fn far_changes_are_told_apart() {
        let mut known = Points::unknown(&Layout::open(30, 30).expect("a size"));
        known.put_cell(Cell::new(0, 0), FREE);
        known.put_cell(Cell::new(29, 29), FREE);
        let far: Vec<[usize; 2]> = known.changed().iter().map(|part| [part.x, part.y]).collect();
        assert_eq!(far, [[59, 1], [1, 59]]);
    }
}

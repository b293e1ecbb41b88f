//! A robot's sight: the cells within R_s to which a ray goes that no obstacle stops (II.B.1). A ray goes straight from
//! midpoint to midpoint. It is stopped by an obstacle in a cell that it crosses, and at a corner where it passes
//! between two obstacles; the first obstacle itself is seen.

use super::chart::Chart;
use crate::ground::Cell;

/// How far a robot sees: R_s, as the cells of a disc round it.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Sight {
    radius_cells: u8,
    /// By rows from the robot: columns to either side.
    half: [u8; Sight::MOST_CELLS as usize + 1],
    /// Cells of the disc.
    cells: u32,
}

impl Sight {
    /// The most cells: a row of the disc fits in a machine word.
    pub const MOST_CELLS: u16 = 31;

    /// A robot that sees so far; `None` if that is not from 1 to [`Sight::MOST_CELLS`].
    pub const fn new(radius_cells: u16) -> Option<Self> {
        if radius_cells == 0 || radius_cells > Self::MOST_CELLS {
            None
        } else {
            Some(Self::of(radius_cells as u8))
        }
    }

    /// A robot that sees so far, from 1 to [`Sight::MOST_CELLS`].
    pub(super) const fn of(radius_cells: u8) -> Self {
        let radius = radius_cells as u32;
        let (mut half, mut cells, mut row) = ([0; Self::MOST_CELLS as usize + 1], 0, 0);
        while row <= radius && (row as usize) < half.len() {
            let columns = (radius * radius - row * row).isqrt();
            half[row as usize] = columns as u8;
            cells += (2 * columns + 1) * (if row == 0 { 1 } else { 2 });
            row += 1;
        }
        Self { radius_cells, half, cells }
    }

    /// R_s in cells.
    pub const fn radius_cells(&self) -> u8 {
        self.radius_cells
    }

    /// How many cells a robot sees where nothing is in the way, its own among them.
    pub const fn cells(&self) -> u32 {
        self.cells
    }

    /// The columns of the disc to either side in a row; `None` if the row is too far.
    fn half(&self, rows: u32) -> Option<u32> {
        if rows > self.radius_cells.into() {
            return None;
        }
        self.half.get(rows as usize).map(|&columns| columns.into())
    }
}

impl<W: AsRef<[[u64; 2]]> + AsMut<[[u64; 2]]>> Chart<W> {
    /// A robot in `from` looks round: `is_obstacle` answers for unknown cells, and `tell` hears of each that is seen,
    /// and whether it is an obstacle.
    pub fn look(
        &mut self,
        sight: &Sight,
        from: Cell,
        is_obstacle: impl FnMut(Cell) -> bool,
        mut tell: impl FnMut(Cell, bool),
    ) {
        let mut window = Window::new(self, sight, from);
        if window.most() > 0 {
            window.look(is_obstacle, |cell, is_obstacle| {
                self.put(cell, is_obstacle);
                tell(cell, is_obstacle);
            });
        }
    }
}

/// Rows of a window.
const ROWS: usize = 2 * Sight::MOST_CELLS as usize + 1;

/// The disc round a cell, one word a row: which of its cells are unknown, and which are obstacles as far as that is
/// known. The lowest bit is R_s columns west of the cell.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Window {
    from: Cell,
    radius: i32,
    unknown: [u64; ROWS],
    obstacles: [u64; ROWS],
    /// Cells that others are going to see.
    taken: [u64; ROWS],
}

impl Window {
    /// The disc round `from`.
    pub fn new<W: AsRef<[[u64; 2]]>>(chart: &Chart<W>, sight: &Sight, from: Cell) -> Self {
        let radius = i32::from(sight.radius_cells);
        let mut window = Self { from, radius, unknown: [0; ROWS], obstacles: [0; ROWS], taken: [0; ROWS] };
        let (west, north) = (i32::from(from.x) - radius, i32::from(from.y) - radius);
        let rows = window.unknown.iter_mut().zip(&mut window.obstacles);
        for ((unknown, obstacles), row) in rows.zip(-radius..=radius) {
            let Some(half) = sight.half(row.unsigned_abs()) else { continue };
            let across = ((1 << (2 * half + 1)) - 1) << (radius as u32 - half);
            let [is_unknown, is_obstacle] = chart.row(west, north + radius + row);
            *unknown = is_unknown & across;
            *obstacles = is_obstacle & across;
        }
        window
    }

    /// Notes that another robot is on its way to `aim`: the cells in the disc round it are taken.
    pub fn take(&mut self, sight: &Sight, aim: Cell) {
        let (columns, rows) =
            (i32::from(aim.x) - i32::from(self.from.x), i32::from(aim.y) - i32::from(self.from.y));
        if columns.abs() > 2 * self.radius || rows.abs() > 2 * self.radius {
            return;
        }
        for (taken, row) in self.taken.iter_mut().zip(-self.radius..=self.radius) {
            let Some(half) = sight.half((row - rows).unsigned_abs()) else { continue };
            let first = (columns + self.radius - half as i32).max(0);
            let last = (columns + self.radius + half as i32).min(u64::BITS as i32 - 1);
            if first <= last {
                *taken |= u64::MAX >> (u64::BITS as i32 - 1 - (last - first)) << first;
            }
        }
    }

    /// How many cells are unknown and not taken, whether in sight or not: no gain is greater.
    pub fn most(&self) -> u32 {
        self.unknown.iter().zip(&self.taken).map(|(unknown, taken)| (unknown & !taken).count_ones()).sum()
    }

    /// The visibility gain V: how many unknown cells would be seen, as far as obstacles are
    /// known; and how many of them are not taken.
    pub fn gain(&self) -> (u32, u32) {
        let (mut all, mut own) = (0, 0);
        self.each_unknown(|columns, rows, _| {
            if self.is_clear(columns, rows) {
                all += 1;
                let taken = self.taken.get((rows + self.radius) as usize);
                own += u32::from(taken.is_some_and(|row| row >> ((columns + self.radius) & 63) & 1 == 0));
            }
        });
        (all, own)
    }

    /// Tells of each unknown cell that is seen, and whether it is an obstacle,
    /// if `is_obstacle` says so of unknown cells.
    pub fn look(&mut self, mut is_obstacle: impl FnMut(Cell) -> bool, mut tell: impl FnMut(Cell, bool)) {
        let mut obstacles = self.obstacles;
        self.each_unknown(|columns, rows, cell| {
            if is_obstacle(cell)
                && let Some(row) = obstacles.get_mut((rows + self.radius) as usize)
            {
                *row |= 1 << (columns + self.radius);
            }
        });
        self.obstacles = obstacles;
        self.each_unknown(|columns, rows, cell| {
            if self.is_clear(columns, rows) {
                tell(cell, self.has_obstacle(columns, rows));
            }
        });
    }

    /// Tells of each unknown cell by columns and rows from the middle.
    fn each_unknown(&self, mut tell: impl FnMut(i32, i32, Cell)) {
        for (&unknown, row) in self.unknown.iter().zip(-self.radius..=self.radius) {
            let mut left = unknown;
            while left != 0 {
                let column = left.trailing_zeros() as i32 - self.radius;
                left &= left - 1;
                tell(column, row, self.from.at_offset(column as i16, row as i16));
            }
        }
    }

    fn has_obstacle(&self, columns: i32, rows: i32) -> bool {
        let row = self.obstacles.get((rows + self.radius) as usize);
        row.is_some_and(|row| row >> ((columns + self.radius) & 63) & 1 == 1)
    }

    /// Whether the ray gets to the cell so many columns and rows away.
    fn is_clear(&self, columns: i32, rows: i32) -> bool {
        let (across, down) = (columns.abs(), rows.abs());
        let (east, south) = (columns.signum(), rows.signum());
        let (mut x, mut y) = (0, 0);
        loop {
            // The ray leaves the cell x,y through its far side in x sooner than through that in y if this is negative.
            let later = (2 * x + 1) * down - (2 * y + 1) * across;
            if later == 0 {
                let is_between = self.has_obstacle(east * (x + 1), south * y)
                    && self.has_obstacle(east * x, south * (y + 1));
                if is_between {
                    return false;
                }
            }
            x += i32::from(later <= 0);
            y += i32::from(later >= 0);
            if x >= across && y >= down {
                return true;
            }
            if self.has_obstacle(east * x, south * y) {
                return false;
            }
        }
    }
}

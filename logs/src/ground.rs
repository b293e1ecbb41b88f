//! Logs against a map: positions where no robot can be, steps through walls, and the cells that were visited.

use std::collections::BTreeSet;
use std::fmt;

use super::{Limits, Sample, Tracks};

/// The grid of cells under the positions. Columns are counted along the first axis, rows along the second one.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Grid {
    /// The corner from which columns and rows are counted, in millimetres.
    pub origin_mm: [f64; 2],
    /// The width of a cell in millimetres; above 0.
    pub cell_mm: f64,
}

impl Grid {
    /// The columns and rows of the square around a place whose half side is the tolerance: the lowest and the highest.
    fn around(self, place: [f64; 2], tolerance_mm: f64) -> [[i32; 2]; 2] {
        let along = |axis: usize, off: f64| {
            ((place[axis] + off - self.origin_mm[axis]) / self.cell_mm).floor() as i32
        };
        [[along(0, -tolerance_mm), along(1, -tolerance_mm)], [along(0, tolerance_mm), along(1, tolerance_mm)]]
    }

    /// The rectangle of cells that a robot at this place may be in: its lowest and its highest column and row.
    pub(super) fn within(self, place: [f64; 2], tolerance_mm: u32) -> [[i32; 2]; 2] {
        self.around(place, tolerance_mm.into())
    }

    /// The cells that a robot at this place may be in.
    pub fn touched(self, place: [f64; 2], tolerance_mm: u32) -> impl Iterator<Item = [i32; 2]> {
        cells_of(self.within(place, tolerance_mm))
    }

    /// The cell in which a robot at this place is without doubt.
    pub fn surely(self, place: [f64; 2], tolerance_mm: u32) -> Option<[i32; 2]> {
        let [low, high] = self.around(place, tolerance_mm.into());
        (low == high).then_some(low)
    }

    /// The corners of a cell that is larger by so much on each side.
    fn bounds(self, cell: [i32; 2], by_mm: f64) -> [[f64; 2]; 2] {
        let corner =
            |axis: usize, cells: f64| self.origin_mm[axis] + self.cell_mm * (f64::from(cell[axis]) + cells);
        [[corner(0, 0.0) - by_mm, corner(1, 0.0) - by_mm], [corner(0, 1.0) + by_mm, corner(1, 1.0) + by_mm]]
    }
}

/// The cells of a rectangle, of which these are the lowest and the highest column and row.
pub(super) fn cells_of([low, high]: [[i32; 2]; 2]) -> impl Iterator<Item = [i32; 2]> {
    (low[1]..=high[1]).flat_map(move |row| (low[0]..=high[0]).map(move |column| [column, row]))
}

/// A map of cells.
pub trait Ground {
    /// Whether a robot can be in this cell.
    fn is_free(&self, cell: [i32; 2]) -> bool;
    /// Whether a robot can go from one cell to another one beside it.
    fn is_open(&self, cell: [i32; 2], beside: [i32; 2]) -> bool;
}

/// The positions that are not of the map, and the steps: how many, and the place of the first in the log.
#[derive(Clone, Copy, PartialEq, Eq, Default, Debug)]
pub struct Strays {
    /// Positions in blocked cells or off the map.
    pub off: Option<(u32, u32)>,
    /// Steps from a cell into one beside it with a wall between them.
    pub through: Option<(u32, u32)>,
    /// Whether more than half of the positions are off the map, and would be on it, in several cells, if their unit
    /// were a thousandth.
    pub is_milli: bool,
}

/// Compares the positions with a map.
pub fn misplaced(tracks: &Tracks, limits: &Limits, grid: Grid, ground: &dyn Ground) -> Strays {
    let mut found = Strays::default();
    let count = |counted: &mut Option<(u32, u32)>, place: u32| {
        let counted = counted.get_or_insert((0, place));
        *counted = (counted.0 + 1, counted.1.min(place));
    };
    let (mut all, mut milli, mut cells) = (0_usize, 0_usize, BTreeSet::new());
    for track in &tracks.robots {
        let mut before: Option<([i32; 2], &Sample)> = None;
        for sample in track {
            let place = [sample.x_mm, sample.y_mm].map(f64::from);
            if grid.touched(place, limits.tolerance_mm).all(|cell| !ground.is_free(cell)) {
                count(&mut found.off, sample.place);
            }
            all += 1;
            let thousandth = grid.around(place.map(|along| along / 1e3), 0.0)[0];
            if ground.is_free(thousandth) {
                milli += 1;
                cells.insert(thousandth);
            }
            let cell = grid.surely(place, limits.tolerance_mm);
            if let (Some((from, last)), Some(to)) = (before, cell) {
                let is_soon = tracks.goes_straight(last, sample);
                let apart: u32 = (0..2).map(|axis| i32::abs_diff(from[axis], to[axis])).sum();
                let is_free = ground.is_free(from) && ground.is_free(to);
                if is_soon && apart == 1 && is_free && !ground.is_open(from, to) {
                    count(&mut found.through, sample.place);
                }
            }
            // At a border it may be in either cell: the last sure one counts.
            before = cell.map(|cell| (cell, sample)).or(before);
        }
    }
    let is_off = found.off.is_some_and(|(off, _)| off as usize * 2 > all);
    found.is_milli = is_off && milli * 2 > all && cells.len() > 1;
    found
}

/// More comparisons of robots than a judge makes.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct TooMuch {
    /// So many.
    pub comparisons: u128,
}

/// The comparisons of robots that a judge makes for a clause.
pub const MOST_COMPARISONS: u128 = 1 << 32;

impl fmt::Display for TooMuch {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { comparisons } = self;
        write!(
            f,
            "the judge would compare robots {comparisons} times, and does so at most {MOST_COMPARISONS} times"
        )
    }
}

impl std::error::Error for TooMuch {}

/// Those of `cells` that were visited without doubt, and those that may have been.
///
/// # Errors
/// [`TooMuch`] if robots leap over too many cells.
pub fn visits(
    tracks: &Tracks,
    limits: &Limits,
    grid: Grid,
    cells: &BTreeSet<[i32; 2]>,
) -> Result<[BTreeSet<[i32; 2]>; 2], TooMuch> {
    let tolerance = f64::from(limits.tolerance_mm);
    // A position far away is no reason to look at all cells on the way.
    let rim = |axis: usize| {
        let along = || cells.iter().map(|cell| cell[axis]);
        (along().min().unwrap_or(0), along().max().unwrap_or(0))
    };
    let rims = [rim(0), rim(1)];
    let ([mut surely, mut maybe], mut comparisons) = ([BTreeSet::new(), BTreeSet::new()], 0);
    for track in &tracks.robots {
        for (sample, next) in track.iter().zip(track.iter().skip(1).chain(track.last())) {
            let next = if tracks.goes_straight(sample, next) { next } else { sample };
            let ends = [sample, next].map(|end| [end.x_mm, end.y_mm].map(f64::from));
            let [one, other] = ends.map(|end| grid.around(end, tolerance));
            let [columns, rows] = [0, 1].map(|axis| {
                let (low, high) = (one[0][axis].min(other[0][axis]), one[1][axis].max(other[1][axis]));
                low.max(rims[axis].0)..=high.min(rims[axis].1)
            });
            comparisons += columns.clone().count() as u128 * rows.clone().count() as u128;
            if comparisons > MOST_COMPARISONS {
                return Err(TooMuch { comparisons });
            }
            for column in columns {
                for cell in rows.clone().map(|row| [column, row]).filter(|cell| cells.contains(cell)) {
                    if !surely.contains(&cell) && crosses(ends, grid.bounds(cell, -tolerance)) {
                        surely.insert(cell);
                    }
                    if !maybe.contains(&cell) && crosses(ends, grid.bounds(cell, tolerance)) {
                        maybe.insert(cell);
                    }
                }
            }
        }
    }
    Ok([surely, maybe])
}

/// Whether the straight way between two places meets a rectangle: the part of the way that is within the bounds of one
/// axis has to meet that of the other one.
fn crosses([from, to]: [[f64; 2]; 2], [low, high]: [[f64; 2]; 2]) -> bool {
    let (mut start, mut end) = (0.0_f64, 1.0_f64);
    for axis in 0..2 {
        let way = to[axis] - from[axis];
        let bounds = [low[axis] - from[axis], high[axis] - from[axis]];
        if bounds[0] > bounds[1] {
            return false;
        }
        if way == 0.0 {
            if bounds[0] > 0.0 || bounds[1] < 0.0 {
                return false;
            }
        } else {
            let [one, other] = bounds.map(|bound| bound / way);
            (start, end) = (start.max(one.min(other)), end.min(one.max(other)));
        }
    }
    start <= end
}

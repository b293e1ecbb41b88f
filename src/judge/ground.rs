//! The map under a log, or the cells alone, and where they lie in metres.

use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};

use clap::Args;
use tautline_io::diagnostic::{Diagnostic, unreadable};
use tautline_io::value_parser::{Metres, metres_within, number, real};
use tautline_kernel::ground::{Cell, Edge, Side};
use tautline_logs::{Grid, Ground, Limits, Tracks};

use crate::options::refuse_needless;
use crate::value_parser::{CellArg, MOST, above_0, file_or_word};
use tautline_grids::layout::ros::{self, Frame};
use tautline_grids::layout::{self, Coarse, Generator, Layout};

#[derive(Debug, Args)]
pub(super) struct MapArgs {
    /// The map: a layout file or a generator, with its lower left corner at 0,0, or where a ROS map says.
    #[arg(long, value_name = "LAYOUT", value_parser = file_or_word())]
    map: Option<String>,
    /// The seed of a map that is generated. Without it 0.
    #[arg(long, requires = "map", value_parser = number::<u64>)]
    seed: Option<u64>,
    /// The image of a ROS map, in place of the one that it names.
    #[arg(long, value_name = "FILE", requires = "map")]
    image: Option<PathBuf>,
    /// The radius of a robot on a ROS map in cells larger than its pixels, in metres. Without it half the side of a
    /// cell.
    #[arg(long, value_name = "METRES", requires = "map", value_parser = real)]
    radius: Option<f64>,
    /// The side of a cell in metres. Without it that of a pixel of a ROS map, and else 1.
    #[arg(long, value_name = "METRES", value_parser = above_0)]
    cell: Option<f64>,
    /// The corner of the cells in metres: the lower left one of the map. Without it 0,0, or what a ROS map says.
    #[arg(long, value_name = "X,Y", allow_hyphen_values = true, value_parser = corner)]
    origin: Option<Metres<2>>,
    /// The cell of the base for CHAIN-2, as the map counts cells; without a map columns east and rows north of
    /// --origin, from 0. Without it that of the map, or the one in which robot 1 is first.
    #[arg(long, value_name = "X,Y")]
    base: Option<CellArg>,
}

/// A corner from which every position has a cell of any size, and that cell a number.
fn corner(text: &str) -> Result<Metres<2>, String> {
    metres_within(text, MOST)
}

/// The cells under a log, and the map of them if there is one. The rows of a map are counted southwards from 0; those
/// of a grid northwards from its corner.
pub(super) struct LogMap {
    layout: Option<Layout>,
    grid: Grid,
    base: Option<Cell>,
}

impl MapArgs {
    /// The files that this is read from.
    pub(super) fn inputs(&self) -> Vec<PathBuf> {
        self.map.as_ref().map_or_else(Vec::new, |map| layout::inputs(map, self.image.as_deref()))
    }

    /// Refuses options without effect on clauses of which some speak of cells and
    /// of a base, and some of a range in cells.
    pub(super) fn check(
        &self,
        (has_cells, has_base): (bool, bool),
        is_range_in_cells: bool,
    ) -> Result<(), Diagnostic> {
        let lies = has_cells || self.map.is_some();
        refuse_needless([("--base", self.base.is_some() && !has_base)], "CHAIN-2 alone has a base")?;
        let origin = ("--origin", self.origin.is_some() && !lies);
        let cell = ("--cell", self.cell.is_some() && !lies && !is_range_in_cells);
        refuse_needless([origin, cell], "none of these clauses speaks of cells")
    }

    pub(super) fn load(&self, is_map_needed: bool) -> Result<LogMap, Diagnostic> {
        let mut corner = [0.0, 0.0];
        let mut cell_m = self.cell.unwrap_or(1.0);
        let layout = match &self.map {
            None if is_map_needed => {
                let what = "FRONTIER-1 asks which cells robots can reach";
                return Err(Diagnostic::usage(what, "give a --map"));
            }
            None => None,
            Some(map) => {
                let (image, path) = (self.image.as_deref(), Path::new(map));
                let mut coarse = Coarse { cell_m: None, radius_m: self.radius };
                let mut of_pixels = None;
                if layout::is_ros(path) && map.parse::<Generator>().is_err() {
                    let (pixels, frame) = ros::load(path, image)?;
                    if frame.yaw_rad != 0.0 {
                        let what = format!("the map is turned by {} rad", frame.yaw_rad);
                        let remedy = "turn the positions into the axes of its \
                            image, and set the yaw of its origin to 0";
                        return Err(Diagnostic::in_file(path, what, remedy));
                    }
                    coarse.cell_m = self.cell;
                    cell_m = self.cell.unwrap_or(frame.resolution_m);
                    of_pixels = Some((frame, pixels.height()));
                }
                let layout = layout::load_coarse(map, self.seed.unwrap_or(0), image, coarse)?;
                if let Some((frame, rows)) = of_pixels {
                    let Frame { x_m, y_m, .. } = frame.of_cells(rows, cell_m, layout.height());
                    corner = [x_m, y_m];
                }
                Some(layout)
            }
        };
        if let Some(Metres(origin)) = self.origin {
            corner = origin;
        }
        let is_random = |map: &str| map.parse::<Generator>().is_ok_and(|generator| generator.is_random());
        let has_other_seed = self.seed.is_some() && !self.map.as_deref().is_some_and(is_random);
        refuse_needless([("--seed", has_other_seed)], "nothing of the map is left to chance")?;
        let base = self.base.map(|CellArg(cell)| cell);
        if let (Some(layout), Some(base)) = (&layout, base) {
            layout.check_base(base)?;
        }
        let base = base.or_else(|| layout.as_ref()?.base());
        let grid = Grid { origin_mm: corner.map(|along| along * 1e3), cell_mm: cell_m * 1e3 };
        Ok(LogMap { layout, grid, base })
    }
}

impl LogMap {
    pub(super) const fn grid(&self) -> Grid {
        self.grid
    }

    pub(super) fn cell_m(&self) -> f64 {
        self.grid.cell_mm / 1e3
    }

    pub(super) const fn layout(&self) -> Option<&Layout> {
        self.layout.as_ref()
    }

    pub(super) fn ground(&self) -> Option<&dyn Ground> {
        self.layout.as_ref().map(|_| self as &dyn Ground)
    }

    /// Refuses cells in which no robot is without doubt.
    pub(super) fn check_cells(&self, id: &str, limits: &Limits) -> Result<(), Diagnostic> {
        if f64::from(limits.tolerance_mm) * 2.0 < self.grid.cell_mm {
            return Ok(());
        }
        let what = format!(
            "{id} speaks of cells, and with this tolerance no robot is in a cell of {} m without doubt",
            self.cell_m()
        );
        Err(Diagnostic::usage(what, "give a --tolerance below half a --cell"))
    }

    /// The cell of the grid: without a map it is counted as there.
    fn northward(&self, cell: Cell) -> [i32; 2] {
        let row = i32::from(cell.y);
        [cell.x.into(), self.layout.as_ref().map_or(row, |layout| i32::from(layout.height()) - 1 - row)]
    }

    /// The cell of the map, or as far as its numbers go.
    fn southward(&self, [column, row]: [i32; 2]) -> Option<Cell> {
        let rows = self.layout.as_ref().map_or(0, Layout::height);
        let row = i32::from(rows).checked_sub(1)?.checked_sub(row)?;
        Some(Cell::new(column.try_into().ok()?, row.try_into().ok()?))
    }

    /// Those of these cells of the grid that are on the map, as the map has them.
    pub(super) fn on_map(&self, cells: &[[i32; 2]]) -> Vec<Cell> {
        cells.iter().filter_map(|&cell| self.southward(cell)).collect()
    }

    /// A cell of the grid as people count it: as the map does, or as the grid does if there is none.
    pub(super) fn counted(&self, cell: [i32; 2]) -> [i32; 2] {
        match (&self.layout, self.southward(cell)) {
            (Some(_), Some(cell)) => [cell.x.into(), cell.y.into()],
            (Some(_) | None, _) => cell,
        }
    }

    /// The base, in the grid.
    pub(super) fn base(&self, tracks: &Tracks) -> Option<[i32; 2]> {
        let first = || self.grid.surely(tracks.starts().next()??, 0);
        self.base.map(|base| self.northward(base)).or_else(first)
    }

    /// Whether the base is where robot 1 is first, and that is at the border of a cell.
    pub(super) fn is_base_in_doubt(&self, tracks: &Tracks, limits: &Limits) -> bool {
        let first = tracks.starts().next().flatten();
        self.base.is_none()
            && first.is_some_and(|place| self.grid.surely(place, limits.tolerance_mm).is_none())
    }

    /// The free cells of the map in which each robot may be first, if the log has a position of it: the one of the
    /// position itself, or, if that is blocked, those within the tolerance.
    fn starts(&self, tracks: &Tracks, limits: &Limits) -> impl Iterator<Item = Option<Vec<Cell>>> {
        let is_free = |cell: &Cell| self.layout.as_ref().is_some_and(|layout| layout.is_free(*cell));
        let free = move |place: [f64; 2], tolerance_mm: u32| -> Vec<Cell> {
            let touched = self.grid.touched(place, tolerance_mm);
            touched.filter_map(|cell| self.southward(cell)).filter(is_free).collect()
        };
        let tolerance_mm = limits.tolerance_mm;
        tracks.starts().map(move |place| {
            let place = place?;
            let within = free(place, 0);
            Some(if within.is_empty() { free(place, tolerance_mm) } else { within })
        })
    }

    /// A robot that is not first in a free cell of the map.
    pub(super) fn astray(&self, tracks: &Tracks, limits: &Limits) -> Option<u32> {
        let mut starts = (0..).zip(self.starts(tracks, limits));
        starts.find_map(|(robot, cells)| cells.is_some_and(|cells| cells.is_empty()).then_some(robot))
    }

    /// The cells that robots can reach from where they are first, in the grid.
    pub(super) fn reachable(&self, tracks: &Tracks, limits: &Limits) -> Vec<[i32; 2]> {
        let Some(layout) = &self.layout else { return Vec::new() };
        let starts: Vec<Cell> = self.starts(tracks, limits).flatten().flatten().collect();
        layout.reachable(&starts).into_iter().map(|cell| self.northward(cell)).collect()
    }
}

impl Ground for LogMap {
    fn is_free(&self, cell: [i32; 2]) -> bool {
        self.southward(cell)
            .is_some_and(|cell| self.layout.as_ref().is_none_or(|layout| layout.is_free(cell)))
    }

    fn is_open(&self, cell: [i32; 2], beside: [i32; 2]) -> bool {
        let (Some(layout), Some(from), Some(to)) =
            (&self.layout, self.southward(cell), self.southward(beside))
        else {
            return true;
        };
        let side = Side::ALL.into_iter().find(|&side| from.beyond(side) == to);
        side.is_some_and(|side| layout.is_open(Edge::new(from, side)))
    }
}

/// The bytes of a file, at most so many; `smaller` is what to do about one that has more.
pub(crate) fn bytes(file: &Path, most: u64, smaller: &str) -> Result<Vec<u8>, Diagnostic> {
    let unread = |error| Diagnostic::in_file(file, unreadable(&error), "name a file that can be read");
    let mut bytes = Vec::new();
    let opened = File::open(file).map_err(unread)?;
    opened.take(most + 1).read_to_end(&mut bytes).map_err(unread)?;
    if bytes.len() as u64 > most {
        let what = format!("the file has more than {} MiB", most >> 20);
        return Err(Diagnostic::in_file(file, what, smaller));
    }
    Ok(bytes)
}

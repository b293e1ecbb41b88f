//! A map in cells larger than its pixels, for robots that are discs. A robot stands in the middle of a cell; the cell
//! is free if the disc meets no blocked pixel there, and a side is open if it meets none on the straight way to the
//! middle of the next cell. Beyond the rim of the map everything is blocked.

use tautline_io::diagnostic::Diagnostic;
use tautline_kernel::ground::{Cell, Edge, Side};

use super::Layout;

/// The size of cells and robots on a map whose pixels have one.
#[derive(Clone, Copy, PartialEq, Default, Debug)]
pub struct Coarse {
    /// The side of a cell in metres, a whole number of pixels; a pixel if nobody says.
    pub cell_m: Option<f64>,
    /// The radius of a robot in metres; if nobody says, half the side of a cell.
    pub radius_m: Option<f64>,
}

/// How far a cell's side may be from a whole number of pixels, in pixels: metres are decimal fractions.
const ROUNDING: f64 = 1e-6;

impl Coarse {
    /// Whether it changes nothing.
    pub(super) fn is_plain(self) -> bool {
        self == Self::default()
    }

    /// `pixels`, each of which is `resolution_m` metres wide, in such cells.
    ///
    /// # Errors
    /// A [`Diagnostic`] if a cell is no whole number of pixels, or too large for the map, or no cell is free.
    pub(super) fn of(self, pixels: &Layout, resolution_m: f64) -> Result<Layout, Diagnostic> {
        let cell = self.cell_m.unwrap_or(resolution_m) / resolution_m;
        let side = cell.round();
        if !(cell > 0.0 && cell.is_finite()) {
            return Err(Diagnostic::of_field("cell", "a cell has no such side", "give metres above 0"));
        }
        if side < 1.0 || (cell - side).abs() >= ROUNDING {
            let [below, above] = [cell.floor(), cell.floor() + 1.0];
            let what = format!("a cell is no whole number of pixels, which are {resolution_m} m wide");
            let more = if below < 1.0 { String::new() } else { format!("{:.3} or ", below * resolution_m) };
            let remedy = format!("take a `cell` of {more}{:.3}", above * resolution_m);
            return Err(Diagnostic::of_field("cell", what, remedy));
        }
        let (width, height) = (pixels.width(), pixels.height());
        if side > f64::from(width.min(height)) {
            let what =
                format!("the map has {width}×{height} pixels of {resolution_m} m: no cell fits into it");
            let remedy =
                format!("take a `cell` of at most {:.3}", f64::from(width.min(height)) * resolution_m);
            return Err(Diagnostic::of_field("cell", what, remedy));
        }
        let radius = self.radius_m.map_or(side / 2.0, |radius_m| radius_m / resolution_m);
        if !(radius >= 0.0 && radius.is_finite()) {
            let remedy = "give metres from 0 on";
            return Err(Diagnostic::of_field("radius", "a robot has no such radius", remedy));
        }
        let side = side as i16;
        let mut layout = Layout::open((width / side) as u64, (height / side) as u64)?;
        let middle = |cell: Cell| [cell.x, cell.y].map(|place| (f64::from(place) + 0.5) * f64::from(side));
        for cell in layout.cells() {
            if !is_clear(pixels, radius, middle(cell), middle(cell)) {
                layout.block(cell);
            }
        }
        for cell in layout.cells() {
            for way in [Side::East, Side::South] {
                let next = cell.beyond(way);
                let is_between = layout.is_free(cell) && layout.is_free(next);
                if is_between && !is_clear(pixels, radius, middle(cell), middle(next)) {
                    layout.build_wall(Edge::new(cell, way));
                }
            }
        }
        if layout.free_cells() == 0 {
            let what = "no cell is free for a robot of this radius";
            return Err(Diagnostic::of_field("radius", what, "give a smaller `radius`, or a smaller `cell`"));
        }
        Ok(layout)
    }
}

/// Whether a disc meets no blocked pixel on the way between two points on a line along the rows or the columns, all in
/// pixels. To touch is not to meet.
fn is_clear(pixels: &Layout, radius: f64, from: [f64; 2], to: [f64; 2]) -> bool {
    let [columns, rows] =
        [0, 1].map(|axis| (from[axis] - radius).floor() as i16..=(to[axis] + radius).floor() as i16);
    // A point on the rim of pixels is in none of them.
    let gap = |axis: usize, place: i16| {
        let (low, high) = (f64::from(place), f64::from(place) + 1.0);
        (low - to[axis]).max(from[axis] - high)
    };
    rows.into_iter().all(|y| {
        columns.clone().all(|x| {
            let (across, down) = (gap(0, x), gap(1, y));
            let is_met = if radius == 0.0 {
                across < 0.0 && down < 0.0
            } else {
                libm::hypot(across.max(0.0), down.max(0.0)) < radius
            };
            !is_met || pixels.is_free(Cell::new(x, y))
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pixels(blocked: &[(i16, i16)]) -> Layout {
        let open = Layout::open(8, 4).expect("a layout");
        open.with_blocked(blocked.iter().map(|&(x, y)| Cell::new(x, y)))
    }

    fn coarse(cell_m: f64, radius_m: Option<f64>) -> Coarse {
        Coarse { cell_m: Some(cell_m), radius_m }
    }

    #[test]
    fn a_cell_is_free_where_the_robot_fits() {
        let map = pixels(&[(0, 0)]);
        let whole = coarse(0.2, None).of(&map, 0.05).expect("a map");
        assert_eq!((whole.width(), whole.height(), whole.free_cells()), (2, 1, 1));
        let small = coarse(0.2, Some(0.05)).of(&map, 0.05).expect("a map");
        assert_eq!((small.free_cells(), small.walls().count()), (2, 0));
    }

    #[test]
    fn a_thing_between_two_cells_is_a_wall() {
        let map = pixels(&[(4, 1)]);
        let layout = coarse(0.2, Some(0.04)).of(&map, 0.05).expect("a map");
        assert_eq!((layout.free_cells(), layout.walls().count()), (2, 1));
        let thin = coarse(0.2, Some(0.0)).of(&pixels(&[(4, 0)]), 0.05).expect("a map");
        assert_eq!((thin.free_cells(), thin.walls().count()), (2, 0));
    }

    #[test]
    fn sizes_that_fit_nothing_are_refused() {
        let said = |coarse: Coarse| coarse.of(&pixels(&[]), 0.05).expect_err("a fault").to_string();
        let refused = [coarse(0.12, None), coarse(0.02, None), coarse(0.5, None), coarse(f64::NAN, None)]
            .into_iter()
            .chain([-0.1, f64::INFINITY, 3.0].map(|radius_m| coarse(0.2, Some(radius_m))));
        let refused: Vec<String> = refused.map(said).collect();
        insta::assert_snapshot!(refused.join("\n"), @r"
        a cell is no whole number of pixels, which are 0.05 m wide; take a `cell` of 0.100 or 0.150
        a cell is no whole number of pixels, which are 0.05 m wide; take a `cell` of 0.050
        the map has 8×4 pixels of 0.05 m: no cell fits into it; take a `cell` of at most 0.200
        a cell has no such side; give metres above 0
        a robot has no such radius; give metres from 0 on
        a robot has no such radius; give metres from 0 on
        no cell is free for a robot of this radius; give a smaller `radius`, or a smaller `cell`
        ");
    }
}

//! The map that a team has made, as ROS has it: an occupancy grid of one pixel for each cell, which `explore` reads again.

use tautline_kernel::ground::{Cell, Side};
use tautline_sim::explore::{Report, Setup};

/// The shades of a map: of cells that are free, occupied and unknown.
const SHADES: [u8; 3] = [254, 0, 205];

/// The description of the map in the image that is called so. A cell counts as one metre wide.
pub(super) fn description(image: &str) -> String {
    format!(
        "image: {image}\nmode: trinary\nresolution: 1.0\norigin: [0.0, 0.0, 0.0]\nnegate: 0\noccupied_thresh: 0.65\n\
         free_thresh: 0.196\n"
    )
}

/// The image: a cell that a robot was in is free, and a blocked one beside such a cell is occupied.
pub(super) fn image(setup: &Setup, report: &Report) -> Vec<u8> {
    let area = report.chart.area();
    let is_explored = |cell| report.chart.step(cell).is_some();
    let [free, occupied, unknown] = SHADES;
    let shade = |cell: Cell| {
        let is_met = || Side::ALL.iter().any(|&side| is_explored(cell.beyond(side)));
        match (is_explored(cell), setup.layout.is_free(cell)) {
            (true, _) => free,
            (false, false) if is_met() => occupied,
            (false, _) => unknown,
        }
    };
    let mut image = format!("P5\n{} {}\n255\n", area.width(), area.height()).into_bytes();
    image.extend(area.cells().map(shade));
    image
}

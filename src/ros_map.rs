//! The map that a team has made, as ROS has it: an occupancy grid of one pixel for each cell, which `explore` reads again.

use tautline_kernel::ground::Cell;
use tautline_sim::draw::svg::known;
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

/// The image.
pub(super) fn image(setup: &Setup, report: &Report) -> Vec<u8> {
    let area = report.chart.area();
    let [free, occupied, unknown] = SHADES;
    let shade = |cell: Cell| match known(setup, report, cell) {
        Some(true) => free,
        Some(false) => occupied,
        None => unknown,
    };
    let mut image = format!("P5\n{} {}\n255\n", area.width(), area.height()).into_bytes();
    image.extend(area.cells().map(shade));
    image
}

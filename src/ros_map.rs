//! The map that a team has made, as ROS has it: an occupancy grid of one pixel
//! for each cell, which `explore` reads again.

use std::path::Path;

use tautline_grids::layout::is_ros;
use tautline_grids::layout::ros::Frame;
use tautline_io::atomic_file::ROS_HEADS;
use tautline_io::diagnostic::Diagnostic;
use tautline_kernel::ground::Cell;
use tautline_sim::draw::svg::known;
use tautline_sim::explore::{Report, Setup};

use super::layout_args::LayoutArgs;

/// The shades of a map: of cells that are free, occupied and unknown.
const SHADES: [u8; 3] = [254, 0, 205];

/// Where the cells of the layout lie of which a map is to stand at `path`.
///
/// # Errors
/// A [`Diagnostic`] if that is no name of a map, or the layout has walls, for which a map has no place.
pub(super) fn frame(path: &Path, layout: &LayoutArgs, setup: &Setup) -> Result<Frame, Diagnostic> {
    if !is_ros(path) {
        let remedy = "name a file that ends in .yaml";
        return Err(Diagnostic::in_file(path, "a map of ROS has another name", remedy));
    }
    if setup.layout.walls().next().is_some() {
        let what = "the layout has walls between cells, and a map of ROS has room for blocked cells alone";
        return Err(Diagnostic::of_field("map", what, "leave --map out; a recording has walls, with --mcap"));
    }
    layout.frame(&setup.layout)
}

/// The description of the map in the image that is called so, where the cells of the layout lie in this frame.
pub(super) fn description(image: &str, frame: Frame, setup: &Setup, report: &Report) -> String {
    let (area, cell_m) = (report.chart.area(), frame.resolution_m);
    let [along, up] = [area.first().x, setup.layout.height() - 1 - area.last().y];
    let Frame { x_m, y_m, yaw_rad, .. } = frame.moved(f64::from(along) * cell_m, f64::from(up) * cell_m);
    format!(
        "{}image: {image}\nmode: trinary\nresolution: {cell_m}\norigin: [{x_m}, {y_m}, {yaw_rad}]\nnegate: 0\n\
         occupied_thresh: 0.65\nfree_thresh: 0.196\n",
        ROS_HEADS[0]
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
    let mut image = format!("{}{} {}\n255\n", ROS_HEADS[1], area.width(), area.height()).into_bytes();
    image.extend(area.cells().map(shade));
    image
}

//! The layout that a command is given: a file or a generator, and how a ROS map is read.

use std::path::{Path, PathBuf};

use clap::Args;
use tautline_grids::layout::ros::{self, Frame};
use tautline_grids::layout::{self, Coarse, Generator, Layout};
use tautline_io::diagnostic::Diagnostic;
use tautline_io::value_parser::{number, real};

use super::options::refuse_needless;
use super::value_parser::file_or_word;

#[derive(Debug, Args)]
pub(super) struct LayoutArgs {
    /// A layout file or a generator.
    #[arg(value_parser = file_or_word())]
    pub(super) layout: String,
    /// The seed of whatever is left to chance. Without it 0.
    #[arg(long, value_parser = number::<u64>)]
    pub(super) seed: Option<u64>,
    /// The image of a ROS map, in place of the one that it names.
    #[arg(long, value_name = "FILE")]
    pub(super) image: Option<PathBuf>,
    #[command(flatten)]
    coarse: CoarseArgs,
}

#[derive(Debug, Args)]
struct CoarseArgs {
    /// The side of a cell of a ROS map, in metres: a whole number of pixels. Without it a cell is a pixel.
    #[arg(long = "cell", value_name = "METRES", value_parser = real, allow_hyphen_values = true)]
    cell_m: Option<f64>,
    /// The radius of a robot on a ROS map, in metres: cells and ways between them are free where it fits. Without it
    /// half the side of a cell.
    #[arg(long = "radius", value_name = "METRES", value_parser = real, allow_hyphen_values = true)]
    radius_m: Option<f64>,
}

impl LayoutArgs {
    pub(super) fn seed(&self) -> u64 {
        self.seed.unwrap_or(0)
    }

    /// The files that this is read from.
    pub(super) fn inputs(&self) -> Vec<PathBuf> {
        layout::inputs(&self.layout, self.image.as_deref())
    }

    /// Refuses what only a ROS map can be told.
    ///
    /// # Errors
    /// A [`Diagnostic`] if something of it is told.
    pub(super) fn refuse_map_options(&self, why: &str) -> Result<(), Diagnostic> {
        let CoarseArgs { cell_m, radius_m } = self.coarse;
        let (image, cell, radius) = (self.image.is_some(), cell_m.is_some(), radius_m.is_some());
        refuse_needless([("--image", image), ("--cell", cell), ("--radius", radius)], why)
    }

    /// The layout.
    pub(super) fn load(&self) -> Result<Layout, Diagnostic> {
        let Self { layout, image, coarse, .. } = self;
        let coarse = Coarse { cell_m: coarse.cell_m, radius_m: coarse.radius_m };
        layout::load_coarse(layout, self.seed(), image.as_deref(), coarse)
    }

    /// Where the cells of `layout`, which was loaded, lie: as a ROS map says; else they are a metre wide.
    ///
    /// # Errors
    /// A [`Diagnostic`] if the ROS map cannot be read again.
    pub(super) fn frame(&self, layout: &Layout) -> Result<Frame, Diagnostic> {
        let file = Path::new(&self.layout);
        if !layout::is_ros(file) || self.layout.parse::<Generator>().is_ok() {
            return Ok(Frame::METRES);
        }
        let (pixels, frame) = ros::load(file, self.image.as_deref())?;
        let cell_m = self.coarse.cell_m.unwrap_or(frame.resolution_m);
        Ok(frame.of_cells(pixels.height(), cell_m, layout.height()))
    }

    /// Whether a seed is given that the layout leaves unused.
    pub(super) fn has_other_seed(&self) -> bool {
        let is_random = || self.layout.parse::<Generator>().is_ok_and(|generator| generator.is_random());
        self.seed.is_some() && !is_random()
    }
}

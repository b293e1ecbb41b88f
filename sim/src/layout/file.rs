//! The LAYOUT argument of the command line: a generator's description, or a file of one of the three formats.

use std::ffi::OsString;
use std::iter;
use std::path::{Path, PathBuf};

use tautline_proofs::plural::counted;

use super::generate::Form;
use super::read::{at, in_file, read_text};
use super::{Generator, Layout, Misread, Problem, movingai, ros, text};
use crate::diagnostic::Diagnostic;

/// The layout that `description` names: a generator's, for `seed`, or else that of a file: a `MovingAI` map
/// (`.map`), a ROS map (`.yaml`, `.yml`), or a drawing of ours. `image` takes the place of the image that a
/// ROS map names. A yaw of a ROS map is logged as a warning, as the cells are those of the image.
///
/// # Errors
/// A [`Diagnostic`] that names the file, the line and the column, or what is wrong with the description.
pub fn load(description: &str, seed: u64, image: Option<&Path>) -> Result<Layout, Diagnostic> {
    let layout = make(description, seed, image)?;
    let (size, free, walls) = (layout.size(), layout.free_cells(), layout.walls().count());
    tracing::info!(
        "layout {description}: {size} cells, {free} free, {} between them",
        counted(walls, "wall")
    );
    Ok(layout)
}

fn make(description: &str, seed: u64, image: Option<&Path>) -> Result<Layout, Diagnostic> {
    let file = Path::new(description);
    match description.parse::<Generator>() {
        Ok(_) if image.is_some() => Err(Problem::needless_image().into()),
        Ok(generator) => generator.generate(seed).map_err(Diagnostic::from),
        Err(problem) if means_generator(description) && !file.exists() => Err(problem.into()),
        Err(_) => load_file(file, image),
    }
}

/// The files that [`load`] reads for these arguments.
pub fn inputs(description: &str, image: Option<&Path>) -> Vec<PathBuf> {
    let file = PathBuf::from(description);
    if description.parse::<Generator>().is_ok() {
        return Vec::new();
    }
    let image = image.map(Path::to_owned).or_else(|| is_ros(&file).then(|| ros::image(&file)).flatten());
    iter::once(file).chain(image).collect()
}

/// The end of a file's name, in small letters.
fn extension(file: &Path) -> OsString {
    file.extension().unwrap_or_default().to_ascii_lowercase()
}

/// Whether the name is that of a ROS map.
fn is_ros(file: &Path) -> bool {
    matches!(extension(file).to_str(), Some("yaml" | "yml"))
}

/// Whether a description that is no generator was meant as one: it names one, or looks like none of the
/// paths.
fn means_generator(description: &str) -> bool {
    Form::of(description).is_some() || description.contains(':') && !description.contains(['/', '\\'])
}

/// The problem of an image in place of the YAML file that describes it.
fn bare_image() -> Problem {
    Problem::new("this is an image alone", "name the .yaml file that describes it")
}

fn load_file(file: &Path, image: Option<&Path>) -> Result<Layout, Diagnostic> {
    if is_ros(file) {
        let (layout, frame) = ros::load(file, image)?;
        if frame.yaw_rad != 0.0 {
            let name = file.display();
            tracing::warn!("{name} is turned by {} rad; cells are those of its image", frame.yaw_rad);
        }
        return Ok(layout);
    }
    let read: fn(&str) -> Result<Layout, Misread> = match extension(file).to_str() {
        Some("pgm" | "png") => return Err(in_file(file, &bare_image())),
        Some("map") => movingai::read,
        Some(_) | None => text::read,
    };
    if image.is_some() {
        return Err(Problem::needless_image().into());
    }
    let source = read_text(file)?;
    read(&source).map_err(|misread| at(file, &source, &misread))
}

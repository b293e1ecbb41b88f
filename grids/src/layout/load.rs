//! A layout by its description: a generator's, or the name of a file, whose end tells the format.

use std::ffi::OsString;
use std::iter;
use std::path::{Path, PathBuf};

use tautline_io::diagnostic::Diagnostic;

use super::file::{Misread, at, read_text};
use super::form::Form;
use super::{Coarse, Generator, Layout, movingai, ros, text};

/// The layout that `description` names: a generator's, for `seed`, or else that of a file: a `MovingAI` map
/// (`.map`), a ROS map (`.yaml`, `.yml`), or a drawing of ours. `image` takes the place of the image that a
/// ROS map names. A yaw of a ROS map is logged as a warning, as the cells are those of the image.
///
/// # Errors
/// A [`Diagnostic`] that names the file, the line and the column, or what is wrong with the description.
pub fn load(description: &str, seed: u64, image: Option<&Path>) -> Result<Layout, Diagnostic> {
    load_coarse(description, seed, image, Coarse::default())
}

/// As [`load`], a ROS map in cells of this size.
///
/// # Errors
/// As of [`load`], or if this is no ROS map, or has no such cells.
pub fn load_coarse(
    description: &str,
    seed: u64,
    image: Option<&Path>,
    coarse: Coarse,
) -> Result<Layout, Diagnostic> {
    let layout = make(description, seed, image, coarse)?;
    let (size, free, walls) = (layout.size(), layout.free_cells(), layout.walls().count());
    tracing::info!("layout {description}: {size} cells, {free} free; walls between them: {walls}");
    Ok(layout)
}

fn make(description: &str, seed: u64, image: Option<&Path>, coarse: Coarse) -> Result<Layout, Diagnostic> {
    let file = Path::new(description);
    match description.parse::<Generator>() {
        Ok(generator) => check_needless(image, coarse).and_then(|()| generator.generate(seed)),
        Err(problem) if means_generator(description) && !file.exists() => Err(problem),
        Err(_) => load_file(file, image, coarse),
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
pub fn is_ros(file: &Path) -> bool {
    matches!(extension(file).to_str(), Some("yaml" | "yml"))
}

/// Whether a description that is no generator was meant as one: it names one, or looks like none of the
/// paths.
fn means_generator(description: &str) -> bool {
    Form::of(description).is_some() || description.contains(':') && !description.contains(['/', '\\'])
}

/// Checks that nothing is given that has a meaning for ROS maps alone.
fn check_needless(image: Option<&Path>, coarse: Coarse) -> Result<(), Diagnostic> {
    if image.is_some() {
        let what = "`image` is given, but the layout is not a ROS map";
        return Err(Diagnostic::of_field("image", what, "leave `image` out, or name the map's .yaml file"));
    }
    if !coarse.is_plain() {
        let what = "`cell` or `radius` is given, but the layout is not a ROS map, which has metres";
        return Err(Diagnostic::of_field("cell", what, "leave them out, or name the map's .yaml file"));
    }
    Ok(())
}

fn load_file(file: &Path, image: Option<&Path>, coarse: Coarse) -> Result<Layout, Diagnostic> {
    if is_ros(file) {
        let (layout, frame) = ros::load(file, image)?;
        if frame.yaw_rad != 0.0 {
            let name = file.display();
            tracing::warn!("{name} is turned by {} rad; cells are those of its image", frame.yaw_rad);
        }
        return if coarse.is_plain() { Ok(layout) } else { coarse.of(&layout, frame.resolution_m) };
    }
    let read: fn(&str) -> Result<Layout, Misread> = match extension(file).to_str() {
        Some("pgm" | "png") => {
            let (what, remedy) = ("this is an image alone", "name the .yaml file that describes it");
            return Err(Diagnostic::in_file(file, what, remedy));
        }
        Some("map") => movingai::read,
        Some(_) | None => text::read,
    };
    check_needless(image, coarse)?;
    let source = read_text(file)?;
    read(&source).map_err(|misread| at(file, &source, &misread))
}

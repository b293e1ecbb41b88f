//! The LAYOUT argument of the command line: a generator's description, or a file of one of the three formats.

use std::ffi::OsString;
use std::fs::{self, File};
use std::io::{self, Read};
use std::iter;
use std::path::{Path, PathBuf};

use tautline_proofs::words::counted;

use super::generate::Form;
use super::{Generator, Layout, Misread, Problem, movingai, ros, text};
use crate::fault::Fault;

/// Larger files are refused before they are read. The drawing of the largest layout is smaller.
pub const MAX_FILE_BYTES: u64 = 128 << 20;

/// The layout that `description` names: a generator's, for `seed`, or else that of a file: a `MovingAI` map
/// (`.map`), a ROS map (`.yaml`, `.yml`), or a drawing of ours. `image` takes the place of the image that a
/// ROS map names. A yaw of a ROS map is logged as a warning, as the cells are those of the image.
///
/// # Errors
/// A [`Fault`] that names the file, the line and the column, or what is wrong with the description.
pub fn load(description: &str, seed: u64, image: Option<&Path>) -> Result<Layout, Fault> {
    let layout = make(description, seed, image)?;
    let (size, free, walls) = (layout.size(), layout.free_cells(), layout.walls().count());
    tracing::info!(
        "layout {description}: {size} cells, {free} free, {} between them",
        counted(walls, "wall")
    );
    Ok(layout)
}

fn make(description: &str, seed: u64, image: Option<&Path>) -> Result<Layout, Fault> {
    let file = Path::new(description);
    match description.parse::<Generator>() {
        Ok(_) if image.is_some() => Err(usage(&Problem::NeedlessImage)),
        Ok(generator) => generator.generate(seed).map_err(|problem| usage(&problem)),
        Err(problem) if means_generator(description) && !file.exists() => Err(usage(&problem)),
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

fn load_file(file: &Path, image: Option<&Path>) -> Result<Layout, Fault> {
    if is_ros(file) {
        let (layout, frame) = ros::load(file, image)?;
        if frame.yaw_rad != 0.0 {
            let name = file.display();
            tracing::warn!("{name} is turned by {} rad; cells are those of its image", frame.yaw_rad);
        }
        return Ok(layout);
    }
    let read: fn(&str) -> Result<Layout, Misread> = match extension(file).to_str() {
        Some("pgm" | "png") => return Err(in_file(file, &Problem::BareImage)),
        Some("map") => movingai::read,
        Some(_) | None => text::read,
    };
    if image.is_some() {
        return Err(usage(&Problem::NeedlessImage));
    }
    let source = read_text(file)?;
    read(&source).map_err(|misread| at(file, &source, &misread))
}

/// The text of `file`.
pub(super) fn read_text(file: &Path) -> Result<String, Fault> {
    let bytes = read_bytes(file).map_err(|problem| in_file(file, &problem))?;
    let not_text = |byte| in_file(file, &Problem::NotText { byte });
    String::from_utf8(bytes).map_err(|error| not_text(error.utf8_error().valid_up_to()))
}

/// The bytes of `file`, at least one and at most [`MAX_FILE_BYTES`].
pub(super) fn read_bytes(file: &Path) -> Result<Vec<u8>, Problem> {
    let about = fs::metadata(file).map_err(|error| unreadable(&error))?;
    if about.is_dir() {
        return Err(Problem::Directory);
    }
    if about.len() > MAX_FILE_BYTES {
        return Err(Problem::TooLarge);
    }
    let mut bytes = Vec::new();
    let opened = File::open(file).map_err(|error| unreadable(&error))?;
    opened.take(MAX_FILE_BYTES + 1).read_to_end(&mut bytes).map_err(|error| unreadable(&error))?;
    match bytes.len() as u64 {
        0 => Err(Problem::Empty),
        size @ 1..=MAX_FILE_BYTES => {
            tracing::info!("read {}: {}", file.display(), counted(size, "byte"));
            Ok(bytes)
        }
        _ => Err(Problem::TooLarge),
    }
}

fn unreadable(error: &io::Error) -> Problem {
    if error.kind() == io::ErrorKind::NotFound {
        Problem::NoFile
    } else {
        Problem::Unreadable(error.to_string())
    }
}

/// The fault of a problem in a text.
pub(super) fn at(file: &Path, source: &str, misread: &Misread) -> Fault {
    Fault::at(file, source, misread.at.clone(), &misread.problem, misread.problem.remedy())
}

/// The fault of a problem with a file as a whole.
pub(super) fn in_file(file: &Path, problem: &Problem) -> Fault {
    Fault::in_file(file, problem, problem.remedy())
}

/// The fault of a problem with the command line.
pub(super) fn usage(problem: &Problem) -> Fault {
    Fault::usage(problem, problem.remedy())
}

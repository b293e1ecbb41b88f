//! Maps of the ROS `map_server`: a YAML file that describes an image, PGM or PNG. One pixel is one cell, and
//! the top row of the image is row 0, while ROS counts rows from the lower left: in an image of `height` rows
//! the centre of the cell x,y lies (x + ½)·resolution along and (height − y − ½)·resolution up from the
//! origin, both turned about it by the yaw. A pixel of mean colour v has the occupancy (255 − v)/255, with
//! `negate` v/255; it is free below `free_thresh`, else, occupied or unknown, blocked; so is a pixel that is
//! not opaque. That is the meaning of the modes `trinary` and `scale`; in `raw` pixels are no occupancies,
//! and it is refused.

use std::ops::{Range, RangeInclusive};
use std::path::{Path, PathBuf};

use tautline_io::diagnostic::Diagnostic;
use tautline_kernel::ground::Cell;

use super::Layout;
use super::file::{Misread, at, read_bytes, read_text};
use super::image::{Pixel, decode, unread_image};
use super::yaml::{FIELDS, Mapping, no_map};

/// Where the cells of a map lie in the world.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Frame {
    /// The side of a cell in metres.
    pub resolution_m: f64,
    /// The lower left corner of the image in metres, eastwards.
    pub x_m: f64,
    /// The lower left corner of the image in metres, northwards.
    pub y_m: f64,
    /// How far the image is turned about that corner, counterclockwise, in radians.
    pub yaw_rad: f64,
}

impl Frame {
    /// Cells of a metre, from 0,0 on.
    pub const METRES: Self = Self { resolution_m: 1.0, x_m: 0.0, y_m: 0.0, yaw_rad: 0.0 };

    /// This frame from another corner: so far along the rows of the image, and so far up its columns.
    #[must_use]
    pub fn moved(self, along_m: f64, up_m: f64) -> Self {
        let (sine, cosine) = libm::sincos(self.yaw_rad);
        let (x_m, y_m) = (along_m * cosine - up_m * sine, along_m * sine + up_m * cosine);
        Self { x_m: self.x_m + x_m, y_m: self.y_m + y_m, ..self }
    }

    /// The frame of cells of this width over an image of so many rows of pixels, of which this is the frame. The rows
    /// of cells begin at the upper rim, and pixels below the last one are in none.
    #[must_use]
    pub fn of_cells(self, pixel_rows: i16, cell_m: f64, rows: i16) -> Self {
        let upper = self.moved(0.0, f64::from(pixel_rows) * self.resolution_m);
        Self { resolution_m: cell_m, ..upper.moved(0.0, -(f64::from(rows) * cell_m)) }
    }
}

/// A checked description of an image.
#[derive(Clone, PartialEq, Debug)]
pub struct Description {
    /// The image as the file names it.
    pub image: String,
    /// The bytes of the file that name the image.
    pub image_at: Range<usize>,
    /// Where the cells lie.
    pub frame: Frame,
    free_below: f64,
    shade: Shade,
}

/// The meaning of a bright pixel.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Shade {
    BrightIsFree,
    BrightIsOccupied,
}

/// Reads the map that `file` describes; `image` takes the place of the image named there, whose path is
/// relative to the folder of `file`.
///
/// # Errors
/// A [`Diagnostic`] in `file` or in the image; a missing image names the path that was tried.
pub fn load(file: &Path, image: Option<&Path>) -> Result<(Layout, Frame), Diagnostic> {
    let source = read_text(file)?;
    let description = describe(&source).map_err(|misread| at(file, &source, &misread))?;
    let beside = file.with_file_name(&description.image);
    let path = image.unwrap_or(&beside);
    let bytes = read_bytes(path).map_err(|problem| match (problem, image) {
        (_, given) if !path.exists() => {
            let what = format!("the image {} is not there", path.display());
            let problem = Diagnostic::of_field("image", what, "name another image with `image` FILE");
            match given {
                Some(_) => problem,
                None => at(file, &source, &Misread { at: description.image_at.clone(), problem }),
            }
        }
        (problem, _) => unread_image(problem.what()).found_in(path),
    })?;
    let layout = read(&description, &bytes).map_err(|problem| problem.found_in(path))?;
    Ok((layout, description.frame))
}

/// The image that `file` names, if it can be read.
pub(super) fn image(file: &Path) -> Option<PathBuf> {
    let description = describe(&read_text(file).ok()?).ok()?;
    Some(file.with_file_name(description.image))
}

/// The side of a pixel. Beyond, places in metres are no numbers, or those of neighbours are the same.
const RESOLUTION_M: RangeInclusive<f64> = 1e-6..=1e6;

/// How far off the origin may be.
const FARTHEST_M: f64 = 1e9;

/// Reads the YAML file.
///
/// # Errors
/// The first [`Diagnostic`] and the bytes it lies in: no YAML, a field missing, a number out of bounds, another
/// mode.
pub fn describe(source: &str) -> Result<Description, Misread> {
    let map = Mapping::read(source)?;
    let (image, negate) = (map.scalar("image")?, map.scalar("negate")?);
    let (metres, metres_at) = map.number("resolution")?;
    let ([x_m, y_m, yaw_rad], origin_at) = map.numbers("origin")?;
    let (occupied_above, occupied_at) = map.number("occupied_thresh")?;
    let (free_below, free_at) = map.number("free_thresh")?;
    // Written as 0 and 1 by some map savers, as a truth value by others.
    let shade = match negate.text.as_str() {
        "0" | "false" => Ok(Shade::BrightIsFree),
        "1" | "true" => Ok(Shade::BrightIsOccupied),
        other if other.parse::<u8>().is_ok() => Err(out_of_bounds(&negate.at, "negate", "write 0 or 1")),
        _ => return Err(no_map(&negate.at, "expected 0 or 1", FIELDS)),
    };
    if !RESOLUTION_M.contains(&metres) {
        let allowed = "write the metres of a pixel's side, from 0.000001 to 1000000";
        return Err(out_of_bounds(&metres_at, "resolution", allowed));
    }
    if ![x_m, y_m, yaw_rad].iter().all(|number| number.abs() <= FARTHEST_M) {
        let allowed = "write x and y in metres and the yaw in radians, each at most 1000000000";
        return Err(out_of_bounds(&origin_at, "origin", allowed));
    }
    if !(0.0..=1.0).contains(&occupied_above) {
        return Err(out_of_bounds(&occupied_at, "occupied_thresh", "write a number from 0 to 1"));
    }
    if !(0.0..=occupied_above).contains(&free_below) {
        return Err(out_of_bounds(&free_at, "free_thresh", "write a number from 0 to `occupied_thresh`"));
    }
    let shade = shade?;
    if map.has("mode") {
        let mode = map.scalar("mode")?;
        if !matches!(mode.text.as_str(), "trinary" | "scale") {
            let what = format!("the mode {:?} is not supported", mode.text);
            let problem = Diagnostic::usage(what, "save the map in mode trinary or scale");
            return Err(Misread { at: mode.at.clone(), problem });
        }
    }
    Ok(Description {
        image_at: image.at.clone(),
        image: image.text.clone(),
        frame: Frame { resolution_m: metres, x_m, y_m, yaw_rad },
        free_below,
        shade,
    })
}

/// The problem of a field whose value, in the bytes `at`, is out of bounds.
fn out_of_bounds(at: &Range<usize>, field: &str, allowed: &str) -> Misread {
    Misread { at: at.clone(), problem: Diagnostic::usage(format!("`{field}` is out of bounds"), allowed) }
}

/// Reads the image that `description` describes, from the `bytes` of its file. The size is checked before the
/// pixels are decoded.
///
/// # Errors
/// [`Diagnostic`] if it cannot be read, is too large, or shows no free cell.
pub fn read(description: &Description, bytes: &[u8]) -> Result<Layout, Diagnostic> {
    let (mut layout, pixels) = decode(bytes)?;
    let width = layout.width() as usize;
    for (place, &pixel) in pixels.iter().enumerate() {
        if !description.is_free(pixel) {
            layout.block(Cell::new((place % width) as i16, (place / width) as i16));
        }
    }
    layout.with_free_cell()
}

impl Description {
    fn is_free(&self, [red, green, blue, alpha]: Pixel) -> bool {
        let bright: u32 = [red, green, blue].map(u32::from).iter().sum();
        let occupied = match self.shade {
            Shade::BrightIsFree => 3 * 255 - bright,
            Shade::BrightIsOccupied => bright,
        };
        alpha == u8::MAX && f64::from(occupied) / (3.0 * 255.0) < self.free_below
    }
}

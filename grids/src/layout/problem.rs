//! The faults of layouts, in any of its formats.

use std::fmt;
use std::ops::Range;

use tautline_io::diagnostic::Diagnostic;
use tautline_kernel::ground::Cell;

use super::generate::FORMS;
use super::{MAX_CELLS, MAX_SIDE_CELLS, Size};

/// A problem in the bytes `at` of a text.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Misread {
    /// The bytes of the text.
    pub at: Range<usize>,
    /// The fault in them.
    pub problem: Diagnostic,
}

/// A side or the area is out of bounds.
pub fn of_size(width: u64, height: u64) -> Diagnostic {
    Diagnostic::usage(format_args!("the size {width}x{height} is out of bounds"), sizes())
}

/// Every cell is blocked.
pub fn no_free_cell() -> Diagnostic {
    Diagnostic::usage("no cell is free", "leave at least one cell free for the base")
}

/// The base, or what else is called so, is not inside the rim.
pub fn outside(what: &str, cell: Cell, size: Size) -> Diagnostic {
    let (width, height) = (size.width() - 1, size.height() - 1);
    let remedy = format!("columns go from 0 to {width}, rows from 0 to {height}");
    Diagnostic::usage(format_args!("the {what} {cell} is outside the {size} cells"), remedy)
}

/// There is no such file.
pub(super) fn no_file(what: &str) -> Diagnostic {
    Diagnostic::usage(what, format_args!("name a layout file or one of the generators {}", examples()))
}

/// The image of a ROS map cannot be read or decoded.
pub(super) fn unread_image(message: impl fmt::Display) -> Diagnostic {
    Diagnostic::usage(format_args!("the image cannot be read: {message}"), "give a whole PGM or PNG file")
}

/// An image is named for a layout that has none.
pub(super) fn needless_image() -> Diagnostic {
    let what = "`image` is given, but the layout is not a ROS map";
    Diagnostic::of_field("image", what, "leave `image` out, or name the map's .yaml file")
}

/// The fault of sizes in metres where nothing has any.
pub(super) fn needless_size() -> Diagnostic {
    let what = "`cell` or `radius` is given, but the layout is not a ROS map, which has metres";
    Diagnostic::of_field("cell", what, "leave them out, or name the map's .yaml file")
}

/// How large a layout can be.
pub(super) fn sizes() -> String {
    format!("a layout has 1 to {MAX_SIDE_CELLS} cells on a side and at most {MAX_CELLS} in all")
}

/// A description of each generator.
pub(super) fn examples() -> String {
    FORMS.map(|form| form.example).join(", ")
}

impl fmt::Display for Misread {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "byte {}: {}", self.at.start, self.problem.what())
    }
}

impl std::error::Error for Misread {}

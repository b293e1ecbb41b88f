//! What can be wrong with a layout, in any of its formats: `Display` says what, [`Problem::remedy`] what
//! would be right.

use std::fmt;
use std::ops::Range;

use tautline_kernel::chain::MAX_ROBOTS;
use tautline_kernel::ground::Cell;
use tautline_proofs::plural::counted;

use super::generate::{FORMS, Form};
use super::{MAX_CELLS, MAX_FILE_BYTES, MAX_SIDE_CELLS, Size};
use crate::diagnostic::Diagnostic;

/// A problem in the bytes `at` of a text.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Misread {
    /// The bytes of the text.
    pub at: Range<usize>,
    /// What is wrong with them.
    pub problem: Problem,
}

/// What is wrong with a layout or with the place it should come from.
#[derive(Clone, PartialEq, Eq, Debug)]
#[expect(
    missing_docs,
    reason = "the fields are the numbers and words that the sentence of each problem shows"
)]
pub enum Problem {
    /// A side or the area is out of bounds.
    Size { width: u64, height: u64 },
    /// Every cell is blocked.
    NoFreeCell,
    /// The base is not inside the rim.
    BaseOutside { base: Cell, size: Size },
    /// The base is on a blocked cell.
    BaseBlocked { base: Cell, nearest: Cell },
    /// A start is not inside the rim.
    StartOutside { start: Cell, size: Size },
    /// A start is on a blocked cell.
    StartBlocked { start: Cell, nearest: Cell },

    /// The first line is not that of a drawing.
    NotALayout,
    /// The drawing has a version that this program does not read.
    Version(u32),
    /// The number of robots is none.
    Robots(String),
    /// The northern rim is not where the drawing should begin.
    NoDrawing,
    /// The drawing ends too early.
    CutShort,
    /// The rim has a gap.
    OpenRim,
    /// A second base.
    TwoBases { first: Cell },
    /// A symbol that the format does not know.
    Symbol { found: String, known: &'static str },
    /// A row is longer or shorter than the first one, or than the header says.
    RowLength { found: usize, expected: usize },

    /// A header line of a `MovingAI` map is not as it should be.
    Header { expected: &'static str },
    /// The number of a header line is none.
    Count { found: String, expected: &'static str },
    /// Fewer rows than the header says.
    TooFewRows { found: usize, expected: usize },
    /// More rows than the header says.
    TooManyRows { expected: usize },

    /// The description of a ROS map is not the YAML it should be; the words are the YAML reader's.
    Yaml(String),
    /// A number of a ROS map is out of bounds.
    Number { field: &'static str, allowed: &'static str },
    /// A ROS map is in a mode whose pixels are not occupancies.
    Mode(String),
    /// The image of a ROS map is not there.
    NoImage { tried: String },
    /// The image of a ROS map cannot be read or decoded.
    Image(String),
    /// An image is named for a layout that has none.
    NeedlessImage,
    /// An image is given in place of the YAML file that describes it.
    BareImage,

    /// No generator has this name.
    NoSuchGenerator(String),
    /// The parts of a generator's description are not what they should be.
    Generator { description: String, form: Form },
    /// A probability is none.
    Probability(String),
    /// There are no rooms, or more than cells.
    Rooms { across: u64, down: u64, size: Size },

    /// There is no such file.
    NoFile,
    /// The file is a directory.
    Directory,
    /// The file is above [`MAX_FILE_BYTES`].
    TooLarge,
    /// The file is empty.
    Empty,
    /// The file is not UTF-8 from this byte on.
    NotText { byte: usize },
    /// The file cannot be read; the words are the operating system's.
    Unreadable(String),
}

impl fmt::Display for Problem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Size { width, height } => write!(f, "the size {width}x{height} is out of bounds"),
            Self::NoFreeCell => f.write_str("no cell is free"),
            Self::BaseOutside { base, size } => write!(f, "the base {base} is outside the {size} cells"),
            Self::BaseBlocked { base, nearest } => {
                write!(f, "the base {base} is on a blocked cell; the nearest free cell is {nearest}")
            }
            Self::StartOutside { start, size } => write!(f, "the start {start} is outside the {size} cells"),
            Self::StartBlocked { start, nearest } => {
                write!(f, "the start {start} is on a blocked cell; the nearest free cell is {nearest}")
            }
            Self::NotALayout => f.write_str("this is not the first line of a layout"),
            Self::Version(version) => write!(f, "this is version {version}, this program reads version 1"),
            Self::Robots(count) => write!(f, "{count:?} is no number of robots"),
            Self::NoDrawing => f.write_str("the northern rim should be drawn here"),
            Self::CutShort => f.write_str("the drawing ends before its southern rim"),
            Self::OpenRim => f.write_str("the rim has a gap"),
            Self::TwoBases { first } => write!(f, "a second base; the first is {first}"),
            Self::Symbol { found, known: _ } => write!(f, "the symbol {found:?} is unknown"),
            Self::RowLength { found, expected } => {
                write!(f, "this row has {}, not {expected}", counted(*found, "character"))
            }
            Self::Header { expected } => write!(f, "the header line `{expected}` is missing here"),
            Self::Count { found, expected } => {
                write!(f, "{found:?} is not the number N of the header line `{expected}`")
            }
            Self::TooFewRows { found, expected } => {
                write!(f, "the map has {}, not {expected}", counted(*found, "row"))
            }
            Self::TooManyRows { expected } => {
                write!(f, "this is row {}, but `height` is {expected}", expected + 1)
            }
            Self::Yaml(message) => write!(f, "this does not describe a map: {message}"),
            Self::Number { field, allowed: _ } => write!(f, "`{field}` is out of bounds"),
            Self::Mode(mode) => write!(f, "the mode {mode:?} is not supported"),
            Self::NoImage { tried } => write!(f, "the image {tried} is not there"),
            Self::Image(message) => write!(f, "the image cannot be read: {message}"),
            Self::NeedlessImage => f.write_str("`image` is given, but the layout is not a ROS map"),
            Self::BareImage => f.write_str("this is an image alone"),
            Self::NoSuchGenerator(description) => write!(f, "{description:?} names no generator"),
            Self::Generator { description, form: _ } => {
                write!(f, "{description:?} is not a whole description")
            }
            Self::Probability(p) => write!(f, "{p:?} is no probability"),
            Self::Rooms { across, down, size } => write!(f, "{size} cells cannot hold {across}x{down} rooms"),
            Self::NoFile => f.write_str("there is no such file"),
            Self::Directory => f.write_str("this is a directory"),
            Self::TooLarge => write!(f, "the file has more than {} MiB", MAX_FILE_BYTES >> 20),
            Self::Empty => f.write_str("the file is empty"),
            Self::NotText { byte } => write!(f, "byte {byte} is not UTF-8 text"),
            Self::Unreadable(message) => write!(f, "the file cannot be read: {message}"),
        }
    }
}

impl Problem {
    /// What would be right.
    pub fn remedy(&self) -> String {
        match self {
            Self::Size { .. } | Self::TooLarge => {
                format!("a layout has 1 to {MAX_SIDE_CELLS} cells on a side and at most {MAX_CELLS} in all")
            }
            Self::NoFreeCell => "leave at least one cell free for the base".to_owned(),
            Self::BaseOutside { size, .. } | Self::StartOutside { size, .. } => {
                format!("columns go from 0 to {}, rows from 0 to {}", size.width() - 1, size.height() - 1)
            }
            Self::BaseBlocked { nearest, .. } => format!("put the base on {nearest}"),
            Self::StartBlocked { nearest, .. } => format!("start on {nearest}"),
            Self::NotALayout => {
                "a drawing begins with `tautline layout 1`; name MovingAI maps .map and ROS maps .yaml"
                    .to_owned()
            }
            Self::Version(_) => "write the drawing again with this program".to_owned(),
            Self::Robots(_) => {
                format!("write `robots N` with N from 1 to {MAX_ROBOTS}, or leave the line out")
            }
            Self::NoDrawing => "draw it as `+--+--+`, one `--` for each column".to_owned(),
            Self::CutShort => {
                "a drawing is a line of walls, then for each row a line of cells and a line of walls"
                    .to_owned()
            }
            Self::OpenRim => "close it: `--` in the north and south, `|` in the east and west".to_owned(),
            Self::TwoBases { .. } => "leave one of them".to_owned(),
            Self::Symbol { known, .. } => (*known).to_owned(),
            Self::RowLength { .. } => "make all rows equally long".to_owned(),
            Self::Header { .. } => {
                "a map begins with the lines `type octile`, `height N`, `width N` and `map`".to_owned()
            }
            Self::Count { .. } => format!("write a whole number from 1 to {MAX_SIDE_CELLS}"),
            Self::TooFewRows { .. } | Self::TooManyRows { .. } => {
                "make `height` the number of rows that follow `map`".to_owned()
            }
            Self::Yaml(_) => "a map has the fields image, resolution, origin: [x, y, yaw], negate, \
                              occupied_thresh and free_thresh"
                .to_owned(),
            Self::Number { allowed, .. } => (*allowed).to_owned(),
            Self::Mode(_) => "save the map in mode trinary or scale".to_owned(),
            Self::NoImage { .. } => "name another image with `image` FILE".to_owned(),
            Self::Image(_) => "give a whole PGM or PNG file".to_owned(),
            Self::NeedlessImage => "leave `image` out, or name the map's .yaml file".to_owned(),
            Self::BareImage => "name the .yaml file that describes it".to_owned(),
            Self::NoSuchGenerator(_) => format!("the generators are {}", examples()),
            Self::Generator { form, .. } if form.pattern == form.example => format!("write {}", form.pattern),
            Self::Generator { form, .. } => format!("write {}, for example {}", form.pattern, form.example),
            Self::Probability(_) => "write a number from 0 to 1, for example 0.1".to_owned(),
            Self::Rooms { .. } => {
                "at least one room each way, and at most one for each column and row".to_owned()
            }
            Self::NoFile | Self::Directory => {
                format!("name a layout file or one of the generators {}", examples())
            }
            Self::Empty => "a drawing begins with `tautline layout 1`".to_owned(),
            Self::NotText { .. } => {
                "a layout is a drawing, a MovingAI map or a ROS map's .yaml file".to_owned()
            }
            Self::Unreadable(_) => "make the file readable".to_owned(),
        }
    }
}

fn examples() -> String {
    FORMS.map(|form| form.example).join(", ")
}

impl std::error::Error for Problem {}

impl From<Problem> for Diagnostic {
    fn from(problem: Problem) -> Self {
        let remedy = problem.remedy();
        match problem {
            Problem::NoImage { .. } | Problem::NeedlessImage => Self::of_field("image", problem, remedy),
            problem => Self::usage(problem, remedy),
        }
    }
}

impl fmt::Display for Misread {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "byte {}: {}", self.at.start, self.problem)
    }
}

impl std::error::Error for Misread {}

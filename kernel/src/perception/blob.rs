//! Blobs of light in a picture, and the colours that an LED has in it [Ferranti 2009, IV, “Detecting a sensor LED”].
//!
//! The paper goes through a picture line by line, clusters pixels of the right colours into sets, and sets that overlap
//! those of the lines before into blobs. Ours are these readings:
//!
//! - A *gap* is the number of pixels, or of lines, between two others: 0 between neighbours.
//! - Pixels of the right colours in one line are in one *set* if no gap between them is longer than allowed. A set
//!   reaches from its first pixel to its last, the gaps between them included.
//! - Two sets in different lines *overlap* if they have a column in common and the gap between their lines is no longer
//!   than allowed, whatever is in the lines between. So with a gap of 0, pixels that touch at a corner only are apart.
//! - A *blob* is a largest collection of sets of which each overlaps another one: also two blobs that a later line joins.
//! - The least number of pixels is enough. (The paper calls it the minimum, and keeps blobs that have more.) The pixels
//!   of the gaps do not count.

use core::fmt;
use core::ops::{Range, RangeInclusive};

use super::Point;

/// A pixel by its three components.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Default, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Pixel {
    /// Luminance, Y in the paper.
    pub y: u8,
    /// The first colour component, U in the paper.
    pub u: u8,
    /// The second colour component, V in the paper.
    pub v: u8,
}

/// A picture: lines of pixels from top to bottom, each from left to right.
#[derive(Clone, Copy, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Picture<'a> {
    pixels: &'a [Pixel],
    width: u16,
}

impl<'a> Picture<'a> {
    /// The picture of whole lines of `width` pixels; `None` if the last line is cut short, or there is no line or
    /// more than 65,535.
    pub fn new(pixels: &'a [Pixel], width: u16) -> Option<Self> {
        let lines = pixels.chunks_exact(usize::from(width.max(1)));
        let is_whole = width > 0 && lines.remainder().is_empty();
        (is_whole && (1..=usize::from(u16::MAX)).contains(&lines.len())).then_some(Self { pixels, width })
    }

    /// Pixels in a line.
    pub const fn width(self) -> u16 {
        self.width
    }

    /// Lines.
    pub const fn height(self) -> u16 {
        (self.pixels.len() / self.width as usize) as u16
    }

    fn lines(self) -> impl Iterator<Item = &'a [Pixel]> {
        self.pixels.chunks_exact(usize::from(self.width))
    }
}

/// A range for each component.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Colours {
    least: Pixel,
    greatest: Pixel,
}

/// Why there is nothing to calibrate with.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum NoSample {
    /// The rectangle has no pixel.
    Empty,
    /// A part of it is outside the picture.
    Outside,
}

impl fmt::Display for NoSample {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Empty => "the rectangle has no pixel: draw it round an LED",
            Self::Outside => "the rectangle reaches beyond the picture: draw it inside",
        })
    }
}

impl core::error::Error for NoSample {}

impl Colours {
    /// From the components of `least` to those of `greatest`, both included; `None` if a range is empty.
    pub fn new(least: Pixel, greatest: Pixel) -> Option<Self> {
        let is_range = least.y <= greatest.y && least.u <= greatest.u && least.v <= greatest.v;
        is_range.then_some(Self { least, greatest })
    }

    /// The calibration: the least and the greatest Y, U and V in a rectangle that is drawn round an LED.
    ///
    /// # Errors
    /// [`NoSample`] if the rectangle is empty or reaches beyond the picture.
    pub fn sample(
        picture: Picture<'_>,
        columns: RangeInclusive<u16>,
        rows: RangeInclusive<u16>,
    ) -> Result<Self, NoSample> {
        let line_count = usize::from(*rows.end()).saturating_sub(usize::from(*rows.start())) + 1;
        let columns = usize::from(*columns.start())..usize::from(*columns.end()) + 1;
        if columns.is_empty() || rows.is_empty() {
            return Err(NoSample::Empty);
        }
        if columns.end > usize::from(picture.width()) || *rows.end() >= picture.height() {
            return Err(NoSample::Outside);
        }
        let lines = picture.lines().skip(usize::from(*rows.start())).take(line_count);
        let pixels = lines.filter_map(|line| line.get(columns.clone())).flatten();
        let samples = pixels.map(|&pixel| Self { least: pixel, greatest: pixel });
        samples.reduce(Self::and).ok_or(NoSample::Empty)
    }

    /// The smallest ranges that have all of both: several LEDs are sampled one after the other.
    pub fn and(self, other: Self) -> Self {
        let both = |one: Pixel, other: Pixel, choose: fn(u8, u8) -> u8| Pixel {
            y: choose(one.y, other.y),
            u: choose(one.u, other.u),
            v: choose(one.v, other.v),
        };
        Self {
            least: both(self.least, other.least, u8::min),
            greatest: both(self.greatest, other.greatest, u8::max),
        }
    }

    /// The least component of each kind.
    pub const fn least(self) -> Pixel {
        self.least
    }

    /// The greatest component of each kind.
    pub const fn greatest(self) -> Pixel {
        self.greatest
    }

    /// Whether each component of `pixel` is in its range.
    #[inline]
    pub fn contains(self, pixel: Pixel) -> bool {
        (self.least.y..=self.greatest.y).contains(&pixel.y)
            && (self.least.u..=self.greatest.u).contains(&pixel.u)
            && (self.least.v..=self.greatest.v).contains(&pixel.v)
    }
}

/// The two parameters of the paper.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Thresholds {
    /// The least number of pixels of a blob. It leaves out sensors that are farther than an adjacent cell.
    pub least_pixels: u32,
    /// The most pixels, or lines, between two parts of one blob.
    pub most_gap_pixels: u16,
}

impl Thresholds {
    /// The most sets that a picture of this size can have.
    pub const fn most_sets(self, width: u16, height: u16) -> usize {
        // A set takes up a pixel and the gap, longer than allowed, that parts it from the next.
        (width as usize).div_ceil(self.most_gap_pixels as usize + 2) * height as usize
    }
}

/// A set of pixels in one line: what [`find`] wants a buffer of.
#[derive(Clone, Copy, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Set {
    row: u16,
    first: u16,
    last: u16,
    /// The place of a set of the same blob before this one; its own place if it is the blob's first one.
    parent: usize,
    /// What is known of the blob, if it is the blob's first one.
    blob: Blob,
}

impl Set {
    /// What a buffer is filled with.
    pub const UNUSED: Self =
        Self { row: 0, first: 0, last: 0, parent: 0, blob: Blob { pixels: 0, columns: 0, rows: 0 } };

    const fn new(row: u16, column: u16, place: usize) -> Self {
        let blob = Blob { pixels: 1, columns: column as u64, rows: row as u64 };
        Self { row, first: column, last: column, parent: place, blob }
    }

    const fn add(&mut self, column: u16) {
        self.last = column;
        self.blob = self.blob.and(Blob { pixels: 1, columns: column as u64, rows: self.row as u64 });
    }
}

/// Pixels of the right colours that belong together.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Blob {
    pixels: u32,
    /// The sum of the columns of all pixels.
    columns: u64,
    /// The sum of their rows.
    rows: u64,
}

impl Blob {
    /// How many pixels of the right colours it has.
    pub const fn pixels(self) -> u32 {
        self.pixels
    }

    /// The mean place of these pixels, rounded to the nearest 256th of a pixel.
    pub fn barycentre(self) -> Point {
        let pixels = u64::from(self.pixels.max(1));
        let mean = |sum: u64| ((sum * u64::from(Point::UNITS_PER_PIXEL) + pixels / 2) / pixels) as u32;
        Point { x: mean(self.columns), y: mean(self.rows) }
    }

    const fn and(self, other: Self) -> Self {
        Self {
            pixels: self.pixels + other.pixels,
            columns: self.columns + other.columns,
            rows: self.rows + other.rows,
        }
    }
}

/// The buffer has no place for the sets of a picture.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct TooManySets {
    /// The line in which it was full.
    pub row: u16,
}

impl fmt::Display for TooManySets {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "there is no place left for sets of pixels in line {}: lend more, or take fewer colours",
            self.row
        )
    }
}

impl core::error::Error for TooManySets {}

/// The blobs of `picture`, in the order of their first pixels, line by line from the left. `sets` is what the work
/// needs; [`Thresholds::most_sets`] are always enough. The time is that of looking at every pixel, and at every set
/// once for each line that the gap allows.
///
/// # Errors
/// [`TooManySets`] if `sets` is too small for this picture.
pub fn find<'a>(
    picture: Picture<'_>,
    colours: Colours,
    thresholds: Thresholds,
    sets: &'a mut [Set],
) -> Result<impl Iterator<Item = Blob> + 'a, TooManySets> {
    // The most that neighbours in a set differ in their columns, or two overlapping sets in their rows.
    let reach = u32::from(thresholds.most_gap_pixels) + 1;
    let mut count = 0;
    for (line, row) in picture.lines().zip(0..) {
        let start = count;
        for (_, column) in line.iter().zip(0..).filter(|&(&pixel, _)| colours.contains(pixel)) {
            match sets[start..count].last_mut() {
                Some(set) if u32::from(column - set.last) <= reach => set.add(column),
                Some(_) | None => {
                    *sets.get_mut(count).ok_or(TooManySets { row })? = Set::new(row, column, count);
                    count += 1;
                }
            }
        }
        join_to_lines_before(&mut sets[..count], start, reach);
    }
    let firsts = sets[..count].iter().enumerate().filter(|&(place, set)| set.parent == place);
    Ok(firsts.map(|(_, set)| set.blob).filter(move |blob| blob.pixels >= thresholds.least_pixels))
}

/// Joins the sets of the last line, those from `start` on, to the sets before that they overlap.
fn join_to_lines_before(sets: &mut [Set], start: usize, reach: u32) {
    let Some(row) = sets[start..].first().map(|set| set.row) else { return };
    let mut end = start;
    while let Some(above) =
        sets[..end].last().map(|set| set.row).filter(|&above| u32::from(row - above) <= reach)
    {
        let first = sets[..end].partition_point(|set| set.row < above);
        join_overlapping(sets, first..end, start..sets.len());
        end = first;
    }
}

/// Joins the sets of two lines that have a column in common. Both are in order, so each is looked at once.
fn join_overlapping(sets: &mut [Set], mut above: Range<usize>, mut below: Range<usize>) {
    while !above.is_empty() && !below.is_empty() {
        let (one, other) = (sets[above.start], sets[below.start]);
        if one.first <= other.last && other.first <= one.last {
            join(sets, above.start, below.start);
        }
        if one.last < other.last { above.start += 1 } else { below.start += 1 }
    }
}

/// Makes one blob of the blobs of two sets.
fn join(sets: &mut [Set], one: usize, other: usize) {
    let (one, other) = (first_of_blob(sets, one), first_of_blob(sets, other));
    if one != other {
        let (first, second) = (one.min(other), one.max(other));
        sets[second].parent = first;
        sets[first].blob = sets[first].blob.and(sets[second].blob);
    }
}

/// The first set of the blob that the set at `place` belongs to. The way there gets shorter for the next who asks.
fn first_of_blob(sets: &mut [Set], mut place: usize) -> usize {
    while sets[place].parent != place {
        let parent = sets[place].parent;
        sets[place].parent = sets[parent].parent;
        place = parent;
    }
    place
}

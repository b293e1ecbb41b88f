//! Where a sensor is, seen from the agent [Ferranti 2009, IV, “Locating sensors with respect to mobile agent”]: the angle
//! from the turning steps and the column in the picture, the distance from the row.
//!
//! Ours are these readings:
//!
//! - Steps turn to the right, and angles grow that way; 0 is straight ahead at the first step. A robot that turns to the
//!   left mirrors its pictures.
//! - All steps of a round are alike, and columns are evenly spaced over the camera's angle of view, of which the paper
//!   says nothing.
//! - The distance, estDist = y²/420 − 0.931·y + 65 with y the row from the top, is in centimetres: sensors are 48 cm
//!   apart, and 65 cm at the upper rim is about the diagonal.
//! - The fit falls up to y = 195.51, where it turns round; but from y = 91.0 on it is not above zero (−26.0 at the
//!   lowest). It is a distance for the rows above that, and falls there; for the others there is none.

use core::fmt;
use core::num::NonZeroU16;

use super::Point;

/// An angle in 2⁻³² of a whole turn, so that angles wrap round as numbers do.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Default, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Angle {
    parts: u32,
}

impl Angle {
    const PARTS_PER_TURN: u64 = 1 << 32;
    const MILLIDEGREES_PER_TURN: u64 = 360_000;

    /// That many thousandths of a degree, rounded down to parts; whole turns are left out.
    pub const fn of_millidegrees(millidegrees: u32) -> Self {
        Self { parts: (millidegrees as u64 * Self::PARTS_PER_TURN / Self::MILLIDEGREES_PER_TURN) as u32 }
    }

    /// In thousandths of a degree, rounded to the nearest, below 360,000.
    pub const fn millidegrees(self) -> u32 {
        let thousandths = (self.parts as u64 * Self::MILLIDEGREES_PER_TURN + Self::PARTS_PER_TURN / 2)
            / Self::PARTS_PER_TURN;
        (thousandths % Self::MILLIDEGREES_PER_TURN) as u32
    }

    /// In 2⁻³² of a whole turn.
    pub const fn parts(self) -> u32 {
        self.parts
    }
}

/// How an agent looks round.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Round {
    /// Turning steps from the first sensor until it is seen again.
    pub steps: NonZeroU16,
    /// Pixels in a line of a picture.
    pub width: NonZeroU16,
    /// The angle between the rims of a picture.
    pub view: Angle,
}

/// A place seen from the agent.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Polar {
    /// Where to.
    pub angle: Angle,
    /// How far, in micrometres.
    pub distance_micrometres: u32,
}

/// Why a light has no place.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Unplaced {
    /// It is beyond the right rim of the picture.
    Column,
    /// It is so low in the picture that the fitted distance is not above zero.
    Row,
}

impl fmt::Display for Unplaced {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Column => "the light is beyond the right rim of the picture",
            Self::Row => "the light is in row 91 or below, where the fitted distance is not above zero",
        })
    }
}

impl core::error::Error for Unplaced {}

impl Round {
    /// Where a light is that was seen at `point` after `step` turning steps.
    ///
    /// # Errors
    /// [`Unplaced`] if `point` is outside the picture, or has no distance.
    pub fn locate(self, step: u32, point: Point) -> Result<Polar, Unplaced> {
        Ok(Polar { angle: self.angle(step, point)?, distance_micrometres: distance_micrometres(point)? })
    }

    /// The angle to a light that was seen at `point` after `step` turning steps. Each of its two parts is rounded down.
    ///
    /// # Errors
    /// [`Unplaced::Column`] if `point` is outside the picture.
    pub fn angle(self, step: u32, point: Point) -> Result<Angle, Unplaced> {
        let width = i64::from(self.width.get()) * i64::from(Point::UNITS_PER_PIXEL);
        // Twice, since the middle may lie between two units.
        let rightmost = width - i64::from(Point::UNITS_PER_PIXEL);
        let twice_from_middle = 2 * i64::from(point.x) - rightmost;
        if twice_from_middle > rightmost {
            return Err(Unplaced::Column);
        }
        let steps = u64::from(self.steps.get());
        // Whole turns are above the lowest 32 bits.
        let turned = u64::from(step) * Angle::PARTS_PER_TURN / steps;
        let aside = (twice_from_middle * i64::from(self.view.parts)).div_euclid(2 * width);
        Ok(Angle { parts: (turned as u32).wrapping_add(aside as u32) })
    }
}

/// The row in which the fit is lowest, 0.931·420/2, rounded up, in 256ths of a pixel.
const LOWEST: u32 = 50_051;

/// The fitted distance of a light at `point`, in micrometres, rounded down.
///
/// # Errors
/// [`Unplaced::Row`] if the fit gives none above zero, or turns round.
pub fn distance_micrometres(point: Point) -> Result<u32, Unplaced> {
    // y²/420 − 0.931·y + 65 with 10,000 micrometres to the centimetre, over the common denominator.
    const UNITS: i64 = Point::UNITS_PER_PIXEL as i64;
    const DENOMINATOR: i64 = 420 * UNITS * UNITS;
    if point.y >= LOWEST {
        return Err(Unplaced::Row);
    }
    let y = i64::from(point.y);
    let numerator = 10_000 * y * y - 9_310 * 420 * UNITS * y + 650_000 * DENOMINATOR;
    // No row is at 0 itself.
    u32::try_from(numerator.div_euclid(DENOMINATOR)).map_err(|_| Unplaced::Row)
}

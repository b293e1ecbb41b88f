//! A robot's knowledge of an anchor, and the numbers that cannot be taken for it.

use super::{Point, Signal};
use crate::error::sentences;

/// An anchor, and how far from it the robot is by the strength of its signal.
#[derive(Clone, Copy, PartialEq, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Range {
    /// Where the anchor is.
    pub anchor: Point,
    /// How far it is.
    pub distance_m: f64,
}

impl Range {
    /// The distance to the anchor at `anchor`.
    pub const fn new(anchor: Point, distance_m: f64) -> Self {
        Self { anchor, distance_m }
    }
}

/// The residual whose squares are minimised.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Residual {
    /// The error of a distance, in metres.
    Metres,
    /// The error of a level, in decibels: for noise in decibels this is the most likely position.
    Decibels,
}

/// Coordinates and distances beyond this are refused, so that none of their squares overflows.
const MOST_M: f64 = 1e9;

/// A micrometre: distances below it are taken for it, anchors nearer to each other are at one place, and so little is
/// not told by a level. So an anchor at the robot's own place has a logarithm and a direction, and no square is lost.
pub(super) const LEAST_M: f64 = 1e-6;

/// Why there is no position. Anchors are counted in the order of the ranges: from 0 in the fields, from 1 in the
/// sentences of `Display`.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Refusal {
    /// So many anchors: fewer than three, or, for the closed form, another number.
    Anchors(usize),
    /// A coordinate or the distance of this anchor, from 0, is infinite or no number, or is above a million kilometres.
    NotFinite(usize),
    /// The distance of this anchor, from 0, is negative.
    Negative(usize),
    /// The distance of this anchor, from 0, is less than a micrometre, so little that no level is as high.
    Zero(usize),
    /// The anchors stand at fewer than three places: these two are within a micrometre.
    Coincident {
        /// The first.
        first: usize,
        /// The second.
        second: usize,
    },
    /// The anchors stand on one line, to the precision of the numbers: a position and its mirror image fit alike.
    Collinear,
    /// The second and the third anchor have the same x, and equation (8) divides by the difference.
    Division,
    /// Two circles do not meet, not even with errors of four standard deviations.
    Apart {
        /// The first.
        first: usize,
        /// The second.
        second: usize,
    },
    /// There is no particle.
    NoParticle,
    /// The place from which steps are to begin is infinite or no number, or is above a million kilometres away; or the
    /// heading of a belief is infinite or no number.
    NoPlace,
}

impl Refusal {
    /// A hint at the right input.
    pub const fn remedy(self) -> &'static str {
        match self {
            Self::Anchors { .. } => "give at least three anchors, and exactly three for the closed form",
            Self::NotFinite { .. } => "give metres, at most 10⁹ of them",
            Self::Negative { .. } => "give distances from 0",
            Self::Zero { .. } => "give a distance above a micrometre, or ask for residuals in metres",
            Self::Coincident { .. } => "give three anchors at different places",
            Self::Collinear => "move an anchor off the line of the others",
            Self::Division => "name the anchors in another order, or solve by linear least squares",
            Self::Apart { .. } => "measure again, or allow for more noise",
            Self::NoParticle => "give at least one particle",
            Self::NoPlace => {
                "begin from the linear solution, or ask for the position without a place to begin from"
            }
        }
    }
}

sentences!(Refusal {
    Self::Anchors(count) => "no position follows from {count} anchor{}", if count == 1 { "" } else { "s" };
    Self::NotFinite(anchor) => "a number of anchor {} is infinite, too large or none", anchor + 1;
    Self::Negative(anchor) => "the distance of anchor {} is negative", anchor + 1;
    Self::Zero(anchor) => "the distance of anchor {} is too small for a level in decibels", anchor + 1;
    Self::Coincident { first, second } => "anchors {} and {} are at the same place", first + 1, second + 1;
    Self::Collinear => "the anchors are on one line, so that a position and its mirror image fit alike";
    Self::Division =>
        "the second and the third anchor have the same x, by whose difference equation (8) divides";
    Self::Apart { first, second } =>
        "the circles of anchors {} and {} do not meet, not even with errors of four standard deviations",
        first + 1, second + 1;
    Self::NoParticle => "the swarm has no particle";
    Self::NoPlace => "the place to begin from is infinite, too far or no number";
});

/// Whether a position can be asked of these ranges: at least three anchors at three places, and distances that are
/// numbers from 0.
///
/// # Errors
/// [`Refusal`] if it cannot.
pub fn check(ranges: &[Range]) -> Result<(), Refusal> {
    if ranges.len() < 3 {
        return Err(Refusal::Anchors(ranges.len()));
    }
    for (anchor, range) in ranges.iter().enumerate() {
        if ![range.anchor.x_m, range.anchor.y_m, range.distance_m].into_iter().all(is_told) {
            return Err(Refusal::NotFinite(anchor));
        }
        if range.distance_m < 0.0 {
            return Err(Refusal::Negative(anchor));
        }
    }
    let mut places = ranges.iter().map(|range| range.anchor);
    let is_other = |place: Point, than: Option<Point>| than.is_none_or(|than| !is_at(place, than));
    let first = places.next();
    let second = places.find(|&place| is_other(place, first));
    if places.any(|place| is_other(place, first) && is_other(place, second)) {
        return Ok(());
    }
    let (first, second) = coincident(ranges);
    Err(Refusal::Coincident { first, second })
}

/// Whether these residuals can be had of `ranges`.
pub(super) fn check_residual(ranges: &[Range], residual: Residual) -> Result<(), Refusal> {
    check(ranges)?;
    if residual == Residual::Decibels
        && let Some(anchor) = ranges.iter().position(|range| range.distance_m < LEAST_M)
    {
        return Err(Refusal::Zero(anchor));
    }
    Ok(())
}

/// Whether steps can begin from `place`.
pub(super) fn check_place(place: Point) -> Result<(), Refusal> {
    let is_place = is_told(place.x_m) && is_told(place.y_m);
    if is_place { Ok(()) } else { Err(Refusal::NoPlace) }
}

/// Whether a coordinate or a distance is a number whose square is one, too.
fn is_told(number: f64) -> bool {
    number.abs() <= MOST_M
}

/// How many ranges there are.
pub(super) fn count(ranges: &[Range]) -> f64 {
    f64::from(u32::try_from(ranges.len()).unwrap_or(u32::MAX))
}

/// Whether two anchors are at one place.
fn is_at(one: Point, other: Point) -> bool {
    one.squared_distance(other) <= LEAST_M * LEAST_M
}

/// The first two anchors at one place.
fn coincident(ranges: &[Range]) -> (usize, usize) {
    let first = |anchor| ranges.iter().position(|range| is_at(range.anchor, anchor)).unwrap_or(0);
    let mut firsts = ranges.iter().enumerate().map(|(second, range)| (first(range.anchor), second));
    firsts.find(|(first, second)| first < second).unwrap_or_default()
}

/// Standard deviations that an error may have before two circles that it keeps apart are refused.
const MOST_DEVIATIONS: f64 = 4.0;

/// How far two circles may miss each other in proportion, for the rounding of numbers.
const ROUNDING: f64 = 1e-9;

/// How many times too great or too small a distance may be by `signal` before circles are refused that do not meet.
pub fn most_error(signal: &Signal) -> f64 {
    libm::exp(MOST_DEVIATIONS * signal.relative_error()) * (1.0 + ROUNDING)
}

/// Whether two circles meet, if each distance may be `most_error` times too great or too small.
pub fn do_meet(one: &Range, other: &Range, most_error: f64) -> bool {
    let between_m = one.anchor.distance_m(other.anchor);
    let (one_m, other_m) = (one.distance_m, other.distance_m);
    let is_outside = (one_m + other_m) * most_error < between_m;
    let is_inside = one_m.max(other_m) / most_error > between_m + one_m.min(other_m) * most_error;
    !is_outside && !is_inside
}

/// Whether every two circles meet, if each distance may be wrong by four standard
/// deviations of `signal`. Every two are compared.
///
/// # Errors
/// [`Refusal::Apart`] if two do not, and what [`check`] returns.
pub fn check_meeting(ranges: &[Range], signal: &Signal) -> Result<(), Refusal> {
    check(ranges)?;
    let most_error = most_error(signal);
    for (second, other) in ranges.iter().enumerate() {
        for (first, one) in ranges.iter().enumerate().take(second) {
            if !do_meet(one, other, most_error) {
                return Err(Refusal::Apart { first, second });
            }
        }
    }
    Ok(())
}

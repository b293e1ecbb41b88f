//! Ways from distances to a position, as the clauses speak of them: one position, or two that fit alike.

use tautline_kernel::net::Propagation;
use tautline_kernel::position::{
    Area, Fix, Point, Range, Refusal, Residual, Signal, bound, closed_form, linear, locate,
};

/// A way from distances to a position. The rectangle is for the ways that keep to one.
pub(super) type Way = fn(&[Range], Option<Area>) -> Result<WayResult, Refusal>;

/// The result of a way.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(super) struct WayResult {
    /// The position that fits best.
    pub(super) best: Point,
    /// Another one that fits as well.
    pub(super) other: Option<Point>,
}

impl WayResult {
    /// One position.
    pub(super) const fn one(best: Point) -> Self {
        Self { best, other: None }
    }

    /// Both positions.
    pub(super) fn places(self) -> impl Iterator<Item = Point> {
        [self.best].into_iter().chain(self.other)
    }
}

/// The noise that decides whether two positions fit alike, in dB.
pub(super) const NOISE_DB: f64 = 1.0;

/// The signal with that noise.
pub(super) fn signal() -> Option<Signal> {
    Signal::new(Propagation::FREE_SPACE, NOISE_DB)
}

/// Equations (5) to (8).
pub(super) fn published(ranges: &[Range], _: Option<Area>) -> Result<WayResult, Refusal> {
    closed_form(ranges).map(WayResult::one)
}

/// Equations (5) to (8), with the anchors in the first order in which they divide by no 0.
pub(super) fn renamed(ranges: &[Range], area: Option<Area>) -> Result<WayResult, Refusal> {
    let mut ranges = ranges.to_vec();
    for _ in 1..ranges.len() {
        match published(&ranges, area) {
            Err(Refusal::Division) => ranges.rotate_left(1),
            found => return found,
        }
    }
    published(&ranges, area)
}

/// The three of `ranges` that come first in the order of `rank`.
fn best_three<R: PartialOrd>(ranges: &[Range], rank: impl Fn([Range; 3]) -> Option<R>) -> Vec<Range> {
    let mut best: Option<(R, [Range; 3])> = None;
    for (third, &c) in ranges.iter().enumerate() {
        for (second, &b) in ranges.iter().enumerate().take(third) {
            for &a in ranges.iter().take(second) {
                let Some(rank) = rank([a, b, c]) else { continue };
                if best.as_ref().is_none_or(|(least, _)| rank < *least) {
                    best = Some((rank, [a, b, c]));
                }
            }
        }
    }
    best.map_or_else(|| ranges.to_vec(), |(_, three)| three.to_vec())
}

/// The three anchors that are heard strongest, which are the nearest.
pub(super) fn strongest(ranges: &[Range]) -> Vec<Range> {
    best_three(ranges, |three| Some(three.iter().map(|range| range.distance_m).sum::<f64>()))
}

/// The three anchors, not on one line, that tell a robot best where all of them put it.
pub(super) fn best_told(ranges: &[Range]) -> Vec<Range> {
    let (Some(signal), Ok(at)) = (signal(), linear(ranges)) else { return ranges.to_vec() };
    best_three(ranges, |three| {
        let bound = bound(three.iter().map(|range| range.anchor), at, &signal);
        bound.filter(|_| linear(&three).is_ok()).map(|bound| bound.rms_m())
    })
}

/// Linear least squares.
pub(super) fn repaired(ranges: &[Range], _: Option<Area>) -> Result<WayResult, Refusal> {
    linear(ranges).map(WayResult::one)
}

fn located(ranges: &[Range], residual: Residual, area: Option<Area>) -> Result<WayResult, Refusal> {
    let signal = signal().ok_or(Refusal::NoParticle)?;
    Ok(match locate(ranges, residual, &signal, area)? {
        Fix::One(one) => WayResult::one(one.at),
        Fix::Two(one, other) => WayResult { best: one.at, other: Some(other.at) },
    })
}

/// Least squares of what distances miss.
pub(super) fn metres(ranges: &[Range], area: Option<Area>) -> Result<WayResult, Refusal> {
    located(ranges, Residual::Metres, area)
}

/// Least squares of what levels miss.
pub(super) fn decibels(ranges: &[Range], area: Option<Area>) -> Result<WayResult, Refusal> {
    located(ranges, Residual::Decibels, area)
}

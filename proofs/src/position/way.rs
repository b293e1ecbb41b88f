//! Ways from distances to a position, as the clauses speak of them: one position, or two that fit alike.

use tautline_kernel::net::Propagation;
use tautline_kernel::position::{
    Area, Fix, Point, Range, Refusal, Residual, Signal, closed_form, linear, locate,
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

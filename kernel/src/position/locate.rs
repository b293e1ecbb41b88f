//! Damped Gauss–Newton (Levenberg's damping): the positions at which the squares of what the distances miss are least, at most
//! two of them.

use super::bound::{Precision, precision};
use super::normal::Normal;
use super::range::{LEAST_M, check, count};
use super::{Area, Layout, Point, Range, Refusal, Signal};

/// What is made small.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Residual {
    /// What a distance misses, in metres.
    Metres,
    /// What a level misses, in decibels: for noise in decibels this is the most likely position.
    Decibels,
}

/// What is to be said with an estimate.
#[derive(Clone, Copy, PartialEq, Eq, Default, Debug)]
pub struct Flags {
    /// The anchors tell one direction badly: the dilution of precision is above 20, or there is none.
    pub is_weak: bool,
    /// The distances lead out of the rectangle: the estimate is on its rim.
    pub is_outside: bool,
    /// The steps ended before they were small.
    pub is_unsettled: bool,
}

/// A position, and how far it can be trusted.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Estimate {
    /// Where.
    pub at: Point,
    /// How exact; `None` if one direction is not told at all.
    pub precision: Option<Precision>,
    /// The sum of the squared residuals, in m² or dB².
    pub cost: f64,
    /// The root mean square residual, in metres or decibels.
    pub residual: f64,
    /// Steps that were tried.
    pub steps: u32,
    /// What is to be said with it.
    pub flags: Flags,
}

/// The positions that fit.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Fix {
    /// One.
    One(Estimate),
    /// Two that cannot be told apart: a mirror image, or a second minimum whose cost is as good within 3.84 times the variance of
    /// the noise, that is at 95 %. The first one fits no worse.
    Two(Estimate, Estimate),
}

impl Fix {
    /// The one that fits best.
    pub const fn best(&self) -> &Estimate {
        match self {
            Self::One(estimate) | Self::Two(estimate, _) => estimate,
        }
    }
}

/// The 95 % quantile of χ² with one degree of freedom.
const AMBIGUOUS: f64 = 3.84;

/// Above this dilution of precision a position is called weak, as is the habit with satellites.
const MOST_DILUTION: f64 = 20.0;

/// A step below this, in proportion to the spread of the anchors, is the last.
const LAST_STEP: f64 = 1e-5;

/// Minima nearer to each other than this, in the same proportion, are one.
const ONE_PLACE: f64 = 1e-4;

/// Costs nearer to each other than this, in the same proportion squared, are one.
const ONE_COST: f64 = 1e-12;

/// Steps at most.
const MOST_STEPS: u32 = 60;

/// The position from which the residuals are least, or two.
///
/// Steps begin on both sides of the line along which the anchors are spread most, as far from it as the distances say on average:
/// so a mirror image is found even if it is not exactly one.
///
/// # Errors
/// [`Refusal`] if there are fewer than three anchors at three places, if a distance is no number from 0, or is less than a
/// micrometre and decibels are asked for.
pub fn locate(
    ranges: &[Range],
    residual: Residual,
    signal: &Signal,
    area: Option<Area>,
) -> Result<Fix, Refusal> {
    check(ranges)?;
    if residual == Residual::Decibels
        && let Some(anchor) = ranges.iter().position(|range| range.distance_m < LEAST_M)
    {
        return Err(Refusal::Zero { anchor });
    }
    let layout = Layout::of(ranges);
    let descent = Descent { ranges, residual, area, last_m: LAST_STEP * layout.spread_m[0] };
    let [one, other] = starts(ranges, &layout).map(|start| descent.from(start));
    let (best, second) = if one.normal.cost <= other.normal.cost { (one, other) } else { (other, one) };
    let estimate = |landing: &Landing| landing.estimate(ranges, residual, signal);
    let squared_m = ranges.iter().map(|range| range.distance_m * range.distance_m).sum::<f64>();
    let (variance, rounding) = match residual {
        Residual::Metres => (squared_m / count(ranges), squared_m),
        Residual::Decibels => (1.0, 1.0),
    };
    let error = signal.relative_error();
    let ambiguous = AMBIGUOUS * error * error * variance + ONE_COST * rounding;
    let is_apart = best.at.distance_m(second.at) > ONE_PLACE * layout.spread_m[0];
    Ok(if is_apart && second.normal.cost - best.normal.cost <= ambiguous {
        Fix::Two(estimate(&best), estimate(&second))
    } else {
        Fix::One(estimate(&best))
    })
}

/// A place on either side of the anchors' line.
fn starts(ranges: &[Range], layout: &Layout) -> [Point; 2] {
    let (along_m, _) = layout.solve(ranges);
    let squared_m = ranges.iter().map(|range| {
        let (u, v) = layout.about_centre(range.anchor);
        range.distance_m * range.distance_m - (along_m - u) * (along_m - u) - v * v
    });
    let mean = squared_m.sum::<f64>() / count(ranges);
    // A place on the line itself is no start: no step leads away from it.
    let across_m = libm::sqrt(mean.max(0.0)).max(layout.spread_m[0] / 16.0);
    [layout.place(along_m, across_m), layout.place(along_m, -across_m)]
}

/// A way downhill.
struct Descent<'a> {
    ranges: &'a [Range],
    residual: Residual,
    area: Option<Area>,
    last_m: f64,
}

/// Where it ended.
struct Landing {
    at: Point,
    normal: Normal,
    steps: u32,
    is_outside: bool,
    is_unsettled: bool,
}

impl Descent<'_> {
    fn from(&self, start: Point) -> Landing {
        let mut at = self.area.map_or(start, |area| area.nearest(start));
        let mut normal = Normal::at(self.ranges, self.residual, at);
        let mut damping = 0.0;
        let mut steps = 0;
        let mut is_unsettled = true;
        while is_unsettled && steps < MOST_STEPS {
            steps += 1;
            let to = self.step(at, &normal, damping);
            is_unsettled = at.squared_distance(to) > self.last_m * self.last_m;
            let next = Normal::at(self.ranges, self.residual, to);
            if next.cost <= normal.cost {
                (at, normal, damping) = (to, next, if damping < 1e-6 { 0.0 } else { damping / 10.0 });
            } else {
                damping = (damping * 8.0).max(1e-2);
            }
        }
        let is_outside = self.area.is_some_and(|area| pressed(area, at, &normal) != [false; 2]);
        Landing { at, normal, steps, is_outside, is_unsettled }
    }

    /// Where the next step leads. A coordinate that is pressed against the rim stays there.
    #[inline]
    fn step(&self, at: Point, normal: &Normal, damping: f64) -> Point {
        let (x, y) = normal.downhill;
        let alone = |along: f64, xx: f64| if xx > 0.0 { along / (xx * (1.0 + damping)) } else { 0.0 };
        let (dx, dy) = match self.area.map_or([false; 2], |area| pressed(area, at, normal)) {
            [false, false] => {
                let inverse = normal.inverse(damping);
                (inverse.xx * x + inverse.xy * y, inverse.xy * x + inverse.yy * y)
            }
            [true, false] => (0.0, alone(y, normal.matrix.yy)),
            [false, true] => (alone(x, normal.matrix.xx), 0.0),
            [true, true] => (0.0, 0.0),
        };
        let to = Point::new(at.x_m + dx, at.y_m + dy);
        self.area.map_or(to, |area| area.nearest(to))
    }
}

/// Whether the way downhill leads out of `area`, along x and along y.
fn pressed(area: Area, at: Point, normal: &Normal) -> [bool; 2] {
    let (least, greatest) = (area.least(), area.greatest());
    let leads_out = |at: f64, least: f64, greatest: f64, to: f64| {
        (at <= least && to < 0.0) || (at >= greatest && to > 0.0)
    };
    [
        leads_out(at.x_m, least.x_m, greatest.x_m, normal.downhill.0),
        leads_out(at.y_m, least.y_m, greatest.y_m, normal.downhill.1),
    ]
}

impl Landing {
    fn estimate(&self, ranges: &[Range], residual: Residual, signal: &Signal) -> Estimate {
        let precision = precision(ranges, residual, signal, self.at);
        let cost = match residual {
            Residual::Metres => self.normal.cost,
            Residual::Decibels => self.normal.cost * signal.decibels() * signal.decibels(),
        };
        let is_weak = precision.is_none_or(|precision| precision.dilution > MOST_DILUTION);
        Estimate {
            at: self.at,
            precision,
            cost,
            residual: libm::sqrt(cost / count(ranges)),
            steps: self.steps,
            flags: Flags { is_weak, is_outside: self.is_outside, is_unsettled: self.is_unsettled },
        }
    }
}

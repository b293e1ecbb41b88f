//! Damped Gauss–Newton (Levenberg's damping): the positions at which the squares of what the distances miss are least,
//! at most two of them.

use super::bound::{Precision, precision};
use super::descent::{Descent, Landing};
use super::range::{LEAST_M, check_place, check_residual, count};
use super::{Area, Layout, Point, Range, Refusal, Residual, Signal};

/// Warnings about an estimate.
#[derive(Clone, Copy, PartialEq, Eq, Default, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
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
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
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
    /// Its warnings.
    pub flags: Flags,
}

/// The positions that fit.
#[derive(Clone, Copy, PartialEq, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Fix {
    /// One.
    One(Estimate),
    /// Two that cannot be told apart: a mirror image, or a second minimum whose cost is as good within 3.84 times the
    /// variance of the noise, that is at 95 %. The first one fits no worse.
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

/// A step below this, in proportion to the spread of the anchors, is the last. Where the sum of the squares is convex
/// the error is then about the square of it.
const LAST_STEP: f64 = 1e-5;

/// Minima nearer to each other than this, in the same proportion, are one, and none that are farther apart than half a
/// metre.
const ONE_PLACE: f64 = 1e-2;
const ONE_PLACE_M: f64 = 0.5;

/// Costs nearer to each other than this, in the same proportion squared, are one.
const ONE_COST: f64 = 1e-12;

/// An image promises a second minimum if the next step from it leads this near to the best one, in units of the
/// difference at which two are told apart: steps are not straight.
const PROMISING: f64 = 32.0;

/// Where a better minimum is found, it is mirrored again, at most this often.
const MOST_ROUNDS: u32 = 3;

/// Images that are looked at in a round: of more anchors than this, in lines from all over the list, each image once.
/// So the work grows with the number of anchors and not with its square.
const MOST_IMAGES: usize = 32;

/// The position from which the residuals are least, or two.
///
/// Steps begin on one side of the line along which the anchors are spread most, as far from it as the
/// distances say on average. Where they end is then mirrored, in that line and in those through two anchors
/// that follow each other, at most 32 of them: from an image the two distances fit as well, and where the
/// others promise to, too, steps begin anew.
///
/// # Errors
/// [`Refusal`] if there are fewer than three anchors at three places, if a distance is no number from 0, or is less
/// than a micrometre and decibels are asked for.
pub fn locate(
    ranges: &[Range],
    residual: Residual,
    signal: &Signal,
    area: Option<Area>,
) -> Result<Fix, Refusal> {
    check_residual(ranges, residual)?;
    let layout = Layout::of(ranges);
    let squared_m = ranges.iter().map(|range| range.distance_m * range.distance_m).sum::<f64>();
    let (variance, rounding) = match residual {
        Residual::Metres => (squared_m / count(ranges), squared_m),
        Residual::Decibels => (1.0, 1.0),
    };
    let error = signal.relative_error();
    let ambiguous = AMBIGUOUS * error * error * variance + ONE_COST * rounding;
    let descent = Descent { ranges, residual, area: None, last_m: LAST_STEP * layout.spread_m[0] };
    let mut minima = Minima::new(start(&descent, &layout), (ONE_PLACE * layout.spread_m[0]).min(ONE_PLACE_M));
    let mut mirrored = None;
    for _ in 0..MOST_ROUNDS {
        let best = minima.best.at;
        if mirrored == Some(best) {
            break;
        }
        mirrored = Some(best);
        let (mut tried, mut count) = ([None; MOST_IMAGES], 0);
        for image in images(ranges, best) {
            if tried.contains(&Some(image)) {
                continue;
            }
            let Some(place) = tried.get_mut(count) else { break };
            (*place, count) = (Some(image), count + 1);
            // Within a rectangle also a minimum counts that is worse elsewhere.
            let most =
                if area.is_some() { f64::INFINITY } else { minima.best.normal.cost + PROMISING * ambiguous };
            let normal = descent.normal(image);
            if !minima.has(image) && normal.promise() <= most {
                minima.add(descent.from(image, normal, |at| minima.has(at)));
            }
        }
    }
    if let Some(area) = area {
        minima = minima.within(area, &descent);
    }
    let estimate = |landing: &Landing| landing.estimate(ranges, residual, signal);
    Ok(match &minima.second {
        Some(second) if second.normal.cost - minima.best.normal.cost <= ambiguous => {
            Fix::Two(estimate(&minima.best), estimate(second))
        }
        Some(_) | None => Fix::One(estimate(&minima.best)),
    })
}

/// The position to which steps lead from `from`: for a robot that knows about where it is, from its last
/// position or from its wheels. No second position is looked for. From a place on the line of anchors
/// that are all on one, no step leads off it.
///
/// # Errors
/// [`Refusal`] as for [`locate`], and if `from` is no place.
pub fn locate_from(
    from: Point,
    ranges: &[Range],
    residual: Residual,
    signal: &Signal,
    area: Option<Area>,
) -> Result<Estimate, Refusal> {
    check_residual(ranges, residual)?;
    check_place(from)?;
    let from = area.map_or(from, |area| area.nearest(from));
    let descent = Descent { ranges, residual, area, last_m: LAST_STEP * Layout::of(ranges).spread_m[0] };
    let landing = descent.from(from, descent.normal(from), |_| false);
    Ok(landing.estimate(ranges, residual, signal))
}

/// The better one of the places on both sides of the anchors' line.
fn start(descent: &Descent<'_>, layout: &Layout) -> Landing {
    let ranges = descent.ranges;
    let (along_m, _) = layout.solve(ranges);
    let squared_m = ranges.iter().map(|range| {
        let (u, v) = layout.about_centre(range.anchor);
        range.distance_m * range.distance_m - (along_m - u) * (along_m - u) - v * v
    });
    let mean = squared_m.sum::<f64>() / count(ranges);
    // A place on the line itself is no start: no step leads away from it.
    let across_m = libm::sqrt(mean.max(0.0)).max(layout.spread_m[0] / 16.0);
    let [one, other] = [across_m, -across_m].map(|across_m| layout.place(along_m, across_m));
    let (of_one, of_other) = (descent.normal(one), descent.normal(other));
    let (at, normal) = if of_one.cost <= of_other.cost { (one, of_one) } else { (other, of_other) };
    descent.from(at, normal, |_| false)
}

/// `at` mirrored in the lines through two anchors that follow each other: in their
/// order, or, of many, from all over the list.
fn images(ranges: &[Range], at: Point) -> impl Iterator<Item = Point> {
    let count = ranges.len();
    let step = if count <= MOST_IMAGES { 1 } else { scattering(count) };
    let places = core::iter::successors(Some(0), move |place| Some((place + step) % count)).take(count);
    let anchor = move |place: usize| ranges.get(place).map(|range| range.anchor);
    let pairs = places.filter_map(move |place| anchor(place).zip(anchor((place + 1) % count)));
    pairs.map(move |(from, to)| {
        let (x, y) = (to.x_m - from.x_m, to.y_m - from.y_m);
        let across =
            (x * (at.y_m - from.y_m) - y * (at.x_m - from.x_m)) / (x * x + y * y).max(LEAST_M * LEAST_M);
        Point::new(at.x_m + 2.0 * across * y, at.y_m - 2.0 * across * x)
    })
}

/// A step by which places of so many follow each other far apart, and none comes twice.
fn scattering(count: usize) -> usize {
    let has_common_part = |mut one: usize, mut other: usize| {
        while other > 0 {
            (one, other) = (other, one % other);
        }
        one > 1
    };
    (count / 8 * 5..count).find(|&step| !has_common_part(count, step)).unwrap_or(1)
}

/// The two best minima so far.
struct Minima {
    best: Landing,
    second: Option<Landing>,
    /// Minima nearer to each other than this are one.
    apart_m: f64,
}

impl Minima {
    const fn new(best: Landing, apart_m: f64) -> Self {
        Self { best, second: None, apart_m }
    }

    fn is_one(&self, one: Point, other: Point) -> bool {
        one.squared_distance(other) <= self.apart_m * self.apart_m
    }

    fn has(&self, place: Point) -> bool {
        let is_second = self.second.as_ref().is_some_and(|second| self.is_one(second.at, place));
        is_second || self.is_one(self.best.at, place)
    }

    fn add(&mut self, landing: Landing) {
        if self.is_one(self.best.at, landing.at) {
            return;
        }
        if landing.normal.cost < self.best.normal.cost {
            self.second = Some(core::mem::replace(&mut self.best, landing));
        } else if self.second.as_ref().is_none_or(|second| landing.normal.cost < second.normal.cost) {
            self.second = Some(landing);
        }
    }

    /// The minima within a rectangle: from minima outside, steps go on from the nearest place in it.
    fn within(self, area: Area, descent: &Descent<'_>) -> Self {
        let descent = Descent { area: Some(area), ..*descent };
        let inside = |landing: Landing| {
            let nearest = area.nearest(landing.at);
            if nearest == landing.at {
                landing
            } else {
                descent.from(nearest, descent.normal(nearest), |_| false)
            }
        };
        let mut minima = Self::new(inside(self.best), self.apart_m);
        if let Some(second) = self.second {
            minima.add(inside(second));
        }
        minima
    }
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

#[cfg(test)]
mod tests {
    use super::super::normal::Normal;
    use super::super::place::SymmetricMatrix;
    use super::*;
    use crate::net::Propagation;

    /// A minimum so many metres to the east.
    fn minimum(x_m: f64, cost: f64) -> Landing {
        let even = SymmetricMatrix { xx: 1.0, xy: 0.0, yy: 1.0 };
        let normal = Normal { cost, matrix: even, curvature: even, downhill: (0.0, 0.0) };
        Landing { at: Point::new(x_m, 0.0), normal, steps: 0, is_outside: false, is_unsettled: false }
    }

    #[test]
    fn images_of_many_anchors_are_taken_from_all_over_the_list_each_once() {
        let anchor = |number: u32| Range::new(Point::new(f64::from(number * number), f64::from(number)), 1.0);
        let all: [Range; 1000] = core::array::from_fn(|number| anchor(number as u32));
        for count in [3, 32, 33, 34, 64, 100, 997, 1000] {
            let ranges = &all[..count];
            let at = Point::new(-3.0, 5.0);
            let whole = |place: usize| {
                let pair = [ranges[place], ranges[(place + 1) % count]];
                images(&pair, at).next().expect("an image")
            };
            assert_eq!(images(ranges, at).count(), count);
            for (number, image) in images(ranges, at).enumerate() {
                let place = if count <= MOST_IMAGES { number } else { number * scattering(count) % count };
                assert_eq!(image, whole(place), "{number} of {count}");
            }
            // Of eight parts of the list each has some of the first ones.
            let first = (0..MOST_IMAGES).map(|number| number * scattering(count) % count * 8 / count);
            let parts = first.fold(0_u32, |parts, part| parts | 1 << part);
            assert!(count <= MOST_IMAGES || parts == 0xff, "{count}: {parts:b}");
        }
    }

    /// Before, positions that were 6 metres apart were one where anchors were a kilometre apart.
    #[test]
    fn the_image_of_a_robot_beside_a_long_line_of_anchors_is_told() {
        let robot = Point::new(300.0, 3.0);
        let ranges = [0.0, 500.0, 1000.0].map(|x_m| {
            let anchor = Point::new(x_m, 0.0);
            Range::new(anchor, anchor.distance_m(robot))
        });
        let signal = Signal::new(Propagation::FREE_SPACE, 0.0).expect("no noise");
        let told = locate(&ranges, Residual::Metres, &signal, None).expect("a position");
        let Fix::Two(one, other) = told else { panic!("{told:?}") };
        let mut sides = [one, other].map(|estimate| estimate.at.y_m);
        sides.sort_by(f64::total_cmp);
        assert!((sides[0] + 3.0).abs() < 1e-3 && (sides[1] - 3.0).abs() < 1e-3, "{told:?}");
    }

    #[test]
    fn of_all_minima_the_two_least_are_kept_in_whatever_order_they_come() {
        for costs in [[1, 2, 3], [1, 3, 2], [2, 1, 3], [2, 3, 1], [3, 1, 2], [3, 2, 1]] {
            let mut found = costs.map(f64::from).map(|cost| minimum(10.0 * cost, cost)).into_iter();
            let mut minima = Minima::new(found.next().expect("the first"), 1.0);
            found.for_each(|landing| minima.add(landing));
            let kept = (minima.best.normal.cost, minima.second.map(|second| second.normal.cost));
            assert_eq!(kept, (1.0, Some(2.0)), "{costs:?}");
        }
    }
}

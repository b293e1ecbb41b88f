//! Where a robot takes itself to be: place and heading with their covariance, by an extended Kalman filter of its
//! wheels and of fixes. It is ours: Rajesh et al. 2024 take each fix for the truth (POSITION-7).

use super::normal::Normal;
use super::range::{check_place, check_residual};
use super::{Point, Range, Refusal, Residual, Signal, SymmetricMatrix, bound};

/// How far wheels err: each drive by a share of its way, each turn by an angle, as standard deviations.
#[derive(Clone, Copy, PartialEq, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Odometry {
    share: f64,
    turn_rad: f64,
}

impl Odometry {
    /// Wheels that do not err.
    pub const EXACT: Self = Self { share: 0.0, turn_rad: 0.0 };

    /// 2 % of the way and 1° a turn. These values are ours: the paper has none.
    pub const USUAL: Self = Self { share: 0.02, turn_rad: core::f64::consts::PI / 180.0 };

    /// A share of the way from 0 to 1, and an error of each turn from 0 to 90 **degrees**, as people write it, while
    /// [`turn_rad`](Self::turn_rad) and all else are in radians; `None` for anything else.
    pub fn new(share: f64, turn_degrees: f64) -> Option<Self> {
        let is_error = (0.0..=1.0).contains(&share) && (0.0..=90.0).contains(&turn_degrees);
        is_error.then(|| Self { share, turn_rad: turn_degrees.to_radians() })
    }

    /// The standard deviation of a drive, as a share of its way.
    pub const fn share(&self) -> f64 {
        self.share
    }

    /// The standard deviation of a turn, however small the turn is, in radians.
    pub const fn turn_rad(&self) -> f64 {
        self.turn_rad
    }
}

/// Whether a fix is compared with the belief before it counts.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Gate {
    /// A fix whose squared Mahalanobis distance is beyond the 99.9 % quantile of χ² is left out.
    Closed,
    /// Every fix counts.
    Open,
}

/// The outcome of a fix.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Correction {
    /// It has corrected the belief.
    Taken,
    /// It is an outlier, and is left out.
    Outlier,
    /// It says nothing: a number of it or of the belief is not finite, or both are certain.
    Nothing,
}

/// The 99.9 % quantile of χ² with two degrees of freedom: 2 ln 1000.
const OUTLIER: f64 = 13.815_510_557_964_274;

/// The place and the heading of a robot, and their covariance. It takes 72 bytes.
#[derive(Clone, Copy, PartialEq, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Belief {
    at: Point,
    heading_rad: f64,
    place: SymmetricMatrix,
    /// The covariances of the heading with x and with y, in m rad, and its variance, in rad².
    heading: [f64; 3],
}

impl Belief {
    /// A robot that is known to be at `at` with a heading in radians, from +x towards +y.
    pub const fn known(at: Point, heading_rad: f64) -> Self {
        Self { at, heading_rad, place: SymmetricMatrix { xx: 0.0, xy: 0.0, yy: 0.0 }, heading: [0.0; 3] }
    }

    /// Its most likely place.
    pub const fn at(&self) -> Point {
        self.at
    }

    /// Its most likely heading, from −π to π.
    pub const fn heading_rad(&self) -> f64 {
        self.heading_rad
    }

    /// The covariance of the place, in m².
    pub const fn covariance(&self) -> SymmetricMatrix {
        self.place
    }

    /// The covariances of the heading with x and with y, in m rad, and its variance, in rad².
    pub const fn heading_covariance(&self) -> [f64; 3] {
        self.heading
    }

    /// The greater standard deviation of the two coordinates, in metres.
    pub fn deviation_m(&self) -> f64 {
        libm::sqrt(self.place.xx.max(self.place.yy))
    }

    /// The turn and the way to `to`, in radians from −π to π and in metres. There is no turn where there is no way.
    pub fn towards(&self, to: Point) -> (f64, f64) {
        let (x, y) = (to.x_m - self.at.x_m, to.y_m - self.at.y_m);
        let way_m = self.at.distance_m(to);
        let turn = if way_m > 0.0 { wrapped(libm::atan2(y, x) - self.heading_rad) } else { 0.0 };
        (turn, way_m)
    }

    /// Whether it can be corrected.
    fn check(&self) -> Result<(), Refusal> {
        if self.heading_rad.is_finite() { check_place(self.at) } else { Err(Refusal::NoPlace) }
    }

    /// The robot has turned by so many radians. A turn or a way that is infinite or no number is not known, and the
    /// belief is lost: each fix by ranges is refused from then on, and [`Belief::known`] begins anew.
    pub fn turned(&mut self, turn_rad: f64, odometry: &Odometry) {
        if turn_rad != 0.0 {
            self.heading_rad = wrapped(self.heading_rad + turn_rad);
            self.heading[2] += odometry.turn_rad * odometry.turn_rad;
        }
    }

    /// The robot has driven so many metres straight on.
    pub fn driven(&mut self, way_m: f64, odometry: &Odometry) {
        let (cosine, sine) = (libm::cos(self.heading_rad), libm::sin(self.heading_rad));
        let (x, y) = (way_m * cosine, way_m * sine);
        self.at = Point::new(self.at.x_m + x, self.at.y_m + y);
        let [of_x, of_y, variance] = self.heading;
        self.place = self.carried(x, y, variance).plus(odometry.share * odometry.share, x, y);
        self.heading = [of_x - y * variance, of_y + x * variance, variance];
    }

    /// The place of an object that the robot sees at `distance_m` and at `bearing_rad` from its heading. **The bearing
    /// turns from +x towards −y, against the heading**: where y goes to the north or the left, as in ROS, it is
    /// positive to the right, and a bearing that is positive to the left has to be negated. A robot that is known to
    /// be at the origin with heading 0 has the object at (d cos θ, −d sin θ) (Rajesh et al. 2024, 4.5).
    pub fn sees(&self, bearing_rad: f64, distance_m: f64, sight: &SightError) -> Sighting {
        let angle = self.heading_rad - bearing_rad;
        let (cosine, sine) = (libm::cos(angle), libm::sin(angle));
        let (x, y) = (distance_m * cosine, distance_m * sine);
        let turned = self.heading[2] + sight.bearing_rad * sight.bearing_rad;
        let covariance = self.carried(x, y, turned).plus(sight.distance_m * sight.distance_m, cosine, sine);
        Sighting { at: Point::new(self.at.x_m + x, self.at.y_m + y), covariance }
    }

    /// The covariance of what is (x, y) away, the variance of its direction being
    /// `variance`: it moves by (−y, x) with each radian.
    const fn carried(&self, x: f64, y: f64, variance: f64) -> SymmetricMatrix {
        let [of_x, of_y, _] = self.heading;
        SymmetricMatrix {
            xx: self.place.xx - 2.0 * y * of_x + y * y * variance,
            xy: self.place.xy + x * of_x - y * of_y - x * y * variance,
            yy: self.place.yy + 2.0 * x * of_y + x * x * variance,
        }
    }

    /// The squared Mahalanobis distance of a fix with this covariance: χ² with two
    /// degrees of freedom if the belief is right.
    pub fn surprise(&self, fix: Point, covariance: SymmetricMatrix) -> Option<f64> {
        let (x, y) = (fix.x_m - self.at.x_m, fix.y_m - self.at.y_m);
        let (by_x, by_y) = self.place.and(covariance).solve((x, y))?;
        Some(x * by_x + y * by_y)
    }

    /// A fix by ranges, whose levels have the noise of `signal`: one step of Gauss and Newton from the believed place,
    /// with the bound there as its covariance; `None` where they tell none. So each level counts as an extended Kalman
    /// filter would have it. The most likely position is no better: its error bends with the circles as far as a fix
    /// alone is off, and a belief is off by less.
    ///
    /// # Errors
    /// [`Refusal`] as for [`locate`](super::locate), and [`Refusal::NoPlace`] of a belief that is
    /// [lost](Self::turned).
    pub fn fix(&self, ranges: &[Range], signal: &Signal) -> Result<Option<Sighting>, Refusal> {
        check_residual(ranges, Residual::Decibels)?;
        self.check()?;
        let normal = Normal::at(ranges, Residual::Decibels, self.at);
        let precision = bound(ranges.iter().map(|range| range.anchor), self.at, signal);
        Ok(precision.zip(normal.matrix.solve(normal.downhill)).map(|(known, (x, y))| Sighting {
            at: Point::new(self.at.x_m + x, self.at.y_m + y),
            covariance: known.covariance,
        }))
    }

    /// Corrects the belief by the [fix](Self::fix) of ranges.
    ///
    /// # Errors
    /// [`Refusal`] as for [`fix`](Self::fix).
    pub fn located(&mut self, ranges: &[Range], signal: &Signal, gate: Gate) -> Result<Correction, Refusal> {
        let fix = self.fix(ranges, signal)?;
        Ok(fix.map_or(Correction::Nothing, |fix| self.corrected(fix.at, fix.covariance, gate)))
    }

    /// Corrects the belief by a fix with its covariance, in m².
    pub fn corrected(&mut self, fix: Point, covariance: SymmetricMatrix, gate: Gate) -> Correction {
        let is_fix = self.check().and(check_place(fix)).is_ok() && covariance.is_finite();
        let weight = self.place.and(covariance).inverse();
        let (true, Some(weight), Some(surprise)) = (is_fix, weight, self.surprise(fix, covariance)) else {
            return Correction::Nothing;
        };
        if gate == Gate::Closed && surprise > OUTLIER {
            return Correction::Outlier;
        }
        let (x, y) = (fix.x_m - self.at.x_m, fix.y_m - self.at.y_m);
        let [of_x, of_y, variance] = self.heading;
        let rows = [(self.place.xx, self.place.xy), (self.place.xy, self.place.yy), (of_x, of_y)];
        // The gain of each coordinate and of the heading.
        let [to_x, to_y, to_heading] =
            rows.map(|(a, b)| (a * weight.xx + b * weight.xy, a * weight.xy + b * weight.yy));
        let by = |gain: (f64, f64)| gain.0 * x + gain.1 * y;
        self.at = Point::new(self.at.x_m + by(to_x), self.at.y_m + by(to_y));
        self.heading_rad = wrapped(self.heading_rad + by(to_heading));
        // Joseph's form, so that no rounding makes a variance negative: (1 − K) P (1 − K)ᵀ + K R Kᵀ.
        let lessened = [(1.0 - to_x.0, -to_x.1), (-to_y.0, 1.0 - to_y.1), (-to_heading.0, -to_heading.1)];
        let through = |matrix: SymmetricMatrix, one: (f64, f64), other: (f64, f64)| {
            let (a, b) =
                (matrix.xx * other.0 + matrix.xy * other.1, matrix.xy * other.0 + matrix.yy * other.1);
            one.0 * a + one.1 * b
        };
        let [in_x, in_y, in_heading] = lessened;
        let kept = |one, other| through(self.place, one, other);
        let added = |one, other| through(covariance, one, other);
        let with = |row: (f64, f64)| row.0 * of_x + row.1 * of_y;
        let heading = [
            kept(in_x, in_heading) + with(in_x) + added(to_x, to_heading),
            kept(in_y, in_heading) + with(in_y) + added(to_y, to_heading),
            kept(in_heading, in_heading) + 2.0 * with(in_heading) + variance + added(to_heading, to_heading),
        ];
        self.place = SymmetricMatrix {
            xx: kept(in_x, in_x) + added(to_x, to_x),
            xy: kept(in_x, in_y) + added(to_x, to_y),
            yy: kept(in_y, in_y) + added(to_y, to_y),
        };
        self.heading = heading;
        Correction::Taken
    }
}

/// How far a sight of an object errs, as standard deviations.
#[derive(Clone, Copy, PartialEq, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct SightError {
    /// Of the bearing, in radians.
    pub bearing_rad: f64,
    /// Of the distance, in metres.
    pub distance_m: f64,
}

/// Where an object or a robot is, with the covariance of its place: the error ellipse.
#[derive(Clone, Copy, PartialEq, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Sighting {
    /// Where.
    pub at: Point,
    /// The covariance of the place, in m².
    pub covariance: SymmetricMatrix,
}

impl Sighting {
    /// This sighting and another one of the same object, each weighed by its covariance. Their errors are taken to be
    /// independent: those of different robots are, but for the anchors that they share.
    #[must_use]
    pub fn merged(self, other: Self) -> Self {
        let mut belief = Belief { at: self.at, heading_rad: 0.0, place: self.covariance, heading: [0.0; 3] };
        belief.corrected(other.at, other.covariance, Gate::Open);
        Self { at: belief.at, covariance: belief.place }
    }
}

/// An angle from −π to π.
fn wrapped(angle: f64) -> f64 {
    libm::remainder(angle, 2.0 * core::f64::consts::PI)
}

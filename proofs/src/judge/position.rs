//! The judge of POSITION: places where the published equations return no position (POSITION-1), second positions that
//! are not told (POSITION-3), and motions that the equations do not follow (POSITION-4). Lengths are whole numbers. It
//! knows the sentences of `SPEC.md` alone.

use super::change::plain;
use super::{Case, Objection, Place, must};

/// A robot at exact distances from three anchors, and whether the published way returns a position.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Exact {
    /// The clause that it is said to break.
    pub clause: &'static str,
    /// A, B and C, in metres.
    pub anchors: [Place; 3],
    /// Where the robot is, in metres.
    pub robot: Place,
    /// Whether a position is returned.
    pub is_told: bool,
}

/// A robot at exact distances from four anchors, of which the published way takes the three that are heard strongest.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Strongest {
    /// The clause that it is said to break.
    pub clause: &'static str,
    /// A, B and C, and the one that is left out, in metres.
    pub anchors: [Place; 4],
    /// Where the robot is, in metres.
    pub robot: Place,
    /// Whether a position is returned.
    pub is_told: bool,
}

/// Three anchors and distances to them, before and after a motion, by the published way.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct FixPair {
    /// The clause that it is said to break.
    pub clause: &'static str,
    /// A, B and C, in metres.
    pub anchors: [Place; 3],
    /// The distances to them, in tenths of a metre.
    pub distances: [i32; 3],
    /// In tenths: what becomes of a metre along x, of one along y, and of the origin.
    pub motion: [Place; 3],
    /// Whether a position is returned before the motion, and after it.
    pub is_told: [bool; 2],
}

plain!(Exact { anchors, robot, is_told });
plain!(Strongest { anchors, robot, is_told });
plain!(FixPair { anchors, distances, motion, is_told });

/// Whether three places are on one line, or two of them are one.
fn is_line([a, b, c]: [Place; 3]) -> bool {
    (b.0 - a.0) * (c.1 - a.1) == (b.1 - a.1) * (c.0 - a.0)
}

/// Whether the published way returns a position: equation (8) divides by the columns from B to C.
fn is_told([_, b, c]: [Place; 3]) -> bool {
    b.0 != c.0
}

impl Case for Exact {
    fn clause(&self) -> &'static str {
        self.clause
    }

    fn judge(&self) -> Result<(), Objection> {
        must(self.clause == "POSITION-1", "the judge does not know this clause")?;
        must(!is_line(self.anchors), "the anchors are on one line")?;
        must(!self.anchors.contains(&self.robot), "the robot is on an anchor")?;
        must(self.is_told == is_told(self.anchors), "the equations return something else")?;
        // The equations are right: a position that they return from exact distances is that of the robot.
        Ok(must(!self.is_told, "the position is where the robot is")?)
    }
}

impl Case for Strongest {
    fn clause(&self) -> &'static str {
        self.clause
    }

    fn judge(&self) -> Result<(), Objection> {
        let Self { anchors: [taken @ .., left], robot, .. } = *self;
        must(self.clause == "POSITION-1", "the judge does not know this clause")?;
        let is_one = (0..4).any(|place| self.anchors[..place].contains(&self.anchors[place]));
        must(!is_one, "two anchors are one")?;
        let is_one_line = is_line(taken) && is_line([taken[0], taken[1], left]);
        must(!is_one_line, "the anchors are on one line")?;
        must(!self.anchors.contains(&robot), "the robot is on an anchor")?;
        let far = |anchor: Place| (anchor.0 - robot.0).pow(2) + (anchor.1 - robot.1).pow(2);
        let is_strongest = taken.into_iter().all(|taken| far(taken) <= far(left));
        must(is_strongest, "a stronger anchor is left out")?;
        let is_due = !is_line(taken) && is_told(taken);
        must(self.is_told == is_due, "the equations return something else")?;
        Ok(must(!self.is_told, "the position is where the robot is")?)
    }
}

impl Case for FixPair {
    fn clause(&self) -> &'static str {
        self.clause
    }

    fn judge(&self) -> Result<(), Objection> {
        let Self { anchors, distances, motion: [x, y, _], .. } = *self;
        must(self.clause == "POSITION-4", "the judge does not know this clause")?;
        must(!is_line(anchors), "the anchors are on one line")?;
        must(distances.iter().all(|&far| far > 0), "a robot is on an anchor")?;
        let length = |(x, y): Place| x * x + y * y;
        let keeps = length(x) == 100 && length(y) == 100 && x.0 * y.0 + x.1 * y.1 == 0;
        must(keeps, "the motion changes distances")?;
        // The origin goes along with all, and plays no part in what is divided by.
        let moved = anchors.map(|(a, b)| (x.0 * a + y.0 * b, x.1 * a + y.1 * b));
        let due = [is_told(anchors), is_told(moved)];
        must(self.is_told == due, "the equations return something else")?;
        Ok(must(due[0] != due[1], "the positions move with the anchors, or there are none")?)
    }
}

/// Three anchors, distances to them, the positions that are told, and one that fits as well. Lengths are whole
/// millimetres, so that a place is a minimum if no place beside it fits better.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Second {
    /// The clause that it is said to break.
    pub clause: &'static str,
    /// A, B and C.
    pub anchors: [Place; 3],
    /// The distances to them.
    pub distances: [i32; 3],
    /// The standard deviation of a distance by the noise, in millionths of it.
    pub noise: i32,
    /// The positions that are told, the best first.
    pub told: Vec<Place>,
    /// The position that fits as well.
    pub other: Place,
}

plain!(Second { anchors, distances, noise, told, other });

/// Positions nearer to each other count as one, in millimetres.
const ONE_MM: f64 = 500.0;

/// The distance between two places.
fn apart((x, y): Place, other: Place) -> f64 {
    let (across, up) = (f64::from(x - other.0), f64::from(y - other.1));
    (across * across + up * up).sqrt()
}

impl Second {
    /// The sum of the squared residuals, in square millimetres.
    fn residual(&self, at: Place) -> f64 {
        let misses = self.anchors.iter().zip(self.distances);
        misses.map(|(&anchor, far)| (f64::from(far) - apart(anchor, at)).powi(2)).sum()
    }

    /// Whether no place beside it fits better.
    fn is_minimum(&self, (x, y): Place) -> bool {
        let beside = (-1..=1).flat_map(|column| (-1..=1).map(move |row| (x + column, y + row)));
        beside.into_iter().all(|place| self.residual(place) >= self.residual((x, y)))
    }
}

impl Case for Second {
    fn clause(&self) -> &'static str {
        self.clause
    }

    fn judge(&self) -> Result<(), Objection> {
        let Self { anchors, distances, noise, ref told, other, .. } = *self;
        must(self.clause == "POSITION-3", "the judge does not know this clause")?;
        must(!is_line(anchors), "the anchors are on one line")?;
        must(distances.iter().all(|&far| far > 0), "a distance is not positive")?;
        must(noise > 0, "there is no noise")?;
        let Some(&best) = told.first() else { return Err("no position is told".into()) };
        must(told.iter().all(|&place| self.is_minimum(place)), "a place is told that is no minimum")?;
        must(self.is_minimum(other), "a place beside the other one fits better")?;
        must(told.iter().all(|&place| apart(place, other) > ONE_MM), "the other position is told")?;
        let errors = distances.map(|far| (f64::from(far) * f64::from(noise) / 1e6).powi(2));
        let alike = 3.84 * errors.iter().sum::<f64>() / 3.0;
        Ok(must((self.residual(other) - self.residual(best)).abs() <= alike, "the two do not fit alike")?)
    }
}

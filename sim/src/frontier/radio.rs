//! The radio as robots have it: which messages they hear, and where they take themselves to be.

use std::collections::BTreeSet;

use tautline_kernel::frontier::{Condition, DETOUR, Place, Rule, SIDE, clamped, midpoint};
use tautline_kernel::ground::{Area, Cell, Edge};
use tautline_kernel::position::{
    self, Belief, Gate, Odometry, Parameters, Particle, Point, Range, Residual, SightError, Sighting, Signal,
    Swarm, SymmetricMatrix, best_three, linear, locate,
};

use super::place::place_of;
use crate::options::Options;
use tautline_grids::chance::{Dice, deviation};

/// Where a robot is and where it heads, and where it takes itself to be, in sides of a cell.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pose {
    pub(super) at: Point,
    heading_rad: f64,
    pub(super) belief: Belief,
    /// Its last fix.
    pub(super) fixed: Option<Sighting>,
}

impl Pose {
    /// A robot that is known to be in the middle of `cell`, and heads east.
    pub(super) fn start(cell: Cell) -> Self {
        let at = midpoint(cell);
        Self { at, heading_rad: 0.0, belief: Belief::known(at, 0.0), fixed: None }
    }

    /// Where it takes itself to be.
    pub(super) fn fix(&self) -> Place {
        place_of(self.belief.at())
    }
}

/// The radio of a run.
#[derive(Clone, Debug)]
pub(super) struct Radio {
    options: Options,
    pub(super) dice: Dice,
    anchors: Vec<Point>,
    rim: Option<position::Area>,
    /// Of one beacon, and of the mean of all that are heard at a stop; none if distances are exact.
    signals: Option<[Signal; 2]>,
    /// How far wheels err.
    pub(super) odometry: Odometry,
}

impl Radio {
    /// A radio with anchors in the corners of the area and in the middle of its sides. A cell counts as one metre wide:
    /// errors are in proportion to distances, so that the width of a cell does not matter.
    pub(super) fn new(options: Options, area: Area, seed: u64) -> Self {
        let [least, greatest] = corners(area);
        let rim = position::Area::new(least, greatest);
        let (dice, odometry) = (Dice::new(seed, *b"frontier"), options.odometry());
        let (anchors, signals) = (anchors(area, options.anchors()), options.signals());
        Self { options, dice, anchors, rim, signals, odometry }
    }

    /// How far messages are heard, if not everywhere.
    pub(super) const fn range_cells(&self) -> Option<u16> {
        self.options.range_cells
    }

    /// Whether every robot hears everything.
    pub(super) fn is_whole(&self) -> bool {
        self.options.range_cells.is_none() && self.options.loss.is_never()
    }

    /// Whether positions have an error.
    pub(super) fn is_noisy(&self) -> bool {
        self.signals.is_some() || self.odometry != Odometry::EXACT
    }

    /// Whether a robot in one cell hears what one in another says now.
    pub(super) fn is_heard(&mut self, from: Cell, to: Cell) -> bool {
        let (columns, rows) = from.apart(to);
        let is_near = self.options.range_cells.is_none_or(|range| {
            u64::from(columns).pow(2) + u64::from(rows).pow(2) <= u64::from(range).pow(2)
        });
        is_near && (self.options.loss.is_never() || !self.options.loss.happens(&mut self.dice))
    }

    /// The pose of a robot after it has turned to where it takes the midpoint of
    /// `to` to be, and after it has gone there.
    pub(super) fn driven(&mut self, pose: &Pose, to: Cell) -> [Pose; 2] {
        let (turn, way) = pose.belief.towards(midpoint(to));
        let mut turned = *pose;
        self.turn(&mut turned, turn);
        let mut arrived = turned;
        self.drive(&mut arrived, way);
        [turned, arrived]
    }

    fn turn(&mut self, pose: &mut Pose, turn: f64) {
        pose.belief.turned(turn, &self.odometry);
        if turn != 0.0 {
            pose.heading_rad += turn + deviation(self.odometry.turn_rad(), &mut self.dice);
        }
    }

    fn drive(&mut self, pose: &mut Pose, way: f64) {
        pose.belief.driven(way, &self.odometry);
        let way = way * (1.0 + deviation(self.odometry.share(), &mut self.dice));
        let (x, y) = (libm::cos(pose.heading_rad), libm::sin(pose.heading_rad));
        pose.at = Point::new(pose.at.x_m + way * x, pose.at.y_m + way * y);
    }

    /// A robot on its way to `to` goes round an obstacle that is smaller than a
    /// cell; without noise it stays at its midpoint.
    pub(super) fn detour(&mut self, pose: &mut Pose, to: Cell) {
        if self.is_noisy() {
            let (turn, _) = pose.belief.towards(midpoint(to));
            self.turn(pose, turn);
            for (turn, way) in DETOUR {
                self.turn(pose, turn);
                self.drive(pose, way);
            }
        }
    }

    /// The sides of `area` with an obstacle that is smaller than a cell.
    pub(super) fn small(&self, area: Area, seed: u64) -> BTreeSet<Edge> {
        let Some(share) = self.options.small else { return BTreeSet::new() };
        let mut dice = Dice::new(seed, *b"detours ");
        area.edges().filter(|_| share.happens(&mut dice)).collect()
    }

    /// The place where a robot takes an object to be that is at `object`: it sees the bearing and the distance.
    pub(super) fn sees(&mut self, pose: &Pose, object: Point) -> Sighting {
        let (x, y) = (object.x_m - pose.at.x_m, object.y_m - pose.at.y_m);
        let bearing = pose.heading_rad - libm::atan2(y, x) + deviation(SIGHT.bearing_rad, &mut self.dice);
        let far = pose.at.distance_m(object) + deviation(SIGHT.distance_m, &mut self.dice);
        pose.belief.sees(bearing, far, &SIGHT)
    }

    /// The fix of a robot, if distances make one: by least squares, or by a swarm as in the paper.
    fn fix(&mut self, belief: &Belief, ranges: &[Range], mean: &Signal) -> Option<Sighting> {
        let fix = belief.fix(ranges, mean).ok()??;
        if !self.options.swarm {
            return Some(fix);
        }
        let (around, mut particles) = (linear(ranges).ok()?, [Particle::UNUSED; PARTICLES]);
        let swarm =
            Swarm::start(ranges, around, Parameters::CONTRACTING, &mut particles, &mut self.dice).ok()?;
        Some(Sighting { at: swarm.run(&mut self.dice), ..fix })
    }

    /// A robot that counts itself to be in `counted` stands and takes a fix.
    pub(super) fn takes_fix(&mut self, rule: &Rule, pose: &mut Pose, counted: Cell) {
        let near = pose.belief.at();
        let hears = self.options.readings() > 0;
        let Some([one, mean]) = self.signals.filter(|_| hears) else {
            // Distances without noise, of which the wheels leave a robot uncertain.
            if hears {
                let exact = SymmetricMatrix { xx: EXACT, xy: 0.0, yy: EXACT };
                pose.belief.corrected(pose.at, exact, Gate::Open);
            }
            return;
        };
        let three = match &self.anchors[..] {
            &[a, b, c] => Some([a, b, c]),
            all => best_three(all, near),
        };
        let Some(anchors) = three else { return };
        let (dice, draws) = (&mut self.dice, self.options.readings().min(MOST_DRAWS));
        let each_db = mean.noise_db() * f64::from(draws).sqrt();
        let ranges = anchors.map(|anchor| {
            let sum: f64 = (0..draws).map(|_| deviation(each_db, dice)).sum();
            let outliers = self.options.outliers.unwrap_or_default();
            let lost_db = if !outliers.is_never() && outliers.happens(dice) { OUTLIER_DB } else { 0.0 };
            let level_db = one.level_db(pose.at.distance_m(anchor)) + sum / f64::from(draws) - lost_db;
            Range::new(anchor, one.distance_m(level_db))
        });
        if rule.has(Condition::Fuse) {
            // Distances that make no position leave the belief as it is.
            if let Some(fix) = self.fix(&pose.belief, &ranges, &mean) {
                pose.belief.corrected(fix.at, fix.covariance, rule.gate());
                pose.fixed = Some(fix);
            }
        } else if let Ok(fix) = locate(&ranges, Residual::Decibels, &mean, self.rim) {
            let best = fix.best();
            pose.fixed = best.precision.map(|known| Sighting { at: best.at, covariance: known.covariance });
            let fix = place_of(best.at);
            let fix = if rule.has(Condition::Track) { clamped(counted, fix) } else { fix };
            let sides = |units: i32| f64::from(units) / f64::from(SIDE);
            pose.belief = Belief::known(Point::new(sides(fix.x), sides(fix.y)), pose.belief.heading_rad());
        }
    }
}

/// How far robots see objects wrong: by 2° and by 2 % of a cell's side. These values are ours.
const SIGHT: SightError = SightError { bearing_rad: core::f64::consts::PI / 90.0, distance_m: 0.02 };

/// The mean of many beacons is drawn as that of so many, whose errors are as
/// great together: it is normal, with its tails.
const MOST_DRAWS: u16 = 8;

/// The particles of a swarm.
const PARTICLES: usize = 30;

/// An outlier is heard fainter by so much, as behind a wall of concrete. This value is ours.
const OUTLIER_DB: f64 = 10.0;

/// The variance of a fix without noise, so small that it counts for nothing.
const EXACT: f64 = 1e-18;

/// The corners of an area, in sides of a cell: north-west and south-east.
fn corners(area: Area) -> [Point; 2] {
    let (first, last) = (midpoint(area.first()), midpoint(area.last()));
    [Point::new(first.x_m - 0.5, first.y_m - 0.5), Point::new(last.x_m + 0.5, last.y_m + 0.5)]
}

/// So many anchors, from 3 to 8: in the corners of the area, and then in the middle of its sides.
pub(super) fn anchors(area: Area, count: u8) -> Vec<Point> {
    let [Point { x_m: west, y_m: north }, Point { x_m: east, y_m: south }] = corners(area);
    let (column, row) = (f64::midpoint(west, east), f64::midpoint(north, south));
    let corners = [(west, north), (east, north), (west, south), (east, south)];
    let sides = [(column, north), (column, south), (west, row), (east, row)];
    let all = corners.into_iter().chain(sides).map(|(x_m, y_m)| Point::new(x_m, y_m));
    all.take(count.into()).collect()
}

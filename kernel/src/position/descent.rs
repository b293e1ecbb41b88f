//! One way downhill: damped steps (Levenberg) to a place from which none leads further down.

use super::normal::Normal;
use super::{Area, Point, Range, Residual};

/// Steps at most.
const MOST_STEPS: u32 = 60;

/// A way downhill.
pub(super) struct Descent<'a> {
    pub(super) ranges: &'a [Range],
    pub(super) residual: Residual,
    pub(super) area: Option<Area>,
    pub(super) last_m: f64,
}

/// Where it ended.
pub(super) struct Landing {
    pub(super) at: Point,
    pub(super) normal: Normal,
    pub(super) steps: u32,
    pub(super) is_outside: bool,
    pub(super) is_unsettled: bool,
}

impl Descent<'_> {
    /// The normal equations of a place.
    pub(super) fn normal(&self, at: Point) -> Normal {
        Normal::at(self.ranges, self.residual, at)
    }

    /// Downhill from `at`, whose normal equations are known, until the steps
    /// are small or lead to a place that is known.
    pub(super) fn from(
        &self,
        mut at: Point,
        mut normal: Normal,
        is_known: impl Fn(Point) -> bool,
    ) -> Landing {
        let mut damping = 0.0;
        let mut steps = 0;
        let mut is_unsettled = true;
        while is_unsettled && steps < MOST_STEPS && !is_known(at) {
            steps += 1;
            let to = self.step(at, &normal, damping);
            is_unsettled = at.squared_distance(to) > self.last_m * self.last_m;
            let next = self.normal(to);
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
    fn step(&self, at: Point, normal: &Normal, damping: f64) -> Point {
        let (dx, dy) = match self.area.map_or([false; 2], |area| pressed(area, at, normal)) {
            [false, false] => normal.step(damping),
            [true, false] => (0.0, normal.steps_alone(damping).1),
            [false, true] => (normal.steps_alone(damping).0, 0.0),
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

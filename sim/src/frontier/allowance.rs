//! How large a floor may be for the noise that there is: how long robots stand
//! that fuse wheels and fixes (FRONTIER-11).

use tautline_kernel::frontier::{SURE_DEVIATIONS, midpoint};
use tautline_kernel::ground::Area;
use tautline_kernel::position::{Odometry, Point, bound};

use super::radio::anchors;
use crate::options::Options;

/// How long a robot stands before a move, where it hears anchors worst.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Allowance {
    /// For at most so many team moves, each with a fix.
    Stops(u32),
    /// For ever: its wheels alone err too much.
    Never,
}

/// Variances of a turn that a heading has before a move: its own and that of the
/// turns before, which fixes have told in part.
const TURNS: f64 = 4.0;

impl Allowance {
    /// That of an area; `None` where positions have no noise, or no fix is taken.
    ///
    /// It is a bound by Cramér and Rao: no way to find a position from so many beacons has a smaller
    /// covariance without bias, so that a robot which knows nothing but its fixes needs as many to be sure. A
    /// robot that moves knows more by its wheels.
    pub fn new(options: &Options, area: Area) -> Option<Self> {
        let [_, mean] = options.signals().filter(|_| options.readings() > 0)?;
        let Some(most) = most_variance(&options.odometry()) else { return Some(Self::Never) };
        let anchors = anchors(area, options.anchors());
        let variance = |at: Point| {
            let covariance = bound(anchors.iter().copied(), at, &mean)?.covariance;
            Some(covariance.xx.max(covariance.yy))
        };
        let worst = area.cells().filter_map(|cell| variance(midpoint(cell))).fold(0.0, f64::max);
        Some(Self::Stops((worst / most) as u32))
    }
}

/// The greatest variance that a coordinate may have before a move, in squares
/// of a cell's side; `None` if there is none.
fn most_variance(odometry: &Odometry) -> Option<f64> {
    let sure = 0.5 / SURE_DEVIATIONS;
    let lost = odometry.share().powi(2) + TURNS * odometry.turn_rad().powi(2);
    Some(sure * sure - lost).filter(|&left| left > 0.0)
}

//! Robots that fuse wheels and fixes, whose errors are bounded along each axis (FRONTIER-10), and robots that stand
//! until they are sure (FRONTIER-11). Errors are in eighths of a cell.

use tautline_kernel::choice::Oracle;
use tautline_kernel::frontier::{Condition, Rule, midpoint};
use tautline_kernel::ground::Cell;
use tautline_kernel::position::{Belief, Gate, Odometry, Point, SymmetricMatrix};

use crate::engine::{Outcome, Stop, assume, require};

/// Parts of a cell's side.
const PARTS: u32 = 8;

/// Parts of the gain of a fix: K is a number of quarters.
const QUARTERS: u32 = 4;

/// Which errors a robot bears that corrects its place by a share K of what a fix says.
#[derive(Clone, Copy, Debug)]
pub(super) struct FusedBudget {
    /// How often the error of the odometry counts, times the quarters of the gain.
    odometry: fn(u32) -> u32,
    /// The limit that the sum has to be below, in parts of a cell's side.
    below: u32,
    /// Whether fixes count.
    takes_fixes: bool,
}

impl FusedBudget {
    /// E + D/K < L/2.
    pub(super) const FUSED: Self = Self { odometry: |_| QUARTERS, below: PARTS / 2, takes_fixes: true };
    /// E + D/K ≤ L/2.
    pub(super) const AT_MOST: Self = Self { below: PARTS / 2 + 1, ..Self::FUSED };
    /// E + D < L/2, as where each fix is believed.
    pub(super) const WITHOUT_GAIN: Self = Self { odometry: |gain| gain, ..Self::FUSED };
    /// Wheels alone.
    pub(super) const WHEELS_ALONE: Self = Self { takes_fixes: false, ..Self::FUSED };
}

/// The bound of [`stays`], in words.
pub(super) fn errors() -> String {
    format!(
        "every error of a place, of a move and of a fix in 1/{PARTS} of a cell, and \
         every gain in 1/{QUARTERS}, along one axis"
    )
}

/// A number of parts from −most to most.
fn within(oracle: &mut dyn Oracle, most: u32) -> f64 {
    f64::from(oracle.pick(2 * most + 1)) - f64::from(most)
}

/// FRONTIER-10: one move and the fix after it, from any error that the moves before may have left.
///
/// # Errors
/// [`Stop`] if the clause is broken.
pub(super) fn stays(bears: &FusedBudget, oracle: &mut dyn Oracle) -> Outcome {
    let gain = 1 + oracle.pick(QUARTERS);
    let (fix, wheels) = (oracle.pick(PARTS / 2 + 1), oracle.pick(PARTS / 2 + 1));
    assume(gain * fix + (bears.odometry)(gain) * wheels < gain * bears.below)?;
    // E + D (1 − K)/K, which no fix leaves behind more than.
    let most = f64::from(fix) + f64::from(wheels) * f64::from(QUARTERS - gain) / f64::from(gain);
    let off = match oracle.pick(2 * most as u32 + 3) {
        0 => most,
        1 => -most,
        other => f64::from(other) - 2.0 - f64::from(most as u32),
    };
    let parts = f64::from(PARTS);
    let moved = off + within(oracle, wheels);
    require(moved.abs() < parts / 2.0, "the robot is inside the cell that it has counted")?;
    // A drive whose variance is 1/64, and a fix whose variance makes its gain K along x.
    let slips = Odometry::new(0.125, 0.0).ok_or(Stop::Assumed)?;
    let mut belief = Belief::known(Point::new(0.0, 0.0), 0.0);
    belief.driven(1.0, &slips);
    let xx = f64::from(QUARTERS - gain) / f64::from(gain) / 64.0;
    let covariance = SymmetricMatrix { xx, xy: 0.0, yy: 1.0 };
    let really = 1.0 + moved / parts;
    let heard = Point::new(really + within(oracle, fix) / parts, 0.0);
    if bears.takes_fixes {
        belief.corrected(heard, covariance, Gate::Open);
    }
    let left = (really - belief.at().x_m).abs();
    require(left <= most / parts + 1e-9, "a fix leaves no more behind than the moves before")?;
    Ok(if gain == QUARTERS { "a fix that is believed" } else { "a fix that is weighed" })
}

/// A robot that may have to stand.
#[derive(Clone, Copy, Debug)]
pub(super) struct StandingRobot {
    rule: Rule,
    takes_fixes: bool,
}

impl StandingRobot {
    pub(super) const REPAIRED: Self = Self { rule: Rule::REPAIRED, takes_fixes: true };
    pub(super) const UNSURE: Self = Self { rule: Rule::REPAIRED.without(Condition::Sure), takes_fixes: true };
    pub(super) const WHEELS_ALONE: Self = Self { takes_fixes: false, ..Self::REPAIRED };
}

/// The most moves straight ahead before the robot stands.
const MOST_MOVES: u32 = 40;

/// Errors of a drive, as parts of its way: 1/64, 1/32, 1/16.
const SHARES: [f64; 3] = [1.0 / 64.0, 1.0 / 32.0, 1.0 / 16.0];

/// Variances of fixes along each axis, in squares of a cell's side.
const VARIANCES: [f64; 4] = [1.0 / 64.0, 0.25, 1.0, 4.0];

/// The bound of [`is_sure_again`], in words.
pub(super) fn stops() -> String {
    format!(
        "0 to {MOST_MOVES} moves straight ahead without a fix, {} errors of wheels, {} variances of fixes",
        SHARES.len(),
        VARIANCES.len()
    )
}

/// FRONTIER-11: a robot that has moved, and takes fixes until it may move.
///
/// # Errors
/// [`Stop`] if the clause is broken.
pub(super) fn is_sure_again(standing: &StandingRobot, oracle: &mut dyn Oracle) -> Outcome {
    let any = |numbers: &[f64], oracle: &mut dyn Oracle| {
        numbers.get(oracle.pick(numbers.len() as u32) as usize).copied().unwrap_or_default()
    };
    let moves = oracle.pick(MOST_MOVES + 1);
    let (share, variance) = (any(&SHARES, oracle), any(&VARIANCES, oracle));
    let wheels = Odometry::new(share, 0.0).ok_or(Stop::Assumed)?;
    let mut belief = Belief::known(midpoint(Cell::new(0, 0)), 0.0);
    (0..moves).for_each(|_| belief.driven(1.0, &wheels));
    let next = Cell::new(moves as i16 + 1, 0);
    // The variance of the place that a robot may have before a move.
    let most = 1.0 / 64.0 - share * share;
    let covariance = SymmetricMatrix { xx: variance, xy: 0.0, yy: variance };
    let mut fixes = 0_u32;
    while !standing.rule.may_go(&belief, next, &wheels) {
        fixes += 1;
        require(f64::from(fixes) <= variance / most + 1.0, "it is sure after finitely many fixes")?;
        if standing.takes_fixes {
            belief.corrected(belief.at(), covariance, Gate::Closed);
        }
    }
    // Kalman's filter along one axis: the information of the moves and of each fix adds up.
    let moved = f64::from(moves) * share * share;
    let left = moved / (1.0 + moved * f64::from(fixes) / variance);
    require(left < most + 1e-12, "it moves only where it will be inside the next cell")?;
    Ok(if fixes > 0 { "it stands" } else { "it moves on" })
}

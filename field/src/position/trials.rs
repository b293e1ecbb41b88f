//! Trials: a robot at random places measures its distances to anchors, and how far its position is from where it is.

use schemars::JsonSchema;
use serde::{Serialize, Serializer};
use tautline_io::diagnostic::{Diagnostic, Halt, Watch};
use tautline_kernel::choice::Oracle;
use tautline_kernel::position::{
    Area, Fix, Point, Range, Refusal, Residual, Signal, closed_form, linear, locate,
};
use tautline_proofs::engine::SeededOracle;

use super::Solver;
use super::analysis::{Ellipse, PARTS, bound, ellipse, scatter, span, spread_m};
use super::solver::Solution;
use crate::campaign;
use crate::stats::{Estimate, decimals, quantile};
use tautline_grids::chance::deviation;
use tautline_sim::explore::RuleName;

/// Anchors that tell a position, and the rectangle that they span.
#[derive(Clone, PartialEq, Debug)]
pub struct Anchors {
    places: Vec<Point>,
    area: Area,
}

impl Anchors {
    /// Anchors at these places.
    ///
    /// # Errors
    /// [`Refusal`] if they are fewer than three, at fewer than three places, or on one line.
    pub fn new(places: Vec<Point>) -> Result<Self, Refusal> {
        let ranges: Vec<Range> = places.iter().map(|&anchor| Range::new(anchor, 1.0)).collect();
        linear(&ranges)?;
        let [west, east] = span(places.iter().map(|place| place.x_m));
        let [south, north] = span(places.iter().map(|place| place.y_m));
        // Anchors that are on no line span a rectangle.
        let area = Area::new(Point::new(west, south), Point::new(east, north)).ok_or(Refusal::Collinear)?;
        Ok(Self { places, area })
    }

    /// Where they are.
    pub fn places(&self) -> &[Point] {
        &self.places
    }

    /// The rectangle that they span.
    pub const fn area(&self) -> Area {
        self.area
    }

    /// Width and height of that rectangle, in metres.
    pub fn sides_m(&self) -> [f64; 2] {
        let (least, greatest) = (self.area.least(), self.area.greatest());
        [greatest.x_m - least.x_m, greatest.y_m - least.y_m]
    }

    /// A random place in that rectangle.
    pub fn somewhere(&self, oracle: &mut dyn Oracle) -> Point {
        let (least, [width_m, height_m]) = (self.area.least(), self.sides_m());
        let mut part = || f64::from(oracle.pick(STEPS)) / f64::from(STEPS);
        Point::new(least.x_m + width_m * part(), least.y_m + height_m * part())
    }
}

tautline_io::written_as! { Anchors as Vec<[f64; 2]> }

impl Serialize for Anchors {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_seq(self.places.iter().map(|place| [place.x_m, place.y_m]))
    }
}

/// The setting of trials.
#[derive(Clone, PartialEq, Debug, JsonSchema, Serialize)]
pub struct Setting {
    /// The anchors, x and y in metres.
    #[serde(rename = "anchors_m")]
    pub anchors: Anchors,
    /// Where the robot is, x and y in metres; anywhere in the rectangle that the anchors span if that is not said.
    pub at_m: Option<[f64; 2]>,
    /// How strength tells a distance.
    #[serde(flatten, serialize_with = "told")]
    #[schemars(with = "SignalFields")]
    pub signal: Signal,
    /// How a position is found.
    pub solver: Solver,
    /// In which order a swarm is updated.
    pub rule: RuleName,
    /// Whether a position is kept within the rectangle that the anchors span.
    pub inside: bool,
    /// How many trials.
    pub trials: u32,
    /// The seed of all of them.
    pub seed: u64,
}

/// A signal as it is printed.
#[derive(JsonSchema, Serialize)]
struct SignalFields {
    noise_db: f64,
    exponent: f64,
}

fn told<S: Serializer>(signal: &Signal, serializer: S) -> Result<S::Ok, S::Error> {
    SignalFields { noise_db: signal.noise_db(), exponent: signal.propagation().exponent() }
        .serialize(serializer)
}

/// The outcome of trials.
#[derive(Clone, PartialEq, Debug, JsonSchema, Serialize)]
pub struct Report {
    /// Trials whose distances were refused; the numbers below are of the others.
    pub refused: u32,
    /// Trials in which two positions fitted; the better one counts.
    pub two: u32,
    /// Positions that the anchors told badly.
    pub weak: u32,
    /// Positions on the rim of the rectangle, outside of which the distances led.
    pub outside: u32,
    /// Positions whose steps ended before they were small.
    pub unsettled: u32,
    /// How far positions are from where the robot is.
    pub error_m: Errors,
    /// How far they are from the position at which the distances miss least, in metres.
    pub optimum_m: Errors,
    /// The Cramér–Rao bound: no unbiased way has a smaller root mean square error, in metres. None if the anchors tell
    /// nothing about one direction somewhere.
    pub crlb_rms_m: Option<f64>,
    /// The singular values of the anchors' places about their mean: how far they are spread along a line and across it.
    pub spread_m: [f64; 2],
    /// The number of cells that such errors allow.
    pub advice: Advice,
}

/// A median, a 95th percentile and a root mean square.
#[derive(Clone, Copy, PartialEq, Debug, JsonSchema, Serialize)]
pub struct Quantiles<T> {
    /// As many are below as above.
    pub median: T,
    /// 95 % are below.
    pub p95: T,
    /// The root of the mean of the squares.
    pub rms: T,
}

/// Distances, and the 95 % interval of each of their numbers.
#[derive(Clone, Copy, PartialEq, Debug, JsonSchema, Serialize)]
pub struct Errors {
    /// The numbers.
    #[serde(flatten)]
    pub of: Quantiles<f64>,
    /// Their 95 % intervals; of few distances there are none.
    pub interval: Quantiles<Option<[f64; 2]>>,
}

/// How many cells a floor can have from side to side, so that an error of the 99th percentile leaves a robot in its
/// cell.
///
/// With cells of side L, a fix that is wrong by at most E and moves that are wrong by at most D, each fix may be
/// believed if 2E + D < L/2, and the place within a cell, the cell being counted by moves, if E + D < L/2. Here D is 0.
#[derive(Clone, Copy, PartialEq, Debug, JsonSchema, Serialize)]
pub struct Advice {
    /// The shorter side of the rectangle that the anchors span, in metres.
    pub side_m: f64,
    /// The 99th percentile of the errors, in metres.
    pub p99_m: f64,
    /// Cells from side to side, if each fix is believed; 1,000,000,000 stands for so many and more.
    pub cells_believed: u32,
    /// Cells from side to side, if the cell is counted by moves, and fixes correct the place within it; likewise.
    pub cells_tracked: u32,
}

/// The outcome of one trial.
struct Trial {
    error_m: f64,
    optimum_m: f64,
    fix: Option<Fix>,
}

/// Trials between two signs of life.
const PART: u32 = 500;

impl Errors {
    /// Those of these distances, of which there is at least one.
    pub(crate) fn of(mut distances_m: Vec<f64>) -> Self {
        distances_m.sort_by(f64::total_cmp);
        let squares: Vec<f64> = distances_m.iter().map(|distance_m| distance_m * distance_m).collect();
        let square = Estimate::of_values(&squares).unwrap_or(Estimate::NOTHING);
        let root = |square: f64| decimals(square.max(0.0).sqrt(), PARTS);
        let [median, p95] = [0.5, 0.95].map(|share| {
            let (at, interval) = quantile(&distances_m, share);
            (decimals(at, PARTS), interval.map(|ends| ends.map(|end| decimals(end, PARTS))))
        });
        let rms = (root(square.mean), square.interval.map(|ends| ends.map(root)));
        Self {
            of: Quantiles { median: median.0, p95: p95.0, rms: rms.0 },
            interval: Quantiles { median: median.1, p95: p95.1, rms: rms.1 },
        }
    }
}

impl Advice {
    /// Trials that it needs: the largest of fewer errors is not above the true 99th percentile in 95 % of all cases.
    pub const FEWEST: u32 = 300;

    /// The count that stands for so many cells and more, as without noise.
    pub const MOST_CELLS: u32 = 1_000_000_000;

    fn new(side_m: f64, errors_m: &[f64]) -> Self {
        let (p99_m, _) = quantile(errors_m, 0.99);
        let cells = |parts: f64| (side_m / (parts * p99_m)).min(Self::MOST_CELLS.into()) as u32;
        Self {
            side_m: decimals(side_m, PARTS),
            p99_m: decimals(p99_m, PARTS),
            cells_believed: cells(4.0),
            cells_tracked: cells(2.0),
        }
    }
}

impl Setting {
    /// The signs of life that [`Setting::run`] gives.
    pub const fn parts(&self) -> u64 {
        self.trials.div_ceil(PART) as u64
    }

    /// Tries; the report, and the setting with as many trials as were made: all, or the first ones if `watch` ends the
    /// work. The report is the same on any number of threads.
    ///
    /// # Errors
    /// [`Halt`], as `watch` returned it before the first trial, or if no trial has a position.
    pub fn run(&self, watch: &Watch<'_>) -> Result<(Self, Report), Halt> {
        if self.solver == Solver::ClosedForm {
            closed_form(&self.exact()).map_err(super::refused)?;
        }
        let parts = (0..self.trials).step_by(PART as usize);
        let tried = campaign::first(parts, |first| {
            watch()?;
            let numbers = first..self.trials.min(first + PART);
            Ok(numbers.map(|number| self.trial(number.into())).collect::<Vec<_>>())
        })?;
        let tried: Vec<_> = tried.into_iter().flatten().collect();
        let made = Self { trials: tried.len() as u32, ..self.clone() };
        let report = made.report(tried)?;
        Ok((made, report))
    }

    fn report(&self, tried: Vec<(Option<f64>, Result<Trial, Refusal>)>) -> Result<Report, Halt> {
        let bounds: Option<Vec<f64>> = tried.iter().map(|(bound, _)| *bound).collect();
        let mean = |squares: &Vec<f64>| squares.iter().sum::<f64>() / f64::from(self.trials.max(1));
        let crlb_rms_m = bounds.as_ref().map(|squares| decimals(mean(squares).sqrt(), PARTS));
        let located: Vec<Trial> = tried.into_iter().filter_map(|(_, trial)| trial.ok()).collect();
        if located.is_empty() {
            return Err(self.nothing_located().into());
        }
        let count = |is: &dyn Fn(&Fix) -> bool| {
            located.iter().filter(|trial| trial.fix.as_ref().is_some_and(is)).count() as u32
        };
        let mut errors_m: Vec<f64> = located.iter().map(|trial| trial.error_m).collect();
        errors_m.sort_by(f64::total_cmp);
        let [width_m, height_m] = self.anchors.sides_m();
        Ok(Report {
            refused: self.trials - located.len() as u32,
            two: count(&|fix| matches!(fix, Fix::Two(..))),
            weak: count(&|fix| fix.best().flags.is_weak),
            outside: count(&|fix| fix.best().flags.is_outside),
            unsettled: count(&|fix| fix.best().flags.is_unsettled),
            advice: Advice::new(width_m.min(height_m), &errors_m),
            error_m: Errors::of(errors_m),
            optimum_m: Errors::of(located.iter().map(|trial| trial.optimum_m).collect()),
            crlb_rms_m,
            spread_m: spread_m(self.anchors.places()).map(|spread_m| decimals(spread_m, PARTS)),
        })
    }

    /// The distances of the first trial without noise.
    fn exact(&self) -> Vec<Range> {
        let at = self.place(&mut SeededOracle::new(self.seed, 0));
        distances(self.anchors.places(), &self.signal, at, 0.0, &mut SeededOracle::new(0, 0))
    }

    /// The fault of trials that have no position: it is the place's, or that of the noise.
    fn nothing_located(&self) -> Diagnostic {
        let mut oracle = SeededOracle::new(self.seed, 0);
        let solved = self.solver.solve(self.rule, &self.exact(), &self.signal, None, &mut oracle);
        let noisy =
            || Diagnostic::usage("with this noise no distances tell a position", "give a smaller `noise-db`");
        solved.err().map_or_else(noisy, super::refused)
    }

    /// Where the robot is in a trial.
    fn place(&self, oracle: &mut dyn Oracle) -> Point {
        self.at_m.map_or_else(|| self.anchors.somewhere(oracle), |[x_m, y_m]| Point::new(x_m, y_m))
    }

    /// The trial of this number, and the trace of the bound where it is.
    fn trial(&self, number: u64) -> (Option<f64>, Result<Trial, Refusal>) {
        let mut oracle = SeededOracle::new(self.seed, number);
        let at = self.place(&mut oracle);
        let bound = bound(self.anchors.places(), at, &self.signal);
        (bound.map(|bound| bound.covariance.trace()), self.located(at, &mut oracle))
    }

    fn located(&self, at: Point, oracle: &mut SeededOracle) -> Result<Trial, Refusal> {
        let (ranges, (found, fix)) = self.solved(at, oracle)?;
        let optimum = locate(&ranges, Residual::Metres, &self.signal, None)?.best().at;
        Ok(Trial { error_m: found.distance_m(at), optimum_m: found.distance_m(optimum), fix })
    }

    fn solved(&self, at: Point, oracle: &mut SeededOracle) -> Result<(Vec<Range>, Solution), Refusal> {
        let ranges = distances(self.anchors.places(), &self.signal, at, self.signal.noise_db(), oracle);
        let area = self.inside.then(|| self.anchors.area());
        let solved = self.solver.solve(self.rule, &ranges, &self.signal, area, oracle)?;
        Ok((ranges, solved))
    }

    /// Places of the robot with many positions each, to be drawn: where it is said to be, or nine places.
    pub fn spots(&self) -> Vec<Spot> {
        let (least, [width_m, height_m]) = (self.anchors.area().least(), self.anchors.sides_m());
        let part = |number: u32| f64::from(2 * number + 1) / 6.0;
        let nine = (0..9).map(|number| {
            let (column, row) = (number % 3, number / 3);
            Point::new(least.x_m + width_m * part(column), least.y_m + height_m * part(row))
        });
        let places: Vec<Point> =
            self.at_m.map_or_else(|| nine.collect(), |[x_m, y_m]| vec![Point::new(x_m, y_m)]);
        places.into_iter().map(|at| self.spot(at)).collect()
    }

    fn spot(&self, at: Point) -> Spot {
        let found = |number: u64| {
            let (_, (found, _)) = self.solved(at, &mut SeededOracle::new(self.seed, number)).ok()?;
            Some(found)
        };
        let found: Vec<Point> = (0..DRAWN).filter_map(found).collect();
        let bound = bound(self.anchors.places(), at, &self.signal);
        Spot {
            at,
            errors: scatter(&found).map(|(middle, covariance)| ellipse(middle, &covariance)),
            bound: bound.map(|bound| ellipse(at, &bound.covariance)),
            found,
        }
    }
}

/// Steps in which a random place is drawn.
const STEPS: u32 = 1 << 31;

/// Positions that are drawn of a place.
const DRAWN: u64 = 200;

/// A place of the robot, and positions that it took for its own.
#[derive(Clone, PartialEq, Debug)]
pub struct Spot {
    /// Where it is.
    pub at: Point,
    /// The positions that it took for its own.
    pub found: Vec<Point>,
    /// The ellipse in which 95 % of that would be, were it normally distributed.
    pub errors: Option<Ellipse>,
    /// The 95 % ellipse of the smallest covariance that an unbiased way can have.
    pub bound: Option<Ellipse>,
}

/// The distances that a robot at `at` measures, each level with noise of its own.
pub fn distances(
    anchors: &[Point],
    signal: &Signal,
    at: Point,
    noise_db: f64,
    oracle: &mut dyn Oracle,
) -> Vec<Range> {
    let measured = |&anchor: &Point| {
        let level_db = signal.level_db(at.distance_m(anchor)) + deviation(noise_db, oracle);
        Range::new(anchor, signal.distance_m(level_db))
    };
    anchors.iter().map(measured).collect()
}

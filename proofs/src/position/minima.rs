//! Two positions that fit alike (POSITION-3): the mirror image of a robot in the line of its anchors, and second minima
//! that an independent search finds, by looking at a whole grid of places and going downhill in steps along the axes.

use std::array;

use tautline_kernel::choice::Oracle;
use tautline_kernel::position::{Point, Range, Signal};

use super::lattice::{is_line, place};
use super::way::{NOISE_DB, Way, signal};
use crate::engine::{Choices, Outcome, Replay, Stop, assume, require};
use crate::judge::position::Second;
use crate::judge::{AnyCase, Place};

/// The side of the lattice.
const SIDE: u32 = 4;

/// The bound of [`tells_the_mirror_image`], in words.
pub(super) fn lines() -> String {
    format!("three anchors on a line and a robot beside it, at any places of {SIDE}×{SIDE}")
}

/// POSITION-3: anchors on one line, exact distances.
///
/// # Errors
/// [`Stop`] if the clause is broken.
pub(super) fn tells_the_mirror_image(way: &Way, oracle: &mut dyn Oracle) -> Outcome {
    let anchors = [place(oracle, SIDE), place(oracle, SIDE), place(oracle, SIDE)];
    let [first, second, third] = anchors;
    assume(first != second && second != third && first != third && is_line(&anchors))?;
    let at = place(oracle, SIDE);
    assume(!is_line(&[first, second, at]))?;
    let (x, y) = (second.x_m - first.x_m, second.y_m - first.y_m);
    let along = ((at.x_m - first.x_m) * x + (at.y_m - first.y_m) * y) / (x * x + y * y);
    let mirror = Point::new(2.0 * (first.x_m + along * x) - at.x_m, 2.0 * (first.y_m + along * y) - at.y_m);
    let ranges = anchors.map(|anchor| Range::new(anchor, anchor.distance_m(at)));
    let told = way(&ranges, None).map_err(|_| Stop::Violated("positions are told"))?;
    let has = |place: Point| told.places().any(|told| told.distance_m(place) < 1e-6);
    require(has(at) && has(mirror), "the position and its mirror image are told")?;
    Ok(if x == 0.0 || y == 0.0 { "a straight line" } else { "a slanting line" })
}

/// The side of the square of random anchors and robots, in metres.
const SQUARE_M: f64 = 20.0;

/// Uniform numbers whose sum is the deviation of a level: near to a normal one.
const PARTS: u32 = 12;

/// Places along a side of the grid, which reaches half a square beyond it.
const GRID: i32 = 60;

/// Minima nearer to each other may be told as one, in metres.
const APART_M: f64 = 0.5;

/// The anchors that [`tells_second_minima`] draws, in words.
pub(super) fn random_anchors() -> String {
    format!(
        "random triples of anchors and robots in {SQUARE_M}×{SQUARE_M} m, noise {NOISE_DB} dB; \
         minima on a grid of {GRID}×{GRID}"
    )
}

/// The sum of the squared residuals, in square metres.
pub(super) fn cost(ranges: &[Range], at: Point) -> f64 {
    ranges
        .iter()
        .map(|range| range.distance_m - at.distance_m(range.anchor))
        .map(|residual| residual * residual)
        .sum()
}

/// Downhill from `at`, by steps along the axes that are halved where none leads down.
fn downhill(ranges: &[Range], mut at: Point, mut step_m: f64) -> Point {
    while step_m > 1e-7 {
        let steps = [(step_m, 0.0), (-step_m, 0.0), (0.0, step_m), (0.0, -step_m)];
        let places = steps.map(|(x_m, y_m)| Point::new(at.x_m + x_m, at.y_m + y_m));
        let best =
            places.into_iter().min_by(|one, other| cost(ranges, *one).total_cmp(&cost(ranges, *other)));
        match best {
            Some(best) if cost(ranges, best) < cost(ranges, at) => at = best,
            Some(_) | None => step_m /= 2.0,
        }
    }
    at
}

/// The minima on the grid, each once.
fn minima(ranges: &[Range]) -> Vec<Point> {
    let step_m = 2.0 * SQUARE_M / f64::from(GRID);
    let place = |column: i32, row: i32| {
        Point::new(f64::from(column) * step_m - SQUARE_M / 2.0, f64::from(row) * step_m - SQUARE_M / 2.0)
    };
    let mut found: Vec<Point> = Vec::new();
    for (column, row) in (0..GRID).flat_map(|column| (0..GRID).map(move |row| (column, row))) {
        let here = cost(ranges, place(column, row));
        let beside = (-1..=1).flat_map(|x| (-1..=1).map(move |y| (x, y)));
        if beside.into_iter().any(|(x, y)| cost(ranges, place(column + x, row + y)) < here) {
            continue;
        }
        let minimum = downhill(ranges, place(column, row), step_m);
        if found.iter().all(|known| known.distance_m(minimum) > 1e-2) {
            found.push(minimum);
        }
    }
    found
}

/// Distances with noise from random anchors to a random robot.
fn drawn(signal: &Signal, oracle: &mut (impl Oracle + ?Sized)) -> [Range; 3] {
    let mut part = || f64::from(oracle.pick(1 << 20)) / f64::from(1 << 20);
    let mut random = || Point::new(SQUARE_M * part(), SQUARE_M * part());
    let (anchors, at) = ([random(), random(), random()], random());
    anchors.map(|anchor| {
        let deviation = (0..PARTS).map(|_| part()).sum::<f64>() - f64::from(PARTS) / 2.0;
        let level_db = signal.level_db(anchor.distance_m(at)) + NOISE_DB * deviation;
        Range::new(anchor, signal.distance_m(level_db))
    })
}

/// The best minimum on the grid, and another one that fits as well, if there is one. Minima that are nearly too bad, or
/// near the best one, do not count.
fn two_minima(signal: &Signal, ranges: &[Range]) -> Option<(Point, Option<Point>)> {
    let mut found = minima(ranges);
    found.sort_by(|one, other| cost(ranges, *one).total_cmp(&cost(ranges, *other)));
    let [first, others @ ..] = &found[..] else { return None };
    let error = signal.relative_error();
    let squares: f64 = ranges.iter().map(|range| range.distance_m * range.distance_m).sum();
    let ambiguous = 3.84 * error * error * squares / 3.0;
    let above = |place: &Point| cost(ranges, *place) - cost(ranges, *first);
    let fits = |place: &&Point| above(place) < 0.9 * ambiguous && place.distance_m(*first) > APART_M;
    Some((*first, others.iter().find(fits).copied()))
}

/// Millimetres in a metre: the judge knows whole ones.
const MM: f64 = 1e3;

/// The counterexample that these choices make, written down for the judge in whole millimetres: another problem, by
/// less than the clause leaves open.
pub(super) fn second(way: &Way, choices: &Choices) -> Option<Box<dyn AnyCase>> {
    let (signal, answers) = (signal()?, choices.all().collect::<Vec<_>>());
    let whole = |metres: f64| (metres * MM).round() as i32;
    let metres = |(x, y): Place| Point::new(f64::from(x) / MM, f64::from(y) / MM);
    let place = |at: Point| (whole(at.x_m), whole(at.y_m));
    let drawn = drawn(&signal, &mut Replay::new(&answers));
    let (anchors, distances) = (drawn.map(|one| place(one.anchor)), drawn.map(|one| whole(one.distance_m)));
    let ranges: [Range; 3] =
        array::from_fn(|one| Range::new(metres(anchors[one]), f64::from(distances[one]) / MM));
    let settled = |at: Point| {
        let mut at = place(at);
        let fits = |place: Place| cost(&ranges, metres(place));
        loop {
            let beside = (-1..=1).flat_map(|x| (-1..=1).map(move |y| (x, y)));
            let beside = beside.map(|(x, y)| (at.0 + x, at.1 + y));
            match beside.min_by(|one, other| fits(*one).total_cmp(&fits(*other))) {
                Some(better) if fits(better) < fits(at) => at = better,
                Some(_) | None => return at,
            }
        }
    };
    let told = way(&ranges, None).ok()?.places().map(settled).collect();
    let other = settled(two_minima(&signal, &ranges)?.1?);
    let noise = (signal.relative_error() * 1e6).round() as i32;
    Some(Box::new(Second { clause: "POSITION-3", anchors, distances, noise, told, other }))
}

/// POSITION-3: whatever the grid finds to fit as well, by a margin, is told.
///
/// # Errors
/// [`Stop`] if the clause is broken.
pub(super) fn tells_second_minima(way: &Way, oracle: &mut dyn Oracle) -> Outcome {
    let signal = signal().ok_or(Stop::Assumed)?;
    let ranges = drawn(&signal, oracle);
    let (first, second) = two_minima(&signal, &ranges).ok_or(Stop::GivenUp)?;
    let told = way(&ranges, None).map_err(|_| Stop::Violated("a position is told"))?;
    let has = |place: Point| told.places().any(|told| told.distance_m(place) < 1e-2);
    let above = cost(&ranges, told.best) - cost(&ranges, first);
    require(above < 1e-6, "no place of the grid leads to a better fit")?;
    require(second.is_none_or(has), "a second minimum that fits as well is told")?;
    Ok(if second.is_some() { "two minima" } else { "one minimum" })
}

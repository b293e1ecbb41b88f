//! Anchors and robots on a lattice of metres: ways are exact without error (POSITION-1), follow the anchors when these
//! are moved and turned (POSITION-4), and keep to a rectangle (POSITION-6).

use tautline_kernel::choice::{Oracle, one_of};
use tautline_kernel::position::{Area, Point, Range};

use super::way::{Way, WayResult, strongest};
use crate::engine::{Choices, Outcome, Replay, Stop, assume, require};
use crate::judge::AnyCase;
use crate::judge::position::{Exact, FixPair, Strongest};

/// The side of the lattice of three anchors and a robot, and of that of four.
const SIDES: [u32; 2] = [4, 3];

/// How far a position may be from where it should be, for the rounding of numbers.
const NEAR_M: f64 = 1e-6;

/// One of the places of a lattice.
pub(super) fn place(oracle: &mut dyn Oracle, side: u32) -> Point {
    Point::new(f64::from(oracle.pick(side)), f64::from(oracle.pick(side)))
}

/// Whether places are on one line. Those of a lattice are so exactly or not at all.
pub(super) fn is_line(places: &[Point]) -> bool {
    let [first, second, others @ ..] = places else { return true };
    let (x, y) = (second.x_m - first.x_m, second.y_m - first.y_m);
    others
        .iter()
        .all(|place| (x * (place.y_m - first.y_m) - y * (place.x_m - first.x_m)).abs() < f64::MIN_POSITIVE)
}

/// As many different places as are wanted, the later ones after the earlier ones.
fn anchors(oracle: &mut dyn Oracle, count: usize, side: u32) -> Result<Vec<Point>, Stop> {
    let anchors: Vec<Point> = (0..count).map(|_| place(oracle, side)).collect();
    let is_again = |(number, place): (usize, &Point)| anchors[..number].contains(place);
    assume(!anchors.iter().enumerate().any(is_again))?;
    Ok(anchors)
}

/// The bound of [`is_exact`], in words.
pub(super) fn places() -> String {
    let [three, four] = SIDES;
    format!("three anchors and a robot at any places of {three}×{three}, four and a robot of {four}×{four}")
}

/// POSITION-1: anchors that are on no line, and a robot beside them.
///
/// # Errors
/// [`Stop`] if the clause is broken.
pub(super) fn is_exact(way: &Way, oracle: &mut dyn Oracle) -> Outcome {
    let case = one_of(oracle, &[(3, SIDES[0]), (4, SIDES[1])]);
    is_exact_among(way, case, oracle)
}

/// So many anchors on a lattice of this side, on no line, and a robot beside them.
fn is_exact_among(way: &Way, (count, side): (usize, u32), oracle: &mut dyn Oracle) -> Outcome {
    let anchors = anchors(oracle, count, side)?;
    let at = place(oracle, side);
    assume(!is_line(&anchors) && !anchors.contains(&at))?;
    let ranges: Vec<Range> =
        anchors.iter().map(|&anchor| Range::new(anchor, anchor.distance_m(at))).collect();
    let told = way(&ranges, None).ok();
    require(
        told.is_some_and(|told| told.best.distance_m(at) < NEAR_M),
        "the position is where the robot is",
    )?;
    Ok(if count == 3 { "three anchors" } else { "four anchors" })
}

/// The bound of [`is_exact_of_three`], in words.
pub(super) fn places_of_three() -> String {
    let [three, _] = SIDES;
    format!("three anchors and a robot at any places of {three}×{three}")
}

/// POSITION-1 of three anchors: the closed form takes no more.
///
/// # Errors
/// [`Stop`] if the clause is broken.
pub(super) fn is_exact_of_three(way: &Way, oracle: &mut dyn Oracle) -> Outcome {
    is_exact_among(way, (3, SIDES[0]), oracle)
}

/// The bound of [`is_exact_of_four`], in words.
pub(super) fn places_of_four() -> String {
    let [_, four] = SIDES;
    format!("four anchors and a robot at any places of {four}×{four}")
}

/// POSITION-1 of four anchors, of which the best three are taken.
///
/// # Errors
/// [`Stop`] if the clause is broken.
pub(super) fn is_exact_of_four(way: &Way, oracle: &mut dyn Oracle) -> Outcome {
    is_exact_among(way, (4, SIDES[1]), oracle)
}

/// A place of a lattice in whole metres, or tenths of a length, as the judge reads it.
fn written(place: Point, per_metre: f64) -> (i32, i32) {
    ((place.x_m * per_metre).round() as i32, (place.y_m * per_metre).round() as i32)
}

/// The anchors and the robot that these choices make, and whether a position is returned.
fn told(way: Way, choices: &Choices, (count, side): (usize, u32)) -> Option<(Vec<Range>, Point, bool)> {
    let answers: Vec<u32> = choices.all().collect();
    let mut replay = Replay::new(&answers);
    let anchors = anchors(&mut replay, count, side).ok()?;
    let at = place(&mut replay, side);
    let ranges: Vec<Range> =
        anchors.iter().map(|&anchor| Range::new(anchor, anchor.distance_m(at))).collect();
    let is_told = way(&ranges, None).is_ok();
    Some((ranges, at, is_told))
}

/// The case of [`is_exact_of_three`] that these choices make, written down for the judge.
pub(super) fn exact(way: &Way, choices: &Choices) -> Option<Box<dyn AnyCase>> {
    let (ranges, at, is_told) = told(*way, choices, (3, SIDES[0]))?;
    let anchors = [0, 1, 2].map(|number| written(ranges[number].anchor, 1.0));
    Some(Box::new(Exact { clause: "POSITION-1", anchors, robot: written(at, 1.0), is_told }))
}

/// The case of [`is_exact_of_four`] that these choices make, written down for the judge.
pub(super) fn exact_of_strongest(way: &Way, choices: &Choices) -> Option<Box<dyn AnyCase>> {
    let (ranges, at, is_told) = told(*way, choices, (4, SIDES[1]))?;
    let mut taken = strongest(&ranges);
    taken.extend(ranges.iter().find(|range| !taken.contains(range)));
    let anchors = <[Range; 4]>::try_from(taken).ok()?.map(|range| written(range.anchor, 1.0));
    Some(Box::new(Strongest { clause: "POSITION-1", anchors, robot: written(at, 1.0), is_told }))
}

/// Ways to move the plane that keep distances.
const MOVES: [Motion; 6] = [
    [1.0, 0.0, 0.0, 1.0, -7.0, 3.0],
    [0.0, 1.0, -1.0, 0.0, 0.0, 0.0],
    [-1.0, 0.0, 0.0, -1.0, 2.0, 9.0],
    [0.0, 1.0, 1.0, 0.0, 0.0, 0.0],
    [0.6, 0.8, -0.8, 0.6, 0.0, 0.0],
    [0.8, -0.6, -0.6, -0.8, 100.0, -50.0],
];

/// Distances of a robot that need not fit each other, in metres.
const DISTANCES_M: [f64; 3] = [1.0, 2.0, 3.5];

/// The bound of [`follows`], in words.
pub(super) fn moves() -> String {
    let (side, moves, distances) = (SIDES[1], MOVES.len(), DISTANCES_M.len());
    format!(
        "three anchors at any places of {side}×{side}, each at any of {distances} distances; {moves} motions"
    )
}

/// x and y of what was x, of what was y, and of where the origin goes.
type Motion = [f64; 6];

/// Three anchors, distances to them, and a motion.
fn motion(oracle: &mut dyn Oracle) -> Result<(Vec<Point>, Vec<f64>, Motion), Stop> {
    let anchors = anchors(oracle, 3, SIDES[1])?;
    assume(!is_line(&anchors))?;
    let distances: Vec<f64> = anchors.iter().map(|_| one_of(oracle, &DISTANCES_M)).collect();
    Ok((anchors, distances, one_of(oracle, &MOVES)))
}

fn moved([xx, xy, yx, yy, x_m, y_m]: Motion, place: Point) -> Point {
    Point::new(xx * place.x_m + yx * place.y_m + x_m, xy * place.x_m + yy * place.y_m + y_m)
}

/// The anchors and the motion that these choices of [`follows`] make, written down for the judge.
pub(super) fn turned(way: &Way, choices: &Choices) -> Option<Box<dyn AnyCase>> {
    let answers: Vec<u32> = choices.all().collect();
    let (anchors, distances, motion) = motion(&mut Replay::new(&answers)).ok()?;
    let is_told = |of: &dyn Fn(Point) -> Point| {
        let ranges: Vec<Range> =
            anchors.iter().zip(&distances).map(|(&anchor, &far)| Range::new(of(anchor), far)).collect();
        way(&ranges, None).is_ok()
    };
    let is_told = [is_told(&|place| place), is_told(&|place| moved(motion, place))];
    let [xx, xy, yx, yy, x_m, y_m] = motion;
    let motion = [(xx, xy), (yx, yy), (x_m, y_m)].map(|(x_m, y_m)| written(Point::new(x_m, y_m), 10.0));
    let distances = [distances[0], distances[1], distances[2]].map(|far| (10.0 * far).round() as i32);
    let anchors = [anchors[0], anchors[1], anchors[2]].map(|anchor| written(anchor, 1.0));
    Some(Box::new(FixPair { clause: "POSITION-4", anchors, distances, motion, is_told }))
}

/// POSITION-4: the same anchors and distances after a motion.
///
/// # Errors
/// [`Stop`] if the clause is broken.
pub(super) fn follows(way: &Way, oracle: &mut dyn Oracle) -> Outcome {
    let (anchors, distances, motion) = motion(oracle)?;
    let moved = |place| moved(motion, place);
    let told = |of: &dyn Fn(Point) -> Point| {
        let ranges: Vec<Range> =
            anchors.iter().zip(&distances).map(|(&anchor, &far)| Range::new(of(anchor), far)).collect();
        way(&ranges, None)
    };
    let (before, after) = (told(&|place| place), told(&moved));
    // Where three positions fit alike by symmetry, either of two may be told.
    let misses = |place: Point| {
        let squares = anchors
            .iter()
            .zip(&distances)
            .map(|(anchor, far)| (far - place.distance_m(moved(*anchor))).powi(2));
        squares.sum::<f64>()
    };
    let follows = |before: WayResult, after: WayResult| {
        let is_it = |before: Point, after: Point| {
            after.distance_m(moved(before)) < NEAR_M
                || (misses(after) - misses(moved(before))).abs() < NEAR_M * NEAR_M
        };
        let has = |place: Point| after.places().any(|after| is_it(place, after));
        before.other.is_some() == after.other.is_some() && before.places().all(has)
    };
    let is_so = matches!((before, after), (Ok(before), Ok(after)) if follows(before, after));
    require(is_so, "the positions move with the anchors")?;
    Ok(if before.is_ok_and(|told| told.other.is_some()) { "two positions" } else { "one position" })
}

/// The rectangle that positions are kept in.
const RECTANGLE: [f64; 4] = [0.5, 0.0, 2.5, 1.5];

/// The bound of [`keeps_inside`], in words.
pub(super) fn rectangles() -> String {
    let (side, distances, [west, south, east, north]) = (SIDES[1], DISTANCES_M.len(), RECTANGLE);
    format!(
        "three anchors at any places of {side}×{side}, each at any of {distances} distances; \
         the rectangle from {west},{south} to {east},{north}"
    )
}

/// POSITION-6: positions within a rectangle.
///
/// # Errors
/// [`Stop`] if the clause is broken.
pub(super) fn keeps_inside(way: &Way, oracle: &mut dyn Oracle) -> Outcome {
    let anchors = anchors(oracle, 3, SIDES[1])?;
    assume(!is_line(&anchors))?;
    let ranges: Vec<Range> =
        anchors.iter().map(|&anchor| Range::new(anchor, one_of(oracle, &DISTANCES_M))).collect();
    let [west, south, east, north] = RECTANGLE;
    let area = Area::new(Point::new(west, south), Point::new(east, north)).ok_or(Stop::Assumed)?;
    let free = way(&ranges, None).ok();
    let told = way(&ranges, Some(area)).map_err(|_| Stop::Violated("a position is returned"))?;
    let is_inside = |place: Point| area.nearest(place) == place;
    require(told.places().all(is_inside), "every position is in the rectangle")?;
    let was_inside = free.is_some_and(|free| is_inside(free.best));
    let is_same = free.is_some_and(|free| told.best.distance_m(free.best) < NEAR_M);
    require(!was_inside || is_same, "a position that is in the rectangle anyway is not changed")?;
    Ok(if was_inside { "inside" } else { "on the rim" })
}

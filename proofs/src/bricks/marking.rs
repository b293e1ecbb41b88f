//! The local rule of Brick&Mortar (BRICKS-1): whatever is around a cell, marking it leaves its side neighbours
//! connected with each other. The eight cells are gone round one by one here; of the kernel only the rule is asked.

use tautline_kernel::bricks::{Agent, Next, Rule, blocks};
use tautline_kernel::choice::{Oracle, one_of};
use tautline_kernel::floor::{COMPASS, Ring, Scan};
use tautline_kernel::ground::Side;

use crate::engine::{Outcome, require};

/// Cells around a cell.
const AROUND: usize = 8;

/// The bound of [`neighbourhood`].
pub(crate) fn neighbourhoods() -> String {
    format!("all {} neighbourhoods", 1 << AROUND)
}

/// The bound of [`walled`].
pub(crate) fn walled_neighbourhoods() -> String {
    format!("{}, walls between cells in every way", neighbourhoods())
}

/// The states and readings of a cell around: inaccessible, explored, unexplored, explored but missed, inaccessible but
/// missed.
const READINGS: u32 = 5;

/// The bound of [`half_seen`].
pub(crate) fn readings() -> String {
    format!("all neighbourhoods, any of {AROUND} sensors missed: {} readings", READINGS.pow(AROUND as u32))
}

/// The cells around a cell, and the readings of them.
struct Around {
    /// Accessible cells, clockwise from the northern one.
    accessible: [bool; AROUND],
    /// Their readings: a cell in neither set reads as inaccessible.
    unexplored: Ring,
    explored: Ring,
    /// Whether one can go from each to the next, and from the cell to each side neighbour.
    rims: [bool; 8],
    spokes: [bool; 8],
}

impl Around {
    fn scan(&self) -> Scan {
        let ring =
            |bits: &[bool; 8]| Ring((0..8).fold(0, |ring, place| ring | u8::from(bits[place]) << place));
        Scan {
            unexplored: self.unexplored,
            explored: self.explored,
            open: ring(&self.spokes),
            rims: ring(&self.rims),
            ..Scan::default()
        }
    }

    fn is_neighbour(&self, place: usize) -> bool {
        place.is_multiple_of(2) && self.accessible[place] && self.spokes[place]
    }

    /// Whether all accessible side neighbours can be reached from the first one along the ring.
    fn is_connected(&self) -> bool {
        let Some(first) = (0..8).find(|&place| self.is_neighbour(place)) else { return true };
        let mut reached = [false; 8];
        reached[first] = true;
        // Once round in each direction reaches all that can be reached.
        for step in 0..16 {
            let place = (first + step) % 8;
            let next = (place + 1) % 8;
            reached[next] |= reached[place] && self.rims[place] && self.accessible[next];
            let (place, next) = ((first + 16 - step) % 8, (first + 15 - step) % 8);
            reached[next] |= reached[place] && self.rims[next] && self.accessible[next];
        }
        (0..8).all(|place| !self.is_neighbour(place) || reached[place])
    }
}

fn decide(rule: Rule, around: &Around) -> Outcome {
    if blocks(rule, &around.scan()) {
        return Ok("explored");
    }
    require(
        around.is_connected(),
        "a marked cell leaves its accessible side neighbours connected with each other",
    )?;
    Ok("visited")
}

/// All 256 neighbourhoods of accessible and inaccessible cells, without walls between them.
pub(crate) fn neighbourhood(rule: &Rule, oracle: &mut dyn Oracle) -> Outcome {
    let accessible = core::array::from_fn(|_| oracle.flip());
    let explored = Ring((0..8).fold(0, |ring, place| ring | u8::from(accessible[place]) << place));
    let around = Around {
        accessible,
        unexplored: Ring::default(),
        explored,
        rims: core::array::from_fn(|place| accessible[place] && accessible[(place + 1) % 8]),
        spokes: core::array::from_fn(|place| place % 2 == 0),
    };
    decide(*rule, &around)
}

/// All neighbourhoods, and walls between any two of the nine cells.
pub(crate) fn walled(rule: &Rule, oracle: &mut dyn Oracle) -> Outcome {
    let accessible: [bool; AROUND] = core::array::from_fn(|_| oracle.flip());
    let explored = Ring((0..8).fold(0, |ring, place| ring | u8::from(accessible[place]) << place));
    let rims =
        core::array::from_fn(|place| accessible[place] && accessible[(place + 1) % 8] && oracle.flip());
    let spokes = core::array::from_fn(|place| place.is_multiple_of(2) && accessible[place] && oracle.flip());
    decide(*rule, &Around { accessible, unexplored: Ring::default(), explored, rims, spokes })
}

/// All neighbourhoods, and any of their sensors missed: the rule of the second pass.
pub(crate) fn half_seen(rule: &Rule, oracle: &mut dyn Oracle) -> Outcome {
    let (mut unexplored, mut explored) = (Ring::default(), Ring::default());
    let accessible: [bool; AROUND] = core::array::from_fn(|place| {
        let what = oracle.pick(READINGS);
        unexplored.0 |= u8::from(what >= 2) << place;
        explored.0 |= u8::from(what == 1) << place;
        (1..4).contains(&what)
    });
    let is_read = |place: usize| (unexplored.0 | explored.0) >> place & 1 == 1;
    let around = Around {
        accessible,
        unexplored,
        explored,
        rims: core::array::from_fn(|place| is_read(place) && is_read((place + 1) % 8)),
        spokes: core::array::from_fn(|place| place % 2 == 0),
    };
    decide(*rule, &around)
}

/// The bound of [`most_walled`].
pub(crate) fn ways_on() -> String {
    format!("all {} neighbourhoods that are explored, unexplored or walls", 3_u32.pow(AROUND as u32))
}

/// The eyes of an agent: they make of a scan what it sees of it.
pub(crate) type Eyes = fn(Scan) -> Scan;

/// Where an agent goes to explore: of the unexplored side neighbours each has two corners beside it.
pub(crate) fn most_walled(eyes: &Eyes, oracle: &mut dyn Oracle) -> Outcome {
    let what: [u32; AROUND] = core::array::from_fn(|_| oracle.pick(3));
    let ring = |is_in: &dyn Fn(u32) -> bool| {
        Ring((0..AROUND).fold(0, |ring, place| ring | u8::from(is_in(what[place])) << place))
    };
    let accessible = what.map(|what| what > 0);
    let around = Around {
        accessible,
        unexplored: ring(&|what| what == 2),
        explored: ring(&|what| what == 1),
        rims: core::array::from_fn(|place| accessible[place] && accessible[(place + 1) % 8]),
        spokes: core::array::from_fn(|place| place % 2 == 0),
    };
    let mut most: Option<(usize, Side)> = None;
    for (side, place) in COMPASS.into_iter().zip([0, 2, 4, 6]) {
        let walls =
            [(place + 1) % 8, (place + 7) % 8].into_iter().filter(|&corner| what[corner] == 0).count();
        if what[place] == 2 && most.is_none_or(|(most, _)| walls > most) {
            most = Some((walls, side));
        }
    }
    let next = Agent::new(0).decide(Rule::REPAIRED, &eyes(around.scan())).next;
    let Some((_, due)) = most else { return Ok("nothing unexplored") };
    require(
        matches!(next, Next::Goes(side, ..) if side == due),
        "it goes to the unexplored neighbour with the most inaccessible sides",
    )?;
    Ok("a way on")
}

/// The side of a cell in millimetres [Ferranti 2009, V.A].
const SIDE: u16 = 480;

/// Where the sensors around are, in columns and rows, clockwise from the northern one.
const PLACES: [(i32, i32); AROUND] = [(0, -1), (1, -1), (1, 0), (1, 1), (0, 1), (-1, 1), (-1, 0), (-1, -1)];

/// Errors of each coordinate, in halves of the largest.
const ERRORS: [i32; 5] = [0, -2, -1, 1, 2];

/// The bound of [`localised`].
pub(crate) fn errors() -> String {
    format!("{AROUND} sensors, {} errors each, a cell of {} cm", ERRORS.len().pow(2), SIDE / 10)
}

/// The largest error of a coordinate in millimetres: just under half a side, or too much.
pub(crate) const LESS_THAN_HALF: i32 = SIDE as i32 / 2 - 1;
pub(crate) const MORE_THAN_HALF: i32 = SIDE as i32 * 3 / 5;

/// Every sensor around, localised with errors to `most` millimetres.
pub(crate) fn localised(most: &i32, oracle: &mut dyn Oracle) -> Outcome {
    let place = oracle.pick(AROUND as u32);
    let (columns, rows) = PLACES[place as usize];
    let error = |oracle: &mut dyn Oracle| most * one_of(oracle, &ERRORS) / 2;
    let east = columns * i32::from(SIDE) + error(oracle);
    let south = rows * i32::from(SIDE) + error(oracle);
    require(Ring::locate(east, south, SIDE) == Some(place), "the sensor is taken for the one of its cell")?;
    Ok("a sensor")
}

#[cfg(test)]
mod tests {
    use std::ops::RangeInclusive;

    use super::*;

    /// 4,200 times estDist = y²/420.0 − 0.931y + 65.0 in millimetres, a sensor's distance by its line y in an image
    /// [Ferranti 2009, IV].
    const fn est_dist(y: i64) -> i64 {
        100 * y * y - 39_102 * y + 2_730_000
    }

    const MILLIMETRE: i64 = 4_200;

    /// The lines of the highest image of the paper's camera, 1280x1024.
    const LINES: RangeInclusive<i64> = 0..=1023;

    /// The squares of the distances of the sensors beside an agent, at the corners, and two cells away in a row.
    const BESIDE: i64 = (SIDE as i64 * MILLIMETRE).pow(2);
    const AT_A_CORNER: i64 = 2 * BESIDE;
    const TWO_AWAY: i64 = 4 * BESIDE;

    /// The place that is known of a sensor in line `y` that is straight ahead in this direction.
    fn known(y: i64, columns: i32, rows: i32) -> Option<u32> {
        let length = u64::try_from(est_dist(y)).ok()?;
        // At a corner both coordinates are 1/√2 of the distance.
        let coordinate = if columns * rows == 0 { length } else { (length.pow(2) / 2).isqrt() };
        let coordinate = i32::try_from(coordinate / MILLIMETRE as u64).ok()?;
        Ring::locate(columns * coordinate, rows * coordinate, SIDE)
    }

    /// The lines of `among` in which each sensor beside an agent, or each at a corner, is taken for that of its cell.
    fn known_lines(is_corner: bool, among: RangeInclusive<i64>) -> RangeInclusive<i64> {
        let places = || (0..).zip(PLACES).filter(|(place, _)| (place % 2 == 1) == is_corner);
        let is_known =
            |&y: &i64| places().all(|(place, (columns, rows))| known(y, columns, rows) == Some(place));
        let lines: Vec<i64> = among.filter(is_known).collect();
        let (first, last) = (lines[0], lines[lines.len() - 1]);
        assert_eq!(lines.len() as i64, last - first + 1);
        first..=last
    }

    #[test]
    fn the_printed_distance_is_negative_in_210_lines_between_those_where_it_falls_and_rises() {
        assert!(LINES.filter(|&y| est_dist(y) <= 0).eq(91..=300));
        assert_eq!(LINES.min_by_key(|&y| est_dist(y)), Some(196));
        assert_eq!(est_dist(196) / MILLIMETRE, -260);
        assert!((1..=196).all(|y| est_dist(y) < est_dist(y - 1)));
        assert!((197..=1023).all(|y| est_dist(y) > est_dist(y - 1)));
    }

    /// In lines in which the distance falls, the farther a sensor, the less its line. No line says as much as the
    /// distance of a corner, but the farthest are near enough to it.
    #[test]
    fn where_the_printed_distance_falls_it_is_less_than_that_of_a_corner_and_the_cell_is_known() {
        assert!((0..=90).all(|y| est_dist(y).pow(2) < AT_A_CORNER));
        assert_eq!(est_dist(0), 650 * MILLIMETRE);
        assert_eq!(known_lines(true, 0..=90), 0..=36);
        assert_eq!(known_lines(false, 0..=90), 0..=50);
        // A sensor two cells away would be taken for one beside the agent, or for the one underfoot.
        assert!((0..=90).all(|y| matches!(known(y, 1, 0), Some(2) | None)));
        assert_eq!(known(0, 1, 0), Some(2));
    }

    /// In lines in which it rises, a corner needs an image of more than 394 lines. The camera has from 128 to 1024.
    #[test]
    fn where_the_printed_distance_rises_every_cell_is_known_from_line_341_on() {
        let first = |square: i64| (301..=1023).find(|&y| est_dist(y).pow(2) >= square);
        assert_eq!((first(BESIDE), first(AT_A_CORNER), first(TWO_AWAY)), (Some(372), Some(395), Some(422)));
        assert_eq!(known_lines(false, 301..=1023), 341..=398);
        assert_eq!(known_lines(true, 301..=1023), 355..=427);
        assert!((422..=1023).all(|y| known(y, 1, 0).is_none()));
    }

    /// Footnote 2, with 24 steps to the side of a cell. A distance is greatest where an agent is in a corner.
    #[test]
    fn the_ranges_of_footnote_2_are_enough_and_sharp_and_reach_more_than_eight_sensors() {
        const HALF: i32 = 12;
        let square = |x: i32, y: i32| x.pow(2) + y.pow(2);
        let diagonal = square(2 * HALF, 2 * HALF);
        let places = || (-HALF..=HALF).flat_map(|x| (-HALF..=HALF).map(move |y| (x, y)));
        let sensor = |(columns, rows): (i32, i32)| (2 * HALF * columns, 2 * HALF * rows);
        let sensed = places().flat_map(|(x, y)| places().map(move |(to_x, to_y)| square(to_x - x, to_y - y)));
        assert_eq!(sensed.max(), Some(diagonal));
        let asked =
            places().flat_map(|(x, y)| PLACES.map(sensor).map(|(to_x, to_y)| square(to_x - x, to_y - y)));
        assert_eq!(asked.max().map(|most| 4 * most), Some(9 * diagonal));
        let heard = |(x, y): (i32, i32)| {
            let all = (-4..=4).flat_map(|columns| (-4..=4).map(move |rows| sensor((columns, rows))));
            all.filter(|(to_x, to_y)| 4 * square(to_x - x, to_y - y) <= 9 * diagonal).count()
        };
        assert_eq!((heard((0, 0)), heard((HALF, 0)), heard((HALF, HALF))), (13, 16, 16));
        // Its own sensor is among them.
        assert_eq!((places().map(heard).min(), places().map(heard).max()), (Some(12), Some(16)));
    }
}

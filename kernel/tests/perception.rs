//! Finding sensors with a camera: blobs against a flood fill over the whole picture, identifiers against what blinked,
//! angles and distances against the paper's numbers, and its times.

use std::num::NonZeroU16;

use proptest::collection::vec;
use proptest::prelude::*;
use tautline_kernel::perception::Point;
use tautline_kernel::perception::blink::{MAX_BITS, Track, Unidentified, follow, identify, is_on};
use tautline_kernel::perception::blob::{Blob, Colours, NoSample, Picture, Pixel, Thresholds, TooManySets};
use tautline_kernel::perception::polar::{Angle, Round, Unplaced, distance_micrometres};
use tautline_kernel::perception::time::{scan_milliseconds, step_milliseconds};

use crate::drawn::{Drawn, FLOOR, rounded};

fn drawn() -> impl Strategy<Value = Drawn> {
    (1..24_u16, 1..16_u16, prop_oneof![Just(0.1), Just(0.3), Just(0.5), Just(0.8)]).prop_flat_map(
        |(width, height, density)| {
            let lit = vec(prop::bool::weighted(density), usize::from(width) * usize::from(height));
            lit.prop_map(move |lit| Drawn { width, lit })
        },
    )
}

fn thresholds() -> impl Strategy<Value = Thresholds> {
    (0..6_u32, 0..4_u16)
        .prop_map(|(least_pixels, most_gap_pixels)| Thresholds { least_pixels, most_gap_pixels })
}

fn pixel() -> impl Strategy<Value = Pixel> {
    any::<[u8; 3]>().prop_map(|[y, u, v]| Pixel { y, u, v })
}

proptest! {
    #[test]
    fn blobs_are_those_of_a_flood_fill(drawn in drawn(), thresholds in thresholds()) {
        let found: Vec<(u32, Point)> =
            drawn.blobs(thresholds).into_iter().map(|blob| (blob.pixels(), blob.barycentre())).collect();
        let flooded: Vec<(u32, Point)> = drawn
            .flooded(thresholds)
            .into_iter()
            .map(|(pixels, columns, rows)| {
                (pixels, Point { x: rounded(columns, pixels), y: rounded(rows, pixels) })
            })
            .collect();
        // Both are in the order of first pixels, but a flood sees the gaps too.
        let in_order = |mut blobs: Vec<(u32, Point)>| {
            blobs.sort_by_key(|&(pixels, Point { x, y })| (y, x, pixels));
            blobs
        };
        prop_assert_eq!(in_order(found), in_order(flooded));
    }

    #[test]
    fn blobs_move_with_the_picture(
        drawn in drawn(),
        thresholds in thresholds(),
        (left, above, right, below) in (0..9_u16, 0..9_u16, 0..9_u16, 0..9_u16),
    ) {
        let moved: Vec<(u32, Point)> = drawn
            .framed(left, above, right, below)
            .blobs(thresholds)
            .into_iter()
            .map(|blob| (blob.pixels(), blob.barycentre()))
            .collect();
        let expected: Vec<(u32, Point)> = drawn
            .blobs(thresholds)
            .into_iter()
            .map(|blob| {
                let Point { x, y } = blob.barycentre();
                (blob.pixels(), Point { x: x + 256 * u32::from(left), y: y + 256 * u32::from(above) })
            })
            .collect();
        prop_assert_eq!(moved, expected);
    }

    #[test]
    fn a_higher_least_leaves_out_small_blobs_and_a_longer_gap_joins(drawn in drawn(), thresholds in thresholds()) {
        let all = Thresholds { least_pixels: 0, ..thresholds };
        let mut kept = drawn.blobs(all);
        let total: u32 = kept.iter().map(|blob| blob.pixels()).sum();
        prop_assert_eq!(total as usize, drawn.lit.iter().filter(|&&lit| lit).count());

        let wider = drawn.blobs(Thresholds { most_gap_pixels: all.most_gap_pixels + 1, ..all });
        prop_assert!(wider.len() <= kept.len());
        prop_assert_eq!(wider.iter().map(|blob| blob.pixels()).sum::<u32>(), total);

        kept.retain(|blob| blob.pixels() >= thresholds.least_pixels);
        prop_assert_eq!(drawn.blobs(thresholds), kept);
    }

    #[test]
    fn a_buffer_too_small_is_refused_and_never_gives_other_blobs(
        drawn in drawn(),
        thresholds in thresholds(),
        sets in 0..40_usize,
    ) {
        // In every line a set begins at each lit pixel that has no other near enough before it.
        let reach = i32::from(thresholds.most_gap_pixels) + 1;
        let begins = |column: u16, row: u16| {
            let before = (i32::from(column) - reach).max(0) as u16..column;
            drawn.is_lit(column, row) && !before.into_iter().any(|column| drawn.is_lit(column, row))
        };
        let rows = 0..drawn.height();
        let needed = rows.flat_map(|row| (0..drawn.width).map(move |column| (column, row)))
            .filter(|&(column, row)| begins(column, row));
        match needed.clone().nth(sets) {
            None => prop_assert_eq!(drawn.blobs_with(thresholds, sets), Ok(drawn.blobs(thresholds))),
            Some((_, row)) => prop_assert_eq!(drawn.blobs_with(thresholds, sets), Err(TooManySets { row })),
        }
        prop_assert!(needed.count() <= thresholds.most_sets(drawn.width, drawn.height()));
    }

    #[test]
    fn calibration_is_the_tightest_range(
        pixels in vec(pixel(), 30),
        (left, right) in (0..6_u16, 0..6_u16),
        (top, bottom) in (0..5_u16, 0..5_u16),
    ) {
        prop_assume!(left <= right && top <= bottom);
        let picture = Picture::new(&pixels, 6).expect("a picture");
        let colours = Colours::sample(picture, left..=right, top..=bottom).expect("a sample");
        let inside: Vec<Pixel> = (0..5_u16)
            .flat_map(|row| (0..6_u16).map(move |column| (column, row)))
            .zip(&pixels)
            .filter(|((column, row), _)| (left..=right).contains(column) && (top..=bottom).contains(row))
            .map(|(_, &pixel)| pixel)
            .collect();
        let components: [fn(&Pixel) -> u8; 3] = [|pixel| pixel.y, |pixel| pixel.u, |pixel| pixel.v];
        for component in components {
            prop_assert_eq!(Some(component(&colours.least())), inside.iter().map(component).min());
            prop_assert_eq!(Some(component(&colours.greatest())), inside.iter().map(component).max());
        }
        prop_assert!(inside.iter().all(|&pixel| colours.contains(pixel)));
    }

    #[test]
    fn a_colour_is_in_range_if_every_component_is(bounds in (pixel(), pixel()), asked in pixel()) {
        let (one, other) = bounds;
        let ranges = [(one.y, other.y, asked.y), (one.u, other.u, asked.u), (one.v, other.v, asked.v)];
        let inside = ranges.iter().all(|&(least, greatest, asked)| least <= asked && asked <= greatest);
        match Colours::new(one, other) {
            Some(colours) => prop_assert_eq!(colours.contains(asked), inside),
            None => prop_assert!(ranges.iter().any(|&(least, greatest, _)| least > greatest)),
        }
    }
}

#[test]
fn sets_in_lines_that_a_later_line_joins_are_one_blob() {
    let thresholds = |least_pixels, most_gap_pixels| Thresholds { least_pixels, most_gap_pixels };
    let drawn = Drawn::from_rows(&[
        "x.x......x", //
        "x.x.......",
        "xxx....xx.",
        "..........",
        ".x........",
    ]);
    let found = |thresholds| {
        let blobs = drawn.blobs(thresholds).into_iter();
        blobs.map(|blob| (blob.pixels(), blob.barycentre())).collect::<Vec<_>>()
    };
    assert_eq!(
        found(thresholds(1, 0)),
        [
            (7, Point { x: 256, y: 256 * 8 / 7 + 1 }),
            (1, Point::of_pixel(9, 0)),
            (2, Point { x: 256 * 15 / 2, y: 512 }),
            (1, Point::of_pixel(1, 4))
        ]
    );
    // A gap of one line joins the pixel below; the one at the upper right has no column in common with another set.
    assert_eq!(found(thresholds(1, 1)).iter().map(|blob| blob.0).collect::<Vec<_>>(), [8, 1, 2]);
    assert_eq!(found(thresholds(2, 1)).iter().map(|blob| blob.0).collect::<Vec<_>>(), [8, 2]);
    // With a gap of four pixels the lower two join the line of the others, with six that at the upper right too.
    assert_eq!(found(thresholds(1, 4)).iter().map(|blob| blob.0).collect::<Vec<_>>(), [10, 1]);
    assert_eq!(found(thresholds(1, 6)).iter().map(|blob| blob.0).collect::<Vec<_>>(), [11]);
}

#[test]
fn the_largest_pictures_are_gone_through() {
    let wide = Drawn { width: u16::MAX, lit: vec![true; 65_535] };
    let high = Drawn { width: 1, lit: vec![true; 65_535] };
    let found = |drawn: &Drawn, most_gap_pixels| {
        let blobs = drawn.blobs(Thresholds { least_pixels: 1, most_gap_pixels }).into_iter();
        blobs.map(Blob::barycentre).collect::<Vec<_>>()
    };
    assert_eq!(found(&wide, 0), [Point::of_pixel(32_767, 0)]);
    assert_eq!(found(&wide, u16::MAX), [Point::of_pixel(32_767, 0)]);
    assert_eq!(found(&high, 3), [Point::of_pixel(0, 32_767)]);
}

#[test]
fn a_picture_has_whole_lines() {
    let pixels = vec![FLOOR; 65_536];
    assert!(
        Picture::new(&pixels[..6], 3).is_some_and(|picture| (picture.width(), picture.height()) == (3, 2))
    );
    assert!(Picture::new(&pixels[..7], 3).is_none());
    assert!(Picture::new(&pixels[..6], 0).is_none());
    assert!(Picture::new(&[], 3).is_none());
    assert!(Picture::new(&pixels, 1).is_none());
    assert!(Picture::new(&pixels[1..], 1).is_some_and(|picture| picture.height() == 65_535));
}

#[test]
fn a_rectangle_without_pixels_or_beyond_the_picture_calibrates_nothing() {
    let pixels = [FLOOR; 6];
    let picture = Picture::new(&pixels, 3).expect("a picture");
    assert_eq!(Colours::sample(picture, 0..=3, 0..=1), Err(NoSample::Outside));
    assert_eq!(Colours::sample(picture, 0..=2, 0..=2), Err(NoSample::Outside));
    assert_eq!(Colours::sample(picture, 0..=u16::MAX, 0..=u16::MAX), Err(NoSample::Outside));
    #[expect(clippy::reversed_empty_ranges, reason = "a rectangle drawn the wrong way round")]
    let nothing = [(2..=1, 0..=1), (0..=2, 1..=0)];
    for (columns, rows) in nothing {
        assert_eq!(Colours::sample(picture, columns, rows), Err(NoSample::Empty));
    }
    assert_eq!(Ok(Colours::new(FLOOR, FLOOR).expect("colours")), Colours::sample(picture, 0..=2, 0..=1));
}

/// Where an LED that is on is seen.
#[derive(Clone, Copy)]
enum Moves {
    /// Off from where it was last seen on.
    Drifting,
    /// Off from where it was when all were on.
    Trembling,
}

/// How far off the LED of each sensor is seen, for every time interval.
type Offsets = Vec<Vec<(i32, i32)>>;

/// Sensors far enough from each other, by place and identifier; how far off they are seen; the bits of identifiers.
fn blinking() -> impl Strategy<Value = (Vec<(Point, u32)>, Offsets, u8)> {
    (1..=8_usize, 1..=MAX_BITS).prop_flat_map(|(sensors, bits)| {
        let places = prop::sample::subsequence((0..25_u32).collect::<Vec<_>>(), sensors);
        let most = u32::MAX >> (32 - u32::from(bits));
        let identifiers = vec(1..=most, sensors);
        let offsets = vec(vec((-7..=7, -7..=7), sensors), usize::from(bits));
        (places, identifiers, offsets).prop_map(move |(places, identifiers, offsets)| {
            // In 32 steps of at most 7 from cells of 1024 they stay more than 2·10 apart.
            let place = |place| Point { x: 1024 * (place % 5) + 512, y: 1024 * (place / 5) + 512 };
            (places.into_iter().map(place).zip(identifiers).collect(), offsets, bits)
        })
    })
}

fn off(at: Point, (x, y): (i32, i32)) -> Point {
    Point { x: at.x.saturating_add_signed(x), y: at.y.saturating_add_signed(y) }
}

/// What is found out of sensors that blink.
fn watched(
    sensors: &[(Point, u32)],
    moves: Moves,
    offsets: &[Vec<(i32, i32)>],
    bits: u8,
    bound: u32,
) -> Vec<Result<u32, Unidentified>> {
    let mut places: Vec<Point> = sensors.iter().map(|&(place, _)| place).collect();
    let mut tracks: Vec<Track> = places.iter().copied().map(Track::new).collect();
    for (interval, offsets) in (0..bits).zip(offsets) {
        let mut picture = Vec::new();
        for ((place, &offset), &(start, identifier)) in places.iter_mut().zip(offsets).zip(sensors) {
            if is_on(identifier, bits, interval) {
                *place = match moves {
                    Moves::Drifting => off(*place, offset),
                    Moves::Trembling => off(start, offset),
                };
                picture.push(*place);
            }
        }
        // The order in which blobs are listed says nothing.
        picture.reverse();
        follow(&mut tracks, &picture, bound);
    }
    identify(&tracks).collect()
}

proptest! {
    #[test]
    fn sensors_far_from_each_other_are_identified((sensors, offsets, bits) in blinking()) {
        let said = watched(&sensors, Moves::Drifting, &offsets, bits, 10);
        for (&(_, identifier), said) in sensors.iter().zip(said) {
            let is_alone = sensors.iter().filter(|&&(_, other)| other == identifier).count() == 1;
            let expected = if is_alone { Ok(identifier) } else { Err(Unidentified::Shared { identifier }) };
            prop_assert_eq!(said, expected);
        }
    }

    #[test]
    fn nothing_wrong_is_said_of_sensors_however_near(
        (sensors, offsets, bits) in blinking(),
        shrink in 1..400_u32,
        bound in 20..200_u32,
    ) {
        let nearer = |&(place, identifier): &(Point, u32)| {
            (Point { x: place.x / shrink, y: place.y / shrink }, identifier)
        };
        let sensors: Vec<(Point, u32)> = sensors.iter().map(nearer).collect();
        let said = watched(&sensors, Moves::Trembling, &offsets, bits, bound);
        for (&(_, identifier), said) in sensors.iter().zip(said) {
            match said {
                Ok(said) => prop_assert_eq!(said, identifier),
                Err(Unidentified::Ambiguous { interval }) => prop_assert!(interval < bits),
                Err(Unidentified::Shared { identifier: shared }) => prop_assert_eq!(shared, identifier),
                Err(Unidentified::NotAsked | Unidentified::Lost | Unidentified::TooManyPictures) => {
                    prop_assert!(false, "{identifier} of {bits} bits: {said:?}");
                }
            }
        }
    }

    #[test]
    fn a_light_is_taken_up_to_the_bound_and_no_farther(x in -30..30_i32, y in -30..30_i32, bound in 0..40_u32) {
        let place = Point::of_pixel(1, 1);
        let mut track = [Track::new(place)];
        follow(&mut track, &[off(place, (x, y))], bound);
        let is_near = f64::from(x).hypot(f64::from(y)) <= f64::from(bound) + 1e-9;
        let expected = if is_near { Ok(1) } else { Err(Unidentified::Lost) };
        prop_assert_eq!(identify(&track).collect::<Vec<_>>(), [expected]);
        prop_assert_eq!(track[0].place(), if is_near { off(place, (x, y)) } else { place });
    }
}

#[test]
fn the_sensor_101_is_on_off_on() {
    assert_eq!([0, 1, 2].map(|interval| is_on(0b101, 3, interval)), [true, false, true]);
    assert_eq!([0, 1, 2, 3].map(|interval| is_on(0b101, 4, interval)), [false, true, false, true]);
    assert_eq!((is_on(0b101, 3, 3), is_on(1, 0, 0)), (false, false));
    let place = Point::of_pixel(40, 30);
    let mut track = [Track::new(place)];
    for picture in [&[place] as &[Point], &[], &[place]] {
        follow(&mut track, picture, 256);
    }
    assert_eq!(identify(&track).collect::<Vec<_>>(), [Ok(0b101)]);
}

#[test]
fn what_cannot_be_told_is_not_guessed() {
    let said = |tracks: &[Point], pictures: &[&[Point]]| {
        let mut tracks: Vec<Track> = tracks.iter().copied().map(Track::new).collect();
        for picture in pictures {
            follow(&mut tracks, picture, 512);
        }
        identify(&tracks).collect::<Vec<_>>()
    };
    let [here, beside, far] =
        [(10, 10), (12, 10), (40, 10)].map(|(column, row)| Point::of_pixel(column, row));
    let ambiguous = |interval| Err(Unidentified::Ambiguous { interval });
    assert_eq!(said(&[here], &[]), [Err(Unidentified::NotAsked)]);
    assert_eq!(said(&[here, far], &[&[far], &[far]]), [Err(Unidentified::Lost), Ok(0b11)]);
    // A second light near one sensor; one light near two sensors.
    assert_eq!(said(&[here, far], &[&[here], &[here, beside], &[far]]), [ambiguous(1), Ok(0b001)]);
    assert_eq!(said(&[here, beside, far], &[&[here, far]]), [ambiguous(0), ambiguous(0), Ok(1)]);
    assert_eq!(said(&[here], &[&[here], &[here, beside], &[here, beside]]), [ambiguous(1)]);
    assert_eq!(said(&[here, far], &[&[here, far]]), [Err(Unidentified::Shared { identifier: 1 }); 2]);
    let on: &[Point] = &[here];
    assert_eq!(said(&[here], &[on; 32]), [Ok(u32::MAX)]);
    assert_eq!(said(&[here], &[on; 33]), [Err(Unidentified::TooManyPictures)]);
    // Places as far apart as there are, and some of which the squares just do not fit.
    let (from, to) = (Point { x: 0, y: 0 }, Point { x: 3_037_000_500, y: 3_037_000_500 });
    assert!(!from.is_within(100_000, to) && from.is_within(u32::MAX, Point { x: u32::MAX, y: 0 }));
    let corners = [Point { x: 0, y: 0 }, Point { x: u32::MAX, y: u32::MAX }];
    assert_eq!(said(&corners, &[&corners[..1], &corners[1..]]), [Ok(0b10), Ok(0b01)]);
}

fn round(steps: u16, width: u16, view_degrees: u32) -> Round {
    let number = |number| NonZeroU16::new(number).expect("not 0");
    Round { steps: number(steps), width: number(width), view: Angle::of_millidegrees(1000 * view_degrees) }
}

/// From `from` to `to` in parts, the shorter way round.
fn turned(from: Angle, to: Angle) -> i32 {
    to.parts().wrapping_sub(from.parts()).cast_signed()
}

proptest! {
    #[test]
    fn angles_wrap_round(
        (steps, width, view) in (1..400_u16, 1..2000_u16, 1..180_u32),
        step in 0..1000_u32,
        place in 0.0..=1.0_f64,
    ) {
        let round = round(steps, width, view);
        let last = 256 * u32::from(width - 1);
        let x = (place * f64::from(last)) as u32;
        let angle = |step, x| round.angle(step, Point { x, y: 0 });
        let here = angle(step, x).expect("inside");
        prop_assert_eq!(angle(step + u32::from(steps), x), Ok(here));
        // In degrees, as one would write it down.
        let columns = (f64::from(x) + 128.0) / (256.0 * f64::from(width)) - 0.5;
        let degrees = 360.0 * f64::from(step) / f64::from(steps) + columns * f64::from(view);
        let off = (f64::from(here.millidegrees()) / 1000.0 - degrees).rem_euclid(360.0);
        prop_assert!(off.min(360.0 - off) < 0.001, "{degrees} as {here:?}");
        // A mirrored light is as far from straight ahead on the other side, but for rounding down.
        let ahead = round.angle(0, Point { x: last / 2, y: 0 }).expect("inside");
        let (left, right) = (angle(0, x).expect("inside"), angle(0, last - x).expect("inside"));
        let sum = i64::from(turned(ahead, left)) + i64::from(turned(ahead, right));
        prop_assert!(view > 90 || last % 2 == 1 || sum.abs() <= 2, "{sum}");
        prop_assert_eq!(angle(step, last + 1), Err(Unplaced::Column));
        prop_assert_eq!(angle(step, u32::MAX), Err(Unplaced::Column));
    }

    #[test]
    fn distance_falls_down_to_row_91_and_there_is_none_below(y in 0..60_000_u32) {
        let distance = |y| distance_micrometres(Point { x: 0, y });
        let row = f64::from(y) / 256.0;
        let centimetres = row * row / 420.0 - 0.931 * row + 65.0;
        match (distance(y), distance(y + 1)) {
            (Ok(here), below) => {
                prop_assert!(here > 0 && (f64::from(here) / 10_000.0 - centimetres).abs() < 0.000_101);
                prop_assert!(below.is_err() || below.is_ok_and(|below| below < here));
            }
            (Err(none), below) => {
                prop_assert!(centimetres < 0.000_1 || row > 195.51);
                prop_assert_eq!((none, below), (Unplaced::Row, Err(Unplaced::Row)));
            }
        }
    }
}

#[test]
fn four_steps_of_a_round_are_quarters() {
    let round = round(4, 161, 60);
    let angle = |step, column| round.angle(step, Point::of_pixel(column, 0)).map(Angle::millidegrees);
    assert_eq!([0, 1, 2, 3, 4].map(|step| angle(step, 80)), [0, 90_000, 180_000, 270_000, 0].map(Ok));
    // 80 of 161 columns of 60 degrees: 29.814.
    assert_eq!((angle(0, 0), angle(0, 160)), (Ok(330_186), Ok(29_814)));
    assert_eq!(angle(0, 161), Err(Unplaced::Column));
    assert_eq!(angle(u32::MAX, 80), Ok(270_000));
    assert_eq!([0, 90_000, 360_000].map(|angle| Angle::of_millidegrees(angle).parts()), [0, 1 << 30, 0]);
}

#[test]
fn the_fitted_distance_at_some_rows() {
    let distance = |row| distance_micrometres(Point::of_pixel(0, row));
    // 42²/420 = 4.2, 0.931·42 = 39.102; 84²/420 = 16.8, 0.931·84 = 78.204; 90²/420 = 19.2857, 0.931·90 = 83.79.
    assert_eq!([0, 42, 84, 90].map(distance), [650_000, 300_980, 35_960, 4_957].map(Ok));
    // Row 91.0 is the first without: 91²/420 = 19.7167, 0.931·91 = 84.721. From row 301 on the fit is above zero again.
    assert_eq!([91, 195, 196, 301, 400, u16::MAX].map(distance), [Err(Unplaced::Row); 6]);
    assert_eq!(distance_micrometres(Point { x: 0, y: u32::MAX }), Err(Unplaced::Row));
    let polar = round(4, 161, 60).locate(1, Point::of_pixel(80, 42)).expect("a place");
    assert_eq!((polar.angle.millidegrees(), polar.distance_micrometres), (90_000, 300_980));
}

#[test]
fn times_are_those_of_the_paper() {
    // No sensor: 18.28 · 1.81 s = 33.0868 s.
    assert_eq!(scan_milliseconds(0), 33_087);
    // Eight: 8 · 9.55 s + 10.28 · 1.81 s = 76.4 s + 18.6068 s.
    assert_eq!(scan_milliseconds(8), 95_007);
    assert_eq!(step_milliseconds(8), 150_427);
    // Eighteen leave 0.28 turns: 171.9 s + 0.5068 s. The nineteenth leaves none.
    assert_eq!(scan_milliseconds(18), 172_407);
    assert_eq!(scan_milliseconds(19), 181_450);
    assert_eq!(scan_milliseconds(u8::MAX), 2_435_250);
}

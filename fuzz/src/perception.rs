//! What a camera sees, in the bytes: pictures of LEDs, lights that blink, and places in a picture.

use std::num::NonZeroU16;

use tautline_kernel::choice::Oracle;
use tautline_kernel::perception::Point;
use tautline_kernel::perception::blink::{MAX_BITS, Track, Unidentified, follow, identify, is_on};
use tautline_kernel::perception::blob::{Thresholds, TooManySets};
use tautline_kernel::perception::polar::{Angle, Round, distance_micrometres};
use tautline_proofs::engine::Tape;

use super::numbers;

#[path = "../../kernel/tests/support/drawn.rs"]
mod drawn;

use drawn::{Drawn, rounded};

/// Blobs are those of a flood fill, however they lie and whatever room there is; sensors far from each other are
/// identified by their blinking, and of others nothing wrong is said; every place has one angle, and a distance that
/// falls down to where there is none.
pub fn perception(bytes: &[u8]) {
    let numbers = numbers(bytes);
    let mut bytes = Tape(&numbers);
    match bytes.pick(3) {
        0 => blobs(&mut bytes),
        1 => blinking(&mut bytes),
        _ => places(&mut bytes),
    }
}

fn blobs(bytes: &mut Tape<'_>) {
    let width = 1 + bytes.pick(40);
    let thresholds = Thresholds { least_pixels: bytes.pick(6), most_gap_pixels: bytes.pick(5) as u16 };
    let sets = bytes.pick(64) as usize;
    // Eight pixels in a byte, and at least one line.
    let mut lit: Vec<bool> =
        bytes.0.iter().flat_map(|byte| (0..8).map(move |bit| byte >> bit & 1 == 1)).collect();
    lit.resize(lit.len().clamp(width as usize, 1_600) / width as usize * width as usize, false);
    let drawn = Drawn { width: width as u16, lit };
    let found = drawn.blobs(thresholds);
    let mut seen: Vec<(u32, Point)> = found.iter().map(|blob| (blob.pixels(), blob.barycentre())).collect();
    let mean =
        |(pixels, columns, rows)| (pixels, Point { x: rounded(columns, pixels), y: rounded(rows, pixels) });
    let mut flooded: Vec<(u32, Point)> = drawn.flooded(thresholds).into_iter().map(mean).collect();
    let in_order =
        |blobs: &mut Vec<(u32, Point)>| blobs.sort_by_key(|&(pixels, Point { x, y })| (y, x, pixels));
    in_order(&mut seen);
    in_order(&mut flooded);
    assert_eq!(seen, flooded, "{drawn:?}");
    match drawn.blobs_with(thresholds, sets) {
        Ok(again) => assert_eq!(again, found),
        Err(TooManySets { row }) => assert!(row < drawn.height()),
    }
}

/// Sensors blink about where they were first seen.
fn blinking(bytes: &mut Tape<'_>) {
    let (sensors, bits) = (1 + bytes.pick(8), 1 + bytes.pick(MAX_BITS.into()) as u8);
    let spacing = 1 << bytes.pick(12);
    let bound = 20 + bytes.pick(200);
    let most = u32::MAX >> (32 - u32::from(bits));
    let sensors: Vec<(Point, u32)> = (0..sensors)
        .map(|_| {
            let place = Point { x: 64 + spacing * bytes.pick(16), y: 64 + spacing * bytes.pick(16) };
            let identifier = (0..4).fold(0_u32, |number, _| number << 8 | bytes.pick(256));
            (place, 1 + identifier % most)
        })
        .collect();
    let mut tracks: Vec<Track> = sensors.iter().map(|&(place, _)| Track::new(place)).collect();
    for interval in 0..bits {
        let lit = sensors.iter().filter(|&&(_, identifier)| is_on(identifier, bits, interval));
        let picture: Vec<Point> = lit
            .map(|&(place, _)| Point { x: place.x + bytes.pick(15) - 7, y: place.y + bytes.pick(15) - 7 })
            .rev()
            .collect();
        follow(&mut tracks, &picture, bound);
    }
    for (track, (&(place, identifier), said)) in sensors.iter().zip(identify(&tracks)).enumerate() {
        let others = || sensors.iter().enumerate().filter(|&(other, _)| other != track);
        match said {
            Ok(said) => assert_eq!(said, identifier),
            Err(Unidentified::Ambiguous { interval }) => {
                let is_near = |other: Point| place.is_within(2 * (bound + 20), other);
                assert!(interval < bits && others().any(|(_, &(other, _))| is_near(other)));
            }
            Err(Unidentified::Shared { identifier: shared }) => {
                assert_eq!(shared, identifier);
                assert!(others().any(|(_, &(_, other))| other == identifier));
            }
            Err(lost) => panic!("{identifier} of {bits} bits: {lost}"),
        }
    }
    // Lights that nobody sent, in one picture more than there can be.
    for _ in 0..=MAX_BITS {
        let lights: Vec<Point> =
            (0..bytes.pick(4)).map(|_| Point { x: number(bytes), y: number(bytes) }).collect();
        follow(&mut tracks, &lights, number(bytes));
    }
    assert!(identify(&tracks).all(|said| said.is_err()), "more pictures than bits");
}

fn places(bytes: &mut Tape<'_>) {
    let size = |bytes: &mut Tape<'_>| NonZeroU16::new(number(bytes) as u16).unwrap_or(NonZeroU16::MIN);
    let round = Round { steps: size(bytes), width: size(bytes), view: Angle::of_millidegrees(number(bytes)) };
    let (step, point) = (number(bytes), Point { x: number(bytes), y: number(bytes) });
    let last = 256 * (u32::from(round.width.get()) - 1);
    let located = round.locate(step, point);
    assert_eq!(round.angle(step, point).is_ok(), point.x <= last);
    assert_eq!(located.is_ok(), point.x <= last && distance_micrometres(point).is_ok());
    let steps = u32::from(round.steps.get());
    if let Some(later) = step.checked_add(steps) {
        assert_eq!(round.angle(later, point), round.angle(step, point), "a whole turn");
    }
    let (Some(y), Ok(here)) = (point.y.checked_add(1), distance_micrometres(point)) else { return };
    let below = distance_micrometres(Point { y, ..point });
    assert!(below.is_err() || below.is_ok_and(|below| below < here), "{here} at {point:?}");
}

/// A number of four bytes.
fn number(bytes: &mut Tape<'_>) -> u32 {
    (0..4).fold(0, |number, _| number << 8 | bytes.pick(256))
}

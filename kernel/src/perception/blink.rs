//! Who a sensor is, from its blinking [Ferranti 2009, IV, “Discovering the IDs of detected sensors”]: in each time interval
//! its LED is on or off as one bit of its identifier says, the most significant bit first, and the agent takes one
//! picture in each.
//!
//! Ours are these readings:
//!
//! - All identifiers have the same number of bits, which all know: 1 to 32, as many as there are pictures.
//! - A sensor is followed from the picture in which all LEDs were on: a light is taken for its LED if the barycentre is
//!   within a bound of where the LED was last seen on.
//! - Nothing is guessed. Where two lights are within the bound of one sensor, or one light within the bound of two
//!   sensors, these sensors have no identifier, and are followed no farther. So an identifier is right as long as every
//!   LED that is on is seen within the bound of where it was last followed to, and every light is an LED's. For an agent
//!   that stands still the bound is twice what barycentres tremble by.
//! - No sensor has the identifier 0: it would never be on, as one that is lost.

use core::fmt;

use super::Point;

/// The most bits of an identifier.
pub const MAX_BITS: u8 = 32;

/// Whether the LED of the sensor `identifier` of `bits` bits is on in time interval `interval`, counted from 0. It is
/// off in intervals beyond the last bit.
pub fn is_on(identifier: u32, bits: u8, interval: u8) -> bool {
    let place = bits.checked_sub(1).and_then(|last| last.checked_sub(interval));
    place.and_then(|place| identifier.checked_shr(place.into())).is_some_and(|shifted| shifted & 1 == 1)
}

/// A sensor that is followed over pictures.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Track {
    place: Point,
    identifier: u32,
    intervals: u8,
    seen: Seen,
    doubt: Option<Unidentified>,
}

/// What the latest picture shows of a sensor.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
enum Seen {
    Off,
    On(Point),
    Doubtful,
}

/// Why a sensor has no identifier.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Unidentified {
    /// No picture was taken.
    NotAsked,
    /// In this time interval, counted from 0, two lights could be its LED, or its light another sensor's.
    Ambiguous {
        /// The first such interval.
        interval: u8,
    },
    /// It was on in no picture.
    Lost,
    /// There were more pictures than an identifier can have bits.
    TooManyPictures,
    /// Another sensor blinked alike.
    Shared {
        /// The identifier of both.
        identifier: u32,
    },
}

impl fmt::Display for Unidentified {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotAsked => f.write_str("no picture was taken of the blinking"),
            Self::Ambiguous { interval } => {
                write!(
                    f,
                    "in time interval {interval} it cannot be told from another light: take a smaller bound"
                )
            }
            Self::Lost => f.write_str("its LED was on in no picture; 0 is no identifier"),
            Self::TooManyPictures => {
                write!(f, "an identifier has at most {MAX_BITS} bits: take fewer pictures")
            }
            Self::Shared { identifier } => write!(f, "two sensors blinked as {identifier}: ask again"),
        }
    }
}

impl core::error::Error for Unidentified {}

impl Track {
    /// A sensor whose LED, when all were on, was seen at `place`.
    pub const fn new(place: Point) -> Self {
        Self { place, identifier: 0, intervals: 0, seen: Seen::Off, doubt: None }
    }

    /// Where its LED was last seen on, as far as it could be followed.
    pub const fn place(&self) -> Point {
        self.place
    }

    /// What its blinking says by itself.
    fn read(&self) -> Result<u32, Unidentified> {
        match (self.doubt, self.intervals, self.identifier) {
            (Some(doubt), _, _) => Err(doubt),
            (None, 0, _) => Err(Unidentified::NotAsked),
            (None, _, 0) => Err(Unidentified::Lost),
            (None, _, identifier) => Ok(identifier),
        }
    }

    fn take_in(&mut self) {
        let bit = match self.seen {
            Seen::Off => 0,
            Seen::On(place) => {
                self.place = place;
                1
            }
            Seen::Doubtful => {
                self.doubt = self.doubt.or(Some(Unidentified::Ambiguous { interval: self.intervals }));
                0
            }
        };
        if self.intervals == MAX_BITS {
            self.doubt = self.doubt.or(Some(Unidentified::TooManyPictures));
        } else {
            self.intervals += 1;
            self.identifier = self.identifier << 1 | bit;
        }
    }
}

/// Takes in the picture of the next time interval, by the barycentres of the blobs in it. An LED is at most `bound`,
/// in 256ths of a pixel, from where it was last seen on.
pub fn follow(tracks: &mut [Track], picture: &[Point], bound: u32) {
    // All are compared with where the others were before this picture.
    for track in 0..tracks.len() {
        tracks[track].seen = look(tracks, track, picture, bound);
    }
    tracks.iter_mut().for_each(Track::take_in);
}

fn look(tracks: &[Track], track: usize, picture: &[Point], bound: u32) -> Seen {
    let is_near = |track: &Track, light: Point| track.place.is_within(bound, light);
    let mut lights = picture.iter().copied().filter(|&light| is_near(&tracks[track], light));
    match (lights.next(), lights.next()) {
        (None, _) => Seen::Off,
        (Some(light), None) if tracks.iter().filter(|other| is_near(other, light)).count() == 1 => {
            Seen::On(light)
        }
        (Some(_), None | Some(_)) => Seen::Doubtful,
    }
}

/// What the pictures so far say of each of `tracks`: its identifier, or why it has none.
pub fn identify(tracks: &[Track]) -> impl Iterator<Item = Result<u32, Unidentified>> {
    tracks.iter().map(|track| {
        let identifier = track.read()?;
        let alike = tracks.iter().filter(|other| other.read() == Ok(identifier)).count();
        if alike == 1 { Ok(identifier) } else { Err(Unidentified::Shared { identifier }) }
    })
}

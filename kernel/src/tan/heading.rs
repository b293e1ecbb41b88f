//! Directions in steps of 15° [Jiang 2011, 3.4, step 3], and the scan of a directional antenna once round.

use crate::net::Strength;

/// Parts of a unit vector.
const UNIT: i32 = 1_000_000;

/// The cosines of 0°, 15°, … 90°, in millionths.
const COSINES: [i32; 7] = [1_000_000, 965_926, 866_025, 707_107, 500_000, 258_819, 0];

/// A direction: a multiple of 15° from +x towards +y.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Heading(u8);

impl Heading {
    /// Directions in all.
    pub const COUNT: u8 = 24;

    /// The direction of +x.
    pub const FIRST: Self = Self(0);

    /// Every direction, in the order of a scan.
    pub fn all() -> impl Iterator<Item = Self> {
        (0..Self::COUNT).map(Self)
    }

    /// In degrees, below 360.
    pub const fn degrees(self) -> u16 {
        self.0 as u16 * 15
    }

    /// This direction turned by `steps` of 15° towards +y.
    pub const fn turned(self, steps: u8) -> Self {
        Self(((self.0 as u16 + steps as u16) % Self::COUNT as u16) as u8)
    }

    /// A quarter turn towards +y.
    pub const fn quarter(self) -> Self {
        self.turned(Self::COUNT / 4)
    }

    /// The way back.
    pub const fn opposite(self) -> Self {
        self.turned(Self::COUNT / 2)
    }

    /// A step of length 1 in this direction, x and y in millionths.
    pub fn vector(self) -> (i32, i32) {
        (cosine(self.0), cosine((self.0 + Self::COUNT * 3 / 4) % Self::COUNT))
    }
}

/// The cosine of a multiple of 15°, in millionths.
fn cosine(step: u8) -> i32 {
    let from_first = step.min(Heading::COUNT.saturating_sub(step));
    let (place, sign) = if from_first <= 6 { (from_first, 1) } else { (12 - from_first, -1) };
    sign * COSINES.get(usize::from(place)).copied().unwrap_or(UNIT)
}

/// One turn of the antenna, direction after direction.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Scan {
    at: u8,
    best: Option<(Strength, Heading)>,
}

impl Scan {
    /// A turn at its beginning.
    pub const START: Self = Self { at: 0, best: None };

    /// Where the antenna points next; `None` after the last direction.
    pub const fn heading(&self) -> Option<Heading> {
        if self.at < Heading::COUNT { Some(Heading(self.at)) } else { None }
    }

    /// The turn at its next direction, with the strength `heard` in this one.
    #[must_use]
    pub fn measure(self, heard: Option<Strength>) -> Self {
        let Some(heading) = self.heading() else { return self };
        let is_better = |strength: Strength| self.best.is_none_or(|(best, _)| strength > best);
        let best = heard.filter(|&strength| is_better(strength)).map(|strength| (strength, heading));
        Self { at: self.at + 1, best: best.or(self.best) }
    }

    /// The strongest signal so far and its direction, the first of equal ones; `None` if nothing was heard.
    pub const fn best(&self) -> Option<(Strength, Heading)> {
        self.best
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    /// The direction nearest to that of (`x`, `y`), the first of two that are
    /// equally near; the first of all for (0, 0).
    pub(in crate::tan) fn towards(x: i32, y: i32) -> Heading {
        let along = |heading: &Heading| {
            let (cosine, sine) = heading.vector();
            i64::from(x) * i64::from(cosine) + i64::from(y) * i64::from(sine)
        };
        Heading::all()
            .fold(Heading::FIRST, |best, heading| if along(&heading) > along(&best) { heading } else { best })
    }

    #[test]
    fn every_direction_is_a_unit_vector_and_the_one_nearest_to_itself() {
        for heading in Heading::all() {
            let (x, y) = heading.vector();
            let length = i64::from(x).pow(2) + i64::from(y).pow(2);
            assert!(length.abs_diff(i64::from(UNIT).pow(2)) < 2_000_000, "{heading:?}: {length}");
            assert_eq!(towards(x, y), heading);
            assert_eq!(heading.opposite().vector(), (-x, -y));
            assert_eq!(heading.quarter().vector(), (-y, x));
            assert_eq!(heading.turned(Heading::COUNT), heading);
        }
        assert_eq!(Heading::FIRST.vector(), (UNIT, 0));
        assert_eq!(Heading::FIRST.quarter().degrees(), 90);
        assert_eq!(towards(0, 0), Heading::FIRST);
    }

    #[test]
    fn the_nearest_direction_is_never_more_than_seven_and_a_half_degrees_off() {
        for x in -40..=40 {
            for y in -40..=40 {
                let (cosine, sine) = towards(x, y).vector();
                let along = i64::from(x) * i64::from(cosine) + i64::from(y) * i64::from(sine);
                let across = i64::from(y) * i64::from(cosine) - i64::from(x) * i64::from(sine);
                // tan 7.5° is 0.131652…, and the cosines are rounded.
                assert!(1_000_000 * across.abs() <= 131_660 * along, "({x}, {y})");
            }
        }
    }

    #[test]
    fn a_scan_finds_the_strongest_direction_the_first_of_equal_ones() {
        let turn = |strength: &dyn Fn(Heading) -> Option<Strength>| {
            let mut scan = Scan::START;
            while let Some(heading) = scan.heading() {
                scan = scan.measure(strength(heading));
            }
            assert_eq!(scan.measure(Some(Strength(i32::MAX))), scan, "the turn is over");
            scan.best()
        };
        assert_eq!(turn(&|_| None), None);
        assert_eq!(turn(&|_| Some(Strength(3))), Some((Strength(3), Heading::FIRST)));
        for towards in Heading::all() {
            let lobe = |antenna: Heading| {
                let ((x, y), (towards_x, towards_y)) = (antenna.vector(), towards.vector());
                Some(Strength((x / 1000) * (towards_x / 1000) + (y / 1000) * (towards_y / 1000)))
            };
            assert_eq!(turn(&lobe).map(|(_, heading)| heading), Some(towards));
        }
    }
}

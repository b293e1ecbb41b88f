//! Monitors of robots in the field: each is told one stamped position at a time, and says whether a safety clause of
//! `SPEC.md` is kept, broken or unknown. A monitor knows no rule: it sees where robots are, not what they intend. Its
//! bytes are fixed, and a position takes time that the number of robots bounds.
//!
//! A breach is reported where the positions leave no doubt: a distance has to be off by more than the tolerance, and a
//! robot is in a cell if the whole circle of the tolerance is. A clause is *kept* if every robot was heard within the
//! gap and nothing is broken. Between two positions a robot goes where it will: choose the tolerance of a cell as the
//! error of a position and the way that a robot goes within the gap, and that of a distance, which has two ends, as twice
//! as much.
//!
//! ```
//! use tautline_monitor::{Monitor, Neighbours, Place, Verdict};
//!
//! let mut chain: Monitor<_, 3> = Monitor::new(Neighbours { range_mm: 2_550, tolerance_mm: 50 }, 1_000_000);
//! chain.hear(0, 0, Place::new(0, 0));
//! chain.hear(1, 0, Place::new(2_000, 0));
//! assert_eq!(chain.hear(2, 0, Place::new(4_000, 0)), Verdict::Kept);
//! assert!(matches!(chain.hear(2, 500_000, Place::new(4_700, 0)), Verdict::Broken(_)));
//! ```
#![no_std]

mod demands;

use core::fmt;

pub use demands::{Apart, Cells, Joined, Neighbours, Own};

/// A position on a floor, in millimetres. The axes are those of the one who measures.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Place {
    /// Along the first axis.
    pub x_mm: i32,
    /// Along the second axis.
    pub y_mm: i32,
}

impl Place {
    /// The farthest that a place may be along an axis: distances between places fit into their numbers.
    pub const FARTHEST_MM: i32 = 1_000_000_000;

    /// A position.
    pub const fn new(x_mm: i32, y_mm: i32) -> Self {
        Self { x_mm, y_mm }
    }

    /// Whether it is near enough to be measured from.
    const fn is_near(self) -> bool {
        self.x_mm.unsigned_abs() <= Self::FARTHEST_MM as u32
            && self.y_mm.unsigned_abs() <= Self::FARTHEST_MM as u32
    }

    /// The square of the distance to `other`, in square millimetres.
    fn squared(self, other: Self) -> u64 {
        let along = |one: i32, other: i32| {
            let apart = u64::from(one.abs_diff(other));
            apart * apart
        };
        along(self.x_mm, other.x_mm) + along(self.y_mm, other.y_mm)
    }

    /// Whether `other` is farther than so many millimetres.
    fn is_beyond(self, other: Self, range_mm: u32) -> bool {
        self.squared(other) > u64::from(range_mm) * u64::from(range_mm)
    }
}

/// The answer to a position.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Verdict {
    /// Every robot was heard within the gap, and the clause is not broken.
    Kept,
    /// The clause is broken, whatever the robots that were not heard do.
    Broken(Breach),
    /// The clause is not seen to be broken, but not enough is known.
    Unknown(Doubt),
}

/// The breach of a clause.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Breach {
    /// Two of the robots that break it, from 0, the lower number first.
    pub robots: [usize; 2],
    /// The distance in millimetres, or the robots in the cell.
    pub measured: u32,
    /// The most or the least that the clause allows, without the tolerance.
    pub allowed: u32,
}

/// The reason why a clause is neither kept nor broken.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Doubt {
    /// This robot was not heard yet, or not within the gap.
    Silent(usize),
    /// The stamp is before one of the same robot; the position was not taken.
    Late,
    /// There is no robot of this number; the position was not taken.
    Nobody(usize),
    /// The place is more than [`Place::FARTHEST_MM`] away; the position was not taken.
    TooFar,
}

impl fmt::Display for Doubt {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Silent(robot) => write!(f, "robot {robot} was not heard within the gap"),
            Self::Late => f.write_str("a position is older than the last one of its robot: sort the stamps"),
            Self::Nobody(robot) => write!(f, "there is no robot {robot}: robots count from 0"),
            Self::TooFar => {
                f.write_str("a position is beyond 1,000 km: give millimetres from an origin nearby")
            }
        }
    }
}

/// The latest positions of robots.
#[derive(Clone, Copy, Debug)]
pub struct Track<const N: usize> {
    latest: [Option<(u64, Place)>; N],
    first: [Option<Place>; N],
    gap_us: u64,
    now_us: u64,
}

impl<const N: usize> Track<N> {
    /// Where `robot` is, if it was heard within the gap.
    pub fn place(&self, robot: usize) -> Option<Place> {
        let (at_us, place) = (*self.latest.get(robot)?)?;
        (self.now_us.saturating_sub(at_us) <= self.gap_us).then_some(place)
    }

    /// Where `robot` was when it was first heard.
    pub fn start(&self, robot: usize) -> Option<Place> {
        *self.first.get(robot)?
    }

    /// The robots that were heard within the gap.
    pub fn heard(&self) -> impl Iterator<Item = (usize, Place)> + '_ {
        (0..N).filter_map(|robot| Some((robot, self.place(robot)?)))
    }

    /// Pairs of robots that were heard within the gap, the lower number first.
    pub fn pairs(&self) -> impl Iterator<Item = [(usize, Place); 2]> + '_ {
        self.heard()
            .flat_map(|one| self.heard().filter(move |other| other.0 > one.0).map(move |other| [one, other]))
    }
}

/// A demand of positions.
pub trait Demand<const N: usize> {
    /// The first breach that leaves no doubt, by robots that were heard within the gap.
    fn breach(&self, track: &Track<N>) -> Option<Breach>;
}

/// A demand, and the robots that it is made of.
#[derive(Clone, Copy, Debug)]
pub struct Monitor<D, const N: usize> {
    demand: D,
    track: Track<N>,
}

impl<D: Demand<N>, const N: usize> Monitor<D, N> {
    /// A monitor that has heard nobody. A position that is older than `gap_us` microseconds is no longer believed.
    pub const fn new(demand: D, gap_us: u64) -> Self {
        let track = Track { latest: [None; N], first: [None; N], gap_us, now_us: 0 };
        Self { demand, track }
    }

    /// Takes the position of `robot` at `at_us` microseconds, and judges all positions of that moment, or of the latest
    /// one if that was later.
    pub fn hear(&mut self, robot: usize, at_us: u64, place: Place) -> Verdict {
        let track = &mut self.track;
        let (Some(latest), Some(first)) = (track.latest.get_mut(robot), track.first.get_mut(robot)) else {
            return Verdict::Unknown(Doubt::Nobody(robot));
        };
        if !place.is_near() {
            return Verdict::Unknown(Doubt::TooFar);
        }
        if latest.is_some_and(|(before_us, _)| at_us < before_us) {
            return Verdict::Unknown(Doubt::Late);
        }
        *latest = Some((at_us, place));
        first.get_or_insert(place);
        track.now_us = track.now_us.max(at_us);
        if let Some(breach) = self.demand.breach(&self.track) {
            return Verdict::Broken(breach);
        }
        match (0..N).find(|&robot| self.track.place(robot).is_none()) {
            Some(silent) => Verdict::Unknown(Doubt::Silent(silent)),
            None => Verdict::Kept,
        }
    }
}

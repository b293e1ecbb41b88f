//! Monitors of robots in the field: each is told one stamped position at a time, and says whether a safety clause of
//! `SPEC.md` is kept, broken or unknown. A monitor knows no rule: it sees where robots are, not what they intend. Its
//! bytes are fixed, and a position takes time that the number of robots bounds.
//!
//! A breach is reported where the positions leave no doubt: a distance has to be off by more than the
//! tolerance, and a robot is in a cell if the whole circle of the tolerance is. A clause is *kept* if every
//! robot was heard within the gap and nothing is broken. Between two positions a robot goes where it will:
//! choose the tolerance of a cell as the error of a position and the way that a robot goes within the gap, and
//! that of a distance, which has two ends, as twice as much.
//!
//! ```
//! use tautline_monitor::{Monitor, Neighbours, Place, Robot, Verdict};
//!
//! let range = Neighbours { range_mm: 2_550, tolerance_mm: 50 };
//! let mut chain = Monitor::new(range, 1_000_000, [Robot::UNHEARD; 3])?;
//! chain.hear(0, 0, 0, Place::new(0, 0));
//! chain.hear(0, 1, 0, Place::new(2_000, 0));
//! assert_eq!(chain.hear(0, 2, 0, Place::new(4_000, 0)), Verdict::Kept);
//! // Half a second later, by the watch of the one who looks and by the robot's stamp.
//! assert!(matches!(chain.hear(500_000, 2, 500_000, Place::new(4_700, 0)), Verdict::Broken(_)));
//! # Ok::<(), tautline_monitor::SetupError>(())
//! ```
#![no_std]

mod demands;

use core::fmt;

pub use demands::{AnyDemand, Apart, Cells, Connectivity, Neighbours, Own};

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
        self.squared(other) > square(range_mm)
    }
}

/// The square of a length.
const fn square(mm: u32) -> u64 {
    mm as u64 * mm as u64
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
    /// Two of the robots that break it, from 0, the lower number first; one that breaks it alone stands there twice.
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
    /// The stamp is further ahead of now than the gap; the position was not taken.
    Ahead,
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
            Self::Ahead => {
                f.write_str("a stamp is further ahead of now than the gap: set the clocks of the robots")
            }
            Self::Nobody(robot) => write!(f, "there is no robot {robot}: robots count from 0"),
            Self::TooFar => {
                f.write_str("a position is beyond 1,000 km: give millimetres from an origin nearby")
            }
        }
    }
}

/// The memory of one robot.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Robot {
    at_us: u64,
    /// The square of the farthest distance from its start at which it was ever heard.
    strayed: u64,
    start: Place,
    place: Place,
    is_heard: bool,
    link: Link,
}

/// The links of a robot, as [`Connectivity`] finds them at each position.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Link {
    /// It is not joined to the first robot.
    Apart,
    /// It is joined to the first robot.
    Joined,
    /// It is joined, and who is near it is as well.
    Asked,
}

impl Robot {
    /// A robot that was not heard.
    pub const UNHEARD: Self = {
        let nowhere = Place::new(0, 0);
        Self { at_us: 0, strayed: 0, start: nowhere, place: nowhere, is_heard: false, link: Link::Apart }
    };
}

/// The latest positions of robots.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Track<R> {
    robots: R,
    gap_us: u64,
    now_us: u64,
}

impl<R: AsRef<[Robot]>> Track<R> {
    /// How many robots there are.
    pub fn robots(&self) -> usize {
        self.robots.as_ref().len()
    }

    /// A robot that was heard within the gap.
    fn robot(&self, robot: usize) -> Option<&Robot> {
        let robot = self.robots.as_ref().get(robot)?;
        (robot.is_heard && self.now_us.saturating_sub(robot.at_us) <= self.gap_us).then_some(robot)
    }

    /// Where `robot` is, if it was heard within the gap.
    pub fn place(&self, robot: usize) -> Option<Place> {
        Some(self.robot(robot)?.place)
    }

    /// Whether `robot` was ever heard so many millimetres, or farther, from where it was heard first.
    pub fn has_strayed(&self, robot: usize, mm: u32) -> bool {
        self.robots.as_ref().get(robot).is_some_and(|robot| robot.strayed >= square(mm))
    }

    /// The robots that were heard within the gap.
    pub fn heard(&self) -> impl Iterator<Item = (usize, Place)> + '_ {
        (0..self.robots()).filter_map(|robot| Some((robot, self.place(robot)?)))
    }

    /// Pairs of robots that were heard within the gap, the lower number first.
    pub fn pairs(&self) -> impl Iterator<Item = [(usize, Place); 2]> + '_ {
        self.heard()
            .flat_map(|one| self.heard().filter(move |other| other.0 > one.0).map(move |other| [one, other]))
    }
}

/// A demand of positions.
pub trait Demand {
    /// The first breach that leaves no doubt, by robots that were heard within the gap.
    fn breach(&self, track: &mut Track<&mut [Robot]>) -> Option<Breach>;

    /// Whether its tolerance is as long as its range or its least distance, or as half the width of its cells. Then
    /// positions say nothing of it.
    fn is_blind(&self) -> bool {
        false
    }
}

/// The reason why there is no monitor.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum SetupError {
    /// The demand is [blind](Demand::is_blind).
    Blind,
    /// There is no robot.
    NoRobots,
}

impl fmt::Display for SetupError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Blind => {
                "with this tolerance positions say nothing of the demand: give one below its range or its least \
                 distance, or below half the width of its cells"
            }
            Self::NoRobots => "there are no robots: give at least one",
        })
    }
}

impl core::error::Error for SetupError {}

/// A demand, and the robots that it is made of: `R` is their memory, as `[Robot; 4]`, `Vec<Robot>` or `&mut [Robot]`.
#[derive(Clone, Copy, Debug)]
pub struct Monitor<D, R> {
    demand: D,
    track: Track<R>,
}

impl<D: Demand, R: AsMut<[Robot]>> Monitor<D, R> {
    /// A monitor of robots that were not heard, whose memory is `robots`, each one [`Robot::UNHEARD`]. A position that
    /// is older than `gap_us` microseconds is no longer believed.
    ///
    /// # Errors
    /// [`SetupError`] if the clause would be kept wherever robots are.
    pub fn new(demand: D, gap_us: u64, mut robots: R) -> Result<Self, SetupError> {
        if demand.is_blind() {
            return Err(SetupError::Blind);
        }
        if robots.as_mut().is_empty() {
            return Err(SetupError::NoRobots);
        }
        Ok(Self { demand, track: Track { robots, gap_us, now_us: 0 } })
    }

    /// Takes the position of `robot` at `at_us` microseconds, and judges all positions of now, as [`Monitor::at`] does.
    /// Of a position that is not taken the reason is told, unless the others of now break the clause.
    pub fn hear(&mut self, now_us: u64, robot: usize, at_us: u64, place: Place) -> Verdict {
        let taken = self.take(now_us, robot, at_us, place);
        match (self.at(now_us), taken) {
            (Verdict::Kept | Verdict::Unknown(_), Err(doubt)) => Verdict::Unknown(doubt),
            (verdict, _) => verdict,
        }
    }

    /// Takes the position of a robot at `at_us` microseconds, and judges nothing.
    ///
    /// # Errors
    /// [`Doubt`] if it is not taken: then it changes nothing. A stamp further ahead of now than the gap is not
    /// believed.
    pub fn take(&mut self, now_us: u64, number: usize, at_us: u64, place: Place) -> Result<(), Doubt> {
        let track = &mut self.track;
        let robot = track.robots.as_mut().get_mut(number).ok_or(Doubt::Nobody(number))?;
        if !place.is_near() {
            return Err(Doubt::TooFar);
        }
        if robot.is_heard && at_us < robot.at_us {
            return Err(Doubt::Late);
        }
        if at_us.saturating_sub(track.now_us.max(now_us)) > track.gap_us {
            return Err(Doubt::Ahead);
        }
        let start = if robot.is_heard { robot.start } else { place };
        let strayed = robot.strayed.max(start.squared(place));
        *robot = Robot { at_us, strayed, start, place, is_heard: true, link: Link::Apart };
        Ok(())
    }

    /// Judges the positions of the moment `now_us`, in microseconds of the clock that the stamps go
    /// by; time does not go back, and a moment before an earlier one counts as that. Ask it when
    /// nobody was heard for a while: silence is said.
    pub fn at(&mut self, now_us: u64) -> Verdict {
        let track = &mut self.track;
        track.now_us = track.now_us.max(now_us);
        let mut track = Track { robots: track.robots.as_mut(), gap_us: track.gap_us, now_us: track.now_us };
        if let Some(breach) = self.demand.breach(&mut track) {
            return Verdict::Broken(breach);
        }
        match (0..track.robots()).find(|&robot| track.robot(robot).is_none()) {
            Some(silent) => Verdict::Unknown(Doubt::Silent(silent)),
            None => Verdict::Kept,
        }
    }
}

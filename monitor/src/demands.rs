//! The demands that positions decide: each says which clauses of `SPEC.md` it is, with which lengths.

use super::{Breach, Demand, Link, Place, Robot, Track, square};

/// The distance of two places in millimetres, cut off.
fn apart_mm(one: Place, other: Place) -> u32 {
    u32::try_from(one.squared(other).isqrt()).unwrap_or(u32::MAX)
}

/// The breach of two robots by their distance.
fn between(one: (usize, Place), other: (usize, Place), allowed: u32) -> Breach {
    Breach { robots: [one.0, other.0], measured: apart_mm(one.1, other.1), allowed }
}

/// CHAIN-3: neighbours in the chain, which are robots whose numbers follow each other, are within range: the paper's
/// r_cov is √6.5 = 2.549 cells.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Neighbours {
    /// The range.
    pub range_mm: u32,
    /// How far off the distance may be: less than the range, or [it says nothing](Demand::is_blind).
    pub tolerance_mm: u32,
}

impl Demand for Neighbours {
    fn breach(&self, track: &mut Track<&mut [Robot]>) -> Option<Breach> {
        let mut pairs = track.pairs().filter(|[one, other]| other.0 == one.0 + 1);
        let most = self.range_mm.saturating_add(self.tolerance_mm);
        let [one, other] = pairs.find(|[one, other]| one.1.is_beyond(other.1, most))?;
        Some(between(one, other, self.range_mm))
    }

    fn is_blind(&self) -> bool {
        self.tolerance_mm >= self.range_mm
    }
}

/// KIT-12, and of two robots KIT-1 and KIT-2, which speak of no more: robots hear each other directly or over others.
/// Two robots of KIT are within 10 m. Nothing is said before every robot is heard within the gap: a silent one may be
/// the link. KIT-12 asks this of robots that hear each other when they start, which is not looked at.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Connectivity {
    /// The range.
    pub range_mm: u32,
    /// How far off the distance may be: less than the range, or [it says nothing](Demand::is_blind).
    pub tolerance_mm: u32,
}

impl Demand for Connectivity {
    fn breach(&self, track: &mut Track<&mut [Robot]>) -> Option<Breach> {
        let most = self.range_mm.saturating_add(self.tolerance_mm);
        if track.heard().count() < track.robots() {
            return None;
        }
        for (number, robot) in track.robots.iter_mut().enumerate() {
            robot.link = if number == 0 { Link::Joined } else { Link::Apart };
        }
        while let Some(asked) = track.robots.iter_mut().find(|robot| robot.link == Link::Joined) {
            asked.link = Link::Asked;
            let from = asked.place;
            let is_near =
                |robot: &&mut Robot| robot.link == Link::Apart && !from.is_beyond(robot.place, most);
            track.robots.iter_mut().filter(is_near).for_each(|robot| robot.link = Link::Joined);
        }
        let track = &*track;
        let linked = |link: Link| track.heard().filter(move |&(robot, _)| track.robots[robot].link == link);
        let left = linked(Link::Apart).next()?;
        let nearest = linked(Link::Asked).min_by_key(|(_, place)| place.squared(left.1))?;
        let (one, other) = if nearest.0 < left.0 { (nearest, left) } else { (left, nearest) };
        Some(between(one, other, self.range_mm))
    }

    fn is_blind(&self) -> bool {
        self.tolerance_mm >= self.range_mm
    }
}

/// KIT-3: robots that have left their starts are never nearer to each other than 3 m. The start of a robot is where it
/// was first heard; it has left it, for ever, once it was heard as far from it as the next node within the tolerance.
/// Of robots that are still on their way there nothing is said.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Apart {
    /// The least distance.
    pub least_mm: u32,
    /// How far off the distance may be: less than the least one, or [nothing breaks it](Demand::is_blind).
    pub tolerance_mm: u32,
}

impl Demand for Apart {
    fn breach(&self, track: &mut Track<&mut [Robot]>) -> Option<Breach> {
        let least = self.least_mm.saturating_sub(self.tolerance_mm);
        let is_near = |[one, other]: &[(usize, Place); 2]| {
            let has_left = |robot: usize| track.has_strayed(robot, least);
            one.1.squared(other.1) < square(least) && has_left(one.0) && has_left(other.0)
        };
        let [one, other] = track.pairs().find(is_near)?;
        Some(between(one, other, self.least_mm))
    }

    fn is_blind(&self) -> bool {
        self.tolerance_mm >= self.least_mm
    }
}

/// CHAIN-2, with 2 in a cell at most and the base left out, and FRONTIER-2 and PACK-2, with 1: not more robots are in
/// one cell. The corner of a cell is at the origin; a robot whose circle of tolerance crosses a border is in no cell.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Cells {
    /// The width of a cell; above 0.
    pub cell_mm: u32,
    /// The most robots in a cell.
    pub most: u32,
    /// The column and the row of a cell in which any number may be.
    pub base: Option<[i32; 2]>,
    /// How far off a position may be: less than half a cell, or [nothing breaks it](Demand::is_blind).
    pub tolerance_mm: u32,
}

impl Cells {
    /// The cell that a robot is in without doubt.
    fn cell(&self, place: Place) -> Option<[i32; 2]> {
        let (width, off) = (i64::from(self.cell_mm.max(1)), i64::from(self.tolerance_mm));
        let along = |mm: i32| {
            let (low, high) = (i64::from(mm) - off, i64::from(mm) + off);
            let cell = low.div_euclid(width);
            (cell == high.div_euclid(width)).then_some(i32::try_from(cell).ok()?)
        };
        Some([along(place.x_mm)?, along(place.y_mm)?])
    }
}

impl Demand for Cells {
    fn breach(&self, track: &mut Track<&mut [Robot]>) -> Option<Breach> {
        let cells = || track.heard().filter_map(|(robot, place)| Some((robot, self.cell(place)?)));
        let counted = |(robot, cell): (usize, [i32; 2])| {
            let others = || cells().filter(move |other| other.1 == cell && other.0 >= robot);
            let measured = others().count() as u32;
            let second = others().nth(1).map_or(robot, |other| other.0);
            let is_broken = Some(cell) != self.base && measured > self.most;
            is_broken.then_some(Breach { robots: [robot, second], measured, allowed: self.most })
        };
        cells().find_map(counted)
    }

    fn is_blind(&self) -> bool {
        self.tolerance_mm >= self.cell_mm.div_ceil(2)
    }
}

/// A demand that is chosen when the program runs.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum AnyDemand {
    /// CHAIN-3.
    Neighbours(Neighbours),
    /// KIT-1, KIT-2, KIT-12.
    Connectivity(Connectivity),
    /// KIT-3.
    Apart(Apart),
    /// CHAIN-2, FRONTIER-2, PACK-2.
    Cells(Cells),
}

impl Demand for AnyDemand {
    fn breach(&self, track: &mut Track<&mut [Robot]>) -> Option<Breach> {
        match self {
            Self::Neighbours(demand) => demand.breach(track),
            Self::Connectivity(demand) => demand.breach(track),
            Self::Apart(demand) => demand.breach(track),
            Self::Cells(demand) => demand.breach(track),
        }
    }

    fn is_blind(&self) -> bool {
        match self {
            Self::Neighbours(demand) => demand.is_blind(),
            Self::Connectivity(demand) => demand.is_blind(),
            Self::Apart(demand) => demand.is_blind(),
            Self::Cells(demand) => demand.is_blind(),
        }
    }
}

/// A demand of one's own: a function of the robots that were heard within the gap.
#[derive(Clone, Copy, Debug)]
pub struct Own<F>(
    /// The first breach, if there is one.
    pub F,
);

impl<F: Fn(&Track<&mut [Robot]>) -> Option<Breach>> Demand for Own<F> {
    fn breach(&self, track: &mut Track<&mut [Robot]>) -> Option<Breach> {
        self.0(track)
    }
}

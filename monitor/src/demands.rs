//! The demands that positions decide: each says which clauses of `SPEC.md` it is, with which lengths.

use super::{Breach, Demand, Place, Track};

/// The distance of two places in millimetres, cut off.
fn apart_mm(one: Place, other: Place) -> u32 {
    u32::try_from(one.squared(other).isqrt()).unwrap_or(u32::MAX)
}

/// The breach of two robots by their distance.
fn between(one: (usize, Place), other: (usize, Place), allowed: u32) -> Breach {
    Breach { robots: [one.0, other.0], measured: apart_mm(one.1, other.1), allowed }
}

/// CHAIN-3: neighbours in the chain, which are robots whose numbers follow each other, are within range: the paper's r_cov
/// is √6.5 = 2.549 cells.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Neighbours {
    /// The range.
    pub range_mm: u32,
    /// How far off the distance may be.
    pub tolerance_mm: u32,
}

impl<const N: usize> Demand<N> for Neighbours {
    fn breach(&self, track: &Track<N>) -> Option<Breach> {
        let mut pairs = track.pairs().filter(|[one, other]| other.0 == one.0 + 1);
        let most = self.range_mm.saturating_add(self.tolerance_mm);
        let [one, other] = pairs.find(|[one, other]| one.1.is_beyond(other.1, most))?;
        Some(between(one, other, self.range_mm))
    }
}

/// KIT-1, KIT-2 and KIT-12: robots hear each other directly or over others. Two robots of KIT are within 10 m. Nothing is
/// said before every robot is heard within the gap: a silent one may be the link.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Joined {
    /// The range.
    pub range_mm: u32,
    /// How far off the distance may be.
    pub tolerance_mm: u32,
}

impl<const N: usize> Demand<N> for Joined {
    fn breach(&self, track: &Track<N>) -> Option<Breach> {
        let mut places = [Place::new(0, 0); N];
        for (robot, place) in places.iter_mut().enumerate() {
            *place = track.place(robot)?;
        }
        let most = self.range_mm.saturating_add(self.tolerance_mm);
        let mut is_joined = [false; N];
        *is_joined.first_mut()? = true;
        for _ in 1..N {
            let before = is_joined;
            for robot in 0..N {
                let mut joined = places.iter().zip(&is_joined).filter(|(_, is_joined)| **is_joined);
                let is_near = joined.any(|(&place, _)| !place.is_beyond(places[robot], most));
                is_joined[robot] |= is_near;
            }
            if is_joined == before {
                break;
            }
        }
        let left = is_joined.iter().position(|is_joined| !is_joined)?;
        let to = |robot: &usize| places[*robot].squared(places[left]);
        let nearest = (0..N).filter(|&robot| is_joined[robot]).min_by_key(to)?;
        let [one, other] = [nearest.min(left), nearest.max(left)].map(|robot| (robot, places[robot]));
        Some(between(one, other, self.range_mm))
    }
}

/// KIT-3: robots that have left their starts are never nearer to each other than 3 m. The start of a robot is where it was
/// first heard; it has left it while it is as far from it as the demand is. So
/// a breach beside the start of a robot that has come back is not seen.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Apart {
    /// The least distance.
    pub least_mm: u32,
    /// How far off the distance may be.
    pub tolerance_mm: u32,
}

impl<const N: usize> Demand<N> for Apart {
    fn breach(&self, track: &Track<N>) -> Option<Breach> {
        let least = self.least_mm.saturating_sub(self.tolerance_mm);
        let has_left = |(robot, place): (usize, Place)| {
            track.start(robot).is_some_and(|start| apart_mm(start, place) >= self.least_mm)
        };
        let is_near = |[one, other]: &[(usize, Place); 2]| {
            one.1.squared(other.1) < u64::from(least) * u64::from(least) && has_left(*one) && has_left(*other)
        };
        let [one, other] = track.pairs().find(is_near)?;
        Some(between(one, other, self.least_mm))
    }
}

/// CHAIN-2, with 2 in a cell at most and the base left out, and FRONTIER-2 and PACK-2, with 1: not more robots are in one
/// cell. The corner of a cell is at the origin; a robot whose circle of tolerance crosses a border is in no cell.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Cells {
    /// The width of a cell; above 0.
    pub cell_mm: u32,
    /// The most robots in a cell.
    pub most: u32,
    /// The column and the row of a cell in which any number may be.
    pub base: Option<[i32; 2]>,
    /// How far off a position may be.
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

impl<const N: usize> Demand<N> for Cells {
    fn breach(&self, track: &Track<N>) -> Option<Breach> {
        let cells = || track.heard().filter_map(|(robot, place)| Some((robot, self.cell(place)?)));
        let counted = |(robot, cell): (usize, [i32; 2])| {
            let others = || cells().filter(move |other| other.1 == cell && other.0 >= robot);
            let (measured, second) = (others().count() as u32, others().nth(1)?.0);
            let is_broken = Some(cell) != self.base && measured > self.most;
            is_broken.then_some(Breach { robots: [robot, second], measured, allowed: self.most })
        };
        cells().find_map(counted)
    }
}

/// A demand of one's own: a function of the robots that were heard within the gap.
#[derive(Clone, Copy, Debug)]
pub struct Own<F>(
    /// The first breach, if there is one.
    pub F,
);

impl<F: Fn(&Track<N>) -> Option<Breach>, const N: usize> Demand<N> for Own<F> {
    fn breach(&self, track: &Track<N>) -> Option<Breach> {
        self.0(track)
    }
}

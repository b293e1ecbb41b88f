//! The judge of a whole log. At each stamp it looks at all robots: where each is, between which positions of it the
//! stamp lies, and which pairs are too far, too near or in one cell. It keeps nothing from one stamp to the next but
//! what a clause asks for: whether a robot has ever left its start.

use std::cmp::Reverse;
use std::collections::{BTreeMap, BTreeSet};

use super::ground::{Grid, MOST_COMPARISONS, TooMuch, cells_of, visits};
use super::{Limits, Silence, Tracks};

/// The demand of a clause, with its lengths.
#[derive(Clone, PartialEq, Debug)]
pub enum Demand {
    /// CHAIN-3: robots whose numbers follow each other are within range.
    Neighbours {
        /// The range.
        range_mm: u32,
    },
    /// KIT-1, KIT-12: all robots hear each other, directly or over others.
    Joined {
        /// The range.
        range_mm: u32,
        /// The robots of which the clause speaks.
        of: Group,
    },
    /// KIT-3: robots that have left their starts are apart. A robot has left its start, the first place of it in the
    /// log, for ever once it was as far from it as the next node within the tolerance. Of one on its way there that is
    /// in doubt.
    Apart {
        /// The least distance.
        least_mm: u32,
    },
    /// CHAIN-2, FRONTIER-2, PACK-2: no more robots than that are in a cell.
    Crowd {
        /// The cells.
        grid: Grid,
        /// So many.
        most: u32,
        /// The cell that may have more.
        base: Option<[i32; 2]>,
    },
    /// FRONTIER-1: these cells were visited when the log ends.
    Visited {
        /// The cells.
        grid: Grid,
        /// Those that robots can reach.
        cells: Vec<[i32; 2]>,
        /// Whether the log ends where the run ends.
        is_whole: bool,
    },
}

/// The robots that have to hear each other.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Group {
    /// All.
    All,
    /// All, if they do so when they start: at the first stamp at which the log says where all of them are.
    JoinedAtStart,
}

/// The answer of a log to a clause.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Verdict {
    /// At no stamp it is broken, no robot was silent for longer than the gap, and the log is whole.
    Kept,
    /// It is broken, whatever else happened.
    Broken(Breach),
    /// It is not seen to be broken, but the log does not say enough.
    Unknown(Doubt),
}

/// The first breach of a clause.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Breach {
    /// The stamp.
    pub at_us: i64,
    /// The robots that break it, from 0.
    pub robots: Vec<u32>,
    /// The distance in millimetres, the robots in the cells, or the cells that nobody visited.
    pub measured: u32,
    /// The most or the least that the clause allows in these cells, without the tolerance.
    pub allowed: u32,
    /// The cells that the clause speaks of: the one with too many robots, or those at whose common border too many for
    /// all of them are, or all that nobody visited.
    pub cells: Vec<[i32; 2]>,
    /// The last line or message of the log that has part in it.
    pub place: u32,
    /// The stamps at which the clause is broken.
    pub moments: u32,
}

/// The reason why a verdict is open.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Doubt {
    /// A robot was silent for longer than the gap; in all so many times some robot was.
    Silent(Silence, usize),
    /// There are fewer than two robots.
    Alone,
    /// The robots do not hear each other when they start: the clause asks for nothing.
    Parted(i64),
    /// Two robots are as near at this stamp, and one of them is on its way from its start.
    Leaving(i64, [u32; 2]),
    /// Within the tolerance, this cell may have been visited or not; in all so many.
    Cell([i32; 2], usize),
    /// At this stamp more robots than allowed may be in this cell, at whose border one of them is.
    Border(i64, [i32; 2], Vec<u32>),
    /// The first place of robot 1, whose cell is the base, is at the border of a cell.
    Base,
    /// The log ends in the midst.
    Cut,
    /// More than half of the positions are not on the map: it is another one, or has other units.
    OtherMap,
    /// No robot is first in a free cell of the map: the clause asks for nothing.
    Nowhere,
    /// This robot is not first in a free cell of the map: which cells it can reach is not known.
    Astray(u32),
    /// More than half of the positions were not taken.
    Refused,
    /// A robot is at several places at one stamp.
    Contradiction {
        /// The robot, from 0.
        robot: u32,
        /// The stamp.
        at_us: i64,
        /// The line or message of the log that is somewhere else than one before it.
        place: u32,
        /// So many times in all, of any robot.
        count: usize,
    },
    /// At this stamp these robots would break the clause if one of them stood still before its first position or behind
    /// its last one.
    Ending(i64, Vec<u32>),
}

/// A moment in which a clause is broken.
struct Finding {
    /// In their order.
    robots: Vec<u32>,
    measured: u32,
    cells: Vec<[i32; 2]>,
}

/// Cells that a robot may be in, where the tolerance is less than half a cell.
const MOST_TOUCHED: usize = 4;

fn apart(one: [f64; 2], other: [f64; 2]) -> f64 {
    let [across, up] = [0, 1].map(|axis| one[axis] - other[axis]);
    (across * across + up * up).sqrt()
}

/// A stamp, with the robots that have a position of it and the places of these in the log.
struct Moment<'a> {
    at_us: i64,
    fresh: &'a [(i64, u32, u32)],
    tracks: &'a Tracks,
    /// Whether robots stand still before their first positions and behind their last ones.
    is_held: bool,
}

impl Moment<'_> {
    fn at(&self, robot: u32) -> Option<[f64; 2]> {
        if self.is_held {
            self.tracks.held(robot as usize, self.at_us)
        } else {
            self.tracks.at(robot as usize, self.at_us)
        }
    }

    fn robots(&self) -> impl Iterator<Item = u32> + use<> {
        0..self.tracks.count() as u32
    }

    /// Pairs with a position of this stamp and their distances, of robots whose places are known.
    fn pairs(&self, others: impl Fn(u32) -> Vec<u32>) -> impl Iterator<Item = ([u32; 2], f64)> {
        self.fresh.iter().flat_map(move |&(_, robot, _)| {
            let place = self.at(robot);
            let distance = move |other: u32| {
                let far = apart(place?, self.at(other)?);
                Some(([robot.min(other), robot.max(other)], far))
            };
            others(robot).into_iter().filter(move |&other| other != robot).filter_map(distance)
        })
    }
}

/// Whether all robots are joined by links of at most so many millimetres; if not, the nearest two of whom one is
/// joined to the first robot and the other one is not. `None` if some place is not known.
fn joined(moment: &Moment<'_>, most_mm: f64) -> Option<Result<(), Finding>> {
    let places: Vec<[f64; 2]> = moment.robots().map(|robot| moment.at(robot)).collect::<Option<_>>()?;
    let (mut reached, mut left): (Vec<usize>, Vec<usize>) = (vec![0], (1..places.len()).collect());
    let mut next = 0;
    while let Some(&robot) = reached.get(next) {
        let (near, far) = left.into_iter().partition(|&other| apart(places[robot], places[other]) <= most_mm);
        reached.extend::<Vec<usize>>(near);
        left = far;
        next += 1;
    }
    let pairs = reached.iter().flat_map(|&one| left.iter().map(move |&other| (one, other)));
    let nearest =
        pairs.min_by(|a, b| apart(places[a.0], places[a.1]).total_cmp(&apart(places[b.0], places[b.1])));
    Some(nearest.map_or(Ok(()), |(one, other)| {
        let measured = apart(places[one], places[other]) as u32;
        Err(Finding {
            robots: vec![one.min(other) as u32, one.max(other) as u32],
            measured,
            cells: Vec::new(),
        })
    }))
}

/// The stamp from which on each robot has been so far from its start that it `is_off` it.
fn leaving(tracks: &Tracks, is_off: impl Fn(f64) -> bool) -> Vec<Option<i64>> {
    let place = |sample: &super::Sample| [sample.x_mm, sample.y_mm].map(f64::from);
    let left = |track: &Vec<super::Sample>| {
        let start = place(track.first()?);
        track.iter().find(|sample| is_off(apart(start, place(sample)))).map(|sample| sample.at_us)
    };
    tracks.robots.iter().map(left).collect()
}

/// The clause of cells with at most so many robots each.
#[derive(Clone, Copy)]
struct Crowding {
    grid: Grid,
    tolerance_mm: u32,
    most: usize,
    base: Option<[i32; 2]>,
}

impl Crowding {
    /// The cell with the most robots in it, if they are more than allowed; or else cells with a common border at which
    /// more robots are than all of them may have, whichever robot is in which.
    fn surely(self, placed: &[(u32, [f64; 2])]) -> Option<Finding> {
        let mut within: BTreeMap<[[i32; 2]; 2], Vec<u32>> = BTreeMap::new();
        for &(robot, place) in placed {
            within.entry(self.grid.within(place, self.tolerance_mm)).or_default().push(robot);
        }
        let crowd = |&cells: &[[i32; 2]; 2]| {
            let area: Vec<_> = cells_of(cells).take(MOST_TOUCHED + 1).collect();
            if area.len() > MOST_TOUCHED || area.iter().any(|cell| Some(*cell) == self.base) {
                return None;
            }
            let parts = area.iter().flat_map(|&low| area.iter().map(move |&high| [low, high]));
            let mut robots: Vec<u32> =
                parts.filter_map(|part| within.get(&part)).flatten().copied().collect();
            robots.sort_unstable();
            (robots.len() > self.most * area.len()).then_some((area, robots))
        };
        let crowds = within.keys().filter_map(crowd);
        let (cells, robots) = crowds.max_by_key(|(area, robots)| (Reverse(area.len()), robots.len()))?;
        Some(Finding { measured: robots.len() as u32, robots, cells })
    }

    /// A cell with a robot at its border that more robots than allowed may be in: the positions themselves are, or
    /// those robots may be at one point.
    fn perhaps(self, placed: &[(u32, [f64; 2])]) -> Option<([i32; 2], Vec<u32>)> {
        let mut touching: BTreeMap<[i32; 2], Vec<usize>> = BTreeMap::new();
        for (number, &(_, place)) in placed.iter().enumerate() {
            for cell in self.grid.touched(place, self.tolerance_mm) {
                touching.entry(cell).or_default().push(number);
            }
        }
        touching.retain(|cell, near| near.len() > self.most && Some(*cell) != self.base);
        touching.into_iter().find_map(|(cell, near)| {
            let inside = |&number: &usize| self.grid.surely(placed[number].1, 0) == Some(cell);
            let inside: Vec<usize> = near.iter().copied().filter(inside).collect();
            let crowd = if inside.len() > self.most { Some(inside) } else { self.meeting(placed, &near) };
            Some((cell, crowd?.into_iter().map(|number| placed[number].0).collect()))
        })
    }

    /// More robots than allowed, of these, who may be where one of them is that is at a border.
    fn meeting(self, placed: &[(u32, [f64; 2])], near: &[usize]) -> Option<Vec<usize>> {
        // The error of a distance is that of both its ends.
        let reach_mm = f64::from(self.tolerance_mm) * 2.0;
        let square = |place: [f64; 2]| place.map(|along| (along / reach_mm).floor() as i64);
        let mut squares: BTreeMap<[i64; 2], Vec<usize>> = BTreeMap::new();
        for &number in near {
            squares.entry(square(placed[number].1)).or_default().push(number);
        }
        let is_unsure = |number: &&usize| self.grid.surely(placed[**number].1, self.tolerance_mm).is_none();
        near.iter().filter(is_unsure).find_map(|&number| {
            let place = placed[number].1;
            let [column, row] = square(place);
            let around = (-1..=1).flat_map(|up| (-1..=1).map(move |across| [column + across, row + up]));
            let is_met = |&other: &usize| {
                [0, 1].into_iter().all(|axis| (placed[other].1[axis] - place[axis]).abs() <= reach_mm)
            };
            // The first of a square are enough: it has no more than may be there, or all of them meet.
            let first = |square| squares.get(&square).into_iter().flatten().take(self.most + 1);
            let mut met: Vec<usize> = around.flat_map(first).copied().filter(is_met).collect();
            met.sort_unstable();
            (met.len() > self.most).then_some(met)
        })
    }
}

/// Judges a clause.
///
/// # Errors
/// [`TooMuch`] if there are too many robots for so many stamps.
pub fn judge(tracks: &Tracks, limits: &Limits, demand: &Demand) -> Result<Verdict, TooMuch> {
    let mut stamps: Vec<(i64, u32, u32)> =
        tracks.samples().map(|sample| (sample.at_us, sample.robot, sample.place)).collect();
    stamps.sort_unstable();
    let moments = || stamps.chunk_by(|one, other| one.0 == other.0);
    let robots = tracks.count() as u128;
    let comparisons = match demand {
        Demand::Neighbours { .. } | Demand::Visited { .. } => stamps.len() as u128,
        Demand::Apart { .. } => stamps.len() as u128 * robots,
        Demand::Crowd { .. } => moments().count() as u128 * robots,
        Demand::Joined { .. } => moments().count() as u128 * robots * robots,
    };
    if comparisons > MOST_COMPARISONS {
        return Err(TooMuch { comparisons });
    }
    let silent = tracks.silences().next().map(|silence| Doubt::Silent(silence, tracks.silences().count()));
    let mut contradictions = tracks.contradictions();
    let count = contradictions.len();
    let contradiction = contradictions.next();
    let contradiction =
        contradiction.map(|(robot, at_us, place)| Doubt::Contradiction { robot, at_us, place, count });
    let refused = || tracks.are_mostly_refused().then_some(Doubt::Refused);
    let doubt = contradiction.or(silent).or_else(refused);
    if let Demand::Visited { grid, cells, is_whole } = demand {
        return visited(tracks, limits, *grid, cells, *is_whole, doubt);
    }
    if tracks.count() < 2 {
        return Ok(Verdict::Unknown(Doubt::Alone));
    }
    let Seen { first, parted, in_doubt } = look((tracks, &stamps), limits, demand, false);
    if let Some(at_us) = parted {
        return Ok(Verdict::Unknown(Doubt::Parted(at_us)));
    }
    if let Some(breach) = first {
        return Ok(Verdict::Broken(breach));
    }
    let ending = || {
        let Seen { first, in_doubt, .. } = look((tracks, &stamps), limits, demand, true);
        first.map(|Breach { at_us, robots, .. }| Doubt::Ending(at_us, robots)).or(in_doubt)
    };
    let cut = || tracks.is_cut().then_some(Doubt::Cut);
    Ok(in_doubt.or(doubt).or_else(ending).or_else(cut).map_or(Verdict::Kept, Verdict::Unknown))
}

/// The findings in a log.
struct Seen {
    first: Option<Breach>,
    parted: Option<i64>,
    in_doubt: Option<Doubt>,
}

/// Looks at each of the `stamps`; robots may be taken to stand still before their first positions and behind their last
/// ones.
fn look(
    (tracks, stamps): (&Tracks, &[(i64, u32, u32)]),
    limits: &Limits,
    demand: &Demand,
    is_held: bool,
) -> Seen {
    let tolerance = f64::from(limits.tolerance_mm);
    let mut is_started = false;
    let (mut parted, mut in_doubt) = (None, None);
    let starts: Vec<_> = tracks.starts().collect();
    // When each robot has left its start, and when it was first off it.
    let [left, off] = if let Demand::Apart { least_mm } = demand {
        [
            leaving(tracks, |far| far >= f64::from(*least_mm) - tolerance),
            leaving(tracks, |far| far > tolerance),
        ]
    } else {
        [Vec::new(), Vec::new()]
    };
    let pair = |([one, other], far): ([u32; 2], f64)| Finding {
        robots: vec![one, other],
        measured: far as u32,
        cells: Vec::new(),
    };
    let mut found = |moment: &Moment<'_>| match demand {
        Demand::Neighbours { range_mm } => {
            let beside = |robot: u32| robot.checked_sub(1).into_iter().chain([robot + 1]).collect();
            let most = f64::from(*range_mm) + tolerance;
            moment.pairs(beside).filter(|&(_, far)| far > most).max_by(|a, b| a.1.total_cmp(&b.1)).map(pair)
        }
        Demand::Joined { range_mm, of } => {
            let is_joined = joined(moment, f64::from(*range_mm) + tolerance)?;
            let is_first = !std::mem::replace(&mut is_started, true);
            if is_first && is_joined.is_err() && *of == Group::JoinedAtStart {
                parted = Some(moment.at_us);
            }
            is_joined.err()
        }
        Demand::Apart { least_mm } => {
            let least = f64::from(*least_mm) - tolerance;
            let has = |since: &[Option<i64>], robot: u32| {
                since[robot as usize].is_some_and(|at| at <= moment.at_us)
            };
            let pairs = moment.pairs(|_| moment.robots().collect());
            let near: Vec<_> = pairs.filter(|&(_, far)| far < least).collect();
            // Robots that part from one start are near until one of them has left it.
            let start_apart = |[one, other]: [u32; 2]| {
                let both = starts[one as usize].zip(starts[other as usize]);
                both.is_some_and(|(one, other)| apart(one, other) >= least)
            };
            let may_be = |robots: [u32; 2]| {
                robots.iter().all(|&robot| has(&off, robot))
                    && (robots.iter().any(|&robot| has(&left, robot)) || start_apart(robots))
            };
            if let Some(&(robots, _)) = near.iter().find(|&&(robots, _)| may_be(robots)) {
                in_doubt.get_or_insert(Doubt::Leaving(moment.at_us, robots));
            }
            let left = near.into_iter().filter(|(robots, _)| robots.iter().all(|&robot| has(&left, robot)));
            left.min_by(|a, b| a.1.total_cmp(&b.1)).map(pair)
        }
        Demand::Crowd { grid, most, base } => {
            let tolerance_mm = limits.tolerance_mm;
            let crowding = Crowding { grid: *grid, tolerance_mm, most: *most as usize, base: *base };
            let placed = moment.robots().filter_map(|robot| Some((robot, moment.at(robot)?)));
            let placed: Vec<_> = placed.collect();
            let surely = crowding.surely(&placed);
            if surely.is_none() && in_doubt.is_none() {
                let perhaps = crowding.perhaps(&placed);
                in_doubt = perhaps.map(|(cell, robots)| Doubt::Border(moment.at_us, cell, robots));
            }
            surely
        }
        Demand::Visited { .. } => None,
    };
    let mut first: Option<Breach> = None;
    for fresh in stamps.chunk_by(|one, other| one.0 == other.0) {
        let moment = Moment { at_us: fresh[0].0, fresh, tracks, is_held };
        let Some(Finding { robots, measured, cells }) = found(&moment) else { continue };
        let place = fresh.iter().filter(|one| robots.binary_search(&one.1).is_ok()).map(|one| one.2).max();
        let place = place.unwrap_or_else(|| fresh.iter().map(|one| one.2).max().unwrap_or(0));
        let (at_us, allowed, moments) = (moment.at_us, allowed(demand, cells.len()), 0);
        first.get_or_insert(Breach { at_us, robots, measured, allowed, cells, place, moments }).moments += 1;
    }
    Seen { first, parted, in_doubt }
}

/// The number that a demand allows, in so many cells.
fn allowed(demand: &Demand, cells: usize) -> u32 {
    match demand {
        Demand::Neighbours { range_mm } | Demand::Joined { range_mm, .. } => *range_mm,
        Demand::Apart { least_mm } => *least_mm,
        Demand::Crowd { most, .. } => *most * cells as u32,
        Demand::Visited { .. } => 0,
    }
}

/// Judges whether all cells were visited: one that a robot may have passed while it was silent may have been.
fn visited(
    tracks: &Tracks,
    limits: &Limits,
    grid: Grid,
    cells: &[[i32; 2]],
    is_whole: bool,
    doubt: Option<Doubt>,
) -> Result<Verdict, TooMuch> {
    if cells.is_empty() {
        return Ok(Verdict::Unknown(Doubt::Nowhere));
    }
    let [surely, maybe] = visits(tracks, limits, grid, &cells.iter().copied().collect::<BTreeSet<_>>())?;
    let left: Vec<_> = cells.iter().copied().filter(|cell| !surely.contains(cell)).collect();
    let Some(&first) = left.first() else { return Ok(Verdict::Kept) };
    if let Some(doubt) = doubt {
        return Ok(Verdict::Unknown(doubt));
    }
    if !is_whole {
        return Ok(Verdict::Unknown(Doubt::Cut));
    }
    let missed: Vec<_> = left.iter().copied().filter(|cell| !maybe.contains(cell)).collect();
    if missed.is_empty() {
        return Ok(Verdict::Unknown(Doubt::Cell(first, left.len())));
    }
    let (robots, measured) = (Vec::new(), missed.len() as u32);
    let place = tracks.samples().map(|sample| sample.place).max().unwrap_or(0);
    let at_us = tracks.span_us()[1];
    Ok(Verdict::Broken(Breach { at_us, robots, measured, allowed: 0, cells: missed, place, moments: 1 }))
}

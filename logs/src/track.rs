//! The positions of a log, by robot and time. Stamps that are late or far off are not taken,
//! and said.

use std::collections::{BTreeMap, HashMap};

use super::{Log, Numbers, Sample};

/// How far a log is believed.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Limits {
    /// How far off a distance may be, and a position at the border of a cell, in millimetres.
    pub tolerance_mm: u32,
    /// The longest time, in microseconds, between two positions of a robot in which it is taken to have gone straight.
    pub gap_us: u64,
    /// The longest time, in microseconds, between a stamp and the one before it in the log, if the stamps behind do not
    /// go on from there.
    pub jump_us: u64,
}

/// The positions that were not taken: how many, and the place of the first in the log.
#[derive(Clone, Copy, PartialEq, Eq, Default, Debug)]
pub struct Refusals {
    /// Stamps before an earlier one of the same robot.
    pub late: Option<(u32, u32)>,
    /// Stamps that are farther than the limit from the one before and from half of those behind.
    pub astray: Option<(u32, u32)>,
    /// Positions in whose place another one of the same robot stands, at the same stamp and within the tolerance.
    pub replaced: Option<(u32, u32)>,
    /// Positions of a robot that is at several places at their stamp.
    pub contradicted: Option<(u32, u32)>,
    /// Positions of names that are no robots.
    pub nobody: Option<(u32, u32)>,
}

/// A time in which a robot was silent for longer than the gap.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Silence {
    /// The robot, from 0.
    pub robot: u32,
    /// The stamp before it, or the first one of the log.
    pub from_us: i64,
    /// The stamp behind it, or the last one of the log.
    pub to_us: i64,
}

/// The positions of the robots, each in the order of time.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Tracks {
    pub(crate) robots: Vec<Vec<Sample>>,
    /// The stamps at which a robot is at several places, none of which is taken: by robot and time, each with the place
    /// in the log at which that is seen.
    contradictions: BTreeMap<(u32, i64), u32>,
    gap_us: u64,
    /// The first stamp and the last one.
    span_us: [i64; 2],
    refused: Refusals,
    is_cut: bool,
}

fn count(counted: &mut Option<(u32, u32)>, place: u32) {
    counted.get_or_insert((0, place)).0 += 1;
}

/// Whether two positions are so near each other, in millimetres.
fn is_within(one: &Sample, other: &Sample, tolerance_mm: u32) -> bool {
    let [x, y, most] =
        [one.x_mm.abs_diff(other.x_mm), one.y_mm.abs_diff(other.y_mm), tolerance_mm].map(u64::from);
    x * x + y * y <= most * most
}

/// The positions behind a stamp that is far off which say whether the log goes on from there.
const LOOKED_AHEAD: usize = 16;

impl Tracks {
    /// The positions of `log`, of the robots that have numbers.
    pub fn new(log: &Log, numbers: &Numbers, limits: &Limits) -> Self {
        let mut refused = Refusals::default();
        let mut robots = vec![Vec::new(); numbers.names().len()];
        let mut latest: HashMap<u32, i64> = HashMap::new();
        // The positions at its latest stamp in whose place another one of the robot stands.
        let mut replaced: HashMap<u32, Vec<Sample>> = HashMap::new();
        let mut contradictions = BTreeMap::new();
        let mut now: Option<i64> = None;
        for (place, sample) in log.samples.iter().enumerate() {
            let Some(robot) = numbers.robot(sample.robot) else {
                count(&mut refused.nobody, sample.place);
                continue;
            };
            let is_far = |other: i64| sample.at_us.abs_diff(other) > limits.jump_us;
            if now.is_none_or(is_far) {
                let next = log.samples[place + 1..].iter().take(LOOKED_AHEAD);
                let far = next.clone().filter(|other| is_far(other.at_us)).count();
                let is_first = now.is_none() && next.len() == 0;
                if far * 2 >= next.len() && !is_first {
                    count(&mut refused.astray, sample.place);
                    continue;
                }
            }
            if latest.get(&robot).is_some_and(|&before| sample.at_us < before) {
                count(&mut refused.late, sample.place);
                continue;
            }
            latest.insert(robot, sample.at_us);
            now = Some(sample.at_us);
            let track: &mut Vec<Sample> = &mut robots[robot as usize];
            let sample = Sample { robot, ..*sample };
            if contradictions.contains_key(&(robot, sample.at_us)) {
                count(&mut refused.contradicted, sample.place);
                continue;
            }
            let before = replaced.entry(robot).or_default();
            before.retain(|known| known.at_us == sample.at_us);
            let is_far_from = |known: &Sample| !is_within(known, &sample, limits.tolerance_mm);
            // Of several positions with one stamp the last counts, and none if any two of them differ by more than the
            // tolerance.
            match track.pop_if(|last| last.at_us == sample.at_us) {
                Some(last) if is_far_from(&last) || before.iter().any(is_far_from) => {
                    count(&mut refused.contradicted, last.place);
                    count(&mut refused.contradicted, sample.place);
                    contradictions.insert((robot, sample.at_us), sample.place);
                }
                Some(last) if (last.x_mm, last.y_mm) != (sample.x_mm, sample.y_mm) => {
                    count(&mut refused.replaced, last.place);
                    before.push(last);
                    track.push(sample);
                }
                Some(_) | None => track.push(sample),
            }
        }
        let all = || robots.iter().flatten().map(|sample| sample.at_us);
        let span_us = [all().min().unwrap_or(0), all().max().unwrap_or(0)];
        Self { robots, contradictions, gap_us: limits.gap_us, span_us, refused, is_cut: log.cut.is_some() }
    }

    /// How many robots there are, silent ones among them.
    pub fn count(&self) -> usize {
        self.robots.len()
    }

    /// The positions that were taken.
    pub fn samples(&self) -> impl Iterator<Item = &Sample> {
        self.robots.iter().flatten()
    }

    /// The first place of each robot, in millimetres; none of a robot that has no position.
    pub fn starts(&self) -> impl Iterator<Item = Option<[f64; 2]>> {
        self.robots.iter().map(|track| track.first().map(|sample| [sample.x_mm, sample.y_mm].map(f64::from)))
    }

    /// The positions that were not taken.
    pub const fn refused(&self) -> Refusals {
        self.refused
    }

    /// Whether the log ends in the midst.
    pub const fn is_cut(&self) -> bool {
        self.is_cut
    }

    /// The first stamp and the last one.
    pub const fn span_us(&self) -> [i64; 2] {
        self.span_us
    }

    /// Whether a robot is taken to have gone straight from one position to the next one: the time between them is no
    /// longer than the gap, and at no stamp in it the robot is at several places.
    pub(super) fn goes_straight(&self, before: &Sample, after: &Sample) -> bool {
        let [from, to] = [before, after].map(|sample| (sample.robot, sample.at_us));
        after.at_us.abs_diff(before.at_us) <= self.gap_us
            && self.contradictions.range(from..to).next().is_none()
    }

    /// The place of a robot, in millimetres, if the log says it.
    pub fn at(&self, robot: usize, at_us: i64) -> Option<[f64; 2]> {
        let track = self.robots.get(robot)?;
        let next = track.partition_point(|sample| sample.at_us < at_us);
        let after = track.get(next)?;
        let [x, y] = [after.x_mm, after.y_mm].map(f64::from);
        if after.at_us == at_us {
            return Some([x, y]);
        }
        let before = track.get(next.checked_sub(1)?)?;
        if !self.goes_straight(before, after) {
            return None;
        }
        let whole = after.at_us.abs_diff(before.at_us);
        let part = at_us.abs_diff(before.at_us) as f64 / whole as f64;
        let between = |from: i32, to: f64| f64::from(from) + part * (to - f64::from(from));
        Some([between(before.x_mm, x), between(before.y_mm, y)])
    }

    /// The place of a robot, in millimetres, if it stood still before its first position and behind its last one, for
    /// as long as the gap.
    pub(crate) fn held(&self, robot: usize, at_us: i64) -> Option<[f64; 2]> {
        let held = || {
            let track = self.robots.get(robot)?;
            let (first, last) = (track.first()?, track.last()?);
            let end = if at_us < first.at_us { first } else { last };
            let is_inside = first.at_us <= at_us && at_us <= last.at_us;
            let is_near = !is_inside && end.at_us.abs_diff(at_us) <= self.gap_us;
            is_near.then(|| [end.x_mm, end.y_mm].map(f64::from))
        };
        self.at(robot, at_us).or_else(held)
    }

    /// Whether more positions of robots were not taken than were.
    pub fn are_mostly_refused(&self) -> bool {
        let Refusals { late, astray, replaced, contradicted, nobody: _ } = self.refused;
        let refused = [late, astray, replaced, contradicted].into_iter().flatten();
        refused.map(|(count, _)| count as usize).sum::<usize>() > self.samples().count()
    }

    /// The stamps at which a robot is at several places, by robot and time: robot, stamp, and the place in the log at
    /// which that is seen.
    pub fn contradictions(&self) -> impl ExactSizeIterator<Item = (u32, i64, u32)> + '_ {
        self.contradictions.iter().map(|(&(robot, at_us), &place)| (robot, at_us, place))
    }

    /// The times in which a robot was silent for longer than the gap, by robot and time.
    pub fn silences(&self) -> impl Iterator<Item = Silence> + '_ {
        let [first, last] = self.span_us;
        (0_u32..).zip(&self.robots).flat_map(move |(robot, track)| {
            let stamps = [first].into_iter().chain(track.iter().map(|sample| sample.at_us)).chain([last]);
            let next = stamps.clone().skip(1);
            let is_long =
                |silence: &Silence| silence.to_us.abs_diff(silence.from_us) > self.gap_us || track.is_empty();
            stamps.zip(next).map(move |(from_us, to_us)| Silence { robot, from_us, to_us }).filter(is_long)
        })
    }
}
